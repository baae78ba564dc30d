/* The blast of a charge of TNT at sea level by the curves of Kingery and Bulmash (1984), which are
 * fits to measurements and no solution: they scatter by about 10 % themselves. Numbers and source
 * are in kingery_curves.h, the pressure over time in blast_wave.h. */
#ifndef BOLIDE_EXACT_KINGERY_BULMASH_H
#define BOLIDE_EXACT_KINGERY_BULMASH_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_kingery_bulmash {
    double mass;
    int charge; /* enum kingery_charge */
    bool reflected;
    struct vector_value center;
    double ambient, age, distance; /* distance: NAN: not given */
};

extern const struct parameter exact_kingery_bulmash_table[];
extern const struct exact_class exact_kingery_bulmash_class;

#endif
