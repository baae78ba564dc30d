/* What the Mie-Grüneisen equations of state do where the form of their source ends. All are
 *
 *   p = p_H + G (e - e_H) = h p_H + G e,   e_H = p_H x/2,   h = 1 - G x/2,   x = v_0 - v
 *
 * about the shock adiabat p_H from rest, with G = gamma rho or gamma_0 rho_0. The form ends
 *
 * - in compression where h, the weight of the adiabat, falls below a limit. At constant gamma h
 *   reaches zero at rho/rho_0 = 1 + 2/gamma, and cold material loses its sound speed before that;
 *   its sound speed has its maximum near h = 1/2. From the limit h_b on, h = h_b - s/(1 + 2 s/h_b),
 *   where s is by how much the source's h is below it, and G = 2 (1 - h)/x: h falls to h_b/2, gamma
 *   like 1/(rho/rho_0 - 1). States on the adiabat stay as they are. c^2 > 0 follows for h_b <= 1/2;
 * - near the largest compression of the adiabat, from 0.95 of rho/rho_0 = s/(s - 1) in terms of x
 *   on: p_H is continued linearly in rho;
 * - in tension at rho_1 = 0.9 rho_0. The curves of the sources have no cohesive energy: below,
 *   either tension grows without bound, or hot material never becomes a gas. With t = rho/rho_1:
 *
 *     p = p_c + G (e - e_c),   p_c = b_1 t^2 + b_2 t^4,   de_c/dt = p_c/(rho_1 t^2)
 *     G = rho_1 (a t + b t^2 + c t^3),   a = min(max(gamma, 3/2), 3 gamma)
 *
 *   b and c continue pressure and its slope at every energy; a is the gamma of the gas, and at most
 *   3 gamma so that G grows with rho. The attraction, b_1 t^2, is van der Waals': as no power above
 *   1 + gamma it leaves c^2 > 0 wherever p >= 0. The tension has a maximum, the cohesive energy is
 *   finite (aluminium: 11 GPa and 11 MJ/kg about the adiabat with gamma rho constant; 12 MJ/kg is
 *   measured), and hotter material expands as a gas. In tension beyond the maximum c^2 would be
 *   negative: it is held at t/100 of that at rho_1;
 * - at energies below e_1 = -c^2/100, which is about that of absolute zero (-0.16 of 0.11 MJ/kg in
 *   copper, -0.042 of 0.038 in lead): what is under tension and compressed would cool, and pull,
 *   without bound. Below, e counts as e_1 - s/(1 - s/e_1), s = e_1 - e: never less than 2 e_1. */
#ifndef BOLIDE_EOS_GRUENEISEN_H
#define BOLIDE_EOS_GRUENEISEN_H

#include "material/eos/common.h"

/* A parameter of such a model, and its rows in the table. */
enum eos_form { EOS_EXTENDED, EOS_SOURCE };
#define EOS_FORM_PARAMETER(T)                                                                   \
    CHOICE(T, form, "extended",                                                                 \
           "outside the range of the published formula: extended keeps a positive sound speed " \
           "and limits tension; source uses the formula unchanged",                             \
           "extended", "source")

/* rho_1/rho_0; the fraction of the adiabat's largest x that is used, and the largest (v_0 - v)/v_0
 * where s is too small for it to end. */
BOLIDE_INLINE double grueneisen_tension(void) { return 0.9; }
BOLIDE_INLINE double grueneisen_adiabat(void) { return 0.95; }
BOLIDE_INLINE double grueneisen_deepest(void) { return 0.9; }
/* h_b where gamma, or gamma rho, is constant. */
BOLIDE_INLINE double grueneisen_gamma_weight(void) { return 0.5; }
BOLIDE_INLINE double grueneisen_product_weight(void) { return 0.25; }

/* A function of density or energy and its derivative. */
struct eos_curve_point {
    double value, slope;
};

/* Whether ENERGY is above e_1, and as what it counts; of a model whose weak shocks have the speed
 * SOUND. */
BOLIDE_INLINE bool grueneisen_is_warm(double sound, double energy)
{
    return energy >= -0.01 * square(sound);
}
BOLIDE_INLINE struct eos_curve_point grueneisen_warmth(double sound, double energy)
{
    const double deepest = 0.01 * square(sound), below = maximum(-deepest - energy, 0.0),
                 share = 1.0 / (1.0 + below / deepest);
    const struct eos_curve_point warmth = {energy + below - below * share, square(share)};
    return warmth;
}

/* The largest (v_0 - v)/v_0 at which p_H is that of U_s = c + SLOPE U_p, and whether PART/WHOLE is
 * within it, without a division. */
BOLIDE_INLINE double grueneisen_largest_strain(double slope)
{
    return minimum(grueneisen_adiabat() / slope, grueneisen_deepest());
}

BOLIDE_INLINE bool grueneisen_on_adiabat(double slope, double part, double whole)
{
    return (slope * part <= grueneisen_adiabat() * whole) & (part <= grueneisen_deepest() * whole);
}

/* p_H of U_s = SOUND + SLOPE U_p. */
BOLIDE_INLINE struct eos_curve_point grueneisen_linear_adiabat(double rest, double sound,
                                                               double slope, double density)
{
    const double within = minimum(density, rest / (1.0 - grueneisen_largest_strain(slope)));
    const double y = 1.0 - rest / within, reach = 1.0 - slope * y;
    const double modulus = rest * square(sound);
    struct eos_curve_point p;
    p.slope = modulus * (1.0 + slope * y) / (reach * square(reach)) * rest / square(within);
    p.value = modulus * y / square(reach) + p.slope * (density - within);
    return p;
}

/* h from that of the source, with its slope by density. */
BOLIDE_INLINE struct eos_curve_point grueneisen_weight(struct eos_curve_point source, double least)
{
    if (source.value >= least)
        return source;
    const double lack = 1.0 + 2.0 * (least - source.value) / least;
    struct eos_curve_point h = {least - (least - source.value) / lack, source.slope / square(lack)};
    return h;
}

/* The state at DENSITY, which is above that at REST, from p_H and h. */
BOLIDE_INLINE struct eos_value grueneisen_compressed(double rest, double density, double energy,
                                                     struct eos_curve_point adiabat,
                                                     struct eos_curve_point h)
{
    const double x = 1.0 / rest - 1.0 / density, thermal = 2.0 * (1.0 - h.value) / x;
    struct eos_value value;
    value.pressure = h.value * adiabat.value + thermal * energy;
    value.dp_drho = h.slope * adiabat.value + h.value * adiabat.slope -
                    (2.0 * h.slope + thermal / square(density)) / x * energy;
    value.dp_de = thermal;
    value.status = 0;
    return value;
}

/* Defines FUNCTION, the temperature on the shock adiabat of MODEL at DENSITY from that of the state
 * FROM on it, whose density is FROM_DENSITY: Walsh and Christian's
 *
 *   C_V [dT/d(ln rho) - (G/rho) T] = (x rho dp_H/drho - p_H/rho)/2
 *
 * (Phys. Rev. 97 (1955) 1544) by the classical method of Runge and Kutta in equal steps of ln rho.
 * ADIABAT and WEIGHT give p_H and h of the model. */
enum { ADIABAT_STEPS = 64 };
#define EOS_ADIABAT_CURVE(function, model, adiabat, weight)                                        \
    BOLIDE_INLINE struct heat_curve function(const struct eos_##model *eos, double capacity,       \
                                             struct heat_curve from, double from_density,          \
                                             double density)                                       \
    {                                                                                              \
        const double step = logarithm(density / from_density) / ADIABAT_STEPS;                     \
        const double half = exponential(0.5 * step);                                               \
        const double grown[4] = {1.0, half, half, half * half};                                    \
        const double ahead[4] = {0.0, 0.5, 0.5, 1.0}, share[4] = {1.0, 2.0, 2.0, 1.0};             \
        double rho = from_density, temperature = from.temperature;                                 \
        for (int i = 0; i < ADIABAT_STEPS; i++) {                                                  \
            double rate = 0.0, rise = 0.0;                                                         \
            for (int k = 0; k < 4; k++) {                                                          \
                const double there = rho * grown[k], x = 1.0 / eos->density - 1.0 / there;         \
                const struct eos_curve_point p = adiabat(eos, there), h = weight(eos, there);      \
                const double heating = 0.5 * (x * there * p.slope - p.value / there) / capacity;   \
                rate =                                                                             \
                    2.0 * (1.0 - h.value) / (x * there) * (temperature + ahead[k] * step * rate) + \
                    heating;                                                                       \
                rise += share[k] / 6.0 * rate;                                                     \
            }                                                                                      \
            rho *= grown[3];                                                                       \
            temperature += step * rise;                                                            \
        }                                                                                          \
        const double x = 1.0 / eos->density - 1.0 / density;                                       \
        struct heat_curve curve = {temperature, 0.5 * adiabat(eos, density).value * x};            \
        return curve;                                                                              \
    }

/* Where tension begins to be bounded: rho_1, and there the reference state, rho c^2, G and
 * dG/drho. */
struct eos_edge {
    double density, pressure, energy, modulus, thermal, thermal_slope;
};

/* That of a model whose pressure is linear in energy: COLD is its value at DENSITY, which is below
 * that at REST, and no energy. The reference state is the one that e = p x/2 leads to from rest. */
BOLIDE_INLINE struct eos_edge eos_edge_of(double rest, double density, struct eos_value cold,
                                          double thermal_slope)
{
    struct eos_edge edge;
    const double half = 0.5 * (1.0 / rest - 1.0 / density);
    edge.density = density;
    edge.pressure = cold.pressure / (1.0 - half * cold.dp_de);
    edge.energy = half * edge.pressure;
    edge.thermal = cold.dp_de;
    edge.thermal_slope = thermal_slope;
    edge.modulus = density * (cold.dp_drho + thermal_slope * edge.energy) +
                   cold.dp_de * edge.pressure / density;
    return edge;
}

/* b_1 and b_2 of p_c, and a, b, c of G. */
struct eos_expansion {
    double first, second, a, b, c;
};

BOLIDE_INLINE struct eos_expansion eos_expansion_of(const struct eos_edge *edge)
{
    const double gamma = edge->thermal / edge->density;
    struct eos_expansion x;
    x.first = 2.0 * edge->pressure - 0.5 * edge->modulus;
    x.second = 0.5 * edge->modulus - edge->pressure;
    x.a = minimum(maximum(gamma, 1.5), 3.0 * gamma);
    x.c = edge->thermal_slope - 2.0 * gamma + x.a;
    x.b = gamma - x.a - x.c;
    return x;
}

BOLIDE_INLINE double eos_expansion_energy(const struct eos_edge *edge,
                                          const struct eos_expansion *x, double t)
{
    return edge->energy +
           (x->first * (t - 1.0) + x->second / 3.0 * (t * square(t) - 1.0)) / edge->density;
}

/* The state at DENSITY, below that of EDGE. */
BOLIDE_INLINE struct eos_value eos_expanded(const struct eos_edge *edge, double density,
                                            double energy)
{
    const struct eos_expansion x = eos_expansion_of(edge);
    const double t = density / edge->density, t2 = square(t);
    const double cold = t2 * (x.first + x.second * t2);
    const double heat = energy - eos_expansion_energy(edge, &x, t);
    struct eos_value value;
    value.dp_de = density * (x.a + t * (x.b + t * x.c));
    value.pressure = cold + value.dp_de * heat;
    value.dp_drho = t * (2.0 * x.first + 4.0 * x.second * t2) / edge->density +
                    (x.a + t * (2.0 * x.b + t * 3.0 * x.c)) * heat -
                    value.dp_de * cold / square(density);
    value.status = 0;
    eos_hold_sound(&value, density, 0.01 * t * edge->modulus / edge->density);
    return value;
}

/* Temperature of the reference state there, from that at the edge: T ~ exp(int gamma d ln t). */
BOLIDE_INLINE struct heat_curve eos_expanded_curve(const struct eos_edge *edge,
                                                   struct heat_curve at_edge, double density,
                                                   double capacity)
{
    const struct eos_expansion x = eos_expansion_of(edge);
    const double t = density / edge->density;
    const double start = at_edge.temperature + (edge->energy - at_edge.energy) / capacity;
    struct heat_curve curve;
    curve.temperature =
        start * exponential(x.a * logarithm(t) + x.b * (t - 1.0) + 0.5 * x.c * (square(t) - 1.0));
    curve.energy = eos_expansion_energy(edge, &x, t);
    return curve;
}

/* Defines MODEL_edge(), eos_MODEL_beyond() and eos_MODEL_curve() of a MODEL with the functions
 * MODEL_end(), the largest density of the form of its source, MODEL_adiabat() and MODEL_weight(),
 * p_H and h, and MODEL_curve(), the curve of temperatures of that form. THERMAL_SLOPE is dG/drho,
 * of EOS. */
#define GRUENEISEN_CONTINUED(model, thermal_slope)                                               \
    BOLIDE_INLINE struct eos_edge model##_edge(const struct eos_##model *eos)                    \
    {                                                                                            \
        const double none[POINT_HISTORY] = {0.0};                                                \
        const double density = grueneisen_tension() * eos->density;                              \
        return eos_edge_of(eos->density, density, eos_##model(eos, density, 0.0, none),          \
                           thermal_slope);                                                       \
    }                                                                                            \
    BOLIDE_INLINE struct eos_value eos_##model##_beyond(const struct eos_##model *eos,           \
                                                        double density, double energy)           \
    {                                                                                            \
        const double none[POINT_HISTORY] = {0.0};                                                \
        const struct eos_edge edge = model##_edge(eos);                                          \
        const struct eos_curve_point warm = grueneisen_warmth(eos->sound, energy);               \
        struct eos_value value;                                                                  \
        if (density < edge.density)                                                              \
            value = eos_expanded(&edge, density, warm.value);                                    \
        else if (density > model##_end(eos))                                                     \
            value = grueneisen_compressed(eos->density, density, warm.value,                     \
                                          model##_adiabat(eos, density),                         \
                                          model##_weight(eos, density));                         \
        else                                                                                     \
            value = eos_##model(eos, density, warm.value, none);                                 \
        value.dp_de *= warm.slope;                                                               \
        value.status &= ~(unsigned)POINT_BEYOND;                                                 \
        return value;                                                                            \
    }                                                                                            \
    EOS_ADIABAT_CURVE(model##_curve_on, model, model##_adiabat, model##_weight)                  \
    BOLIDE_INLINE struct heat_curve eos_##model##_curve(const struct eos_##model *eos,           \
                                                        const struct heat *heat, double density) \
    {                                                                                            \
        const struct eos_edge edge = model##_edge(eos);                                          \
        const double end = model##_end(eos);                                                     \
        if (eos->form == EOS_SOURCE || (density >= edge.density && density <= end))              \
            return model##_curve(eos, heat, density);                                            \
        if (density > end)                                                                       \
            return model##_curve_on(eos, heat->capacity, model##_curve(eos, heat, end), end,     \
                                    density);                                                    \
        return eos_expanded_curve(&edge, model##_curve(eos, heat, edge.density), density,        \
                                  heat->capacity);                                               \
    }

#endif
