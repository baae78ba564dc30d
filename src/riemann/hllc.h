/* The contact problem of two elastic, perfectly plastic solids in three steps, each side with an elastic and, where
 * it yields, a plastic wave: elastic contact (7); deviator behind it (9), at most at yield (10), (11), and the
 * state at the elastic limit (12); contact of these by the waves that follow (13)-(15). Along the axis from left
 * to right, tension positive:
 *
 *   c_E^2 = p_rho - (sigma/rho^2) p_e + 4 mu/(3 rho)     (6a)
 *   c_P^2 = c_E^2 - 3 mu S^2/(rho Y^2)                   (6b) at yield, S = -+2Y/3: c_E^2 less 4 mu/(3 rho)
 *
 * Source: Wang et al., Explosion and Shock Waves 44 (2024) 081431; numbers are its equations. */
#ifndef BOLIDE_RIEMANN_HLLC_H
#define BOLIDE_RIEMANN_HLLC_H

#include "base/exponential.h"
#include "riemann/side.h"

/* One side: density, velocity, stress sigma = S - p and its deviator S along the axis, (dp/drho)_e, (dp/de)_rho,
 * shear modulus and yield stress as they stand, both zero for a fluid. SI units. */
struct elastic_side {
    double density, velocity, stress, deviator, dp_drho, dp_de, shear_modulus, yield;
};

/* A wave of impedance rho c into a state. */
struct elastic_wave {
    double impedance, velocity, stress;
};

/* (7), (15) by means and differences, so that equal states give themselves and a mirror mirrors, to the bit. */
BOLIDE_INLINE struct contact hllc_contact(struct elastic_wave left, struct elastic_wave right)
{
    struct contact contact;
    double inverse = 1.0 / (left.impedance + right.impedance);
    double lean = 0.5 * (right.impedance - left.impedance) * inverse;
    double apart = right.velocity - left.velocity, rise = right.stress - left.stress;
    contact.velocity = 0.5 * (left.velocity + right.velocity) + (lean * apart + inverse * rise);
    contact.stress = 0.5 * (left.stress + right.stress) +
                     (left.impedance * right.impedance * inverse * apart - lean * rise);
    return contact;
}

/* The square of the sound speed without shear, under STRESS. */
BOLIDE_INLINE double hllc_bulk(struct elastic_side side, double volume, double stress)
{
    return side.dp_drho - stress * side.dp_de * square(volume);
}

BOLIDE_INLINE struct elastic_wave hllc_elastic(struct elastic_side side)
{
    double volume = 1.0 / side.density;
    double square_of_speed =
        hllc_bulk(side, volume, side.stress) + 4.0 / 3.0 * side.shear_modulus * volume;
    struct elastic_wave wave = {side.density * sqrt(maximum(square_of_speed, 0.0)), side.velocity,
                                side.stress};
    return wave;
}

/* How far an elastic contact takes a side: Z times the volume behind its wave, which way, the deviator at yield there,
 * and the logarithm of the volume at yield over that of the side (11). */
struct elastic_reach {
    double volume, towards, limit, strain;
};

/* WAY is -1 for the left side, 1 for the right. */
BOLIDE_INLINE struct elastic_reach hllc_reach(struct elastic_side side, struct elastic_wave elastic,
                                              struct contact contact, double way)
{
    double spread = way * (side.velocity - contact.velocity);
    struct elastic_reach reach;
    reach.volume = elastic.impedance / side.density + spread;
    reach.towards = spread < 0.0 ? -1.0 : 1.0;
    reach.limit = reach.towards * (2.0 / 3.0 * side.yield);
    reach.strain =
        side.shear_modulus > 0.0 ? 0.75 / side.shear_modulus * (reach.limit - side.deviator) : 0.0;
    return reach;
}

/* By how much, times Z, the elastic contact goes beyond yield (9), (10) where the volume at yield is RATIO times that
 * of the side; not positive where it does not, where it would leave no volume, and for a fluid. */
BOLIDE_INLINE double hllc_beyond(struct elastic_side side, struct elastic_wave elastic,
                                 struct elastic_reach reach, double ratio)
{
    double beyond = reach.towards * (reach.volume - elastic.impedance * ratio / side.density);
    beyond = reach.volume > 0.0 ? beyond : 0.0;
    return side.yield * side.shear_modulus > 0.0 ? beyond : 0.0;
}

/* What runs into the contact behind the elastic wave: the plastic wave on a side that yields, else the elastic one. */
BOLIDE_INLINE struct elastic_wave hllc_second(struct elastic_side side, struct elastic_wave elastic,
                                              struct contact contact, double way)
{
    struct elastic_reach reach = hllc_reach(side, elastic, contact, way);
    double ratio = exponential(reach.strain), volume = 1.0 / side.density;
    double beyond = hllc_beyond(side, elastic, reach, ratio);
    double push = elastic.impedance * (volume - volume * ratio); /* (12) */
    double bulk = hllc_bulk(side, volume, side.stress + (reach.limit - side.deviator));
    struct elastic_wave second;
    second.impedance = beyond > 0.0 ? side.density * sqrt(maximum(bulk, 0.0)) : elastic.impedance;
    second.velocity = side.velocity + (beyond > 0.0 ? way * push : 0.0);
    second.stress = side.stress - (beyond > 0.0 ? elastic.impedance * push : 0.0);
    return second;
}

/* Positive unless the side is certain to stay elastic: e^x lies beyond 1 + x + x^2/2, as seen from one. */
BOLIDE_INLINE double hllc_doubt(struct elastic_side side, struct elastic_wave elastic,
                                struct contact contact, double way)
{
    struct elastic_reach reach = hllc_reach(side, elastic, contact, way);
    double ratio = 1.0 + reach.strain * (1.0 + 0.5 * reach.strain);
    return hllc_beyond(side, elastic, reach, ratio);
}

BOLIDE_INLINE struct contact riemann_hllc(struct elastic_side left, struct elastic_side right)
{
    struct elastic_wave l = hllc_elastic(left), r = hllc_elastic(right);
    struct contact elastic = hllc_contact(l, r);
    return hllc_contact(hllc_second(left, l, elastic, -1.0), hllc_second(right, r, elastic, 1.0));
}

/* The same where neither side yields; *DOUBT is positive where one may. */
BOLIDE_INLINE struct contact riemann_hllc_elastic(struct elastic_side left,
                                                  struct elastic_side right, double *doubt)
{
    struct elastic_wave l = hllc_elastic(left), r = hllc_elastic(right);
    struct contact elastic = hllc_contact(l, r);
    *doubt = maximum(hllc_doubt(left, l, elastic, -1.0), hllc_doubt(right, r, elastic, 1.0));
    return elastic;
}

#endif
