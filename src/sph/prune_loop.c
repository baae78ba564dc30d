/* Chooses the finding of near rows for the processor that it runs on. */
#include "base/isa.h"
#include "sph/prune.h"

ISA_CHOOSE(void, prune_loop_run,
           (const struct prune_loop *loop, const struct block *block, int32_t b), (loop, block, b))
