/* The list of exact solutions; see choices.h. */
#include "exact/choices.h"

#include "exact/closed_room.h"
#include "exact/elastic_plastic_impact.h"
#include "exact/elastic_plastic_riemann.h"
#include "exact/failure_wave.h"
#include "exact/gas_expansion.h"
#include "exact/gas_riemann.h"
#include "exact/impedance_match.h"
#include "exact/kingery_bulmash.h"
#include "exact/long_rod.h"
#include "exact/point_explosion.h"
#include "exact/sedov.h"
#include "exact/slab_detonation.h"
#include "exact/temperature_jump.h"
#include "exact/verney.h"
#include "exact/znd.h"

#define EXACT_CHOICE(identifier, name, help)                                    \
    {name, help, exact_##identifier##_table, sizeof(struct exact_##identifier), \
     &exact_##identifier##_class},

const struct choice exact_choices[exact_choice_count] = {EXACT_LIST(EXACT_CHOICE)};
