/* What happens to a particle on its own: the step from level n to n + 1 once its pair sums are known.
 * Source: Parshikov (2013), section 1.5, block 2. */
#include "sph/deform.h"
#include "sph/evaluate.h"
#include "sph/scheme.h"

void sph_evaluate(const struct sph *sph, struct simulation *simulation)
{
    struct sph_fields f = sph_fields_of(sph, simulation);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < simulation->particles.count; i++) {
        if (f.thickness && f.thickness[i] == 0.0) /* fresh */
            f.thickness[i] = 1.0;
        sph_evaluate_point(simulation, &f, i);
        f.diameter[i] = diameter_of_volume(sph_volume(simulation, &f, i), simulation->dimension);
        if (f.support && f.support[i] == 0.0) /* fresh */
            f.support[i] = f.diameter[i];
    }
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

/* A step of DT that ends at TIME; TOTAL: the power is that of E + U^2/2; FINITE: the velocity gradient is that of
 * positions at level n (deform.h). */
struct advance {
    const struct sph_fields *fields;
    int dimension;
    bool total, finite;
    double dt, time;
    const double *gravity;
};

/* Particles begin .. end - 1, all of one material. */
struct run {
    int32_t begin, end;
};

/* Takes a run through the step. MATERIAL's kinds are constants where this is inlined; PLAIN: it remembers no more
 * than its plastic strain. */
BOLIDE_INLINE void update_run(const struct material *material, bool plain, struct particles *p,
                              struct advance step, struct run run, struct failure *failure)
{
    const struct sph_fields *const f = step.fields;
    const int dimension = step.dimension;
    const double dt = step.dt;
    for (int32_t i = run.begin; i < run.end; i++) {
        const double *a = f->rates.acceleration[i], *rate = f->rates.strain_rate[i];
        double *u = p->velocity[i], *x = p->position[i], *s = p->deviator[i];
        double divergence = rate[0] + rate[1] + rate[2], a2 = 0.0;
        for (int axis = 0; axis < dimension; axis++) {
            double next = u[axis] + dt * a[axis];
            /* (1.86), or the kernel mean of contact velocities */
            x[axis] += f->rates.drift && !step.finite ? dt * (u[axis] + f->rates.drift[i][axis])
                                                      : 0.5 * dt * (u[axis] + next);
            if (f->rates.drift && step.finite)
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
        if (step.finite)
            motion.density = p->density[i] / sph_deform(dt, &motion.strain_rate, &motion.spin);
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
                                                  struct particles *p, struct advance step,
                                                  struct run run, struct failure *failure)
{
    update_run(material, false, p, step, run, failure);
}

/* One switch a run: in each branch the kinds of the material are constants. */
static void update_batch(const struct material *material, struct particles *p, struct advance step,
                         struct run run, struct failure *failure)
{
    struct material m = *material;
    if (!material_is_plain(material)) {
        update_rare(material, p, step, run, failure);
        return;
    }
    switch (material->eos.kind) {
#define UPDATE_SOLID(name)                           \
    case STRENGTH_##name:                            \
        m.strength.kind = STRENGTH_##name;           \
        update_run(&m, true, p, step, run, failure); \
        break;
#define UPDATE_CASE(name)                                \
    case EOS_##name:                                     \
        m.eos.kind = EOS_##name;                         \
        switch (material->strength.kind) {               \
            STRENGTH_PLAIN(UPDATE_SOLID)                 \
        default:                                         \
            m.strength.kind = STRENGTH_NONE;             \
            update_run(&m, true, p, step, run, failure); \
        }                                                \
        break;
        EOS_LIST(UPDATE_CASE)
#undef UPDATE_CASE
#undef UPDATE_SOLID
    default:
        break;
    }
}

static void update_block(struct simulation *simulation, struct advance step,
                         const struct block *block, struct failure *failure)
{
    struct particles *p = &simulation->particles;
    const int32_t end = block->first + block->count;
    for (int32_t begin = block->first, next; begin < end; begin = next) {
        uint16_t material = p->material[begin];
        for (next = begin + 1; next < end && p->material[next] == material;)
            next++;
        update_batch(&simulation->material[material], p, step, (struct run){begin, next}, failure);
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

struct error *sph_update(const struct sph *sph, struct simulation *simulation,
                         const struct sph_fields *fields, double dt)
{
    if (fields->rates.wall)
        sph_book_walls(simulation, fields, dt);
    sph_hold_bodies(simulation, fields, dt);
    struct failure failure = {false, 0, 0};
    if (sph_has(sph, SPH_STILL)) {
        update_heat(sph, simulation, fields, dt, &failure);
        return failure.any ? simulation_impossible(simulation, failure.index) : NULL;
    }
    sph_add_gravity(simulation, fields, dt, 0.5 * dt);
    const struct advance step = {.fields = fields,
                                 .dimension = simulation->dimension,
                                 .total = sph_has(sph, SPH_TOTAL_ENERGY),
                                 .finite = sph_has(sph, SPH_FINITE_STRAIN),
                                 .dt = dt,
                                 .time = simulation->time + dt,
                                 .gravity = simulation->gravity};
#pragma omp parallel num_threads(simulation->threads)
    {
        struct failure own = {false, 0, 0};
#pragma omp for schedule(dynamic)
        for (int32_t b = 0; b < simulation->particles.blocks; b++)
            update_block(simulation, step, &simulation->particles.block[b], &own);
#pragma omp critical(bolide_sph_failure)
        if (own.any)
            note_failure(&failure, own.id, own.index);
    }
    if (sph_axisymmetric(simulation))
        sph_cross_axis(simulation);
    return failure.any ? simulation_impossible(simulation, failure.index) : NULL;
}
