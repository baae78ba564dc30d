/* Chooses the loops of transfer.h for the processor that they run on. */
#include "base/isa.h"
#include "mpm/transfer.h"

ISA_CHOOSE(void, transfer_scatter, (const struct transfer *transfer, int32_t bin), (transfer, bin))

ISA_CHOOSE(void, transfer_push, (const struct transfer *transfer, int32_t bin), (transfer, bin))

ISA_CHOOSE(void, transfer_slopes, (const struct transfer *transfer, int32_t bin), (transfer, bin))

ISA_CHOOSE(void, transfer_velocity,
           (const struct transfer *transfer, int32_t bin, struct transfer_step step, bool scatter),
           (transfer, bin, step, scatter))

ISA_CHOOSE(void, transfer_again,
           (const struct transfer *transfer, int32_t bin, const double *from, bool accelerations,
            double *to),
           (transfer, bin, from, accelerations, to))

ISA_CHOOSE(void, transfer_heat, (const struct transfer *transfer, int32_t bin), (transfer, bin))

ISA_CHOOSE(void, transfer_mix, (const struct transfer *transfer, int32_t bin, double dt),
           (transfer, bin, dt))

ISA_CHOOSE(void, transfer_warm, (const struct transfer *transfer, int32_t bin), (transfer, bin))

ISA_CHOOSE(void, transfer_gradient,
           (const struct transfer *transfer, int32_t bin, struct transfer_step step,
            struct nodal velocity, struct rates rates),
           (transfer, bin, step, velocity, rates))
