/* The Riemann problem of two ideal gases, exactly: waves of gas_wave.h on both sides, p* by
 * Newton's method. `shock_slope` of a side is its ratio of specific heats. Where the gases part
 * faster than both can expand, a vacuum opens: no stress, and each side moves at its own speed of
 * escape. */
#ifndef BOLIDE_RIEMANN_EXACT_GAS_H
#define BOLIDE_RIEMANN_EXACT_GAS_H

#include "material/gas_wave.h"
#include "riemann/acoustic.h"

/* The contact as the left side sees it. */
BOLIDE_INLINE struct contact riemann_exact_gas(struct side left, struct side right)
{
    struct contact contact = riemann_acoustic(left, right);
    double cl = left.impedance / left.density, cr = right.impedance / right.density;
    double pl = -left.stress, pr = -right.stress, apart = right.velocity - left.velocity;
    double escape = 2.0 * cl / (left.shock_slope - 1.0);
    if (apart >= escape + 2.0 * cr / (right.shock_slope - 1.0)) {
        contact.velocity = left.velocity + escape;
        contact.stress = 0.0;
        return contact;
    }
    /* The velocities' difference is increasing and concave in p*: after one step to the left of the
     * root, Newton's steps rise to it. */
    double least = pl < pr ? pl : pr;
    double p = maximum(-contact.stress, 1e-6 * least);
    for (int k = 0; k < 60; k++) {
        struct gas_push l = gas_wave_push(left.density, pl, cl, left.shock_slope, p);
        struct gas_push r = gas_wave_push(right.density, pr, cr, right.shock_slope, p);
        double next = p - (apart + (l.value + r.value)) / (l.slope + r.slope);
        next = maximum(next, 1e-3 * p);
        double moved = fabs(next - p);
        p = next;
        if (moved <= 4e-16 * p)
            break;
    }
    struct gas_push l = gas_wave_push(left.density, pl, cl, left.shock_slope, p);
    struct gas_push r = gas_wave_push(right.density, pr, cr, right.shock_slope, p);
    contact.velocity = 0.5 * ((left.velocity - l.value) + (right.velocity + r.value));
    contact.stress = -p;
    return contact;
}

#endif
