/* A row of gas cells along an axis, on which the sweeps of split schemes work. Equations (2-49),
 * (2-50) of Cui, dissertation (2014): density, momentum and energy per volume,
 *
 *   U = (rho, rho u, E)   E = rho e + rho u^2/2   f = (rho u_n, rho u u_n + p n, (E + p) u_n)
 *
 * Along a radius r, from an axis with s = 1 or a centre with s = 2, a sweep is
 *
 *   d(r^s U)/dt + d(r^s f)/dr = s r^(s-1) p n
 *
 * whose right side takes a mean pressure of the cell: then a uniform pressure pushes nothing.
 *
 * For files that are compiled once an instruction set: a loop here runs over the cells of a row. */
#ifndef BOLIDE_GAS_ROW_H
#define BOLIDE_GAS_ROW_H

#include "gas/closure.h"

enum { GAS_DENSITY, GAS_MOMENTUM, GAS_ENERGY = 4, GAS_NUMBERS = 5 };

/* What cells have of a second material: its mass per volume of the cell, kg/m^3, and the fraction
 * of the volume that it fills. */
enum { PART_MASS, PART_FRACTION, PARTS };

/* Numbers of a row: cell c is at [c + ROW_GHOSTS], the face below it too. */
struct gas_numbers {
    double of[GAS_NUMBERS][ROW_ROOM];
};

struct gas_row {
    struct gas_closure closure;
    int riemann;     /* enum gas_riemann, of sweeps of second order */
    int cells, axis; /* the axis that it runs along */
    int round;       /* s along a radius, else 0 */
    double first;    /* radius of the face below its first cell, in cells */
    struct gas_numbers u;
    double shock[ROW_ROOM]; /* axes of strong shocks in cells: the sum of 1, 2, 4 for x, y, z */
    bool crossed; /* some of `shock` may not be zero; else it is zero in cells -2 .. cells + 1 */
    bool shocked; /* found by a sweep: a strong shock runs along the row */
    bool spent;   /* and: some cell is left with hardly any density or energy */
    double part[PARTS][ROW_ROOM]; /* of the second material, where there are two */
    double gamma[ROW_ROOM];       /* p/(rho e), where markers divide them (markers.h) */
    bool afterburns;              /* it burns in the first */
    bool thaws;                   /* the second is never colder than 0 K, see mixture.h */
    double afterburnt[ROW_ROOM];  /* its mass per volume of the cell that has */
    bool watched;                 /* who sweeps wants to know */
    /* what of its mass, of its volume and of what has burnt has passed through faces, where it
     * does, and the speed of the faces */
    double second_flux[ROW_ROOM], volume_flux[ROW_ROOM], afterburnt_flux[ROW_ROOM],
        face_speed[ROW_ROOM];
    double burnt[ROW_ROOM]; /* the fraction burnt of an explosive, where some is not */
    double
        push[ROW_ROOM]; /* found along a radius: mean pressures in a sweep, Pa, times s r^(s-1) */
};

/* Before a loop whose arrays never overlap although one is found by an axis, so that the compiler
 * cannot know: without it a check at run time takes them for overlapping and the loop is scalar. */
#if defined(__clang__)
#define ROWS_APART _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__) && !defined(__CUDACC__)
#define ROWS_APART _Pragma("GCC ivdep")
#else
#define ROWS_APART
#endif

/* The specific energies of the cells FIRST to LAST, whose numbers are U, less that of their
 * motion. */
BOLIDE_INLINE void row_energies(const struct gas_numbers *u, int first, int last, double *energy)
{
    FOR_ROW (k, first, last)
        energy[k] = (u->of[GAS_ENERGY][k] -
                     0.5 *
                         (square(u->of[GAS_MOMENTUM][k]) + square(u->of[GAS_MOMENTUM + 1][k]) +
                          square(u->of[GAS_MOMENTUM + 2][k])) /
                         u->of[GAS_DENSITY][k]) /
                    u->of[GAS_DENSITY][k];
}

/* The radius of the face below cell k, in cells; the sources want k as FOR_ROW counts it. */
BOLIDE_INLINE double row_radius(const struct gas_row *row, int k)
{
    return row->first + (double)(k - ROW_GHOSTS);
}

/* The area of the face below cell k and the volume of the cell, in cells; of a radian or
 * steradian. */
BOLIDE_INLINE double row_area(const struct gas_row *row, int k)
{
    const double low = row_radius(row, k);
    return row->round == 0 ? 1.0 : row->round == 1 ? low : low * low;
}

BOLIDE_INLINE double row_size(const struct gas_row *row, int k)
{
    const double low = row_radius(row, k);
    return row->round == 0 ? 1.0 : row->round == 1 ? low + 0.5 : low * (low + 1.0) + 1.0 / 3.0;
}

/* By how much the gas in cell k, which flows at SPEED along the radius, widens per time and
 * cell. */
BOLIDE_INLINE double row_widening(const struct gas_row *row, double speed, int k)
{
    return speed * (row_area(row, k + 1) - row_area(row, k)) / row_size(row, k);
}

/* dt/h with which both faces of a cell, by their areas, take no more of it than those of a plane
 * cell: at a centre (1 + 0)/(2/3). */
BOLIDE_INLINE double row_strict(const struct gas_row *row, double r)
{
    return row->round == 2 ? 1.5 * r : r;
}

/* The volume of a cell whose centre is at the radius X, per radian or steradian; VOLUME where its
 * power ROUND is 0. */
static inline double gas_cell_volume(double volume, double edge, double x, int round)
{
    return round == 0   ? volume
           : round == 1 ? volume * x
                        : volume * (square(x) + square(edge) / 12.0);
}

/* What FROM become where FLUX leaves through the faces of cells FIRST to LAST in a step of R =
 * dt/h. PUSH, the mean pressures of cells, counts along the radius alone. */
BOLIDE_INLINE void row_advance(const struct gas_row *row, const struct gas_numbers *from,
                               const struct gas_numbers *flux, const double *push, double r,
                               int first, int last, struct gas_numbers *to)
{
    for (int n = 0; n < GAS_NUMBERS; n++) {
        const double *f = flux->of[n], *u = from->of[n];
        if (!row->round)
            FOR_ROW (k, first, last)
                to->of[n][k] = u[k] - r * (f[k + 1] - f[k]);
        else if (n == GAS_MOMENTUM + row->axis)
            FOR_ROW (k, first, last)
                to->of[n][k] = u[k] - r *
                                          (row_area(row, k + 1) * (f[k + 1] - push[k]) -
                                           row_area(row, k) * (f[k] - push[k])) /
                                          row_size(row, k);
        else
            FOR_ROW (k, first, last)
                to->of[n][k] =
                    u[k] - r * (row_area(row, k + 1) * f[k + 1] - row_area(row, k) * f[k]) /
                               row_size(row, k);
    }
}

/* Along a radius the row keeps PUSH, for the ledger. */
BOLIDE_INLINE void row_keep_push(struct gas_row *row, const double *push)
{
    if (row->round)
        FOR_ROW (k, 0, row->cells - 1)
            row->push[k] = push[k] * (row_area(row, k + 1) - row_area(row, k));
}

/* What flows along AXIS in cells FIRST to LAST with numbers U. */
BOLIDE_INLINE void row_flows(const struct gas_numbers *u, const double *pressure, int axis,
                             int first, int last, struct gas_numbers *flow)
{
    for (int n = 0; n < GAS_NUMBERS; n++)
        FOR_ROW (k, first, last) {
            const double velocity = u->of[GAS_MOMENTUM + axis][k] / u->of[GAS_DENSITY][k];
            flow->of[n][k] = velocity * u->of[n][k];
            if (n == GAS_MOMENTUM + axis)
                flow->of[n][k] += pressure[k];
            if (n == GAS_ENERGY)
                flow->of[n][k] += velocity * pressure[k];
        }
}

#endif
