/* What the headers of the strength models have in common: the traits that others ask of a model,
 * with a default for what a model does not have, and many points of one material side by side. */
#ifndef BOLIDE_STRENGTH_COMMON_H
#define BOLIDE_STRENGTH_COMMON_H

#include <string.h>

#include "base/lanes.h"
#include "material/strength/elastic.h"

struct strength_traits {
    /* The history that it needs beside the plastic strain: a sum of HISTORY_BIT. With `dilation`
     * the equation of state sees the density without that volume. */
    unsigned history;
    /* Its step takes the pressure of the elastic trial, and may change it. */
    bool takes_pressure;
    /* It limits the mean tension. */
    bool limits_tension;
    /* It has a step of many points at once. */
    bool batched;
    /* The specific heat by which it computes temperatures, J/(kg K); NAN: it has none. */
    double capacity;
    /* Why its parameters do not go together, and the parameter to name; NULL when they do. */
    const char *wrong, *wrong_key;
};

/* The traits of a model that says no more. */
BOLIDE_INLINE struct strength_traits strength_default_traits(void)
{
    struct strength_traits traits = {0, false, false, false, (double)NAN, NULL, NULL};
    return traits;
}

enum { BATCH = 64 };

/* Points before and after a step, and what the step does to them; see struct point and struct
 * motion. COUNT is a multiple of LANES; what fills it up must only be some point. */
struct batch {
    int count;
    double dt;
    double density[BATCH], new_density[BATCH], energy[BATCH], pressure[BATCH],
        viscous_pressure[BATCH];
    double strain_rate[6][BATCH], spin[3][BATCH], deviator[6][BATCH], new_deviator[6][BATCH];
    double plastic_strain[BATCH], plastic_heating[BATCH];
    double damage[BATCH], void_ratio[BATCH], scatter[BATCH]; /* where the material fails */
    double sound_long[BATCH];                                /* after; zero: there is none */
};

BOLIDE_INLINE struct sym3 batch_tensor(const double (*of)[BATCH], int k)
{
    struct sym3 s = {of[0][k], of[1][k], of[2][k], of[3][k], of[4][k], of[5][k]};
    return s;
}

BOLIDE_INLINE void batch_keep_tensor(double (*of)[BATCH], int k, struct sym3 s)
{
    of[0][k] = s.xx;
    of[1][k] = s.yy;
    of[2][k] = s.zz;
    of[3][k] = s.xy;
    of[4][k] = s.yz;
    of[5][k] = s.zx;
}

BOLIDE_INLINE struct motion batch_motion(const struct batch *b, int k)
{
    struct motion motion = {.dt = b->dt,
                            .density = b->new_density[k],
                            .strain_rate = batch_tensor(b->strain_rate, k),
                            .spin = vec3_make(b->spin[0][k], b->spin[1][k], b->spin[2][k]),
                            .viscous_pressure = b->viscous_pressure[k]};
    return motion;
}

#endif
