/* What ranks tell each other of a coupling: all have all gates, and each some of the cells and
 * nodes beside them. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "couple/gates.h"

void cfdmp_unite(const struct cfdmp *cfdmp, double *values, int64_t count)
{
    part_unite(cfdmp->ranks, cfdmp->bits, values, count);
}

static struct flank flank_at(const struct gas_view *view, const int64_t at[3])
{
    int32_t block;
    const int32_t i = part_cell(view->cells, at, &block);
    struct flank flank = {0.0, 0.0, 0.0, 0.0, {0.0, 0.0, 0.0}, 0.0, 0.0};
    if (i < 0)
        return flank;
    flank.density = view->cells->density[i];
    flank.energy = view->cells->energy[i];
    flank.pressure = view->cells->pressure[i];
    flank.sound = ((const double *)cell_blocks_field(view->cells, "sound_long"))[i];
    memcpy(flank.velocity, view->cells->velocity[i], sizeof flank.velocity);
    if (view->layout->two) {
        flank.second = view->u[GAS_SECOND][i];
        flank.fraction = view->u[GAS_FRACTION][i];
    }
    return flank;
}

void cfdmp_look(struct cfdmp *cfdmp)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int s = 0; s < 2; s++) {
            struct side *side = &cfdmp->side[axis][s];
            for (int64_t n = 0; n < side->gates; n++)
                for (int inside = 0; inside < 2; inside++) {
                    int64_t at[3];
                    gate_cell(cfdmp, axis, s, n, inside, at);
                    side->flank[n][inside] = flank_at(&view, at);
                }
            if (side->gates)
                cfdmp_unite(cfdmp, &side->flank[0][0].density,
                            2 * side->gates * (int64_t)(sizeof **side->flank / sizeof(double)));
        }
}

static int by_order(const void *left, const void *right)
{
    const struct mpm_push *a = left, *b = right;
    for (int k = 0; k < 3; k++)
        if (a->order[k] != b->order[k])
            return a->order[k] > b->order[k] ? 1 : -1;
    return 0;
}

struct error *cfdmp_gather_pushes(struct cfdmp *cfdmp)
{
    const struct ranks *ranks = cfdmp->ranks;
    struct mpm_push *all;
    int64_t count;
    TRY(ranks_agree(ranks, cfdmp->pushes_lost ? out_of_memory_for("the coupling") : NULL));
    if (ranks->size < 2)
        return NULL;
    TRY(ranks_gather(ranks, -1, cfdmp->push, cfdmp->pushes, sizeof *all, (void **)&all, &count));
    qsort(all, (size_t)count, sizeof *all, by_order);
    free(cfdmp->push);
    cfdmp->push = all;
    cfdmp->pushes = cfdmp->push_capacity = count;
    return NULL;
}
