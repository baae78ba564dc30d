/* Device code of SPH with corrected gradients: what the bodies of its pair loops do with a particle and
 * eight neighbours. The kind is known at run time only. */
#include "sph/hllc/body.h"

__global__ void add_pairs(struct eight eight, struct gradient_sums *gradients,
                          struct force_sums *forces)
{
    const int i = (int)blockIdx.x;
    add_gradients(eight.kind.dimension, eight.smoothing, eight.own, eight.field, &gradients[i]);
    add_forces(&eight, &forces[i]);
}

__global__ void invert(struct sym3 *moment)
{
    moment[threadIdx.x] = inverse_of(2, moment[threadIdx.x]);
}
