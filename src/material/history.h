/* What a point remembers beyond density, energy and deviator. A slot means the same in every
 * material; a store has fields for the slots that the materials of its case need. All begin at
 * zero. */
#ifndef BOLIDE_MATERIAL_HISTORY_H
#define BOLIDE_MATERIAL_HISTORY_H

#include "base/field.h"

/* X(slot, unit, help, range): HISTORY_<slot> is its index, <slot> the name of its field, RANGE what
 * it can be (enum field_kind). The first is in every store. */
#define HISTORY_LIST(X)                                                                      \
    X(plastic_strain, "", "equivalent plastic strain", FIELD_NOT_NEGATIVE)                   \
    X(dilation, "", "volume gained by flow and tearing, relative to the elastic volume", 0)  \
    X(largest_compression, "", "largest rho/rho_0 - 1 so far", FIELD_NOT_NEGATIVE)           \
    X(damage, "", "damage by crushing or by a failure model; 1: failed", FIELD_NOT_NEGATIVE) \
    X(void_ratio, "", "volume of voids in failed material over that of the material", 0)     \
    X(overload, "", "fraction of the time to spall that has passed", FIELD_NOT_NEGATIVE)     \
    X(strength_scatter, "", "strength at failure over the characteristic one, less 1", 0)    \
    X(tensile_damage, "", "damage by tension; 1: broken", FIELD_NOT_NEGATIVE)                \
    X(plastic_heating, "K", "temperature rise from a hot start and plastic work", 0)         \
    X(lighting_time, "s", "arrival time of the detonation", 0)                               \
    X(explosive_volume, "", "volume of the unburnt explosive over that at rest", 0)          \
    X(burnt, "", "burnt fraction of the explosive", FIELD_FRACTION)                          \
    X(bulking, "Pa", "pressure by the bulking of damaged ceramics and glass", 0)             \
    X(yield_before, "Pa", "yield stress of the last step", 0)                                \
    X(deviator_rate_xx, "Pa/s", "rate of deviator.xx in the last step", 0)                   \
    X(deviator_rate_yy, "Pa/s", "rate of deviator.yy in the last step", 0)                   \
    X(deviator_rate_zz, "Pa/s", "rate of deviator.zz in the last step", 0)                   \
    X(deviator_rate_xy, "Pa/s", "rate of deviator.xy in the last step", 0)                   \
    X(deviator_rate_yz, "Pa/s", "rate of deviator.yz in the last step", 0)                   \
    X(deviator_rate_zx, "Pa/s", "rate of deviator.zx in the last step", 0)

#define HISTORY_ENUM(slot, unit, help, range) HISTORY_##slot,
enum { HISTORY_LIST(HISTORY_ENUM) POINT_HISTORY };
#undef HISTORY_ENUM

/* A set of slots. */
#define HISTORY_BIT(slot) (1u << HISTORY_##slot)

struct history_slot {
    const char *name, *unit, *help;
    unsigned range;
};
extern const struct history_slot history_slots[POINT_HISTORY];

#endif
