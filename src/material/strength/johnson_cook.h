/* Johnson and Cook's yield stress, with isotropic hardening, rate and heat:
 *
 * Y = (A + B eps^n)(1 + C ln max(rate/rate_0, 1))(1 - T*^m),  T* = (T - T_room)/(T_melt - T_room)
 * (2-64)
 *
 * T is T_room plus the excess temperature of the body at the start plus the heat of the plastic
 * work, dT = Y d eps/(rho c_v); it has no heat of compression or conduction. Radial return solves
 *
 *   S_eq - 3 G d eps = Y(eps + d eps, d eps/dt)
 *
 * of the elastic trial S_eq, by Newton's method; T is that before the step. The explicit variant is
 * that of the public MPM3D codes: d eps = (S_eq - Y)/[3 G + B n (eps + 1e-4)^(n-1)] with the Y
 * before the step, then the stress is put on Y after it; their Y before the step is stored, ours
 * has the strain rate of the step. Source: Johnson and Cook, Proc. 7th Int. Symp. Ballistics (1983)
 * 541, in the form of Cui, dissertation (2014).
 *
 * Damage that is coupled to strength takes the fraction w of Y, and flow hardens less by it:
 *
 *   Y = (1 - w)(A + B r^n) ...,  dr = (1 - w) d eps,  w = beta D
 *
 * r is taken as (1 - w/2) eps, which it is where damage grows in proportion to eps. Elastic moduli
 * and pressure stay those of intact material. Source: Borvik, Hopperstad, Berstad and Langseth,
 * Eur. J. Mech. A 20 (2001) 685, recalled. */
#ifndef BOLIDE_STRENGTH_JOHNSON_COOK_H
#define BOLIDE_STRENGTH_JOHNSON_COOK_H

#include "base/exponential.h"
#include "material/strength/common.h"

enum johnson_cook_return { JOHNSON_COOK_IMPLICIT, JOHNSON_COOK_EXPLICIT };

struct strength_johnson_cook {
    double shear_modulus;        /* G, Pa */
    double a, b;                 /* A, B, Pa */
    double n, c;                 /* n, C */
    double rate;                 /* rate_0, 1/s */
    double m;                    /* NAN: heat does not soften, and what follows is not used */
    double room, melt, capacity; /* T_room, T_melt, K; c_v, J/(kg K) */
    int return_map;              /* enum johnson_cook_return */
    double weakening;            /* w at failure; of the failure model: strength_weaken() */
};

#define STRENGTH_johnson_cook_NAME "johnson-cook"
#define STRENGTH_johnson_cook_HELP \
    "yield stress (A + B eps^n)(1 + C ln(rate/rate_0))(1 - T*^m) after Johnson and Cook"
#define STRENGTH_johnson_cook_PARAMETERS(T)                                                      \
    NUMBER(T, shear_modulus, "Pa", REQUIRED, POSITIVE, "shear modulus")                          \
    NUMBER(T, a, "Pa", REQUIRED, POSITIVE, "A: yield stress in simple tension before hardening") \
    NUMBER(T, b, "Pa", REQUIRED, NOT_NEGATIVE, "B: hardening by plastic strain")                 \
    NUMBER(T, n, "", REQUIRED, POSITIVE, "exponent of the plastic strain")                       \
    NUMBER(T, c, "", REQUIRED, NOT_NEGATIVE, "C: factor of the logarithm of the strain rate")    \
    NUMBER(T, rate, "1/s", "1 1/s", POSITIVE, "strain rate below which the rate has no effect")  \
    NUMBER(T, m, "", OPTIONAL, POSITIVE,                                                         \
           "exponent of T* = (T - room)/(melt - room); default: no thermal softening")           \
    NUMBER(T, room, "K", "300 K", POSITIVE, "reference temperature of T*; used with m")          \
    NUMBER(T, melt, "K", OPTIONAL, POSITIVE,                                                     \
           "temperature at which no strength is left; needed with m")                            \
    NUMBER(T, capacity, "J/(kg*K)", OPTIONAL, POSITIVE,                                          \
           "specific heat for the heating by plastic work; needed with m")                       \
    CHOICE(T, return_map, "implicit",                                                            \
           "implicit: with strain and rate of the step itself, by iteration; explicit: one "     \
           "evaluation, as in MPM3D",                                                            \
           "implicit", "explicit")

BOLIDE_INLINE bool johnson_cook_softens(const struct strength_johnson_cook *solid)
{
    return !isnan(solid->m);
}

/* T* after HEATING by K, from zero to one; zero where heat does not soften it. */
BOLIDE_INLINE double strength_johnson_cook_homologous(const struct strength_johnson_cook *solid,
                                                      double heating)
{
    return johnson_cook_softens(solid)
               ? minimum(maximum(heating, 0.0) / (solid->melt - solid->room), 1.0)
               : 0.0;
}

/* 1 - T*^m after HEATING by K. */
BOLIDE_INLINE double johnson_cook_softening(const struct strength_johnson_cook *solid,
                                            double heating)
{
    if (!johnson_cook_softens(solid))
        return 1.0;
    return 1.0 - power(strength_johnson_cook_homologous(solid, heating), solid->m);
}

/* 1 - w at DAMAGE of the failure model. */
BOLIDE_INLINE double johnson_cook_bearing(const struct strength_johnson_cook *solid, double damage)
{
    return 1.0 - solid->weakening * minimum(damage, 1.0);
}

/* r at plastic STRAIN, where 1 - w is BEARING. */
BOLIDE_INLINE double johnson_cook_hardened(double strain, double bearing)
{
    return strain * (0.5 + 0.5 * bearing);
}

/* 1 + C ln max(rate/rate_0, 1). */
BOLIDE_INLINE double johnson_cook_hastening(const struct strength_johnson_cook *solid, double rate)
{
    return 1.0 + solid->c * logarithm(maximum(rate / solid->rate, 1.0));
}

/* Y of slow flow at plastic STRAIN, with the SOFTENING by heat. */
BOLIDE_INLINE double johnson_cook_slow(const struct strength_johnson_cook *solid, double strain,
                                       double softening)
{
    return (solid->a + solid->b * power(strain, solid->n)) * softening;
}

/* Y at plastic STRAIN, RATE (1/s) and HEATING (K). */
BOLIDE_INLINE double johnson_cook_stress(const struct strength_johnson_cook *solid, double strain,
                                         double rate, double heating)
{
    return johnson_cook_slow(solid, strain, johnson_cook_softening(solid, heating)) *
           johnson_cook_hastening(solid, rate);
}

/* Y of slow flow. */
BOLIDE_INLINE double strength_johnson_cook_yield(const struct strength_johnson_cook *solid,
                                                 const struct point *point)
{
    const double heating =
        johnson_cook_softens(solid) ? point->history[HISTORY_plastic_heating] : 0.0;
    const double bearing = johnson_cook_bearing(solid, point->history[HISTORY_damage]);
    const double strain = johnson_cook_hardened(point->history[HISTORY_plastic_strain], bearing);
    return bearing * johnson_cook_stress(solid, strain, 0.0, heating);
}

/* Up to eight points that flow, each on its own: what it does for one does not depend on the
 * others. */
struct johnson_cook_points {
    double trial[LANES];     /* Mises stress of the elastic trial, beyond YIELD */
    double strain[LANES];    /* r before the step */
    double yield[LANES];     /* Y before the step; implicit: of slow flow */
    double softening[LANES]; /* (1 - T*^m)(1 - w) */
    double flow[LANES];      /* the plastic strain of the step: found */
    double stress[LANES];    /* and the Mises stress after it */
};

/* A first guess of what a step of DT flows, from the hardening along its slope ALONG:
 *
 *   x + a ln x = b,  w = x/a:  w + ln w = z
 *
 * with w roughly known and brought nearer by one step of third order (Fritsch, Shafer and Crowley,
 * Commun. ACM 16 (1973) 123). */
BOLIDE_INLINE double johnson_cook_guess(const struct strength_johnson_cook *solid, double dt,
                                        double trial, double slow, double along)
{
    const double stiff = 3.0 * solid->shear_modulus + along, beyond = trial - slow;
    /* where rate does not matter much, a little more of it does no harm */
    const double a = maximum(solid->c * slow, 1e-3 * beyond) / stiff;
    const double z = beyond / (stiff * a) - logarithm(a / (solid->rate * dt));
    const double e = exponential(minimum(z, 1.0));
    const double w = z > 1.0 ? z - logarithm(maximum(z, 1.0)) : e / (1.0 + e);
    const double rest = z - w - logarithm(w), up = 1.0 + w,
                 much = 2.0 * up * (up + 2.0 / 3.0 * rest);
    return minimum(a * w * (1.0 + rest / up * (much - rest) / (much - 2.0 * rest)), beyond / stiff);
}

/* What COUNT points flow in a step of DT. What is left of the trial stress falls with the flow and
 * Y grows, and Y bends down on either side of the reference rate: from the left Newton's method
 * does not overshoot, from the right it comes to the left. It stops over where Y has its kink. */
BOLIDE_INLINE void johnson_cook_flow(const struct strength_johnson_cook *solid, int count,
                                     double dt, struct johnson_cook_points *p)
{
    const double triple = 3.0 * solid->shear_modulus, kink = solid->rate * dt;
    int64_t going[LANES], left = count;
    for (int k = 0; k < count; k++) {
        const double strain = p->strain[k], hardening = p->yield[k] - solid->a * p->softening[k];
        going[k] = 1;
        p->flow[k] = johnson_cook_guess(solid, dt, p->trial[k], p->yield[k],
                                        strain > 0.0 ? hardening * solid->n / strain : 0.0);
    }
    for (int round = 0; round < 60 && left > 0; round++) {
        left = 0;
        for (int k = 0; k < count; k++) {
            const double flow = p->flow[k], now = p->strain[k] + flow;
            const double hardening = solid->b * p->softening[k] * power(now, solid->n);
            const double stress = solid->a * p->softening[k] + hardening;
            const double hastening = johnson_cook_hastening(solid, flow / dt);
            const double over = p->trial[k] - triple * flow - stress * hastening;
            const double left_of = flow >= kink ? solid->c : 0.0,
                         right_of = flow > kink ? solid->c : 0.0;
            const double hasty = over > 0.0 ? left_of : right_of;
            const double slope = hardening * solid->n / now * hastening + stress * hasty / flow;
            const double low = maximum(0.05 * flow, flow > kink ? kink : 0.0);
            const double high = flow < kink ? kink : (double)INFINITY;
            const double next = minimum(maximum(flow + over / (triple + slope), low), high);
            const double change = fabs(next - flow);
            p->flow[k] = going[k] ? next : flow;
            /* the error left is about the square of this */
            going[k] &= change > 1e-4 * next;
            left += going[k];
        }
    }
    for (int k = 0; k < count; k++)
        p->stress[k] = p->trial[k] - triple * p->flow[k];
}

/* The same by one evaluation. */
BOLIDE_INLINE void johnson_cook_flow_once(const struct strength_johnson_cook *solid, int count,
                                          double dt, struct johnson_cook_points *p)
{
    for (int k = 0; k < count; k++) {
        const double low = p->strain[k] + 1e-4,
                     slope = solid->b * power(low, solid->n) * solid->n / low, /* B n eps^(n-1) */
            flow = (p->trial[k] - p->yield[k]) / (3.0 * solid->shear_modulus + slope);
        const double stress = johnson_cook_slow(solid, p->strain[k] + flow, p->softening[k]) *
                              johnson_cook_hastening(solid, flow / dt);
        p->flow[k] = flow;
        p->stress[k] = minimum(stress, p->trial[k]);
    }
}

BOLIDE_INLINE void strength_johnson_cook(const struct strength_johnson_cook *solid,
                                         const struct motion *motion, double bulk_modulus,
                                         struct point *point)
{
    (void)bulk_modulus;
    struct sym3 s = strength_elastic(solid->shear_modulus, motion, point->deviator);
    const double bearing = johnson_cook_bearing(solid, point->history[HISTORY_damage]);
    double trial = sym3_mises(s);
    double strain = johnson_cook_hardened(point->history[HISTORY_plastic_strain], bearing);
    double softening =
        johnson_cook_softening(solid, point->history[HISTORY_plastic_heating]) * bearing;
    double yield = johnson_cook_slow(solid, strain, softening);
    point->deviator = s;
    if (solid->return_map == JOHNSON_COOK_EXPLICIT)
        yield *= johnson_cook_hastening(solid, strength_strain_rate(motion->strain_rate));
    if (!(trial > yield))
        return;
    struct johnson_cook_points one = {{trial}, {strain}, {yield}, {softening}, {0.0}, {0.0}};
    if (solid->return_map == JOHNSON_COOK_EXPLICIT)
        johnson_cook_flow_once(solid, 1, motion->dt, &one);
    else
        johnson_cook_flow(solid, 1, motion->dt, &one);
    const double flow = one.flow[0], stress = one.stress[0];
    point->deviator = sym3_scale(stress / trial, s);
    point->history[HISTORY_plastic_strain] += flow;
    if (johnson_cook_softens(solid))
        point->history[HISTORY_plastic_heating] +=
            stress * flow / (motion->density * solid->capacity);
}

/* Points of a batch, before they are put side by side: see johnson_cook_points. */
struct johnson_cook_batch {
    double trial[BATCH], strain[BATCH], yield[BATCH], softening[BATCH], flow[BATCH], stress[BATCH];
};

/* What points flow that flow at all: those are put side by side. */
BOLIDE_INLINE void johnson_cook_batch_flow(const struct strength_johnson_cook *solid,
                                           const struct batch *b, struct johnson_cook_batch *of)
{
    int flowing[BATCH + LANES], count = 0;
    for (int k = 0; k < b->count; k++) {
        flowing[count] = k;
        count += of->trial[k] > of->yield[k];
    }
    if (count == 0)
        return;
    for (int lane = 0; lane < LANES; lane++)
        flowing[count + lane] = flowing[count - 1];
    for (int first = 0; first < count; first += LANES) {
        const int *at = flowing + first;
        struct johnson_cook_points p;
        for (int lane = 0; lane < LANES; lane++) {
            p.trial[lane] = of->trial[at[lane]];
            p.strain[lane] = of->strain[at[lane]];
            p.yield[lane] = of->yield[at[lane]];
            p.softening[lane] = of->softening[at[lane]];
        }
        if (solid->return_map == JOHNSON_COOK_EXPLICIT)
            johnson_cook_flow_once(solid, LANES, b->dt, &p);
        else
            johnson_cook_flow(solid, LANES, b->dt, &p);
        for (int lane = 0; lane < LANES; lane++) {
            of->flow[at[lane]] = p.flow[lane];
            of->stress[at[lane]] = p.stress[lane];
        }
    }
}

BOLIDE_INLINE void strength_johnson_cook_batch(const struct strength_johnson_cook *solid,
                                               struct batch *b)
{
    struct johnson_cook_batch of;
    const bool softens = johnson_cook_softens(solid);
    for (int k = 0; k < b->count; k++) {
        const struct motion motion = batch_motion(b, k);
        const struct sym3 s =
            strength_elastic(solid->shear_modulus, &motion, batch_tensor(b->deviator, k));
        batch_keep_tensor(b->new_deviator, k, s);
        of.trial[k] = of.stress[k] = sym3_mises(s);
        of.strain[k] = b->plastic_strain[k];
        of.softening[k] = 1.0;
        of.flow[k] = 0.0;
    }
    if (softens)
        for (int k = 0; k < b->count; k++)
            of.softening[k] = johnson_cook_softening(solid, b->plastic_heating[k]);
    for (int k = 0; k < b->count && solid->weakening > 0.0; k++) {
        const double bearing = johnson_cook_bearing(solid, b->damage[k]);
        of.strain[k] = johnson_cook_hardened(b->plastic_strain[k], bearing);
        of.softening[k] *= bearing;
    }
    for (int k = 0; k < b->count; k++)
        of.yield[k] = johnson_cook_slow(solid, of.strain[k], of.softening[k]);
    if (solid->return_map == JOHNSON_COOK_EXPLICIT)
        for (int k = 0; k < b->count; k++)
            of.yield[k] *= johnson_cook_hastening(
                solid, strength_strain_rate(batch_tensor(b->strain_rate, k)));
    johnson_cook_batch_flow(solid, b, &of);
    for (int k = 0; k < b->count; k++) {
        const double share = of.flow[k] > 0.0 ? of.stress[k] / of.trial[k] : 1.0;
        batch_keep_tensor(b->new_deviator, k, sym3_scale(share, batch_tensor(b->new_deviator, k)));
        b->plastic_strain[k] += of.flow[k];
        if (softens)
            b->plastic_heating[k] +=
                of.stress[k] * of.flow[k] / (b->new_density[k] * solid->capacity);
    }
}

BOLIDE_INLINE void strength_johnson_cook_weaken(struct strength_johnson_cook *solid,
                                                double weakening)
{
    solid->weakening = weakening;
}

BOLIDE_INLINE void strength_johnson_cook_melt(struct strength_johnson_cook *solid, double left)
{
    solid->shear_modulus *= left;
    solid->a *= left;
    solid->b *= left;
}

/* Softening needs both temperatures and the capacity. */
BOLIDE_INLINE struct strength_traits strength_johnson_cook_traits(
    const struct strength_johnson_cook *solid)
{
    struct strength_traits traits = strength_default_traits();
    traits.batched = traits.weakened = traits.melts = true;
    traits.capacity = solid->capacity;
    if (!johnson_cook_softens(solid))
        return traits;
    traits.history = HISTORY_BIT(plastic_heating);
    traits.melting_heat = solid->capacity * (solid->melt - solid->room);
    if (isnan(solid->melt) || isnan(solid->capacity)) {
        traits.wrong = "m needs this beside it";
        traits.wrong_key = isnan(solid->melt) ? "melt" : "capacity";
    } else if (!(solid->melt > solid->room)) {
        traits.wrong = "this is not above `room`";
        traits.wrong_key = "melt";
    }
    return traits;
}

#endif
