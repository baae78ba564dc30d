/* Chooses the loops of transfer.h for the processor that they run on, and for the nodes that a
 * particle reaches. */
#include "base/isa.h"
#include "mpm/transfer.h"

#define CHOOSE_FOR(name, window, parameters, arguments) \
    void name##_##window parameters;                    \
    ISA_CHOOSE(void, name##_##window, parameters, arguments)

#define CHOOSE(name, parameters, arguments)    \
    CHOOSE_FOR(name, 2, parameters, arguments) \
    CHOOSE_FOR(name, 3, parameters, arguments) \
    CHOOSE_FOR(name, 4, parameters, arguments) \
    void name parameters                       \
    {                                          \
        if (transfer->window == 2)             \
            name##_2 arguments;                \
        else if (transfer->window == 3)        \
            name##_3 arguments;                \
        else                                   \
            name##_4 arguments;                \
    }

CHOOSE(transfer_scatter, (const struct transfer *transfer, int32_t bin), (transfer, bin))

CHOOSE(transfer_push, (const struct transfer *transfer, int32_t bin), (transfer, bin))

CHOOSE(transfer_slopes, (const struct transfer *transfer, int32_t bin), (transfer, bin))

CHOOSE(transfer_velocity,
       (const struct transfer *transfer, int32_t bin, struct transfer_step step, bool scatter),
       (transfer, bin, step, scatter))

CHOOSE(transfer_again,
       (const struct transfer *transfer, int32_t bin, const double *from, bool accelerations,
        double *to),
       (transfer, bin, from, accelerations, to))

CHOOSE(transfer_heat, (const struct transfer *transfer, int32_t bin), (transfer, bin))

CHOOSE(transfer_mix, (const struct transfer *transfer, int32_t bin, double dt), (transfer, bin, dt))

CHOOSE(transfer_compliance, (const struct transfer *transfer, int32_t bin), (transfer, bin))

CHOOSE(transfer_balance, (const struct transfer *transfer, int32_t bin), (transfer, bin))

CHOOSE(transfer_stiffness, (const struct transfer *transfer, int32_t bin), (transfer, bin))

CHOOSE(transfer_speed, (const struct transfer *transfer, int32_t bin, double *sound),
       (transfer, bin, sound))

CHOOSE(transfer_damage, (const struct transfer *transfer, int32_t bin), (transfer, bin))

CHOOSE(transfer_spread, (const struct transfer *transfer, int32_t bin), (transfer, bin))

CHOOSE(transfer_warm, (const struct transfer *transfer, int32_t bin), (transfer, bin))

CHOOSE(transfer_gradient,
       (const struct transfer *transfer, int32_t bin, struct transfer_step step,
        struct nodal velocity, struct rates rates),
       (transfer, bin, step, velocity, rates))
