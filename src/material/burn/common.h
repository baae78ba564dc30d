/* What the headers of the burn models have in common: what the fraction burnt and its rate depend
 * on, and the traits that others ask of a model. */
#ifndef BOLIDE_BURN_COMMON_H
#define BOLIDE_BURN_COMMON_H

#include "base/exponential.h"
#include "material/point.h"

/* An explosive that burns at a rate. Volumes are over that of the explosive at rest. */
struct reacting {
    double burnt;            /* mass fraction of the products */
    double pressure;         /* Pa */
    double volume;           /* of the mixture */
    double explosive_volume; /* of the part that has not burnt, where the phases have volumes */
};

/* The number of fractions burnt at which terms of a rate end, at most. */
enum { BURN_ENDS = 3 };

struct burn_traits {
    bool kinetic;    /* it burns by itself, where it is compressed; others are lit */
    bool by_time;    /* the time since it was lit alone decides the fraction burnt */
    bool phases;     /* it needs the volume of the explosive apart from that of the products */
    double pressure; /* p_CJ, Pa, of its detonation; NAN: its parameters do not say */
};

/* The traits of a model that says no more. */
BOLIDE_INLINE struct burn_traits burn_default_traits(void)
{
    struct burn_traits traits = {false, false, false, NAN};
    return traits;
}

#endif
