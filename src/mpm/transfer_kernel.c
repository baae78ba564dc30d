/* The loops of transfer.h for one instruction set, named by BOLIDE_ISA: for two, four or eight
 * particles of a cell at once. */
#include "base/isa.h"
#include "mpm/transfer_body.h"
#include "mpm/transfer_mixing.h"

/* One switch a block: in each branch dimension and window are constants. */
#define BY_WINDOW(t, CALL, dimension) \
    if ((t)->window == 2)             \
        CALL(dimension, 2);           \
    else if ((t)->window == 3)        \
        CALL(dimension, 3);           \
    else                              \
        CALL(dimension, 4)
#define BY_KIND(t, CALL)              \
    if ((t)->dimension == 1) {        \
        BY_WINDOW(t, CALL, 1);        \
    } else if ((t)->dimension == 2) { \
        BY_WINDOW(t, CALL, 2);        \
    } else {                          \
        BY_WINDOW(t, CALL, 3);        \
    }

ISA_KERNEL(void, transfer_scatter, const struct transfer *t, int32_t bin){
#define CALL(dimension, window) bin_scatter(t, kind_make(dimension, window, 1 << dimension), bin)
    BY_KIND(t, CALL)
#undef CALL
}

ISA_KERNEL(void, transfer_push, const struct transfer *t, int32_t bin){
#define CALL(dimension, window) bin_push(t, kind_make(dimension, window, 1 << dimension), bin)
    BY_KIND(t, CALL)
#undef CALL
}

ISA_KERNEL(void, transfer_slopes, const struct transfer *t, int32_t bin){
#define CALL(dimension, window) bin_slopes(t, kind_make(dimension, window, 1 << dimension), bin)
    BY_KIND(t, CALL)
#undef CALL
}

ISA_KERNEL(void, transfer_velocity, const struct transfer *t, int32_t bin,
           struct transfer_step step, bool scatter_back){
#define CALL(dimension, window) \
    bin_velocity(t, kind_make(dimension, window, 1 << dimension), bin, step, scatter_back)
    BY_KIND(t, CALL)
#undef CALL
}

ISA_KERNEL(void, transfer_again, const struct transfer *t, int32_t bin, const double *from,
           bool accelerations, double *to){
#define CALL(dimension, window) \
    bin_again(t, kind_make(dimension, window, 1 << dimension), bin, from, accelerations, to)
    BY_KIND(t, CALL)
#undef CALL
}

ISA_KERNEL(void, transfer_heat, const struct transfer *t, int32_t bin){
#define CALL(dimension, window) bin_heat(t, kind_make(dimension, window, 1 << dimension), bin)
    BY_KIND(t, CALL)
#undef CALL
}

ISA_KERNEL(void, transfer_mix, const struct transfer *t, int32_t bin, double dt){
#define CALL(dimension, window) bin_mix(t, kind_make(dimension, window, 1 << dimension), bin, dt)
    BY_KIND(t, CALL)
#undef CALL
}

ISA_KERNEL(void, transfer_warm, const struct transfer *t, int32_t bin){
#define CALL(dimension, window) bin_warm(t, kind_make(dimension, window, 1 << dimension), bin)
    BY_KIND(t, CALL)
#undef CALL
}

ISA_KERNEL(void, transfer_gradient, const struct transfer *t, int32_t bin,
           struct transfer_step step, struct nodal velocity, struct rates rates)
{
#define CALL(dimension, window) \
    bin_gradient(t, kind_make(dimension, window, 1 << dimension), bin, step, velocity, rates)
    BY_KIND(t, CALL)
#undef CALL
}
