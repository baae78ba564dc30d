/* The sums over a neighbour list in the second-order pair loop. For the files that are compiled
 * once an instruction set. */
#ifndef BOLIDE_SPH_MUSCL_SUMS_H
#define BOLIDE_SPH_MUSCL_SUMS_H

#include "sph/kernel.h"
#include "sph/muscl/kernel.h"
#include "sph/record.h"

enum { SUMS = 56, ROW = 8, TOTALS = SUMS + 28 /* 3 (ROW + 1), a multiple of four */ };

/* Where the sums over a row stand, with w = V W' and f = 2 D_i/(D_i + D_j) twice the share of the
 * pair that i has. */
struct layout {
    int traction, power; /* w |a| t*, w |a| t*.(U* - U) */
    int gradient;        /* w (U* - U)^a e^b */
    int weight;          /* w */
    int drift;           /* on a line: w (U* - U) */
    int impedance;       /* w Z_j */
    int offset, moment;  /* -f w x, -f w x^a e^b */
    int narrow;          /* slopes of what stands in no row */
    int hoop;            /* of axisymmetry: w |a| (depth - d) n_x, w |a| x n_x */
    /* in 2-D and 3-D, v = V W/h^2: v x^a x^b, v (U_j - U)^a x^b; w |a| of the exchange of volume; v
     * of like material, v times its packing, of solids v times its credit; w a */
    int spread, parting, exchange, like, packing, open, credit;
    /* totals only: -f w dq e^b by b, of the values after the step; a multiple of eight before */
    int slopes;
    int count;
};

BOLIDE_INLINE struct layout layout_of(struct muscl_kind kind)
{
    const int dimension = kind.dimension, tensor = tensor_components(dimension);
    struct layout at;
    at.traction = 0;
    at.power = dimension;
    at.gradient = at.power + 1;
    at.weight = at.gradient + dimension * dimension;
    at.drift = at.weight + 1;
    at.impedance = at.drift + (dimension == 1 ? 1 : 0);
    at.offset = at.impedance + 1;
    at.moment = at.offset + dimension;
    at.narrow = at.moment + tensor;
    at.hoop = at.narrow + dimension * muscl_narrow(kind);
    at.spread = at.hoop + (kind.depth ? 2 : 0);
    at.parting = at.spread + (dimension > 1 ? tensor : 0);
    at.exchange = at.parting + (dimension > 1 ? dimension * dimension : 0);
    at.like = at.exchange + (dimension > 1 ? 1 : 0);
    at.packing = at.like + (dimension > 1 ? 1 : 0);
    at.open = at.packing + (dimension > 1 ? 1 : 0);
    at.credit = at.open + (dimension > 1 ? dimension : 0);
    at.slopes = (at.credit + (dimension > 1 && kind.shear ? 1 : 0) + 7) / 8 * 8;
    at.count = at.slopes + dimension * muscl_values(kind);
    return at;
}

/* Sums over the neighbours seen so far: in lanes, and of slopes in rows. */
struct sums {
    double lane[SUMS][LANES] ALIGNED;
    double row[3][ROW] ALIGNED;
};

/* The totals in the order of the layout. */
BOLIDE_INLINE void sums_totals(struct muscl_kind kind, struct sums *sums, double *all)
{
    const struct layout at = layout_of(kind);
    const int values = muscl_values(kind), wide = muscl_wide(kind), narrow = muscl_narrow(kind);
    lanes_totals(sums->lane, at.slopes, all);
    for (int b = 0; b < kind.dimension; b++)
        for (int f = 0; f < values; f++)
            all[at.slopes + b * values + f] =
                f < wide ? sums->row[b][f] : all[at.narrow + b * narrow + f - wide];
}

#endif
