/* Maps: what the members of populations keep of a field over the time: its peak, when it arrived,
 * its impulse. Each is a field of the store by its own name, and a second one, which nobody sees,
 * for its memory: so they move with their members and go into checkpoints like any other. */
#ifndef BOLIDE_MAPS_H
#define BOLIDE_MAPS_H

#include "model/simulation.h"

/* The maps that the case of SIMULATION asks for; and one more, unless it has one of that name. */
void maps_take(struct simulation *simulation);
void maps_add(struct simulation *simulation, const struct map *map);

/* Declares the fields of the maps of POPULATION's quantities in FIELDS, 2 * MAPS_MAX at most, and
 * returns how many; names and units are those of SIMULATION. */
int maps_declare(struct simulation *simulation, const struct population *population,
                 struct field_declaration *fields);

/* Looks at all members at the end of a step of DT; with DT 0 at the start or after loading. */
void maps_update(const struct simulation *simulation, double dt);

/* Whether POPULATION keeps MAP, also before it has members. */
bool maps_has(const struct map *map, const struct population *population);

/* The visible field and the memory of MAP in POPULATION; false where it has none. */
struct map_fields {
    double *value, *memory;
};
bool maps_find(const struct map *map, const struct population *population,
               struct map_fields *fields);

/* Mistakes of the case in its maps, located, once the populations are there. */
struct error *maps_check(const struct simulation *simulation);

#endif
