/* Bodies that something outside holds: pistons that keep their velocity whatever pushes back (`driven`), strikers that stop
 * (`stop`), and ends that keep all of their state (`frozen`). */
#ifndef BOLIDE_HELD_H
#define BOLIDE_HELD_H

#include "model/simulation.h"

/* Whether BODY has come to rest for good, keeps all of its state, or keeps its velocity for any of these reasons. */
bool body_stands(const struct simulation *simulation, int body);
bool body_is_frozen(const struct simulation *simulation, int body);
bool body_is_held(const struct simulation *simulation, int body);

/* Whether IS holds for any body. */
bool any_body(const struct simulation *simulation, bool (*is)(const struct simulation *, int));

/* Brings bodies to rest whose time has come, and books what that takes. */
void stop_bodies(struct simulation *simulation);

#endif
