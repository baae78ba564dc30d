/* The heat loop: conduction between a particle and its neighbours.
 *
 *   dE_i/dt = -(1/rho_i) sum V_j W'_ij k_ij (T_j - T_i)/r_ij,   V = m/rho
 *
 *   contact   k = 2 lambda_i lambda_j (1 + s)/(lambda_i + lambda_j s), s = sqrt(a_i/a_j)     (1.53)
 *   harmonic  k = 4 lambda_i lambda_j/(lambda_i + lambda_j)                                  (1.48)
 *
 * with the diffusivity a = lambda/(rho C_V) (1.52). k is symmetric, so that what one particle of a
 * pair gains the other loses. A neighbour is seen through its record alone:
 *   x [y [z]]  diameter  volume  temperature  conductivity  sqrt(a)  [depth]
 * Where particles of the plane have a depth d, the radius of axisymmetry or the thickness of a
 * plate, the volume is the area A = m/(rho d) of a section, and the sum -1/(rho_i d_i) sum A_j w
 * W'_ij k_ij (T_j - T_i)/r_ij with the depth w = |d_i + d_j|/2 of the pair. Source: Parshikov
 * (2013), section 1.3; (1.48) after Cleary and Monaghan, J. Comput. Phys. 148 (1999) 227. */
#ifndef BOLIDE_SPH_HEAT_KERNEL_H
#define BOLIDE_SPH_HEAT_KERNEL_H

#include "particle/neighbours.h"

enum heat_form {
    HEAT_CONTACT,  /* the contact temperature of the decaying jump */
    HEAT_HARMONIC, /* equal fluxes from both centres: Cleary and Monaghan */
};

/* Doubles from one record to the next: a cache line. */
enum { HEAT_STRIDE = 8 };

/* Offsets in a record, behind position and diameter. */
BOLIDE_INLINE int heat_record_volume(int dimension) { return dimension + 1; }
BOLIDE_INLINE int heat_record_temperature(int dimension) { return dimension + 2; }
BOLIDE_INLINE int heat_record_conductivity(int dimension) { return dimension + 3; }
BOLIDE_INLINE int heat_record_diffusivity(int dimension) { return dimension + 4; }
BOLIDE_INLINE int heat_record_depth(int dimension) { return dimension + 5; }

/* k of a pair, W/(m K), from conductivities and roots of diffusivities; zero where one of the two
 * conducts no heat. The bits do not depend on which is which. */
BOLIDE_INLINE double heat_pair_conductivity(enum heat_form form, double conductivity_i,
                                            double root_i, double conductivity_j, double root_j)
{
    double both = 2.0 * (conductivity_i * conductivity_j);
    if (form == HEAT_HARMONIC)
        return 2.0 * both / maximum(conductivity_i + conductivity_j, 1e-200);
    return both * (root_i + root_j) /
           maximum(conductivity_i * root_j + conductivity_j * root_i, 1e-200);
}

/* What instantiates a kernel. */
struct heat_kind {
    int dimension;
    bool depth; /* particles have one; dimension is 2 */
    enum heat_form form;
};

struct heat_loop {
    struct heat_kind kind;
    const double *record; /* owned, ghosts, and one of zeros behind them */
    int32_t empty;        /* index of the record of zeros */
    double smoothing;     /* alpha: h = alpha (D_i + D_j)/2 (1.19) */
    const struct neighbours *neighbours;
    const double *density;
    double *rate; /* dE/dt, W/kg */
};

/* Fills the rates of particles begin .. end - 1 with the best instruction set of this processor. */
void heat_loop_run(const struct heat_loop *loop, int32_t begin, int32_t end);

#endif
