/* The loops of transfer.h for one instruction set, named by BOLIDE_ISA, and for particles that
 * reach WINDOW nodes along an axis: for two, four or eight particles of a cell at once. A file for
 * each window includes this one, so that they compile side by side; transfer_loop.c chooses. */
#ifndef BOLIDE_MPM_TRANSFER_KERNEL_H
#define BOLIDE_MPM_TRANSFER_KERNEL_H

#include "base/isa.h"
#include "mpm/transfer_balance.h"
#include "mpm/transfer_body.h"
#include "mpm/transfer_mixing.h"
#include "mpm/transfer_speed.h"
#include "mpm/transfer_spread.h"

#ifndef WINDOW
#define WINDOW 4 /* for scripts/check-headers, which compiles each header alone */
#endif

/* The head of function NAME for its window and instruction set. */
#define KERNEL(name, ...) KERNEL_FOR(name, WINDOW, __VA_ARGS__)
#define KERNEL_FOR(name, window, ...) KERNEL_NAMED(name, window, __VA_ARGS__)
#define KERNEL_NAMED(name, window, ...) ISA_KERNEL(void, name##_##window, __VA_ARGS__)

/* One switch a block: in each branch dimension and window are constants. */
#define BY_DIMENSION(t, CALL)         \
    if ((t)->dimension == 1) {        \
        CALL(1);                      \
    } else if ((t)->dimension == 2) { \
        CALL(2);                      \
    } else {                          \
        CALL(3);                      \
    }

KERNEL(transfer_scatter, const struct transfer *t, int32_t bin){
#define CALL(dimension) bin_scatter(t, kind_make(dimension, WINDOW, 1 << dimension), bin)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_push, const struct transfer *t, int32_t bin){
#define CALL(dimension) bin_push(t, kind_make(dimension, WINDOW, 1 << dimension), bin)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_slopes, const struct transfer *t, int32_t bin){
#define CALL(dimension) bin_slopes(t, kind_make(dimension, WINDOW, 1 << dimension), bin)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_velocity, const struct transfer *t, int32_t bin, struct transfer_step step,
       bool scatter_back){
#define CALL(dimension) \
    bin_velocity(t, kind_make(dimension, WINDOW, 1 << dimension), bin, step, scatter_back)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_again, const struct transfer *t, int32_t bin, const double *from,
       bool accelerations, double *to){
#define CALL(dimension) \
    bin_again(t, kind_make(dimension, WINDOW, 1 << dimension), bin, from, accelerations, to)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_heat, const struct transfer *t, int32_t bin){
#define CALL(dimension) bin_heat(t, kind_make(dimension, WINDOW, 1 << dimension), bin)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_mix, const struct transfer *t, int32_t bin, double dt){
#define CALL(dimension) bin_mix(t, kind_make(dimension, WINDOW, 1 << dimension), bin, dt)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_compliance, const struct transfer *t, int32_t bin){
#define CALL(dimension) bin_compliance(t, kind_make(dimension, WINDOW, 1 << dimension), bin)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_balance, const struct transfer *t, int32_t bin){
#define CALL(dimension) bin_balance(t, kind_make(dimension, WINDOW, 1 << dimension), bin)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_stiffness, const struct transfer *t, int32_t bin){
#define CALL(dimension) bin_stiffness(t, kind_make(dimension, WINDOW, 1 << dimension), bin)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_speed, const struct transfer *t, int32_t bin, double *sound){
#define CALL(dimension) bin_speed(t, kind_make(dimension, WINDOW, 1 << dimension), bin, sound)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_damage, const struct transfer *t, int32_t bin){
#define CALL(dimension) bin_damage(t, kind_make(dimension, WINDOW, 1 << dimension), bin)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_spread, const struct transfer *t, int32_t bin){
#define CALL(dimension) bin_spread(t, kind_make(dimension, WINDOW, 1 << dimension), bin)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_warm, const struct transfer *t, int32_t bin){
#define CALL(dimension) bin_warm(t, kind_make(dimension, WINDOW, 1 << dimension), bin)
    BY_DIMENSION(t, CALL)
#undef CALL
}

KERNEL(transfer_gradient, const struct transfer *t, int32_t bin, struct transfer_step step,
       struct nodal velocity, struct rates rates)
{
#define CALL(dimension) \
    bin_gradient(t, kind_make(dimension, WINDOW, 1 << dimension), bin, step, velocity, rates)
    BY_DIMENSION(t, CALL)
#undef CALL
}

#endif
