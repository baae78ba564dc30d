/* The step of particles for one instruction set, named by BOLIDE_ISA; see point_kernel.h. */
#include "base/isa.h"
#include "material/batch_run.h"
#include "mpm/point_body.h"

ISA_KERNEL(bool, point_loop_run, const struct point_loop *loop, const struct material *material,
           const int32_t *list, int32_t begin, int32_t end)
{
    bool possible = true;
    for (int32_t first = begin; first < end; first += BATCH) {
        const int count = end - first < BATCH ? end - first : BATCH;
        struct batch batch;
        struct batch_flow flow;
        flow.solid = material_has_strength(material);
        flow.filter = point_filter(material);
        points_load(loop, list + first, loop->rate + first, count, &batch);
        points_start(loop, &batch, loop->rate + first + (size_t)RATE_UNRESOLVED * loop->rate_stride,
                     &flow);
        batch_run(material, &batch, ENERGY_BY_WORK);
        possible &= points_keep(loop, list + first, count, &batch, &flow);
    }
    return possible;
}
