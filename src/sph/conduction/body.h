/* What the heat loop does with one particle and eight of its neighbours: for the files that are
 * compiled once an instruction set, and for a device. */
#ifndef BOLIDE_SPH_CONDUCTION_BODY_H
#define BOLIDE_SPH_CONDUCTION_BODY_H

#include "sph/conduction/kernel.h"
#include "sph/kernel.h"
#include "sph/lanes.h"

/* One own particle against eight neighbours: adds V W' k (T_j - T_i)/r. */
BOLIDE_INLINE void add_lanes(struct heat_kind kind, double smoothing, const double *own,
                             double (*field)[LANES], double sum[LANES])
{
    const int dimension = kind.dimension;
    const int d = dimension, v = heat_record_volume(dimension);
    const int t = heat_record_temperature(dimension), w = heat_record_depth(dimension);
    const int c = heat_record_conductivity(dimension), q = heat_record_diffusivity(dimension);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        double r2 = square(field[0][k] - own[0]);
        if (dimension > 1)
            r2 += square(field[1][k] - own[1]);
        if (dimension > 2)
            r2 += square(field[2][k] - own[2]);
        double r = sqrt(maximum(r2, 1e-200));
        double inverse_h = 2.0 / (smoothing * (own[d] + field[d][k]));
        double weight = field[v][k] * kernel_slope(r, inverse_h, dimension);
        if (kind.depth)
            weight *= 0.5 * fabs(own[w] + field[w][k]);
        double conductivity =
            heat_pair_conductivity(kind.form, own[c], own[q], field[c][k], field[q][k]);
        sum[k] += weight * conductivity * (field[t][k] - own[t]) / r;
    }
}

#endif
