/* The interface of two materials by massless markers that the gas carries, for Lax-Wendroff.
 * Source: Cui, dissertation (2014), 3.3 and 3.4.4, (3-9)-(3-13) and (3-21)-(3-28), restored.
 *
 * A cell with markers of one material is pure, and one with markers of both is mixed: theta_1 and
 * theta_2 are the volumes that its markers stand for, and its materials have one pressure and
 * specific energies that grow by their fractions of volume,
 *
 *   p = f_1(rho_1, e_1) = f_2(rho_2, e_2)   rho_1 theta_1 + rho_2 theta_2 = rho
 *   e_r = e_r of the last step + theta_r de
 *
 * as printed, which does not conserve energy; the default multiplies both e_r by the factor with
 * which rho_1 theta_1 e_1 + rho_2 theta_2 e_2 = rho e. A cell that becomes pure keeps its mass,
 * momentum and energy: the masses of materials are not conserved, their sum is. Private to gas/. */
#ifndef BOLIDE_GAS_MARKERS_H
#define BOLIDE_GAS_MARKERS_H

#include "gas/gas_internal.h"

enum gas_mixing { MIXING_CONSERVATIVE, MIXING_PRINTED };

struct gas_marker {
    double at[3];   /* m */
    double second;  /* 1: of the second material, 0: of the first */
    double volume;  /* that it stands for in this step */
    double deleted; /* 1: it is */
};

struct gas_markers {
    struct gas_marker *marker;
    int64_t count, capacity;
    int64_t cells;     /* of the domain, all of them */
    int32_t *cell;     /* of each place of the domain, x fastest */
    int8_t *near;      /* of each place: it is near the interface */
    double *energy[2]; /* of each cell of the store: e_r of a mixed cell, J/kg */
    double *before;    /* of each cell: rho e / rho of the last step */
    double *volume[2]; /* of each place: of its markers */
};

/* The state of a mixed cell: what its materials have at one pressure. */
struct gas_mixed {
    double density[2], energy[2], pressure;
};

/* Of materials EOS with fractions THETA of the volume and specific energies ENERGY in a cell of
 * DENSITY and specific energy OF_CELL. */
struct gas_mixed gas_mix(const struct eos eos[2], const double theta[2], const double energy[2],
                         double density, double of_cell, int mixing);

/* With Gamma = p/(rho e) energies must count from cold gas that fills all space, not from an
 * explosive at rest: the equations of state become such, and `heat` of the solver is what energies
 * are higher by, until the run ends. */
void gas_count_heat(struct gas *gas);

/* Memory for markers, and markers in cells near the interface as the bodies of the case have
 * them. */
struct error *gas_make_markers(struct gas *gas);
void gas_free_markers(struct gas *gas);

/* Carries the markers over DT with the velocities at its start, and finds the state of all cells
 * with markers. */
struct error *gas_move_markers(struct gas *gas, const struct simulation *simulation, double dt);

/* The arrays of a checkpoint. */
struct error *gas_visit_markers(struct gas *gas, struct visitor *visitor);

#endif
