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
    /* Its damage breaks it: at one, a point has failed. */
    bool breaks;
    /* The speed at which its damage spreads, m/s: the solver supplies the gradient, and damage at
     * the surface. 0: it does not. */
    double spread_speed;
    /* It has a step of many points at once. */
    bool batched;
    /* Damage of a failure model can weaken it. */
    bool weakened;
    /* Heat can melt it, as a metal: see melting.h. */
    bool melts;
    /* The heat from room temperature to melting, J/kg; NAN: it has none. */
    double melting_heat;
    /* The specific heat by which it computes temperatures, J/(kg K); NAN: it has none. */
    double capacity;
    /* Why its parameters do not go together, and the parameter to name; NULL when they do. */
    const char *wrong, *wrong_key;
};

/* The traits of a model that says no more. */
BOLIDE_INLINE struct strength_traits strength_default_traits(void)
{
    struct strength_traits traits = {.melting_heat = (double)NAN, .capacity = (double)NAN};
    return traits;
}

enum { BATCH = 64 };

/* Where the energy of a step comes from: it is known before, or follows from the power of the
 * stress (material_step, material_step_by_work). */
enum batch_energy { ENERGY_GIVEN, ENERGY_BY_WORK };

/* Points before and after a step, and what the step does to them; see struct point and struct
 * motion. COUNT is a multiple of LANES; what fills it up must only be some point. `energy` is that
 * before the step, or where it is given that after it. */
struct batch {
    int count;
    double dt;
    double density[BATCH], new_density[BATCH], energy[BATCH], pressure[BATCH],
        viscous_pressure[BATCH];
    double strain_rate[6][BATCH], spin[3][BATCH], deviator[6][BATCH], new_deviator[6][BATCH];
    double plastic_strain[BATCH], plastic_heating[BATCH];
    double damage[BATCH], void_ratio[BATCH], scatter[BATCH]; /* where the material fails */
    double bulking[BATCH], damage_gradient[BATCH];
    /* after the step, for strength that takes the pressure: at the energy that is known */
    double trial[BATCH];
    uint64_t failing[BATCH]; /* points that it leaves to be taken by themselves */
    double length[BATCH], overload[BATCH], acceleration[3][BATCH]; /* that, too */
    double sound_long[BATCH];                                      /* after; zero: there is none */
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

/* What batches know of the HISTORY of a store, by slot, of its point I. */
BOLIDE_INLINE void batch_load_history(struct batch *b, int k, double *const history[POINT_HISTORY],
                                      int32_t i)
{
    const double *heating = history[HISTORY_plastic_heating], *voids = history[HISTORY_void_ratio],
                 *scatter = history[HISTORY_strength_scatter], *bulking = history[HISTORY_bulking],
                 *overload = history[HISTORY_overload];
    b->plastic_strain[k] = history[HISTORY_plastic_strain][i];
    b->plastic_heating[k] = heating ? heating[i] : 0.0;
    b->damage[k] = history[HISTORY_damage] ? history[HISTORY_damage][i] : 0.0;
    b->bulking[k] = bulking ? bulking[i] : 0.0;
    b->void_ratio[k] = voids ? voids[i] : 0.0;
    b->scatter[k] = scatter ? scatter[i] : 0.0;
    b->overload[k] = overload ? overload[i] : 0.0;
}

BOLIDE_INLINE void batch_keep_history(const struct batch *b, int k,
                                      double *const history[POINT_HISTORY], int32_t i)
{
    history[HISTORY_plastic_strain][i] = b->plastic_strain[k];
    if (history[HISTORY_plastic_heating])
        history[HISTORY_plastic_heating][i] = b->plastic_heating[k];
    if (history[HISTORY_damage])
        history[HISTORY_damage][i] = b->damage[k];
    if (history[HISTORY_void_ratio])
        history[HISTORY_void_ratio][i] = b->void_ratio[k];
    if (history[HISTORY_overload])
        history[HISTORY_overload][i] = b->overload[k];
    if (history[HISTORY_bulking])
        history[HISTORY_bulking][i] = b->bulking[k];
}

BOLIDE_INLINE struct motion batch_motion(const struct batch *b, int k)
{
    struct motion motion = {.dt = b->dt,
                            .density = b->new_density[k],
                            .strain_rate = batch_tensor(b->strain_rate, k),
                            .spin = vec3_make(b->spin[0][k], b->spin[1][k], b->spin[2][k]),
                            .viscous_pressure = b->viscous_pressure[k],
                            .length = b->length[k]};
    return motion;
}

#endif
