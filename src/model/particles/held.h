/* The loop over the particles of bodies that something outside holds (model/bodies.h). */
#ifndef BOLIDE_HELD_H
#define BOLIDE_HELD_H

#include "model/bodies.h"

struct particles;

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

/* Marks the particles of bodies that are taken away after SINCE and up to now, and books what goes
 * with them; simulation_commit takes them out. True where there are such bodies. */
bool remove_bodies(struct simulation *simulation, double since);

/* How many particles BODY has on all ranks; 0: it has been taken away. Collective. */
int64_t body_members(const struct simulation *simulation, int body);

/* Slows the bodies with `damping` as a step from SINCE to now does, and books what they lose. */
void damp_bodies(struct simulation *simulation, double since);

/* Gives driven bodies whose velocity is one of the time that at the end of a step of DT, and books
 * what that takes. They have moved with the velocity at its begin, and come to where the mean of
 * both takes them. ERROR_STATE: it is not finite. */
struct error *drive_bodies(struct simulation *simulation, const struct particles *particles,
                           double dt);

#endif
