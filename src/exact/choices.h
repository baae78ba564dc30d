/* The list of exact solutions, kind "exact" of the catalogue. The thing of a choice is its struct
 * exact_class. To add one: its header and file, and its line in the list below. */
#ifndef BOLIDE_EXACT_CHOICES_H
#define BOLIDE_EXACT_CHOICES_H

#include "base/parameter.h"

/* X(identifier, name, help): struct exact_<identifier>, exact_<identifier>_table,
 * exact_<identifier>_class of exact/<identifier>.h. */
#define EXACT_LIST(X)                                                                             \
    X(gas_riemann, "gas-riemann",                                                                 \
      "two ideal gases that meet at a plane: shocks and expansion fans")                          \
    X(elastic_plastic_riemann, "elastic-plastic-riemann",                                         \
      "two perfectly plastic solids that meet at a plane: elastic and plastic waves")             \
    X(elastic_plastic_impact, "elastic-plastic-impact",                                           \
      "two perfectly plastic plates that collide: waves interact and reflect at free surfaces")   \
    X(impedance_match, "impedance-match",                                                         \
      "planar impact of two materials with linear shock relations")                               \
    X(sedov, "sedov", "a strong blast in a gas from a point, a line or a plane")                  \
    X(point_explosion, "point-explosion",                                                         \
      "a blast in an ideal gas from a point, a line or a plane as it weakens: its front")         \
    X(kingery_bulmash, "kingery-bulmash",                                                         \
      "the blast of TNT in air, free or on the ground: curves through measurements")              \
    X(closed_room, "closed-room",                                                                 \
      "the gas of a closed room in which an explosive has burnt, in chemical equilibrium")        \
    X(gas_expansion, "gas-expansion",                                                             \
      "homogeneous expansion of a slab, cylinder or ball of gas into a vacuum")                   \
    X(slab_detonation, "slab-detonation",                                                         \
      "a slab of explosive ignited at a rigid wall: the front and the rarefaction after it")      \
    X(znd, "znd", "a steady detonation with its reaction zone (Zeldovich, von Neumann, Doering)") \
    X(verney, "verney", "a thick plastic cylinder that collapses until it stops")                 \
    X(failure_wave, "failure-wave",                                                               \
      "glass that runs into a rigid wall: the elastic wave and a failure wave behind it")         \
    X(long_rod, "long-rod", "a long rod that erodes in a thick target, Alekseevskii-Tate")        \
    X(temperature_jump, "temperature-jump",                                                       \
      "heat conduction between two bodies of different temperature, in an infinite or an "        \
      "insulated rod")

#define EXACT_COUNT_ONE(identifier, name, help) +1
enum { exact_choice_count = 0 EXACT_LIST(EXACT_COUNT_ONE) };
#undef EXACT_COUNT_ONE

extern const struct choice exact_choices[exact_choice_count];

#endif
