/* Which field a picture shows: a component of a view, or what the particles belong to. */
#include <string.h>

#include "picture/internal.h"
#include "picture/picture.h"

struct error *shown_find(const struct simulation *simulation, const struct views *views,
                         const char *field, struct shown *shown)
{
    static const char *const categories[] = {"material", "body"};
    *shown = (struct shown){0};
    bool material = strcmp(field, categories[0]) == 0;
    if (material || strcmp(field, categories[1]) == 0) {
        const struct simulation_case *input = simulation->problem->input;
        shown->category = material ? simulation_population(simulation).material
                                   : simulation_population(simulation).body;
        shown->names = !input ? NULL : material ? &input->materials : &input->bodies;
        return NULL;
    }
    return views_choose(views, field, categories, COUNT_OF(categories), &shown->view,
                        &shown->component);
}

struct error *picture_field_check(const struct simulation *simulation, const struct views *views,
                                  const char *field)
{
    struct shown shown;
    return shown_find(simulation, views, field, &shown);
}

void shown_read(const struct shown *shown, int64_t begin, int64_t end, double *out)
{
    if (!shown->view)
        for (int64_t i = begin; i < end; ++i)
            out[i - begin] = shown->category[i];
    else
        view_read_component(shown->view, shown->component, begin, end, out);
}
