/* What happens to a particle on its own: records from states, and the step from level n to n + 1 once its sums
 * are known. Source: Parshikov (2013), section 1.5, block 2. */
#include <string.h>

#include "sph/sph_internal.h"

void sph_evaluate(const struct sph *sph, struct simulation *simulation)
{
    struct sph_fields f = sph_fields_of(sph, simulation);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < simulation->particles.count; i++) {
        sph_evaluate_point(simulation, &f, i);
        f.diameter[i] = diameter_of_volume(sph_volume(simulation, &f, i), simulation->dimension);
        if (f.support && f.support[i] == 0.0) /* fresh */
            f.support[i] = f.diameter[i];
    }
}

/* Record of particle I; see pair_kernel.h for the order. What KIND has beyond the plain is a constant where this
 * is inlined. */
BOLIDE_INLINE void pack_owned(const struct sph *sph, const struct simulation *simulation,
                              const struct sph_fields *f, struct pair_kind kind, int32_t i,
                              double *record)
{
    bool shear = kind.shear;
    const struct particles *p = &simulation->particles;
    int dimension = simulation->dimension, k = 0;
    for (int axis = 0; axis < dimension; axis++)
        record[k++] = p->position[i][axis];
    record[k++] = f->diameter[i];
    record[k++] = kind.depth ? sph_volume(simulation, f, i) : p->mass[i] / p->density[i];
    for (int axis = 0; axis < dimension; axis++)
        record[k++] = p->velocity[i][axis];
    const double *s = p->deviator[i];
    double pressure = p->pressure[i] + (f->viscosity ? f->viscosity[i] : 0.0);
    record[k++] = s[0] - pressure;
    if (shear && dimension == 2) {
        record[k++] = s[1] - pressure;
        record[k++] = s[3];
    }
    if (shear && dimension == 3) {
        record[k++] = s[1] - pressure;
        record[k++] = s[2] - pressure;
        memcpy(record + k, s + 3, 3 * sizeof *s);
        k += 3;
    }
    record[k++] = p->density[i] * f->sound_long[i];
    if (shear)
        record[k++] = p->density[i] * f->sound_shear[i];
    if (record_has_bend(kind)) {
        record[k++] = p->density[i];
        record[k++] = sph->bend[p->material[i]];
    }
    if (kind.depth)
        record[k++] = sph_depth(simulation, f, i);
    if (kind.turn) {
        const double *spin = f->rates.spin[i];
        memcpy(record + k, dimension == 2 ? spin + 2 : spin,
               (dimension == 2 ? 1 : 3) * sizeof *spin);
    }
}

void sph_reflect_motion(const struct simulation *simulation, image_code image, double *record)
{
    int dimension = simulation->dimension;
    struct vec3 sign = image_sign(image);
    double x[3] = {0.0, 0.0, 0.0}, signs[3] = {sign.x, sign.y, sign.z};
    memcpy(x, record, (size_t)dimension * sizeof *x);
    struct vec3 place = image_position(&simulation->mirrors, image, vec3_make(x[0], x[1], x[2]));
    double at[3] = {place.x, place.y, place.z};
    double *velocity = record + record_velocity(dimension);
    assert(dimension <= 3);
    for (int axis = 0; axis < dimension; axis++) {
        record[axis] = at[axis];
        velocity[axis] *= signs[axis];
    }
}

/* Turns the record of a particle into that of its image: place mirrored, normal velocity and the shear
 * stresses with one normal index negated, spin as a pseudovector; behind the axis a radius is negative. */
static void reflect(const struct simulation *simulation, struct pair_kind kind, image_code image,
                    double *record)
{
    int dimension = simulation->dimension;
    struct vec3 sign = image_sign(image);
    sph_reflect_motion(simulation, image, record);
    if (kind.shear)
        sph_reflect_tensor(dimension, sign, record + record_stress(dimension));
    if (sph_axisymmetric(simulation) && image % 3 == 1)
        record[record_depth(kind)] *= -1.0;
    double *spin = record + record_spin(kind);
    if (kind.turn && dimension == 2)
        spin[0] *= sign.x * sign.y;
    if (kind.turn && dimension == 3) {
        spin[0] *= sign.y * sign.z;
        spin[1] *= sign.z * sign.x;
        spin[2] *= sign.x * sign.y;
    }
}

/* The records of ghosts BEGIN .. END - 1, which are images. */
static void pack_images(struct sph *sph, const struct simulation *simulation, int32_t begin,
                        int32_t end)
{
    const struct ghosts *ghosts = &sph->neighbours.ghosts;
    size_t stride = (size_t)record_stride(sph->kind);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t g = begin; g < end; g++) {
        double *record = sph->record + (size_t)(simulation->particles.count + g) * stride;
        memcpy(record, sph->record + (size_t)ghosts->source[g] * stride, stride * sizeof *record);
        reflect(simulation, sph->kind, ghosts->image[g], record);
    }
}

void sph_pack(struct sph *sph, const struct simulation *simulation)
{
    const struct particles *p = &simulation->particles;
    struct ghosts *ghosts = &sph->neighbours.ghosts;
    struct sph_fields f = sph_fields_of(sph, simulation);
    size_t stride = (size_t)record_stride(sph->kind);
    struct pair_kind kind = sph->kind;
    bool plain = !kind.depth && !kind.turn;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        double *record = sph->record + (size_t)i * stride;
        if (plain) {
            struct pair_kind same = {kind.dimension, kind.shear, kind.star,
                                     kind.drift,     false,      false};
            pack_owned(sph, simulation, &f, same, i, record);
        } else {
            pack_owned(sph, simulation, &f, kind, i, record);
        }
    }
    ghosts_start(ghosts, sph->record, p->count, stride * sizeof *sph->record);
    pack_images(sph, simulation, ghosts->remotes, ghosts->early);
    /* The record that fills up lanes has no volume; its contact problem must only have an answer. */
    double *empty = sph->record + (size_t)(p->count + ghosts->count) * stride;
    memset(empty, 0, stride * sizeof *empty);
    if (record_has_bend(sph->kind)) {
        int dimension = simulation->dimension, bend = record_bend(dimension, sph->kind.shear);
        empty[record_stress(dimension)] = -1.0;
        empty[record_impedance(dimension, sph->kind.shear)] = 1.0;
        empty[bend] = 1.0;
        empty[bend + 1] = 2.0;
    }
}

void sph_pack_rest(struct sph *sph, const struct simulation *simulation)
{
    struct ghosts *ghosts = &sph->neighbours.ghosts;
    ghosts_finish(ghosts);
    pack_images(sph, simulation, ghosts->early, ghosts->count);
}

void sph_find_viscosity(const struct sph *sph, const struct simulation *simulation,
                        const struct sph_fields *f)
{
    const struct particles *p = &simulation->particles;
    double quadratic = sph->parameters.viscosity_quadratic,
           linear = sph->parameters.viscosity_linear;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        const double *rate = f->rates.strain_rate[i];
        double k = maximum(-(rate[0] + rate[1] + rate[2]), 0.0), d = f->diameter[i];
        f->viscosity[i] = p->density[i] * d * k * (quadratic * d * k + linear * f->sound_long[i]);
    }
}

struct limit sph_least_limit(const struct simulation *simulation, struct limit own)
{
    double dt = ranks_minimum(simulation->ranks, own.dt);
    return own.dt > dt ? (struct limit){dt, "another rank", UINT64_MAX} : own;
}

void sph_limit_step(const struct sph *sph, const struct simulation *simulation,
                    const struct sph_fields *f, struct limit *limit)
{
    const struct particles *p = &simulation->particles;
    double courant = sph->parameters.courant;
    struct limit smallest = {(double)INFINITY, "sound speed", 0};
#pragma omp parallel num_threads(simulation->threads)
    {
        struct limit own = smallest;
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++) {
            const double *rate = f->rates.strain_rate[i];
            double divergence = sph_second_order(sph) ? muscl_divergence(simulation, f, i)
                                                      : rate[0] + rate[1] + rate[2];
            double d = f->diameter[i];
            double stretch = 4.0 * d * divergence;
            double dt = courant * d / sqrt(square(f->sound_long[i]) + square(stretch));
            if (dt < own.dt || (dt == own.dt && p->id[i] < own.id)) {
                own.dt = dt;
                own.id = p->id[i];
                own.why = fabs(stretch) > f->sound_long[i] ? "volume rate" : "sound speed";
            }
        }
#pragma omp critical(bolide_sph_limit)
        if (own.dt < smallest.dt || (own.dt == smallest.dt && own.id < smallest.id))
            smallest = own;
    }
    *limit = sph_least_limit(simulation, smallest);
}

/* The particle with the smallest id whose new state is impossible. */
struct failure {
    bool any;
    uint64_t id;
    int32_t index;
};

static void note_failure(struct failure *failure, uint64_t id, int32_t index)
{
    if (!failure->any || id < failure->id)
        *failure = (struct failure){true, id, index};
}

/* How fast a particle is compressed, 1/s, where the volumes about it fill more than the space there is: by the excess,
 * 0.1 at most, with the speed of sound over the diameter. Its heat must pay for that, since no work goes with it: less than the energy of cold
 * compression leaves none, twice as much is enough. */
BOLIDE_INLINE double packing_rate(const struct material *material, const struct particles *p,
                                  const struct sph_fields *f, int32_t i)
{
    const double bulk = square(f->sound_long[i]) - 4.0 / 3.0 * square(f->sound_shear[i]);
    const double cold =
        0.5 * bulk * square(maximum(0.0, 1.0 - material_density(material) / p->density[i]));
    const double room = cold > 0.0 ? minimum(1.0, maximum(0.0, (p->energy[i] - cold) / cold)) : 1.0;
    return room * minimum(f->packing[i][1], 0.1) * f->sound_long[i] / f->diameter[i];
}

/* The share of the diameter by which the support of particle I is wider after a step of DT. Matter that flows far draws its
 * particles apart along one axis and together along another, until on the one they no longer see each other: the velocity
 * gradient knows nothing of that axis then, and density goes astray. So a support grows, some per cent a step, where
 * neighbours stand more thinly than at the start (see write_packing), and shrinks where they do not; not beyond what plastic
 * strain can have drawn out, nor three times. */
BOLIDE_INLINE double support_share(const struct particles *p, const struct sph_fields *f, double dt,
                                   int32_t i)
{
    const double lack = minimum(f->packing[i][3] / f->packing[i][2] - 1.0, 1.0);
    const double share = f->support[i] / f->diameter[i] *
                         (1.0 + 0.1 * lack * dt * f->sound_long[i] / f->diameter[i]);
    return share > 1.0 ? minimum(share, minimum(3.0, exp(p->plastic_strain[i]))) : 1.0;
}

/* A step of DT that ends at TIME; TOTAL: the rates' power is that of E + U^2/2. */
struct advance {
    int dimension;
    bool total;
    double dt, time;
    const double *gravity;
};

/* A run of particles of one material. MATERIAL's kinds are constants where this is inlined; PLAIN: it remembers no more
 * than its plastic strain. */
BOLIDE_INLINE void update_run(const struct material *material, bool plain, struct particles *p,
                              const struct sph_fields *f, struct advance step, int32_t begin,
                              int32_t end, struct failure *failure)
{
    const int dimension = step.dimension;
    const double dt = step.dt;
    for (int32_t i = begin; i < end; i++) {
        const double *a = f->rates.acceleration[i], *rate = f->rates.strain_rate[i];
        double *u = p->velocity[i], *x = p->position[i], *s = p->deviator[i];
        double divergence = rate[0] + rate[1] + rate[2], a2 = 0.0;
        for (int axis = 0; axis < dimension; axis++) {
            double next = u[axis] + dt * a[axis];
            /* (1.86), or the kernel mean of contact velocities */
            x[axis] += f->rates.drift && !f->velocity_gradient
                           ? dt * (u[axis] + f->rates.drift[i][axis])
                           : 0.5 * dt * (u[axis] + next);
            if (f->rates.drift && f->velocity_gradient)
                x[axis] += dt * f->rates.drift[i][axis];
            u[axis] = next;
            a2 += a[axis] * (a[axis] - step.gravity[axis]);
        }
        struct motion motion;
        motion.dt = dt;
        motion.time = step.time;
        motion.length = f->diameter[i];
        motion.density =
            p->density[i] * (2.0 - divergence * dt) / (2.0 + divergence * dt); /* (1.82) */
        motion.strain_rate = (struct sym3){rate[0], rate[1], rate[2], rate[3], rate[4], rate[5]};
        motion.spin = vec3_make(f->rates.spin[i][0], f->rates.spin[i][1], f->rates.spin[i][2]);
        if (f->velocity_gradient)
            motion.density = p->density[i] / muscl_deform(dt, &motion.strain_rate, &motion.spin);
        if (f->packing)
            motion.density *= 1.0 + dt * packing_rate(material, p, f, i);
        /* (1.80), (1.81): the change of E + U^2/2 less that of U^2/2 and the work of gravity, without taking
         * differences. */
        motion.energy =
            p->energy[i] + dt * f->rates.power[i] - (step.total ? 0.5 * square(dt) * a2 : 0.0);
        if (f->heat_rate)
            motion.energy += dt * f->heat_rate[i];
        struct point point = {.density = p->density[i],
                              .deviator = {s[0], s[1], s[2], s[3], s[4], s[5]},
                              .history = {p->plastic_strain[i]}};
        if (!plain)
            particle_load_history(p, i, point.history);
        struct response r;
        if (f->thickness) { /* by copies: the other branch keeps its values in registers */
            struct material own = *material;
            struct point thin = point;
            motion.viscous_pressure = 0.0; /* of those who find the energy from work */
            struct motion within = motion;
            r = sph_thin_step(&own, divergence, &thin, &within, &f->thickness[i]);
            point = thin;
        } else {
            r = material_step(material, &point, &motion);
        }
        p->density[i] = point.density;
        p->energy[i] = point.energy;
        p->pressure[i] = point.pressure;
        if (plain)
            p->plastic_strain[i] = point.history[HISTORY_plastic_strain];
        else
            particle_keep_history(p, i, point.history);
        s[0] = point.deviator.xx;
        s[1] = point.deviator.yy;
        s[2] = point.deviator.zz;
        s[3] = point.deviator.xy;
        s[4] = point.deviator.yz;
        s[5] = point.deviator.zx;
        const double share = f->support ? support_share(p, f, dt, i) : 1.0;
        f->sound_long[i] = r.sound_long;
        f->sound_shear[i] = r.sound_shear;
        double depth = f->thickness ? f->thickness[i] : f->rates.hoop_pull ? fabs(x[0]) : 1.0;
        f->diameter[i] = diameter_of_volume(p->mass[i] / (point.density * depth), dimension);
        if (f->support)
            f->support[i] = share * f->diameter[i];
        bool possible = point.density > 0.0 && isfinite(point.density) &&
                        isfinite(point.pressure) && isfinite(point.energy) && isfinite(a2) &&
                        !(r.status & POINT_NO_SOUND);
        if (!possible)
            note_failure(failure, p->id[i], i);
    }
}

/* Materials of the rarer kinds, one switch a particle; apart, so that their physics is not in the way of the others'. */
static __attribute__((noinline)) void update_rare(const struct material *material,
                                                  struct particles *p, const struct sph_fields *f,
                                                  struct advance step, int32_t begin, int32_t end,
                                                  struct failure *failure)
{
    update_run(material, false, p, f, step, begin, end, failure);
}

/* One switch a run: in each branch the kinds of the material are constants. */
static void update_batch(const struct material *material, struct particles *p,
                         const struct sph_fields *f, struct advance step, int32_t begin,
                         int32_t end, struct failure *failure)
{
    struct material m = *material;
    if (!material_is_plain(material)) {
        update_rare(material, p, f, step, begin, end, failure);
        return;
    }
    switch (material->eos.kind) {
#define UPDATE_SOLID(name)                                     \
    case STRENGTH_##name:                                      \
        m.strength.kind = STRENGTH_##name;                     \
        update_run(&m, true, p, f, step, begin, end, failure); \
        break;
#define UPDATE_CASE(name)                                          \
    case EOS_##name:                                               \
        m.eos.kind = EOS_##name;                                   \
        switch (material->strength.kind) {                         \
            STRENGTH_PLAIN(UPDATE_SOLID)                           \
        default:                                                   \
            m.strength.kind = STRENGTH_NONE;                       \
            update_run(&m, true, p, f, step, begin, end, failure); \
        }                                                          \
        break;
        EOS_LIST(UPDATE_CASE)
#undef UPDATE_CASE
#undef UPDATE_SOLID
    default:
        break;
    }
}

static void update_block(const struct sph *sph, struct simulation *simulation,
                         const struct sph_fields *f, const struct block *block, double dt,
                         struct failure *failure)
{
    struct particles *p = &simulation->particles;
    const struct advance step = {simulation->dimension, sph->parameters.energy == SPH_ENERGY_TOTAL,
                                 dt, simulation->time + dt, simulation->gravity};
    int32_t end = block->first + block->count;
    for (int32_t begin = block->first, next; begin < end; begin = next) {
        uint16_t material = p->material[begin];
        for (next = begin + 1; next < end && p->material[next] == material;)
            next++;
        update_batch(&simulation->material[material], p, f, step, begin, next, failure);
    }
}

/* Heat alone: density and deviator stay. */
static void update_heat(const struct sph *sph, struct simulation *simulation,
                        const struct sph_fields *f, double dt, struct failure *failure)
{
    struct particles *p = &simulation->particles;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++)
        p->energy[i] += dt * f->heat_rate[i];
    sph_evaluate(sph, simulation);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++)
        if (!isfinite(p->energy[i]) || !isfinite(p->pressure[i])) {
#pragma omp critical(bolide_sph_failure)
            note_failure(failure, p->id[i], i);
        }
}

struct error *sph_update(const struct sph *sph, struct simulation *simulation, double dt)
{
    struct sph_fields f = sph_fields_of(sph, simulation);
    if (f.rates.wall)
        sph_book_walls(simulation, &f, dt);
    frozen_book(sph, simulation, dt);
    sph_hold_bodies(simulation, &f, dt);
    struct failure failure = {false, 0, 0};
    if (sph_still(sph)) {
        update_heat(sph, simulation, &f, dt, &failure);
        return failure.any ? simulation_impossible(simulation, failure.index) : NULL;
    }
    sph_add_gravity(simulation, &f, dt, 0.5 * dt);
#pragma omp parallel num_threads(simulation->threads)
    {
        struct failure own = {false, 0, 0};
#pragma omp for schedule(dynamic)
        for (int32_t b = 0; b < simulation->particles.blocks; b++)
            update_block(sph, simulation, &f, &simulation->particles.block[b], dt, &own);
#pragma omp critical(bolide_sph_failure)
        if (own.any)
            note_failure(&failure, own.id, own.index);
    }
    if (sph_axisymmetric(simulation))
        sph_cross_axis(simulation);
    return failure.any ? simulation_impossible(simulation, failure.index) : NULL;
}
