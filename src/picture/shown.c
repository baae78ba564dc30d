/* Which field a picture shows: a component of a column, or what the particles belong to. */
#include <string.h>

#include "picture/internal.h"
#include "picture/picture.h"

struct error *shown_find(const struct simulation *simulation, const struct population *population,
                         const char *field, struct shown *shown)
{
    static const char *const categories[] = {"material", "body"};
    *shown = (struct shown){.population = population};
    bool material = strcmp(field, categories[0]) == 0;
    if (material || strcmp(field, categories[1]) == 0) {
        const struct simulation_case *input = simulation->problem->input;
        shown->category = material ? population->material : population->body;
        shown->names = !input ? NULL : material ? &input->materials : &input->bodies;
        return NULL;
    }
    return column_choose(population, field, categories, COUNT_OF(categories), &shown->column,
                         &shown->component);
}

struct error *picture_field_check(const struct simulation *simulation,
                                  const struct population *population, const char *field)
{
    struct shown shown;
    return shown_find(simulation, population, field, &shown);
}

void shown_read(const struct shown *shown, int64_t begin, int64_t end, double *out)
{
    if (!shown->column)
        for (int64_t i = begin; i < end; ++i)
            out[i - begin] = shown->category[i];
    else
        column_read_component(shown->population, shown->column, shown->component, begin, end, out);
}
