/* Which ranks have which blocks of gas: those of equal work. */
#include <stdlib.h>

#include "base/clock.h"
#include "base/memory.h"
#include "gas/gas_internal.h"

struct error *gas_balance(struct gas *gas, struct simulation *simulation)
{
    enum { STEPS = 10 }; /* between comparisons of work */
    const int64_t every = simulation->problem->input->run.rebalance;
    const int64_t step = simulation->step;
    if (simulation->ranks->size < 2 || step == 0 || step % (every > 0 ? every : STEPS) != 0)
        return NULL;
    struct cell_blocks *cells = gas->cells;
    const uint64_t order = cells->order;
    const double began = clock_seconds();
    int64_t *work = memory_allocate(((size_t)cells->blocks + 1) * sizeof *work);
    TRY(ranks_agree(simulation->ranks, work ? NULL : out_of_memory_for("blocks of cells")));
    for (int32_t b = 0; b < cells->blocks; b++) {
        work[b] = gas->block[b].work;
        gas->block[b].work = 0;
    }
    struct error *error = cell_blocks_distribute(cells, work, every > 0);
    free(work);
    TRY(error);
    if (ranks_maximum(simulation->ranks, cells->order != order) == 0.0)
        return NULL;
    gas->room = 0; /* all of them may have moved */
    TRY(gas_plan(gas, simulation));
    TRY(ranks_agree(simulation->ranks, gas_derive(gas, simulation, NULL)));
    simulation->partition.cost = ranks_maximum(simulation->ranks, clock_seconds() - began);
    return NULL;
}
