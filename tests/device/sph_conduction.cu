/* Device code of heat conduction in SPH: what the body of its loop does with a particle and eight
 * neighbours. */
#include "sph/conduction/body.h"

__global__ void add_pairs(struct heat_kind kind, double smoothing, const double *record,
                          double (*field)[LANES], double (*sum)[LANES])
{
    const int i = (int)blockIdx.x;
    add_lanes(kind, smoothing, record, field, sum[i]);
}
