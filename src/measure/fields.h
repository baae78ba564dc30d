/* Which fields are recorded: single components of what the solver shows, chosen by the names of a case. */
#ifndef BOLIDE_FIELDS_H
#define BOLIDE_FIELDS_H

#include "model/views.h"

struct chosen_field {
    char name[72]; /* "pressure", "velocity.x" */
    const char *unit;
    int view, component; /* the index of the view, the same at every step */
};

enum { FIELDS_MAX = 6 * VIEWS_MAX };

struct chosen_fields {
    int count;
    struct chosen_field field[FIELDS_MAX];
};

/* Adds the fields that NAMES say, none twice, a vector or tensor standing for all of its components that mean something in
 * DIMENSION dimensions; without names all. ERROR_INPUT, not located, where there is no such field. */
struct error *fields_choose(const struct views *views, const struct name_list *names, int dimension,
                            struct chosen_fields *fields);

/* FIELD of the particle at INDEX. */
double field_value(const struct views *views, const struct chosen_field *field, int64_t index);

#endif
