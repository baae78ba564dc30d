/* The wave that takes an ideal gas to another pressure. Through a shock, with A = 2/((g+1) rho) and
 * B = (g-1)/(g+1) p,   |u* - u| = (p* - p) sqrt(A/(p* + B)); through a fan        |u* - u| =
 * 2c/(g-1) (1 - r^((g-1)/2g)),  r = p* over p. Both are one increasing, concave function of p*.
 * Source: Landau and Lifshitz, Fluid mechanics, sections 85, 89, 99, 100. */
#ifndef BOLIDE_GAS_WAVE_H
#define BOLIDE_GAS_WAVE_H

#include "base/exponential.h"

/* A change of velocity (m/s) and its derivative by the pressure behind the wave (m/s/Pa). */
struct gas_push {
    double value, slope;
};

/* How much the wave to PRESSURE behind it pushes a gas of density RHO, pressure P and sound speed C
 * away from where the wave came from; negative where it draws. */
BOLIDE_INLINE struct gas_push gas_wave_push(double rho, double p, double c, double gamma,
                                            double pressure)
{
    struct gas_push push;
    if (pressure > p) {
        double a = 2.0 / ((gamma + 1.0) * rho), b = (gamma - 1.0) / (gamma + 1.0) * p;
        double rise = pressure - p, root = sqrt(a / (pressure + b));
        push.value = rise * root;
        push.slope = root * (1.0 - 0.5 * rise / (pressure + b));
    } else {
        double fall = logarithm(pressure / p);
        push.value =
            2.0 * c / (gamma - 1.0) * exponential_minus_one(0.5 * (gamma - 1.0) / gamma * fall);
        push.slope = exponential(-0.5 * (gamma + 1.0) / gamma * fall) / (rho * c);
    }
    return push;
}

#endif
