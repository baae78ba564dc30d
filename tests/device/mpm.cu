/* Device code of the material point method: what the bodies of its kernels do with a block of
 * particles, and with a particle. Dimension and shape functions are known at run time only. */
#include "grid/cell_kernel.h"
#include "mpm/point_body.h"
#include "mpm/transfer_mixing.h"

__global__ void scatter(struct transfer transfer, struct kind kind)
{
    bin_scatter(&transfer, kind, (int32_t)blockIdx.x);
    bin_push(&transfer, kind, (int32_t)blockIdx.x);
    bin_slopes(&transfer, kind, (int32_t)blockIdx.x);
}

__global__ void gather(struct transfer transfer, struct kind kind, const double *from, double *to,
                       struct rates rates)
{
    const struct transfer_step step = {1e-9, true};
    const struct nodal velocity = {from, BACK_STRIDE};
    bin_velocity(&transfer, kind, (int32_t)blockIdx.x, step, true);
    bin_again(&transfer, kind, (int32_t)blockIdx.x, from, true, to);
    bin_gradient(&transfer, kind, (int32_t)blockIdx.x, step, velocity, rates);
    bin_warm(&transfer, kind, (int32_t)blockIdx.x);
}

__global__ void step_particles(struct point_loop loop, const struct material *material,
                               const int32_t *list)
{
    const int32_t k = (int32_t)(blockIdx.x * blockDim.x + threadIdx.x);
    point_advance(&loop, material, list[k], k, 1e-3);
}

__global__ void step_batch(struct point_loop loop, const struct material *material,
                           const int32_t *list, struct batch *batch, struct batch_flow *flow)
{
    points_load(&loop, list, loop.rate, BATCH, batch);
    points_start(&loop, batch, loop.rate + (size_t)RATE_UNRESOLVED * loop.rate_stride, flow);
    batch_step(material, batch, ENERGY_BY_WORK);
    points_keep(&loop, list, BATCH, batch, flow);
}

__global__ void find_cells(struct cell_loop loop, const double *corner, double *number)
{
    const int i = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    number[i] = cell_number(&loop, loop.dimension, corner, loop.position[i]);
}
