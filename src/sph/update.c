/* What happens to a particle on its own: the step from level n to n + 1 once its pair sums are
 * known. Source: Parshikov (2013), section 1.5, block 2. */
#include <string.h>

#include "base/exponential.h"
#include "material/any.h"
#include "sph/deform.h"
#include "sph/evaluate.h"
#include "sph/scheme.h"

void sph_evaluate(const struct sph *sph, struct simulation *simulation)
{
    struct sph_fields f = sph_fields_of(sph, simulation);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < sph->particles->count; i++) {
        if (f.thickness && f.thickness[i] == 0.0) /* fresh */
            f.thickness[i] = 1.0;
        sph_evaluate_point(simulation, &f, i);
        f.diameter[i] =
            diameter_of_volume(sph_volume(simulation, &f, i), simulation->problem->dimension);
        if (f.support && f.support[i] == 0.0) /* fresh */
            f.support[i] = f.diameter[i];
    }
}

/* The particle with the smallest id whose new state is impossible. */
struct impossible {
    bool any;
    uint64_t id;
    int32_t index;
};

static void note_impossible(struct impossible *impossible, uint64_t id, int32_t index)
{
    if (!impossible->any || id < impossible->id)
        *impossible = (struct impossible){true, id, index};
}

/* The relative growth of a particle's density in a step of DT where neighbouring volumes overlap:
 * the mean excess about it times the sound transits of the particle in DT. No work goes with it, so
 * internal energy must suffice: growth is zero below the energy of cold compression and full at
 * twice as much. Where volumes leave gaps, density decreases, but by no more than it has grown here
 * before: at a surface and in stretched material neighbours are few too. */
BOLIDE_INLINE double packing_growth(const struct material *material, const struct particles *p,
                                    const struct sph_fields *f, double dt, int32_t i)
{
    double *packing = f->packing[i];
    const double passages = dt * f->sound_long[i] / f->diameter[i];
    const double bulk = square(f->sound_long[i]) - 4.0 / 3.0 * square(f->sound_shear[i]);
    const double cold =
        0.5 * bulk * square(maximum(0.0, 1.0 - material_density(material) / p->density[i]));
    const double room = cold > 0.0 ? minimum(1.0, maximum(0.0, (p->energy[i] - cold) / cold)) : 1.0;
    const double excess = packing[PACKING_MEAN];
    const double growth = excess > 0.0 ? room * passages * excess
                                       : maximum(passages * excess, -packing[PACKING_GROWTH]);
    packing[PACKING_GROWTH] += growth;
    return growth;
}

/* The volume ratio in a step of DT, where it is RATIO by the velocities of contacts, and SHARE of
 * it follows positions; ACROSS is the strain rate that the plane does not know of, that of a hoop.
 * Courant's condition keeps what the particles' places do to a volume below a tenth a step; what
 * single neighbours do is kept below a third. */
BOLIDE_INLINE double volume_ratio(const double *volume, double share, double dt, double ratio,
                                  double across)
{
    const double growth = 1.0 + dt * (volume[VOLUME_FIRST] +
                                      dt * (volume[VOLUME_SECOND] + dt * volume[VOLUME_THIRD]));
    const double placed = growth * (1.0 + dt * across) * exponential(dt * volume[VOLUME_EXCHANGE]);
    return ratio + share * (minimum(maximum(placed, 0.75), 4.0 / 3.0) - ratio);
}

/* The same for ring I. A fit through the few neighbours that a fragment has left says little of its
 * volume, and no work goes with what it says. So its share falls from one to none as neighbours
 * fill less than a half of the surroundings, which they do at a corner, down to a quarter. */
BOLIDE_INLINE double ring_volume_ratio(const struct sph_fields *f, int32_t i, double dt,
                                       double ratio)
{
    const double *packing = f->packing[i], *volume = f->volume[i];
    const double filled = packing[PACKING_START] + packing[PACKING_EXCESS];
    const double share = volume[VOLUME_SHARE] * minimum(1.0, maximum(0.0, 4.0 * filled - 1.0));
    ratio = volume_ratio(volume, share, dt, ratio, f->rates.strain_rate[i][2]);
    return minimum(maximum(ratio, 0.75), 4.0 / 3.0);
}

/* The largest stretch that the plastic and elastic strain allow. */
BOLIDE_INLINE double largest_stretch(const struct particles *p, const struct sph_fields *f,
                                     int32_t i)
{
    const double *s = p->deviator[i], modulus = p->density[i] * square(f->sound_shear[i]);
    const struct sym3 deviator = {s[0], s[1], s[2], s[3], s[4], s[5]};
    const double elastic = modulus > 0.0 ? sqrt(sym3_square(deviator) / 6.0) / modulus : 0.0;
    return exp(p->plastic_strain[i] + elastic);
}

/* The ratio of support to diameter of particle I after a step of DT. Large strain moves particles
 * apart along one axis and together along another, until they lose their neighbours along the first
 * axis: the velocity gradient then lacks that axis, and density drifts. So a support grows, some
 * per cent a step, where neighbours are more sparse than at the start (see find_packing), and
 * shrinks where they are not; at most to largest_stretch and to LARGEST times. SOUND is that
 * of level n. */
BOLIDE_INLINE double support_ratio(const struct particles *p, const struct sph_fields *f,
                                   double sound, double largest, double dt, int32_t i)
{
    const double *packing = f->packing[i];
    const double lack = minimum(packing[PACKING_THIN] / packing[PACKING_THIN_START] - 1.0, 1.0);
    const double ratio =
        f->support[i] / f->diameter[i] * (1.0 + 0.1 * lack * dt * sound / f->diameter[i]);
    return ratio > 1.0 ? minimum(ratio, minimum(largest, largest_stretch(p, f, i))) : 1.0;
}

/* A step of DT that ends at TIME; TOTAL: the power is that of E + U^2/2; FINITE: the velocity
 * gradient is that of positions at level n (deform.h). */
struct advance {
    const struct sph_fields *fields;
    int dimension;
    bool total, finite;
    double largest_support, dt, time;
    const double *gravity;
    const double (*load)[3]; /* the acceleration by loads; NULL: none */
};

/* Particles FIRST .. FIRST + COUNT - 1, all of one material, on their way through a step: they
 * move, their material takes them to their new density and energy, and their sizes follow. Only the
 * second of these loops is compiled for each model. */
enum { PASSAGE = 64 };
struct passage {
    const struct material *material;
    int32_t first;
    int count;
    double density[PASSAGE], energy[PASSAGE]; /* new */
    double a2[PASSAGE];                       /* square of the acceleration by contacts */
    double sound[PASSAGE];                    /* at level n, where supports need it */
    unsigned status[PASSAGE];
    const double (*strain_rate)[6], (*spin)[3]; /* from FIRST on: of the fields, or */
    double deformed_rate[PASSAGE][6], deformed_spin[PASSAGE][3];
};

/* Moves particle I; returns the square of its acceleration by contacts. */
BOLIDE_INLINE double move(struct particles *p, const struct advance *step, int32_t i)
{
    const struct sph_fields *const f = step->fields;
    const double dt = step->dt, *a = f->rates.acceleration[i];
    double *u = p->velocity[i], *x = p->position[i], a2 = 0.0;
    for (int axis = 0; axis < step->dimension; axis++) {
        double next = u[axis] + dt * a[axis];
        /* (1.86), or the kernel mean of contact velocities */
        x[axis] += f->rates.drift && !step->finite ? dt * (u[axis] + f->rates.drift[i][axis])
                                                   : 0.5 * dt * (u[axis] + next);
        if (f->rates.drift && step->finite)
            x[axis] += dt * f->rates.drift[i][axis];
        u[axis] = next;
        a2 += a[axis] * (a[axis] - step->gravity[axis]);
    }
    for (int axis = 0; step->load && axis < step->dimension; axis++)
        a2 -= a[axis] * step->load[i][axis];
    return a2;
}

/* The volume ratio of a step with a finite velocity gradient, with the rates that the material is
 * to see. */
static double deform(const struct advance *step, struct passage *passage, int k)
{
    const double *rate = step->fields->rates.strain_rate[passage->first + k],
                 *turn = step->fields->rates.spin[passage->first + k];
    struct sym3 strain_rate = {rate[0], rate[1], rate[2], rate[3], rate[4], rate[5]};
    struct vec3 spin = vec3_make(turn[0], turn[1], turn[2]);
    const double ratio = sph_deform(step->dt, &strain_rate, &spin);
    memcpy(passage->deformed_rate[k], &strain_rate, sizeof strain_rate);
    memcpy(passage->deformed_spin[k], &spin, sizeof spin);
    return ratio;
}

/* Moves number K of a passage, and finds its new density and energy. */
BOLIDE_INLINE void start_point(struct particles *p, const struct advance *step,
                               struct passage *passage, int k)
{
    const struct sph_fields *const f = step->fields;
    const int32_t i = passage->first + k;
    const double dt = step->dt, *rate = f->rates.strain_rate[i];
    const double divergence = rate[0] + rate[1] + rate[2], a2 = move(p, step, i);
    double density = p->density[i] * (2.0 - divergence * dt) / (2.0 + divergence * dt); /* (1.82) */
    if (step->finite) {
        double ratio = deform(step, passage, k);
        if (f->volume && f->rates.hoop_pull)
            ratio = ring_volume_ratio(f, i, dt, ratio);
        else if (f->volume)
            ratio = volume_ratio(f->volume[i], f->volume[i][VOLUME_SHARE], dt, ratio,
                                 step->dimension == 2 ? rate[2] : 0.0);
        density = p->density[i] / ratio;
    }
    if (f->packing)
        density *= 1.0 + packing_growth(passage->material, p, f, dt, i);
    /* (1.80), (1.81): the change of E + U^2/2 less that of U^2/2 and the work of gravity and
     * loads, without taking differences. */
    double energy =
        p->energy[i] + dt * f->rates.power[i] - (step->total ? 0.5 * square(dt) * a2 : 0.0);
    if (f->heat_rate)
        energy += dt * f->heat_rate[i];
    passage->density[k] = density;
    passage->energy[k] = energy;
    passage->a2[k] = a2;
    if (f->support)
        passage->sound[k] = f->sound_long[i];
}

/* What a loop is compiled for: points that remember no more than their plastic strain; all; those
 * of a plate that thins. */
enum kind_of_points { PLAIN_POINTS, ANY_POINTS, THIN_POINTS };

/* Takes a passage through MATERIAL, whose kinds are constants where plain points are stepped. */
BOLIDE_INLINE void step_points(const struct material *material, enum kind_of_points kind,
                               struct particles *p, const struct advance *step,
                               struct passage *passage)
{
    const struct sph_fields *const f = step->fields;
    for (int k = 0; k < passage->count; k++) {
        const int32_t i = passage->first + k;
        const double *rate = passage->strain_rate[k], *spin = passage->spin[k];
        double *s = p->deviator[i];
        struct motion motion = {
            .dt = step->dt,
            .density = passage->density[k],
            .energy = passage->energy[k],
            .strain_rate = {rate[0], rate[1], rate[2], rate[3], rate[4], rate[5]},
            .spin = {spin[0], spin[1], spin[2]},
            .time = step->time,
            .length = f->diameter[i]};
        struct point point = {.density = p->density[i],
                              .deviator = {s[0], s[1], s[2], s[3], s[4], s[5]},
                              .history = {p->plastic_strain[i]}};
        struct response r;
        if (kind != PLAIN_POINTS)
            particle_load_history(p, i, point.history);
        if (kind == PLAIN_POINTS) {
            r = material_step(material, &point, &motion);
        } else if (kind == THIN_POINTS) {
            const double *plane = f->rates.strain_rate[i];
            r = sph_thin_step(material, plane[0] + plane[1] + plane[2], &point, &motion,
                              &f->thickness[i]);
        } else {
            r = any_material_step(material, &point, &motion);
        }
        p->density[i] = point.density;
        p->energy[i] = point.energy;
        p->pressure[i] = point.pressure;
        if (kind == PLAIN_POINTS)
            p->plastic_strain[i] = point.history[HISTORY_plastic_strain];
        else
            particle_keep_history(p, i, point.history);
        s[0] = point.deviator.xx;
        s[1] = point.deviator.yy;
        s[2] = point.deviator.zz;
        s[3] = point.deviator.xy;
        s[4] = point.deviator.yz;
        s[5] = point.deviator.zx;
        f->sound_long[i] = r.sound_long;
        f->sound_shear[i] = r.sound_shear;
        passage->status[k] = r.status;
    }
}

/* One switch for all points. */
static void step_plain_points(struct particles *p, const struct advance *step,
                              struct passage *passage)
{
    struct material m = *passage->material;
    const enum strength_kind strength = m.strength.kind;
    m.failure.kind = FAILURE_NONE; /* constants here, as for all plain points */
    m.burn.kind = BURN_INSTANT;
    switch (m.eos.kind) {
#define STEP_SOLID(name)                                 \
    case STRENGTH_##name:                                \
        m.strength.kind = STRENGTH_##name;               \
        step_points(&m, PLAIN_POINTS, p, step, passage); \
        break;
#define STEP_CASE(name)                                      \
    case EOS_##name:                                         \
        m.eos.kind = EOS_##name;                             \
        switch (strength) {                                  \
            STRENGTH_PLAIN(STEP_SOLID)                       \
        default:                                             \
            m.strength.kind = STRENGTH_NONE;                 \
            step_points(&m, PLAIN_POINTS, p, step, passage); \
        }                                                    \
        break;
        EOS_STATELESS(STEP_CASE)
#undef STEP_CASE
#undef STEP_SOLID
    default:
        break;
    }
}

/* Sizes of number K of a passage in its new state, and whether that is possible. */
BOLIDE_INLINE void finish_point(struct particles *p, const struct advance *step,
                                const struct passage *passage, int k, struct impossible *impossible)
{
    const struct sph_fields *const f = step->fields;
    const int32_t i = passage->first + k;
    const double ratio =
        f->support ? support_ratio(p, f, passage->sound[k], step->largest_support, step->dt, i)
                   : 1.0;
    const double depth = f->thickness         ? f->thickness[i]
                         : f->rates.hoop_pull ? sph_ring(p, i).depth
                                              : 1.0;
    f->diameter[i] = diameter_of_volume(p->mass[i] / (p->density[i] * depth), step->dimension);
    if (f->support)
        f->support[i] = ratio * f->diameter[i];
    const bool possible = p->density[i] > 0.0 && isfinite(p->density[i]) &&
                          isfinite(p->pressure[i]) && isfinite(p->energy[i]) &&
                          isfinite(passage->a2[k]) && !(passage->status[k] & POINT_NO_SOUND);
    if (!possible)
        note_impossible(impossible, p->id[i], i);
}

/* Particles BEGIN .. END - 1, all of one material. */
static void update_run(const struct material *material, struct particles *p,
                       const struct advance *step, int32_t begin, int32_t end,
                       struct impossible *impossible)
{
    const struct sph_fields *const f = step->fields;
    struct passage passage;
    passage.material = material;
    for (int32_t first = begin; first < end; first += PASSAGE) {
        passage.first = first;
        passage.count = end - first < PASSAGE ? end - first : PASSAGE;
        for (int k = 0; k < passage.count; k++)
            start_point(p, step, &passage, k);
        passage.strain_rate = (const double(*)[6])(step->finite ? passage.deformed_rate
                                                                : f->rates.strain_rate + first);
        passage.spin =
            (const double(*)[3])(step->finite ? passage.deformed_spin : f->rates.spin + first);
        if (f->thickness)
            step_points(material, THIN_POINTS, p, step, &passage);
        else if (material_is_plain(material))
            step_plain_points(p, step, &passage);
        else
            step_points(material, ANY_POINTS, p, step, &passage);
        for (int k = 0; k < passage.count; k++)
            finish_point(p, step, &passage, k, impossible);
    }
}

static void update_block(struct simulation *simulation, const struct advance *step,
                         const struct block *block, struct impossible *impossible)
{
    struct particles *p = step->fields->particles;
    const int32_t end = block->first + block->count;
    for (int32_t begin = block->first, next; begin < end; begin = next) {
        uint16_t material = p->material[begin];
        for (next = begin + 1; next < end && p->material[next] == material;)
            next++;
        update_run(&simulation->problem->material[material], p, step, begin, next, impossible);
    }
}

/* Heat alone: density and deviator stay. */
static void update_heat(const struct sph *sph, struct simulation *simulation,
                        const struct sph_fields *f, double dt, struct impossible *impossible)
{
    struct particles *p = sph->particles;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++)
        p->energy[i] += dt * f->heat_rate[i];
    sph_evaluate(sph, simulation);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++)
        if (!isfinite(p->energy[i]) || !isfinite(p->pressure[i])) {
#pragma omp critical(bolide_sph_impossible)
            note_impossible(impossible, p->id[i], i);
        }
}

struct error *sph_update(const struct sph *sph, struct simulation *simulation,
                         const struct sph_fields *fields, double dt)
{
    if (fields->rates.wall)
        sph_book_walls(simulation, fields, dt);
    sph_hold_bodies(simulation, fields, dt);
    struct impossible impossible = {false, 0, 0};
    if (sph_has(sph, SPH_STILL)) {
        update_heat(sph, simulation, fields, dt, &impossible);
        return impossible.any ? simulation_impossible(simulation, impossible.index) : NULL;
    }
    TRY(sph_add_loads(sph, simulation, fields, simulation->time, dt));
    sph_add_gravity(simulation, fields, dt, 0.5 * dt);
    sph_book_loads(sph, simulation, fields, dt, 0.5 * dt);
    const struct advance step = {.fields = fields,
                                 .dimension = simulation->problem->dimension,
                                 .total = sph_has(sph, SPH_TOTAL_ENERGY),
                                 .finite = sph_has(sph, SPH_FINITE_STRAIN),
                                 .largest_support = sph->largest_support,
                                 .dt = dt,
                                 .time = simulation->time + dt,
                                 .gravity = simulation->problem->gravity,
                                 .load = sph_load_of(sph)};
#pragma omp parallel num_threads(simulation->threads)
    {
        struct impossible own = {false, 0, 0};
#pragma omp for schedule(dynamic)
        for (int32_t b = 0; b < sph->particles->blocks; b++)
            update_block(simulation, &step, &sph->particles->block[b], &own);
#pragma omp critical(bolide_sph_impossible)
        if (own.any)
            note_impossible(&impossible, own.id, own.index);
    }
    if (fields->rates.wall)
        sph_return_strays(simulation, sph->particles);
    return impossible.any ? simulation_impossible(simulation, impossible.index) : NULL;
}
