/* States of the cells of a row and on one side of its faces: primitive numbers, their limited
 * differences, and the sides that Riemann solvers take. */
#ifndef BOLIDE_GAS_STATES_H
#define BOLIDE_GAS_STATES_H

#include "gas/row.h"
#include "riemann/gas_solvers.h"

/* Primitive numbers of a row. */
enum { PRIMITIVE_DENSITY, PRIMITIVE_VELOCITY, PRIMITIVE_PRESSURE = 4 };

/* States in cells or on one side of faces: primitive numbers, specific energy, J/kg, sound
 * speed. */
struct row_states {
    struct gas_numbers of;
    double energy[ROW_ROOM], sound[ROW_ROOM];
    /* of cells where floors count: by how much one raises the pressure, Pa, and in cells of both
     * materials the energy that the liquid lacks for it, J/kg of it */
    double lift[ROW_ROOM], lacks[ROW_ROOM];
};

/* How far density and specific energy may fall at once: the density to this part of itself, the
 * energy by as much of what an ideal gas of the same sound speed c and G = (dp/de)/rho has, c^2/(G
 * (G + 1)). */
static const double GAS_LEAST = 0.2;

/* The limited difference over a cell between differences to its neighbours: van Leer's harmonic
 * mean. */
BOLIDE_INLINE double limited(double past, double next)
{
    const double product = past * next;
    return product > 0.0 ? 2.0 * product / (past + next) : 0.0;
}

/* Where the numbers of a row along an axis are: normal first. */
struct gas_axes {
    int normal, across[2];
};

BOLIDE_INLINE struct gas_axes gas_axes_of(int axis)
{
    const struct gas_axes axes = {axis, {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2}};
    return axes;
}

BOLIDE_INLINE struct gas_side gas_side_of(const struct row_states *states, struct gas_axes axes,
                                          int k)
{
    struct gas_side side;
    side.density = states->of.of[PRIMITIVE_DENSITY][k];
    side.surplus = 0.0;
    side.normal = states->of.of[PRIMITIVE_VELOCITY + axes.normal][k];
    for (int n = 0; n < 2; n++)
        side.across[n] = states->of.of[PRIMITIVE_VELOCITY + axes.across[n]][k];
    side.pressure = states->of.of[PRIMITIVE_PRESSURE][k];
    side.energy = states->energy[k];
    side.sound = states->sound[k];
    return side;
}

BOLIDE_INLINE void row_put_flow(struct gas_flow flow, struct gas_axes axes, int k,
                                struct gas_numbers *flux)
{
    flux->of[GAS_DENSITY][k] = flow.mass;
    flux->of[GAS_MOMENTUM + axes.normal][k] = flow.normal;
    flux->of[GAS_MOMENTUM + axes.across[0]][k] = flow.across[0];
    flux->of[GAS_MOMENTUM + axes.across[1]][k] = flow.across[1];
    flux->of[GAS_ENERGY][k] = flow.energy;
}

/* Fluxes through the faces 0 .. cells, between states LOW and HIGH, whose surplus (gas_side.h) is
 * zero where SURPLUS is NULL. */
BOLIDE_INLINE void row_fluxes(const struct gas_row *row, const struct row_states *low,
                              const struct row_states *high, double (*surplus)[ROW_ROOM],
                              struct gas_numbers *flux)
{
    const struct gas_axes axes = gas_axes_of(row->axis);
    switch (row->riemann) {
#define FLUX_CASE(name)                                                                    \
    case GAS_RIEMANN_##name:                                                               \
        ROWS_APART                                                                         \
        FOR_ROW (k, 0, row->cells) {                                                       \
            struct gas_side l = gas_side_of(low, axes, k), h = gas_side_of(high, axes, k); \
            l.surplus = surplus ? surplus[0][k] : 0.0;                                     \
            h.surplus = surplus ? surplus[1][k] : 0.0;                                     \
            row_put_flow(gas_riemann_##name(l, h), axes, k, flux);                         \
        }                                                                                  \
        break;
        GAS_RIEMANN_LIST(FLUX_CASE)
#undef FLUX_CASE
    default:
        break;
    }
}

/* Whether a strong shock along another axis than that of ROW is in cell K, as sweeps along that
 * left it. */
BOLIDE_INLINE bool row_shock_across(const struct gas_row *row, int k)
{
    return ((int)row->shock[k] & ~(1 << row->axis)) != 0;
}

#endif
