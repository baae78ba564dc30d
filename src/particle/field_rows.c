/* Loops over the rows of a solver's fields; see field_rows.h. */
#include "particle/field_rows.h"

#include <string.h>

#include "particle/particles.h"

static bool exists(const struct field_row *row, const struct field_needs *needs)
{
    return (row->when & needs->conditions) == row->when;
}

static struct field_declaration declaration_of(const struct field_row *row,
                                               const struct field_needs *needs)
{
    struct field_declaration field = row->field;
    if (row->size)
        field.components = needs->size[row->size];
    if (row->state_when & needs->conditions)
        field.kind = FIELD_STATE | (field.kind & ~(unsigned)(FIELD_DERIVED | FIELD_PASSING));
    return field;
}

int field_rows_declare(const struct field_row *rows, const struct field_needs *needs,
                       struct field_declaration *fields)
{
    int count = 0;
    for (const struct field_row *row = rows; row->field.name; row++)
        if (exists(row, needs))
            fields[count++] = declaration_of(row, needs);
    return count;
}

/* Several rows may share a member: at most one of their fields exists. */
void field_rows_bind(const struct field_row *rows, const struct field_needs *needs,
                     const struct particles *particles, void *pointers)
{
    for (const struct field_row *row = rows; row->field.name; row++)
        memset((char *)pointers + row->offset, 0, sizeof(void *));
    for (const struct field_row *row = rows; row->field.name; row++) {
        if (!exists(row, needs))
            continue;
        void *data = particles_field(particles, row->field.name);
        memcpy((char *)pointers + row->offset, &data, sizeof data);
    }
}
