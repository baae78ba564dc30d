/* What the kernels of all schemes have in common: what the record of a neighbour begins with, and
 * the sums over pairs. */
#ifndef BOLIDE_SPH_LAYOUT_H
#define BOLIDE_SPH_LAYOUT_H

#include "base/base.h"

/* Offsets in a record, in doubles: position first, then these, then stress as far as the scheme has
 * it: sigma_xx alone for fluids and in 1-D, (xx, yy, xy) in 2-D, (xx, yy, zz, xy, yz, zx) in 3-D.
 */
BOLIDE_INLINE int record_diameter(int dimension) { return dimension; }
BOLIDE_INLINE int record_volume(int dimension) { return dimension + 1; }
BOLIDE_INLINE int record_velocity(int dimension) { return dimension + 2; }
BOLIDE_INLINE int record_stress(int dimension) { return 2 * dimension + 2; }
BOLIDE_INLINE int record_stresses(int dimension, bool shear)
{
    return !shear || dimension == 1 ? 1 : dimension == 2 ? 3 : 6;
}

/* Pair sums of particle i that every scheme gives, with V = m/rho, W' = dW/dr, e from i to j, and
 * U*, t* = sigma*.e velocity and traction of the contact. With a depth d (a radius or a thickness),
 * V is the area A = m/(rho d) of a section and w = |d_i + d_j|/2 the depth of a pair: the sums of
 * forces then read -2/(rho d_i) sum A_j w W' ... */
struct pair_rates {
    double (*acceleration)[3]; /* -(2/rho) sum V W' t*                (1.39), m/s^2 */
    double *power;             /* -(2/rho) sum V W' t*.(U* - U)       (1.40) less U.(1.39), W/kg */
    double (*strain_rate)[6];  /* symmetric part of dU^a/dx^b = 2 sum V W' (U - U*)^a e^b, 1/s */
    double (*spin)[3];         /* half the curl of U (1.57), (1.58), rad/s */
    double (*wall)[3];  /* the part of the acceleration due to mirror images; NULL without walls */
    double (*drift)[3]; /* sum V W' (U* - U) / sum V W', m/s; NULL unless particles move with it */
    /* Axisymmetry, NULL otherwise: g = -2 sum A_j (w - d_i) W' e_x, the part of the hoop stress
     * that pulls inwards, and k = -sum A_j (x_j - x_i) W' e_x, the part of u/r that is hoop strain
     * rate; both are one in the continuum. Both include (k+ - k-)^2/k, k+ and k- the parts of k due
     * to neighbours outside and inside: what a free surface lacks on one side. */
    double *hoop_pull, *hoop_strain;
    double *broken; /* share of the contacts that are broken, by V W'; NULL unless contacts break */
};

/* How the volumes about a particle fill space, in 2-D and 3-D (muscl/rates.h): at the start, one at
 * least; what they do beyond, and its mean over the neighbours; by how much density has grown for
 * it. And how thinly neighbours stand on some axis, at the start and now. */
enum {
    PACKING_START,
    PACKING_EXCESS,
    PACKING_MEAN,
    PACKING_GROWTH,
    PACKING_THIN_START,
    PACKING_THIN,
    PACKING_NUMBERS
};

/* How the volume of a particle follows from the places of its neighbours. In a step
 * dt it grows by (1 + dt I1 + dt^2 I2 + dt^3 I3) exp(dt X): the invariants of the gradient of the
 * velocities that particles move with, and the exchange. And the share that this has in the growth,
 * beside that of the velocities of contacts. */
enum { VOLUME_SHARE, VOLUME_FIRST, VOLUME_SECOND, VOLUME_THIRD, VOLUME_EXCHANGE, VOLUME_NUMBERS };

#endif
