/* Finding near rows for one instruction set, named by BOLIDE_ISA; see prune.h. */
#include "base/isa.h"
#include "base/vector.h"
#include "sph/lanes.h"
#include "sph/prune.h"

/* Finds the near row of particle I and writes it to NEAR; returns how many entries it has. */
BOLIDE_INLINE uint32_t prune_row(const struct prune_loop *loop, struct lane_records records,
                                 int32_t i, uint32_t *near)
{
    const double *own = records.record + (size_t)i * (size_t)records.stride;
    const uint32_t *entry = neighbours_row(loop->neighbours, i);
    uint32_t list[LANES_CHUNK + LANES], found = 0;
    const int count = (int)loop->neighbours->row[i].count;
    for (int first = 0; first < count; first += LANES_CHUNK) {
        int left = count - first, length = left < LANES_CHUNK ? left : LANES_CHUNK;
        int kept = lanes_keep(records, own, entry + first, length, UINT32_MAX, list);
        memcpy(near + found, list, (size_t)kept * sizeof *near);
        found += (uint32_t)kept;
    }
    return found;
}

ISA_KERNEL(void, prune_loop_run, const struct prune_loop *loop, const struct block *block,
           int32_t b)
{
    const struct lane_records records = {loop->record,
                                         loop->stride,
                                         loop->dimension,
                                         0,
                                         loop->smoothing * (1.0 + loop->neighbours->near_skin),
                                         loop->place};
    const struct neighbours *n = loop->neighbours;
    const struct block *own = &block[b];
    if (!n->prune)
        return;
    int64_t room = n->near_block[b];
    for (int32_t i = own->first; i < own->first + own->count; i++) {
        uint32_t count = prune_row(loop, records, i, n->near_entry + room);
        n->near_row[i] = (struct near_row){room, count};
        room += count;
    }
}
