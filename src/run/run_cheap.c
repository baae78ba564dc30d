/* How much of the start of a run `bolide check` may compute itself; see run.h. */
#include <math.h>

#include "material/material.h"
#include "model/solver.h"
#include "run/run.h"

/* Cells that are filled, and updates of the case of a `start`, in a few seconds. */
static const double MOST_CELLS = 0x1p20, MOST_UPDATES = 2e7;

static double cells_of(const struct simulation_case *input)
{
    double cells = 1.0;
    for (int axis = 0; axis < (int)input->dimension; axis++)
        cells *=
            (domain_face(input, axis, 1).at - domain_face(input, axis, 0).at) / input->resolution;
    return cells;
}

/* Updates that the case of `start` takes: its waves are about as fast as its detonation. */
static double updates_of(const struct start_input *start)
{
    const struct simulation_case *input = start->input;
    const double until = isnan(start->at) ? input->run.until : start->at;
    double speed = 8000.0;
    for (int m = 0; m < input->materials.count; m++)
        if (material_is_lit(case_material(input, m)->material))
            speed = maximum(speed, material_detonation_speed(case_material(input, m)->material));
    return cells_of(input) * until * 2.0 * speed / input->resolution;
}

bool run_is_filled_in_check(const struct simulation_case *input)
{
    const struct solver_class *class = input->solver.choice->thing;
    return class->count && cells_of(input) <= MOST_CELLS &&
           (!input->start.input || updates_of(&input->start) <= MOST_UPDATES);
}
