/* All particles in one place; see whole.h. */
#include "run/whole.h"

#include <stdlib.h>

#include "base/memory.h"

struct gathered {
    struct ranks alone;
    struct simulation simulation;
    struct views views;
};

struct error *whole_make(const struct simulation *simulation, const struct views *views,
                         struct whole *whole)
{
    *whole = (struct whole){true, simulation, views, NULL};
    if (!simulation->ranks->joined)
        return NULL;
    struct gathered *own = memory_allocate(sizeof *own);
    whole->own = own;
    TRY(ranks_agree(simulation->ranks, own ? NULL : error_new(ERROR_SYSTEM, "out of memory")));
    own->alone = ranks_alone();
    own->simulation = *simulation;
    own->simulation.ranks = &own->alone;
    *whole = (struct whole){simulation->ranks->rank == 0, &own->simulation, &own->views, own};
    TRY(particles_gather(&simulation->particles, &own->simulation.particles));
    views_of_particles(&own->views, &own->simulation);
    return NULL;
}

void whole_free(struct whole *whole)
{
    if (whole->own)
        particles_destroy(&whole->own->simulation.particles);
    free(whole->own);
    *whole = (struct whole){0};
}

struct error *whole_tell(const struct simulation *simulation, struct error *error, double *numbers,
                         int count)
{
    TRY(ranks_agree(simulation->ranks, error));
    ranks_broadcast(simulation->ranks, 0, numbers, count * (int64_t)sizeof *numbers);
    return NULL;
}
