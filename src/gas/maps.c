/* Maps of a blast: the largest overpressure that each cell has seen, and the largest impulse, the
 * integral of the overpressure over time. Cells at rest are included: the bits do not depend on
 * which blocks sleep. */
#include "gas/gas_internal.h"

void gas_map(const struct gas *gas, const struct simulation *simulation, double dt)
{
    const struct cell_blocks *cells = gas->cells;
    const double ambient = gas->parameters.ambient;
    if (isnan(ambient))
        return;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < cells->count; i++) {
        if (gas->open && gas->open[i] == 0.0)
            continue;
        const double over = cells->pressure[i] - ambient;
        gas->map.sum[i] += over * dt;
        gas->map.overpressure[i] = maximum(gas->map.overpressure[i], over);
        gas->map.impulse[i] = maximum(gas->map.impulse[i], gas->map.sum[i]);
    }
}
