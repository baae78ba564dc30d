/* Chosen fields; see fields.h. */
#include "measure/fields.h"

#include <stdio.h>
#include <string.h>

static void add(struct chosen_fields *fields, const struct population *population, int column,
                int component)
{
    const struct column *chosen = &population->column[column];
    for (int i = 0; i < fields->count; i++)
        if (fields->field[i].column == column && fields->field[i].component == component)
            return;
    struct chosen_field *field = &fields->field[fields->count++];
    const char *part = column_component_name(chosen->components, component);
    *field = (struct chosen_field){.unit = chosen->unit, .column = column, .component = component};
    snprintf(field->name, sizeof field->name, "%s%s%s", chosen->name, *part ? "." : "", part);
}

static void add_whole(struct chosen_fields *fields, const struct population *population, int column,
                      int dimension)
{
    int components = population->column[column].components;
    for (int k = 0; k < components; k++)
        if (column_component_shown(components, k, dimension))
            add(fields, population, column, k);
}

struct error *fields_choose(const struct population *population, const struct name_list *names,
                            int dimension, struct chosen_fields *fields)
{
    for (int i = 0; names->count == 0 && i < population->columns; i++)
        add_whole(fields, population, i, dimension);
    struct error *error = NULL;
    for (int i = 0; i < names->count; i++) {
        int component;
        const struct column *column = column_find(population, names->names[i], &component);
        if (column && component < 0)
            add_whole(fields, population, (int)(column - population->column), dimension);
        else if (column)
            add(fields, population, (int)(column - population->column), component);
        else
            error = error_join(
                error, column_choose(population, names->names[i], NULL, 0, &column, &component));
    }
    return error;
}

double field_value(const struct population *population, const struct chosen_field *field,
                   int64_t index)
{
    double value;
    column_read_component(population, &population->column[field->column], field->component, index,
                          index + 1, &value);
    return value;
}
