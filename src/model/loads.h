/* Loads on the surfaces of bodies (surface.h): what each pushes on the particles of a surface, and
 * the impulse that it should give, by which the one that it gives is judged (load_record.h). */
#ifndef BOLIDE_LOADS_H
#define BOLIDE_LOADS_H

#include "model/findings.h"
#include "model/simulation.h"
#include "model/surface.h"

/* What a load does to an element: its force, and the magnitude of that. N, or per metre, square
 * metre or radian. */
struct push {
    struct vec3 force;
    double size;
};

struct loads {
    int count;    /* of the case */
    int surfaces; /* of the bodies that have loads */
    struct body_surface *surface;
    int *of;            /* the index of the surface of each load */
    bool **acts;        /* by element: a local load may push on it; NULL of others */
    struct push *push;  /* of each element; room for the largest surface */
    bool pushes;        /* whether any of these is on a member of this rank */
    double (*force)[3]; /* of each member */
    int64_t capacity;
};

/* Whether a load acts at TIME, as its keys `after` and `before` say. */
bool load_acts_at(const struct load_input *load, double time);
BOLIDE_INLINE bool load_is_blast(const struct load_input *load) { return load->blast.at.count > 0; }
BOLIDE_INLINE bool load_is_record(const struct load_input *load) { return load->record.from; }

/* One that differs from element to element, and acts on those that it takes at the start. */
BOLIDE_INLINE bool load_is_local(const struct load_input *load)
{
    return load_is_blast(load) || load_is_record(load);
}

/* Whether a local load acts on ELEMENT. */
bool load_takes(const struct load_input *load, const struct surface_element *element);

/* The cosine of the angle between the normal of a surface element and the direction to the charge;
 * and the DISTANCE to it. */
double blast_cosine(const struct blast_input *blast, const struct surface_state *state,
                    double *distance);

/* Samples the surfaces of all loads of SIMULATION. loads_free in any case. */
struct error *loads_create(const struct simulation *simulation, struct loads *loads);
void loads_free(struct loads *loads);

/* Collective: the surfaces follow the members of POPULATION while a load acts on them; room for
 * forces. */
struct error *loads_follow(struct loads *loads, const struct simulation *simulation,
                           const struct population *population);

/* Books the impulse that load INDEX should give from time FROM on in DT, and with ADD adds its
 * forces to loads->force, which loads_clear sets to zero. Whoever applies a load books what it
 * delivers. Without ADD it is one that acts all around the body: what it pushes at walls, which is
 * no load, is then taken off what it delivers. ERROR_STATE: the load is not finite. */
struct error *loads_push(struct loads *loads, struct simulation *simulation, int index, double from,
                         double dt, bool add);
/* Books all that loads_push has just added as delivered in DT. */
void loads_deliver(const struct loads *loads, struct simulation *simulation, int index, double dt);
void loads_clear(struct loads *loads, const struct population *population);

/* Finds loads that have no effect or not the one that is meant, known from the start. */
void loads_judge(struct findings *findings);

#endif
