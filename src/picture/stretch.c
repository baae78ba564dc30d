/* From which diameter on a particle is drawn as debris, not as a cell of a whole. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/material.h"
#include "picture/album_internal.h"

/* Density at the start over that of debris. Gas expands and stays a whole, up to where one particle
 * has the place of many. */
static const double CONDENSED = 4.0, GAS = 25.0;

static bool is_condensed(const struct simulation_case *input, const char *body)
{
    for (int b = 0; b < input->bodies.count; b++)
        if (!strcmp(input->bodies.names[b], body)) {
            const struct material *material = body_material(input, b);
            return material && material_is_condensed(material);
        }
    return false;
}

struct error *stretch_find(const struct album *album, const struct frame *first,
                           struct stretch **stretch)
{
    const int bodies = album->bodies.count;
    struct stretch *made = memory_allocate(((size_t)bodies + 1) * sizeof *made);
    *stretch = made;
    if (!made)
        return out_of_memory_for("a picture");
    for (int g = 0; g < first->groups; g++) {
        const struct frame_group *group = &first->group[g];
        for (int64_t i = 0; i < group->count && !group->cell_dimension; i++)
            if (group->body[i] < bodies)
                made[group->body[i]].least = fmaxf(made[group->body[i]].least, group->diameter[i]);
    }
    for (int b = 0; b < bodies; b++) {
        const double times = is_condensed(album->input, album->bodies.name[b]) ? CONDENSED : GAS;
        /* of a body that is not there yet nothing is known */
        made[b].most = made[b].least > 0.0f
                           ? made[b].least * (float)pow(times, 1.0 / album->dimension)
                           : INFINITY;
    }
    made[bodies].most = INFINITY; /* of no body */
    return NULL;
}
