/* The partition: which rank owns which blocks of the global grid, with all that is in them,
 * particles, nodes or cells. The curve that runs through all blocks in the order of their keys
 * is cut into as many parts as there are ranks, of equal work. */
#ifndef BOLIDE_PARTITION_H
#define BOLIDE_PARTITION_H

#include "base/base.h"
#include "parallel/ranks.h"

/* Zero but for RANKS until it is divided for the first time: then each rank owns what it has. */
struct partition {
    const struct ranks *ranks;
    uint64_t *cut; /* rank r owns the blocks of keys cut[r] .. cut[r + 1] - 1 */
    double work;   /* seconds that this rank has computed for its blocks since the cut */
    double cost;   /* seconds that a new cut costs, the same on all ranks; 0: hardly any */
};

/* How much work a block is, in any unit: particles, cells that were computed. */
struct block_weight {
    uint64_t key;
    double weight;
};

void partition_free(struct partition *partition);

/* The rank that owns the block of KEY. */
int partition_owner(const struct partition *partition, uint64_t key);

/* Collective: whether to divide the blocks, for the first time or because the ranks' work since
 * the cut differs by too much, and they have lost more by that than a new cut costs. */
bool partition_is_uneven(const struct partition *partition);

/* Collective: divides the blocks of all ranks. OWN are the COUNT blocks that this rank holds
 * something of; what the rank has worked counts for them by their weight. Unless ANYWAY, a cut that
 * gains little is not made; ANEW: one was. */
struct error *partition_divide(struct partition *partition, struct block_weight *own, int32_t count,
                               bool anyway, bool *anew);

#endif
