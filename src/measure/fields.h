/* Which fields are recorded: single components of what the solver shows, chosen by the names of a
 * case. */
#ifndef BOLIDE_FIELDS_H
#define BOLIDE_FIELDS_H

#include "model/columns.h"
#include "model/simulation.h"

struct chosen_field {
    char name[72]; /* "pressure", "velocity.x" */
    const char *unit;
    int column, component; /* the index of the column, the same at every step */
};

enum { FIELDS_MAX = 6 * COLUMNS_MAX };

struct chosen_fields {
    int count;
    struct chosen_field field[FIELDS_MAX];
};

/* Adds the fields that NAMES say, none twice, a vector or tensor standing for all of its components
 * that mean something in DIMENSION dimensions; without names all. ERROR_INPUT, not located, where
 * there is no such field. */
struct error *fields_choose(const struct population *population, const struct name_list *names,
                            int dimension, struct chosen_fields *fields);

/* FIELD of the particle at INDEX. */
double field_value(const struct population *population, const struct chosen_field *field,
                   int64_t index);

#endif
