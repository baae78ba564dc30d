/* Bodies that something outside holds, and the loop over their particles: pistons that keep their velocity whatever pushes back (`driven`), strikers that stop
 * (`stop`), and ends that keep all of their state (`frozen`). */
#ifndef BOLIDE_HELD_H
#define BOLIDE_HELD_H

#include "model/particle_population.h"

/* Whether BODY has come to rest for good, keeps all of its state, or keeps its velocity for any of these reasons. */
bool body_stands(const struct simulation *simulation, int body);
bool body_is_frozen(const struct simulation *simulation, int body);
bool body_is_held(const struct simulation *simulation, int body);

/* Whether gravity pulls BODY: that of the case does, and nothing holds it. */
bool body_is_heavy(const struct simulation *simulation, int body);

/* Whether IS holds for any body. */
bool any_body(const struct simulation *simulation, bool (*is)(const struct simulation *, int));

BOLIDE_INLINE struct vec3 vector_at(const double v[3]) { return vec3_make(v[0], v[1], v[2]); }

/* What happens to particle I, and is booked. */
typedef void particle_act(const struct simulation *simulation, const struct particles *particles,
                          const void *of, int32_t i, struct ledger *ledger);

/* Calls ACT with OF for each of PARTICLES whose body IS holds for, or for all where IS is NULL, on
 * all threads. What they book joins the ledger. */
void act_on_particles(struct simulation *simulation, const struct particles *particles,
                      bool (*is)(const struct simulation *, int), particle_act *act,
                      const void *of);

/* Brings bodies to rest whose time has come, and books what that takes. */
void stop_bodies(struct simulation *simulation, const struct particles *particles);

/* Gives driven bodies whose velocity is one of the time that at the end of a step of DT, and books what that takes. They have
 * moved with the velocity at its begin, and come to where the mean of both takes them. ERROR_STATE: it is not finite. */
struct error *drive_bodies(struct simulation *simulation, const struct particles *particles,
                           double dt);

/* The time of the next event of bodies and loads after now: a body stops, a load begins or ends;
 * INFINITY: none. */
double next_event(const struct simulation *simulation);

#endif
