/* Chooses the sweeps of sweep.h for the processor that they run on. */
#include "base/isa.h"
#include "gas/sweep.h"

ISA_CHOOSE(void, gas_sweep_strip,
           (const struct gas_sweep *sweep, const struct gas_strip *strip,
            struct gas_through *through),
           (sweep, strip, through))

ISA_CHOOSE(struct gas_fastest, gas_look_at_block, (const struct gas_look *look, int32_t b),
           (look, b))
