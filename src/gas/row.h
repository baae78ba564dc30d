/* A row of gas cells along an axis, on which the sweeps of split schemes work. Equations (2-49),
 * (2-50) of Cui, dissertation (2014): density, momentum and energy per volume,
 *
 *   U = (rho, rho u, E)   E = rho e + rho u^2/2   f = (rho u_n, rho u u_n + p n, (E + p) u_n)
 *
 * For files that are compiled once an instruction set: a loop here runs over the cells of a row. */
#ifndef BOLIDE_GAS_ROW_H
#define BOLIDE_GAS_ROW_H

#include "material/eos.h"

enum { GAS_DENSITY, GAS_MOMENTUM, GAS_ENERGY = 4, GAS_NUMBERS = 5 };

/* Cells of a row at most, and those known beyond either end of it. */
enum { ROW_CELLS = 64, ROW_GHOSTS = 3, ROW_ROOM = ROW_CELLS + 2 * ROW_GHOSTS };

/* Numbers of a row: cell c is at [c + ROW_GHOSTS], the face below it too. */
struct gas_numbers {
    double of[GAS_NUMBERS][ROW_ROOM];
};

struct gas_row {
    const struct eos *eos;
    int cells, axis; /* the axis that it runs along */
    struct gas_numbers u;
};

/* Where the cells or faces FIRST to LAST are in the numbers of a row. */
#define FOR_ROW(k, first, last) for (int k = (first) + ROW_GHOSTS; k <= (last) + ROW_GHOSTS; k++)

/* Pressures of the cells FIRST to LAST of a row, whose numbers are U. */
BOLIDE_INLINE void row_pressures(const struct eos *eos, const struct gas_numbers *u, int first,
                                 int last, double *pressure)
{
    const double none[POINT_HISTORY] = {0.0};
    double energy[ROW_ROOM];
    FOR_ROW(k, first, last)
    energy[k] = (u->of[GAS_ENERGY][k] -
                 0.5 *
                     (square(u->of[GAS_MOMENTUM][k]) + square(u->of[GAS_MOMENTUM + 1][k]) +
                      square(u->of[GAS_MOMENTUM + 2][k])) /
                     u->of[GAS_DENSITY][k]) /
                u->of[GAS_DENSITY][k];
    switch (eos->kind) {
#define ROW_CASE(name)                                                                            \
    case EOS_##name:                                                                              \
        FOR_ROW(k, first, last)                                                                   \
        pressure[k] = eos_##name(&eos->of.name, u->of[GAS_DENSITY][k], energy[k], none).pressure; \
        break;
        ROW_CASE(ideal_gas)
        ROW_CASE(noble_abel)
#undef ROW_CASE
    default:
        FOR_ROW(k, first, last)
        pressure[k] = eos_evaluate(eos, u->of[GAS_DENSITY][k], energy[k], none).pressure;
    }
}

/* What flows along AXIS in cells FIRST to LAST with numbers U. */
BOLIDE_INLINE void row_flows(const struct gas_numbers *u, const double *pressure, int axis,
                             int first, int last, struct gas_numbers *flow)
{
    for (int n = 0; n < GAS_NUMBERS; n++)
        FOR_ROW(k, first, last)
        {
            const double velocity = u->of[GAS_MOMENTUM + axis][k] / u->of[GAS_DENSITY][k];
            flow->of[n][k] = velocity * u->of[n][k];
            if (n == GAS_MOMENTUM + axis)
                flow->of[n][k] += pressure[k];
            if (n == GAS_ENERGY)
                flow->of[n][k] += velocity * pressure[k];
        }
}

#endif
