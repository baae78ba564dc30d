/* A step of many points of one material at once, in lanes: material_step_by_work point by point, to the last bit, for the
 * materials of which there are many. For files that are compiled once an instruction set: a loop here is one over the
 * points of a batch, and has no branch that a point decides. */
#ifndef BOLIDE_BATCH_H
#define BOLIDE_BATCH_H

#include "material/material.h"

/* Whether batches can take the material. */
BOLIDE_INLINE bool batch_takes(const struct material *material)
{
    return !material_burns(material) && !eos_history(&material->eos) &&
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

/* Takes the points of a batch through the step. */
BOLIDE_INLINE void batch_step(const struct material *material, struct batch *b)
{
    const double shear_modulus = strength_shear_modulus(&material->strength);
    const double none[POINT_HISTORY] = {0.0};
    strength_batch(&material->strength, b);
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
