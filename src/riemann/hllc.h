/* The Riemann problem of two elastic, perfectly plastic solids in three steps, each side with an
 * elastic and, where it yields, a plastic wave: elastic contact (7); deviator behind it (9), at
 * most at yield (10), (11), and the state at the elastic limit (12); contact of these by the waves
 * that follow (13)-(15). Along the axis from left to right, tension positive:
 *
 *   c_E^2 = p_rho - (sigma/rho^2) p_e + 4 mu/(3 rho)     (6a)
 *   c_P^2 = c_E^2 - 3 mu S^2/(rho Y^2)                   (6b) at yield, S = -+2Y/3: c_E^2 less 4 mu/(3 rho)
 *
 * Source: Wang et al., Explosion and Shock Waves 44 (2024) 081431; numbers are its equations. */
#ifndef BOLIDE_RIEMANN_HLLC_H
#define BOLIDE_RIEMANN_HLLC_H

#include "base/exponential.h"
#include "riemann/side.h"

/* One side: density, velocity, stress sigma = S - p and its deviator S along the axis, (dp/drho)_e,
 * (dp/de)_rho, shear modulus and yield stress as they stand, both zero for a fluid. SI units. */
struct elastic_side {
    double density, velocity, stress, deviator, dp_drho, dp_de, shear_modulus, yield;
};

/* A wave of impedance rho c into a state. */
struct elastic_wave {
    double impedance, velocity, stress;
};

/* (7), (15) by means and differences, so that equal states give themselves and mirrored ones a
 * mirror image, to the bit. */
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

/* The square of the impedance rho c by the bulk speed, under STRESS. */
BOLIDE_INLINE double hllc_bulk(struct elastic_side side, double stress)
{
    return square(side.density) * side.dp_drho - stress * side.dp_de;
}

BOLIDE_INLINE struct elastic_wave hllc_elastic(struct elastic_side side)
{
    double bulk = hllc_bulk(side, side.stress);
    double shear = 4.0 / 3.0 * side.shear_modulus * side.density;
    struct elastic_wave wave = {sqrt(maximum(bulk + shear, 0.0)), side.velocity, side.stress};
    return wave;
}

/* How far an elastic contact takes a side: by how much the volume behind its wave changes, times Z
 * over the volume, and which way; what the deviator has left until yield there. */
struct elastic_reach {
    double change, towards, left;
};

/* WAY is -1 for the left side, 1 for the right. */
BOLIDE_INLINE struct elastic_reach hllc_reach(struct elastic_side side, struct contact contact,
                                              double way)
{
    struct elastic_reach reach;
    reach.change = side.density * (way * (side.velocity - contact.velocity));
    reach.towards = reach.change < 0.0 ? -1.0 : 1.0;
    reach.left = reach.towards * (2.0 / 3.0 * side.yield) - side.deviator;
    return reach;
}

/* What runs into the contact behind the elastic wave: the plastic wave on a side that yields, the
 * elastic one on the others, on a fluid, and where the elastic contact would leave no volume. */
BOLIDE_INLINE struct elastic_wave hllc_second(struct elastic_side side, struct elastic_wave elastic,
                                              struct contact contact, double way)
{
    struct elastic_reach reach = hllc_reach(side, contact, way);
    double per_stress = side.shear_modulus > 0.0 ? 0.75 / side.shear_modulus : 0.0;
    double at_limit = elastic.impedance * exponential(per_stress * reach.left); /* (11) */
    double behind = elastic.impedance + reach.change;
    /* (9), (10); nested minima, since branches here would keep a loop from becoming vectors */
    double beyond = minimum(minimum(side.yield * side.shear_modulus, behind),
                            reach.towards * (behind - at_limit));
    double push = (elastic.impedance - at_limit) * (1.0 / side.density); /* (12) */
    double bulk = hllc_bulk(side, side.stress + reach.left);
    struct elastic_wave second;
    second.impedance = beyond > 0.0 ? sqrt(maximum(bulk, 0.0)) : elastic.impedance;
    second.velocity = side.velocity + (beyond > 0.0 ? way * push : 0.0);
    second.stress = side.stress - (beyond > 0.0 ? elastic.impedance * push : 0.0);
    return second;
}

/* Positive unless the side is certain to stay elastic: |e^x - 1| >= |x| - x^2/2 where x goes
 * towards yield; times mu^2. */
BOLIDE_INLINE double hllc_doubt(struct elastic_side side, struct elastic_wave elastic,
                                struct contact contact, double way)
{
    struct elastic_reach reach = hllc_reach(side, contact, way);
    double mu = side.shear_modulus, left = 0.75 * reach.left;
    return reach.towards * (square(mu) * reach.change - elastic.impedance * mu * left) +
           0.5 * elastic.impedance * square(left);
}

BOLIDE_INLINE struct contact riemann_hllc(struct elastic_side left, struct elastic_side right)
{
    struct elastic_wave l = hllc_elastic(left), r = hllc_elastic(right);
    struct contact elastic = hllc_contact(l, r);
    return hllc_contact(hllc_second(left, l, elastic, -1.0), hllc_second(right, r, elastic, 1.0));
}

/* What of it is certain without plastic waves: the elastic contact, and whether a side may yield:
 * doubt > 0. */
struct elastic_contact {
    struct contact contact;
    double doubt;
};

BOLIDE_INLINE struct elastic_contact riemann_hllc_elastic(struct elastic_side left,
                                                          struct elastic_side right)
{
    struct elastic_wave l = hllc_elastic(left), r = hllc_elastic(right);
    struct elastic_contact elastic;
    elastic.contact = hllc_contact(l, r);
    elastic.doubt = maximum(hllc_doubt(left, l, elastic.contact, -1.0),
                            hllc_doubt(right, r, elastic.contact, 1.0));
    return elastic;
}

#endif
