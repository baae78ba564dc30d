/* Device code of second-order contact SPH: what the body of its pair loop does with a particle and eight
 * neighbours. The kind is known at run time only. */
#include "sph/muscl/body.h"
#include "sph/muscl/closure.h"
#include "sph/muscl/rates.h"

__global__ void add_pairs(struct muscl_kind kind, double smoothing, double material,
                          const double *record, const struct lanes *lanes, struct sums *sums)
{
    const int i = (int)blockIdx.x;
    struct pairs pairs;
    find_places(kind, true, smoothing, record, &lanes[i], &pairs, sums[i].lane);
    walk_rows(kind, record, &lanes[i], &pairs, sums[i].row);
    find_changes(kind, true, material, record, &lanes[i], &pairs);
    add_contacts(kind, true, record, &lanes[i], &pairs, sums[i].lane);
    add_pulls(kind, record, 1, &lanes[i], &pairs, sums[i].lane);
    add_slopes(kind, record, &lanes[i], &pairs, sums[i].lane);
}

__global__ void write_sums(struct muscl_loop loop, struct muscl_kind kind, struct sums *sums,
                           struct batch *batch)
{
    const int i = (int)blockIdx.x;
    double *all = batch[i].total[0];
    sums_totals(kind, &sums[i], all);
    batch_add(&loop, kind, i, all, &batch[i]);
    batch_pad(&loop, kind, &batch[i]);
    batch_finish(&loop, kind, &batch[i]);
}
