/* The fields that a solver adds to the store, one row each: what the field is, when the store has
 * it, how many components it has, and where its pointer goes. Declaring, binding and help are loops
 * over these rows, and bytes are counted from what they declare; nothing else says when a field
 * exists. */
#ifndef BOLIDE_FIELD_ROWS_H
#define BOLIDE_FIELD_ROWS_H

#include "base/field.h"

struct particles;

/* A table ends with FIELD_ROWS_END. A field without unit is not shown to the user. */
struct field_row {
    struct field_declaration field;
    unsigned when;       /* bits of conditions that must all be met; 0: the field is always there */
    const char *where;   /* the same in words, for help; NULL: always */
    size_t offset;       /* of its pointer in the solver's struct of pointers */
    int size;            /* index of its components among the sizes of the run; 0: as declared */
    unsigned state_when; /* any of these conditions makes a derived field one of the state */
};

#define FIELD_ROWS_END \
    {                  \
        .when = 0      \
    }

/* What the rows depend on in a run: bits of conditions, and numbers of components by index; those
 * of index 0 are not used. SIZE may be NULL where no row asks for one. */
struct field_needs {
    unsigned conditions;
    const int *size;
};

/* Writes the declarations of the fields of ROWS that exist to FIELDS and returns how many. */
int field_rows_declare(const struct field_row *rows, const struct field_needs *needs,
                       struct field_declaration *fields);

/* Points the members of POINTERS at the fields of PARTICLES; those of fields that do not exist
 * become NULL. The pointers hold until the next append or commit. */
void field_rows_bind(const struct field_row *rows, const struct field_needs *needs,
                     const struct particles *particles, void *pointers);

#endif
