/* Two elastic, perfectly plastic bodies of finite thickness that strike each other in uniaxial
 * strain: their waves meet, and are reflected at free surfaces. The waves are followed one by one:
 * jumps are exact, a fan is cut into pieces of equal strain, and wherever fronts meet a Riemann
 * problem says what leaves. The bodies stick to each other and bear any tension. */
#ifndef BOLIDE_EXACT_ELASTIC_PLASTIC_IMPACT_H
#define BOLIDE_EXACT_ELASTIC_PLASTIC_IMPACT_H

#include "exact/solid_path.h"

struct exact_elastic_plastic_impact {
    struct exact_solid solid[2]; /* by enum exact_side */
    double at;                   /* where they meet */
    double rear[2];              /* the other surface of each, free; NAN: endlessly far */
    double until;                /* s, as long the waves are followed */
};

extern const struct parameter exact_elastic_plastic_impact_table[];
extern const struct exact_class exact_elastic_plastic_impact_class;

#endif
