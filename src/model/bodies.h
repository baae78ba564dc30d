/* Bodies that something outside holds: pistons that keep their velocity whatever pushes back
 * (`driven`), strikers that stop (`stop`), and ends that keep all of their state (`frozen`). */
#ifndef BOLIDE_BODIES_H
#define BOLIDE_BODIES_H

#include "model/simulation.h"

/* Whether BODY has come to rest for good, keeps all of its state, or keeps its velocity for any of
 * these reasons. */
bool body_stands(const struct simulation *simulation, int body);
bool body_is_frozen(const struct simulation *simulation, int body);
bool body_is_prescribed(const struct simulation *simulation, int body);

/* Whether gravity pulls BODY: that of the case does, and nothing holds it. */
bool body_is_heavy(const struct simulation *simulation, int body);

/* Whether IS holds for any body. */
bool any_body(const struct simulation *simulation, bool (*is)(const struct simulation *, int));

/* The time of the next event of bodies and loads after now: a body stops, a load begins or ends;
 * INFINITY: none. */
double next_event(const struct simulation *simulation);

#endif
