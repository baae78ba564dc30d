/* Chooses the finding of near rows for the processor that it runs on. */
#include "base/isa.h"
#include "sph/prune.h"

typedef void prune_loop_isa(const struct prune_loop *, const struct block *, int64_t);

prune_loop_isa prune_loop_run_v2;
#if defined(__x86_64__)
prune_loop_isa prune_loop_run_v3, prune_loop_run_v4;
#endif

void prune_loop_run(const struct prune_loop *loop, const struct block *block, int32_t b)
{
    const struct block *own = &block[b];
    if (!loop->neighbours->prune)
        return;
    const int64_t room = loop->neighbours->near_block[b];
    switch (isa_best()) {
#if defined(__x86_64__)
    case ISA_V4:
        prune_loop_run_v4(loop, own, room);
        return;
    case ISA_V3:
        prune_loop_run_v3(loop, own, room);
        return;
#endif
    default:
        prune_loop_run_v2(loop, own, room);
    }
}
