/* A step of many points of one material at once, in lanes: material_step_by_work point by point, to the last bit, for the
 * materials of which there are many. For files that are compiled once an instruction set: a loop here is one over the
 * points of a batch, and has no branch that a point decides. */
#ifndef BOLIDE_BATCH_H
#define BOLIDE_BATCH_H

#include "material/material.h"

/* Whether batches can take the material. */
BOLIDE_INLINE bool batch_takes(const struct material *material)
{
    return !material_burns(material) && !material_fails(material) && !eos_history(&material->eos) &&
           (!material_has_strength(material) || strength_traits(&material->strength).batched);
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

/* Point K, whose energy is ENERGY but for the work of the new pressure. */
BOLIDE_INLINE void batch_finish(const struct eos *eos, struct batch *b, int k, double energy,
                                double shear_modulus)
{
    const double density = b->new_density[k], none[POINT_HISTORY] = {0.0};
    struct eos_value value = eos_evaluate(eos, density, energy, none);
    b->energy[k] = energy + material_work_of_pressure(b->density[k], density, &value);
    value = eos_evaluate(eos, density, b->energy[k], none);
    b->pressure[k] = value.pressure;
    b->sound_long[k] = material_response(&value, density, shear_modulus, 0.0).sound_long;
}

/* Takes the points of a batch through the step. The loop evaluates the form of the source, which
 * has no branches; the few points beyond it are done once more. */
BOLIDE_INLINE void batch_step(const struct material *material, struct batch *b)
{
    const double shear_modulus = strength_shear_modulus(&material->strength);
    const double none[POINT_HISTORY] = {0.0};
    double energy[BATCH];
    uint64_t beyond[BATCH], any = 0;
    strength_batch(&material->strength, b);
    batch_work(b);
    switch (material->eos.kind) {
#define BATCH_CASE(name)                                                                          \
    case EOS_##name:                                                                              \
        for (int k = 0; k < b->count; k++) {                                                      \
            const struct eos_##name *eos = &material->eos.of.name;                                \
            const double density = b->new_density[k];                                             \
            energy[k] = b->energy[k];                                                             \
            struct eos_value value = eos_##name(eos, density, energy[k], none);                   \
            b->energy[k] += material_work_of_pressure(b->density[k], density, &value);            \
            value = eos_##name(eos, density, b->energy[k], none);                                 \
            b->pressure[k] = value.pressure;                                                      \
            b->sound_long[k] = material_response(&value, density, shear_modulus, 0.0).sound_long; \
            beyond[k] = value.status & POINT_BEYOND; /* which depends on the density alone */     \
            any |= beyond[k];                                                                     \
        }                                                                                         \
        break;
        EOS_LIST(BATCH_CASE)
#undef BATCH_CASE
    default:
        break;
    }
    for (int k = 0; any && k < b->count; k++)
        if (beyond[k])
            batch_finish(&material->eos, b, k, energy[k], shear_modulus);
}

#endif
