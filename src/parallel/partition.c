/* The partition; see partition.h. */
#include "parallel/partition.h"

#include <stdlib.h>

#include "base/memory.h"

/* Blocks are divided anew when a rank has worked this much longer than the mean of all. */
static const double imbalance_limit = 1.1;

static int compare_weights(const void *a, const void *b)
{
    uint64_t x = ((const struct block_weight *)a)->key, y = ((const struct block_weight *)b)->key;
    return x < y ? -1 : x > y;
}

/* A cut is kept unless another leaves the rank that works longest this much less of it. */
static const double least_gain = 0.05;

/* A block goes to the part that its middle falls into. The blocks at one place of the curve may
 * still belong to several ranks. */
static void cut_curve(uint64_t *cut, int parts, struct block_weight *block, int64_t count)
{
    double total = 0.0, before = 0.0;
    qsort(block, (size_t)count, sizeof *block, compare_weights);
    for (int64_t k = 0; k < count; k++)
        total += block[k].weight;
    int part = 0;
    cut[0] = 0;
    for (int64_t k = 0, next; k < count; k = next) {
        double work = 0.0;
        for (next = k; next < count && block[next].key == block[k].key; next++)
            work += block[next].weight;
        while (part + 1 < parts && (before + 0.5 * work) * parts >= total * (part + 1))
            cut[++part] = block[k].key;
        before += work;
    }
    while (part < parts)
        cut[++part] = UINT64_MAX;
}

/* The most work of a part of the sorted BLOCKS. */
static double most_work(const uint64_t *cut, int parts, const struct block_weight *block,
                        int64_t count)
{
    double most = 0.0, work = 0.0;
    int part = 0;
    for (int64_t k = 0; k < count; k++) {
        for (; part + 1 < parts && block[k].key >= cut[part + 1]; part++)
            work = 0.0;
        work += block[k].weight;
        most = work > most ? work : most;
    }
    return most;
}

void partition_free(struct partition *partition)
{
    free(partition->cut);
    partition->cut = NULL;
}

int partition_owner(const struct partition *partition, uint64_t key)
{
    if (!partition->cut)
        return partition->ranks->rank;
    int low = 0, high = partition->ranks->size; /* cut[low] <= key < cut[high] */
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (partition->cut[middle] <= key)
            low = middle;
        else
            high = middle;
    }
    return low;
}

bool partition_is_uneven(const struct partition *partition)
{
    if (!partition->cut)
        return true;
    double most = ranks_maximum(partition->ranks, partition->work), mean = 0.0;
    struct exact_sum sum = {0};
    exact_sum_add(&sum, partition->work);
    ranks_sum_exact(partition->ranks, &sum, 1);
    mean = exact_sum_value(&sum) / partition->ranks->size;
    return mean > 0.01 && most > imbalance_limit * mean && most - mean > partition->cost;
}

struct error *partition_divide(struct partition *partition, struct block_weight *own, int32_t count,
                               bool anyway, bool *anew)
{
    const struct ranks *ranks = partition->ranks;
    const size_t cuts = (size_t)ranks->size + 1;
    struct block_weight *all = NULL;
    uint64_t *cut = memory_allocate(cuts * sizeof *cut);
    int64_t blocks = 0;
    double held = 0.0;
    for (int32_t b = 0; b < count; b++)
        held += own[b].weight;
    const double each = partition->work > 0.0 && held > 0.0 ? partition->work / held : 0.0;
    const bool measured = ranks_minimum(ranks, held > 0.0 && each <= 0.0 ? 0.0 : 1.0) > 0.0;
    for (int32_t b = 0; b < count && measured; b++)
        own[b].weight *= each;
    struct error *error =
        ranks_agree(ranks, cut ? NULL : out_of_memory_for("the blocks of the ranks"));
    if (!error)
        error = ranks_gather(ranks, -1, own, count, sizeof *own, (void **)&all, &blocks);
    if (!error)
        cut_curve(cut, ranks->size, all, blocks);
    *anew =
        !error && (anyway || !partition->cut ||
                   most_work(cut, ranks->size, all, blocks) <
                       (1.0 - least_gain) * most_work(partition->cut, ranks->size, all, blocks));
    if (*anew) {
        free(partition->cut);
        partition->cut = cut;
        cut = NULL;
    }
    free(cut);
    free(all);
    partition->work = 0.0;
    return error;
}
