/* The spread loop for one instruction set, named by BOLIDE_ISA; see kernel.h. */
#include "sph/spread/kernel.h"

#include "base/isa.h"
#include "sph/spread/body.h"

BOLIDE_INLINE double row_gradient(const struct spread_loop *loop, int dimension, int32_t i)
{
    const struct lane_records records = {loop->record, SPREAD_STRIDE,   dimension,
                                         loop->empty,  loop->smoothing, NULL};
    const double *own = loop->record + (size_t)i * SPREAD_STRIDE;
    const uint32_t *entry = neighbours_row(loop->neighbours, i);
    const int count = (int)loop->neighbours->row[i].count;
    double field[SPREAD_STRIDE][LANES] ALIGNED, sum[SPREAD_SUMS][LANES] ALIGNED = {{0.0}};
    double total[SPREAD_SUMS];
    struct lane_walk walk;
    walk.looked_at = walk.ready = walk.waiting = 0;
    while (lanes_walk(&walk, records, own, entry, count))
        for (int k = 0; k < walk.ready; k += LANES) {
            lanes_stage(records, walk.list + k, field);
            add_lanes(dimension, loop->smoothing, own, field, sum);
        }
    for (int k = 0; k < SPREAD_SUMS; k++)
        total[k] = across_lanes(sum[k]);
    return gradient_of(dimension, total);
}

#define INSTANCE(name, dimension)                                                          \
    static void name(const struct spread_loop *loop, int32_t begin, int32_t end)           \
    {                                                                                      \
        for (int32_t i = begin; i < end; i++)                                              \
            loop->gradient[i] =                                                            \
                loop->spreads[loop->material[i]] ? row_gradient(loop, dimension, i) : 0.0; \
    }

INSTANCE(line, 1)
INSTANCE(plane, 2)
INSTANCE(space, 3)

ISA_KERNEL(void, spread_loop_run, const struct spread_loop *loop, int32_t begin, int32_t end)
{
    typedef void instance(const struct spread_loop *, int32_t, int32_t);
    static instance *const table[3] = {line, plane, space};
    table[loop->dimension - 1](loop, begin, end);
}
