/* The pair loops of SPH with corrected kernel gradients, by elastic-plastic Riemann problems
 * (`hllc`) or with artificial viscosity (`monaghan`). Two passes over the rows a stage: gradients
 * with L_i = [sum V_j x_ij (x) grad W]^-1, then forces, each with records of its own:
 *
 *   x [y]  diameter  volume  u [v]  [density pressure deviator: 1-D]                    gradients
 *   x [y]  diameter  volume  u [v]  density  stress  L  pressure p_rho p_e mu Y         forces, hllc
 *                                           density  stress  L  sound                           forces, monaghan
 *     [material  rates of strain  [gradients of density, pressure, deviator: 1-D]]
 *
 * where stress, L and rates of strain are xx in 1-D, (xx, yy, xy) in 2-D. Compiled for several
 * instruction sets with the same bits. Source: Wang et al., Explosion and Shock Waves 44 (2024)
 * 081431, (2), (16), (17), (20), (21). */
#ifndef BOLIDE_SPH_HLLC_KERNEL_H
#define BOLIDE_SPH_HLLC_KERNEL_H

#include "particle/neighbours.h"

/* What instantiates a kernel. */
struct hllc_kind {
    int dimension;      /* 1 or 2 */
    bool viscous;       /* artificial viscosity in place of Riemann problems */
    bool reconstructed; /* contacts between linear reconstructions */
};

/* What a record holds more than the plain, in the order of the record. */
enum { HLLC_GRADIENT_STRIDE = 8 };
BOLIDE_INLINE int hllc_tensor(int dimension) { return dimension * (dimension + 1) / 2; }
BOLIDE_INLINE int hllc_density(int dimension) { return 2 * dimension + 2; }
BOLIDE_INLINE int hllc_stress(int dimension) { return hllc_density(dimension) + 1; }
BOLIDE_INLINE int hllc_correction(int dimension)
{
    return hllc_stress(dimension) + hllc_tensor(dimension);
}
/* Of the material: pressure, p_rho, p_e, mu, Y, or the sound speed. */
BOLIDE_INLINE int hllc_response(int dimension)
{
    return hllc_correction(dimension) + hllc_tensor(dimension);
}
BOLIDE_INLINE int hllc_material(struct hllc_kind kind)
{
    return hllc_response(kind.dimension) + (kind.viscous ? 1 : 5);
}
BOLIDE_INLINE int hllc_strain(struct hllc_kind kind) { return hllc_material(kind) + 1; }
BOLIDE_INLINE int hllc_slopes(struct hllc_kind kind)
{
    return hllc_strain(kind) + hllc_tensor(kind.dimension);
}
/* Doubles from one record of the forces to the next: whole cache lines. */
BOLIDE_INLINE int hllc_stride(struct hllc_kind kind)
{
    int used = !kind.reconstructed   ? hllc_material(kind)
               : kind.dimension == 1 ? hllc_slopes(kind) + 3
                                     : hllc_slopes(kind);
    return (used + 7) / 8 * 8;
}

/* What the passes find for particle i, with g = L_i grad_i W_ij. */
struct hllc_rates {
    double (*correction)[6];   /* L_i, as a symmetric tensor; one where its inverse is singular */
    double (*slopes)[3];       /* 1-D gradients of density, pressure, deviator; NULL: not wanted */
    double (*strain_rate)[6];  /* symmetric part of sum V_j (u_j - u_i) (x) g, 1/s */
    double (*spin)[3];         /* half the curl of u, rad/s */
    double *density_rate;      /* of the material in the plane, (2a), kg/m^3/s */
    double (*acceleration)[3]; /* (2b), m/s^2 */
    double *power;             /* (2c), W/kg */
    double (*wall)[3]; /* the part of the acceleration that images gave; NULL without walls */
};

/* What the options of a scheme choose in the forces, as numbers that select. */
struct hllc_selection {
    double others_share;  /* of L_j in the gradient of forces: 0 or 1/2 */
    double scalars_share; /* of the reconstruction of density, pressure, deviator: 0 or 1 */
    double parting;       /* Riemann problems below this speed of parting: 0 or infinite */
    double squares;       /* 1: stress over squares of density, 0: over their product */
    double alpha, beta;   /* of the viscosity (17) */
};

struct hllc_loop {
    struct hllc_kind kind;
    struct hllc_selection selection;
    const double *record; /* owned, ghosts, and one that adds nothing behind them */
    int32_t empty;
    double smoothing; /* h = smoothing (D_i + D_j)/2 */
    const struct neighbours *neighbours;
    bool by_mass; /* continuity by m_j in place of rho_i V_j */
    struct hllc_rates rates;
};

/* Each pass for particles begin .. end - 1, with the best instruction set of this processor. */
void hllc_find_gradients(const struct hllc_loop *loop, int32_t begin, int32_t end);
void hllc_find_forces(const struct hllc_loop *loop, int32_t begin, int32_t end);

#endif
