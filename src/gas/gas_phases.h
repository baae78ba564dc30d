/* What a coupling uses of the gas solver beside the functions of its class: the state of its cells,
 * and what passes through faces within its domain. */
#ifndef BOLIDE_GAS_PHASES_H
#define BOLIDE_GAS_PHASES_H

#include "gas/gas.h"
#include "gas/sweep.h"
#include "model/findings.h"

struct gas;

/* The cells and their state; pointers hold until the next step. */
struct gas_view {
    struct cell_blocks *cells;
    double *u[GAS_FIELDS]; /* as sweep.h has them; NULL: there is none */
    const struct gas_layout *layout;
    const struct eos *eos; /* of both materials, the same twice where there is one */
    const int *material;
    const double *heat; /* of both: what energies in cells are higher by than elsewhere, J/kg */
};
struct gas_view gas_view(const struct gas *gas);

/* Sweeps add to CUT, which must last, what passes through its faces; NULL: to nothing. */
void gas_watch(struct gas *gas, const struct gas_cut *cut);

/* Collective: finds what follows from the state of cells after a coupling has changed it; cells of
 * BLOCKS, a flag each, may have changed. ERROR_STATE: one is impossible. */
struct error *gas_refresh(struct gas *gas, const struct simulation *simulation, const bool *blocks);

/* Collective: all cells become those of the finest level. */
struct error *gas_refine(struct gas *gas, struct simulation *simulation);

/* Where markers divide two materials: none is left; there is one more at AT, of the second material
 * or of the first; cells get their states by all of them. Nothing happens where they do not. */
void gas_forget_markers(struct gas *gas);
struct error *gas_add_marker(struct gas *gas, const double at[3], bool second);
struct error *gas_settle_markers(struct gas *gas);

/* The fraction of volume of the second material of a cell, FRACTION, when both have come to one
 * pressure: the first without heat, the second, BURNT to this fraction, with the rest of the
 * energy. Masses and energies, those of the materials at rest, are per volume of the cell. */
double gas_relax(const struct eos eos[2], const double mass[2], const double energy[2],
                 double fraction, double burnt);

/* Finds rigid bodies that cells of EDGE do not see. */
void gas_judge_bodies(struct findings *findings, double edge);

/* The cells of PLACE at the start, before waves ask for finer ones, over those of one level; 1
 * where a case is wrong. */
double gas_part_of_cells(const struct place *place);

/* Whether the solver computes MATERIAL. */
bool gas_computes(const struct material *material);

#endif
