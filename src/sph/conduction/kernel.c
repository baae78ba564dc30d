/* The heat loop for one instruction set, named by BOLIDE_ISA; see kernel.h. */
#include "sph/conduction/kernel.h"

#include "base/isa.h"
#include "sph/conduction/body.h"

BOLIDE_INLINE void row_rate(const struct heat_loop *loop, struct heat_kind kind, int32_t i)
{
    const struct lane_records records = {loop->record, HEAT_STRIDE,     kind.dimension,
                                         loop->empty,  loop->smoothing, NULL};
    const double *own = loop->record + (size_t)i * HEAT_STRIDE;
    const uint32_t *entry = neighbours_row(loop->neighbours, i);
    const int count = (int)loop->neighbours->row[i].count;
    double field[HEAT_STRIDE][LANES] ALIGNED, sum[LANES] ALIGNED = {0.0};
    struct lane_walk walk;
    walk.looked_at = walk.ready = walk.waiting = 0;
    while (lanes_walk(&walk, records, own, entry, count))
        for (int k = 0; k < walk.ready; k += LANES) {
            lanes_stage(records, walk.list + k, field);
            add_lanes(kind, loop->smoothing, own, field, sum);
        }
    const double depth = kind.depth ? own[heat_record_depth(kind.dimension)] : 1.0;
    loop->rate[i] = -across_lanes(sum) / (loop->density[i] * depth);
}

#define INSTANCE(name, ...)                                                    \
    static void name(const struct heat_loop *loop, int32_t begin, int32_t end) \
    {                                                                          \
        const struct heat_kind kind = {__VA_ARGS__};                           \
        for (int32_t i = begin; i < end; i++)                                  \
            row_rate(loop, kind, i);                                           \
    }

INSTANCE(line_contact, 1, false, HEAT_CONTACT)
INSTANCE(line_harmonic, 1, false, HEAT_HARMONIC)
INSTANCE(plane_contact, 2, false, HEAT_CONTACT)
INSTANCE(plane_harmonic, 2, false, HEAT_HARMONIC)
INSTANCE(space_contact, 3, false, HEAT_CONTACT)
INSTANCE(space_harmonic, 3, false, HEAT_HARMONIC)
INSTANCE(deep_contact, 2, true, HEAT_CONTACT)
INSTANCE(deep_harmonic, 2, true, HEAT_HARMONIC)

ISA_KERNEL(void, heat_loop_run, const struct heat_loop *loop, int32_t begin, int32_t end)
{
    typedef void instance(const struct heat_loop *, int32_t, int32_t);
    static instance *const table[4][2] = {{line_contact, line_harmonic},
                                          {plane_contact, plane_harmonic},
                                          {space_contact, space_harmonic},
                                          {deep_contact, deep_harmonic}};
    table[loop->kind.depth ? 3 : loop->kind.dimension - 1][loop->kind.form](loop, begin, end);
}
