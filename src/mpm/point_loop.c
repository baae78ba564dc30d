/* Chooses the loop of point_kernel.h for the processor that it runs on. */
#include "base/isa.h"
#include "mpm/point_kernel.h"

ISA_CHOOSE(bool, point_loop_run,
           (const struct point_loop *loop, const struct material *material, const int32_t *list,
            int32_t begin, int32_t end),
           (loop, material, list, begin, end))
