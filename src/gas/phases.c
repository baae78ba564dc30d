/* What a coupling sees and does of the gas solver, see gas_phases.h. */
#include "gas/gas_phases.h"

#include <string.h>

#include "gas/gas_internal.h"

struct gas_view gas_view(const struct gas *gas)
{
    struct gas_view view = {.cells = gas->cells,
                            .layout = &gas->layout,
                            .eos = gas->eos,
                            .material = gas->material,
                            .heat = gas->heat};
    memcpy(view.u, gas->u, sizeof view.u);
    return view;
}

void gas_watch(struct gas *gas, const struct gas_cut *cut) { gas->cut = cut; }

struct error *gas_refresh(struct gas *gas, const struct simulation *simulation, const bool *blocks)
{
    for (int32_t b = 0; b < gas->cells->blocks; b++)
        if (blocks[b]) {
            gas->block[b].awake = true;
            gas->block[b].same = false;
        }
    return gas_derive(gas, simulation, blocks);
}
