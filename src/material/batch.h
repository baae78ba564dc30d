/* A step of many points of one material at once, in lanes: that of material_step or
 * material_step_by_work point by point, to the last bit, for the materials of which there are many.
 * For files that are compiled once an instruction set: a loop here is one over the points of a
 * batch, and has no branch that a point decides. */
#ifndef BOLIDE_BATCH_H
#define BOLIDE_BATCH_H

#include "material/material.h"

/* Whether batches can take the material. */
BOLIDE_INLINE bool batch_takes(const struct material *material)
{
    return !material_burns(material) && !eos_history(&material->eos) &&
           (!material_fails(material) || failure_traits(&material->failure).batched) &&
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

/* The densities at which the equation of state sees the points of a batch, and the least pressure
 * that they have there. */
struct batch_matter {
    double density[BATCH], least[BATCH];
    double added[BATCH]; /* to its pressure, by bulking; -0: nothing, to the last bit */
};

/* The pressure of point K as it is, from that of the equation of state. */
BOLIDE_INLINE double batch_pressure(const struct batch_matter *matter, int k, double pressure)
{
    return maximum(pressure + matter->added[k], matter->least[k]);
}

/* The equation of state of point K at ENERGY. */
BOLIDE_INLINE struct eos_value batch_value(const struct eos *eos, const struct batch_matter *matter,
                                           int k, double energy)
{
    const double none[POINT_HISTORY] = {0.0};
    struct eos_value value = eos_evaluate(eos, matter->density[k], energy, none);
    value.pressure = batch_pressure(matter, k, value.pressure);
    return value;
}

/* Point K, whose energy is ENERGY, or that but for the work of the new pressure. */
BOLIDE_INLINE void batch_finish(const struct material *material, struct batch *b,
                                const struct batch_matter *matter, int k, double energy,
                                enum batch_energy from)
{
    const struct eos *eos = &material->eos;
    struct eos_value value = batch_value(eos, matter, k, energy);
    b->energy[k] = energy;
    if (from == ENERGY_BY_WORK) {
        b->energy[k] += material_work_of_pressure(b->density[k], b->new_density[k], &value);
        value = batch_value(eos, matter, k, b->energy[k]);
    }
    b->pressure[k] = value.pressure;
    const double modulus = material_shear_modulus(material, matter->density[k], b->energy[k]);
    b->sound_long[k] = material_response(&value, matter->density[k], modulus, 0.0).sound_long;
}

/* Energies, where they are not given, and pressures after the step. The loop evaluates the form of
 * the source, which has no branches; the few points beyond it, or that have melted, are done once
 * more. */
BOLIDE_INLINE void batch_energies(const struct material *material, struct batch *b,
                                  const struct batch_matter *matter, enum batch_energy from)
{
    const double none[POINT_HISTORY] = {0.0};
    const double shear_modulus = strength_shear_modulus(&material->strength);
    double energy[BATCH];
    uint64_t beyond[BATCH], any = 0;
    switch (material->eos.kind) {
#define BATCH_CASE(name)                                                                          \
    case EOS_##name:                                                                              \
        for (int k = 0; k < b->count; k++) {                                                      \
            const struct eos_##name *eos = &material->eos.of.name;                                \
            const double density = matter->density[k];                                            \
            energy[k] = b->energy[k];                                                             \
            struct eos_value value = eos_##name(eos, density, energy[k], none);                   \
            value.pressure = batch_pressure(matter, k, value.pressure);                           \
            beyond[k] = value.status & POINT_BEYOND;                                              \
            if (from == ENERGY_BY_WORK) {                                                         \
                b->energy[k] +=                                                                   \
                    material_work_of_pressure(b->density[k], b->new_density[k], &value);          \
                value = eos_##name(eos, density, b->energy[k], none);                             \
                value.pressure = batch_pressure(matter, k, value.pressure);                       \
            }                                                                                     \
            b->pressure[k] = value.pressure;                                                      \
            b->sound_long[k] = material_response(&value, density, shear_modulus, 0.0).sound_long; \
            beyond[k] |= (value.status & POINT_BEYOND) |                                          \
                         melting_begins(&material->melting, density, b->energy[k]);               \
            any |= beyond[k];                                                                     \
        }                                                                                         \
        break;
        EOS_STATELESS(BATCH_CASE)
#undef BATCH_CASE
    default:
        break;
    }
    for (int k = 0; any && k < b->count; k++)
        if (beyond[k])
            batch_finish(material, b, matter, k, energy[k], from);
}

/* Pressures at the densities of MATTER and the energies before the work of the step. */
BOLIDE_INLINE void batch_trial(const struct eos *of, const struct batch *b,
                               const struct batch_matter *matter, double *pressure)
{
    const double none[POINT_HISTORY] = {0.0};
    uint64_t beyond[BATCH], any = 0;
    switch (of->kind) {
#define BATCH_CASE(name)                                                          \
    case EOS_##name:                                                              \
        for (int k = 0; k < b->count; k++) {                                      \
            const struct eos_value value =                                        \
                eos_##name(&of->of.name, matter->density[k], b->energy[k], none); \
            pressure[k] = value.pressure;                                         \
            beyond[k] = value.status & POINT_BEYOND;                              \
            any |= beyond[k];                                                     \
        }                                                                         \
        break;
        EOS_STATELESS(BATCH_CASE)
#undef BATCH_CASE
    default:
        break;
    }
    for (int k = 0; any && k < b->count; k++)
        if (beyond[k])
            pressure[k] = eos_evaluate(of, matter->density[k], b->energy[k], none).pressure;
}

/* Point K of a batch, which has failed, as material_fail leaves it. */
BOLIDE_INLINE void batch_leave_rubble(const struct material *material, struct batch *b,
                                      struct batch_matter *matter, int k)
{
    struct point point = {.density = matter->density[k],
                          .energy = b->energy[k],
                          .deviator = batch_tensor(b->new_deviator, k)};
    for (int slot = 0; slot < POINT_HISTORY; slot++)
        point.history[slot] = 0.0;
    point.history[HISTORY_damage] = b->damage[k];
    material_leave_rubble(material, &point);
    b->void_ratio[k] = point.history[HISTORY_void_ratio];
    batch_keep_tensor(b->new_deviator, k, point.deviator);
    matter->density[k] = point.density;
    matter->least[k] = 0.0;
}

/* The points of a batch wait for the edge of the tension to stand, as material_wait has it. */
BOLIDE_INLINE void batch_wait(const struct material *material, struct batch *b,
                              const struct batch_matter *matter)
{
    for (int k = 0; k < b->count; k++) {
        struct motion motion = batch_motion(b, k);
        struct point point = {.density = matter->density[k],
                              .energy = b->energy[k],
                              .deviator = batch_tensor(b->new_deviator, k)};
        if (b->damage[k] >= 1.0)
            continue;
        motion.acceleration =
            vec3_make(b->acceleration[0][k], b->acceleration[1][k], b->acceleration[2][k]);
        for (int slot = 0; slot < POINT_HISTORY; slot++)
            point.history[slot] = 0.0;
        point.history[HISTORY_strength_scatter] = b->scatter[k];
        point.history[HISTORY_damage] = b->damage[k];
        point.history[HISTORY_overload] = b->overload[k];
        const struct eos_value value = material_pressure(material, &point);
        material_wait(material, &motion, &value, &point);
        b->overload[k] = point.history[HISTORY_overload];
        b->damage[k] = point.history[HISTORY_damage];
    }
}

/* Voids grow in the points of a batch, as material_grow_voids has it, at the pressures TRIAL. */
BOLIDE_INLINE void batch_grow_voids(const struct material *material,
                                    const struct void_growth *growth, const double *trial,
                                    struct batch *b, struct batch_matter *matter)
{
    for (int k = 0; k < b->count; k++) {
        struct point point = {.density = matter->density[k], .energy = b->energy[k]};
        if (b->damage[k] >= 1.0)
            continue;
        b->void_ratio[k] = 0.0;
        if (!(-trial[k] > growth->strength * (1.0 + b->scatter[k]) * (1.0 - b->damage[k])))
            continue;
        for (int slot = 0; slot < POINT_HISTORY; slot++)
            point.history[slot] = 0.0;
        point.history[HISTORY_strength_scatter] = b->scatter[k];
        point.history[HISTORY_damage] = b->damage[k];
        material_grow_voids(material, growth, trial[k], &point);
        b->damage[k] = point.history[HISTORY_damage];
        b->void_ratio[k] = point.history[HISTORY_void_ratio];
        matter->density[k] = point.density;
    }
}

/* The failure model, after the strength; STRAIN is the plastic strain before. */
BOLIDE_INLINE void batch_fail(const struct material *material, struct batch *b,
                              const double *strain, struct batch_matter *matter)
{
    double pressure[BATCH], damage[BATCH], homologous[BATCH];
    uint64_t failed = 0;
    for (int k = 0; k < b->count; k++)
        matter->density[k] = b->new_density[k] / (1.0 + b->void_ratio[k]);
    batch_trial(&material->eos, b, matter, pressure);
    strength_batch_homologous(&material->strength, b, homologous);
    switch (material->failure.kind) {
#define BATCH_CASE(name)                                                                          \
    case FAILURE_##name:                                                                          \
        for (int k = 0; k < b->count; k++) {                                                      \
            const struct motion motion = batch_motion(b, k);                                      \
            const struct point point = {.density = matter->density[k],                            \
                                        .deviator = batch_tensor(b->new_deviator, k)};            \
            struct failing failing =                                                              \
                material_failing(&motion, &point, b->plastic_strain[k] - strain[k], pressure[k]); \
            failing.strain = b->plastic_strain[k];                                                \
            failing.relative = 1.0 + b->scatter[k];                                               \
            failing.homologous = homologous[k];                                                   \
            damage[k] = failure_##name(&material->failure.of.name, &failing, b->damage[k]);       \
        }                                                                                         \
        break;
        FAILURE_LIST(BATCH_CASE)
#undef BATCH_CASE
    default:
        break;
    }
    for (int k = 0; k < b->count; k++) {
        b->damage[k] = b->damage[k] < 1.0 ? minimum(damage[k], 1.0) : b->damage[k];
    }
    const struct void_growth growth = failure_traits(&material->failure).growth;
    if (growth.most > 0.0)
        batch_grow_voids(material, &growth, pressure, b, matter);
    if (failure_waits(&material->failure))
        batch_wait(material, b, matter);
    for (int k = 0; k < b->count; k++)
        failed |= b->damage[k] >= 1.0;
    for (int k = 0; failed && k < b->count; k++)
        if (b->damage[k] >= 1.0)
            batch_leave_rubble(material, b, matter, k);
}

/* What strength adds to the PRESSURE of the equation of state, and what it cuts of it. */
BOLIDE_INLINE void batch_cut(const struct strength *strength, const struct batch *b,
                             double *pressure)
{
    switch (strength->kind) {
#define BATCH_CASE(name)                                                \
    case STRENGTH_##name:                                               \
        for (int k = 0; k < b->count; k++) {                            \
            double history[POINT_HISTORY] = {0.0};                      \
            struct eos_value value = {pressure[k], 0.0, 0.0, 0};        \
            history[HISTORY_damage] = b->damage[k];                     \
            history[HISTORY_bulking] = b->bulking[k];                   \
            strength_##name##_cut(&strength->of.name, history, &value); \
            pressure[k] = value.pressure;                               \
        }                                                               \
        break;
        STRENGTH_CUTTING(BATCH_CASE)
#undef BATCH_CASE
    default:
        break;
    }
}

/* Point K, which fails, through the step of its strength. */
BOLIDE_INLINE void batch_fail_pressed(const struct material *material, struct batch *b,
                                      const struct batch_matter *matter, int k)
{
    const struct motion motion = batch_motion(b, k);
    struct point point = {.density = matter->density[k],
                          .energy = b->energy[k],
                          .deviator = batch_tensor(b->deviator, k)};
    point.history[HISTORY_damage] = b->damage[k];
    point.history[HISTORY_bulking] = b->bulking[k];
    point.history[HISTORY_plastic_strain] = b->plastic_strain[k];
    const struct eos_value trial = material_pressure(material, &point);
    point.pressure = trial.pressure;
    strength_step(&material->strength, &motion, material_bulk_modulus(&point, &trial), &point);
    b->damage[k] = point.history[HISTORY_damage];
    b->bulking[k] = point.history[HISTORY_bulking];
    b->plastic_strain[k] = point.history[HISTORY_plastic_strain];
    batch_keep_tensor(b->new_deviator, k, point.deviator);
}

/* The strength that takes the pressure. Where it has broken, voids open or close. */
BOLIDE_INLINE void batch_pressed(const struct material *material, struct batch *b,
                                 struct batch_matter *matter)
{
    const bool opens = material_opens(material);
    double whole[BATCH];
    for (int k = 0; k < b->count; k++)
        matter->density[k] = b->new_density[k] / (opens ? 1.0 + b->void_ratio[k] : 1.0);
    batch_trial(&material->eos, b, matter, whole);
    memcpy(b->trial, whole, sizeof whole);
    batch_cut(&material->strength, b, b->trial);
    strength_batch(&material->strength, b);
    for (int k = 0; k < b->count; k++) {
        if (b->failing[k])
            batch_fail_pressed(material, b, matter, k);
        matter->added[k] = b->bulking[k];
        matter->least[k] = -(double)INFINITY;
        if (!(opens && b->damage[k] >= 1.0))
            continue;
        b->void_ratio[k] = 0.0;
        if (!(whole[k] + b->bulking[k] < 0.0))
            continue;
        struct point point = {.density = matter->density[k], .energy = b->energy[k]};
        point.history[HISTORY_bulking] = b->bulking[k];
        material_open(material, &point);
        b->void_ratio[k] = point.history[HISTORY_void_ratio];
        matter->density[k] = point.density;
    }
    batch_cut(&material->strength, b, matter->least);
}

/* Point K, of whose strength LEFT remains, from its plastic STRAIN and HEATING before the step. */
BOLIDE_INLINE void batch_melt(const struct material *material, struct batch *b, double left,
                              double strain, double heating, int k)
{
    const struct motion motion = batch_motion(b, k);
    struct point point = {.density = b->new_density[k], .deviator = batch_tensor(b->deviator, k)};
    for (int slot = 0; slot < POINT_HISTORY; slot++)
        point.history[slot] = 0.0;
    point.history[HISTORY_plastic_strain] = strain;
    point.history[HISTORY_plastic_heating] = heating;
    point.history[HISTORY_damage] = b->damage[k];
    melting_step(&material->strength, left, &motion, &point);
    b->plastic_strain[k] = point.history[HISTORY_plastic_strain];
    b->plastic_heating[k] = point.history[HISTORY_plastic_heating];
    batch_keep_tensor(b->new_deviator, k, point.deviator);
}

/* The strength that leaves the pressure as it is. The few points that have melted are done once
 * more. */
BOLIDE_INLINE void batch_strength(const struct material *material, struct batch *b)
{
    const bool opens = material_opens(material);
    double density[BATCH], strain[BATCH], heating[BATCH];
    uint64_t any = 0;
    for (int k = 0; k < b->count; k++) {
        density[k] = b->new_density[k] / (opens ? 1.0 + b->void_ratio[k] : 1.0);
        any |= melting_begins(&material->melting, density[k], b->energy[k]);
    }
    if (any) {
        memcpy(strain, b->plastic_strain, sizeof strain);
        memcpy(heating, b->plastic_heating, sizeof heating);
    }
    strength_batch(&material->strength, b);
    for (int k = 0; any && k < b->count; k++) {
        const double left = melting_left(&material->melting, density[k], b->energy[k]);
        if (left < 1.0)
            batch_melt(material, b, left, strain[k], heating[k], k);
    }
}

/* Takes the points of a batch through the step: strength, failure, work, pressure. */
BOLIDE_INLINE void batch_step(const struct material *material, struct batch *b,
                              enum batch_energy from)
{
    const bool fails = material_fails(material);
    struct batch_matter matter;
    double strain[BATCH];
    if (fails)
        memcpy(strain, b->plastic_strain, sizeof strain);
    if (strength_takes_pressure(&material->strength)) {
        batch_pressed(material, b, &matter);
    } else {
        batch_strength(material, b);
        for (int k = 0; k < b->count; k++) {
            matter.density[k] = b->new_density[k];
            matter.least[k] = -(double)INFINITY;
            matter.added[k] = -0.0;
        }
    }
    if (fails)
        batch_fail(material, b, strain, &matter);
    if (from == ENERGY_BY_WORK)
        batch_work(b);
    batch_energies(material, b, &matter, from);
    if (material_opens(material))
        memcpy(b->new_density, matter.density, sizeof b->new_density);
}

#endif
