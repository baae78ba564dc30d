/* An explosive and its products at one pressure and temperature, each a JWL, and the mass fraction
 * l of the products as the burn model has it. With the volumes V_i = v_i/v_0 of the explosive, s,
 * and the products, g, over that of the explosive at rest, and the energy E = e/v_0:
 *
 *   P_i = (w_i/V_i) (E_i + F_i - O_i),  T_i = (P_i V_i/w_i - F_i - G_i)/C_i,  O_s = F_s(1), O_g = -Q
 *   V = (1 - l) V_s + l V_g,  E = (1 - l) E_s + l E_g,  P_s = P_g,  T_s = T_g
 *   F_i = A_i (V_i/w_i - 1/R1_i) exp(-R1_i V_i) + B_i (V_i/w_i - 1/R2_i) exp(-R2_i V_i)
 *   G_i = A_i/R1_i exp(-R1_i V_i) + B_i/R2_i exp(-R2_i V_i)
 *
 * One unknown is left, the volume of the rarer phase, at which the temperatures are equal: Newton's
 * method finds it, from the last volume of the explosive. Where that leads to no state with P, T >
 * 0, the range is searched for the nearest one. Source: Lee and Tarver, Phys. Fluids 23 (1980)
 * 2362, in the form of Parshikov (2013), (5.4)-(5.11); the choice of the unknown is ours. */
#ifndef BOLIDE_EOS_REACTIVE_JWL_H
#define BOLIDE_EOS_REACTIVE_JWL_H

#include "material/eos/jwl.h"

struct eos_reactive_jwl {
    double density;                       /* rho_0 of the explosive, kg/m^3 */
    double a, b, r1, r2, omega, capacity; /* C, Pa/K */
    double products_a, products_b, products_r1, products_r2, products_omega, products_capacity;
    double energy; /* Q, J/m^3 of the explosive */
};

#define EOS_reactive_jwl_NAME "reactive-jwl"
#define EOS_reactive_jwl_HELP \
    "explosive and products in equilibrium, both JWL, for `burn: ignition-growth`"
#define EOS_reactive_jwl_SAMPLE                                                                   \
    {                                                                                             \
        1750.0, 3756e9, -131.3e9, 7.2, 3.6, 1.173, 2.263e6, 617e9, 16.926e9, 4.4, 1.2, 0.25, 1e6, \
            10.1e9                                                                                \
    } /* PETN */
#define EOS_reactive_jwl_PARAMETERS(T)                                                          \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density of the explosive")                \
    NUMBER(T, a, "Pa", REQUIRED, ANY, "A of the explosive: factor of exp(-R_1 V)")              \
    NUMBER(T, b, "Pa", REQUIRED, ANY, "B of the explosive: factor of exp(-R_2 V)")              \
    NUMBER(T, r1, "", REQUIRED, POSITIVE, "R_1 of the explosive")                               \
    NUMBER(T, r2, "", REQUIRED, POSITIVE, "R_2 of the explosive")                               \
    NUMBER(T, omega, "", REQUIRED, POSITIVE, "Grueneisen coefficient of the explosive")         \
    NUMBER(T, capacity, "Pa/K", REQUIRED, POSITIVE,                                             \
           "C_V of the explosive, of a unit of volume at rest")                                 \
    NUMBER(T, products_a, "Pa", REQUIRED, ANY, "A of the products")                             \
    NUMBER(T, products_b, "Pa", REQUIRED, ANY, "B of the products")                             \
    NUMBER(T, products_r1, "", REQUIRED, POSITIVE, "R_1 of the products")                       \
    NUMBER(T, products_r2, "", REQUIRED, POSITIVE, "R_2 of the products")                       \
    NUMBER(T, products_omega, "", REQUIRED, POSITIVE, "Grueneisen coefficient of the products") \
    NUMBER(T, products_capacity, "Pa/K", REQUIRED, POSITIVE,                                    \
           "C_V of the products, of a unit of volume of the explosive")                         \
    NUMBER(T, energy, "J/m^3", REQUIRED, POSITIVE, "Q: heat of the reaction")

/* One phase: its constants, and O. */
struct jwl_phase {
    double a, b, r1, r2, omega, capacity, offset;
};

/* F, G and their slopes by V. */
struct jwl_terms {
    double f, g, f_slope, g_slope;
};

BOLIDE_INLINE struct jwl_terms jwl_terms_of(const struct jwl_phase *phase, double volume)
{
    const double first = phase->a * exponential(-phase->r1 * volume),
                 second = phase->b * exponential(-phase->r2 * volume), over = 1.0 / phase->omega;
    struct jwl_terms t;
    t.f = first * (volume * over - 1.0 / phase->r1) + second * (volume * over - 1.0 / phase->r2);
    t.g = first / phase->r1 + second / phase->r2;
    t.f_slope = first * (over - phase->r1 * volume * over + 1.0) +
                second * (over - phase->r2 * volume * over + 1.0);
    t.g_slope = -(first + second);
    return t;
}

BOLIDE_INLINE struct jwl_phase reactive_jwl_explosive(const struct eos_reactive_jwl *jwl)
{
    struct jwl_phase phase = {jwl->a, jwl->b, jwl->r1, jwl->r2, jwl->omega, jwl->capacity, 0.0};
    phase.offset = jwl_terms_of(&phase, 1.0).f;
    return phase;
}

BOLIDE_INLINE struct jwl_phase reactive_jwl_products(const struct eos_reactive_jwl *jwl)
{
    struct jwl_phase phase = {jwl->products_a,  jwl->products_b,     jwl->products_r1,
                              jwl->products_r2, jwl->products_omega, jwl->products_capacity,
                              -jwl->energy};
    return phase;
}

/* Where two phases of VOLUME[] and FRACTION[] by mass would be at one pressure: that, and how far
 * their temperatures are apart, with slopes. */
struct jwl_mixture {
    double pressure, apart; /* Pa; K: T_0 - T_1 */
    double temperature[2];  /* K */
    double p_volume[2];     /* slopes of P by V_i, and by E */
    double t_volume[2];     /* of T_i by V_i at constant P */
    double t_pressure[2];   /* of T_i by P */
    double p_energy;
};

BOLIDE_INLINE struct jwl_mixture jwl_mix(const struct jwl_phase phase[2], const double fraction[2],
                                         const double volume[2], double energy)
{
    struct jwl_mixture m;
    struct jwl_terms t[2];
    double sum = energy, room = 0.0;
    for (int i = 0; i < 2; i++) {
        t[i] = jwl_terms_of(&phase[i], volume[i]);
        sum += fraction[i] * (t[i].f - phase[i].offset);
        room += fraction[i] * volume[i] / phase[i].omega;
    }
    m.p_energy = 1.0 / room;
    m.pressure = sum / room;
    for (int i = 0; i < 2; i++) {
        const double omega = phase[i].omega, capacity = phase[i].capacity;
        m.temperature[i] = (m.pressure * volume[i] / omega - t[i].f - t[i].g) / capacity;
        m.p_volume[i] = fraction[i] * (t[i].f_slope - m.pressure / omega) / room;
        m.t_volume[i] = (m.pressure / omega - t[i].f_slope - t[i].g_slope) / capacity;
        m.t_pressure[i] = volume[i] / (omega * capacity);
    }
    m.apart = m.temperature[0] - m.temperature[1];
    return m;
}

/* The slope of the difference of temperatures by the volume of phase 0, at a constant volume of
 * both. */
BOLIDE_INLINE double jwl_apart_slope(const struct jwl_mixture *m, const double fraction[2])
{
    const double other = -fraction[0] / fraction[1];
    const double p = m->p_volume[0] + other * m->p_volume[1];
    return m->t_volume[0] + m->t_pressure[0] * p - other * m->t_volume[1] - m->t_pressure[1] * p;
}

BOLIDE_INLINE bool jwl_is_state(const struct jwl_mixture *m)
{
    return m->pressure > 0.0 && m->temperature[0] > 0.0 && m->temperature[1] > 0.0;
}

/* The volumes of both phases, whose sum is TOTAL: that of phase 0, the rarer one, begins at FIRST.
 * Whether there is a state. */
BOLIDE_INLINE bool jwl_newton(const struct jwl_phase phase[2], const double fraction[2],
                              double total, double energy, double low, double high, double first,
                              double volume[2], struct jwl_mixture *m)
{
    double v = first;
    for (int round = 0; round < 60; round++) {
        volume[0] = v;
        volume[1] = (total - fraction[0] * v) / fraction[1];
        *m = jwl_mix(phase, fraction, volume, energy);
        const double scale = fabs(m->temperature[0]) + fabs(m->temperature[1]);
        if (!(fabs(m->apart) > 1e-13 * scale))
            return jwl_is_state(m);
        const double step = -m->apart / jwl_apart_slope(m, fraction);
        const double reach = 0.3 * v; /* of one step */
        double next = v + maximum(-reach, minimum(reach, step));
        if (!(next > low))
            next = 0.5 * (v + low);
        if (!(next < high))
            next = 0.5 * (v + high);
        if (!(fabs(next - v) > 1e-15 * v))
            return jwl_is_state(m) && fabs(m->apart) < 1e-9 * scale;
        v = next;
    }
    return false;
}

/* The same where Newton's method from FIRST leads nowhere: from the change of sign between states
 * that is nearest to FIRST, by bisection. */
BOLIDE_INLINE bool jwl_search(const struct jwl_phase phase[2], const double fraction[2],
                              double total, double energy, double low, double high, double first,
                              double volume[2], struct jwl_mixture *m)
{
    enum { STATIONS = 200 };
    const double ratio = power(high / low, 1.0 / STATIONS);
    double best = INFINITY, from = 0.0, before = 0.0, at = low;
    bool had = false;
    for (int k = 0; k <= STATIONS; k++, at *= ratio) {
        const double trial[2] = {at, (total - fraction[0] * at) / fraction[1]};
        if (!(trial[1] > 0.0))
            break;
        const struct jwl_mixture here = jwl_mix(phase, fraction, trial, energy);
        const bool has = jwl_is_state(&here);
        const double distance = fabs(logarithm(at / first));
        if ((has || had) && (before > 0.0) != (here.apart > 0.0) && distance < best) {
            best = distance;
            from = at / ratio;
        }
        had = has;
        before = here.apart;
    }
    if (!(from > 0.0))
        return false;
    double left = from, right = from * ratio;
    for (int round = 0; round < 40; round++) {
        const double middle = 0.5 * (left + right);
        const double trial[2] = {middle, (total - fraction[0] * middle) / fraction[1]};
        const double start[2] = {left, (total - fraction[0] * left) / fraction[1]};
        const bool same = (jwl_mix(phase, fraction, trial, energy).apart > 0.0) ==
                          (jwl_mix(phase, fraction, start, energy).apart > 0.0);
        left = same ? middle : left;
        right = same ? right : middle;
    }
    return jwl_newton(phase, fraction, total, energy, low, high, 0.5 * (left + right), volume, m);
}

/* One phase alone: its JWL, which continues where an unburnt explosive expands (jwl.h). */
BOLIDE_INLINE struct eos_value jwl_alone(const struct jwl_phase *phase, double rest, double density,
                                         double energy)
{
    const struct eos_jwl jwl = {rest,      phase->a,     phase->b,       phase->r1,
                                phase->r2, phase->omega, -phase->offset, EOS_EXTENDED};
    const double none[POINT_HISTORY] = {0.0};
    const struct eos_value value = eos_jwl(&jwl, density, energy, none);
    return value.status & POINT_BEYOND ? eos_jwl_beyond(&jwl, density, energy) : value;
}

/* Fractions below this and above one less this are one phase. */
static const double JWL_PURE = 1e-5;

/* Both phases of a mixture, the rarer one first, by which its equations are solved. */
struct jwl_closure {
    struct jwl_phase phase[2];
    double fraction[2], volume[2];
    struct jwl_mixture mixture;
    bool found;
};

/* The mixture of the volume TOTAL and the energy ALL (J/m^3) with the fraction BURNT, neither 0 nor
 * 1, from the GUESS of the volume of the explosive; 0: from none. */
BOLIDE_INLINE struct jwl_closure reactive_jwl_close(const struct eos_reactive_jwl *jwl,
                                                    double total, double all, double burnt,
                                                    double guess)
{
    const struct jwl_phase explosive = reactive_jwl_explosive(jwl),
                           products = reactive_jwl_products(jwl);
    const bool few = burnt < 0.5;
    struct jwl_closure c = {.phase = {few ? products : explosive, few ? explosive : products},
                            .fraction = {few ? burnt : 1.0 - burnt, few ? 1.0 - burnt : burnt},
                            .volume = {total, total}};
    const double low = 0.05, high = total / c.fraction[0];
    const double start = guess > 0.0 ? guess : total;
    double first = few ? (total - (1.0 - burnt) * start) / burnt : start;
    if (!(first > low && first < high))
        first = maximum(low, minimum(total, 0.999 * high));
    c.found = jwl_newton(c.phase, c.fraction, total, all, low, high, first, c.volume, &c.mixture);
    if (!c.found)
        c.found = jwl_newton(c.phase, c.fraction, total, all, low, high,
                             maximum(low, minimum(total, 0.999 * high)), c.volume, &c.mixture);
    if (!c.found)
        c.found = jwl_search(c.phase, c.fraction, total, all, low, 0.9999 * high, first, c.volume,
                             &c.mixture);
    return c;
}

/* The state of DENSITY and ENERGY (J/kg) with the fraction BURNT; LAST is the last volume of the
 * explosive, and becomes the new one. */
BOLIDE_INLINE struct eos_value reactive_jwl_state(const struct eos_reactive_jwl *jwl,
                                                  double density, double energy, double burnt,
                                                  double *last)
{
    const double total = jwl->density / density, all = energy * jwl->density;
    if (burnt < JWL_PURE || burnt > 1.0 - JWL_PURE) {
        const struct jwl_phase alone =
            burnt < 0.5 ? reactive_jwl_explosive(jwl) : reactive_jwl_products(jwl);
        *last = total;
        return jwl_alone(&alone, jwl->density, density, energy);
    }
    const struct jwl_closure closure = reactive_jwl_close(jwl, total, all, burnt, *last);
    const struct jwl_mixture m = closure.mixture;
    const double *fraction = closure.fraction;
    struct eos_value value;
    const double slope = jwl_apart_slope(&m, fraction), other = -fraction[0] / fraction[1];
    const double heats = m.t_pressure[0] - m.t_pressure[1];
    /* of V_0 by V and E, where the temperatures stay equal */
    const double by_volume = (m.t_volume[1] - heats * m.p_volume[1]) / (fraction[1] * slope);
    const double by_energy = -heats * m.p_energy / slope;
    const double along = m.p_volume[0] + other * m.p_volume[1];
    value.pressure = m.pressure;
    value.dp_drho = -(m.p_volume[1] / fraction[1] + along * by_volume) * total / density;
    value.dp_de = (m.p_energy + along * by_energy) * jwl->density;
    value.status = closure.found ? 0 : POINT_OUT_OF_RANGE;
    /* Beyond the tension that the explosive bears its pressure falls with density, and with a
     * little of hot products so does that of both. */
    eos_hold_sound(&value, density,
                   0.01 * jwl->energy / jwl->density * minimum(density / jwl->density, 1.0));
    *last = closure.volume[burnt < 0.5 ? 1 : 0];
    return value;
}

/* See EOS_PHASES: the state, and the temperature from the phase of which there is more. */
BOLIDE_INLINE struct eos_value eos_reactive_jwl_react(const struct eos_reactive_jwl *jwl,
                                                      double density, double energy,
                                                      double *history)
{
    return reactive_jwl_state(jwl, density, energy, history[HISTORY_burnt],
                              &history[HISTORY_explosive_volume]);
}

BOLIDE_INLINE double eos_reactive_jwl_temperature(const struct eos_reactive_jwl *jwl,
                                                  double density, double pressure,
                                                  const double *history)
{
    const double burnt = history[HISTORY_burnt], explosive = history[HISTORY_explosive_volume];
    const bool few = burnt<0.5, pure = burnt> 1.0 - JWL_PURE;
    const struct jwl_phase phase = few ? reactive_jwl_explosive(jwl) : reactive_jwl_products(jwl);
    const double total = jwl->density / density;
    const double volume = few    ? explosive
                          : pure ? total
                                 : (total - (1.0 - burnt) * explosive) / burnt;
    const struct jwl_terms t = jwl_terms_of(&phase, volume);
    return (pressure * volume / phase.omega - t.f - t.g) / phase.capacity;
}

BOLIDE_INLINE struct eos_value eos_reactive_jwl(const struct eos_reactive_jwl *jwl, double density,
                                                double energy, const double *history)
{
    double last = history[HISTORY_explosive_volume];
    return reactive_jwl_state(jwl, density, energy, history[HISTORY_burnt], &last);
}

BOLIDE_INLINE struct eos_traits eos_reactive_jwl_traits(const struct eos_reactive_jwl *jwl)
{
    struct eos_traits traits = eos_default_traits();
    traits.reaction_energy = jwl->energy;
    traits.history = HISTORY_BIT(burnt) | HISTORY_BIT(explosive_volume);
    return traits;
}

BOLIDE_INLINE struct heat_curve eos_reactive_jwl_curve(const struct eos_reactive_jwl *jwl,
                                                       const struct heat *heat, double density)
{
    const struct heat_curve none = {NAN, 0.0};
    (void)jwl;
    (void)heat;
    (void)density;
    return none;
}

#endif
