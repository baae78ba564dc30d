/* What a solver shows to output and checks: named quantities of the members, read by slices. */
#ifndef BOLIDE_VIEWS_H
#define BOLIDE_VIEWS_H

#include "model/simulation.h"

enum { VIEWS_MAX = 40 };

struct view {
    const char *name, *unit, *help;
    int components; /* 1, 3 or 6 */
    /* Either the array itself (as doubles), or a function that fills OUT, components numbers a
     * member, for the members begin .. end - 1. */
    const double *data;
    void (*compute)(const void *context, int64_t begin, int64_t end, double *out);
    const void *context;
};

/* Views hold until the next step. */
struct views {
    int dimension;
    int count;
    struct view view[VIEWS_MAX];
};

/* Adds the views that a population has by itself: every double field of the store that is declared
 * with a name, and from them speed, stress (6) and equivalent_stress, temperature where all materials
 * have a heat capacity; of particles that were made from a case also diameter and displacement. */
void views_of_population(struct views *views, const struct simulation *simulation);

void views_add(struct views *views, struct view view);

/* Finds "pressure", or one component of a view: "velocity.x", "stress.xx". *component is -1 for a whole
 * view. NULL when there is none. */
const struct view *views_find(const struct views *views, const char *name, int *component);

/* The same for a FIELD that must be one number a member: ERROR_INPUT, not located, when there is none
 * or it has several components. MORE are COUNT other words that would have been right, for suggestions. */
struct error *views_choose(const struct views *views, const char *field, const char *const *more,
                           int count, const struct view **view, int *component);

/* What COMPONENT of a view of COMPONENTS is called: "x", "xy"; "" for that of a scalar. */
const char *view_component_name(int components, int component);

/* Whether a component means something in DIMENSION dimensions: of a vector those along the axes that the
 * case has, of a tensor those on the diagonal too, since stress acts along all three. */
bool view_component_shown(int components, int component, int dimension);

/* Copies the view of members begin .. end - 1 to OUT. */
void view_read(const struct view *view, int64_t begin, int64_t end, double *out);

/* The same for one component of it. */
void view_read_component(const struct view *view, int component, int64_t begin, int64_t end,
                         double *out);
#endif
