/* The step of particles for one instruction set, named by BOLIDE_ISA; see point_kernel.h. */
#include "mpm/point_kernel.h"

#include "base/isa.h"
#include "base/lanes.h"
#include "material/batch.h"

/* COUNT particles at LIST and RATE become a batch; what is behind the last one is that one again, with other rates. */
INLINE void load(const struct point_loop *loop, const int32_t *list, const double *rate, int count,
                 struct batch *b)
{
    b->dt = loop->dt;
    b->count = (count + LANES - 1) / LANES * LANES;
    for (int c = 0; c < 9; c++)
        memcpy(c < 6 ? b->strain_rate[c] : b->spin[c - 6], rate + (size_t)c * loop->rate_stride,
               (size_t)b->count * sizeof *rate);
    for (int k = 0; k < b->count; k++) {
        const int32_t i = list[k < count ? k : count - 1];
        for (int c = 0; c < 6; c++)
            b->deviator[c][k] = loop->deviator[i][c];
        b->density[k] = loop->density[i];
        b->energy[k] = loop->energy[i];
        b->pressure[k] = loop->pressure[i];
        b->plastic_strain[k] = loop->plastic_strain[i];
        b->plastic_heating[k] = loop->plastic_heating ? loop->plastic_heating[i] : 0.0;
        b->viscous_pressure[k] = loop->viscosity[i];
        b->sound_long[k] = loop->sound[i];
    }
}

/* What the rates do to density and viscosity; the new one goes to VISCOSITY. */
INLINE void start(const struct point_loop *loop, struct batch *b, double *viscosity)
{
    for (int k = 0; k < b->count; k++) {
        const double divergence =
            b->strain_rate[0][k] + b->strain_rate[1][k] + b->strain_rate[2][k];
        b->new_density[k] = b->density[k] / (1.0 + b->dt * divergence); /* (2-20) */
        viscosity[k] = point_viscosity(loop, b->new_density[k], b->sound_long[k], divergence);
        b->viscous_pressure[k] = 0.5 * (b->viscous_pressure[k] + viscosity[k]);
    }
    if (!loop->jaumann)
        return;
    for (int k = 0; k < b->count; k++) {
        const struct vec3 angle =
            vec3_make(b->dt * b->spin[0][k], b->dt * b->spin[1][k], b->dt * b->spin[2][k]);
        batch_keep_tensor(b->deviator, k, jaumann_turn(batch_tensor(b->deviator, k), angle));
        for (int c = 0; c < 3; c++)
            b->spin[c][k] = 0.0;
    }
}

INLINE bool keep(const struct point_loop *loop, const int32_t *list, int count,
                 const struct batch *b, const double *viscosity)
{
    int64_t wrong = 0;
    double zero = 0.0; /* unless a place or velocity is not finite */
    for (int k = 0; k < b->count; k++) {
        const double all = b->energy[k] + b->pressure[k] + b->new_density[k];
        wrong += !(minimum(b->new_density[k], b->sound_long[k]) > 0.0 * all);
    }
    for (int k = 0; k < count; k++) {
        const int32_t i = list[k];
        const double *x = loop->position[i], *u = loop->velocity[i];
        double *s = loop->deviator[i];
        for (int c = 0; c < 6; c++)
            s[c] = b->new_deviator[c][k];
        loop->density[i] = b->new_density[k];
        loop->energy[i] = b->energy[k];
        loop->pressure[i] = b->pressure[k];
        loop->plastic_strain[i] = b->plastic_strain[k];
        if (loop->plastic_heating)
            loop->plastic_heating[i] = b->plastic_heating[k];
        loop->viscosity[i] = viscosity[k];
        loop->sound[i] = b->sound_long[k];
        zero += 0.0 * ((x[0] + x[1]) + (x[2] + u[0]) + (u[1] + u[2]));
    }
    return !wrong && zero == 0.0;
}

ISA_KERNEL(bool, point_loop_run, const struct point_loop *loop, const struct material *material,
           const int32_t *list, int32_t begin, int32_t end)
{
    bool possible = true;
    for (int32_t first = begin; first < end; first += BATCH) {
        const int count = end - first < BATCH ? end - first : BATCH;
        struct batch batch;
        double viscosity[BATCH];
        load(loop, list + first, loop->rate + first, count, &batch);
        start(loop, &batch, viscosity);
        batch_step(material, &batch);
        possible &= keep(loop, list + first, count, &batch, viscosity);
    }
    return possible;
}
