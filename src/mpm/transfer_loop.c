/* Chooses the loops of transfer.h for the processor that they run on. */
#include "base/isa.h"
#include "mpm/transfer.h"

typedef void scatter_isa(const struct transfer *, int32_t);
typedef void velocity_isa(const struct transfer *, int32_t, double, bool, bool);
typedef void gradient_isa(const struct transfer *, int32_t, double, const double *, int, bool,
                          double *);

scatter_isa transfer_scatter_v2, transfer_slopes_v2;
velocity_isa transfer_velocity_v2;
gradient_isa transfer_gradient_v2;
#if defined(__x86_64__)
scatter_isa transfer_scatter_v3, transfer_scatter_v4, transfer_slopes_v3, transfer_slopes_v4;
velocity_isa transfer_velocity_v3, transfer_velocity_v4;
gradient_isa transfer_gradient_v3, transfer_gradient_v4;
static scatter_isa *const scatter_of[] = {transfer_scatter_v2, transfer_scatter_v3,
                                          transfer_scatter_v4};
static scatter_isa *const slopes_of[] = {transfer_slopes_v2, transfer_slopes_v3,
                                         transfer_slopes_v4};
static velocity_isa *const velocity_of[] = {transfer_velocity_v2, transfer_velocity_v3,
                                            transfer_velocity_v4};
static gradient_isa *const gradient_of[] = {transfer_gradient_v2, transfer_gradient_v3,
                                            transfer_gradient_v4};
#else
static scatter_isa *const scatter_of[] = {transfer_scatter_v2};
static scatter_isa *const slopes_of[] = {transfer_slopes_v2};
static velocity_isa *const velocity_of[] = {transfer_velocity_v2};
static gradient_isa *const gradient_of[] = {transfer_gradient_v2};
#endif

void transfer_scatter(const struct transfer *transfer, int32_t bin)
{
    scatter_of[isa_best()](transfer, bin);
}

void transfer_slopes(const struct transfer *transfer, int32_t bin)
{
    slopes_of[isa_best()](transfer, bin);
}

void transfer_velocity(const struct transfer *transfer, int32_t bin, double dt, bool scatter,
                       bool move)
{
    velocity_of[isa_best()](transfer, bin, dt, scatter, move);
}

void transfer_gradient(const struct transfer *transfer, int32_t bin, double dt,
                       const double *velocity, int stride, bool move, double *rate)
{
    gradient_of[isa_best()](transfer, bin, dt, velocity, stride, move, rate);
}
