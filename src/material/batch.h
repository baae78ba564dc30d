/* A step of many points of one material at once, in lanes: material_step_by_work point by point, to the last bit, for the
 * materials of which there are many. For files that are compiled once an instruction set: a loop here is one over the
 * points of a batch, and has no branch that a point decides. */
#ifndef BOLIDE_BATCH_H
#define BOLIDE_BATCH_H

#include <string.h>

#include "base/lanes.h"
#include "material/material.h"

enum { BATCH = 64 };

/* Points before and after a step, and what the step does to them; see struct point and struct motion. COUNT is a multiple
 * of LANES; what fills it up must only be some point. */
struct batch {
    int count;
    double dt;
    double density[BATCH], new_density[BATCH], energy[BATCH], pressure[BATCH],
        viscous_pressure[BATCH];
    double strain_rate[6][BATCH], spin[3][BATCH], deviator[6][BATCH], new_deviator[6][BATCH];
    double plastic_strain[BATCH], plastic_heating[BATCH];
    double sound_long[BATCH]; /* after; zero: there is none */
};

/* Whether batches know the material. */
BOLIDE_INLINE bool batch_takes(const struct material *material)
{
    const struct strength *strength = &material->strength;
    return material_is_plain(material) ||
           (strength->kind == STRENGTH_johnson_cook &&
            strength->of.johnson_cook.return_map == JOHNSON_COOK_IMPLICIT &&
            material->eos.kind != EOS_hjc && !material_burns(material));
}

BOLIDE_INLINE struct sym3 batch_tensor(const double (*of)[BATCH], int k)
{
    struct sym3 s = {of[0][k], of[1][k], of[2][k], of[3][k], of[4][k], of[5][k]};
    return s;
}

BOLIDE_INLINE void batch_keep_tensor(double (*of)[BATCH], int k, struct sym3 s)
{
    of[0][k] = s.xx;
    of[1][k] = s.yy;
    of[2][k] = s.zz;
    of[3][k] = s.xy;
    of[4][k] = s.yz;
    of[5][k] = s.zx;
}

BOLIDE_INLINE struct motion batch_motion(const struct batch *b, int k)
{
    struct motion motion = {.dt = b->dt,
                            .density = b->new_density[k],
                            .strain_rate = batch_tensor(b->strain_rate, k),
                            .spin = vec3_make(b->spin[0][k], b->spin[1][k], b->spin[2][k]),
                            .viscous_pressure = b->viscous_pressure[k]};
    return motion;
}

BOLIDE_INLINE void batch_perfect_plastic(const struct strength_perfect_plastic *solid,
                                         struct batch *b)
{
    for (int k = 0; k < b->count; k++) {
        struct motion motion = batch_motion(b, k);
        struct point point = {.deviator = batch_tensor(b->deviator, k),
                              .history = {b->plastic_strain[k]}};
        strength_perfect_plastic(solid, &motion, 0.0, &point);
        batch_keep_tensor(b->new_deviator, k, point.deviator);
        b->plastic_strain[k] = point.history[HISTORY_plastic_strain];
    }
}

/* What points flow that flow at all: those are put side by side. */
BOLIDE_INLINE void batch_flow(const struct strength_johnson_cook *solid, const struct batch *b,
                              const double *trial, const double *slow, const double *softening,
                              double *flow)
{
    int flowing[BATCH + LANES], count = 0;
    for (int k = 0; k < b->count; k++) {
        flowing[count] = k;
        count += trial[k] > slow[k];
    }
    for (int lane = 0; lane < LANES; lane++)
        flowing[count + lane] = flowing[count > 0 ? count - 1 : 0];
    for (int first = 0; first < count; first += LANES) {
        const int *at = flowing + first;
        struct johnson_cook_points p;
        for (int lane = 0; lane < LANES; lane++) {
            p.trial[lane] = trial[at[lane]];
            p.strain[lane] = b->plastic_strain[at[lane]];
            p.slow[lane] = slow[at[lane]];
            p.softening[lane] = softening[at[lane]];
        }
        johnson_cook_flow(solid, LANES, b->dt, &p);
        for (int lane = 0; lane < LANES; lane++)
            flow[at[lane]] = p.flow[lane];
    }
}

BOLIDE_INLINE void batch_johnson_cook(const struct strength_johnson_cook *solid, struct batch *b)
{
    double trial[BATCH], slow[BATCH], softening[BATCH], flow[BATCH];
    const bool softens = johnson_cook_softens(solid);
    for (int k = 0; k < b->count; k++) {
        const struct motion motion = batch_motion(b, k);
        const struct sym3 s =
            strength_elastic(solid->shear_modulus, &motion, batch_tensor(b->deviator, k));
        batch_keep_tensor(b->new_deviator, k, s);
        trial[k] = sym3_mises(s);
        softening[k] = 1.0;
        flow[k] = 0.0;
    }
    if (softens)
        for (int k = 0; k < b->count; k++)
            softening[k] = johnson_cook_softening(solid, b->plastic_heating[k]);
    for (int k = 0; k < b->count; k++)
        slow[k] = johnson_cook_slow(solid, b->plastic_strain[k], softening[k]);
    batch_flow(solid, b, trial, slow, softening, flow);
    for (int k = 0; k < b->count; k++) {
        const double stress = trial[k] - 3.0 * solid->shear_modulus * flow[k];
        const double share = flow[k] > 0.0 ? stress / trial[k] : 1.0;
        batch_keep_tensor(b->new_deviator, k, sym3_scale(share, batch_tensor(b->new_deviator, k)));
        b->plastic_strain[k] += flow[k];
        if (softens)
            b->plastic_heating[k] += stress * flow[k] / (b->new_density[k] * solid->capacity);
    }
}

/* The work of a step but for what the new pressure does. */
BOLIDE_INLINE void batch_work(struct batch *b)
{
    for (int k = 0; k < b->count; k++) {
        const struct motion motion = batch_motion(b, k);
        const struct point point = {.density = b->density[k],
                                    .pressure = b->pressure[k],
                                    .deviator = batch_tensor(b->deviator, k)};
        b->energy[k] += material_work(&point, &motion, batch_tensor(b->new_deviator, k));
    }
}

/* Takes the points of a batch through the step. */
BOLIDE_INLINE void batch_step(const struct material *material, struct batch *b)
{
    const double shear_modulus = strength_shear_modulus(&material->strength);
    const double none[POINT_HISTORY] = {0.0};
    switch (material->strength.kind) {
    case STRENGTH_perfect_plastic:
        batch_perfect_plastic(&material->strength.of.perfect_plastic, b);
        break;
    case STRENGTH_johnson_cook:
        batch_johnson_cook(&material->strength.of.johnson_cook, b);
        break;
    default:
        memcpy(b->new_deviator, b->deviator, sizeof b->deviator);
    }
    batch_work(b);
    switch (material->eos.kind) {
#define BATCH_CASE(name)                                                                          \
    case EOS_##name:                                                                              \
        for (int k = 0; k < b->count; k++) {                                                      \
            const struct eos_##name *eos = &material->eos.of.name;                                \
            const double density = b->new_density[k];                                             \
            struct eos_value value = eos_##name(eos, density, b->energy[k], none);                \
            b->energy[k] += material_work_of_pressure(b->density[k], density, &value);            \
            value = eos_##name(eos, density, b->energy[k], none);                                 \
            b->pressure[k] = value.pressure;                                                      \
            b->sound_long[k] = material_response(&value, density, shear_modulus, 0.0).sound_long; \
        }                                                                                         \
        break;
        EOS_LIST(BATCH_CASE)
#undef BATCH_CASE
    default:
        break;
    }
}

#endif
