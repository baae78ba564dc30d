/* What the headers of the equations of state have in common: the traits that others ask of a model,
 * with a default for what a model does not have, and the curve that its temperatures are counted
 * from. */
#ifndef BOLIDE_EOS_COMMON_H
#define BOLIDE_EOS_COMMON_H

#include "base/exponential.h"
#include "material/point.h"

struct eos_traits {
    /* A of the shock adiabat U_s = c + A u from rest; NAN: that of a weak shock (see
     * riemann/shock_slope.h). */
    double shock_slope;
    /* C of U_s = C + S U_p with this slope S, where that is the shock adiabat; else NAN. */
    double shock_sound;
    /* gamma where waves are those of an ideal gas, for exact solutions of them; NAN: they are not.
     * */
    double ratio_of_heats;
    /* A gas: however far it expands it never pulls. */
    bool gas;
    /* A liquid like a gas: linear in the energy, with waves at any pressure above zero. */
    bool stiffened;
    /* Of rho/rho_0, up to which the model is meant; a run warns beyond it. INFINITY: any, as of
     * gases. */
    double largest_compression;
    /* Its tension has a limit that is a strength, not the form of a curve. */
    bool limits_tension;
    /* Q, J/m^3 of an explosive at rest: the heat that its reaction frees, by which energies of its
     * products are lower; 0: it does not react. */
    double reaction_energy;
    /* The history that it needs: a sum of HISTORY_BIT. */
    unsigned history;
    /* Why its parameters do not go together, and the parameter to name; NULL when they do. */
    const char *wrong, *wrong_key;
};

/* The traits of a model that says no more. */
BOLIDE_INLINE struct eos_traits eos_default_traits(void)
{
    struct eos_traits traits = {NAN, NAN, NAN, false, false, 4.0, false, 0.0, 0, NULL, NULL};
    return traits;
}

/* Raises (dp/drho)_e where c^2 = (dp/drho)_e + (dp/de)_rho p/rho^2 falls below LEAST, m^2/s^2. */
BOLIDE_INLINE void eos_hold_sound(struct eos_value *value, double density, double least)
{
    const double held = least - value->dp_de * value->pressure / square(density);
    value->status |= value->dp_drho < held ? POINT_SOUND_HELD : 0;
    value->dp_drho = maximum(value->dp_drho, held);
}

/* The thermal constants of a material; NAN where a case says nothing. */
struct heat {
    double capacity;     /* C_V, J/(kg K) */
    double conductivity; /* lambda, W/(m K) */
    double temperature;  /* T_0, K, of the state of no pressure and no energy; gases have none */
};

/* A point of the curve that temperatures are counted from, T = T_r + (e - e_r)/C_V: K, J/kg. */
struct heat_curve {
    double temperature, energy;
};

/* Point K of Gauss and Legendre's quadrature over -1 .. 1. */
enum { QUADRATURE = 6 };
struct quadrature {
    double at, weight;
};

BOLIDE_INLINE struct quadrature quadrature_point(int k)
{
    const double node[3] = {0.23861918608319690863, 0.66120938646626451366, 0.93246951420315202781};
    const double weight[3] = {0.46791393457269104739, 0.36076157304813860757,
                              0.17132449237917034504};
    struct quadrature point = {k < 3 ? -node[k] : node[k - 3], weight[k % 3]};
    return point;
}

/* Defines FUNCTION, the curve of a MODEL that has none of its own: the isentrope of the state at
 * rest,
 *
 *   de/d(ln rho) = p/rho,   d(ln T)/d(ln rho) = (dp/de)/rho
 *
 * by the classical method of Runge and Kutta in equal steps of ln rho. Where p is linear in e and
 * C_V constant, T = T_r + (e - e_r)/C_V is exact; elsewhere it is an approximation. */
enum { ISENTROPE_STEPS = 16 };
#define EOS_ISENTROPE(function, model)                                                  \
    BOLIDE_INLINE struct heat_curve function(const struct eos_##model *eos,             \
                                             const struct heat *heat, double density)   \
    {                                                                                   \
        const double step = logarithm(density / eos->density) / ISENTROPE_STEPS;        \
        const double half = exponential(0.5 * step), none[POINT_HISTORY] = {0.0};       \
        const double grown[4] = {1.0, half, half, half * half};                         \
        const double ahead[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0}; \
        double rho = eos->density, energy = 0.0, warmth = 0.0;                          \
        for (int i = 0; i < ISENTROPE_STEPS; i++) {                                     \
            double slope = 0.0, rise = 0.0, heating = 0.0;                              \
            for (int k = 0; k < 4; k++) {                                               \
                const double there = rho * grown[k];                                    \
                struct eos_value value =                                                \
                    eos_##model(eos, there, energy + ahead[k] * step * slope, none);    \
                slope = value.pressure / there;                                         \
                rise += weight[k] / 6.0 * slope;                                        \
                heating += weight[k] / 6.0 * value.dp_de / there;                       \
            }                                                                           \
            rho *= grown[3];                                                            \
            energy += step * rise;                                                      \
            warmth += step * heating;                                                   \
        }                                                                               \
        struct heat_curve curve = {heat->temperature * exponential(warmth), energy};    \
        return curve;                                                                   \
    }

#endif
