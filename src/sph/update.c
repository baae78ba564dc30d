/* What happens to a particle on its own: the step from level n to n + 1 once its pair sums are
 * known. Source: Parshikov (2013), section 1.5, block 2. */
#include <string.h>

#include "base/exponential.h"
#include "material/any.h"
#include "material/batch.h"
#include "material/batch_run.h"
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
 * move, their material takes them to their new density and energy, and their sizes follow. */
struct passage {
    const struct material *material;
    int32_t first;
    int count;
    struct batch batch;
    double a2[BATCH];    /* square of the acceleration by contacts */
    double sound[BATCH]; /* at level n, where supports need it */
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

/* The rates that the material of number K of a passage is to see; returns the volume ratio of the
 * step where the velocity gradient is finite, else 1. */
static double keep_rates(const struct advance *step, struct passage *passage, int k)
{
    struct batch *b = &passage->batch;
    const double *rate = step->fields->rates.strain_rate[passage->first + k],
                 *turn = step->fields->rates.spin[passage->first + k];
    struct sym3 strain_rate = {rate[0], rate[1], rate[2], rate[3], rate[4], rate[5]};
    struct vec3 spin = vec3_make(turn[0], turn[1], turn[2]);
    const double ratio = step->finite ? sph_deform(step->dt, &strain_rate, &spin) : 1.0;
    batch_keep_tensor(b->strain_rate, k, strain_rate);
    b->spin[0][k] = spin.x;
    b->spin[1][k] = spin.y;
    b->spin[2][k] = spin.z;
    b->viscous_pressure[k] = 0.0;
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
    double ratio = keep_rates(step, passage, k);
    if (step->finite) {
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
    passage->batch.new_density[k] = density;
    passage->batch.energy[k] = energy;
    passage->a2[k] = a2;
    if (f->support)
        passage->sound[k] = f->sound_long[i];
}

/* Takes number K of a passage through the step alone; under plane stress where particles have a
 * thickness. */
static void step_point(struct particles *p, const struct advance *step,
                       const struct passage *passage, int k)
{
    const struct sph_fields *const f = step->fields;
    const int32_t i = passage->first + k;
    const double *plane = f->rates.strain_rate[i];
    double *s = p->deviator[i];
    struct motion motion = batch_motion(&passage->batch, k);
    struct point point = {.density = p->density[i], .deviator = sym3_make(s)};
    motion.energy = passage->batch.energy[k];
    motion.time = step->time;
    motion.length = f->diameter[i];
    motion.acceleration = vector_at(f->rates.acceleration[i]);
    motion.damage_gradient = f->damage_gradient ? f->damage_gradient[i] : 0.0;
    particle_load_history(p, i, point.history);
    const struct response r = f->thickness
                                  ? sph_thin_step(passage->material, plane[0] + plane[1] + plane[2],
                                                  &point, &motion, &f->thickness[i])
                                  : any_material_step(passage->material, &point, &motion);
    p->density[i] = point.density;
    p->energy[i] = point.energy;
    p->pressure[i] = point.pressure;
    particle_keep_history(p, i, point.history);
    sym3_store(point.deviator, s);
    f->sound_long[i] = r.status & POINT_NO_SOUND ? 0.0 : r.sound_long;
    f->sound_shear[i] = r.sound_shear;
}

/* Takes a passage through the step as a batch, which number K - 1 fills up. */
static void step_batch(struct particles *p, const struct advance *step, struct passage *passage)
{
    const struct sph_fields *const f = step->fields;
    const double modulus = strength_shear_modulus(&passage->material->strength);
    struct batch *b = &passage->batch;
    b->count = (passage->count + LANES - 1) / LANES * LANES;
    for (int k = 0; k < b->count; k++) {
        const int from = k < passage->count ? k : passage->count - 1;
        const int32_t i = passage->first + from;
        b->density[k] = p->density[i];
        b->new_density[k] = b->new_density[from];
        b->energy[k] = b->energy[from];
        b->viscous_pressure[k] = 0.0;
        b->length[k] = f->diameter[i];
        b->damage_gradient[k] = f->damage_gradient ? f->damage_gradient[i] : 0.0;
        batch_keep_tensor(b->deviator, k, sym3_make(p->deviator[i]));
        batch_keep_tensor(b->strain_rate, k, batch_tensor(b->strain_rate, from));
        for (int c = 0; c < 3; c++)
            b->spin[c][k] = b->spin[c][from];
        batch_load_history(b, k, p->history, i);
        for (int c = 0; c < 3 && p->history[HISTORY_overload]; c++)
            b->acceleration[c][k] = f->rates.acceleration[i][c];
    }
    batch_run(passage->material, b, ENERGY_GIVEN);
    for (int k = 0; k < passage->count; k++) {
        const int32_t i = passage->first + k;
        p->density[i] = b->new_density[k];
        p->energy[i] = b->energy[k];
        p->pressure[i] = b->pressure[k];
        sym3_store(batch_tensor(b->new_deviator, k), p->deviator[i]);
        batch_keep_history(b, k, p->history, i);
        f->sound_long[i] = b->sound_long[k];
        f->sound_shear[i] = sqrt(modulus / b->new_density[k]);
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
                          isfinite(passage->a2[k]) && f->sound_long[i] > 0.0;
    if (!possible)
        note_impossible(impossible, p->id[i], i);
}

/* Particles BEGIN .. END - 1, all of one material. */
static void update_run(const struct material *material, struct particles *p,
                       const struct advance *step, int32_t begin, int32_t end,
                       struct impossible *impossible)
{
    const bool batches = !step->fields->thickness && batch_takes(material);
    struct passage passage;
    passage.material = material;
    passage.batch.dt = step->dt;
    for (int32_t first = begin; first < end; first += BATCH) {
        passage.first = first;
        passage.count = end - first < BATCH ? end - first : BATCH;
        for (int k = 0; k < passage.count; k++)
            start_point(p, step, &passage, k);
        if (batches)
            step_batch(p, step, &passage);
        for (int k = 0; k < passage.count && !batches; k++)
            step_point(p, step, &passage, k);
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
