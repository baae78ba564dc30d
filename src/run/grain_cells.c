/* Particles across the grains of a bed; see grain_cells.h. The shock in a bed is carried by
 * grains that flow into the voids between them; with few particles across a grain they are too
 * stiff for that, and the shock is too fast (docs/tasks/granular-bed.md). */
#include "run/grain_cells.h"

#include <math.h>

#include "model/generate.h"
#include "shape/shape.h"

/* Across the mean grain, and what a packing may be off that a fraction has changed the radii of. */
static const double PARTICLES = 12.0, WITHIN = 0.5;

bool grain_cells_of(const struct simulation_case *input, int body, struct grain_cells *cells)
{
    const struct body_input *of = case_body(input, body);
    struct grain_sizes sizes;
    if (!shape_grains(&of->shape, &sizes))
        return false;
    const double spacing = body_lattice(input, body).spacing.x;
    *cells = (struct grain_cells){sizes.smallest / spacing, sizes.mean / spacing,
                                  of->replaces.count == 0};
    return true;
}

/* Grains that replace a part of another body fill it without voids; those that another body fills
 * the gaps of, which they replace or not, cannot be told from loose ones by their shape alone. */
void grain_cells(struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    struct grain_cells cells;
    for (int body = 0; body < input->bodies.count; body++)
        if (grain_cells_of(input, body, &cells) && cells.loose && cells.mean < PARTICLES - WITHIN)
            finding_add(findings, FINDING_COARSE, "bodies", input->bodies.names[body],
                        "%.3g particles across the mean grain: with 6 the shock in a loose bed is "
                        "8 %% too fast, with 9 5 %%; choose a `resolution` for %.0f",
                        cells.mean, PARTICLES);
}
