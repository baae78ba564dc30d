/* What a point remembers beyond density, energy and deviator. A slot means the same in every
 * material; a store has fields for the slots that the materials of its case need. All begin at
 * zero. */
#ifndef BOLIDE_MATERIAL_HISTORY_H
#define BOLIDE_MATERIAL_HISTORY_H

/* X(slot, unit, help): HISTORY_<slot> is its index, <slot> the name of its field. The first is in
 * every store. */
#define HISTORY_LIST(X)                                                                  \
    X(plastic_strain, "", "equivalent plastic strain")                                   \
    X(dilation, "", "volume gained by flow and tearing, relative to the elastic volume") \
    X(largest_compression, "", "largest rho/rho_0 - 1 so far")                           \
    X(damage, "", "damage by crushing or by a failure model; 1: failed")                 \
    X(void_ratio, "", "volume of voids in failed material over that of the material")    \
    X(strength_scatter, "", "strength at failure over the characteristic one, less 1")   \
    X(tensile_damage, "", "damage by tension; 1: broken")                                \
    X(plastic_heating, "K", "temperature rise from a hot start and plastic work")        \
    X(lighting_time, "s", "arrival time of the detonation")                              \
    X(explosive_volume, "", "volume of the unburnt explosive over that at rest")         \
    X(burnt, "", "burnt fraction of the explosive")

#define HISTORY_ENUM(slot, unit, help) HISTORY_##slot,
enum { HISTORY_LIST(HISTORY_ENUM) POINT_HISTORY };
#undef HISTORY_ENUM

/* A set of slots. */
#define HISTORY_BIT(slot) (1u << HISTORY_##slot)

struct history_slot {
    const char *name, *unit, *help;
};
extern const struct history_slot history_slots[POINT_HISTORY];

#endif
