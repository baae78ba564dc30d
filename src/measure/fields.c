/* Chosen fields; see fields.h. */
#include "measure/fields.h"

#include <stdio.h>
#include <string.h>

static void add(struct chosen_fields *fields, const struct views *views, int view, int component)
{
    const struct view *chosen = &views->view[view];
    for (int i = 0; i < fields->count; i++)
        if (fields->field[i].view == view && fields->field[i].component == component)
            return;
    struct chosen_field *field = &fields->field[fields->count++];
    const char *part = view_component_name(chosen->components, component);
    *field = (struct chosen_field){.unit = chosen->unit, .view = view, .component = component};
    snprintf(field->name, sizeof field->name, "%s%s%s", chosen->name, *part ? "." : "", part);
}

static void add_whole(struct chosen_fields *fields, const struct views *views, int view,
                      int dimension)
{
    int components = views->view[view].components;
    for (int k = 0; k < components; k++)
        if (view_component_shown(components, k, dimension))
            add(fields, views, view, k);
}

struct error *fields_choose(const struct views *views, const struct name_list *names, int dimension,
                            struct chosen_fields *fields)
{
    for (int i = 0; names->count == 0 && i < views->count; i++)
        add_whole(fields, views, i, dimension);
    struct error *error = NULL;
    for (int i = 0; i < names->count; i++) {
        int component;
        const struct view *view = views_find(views, names->names[i], &component);
        if (view && component < 0)
            add_whole(fields, views, (int)(view - views->view), dimension);
        else if (view)
            add(fields, views, (int)(view - views->view), component);
        else
            error =
                error_join(error, views_choose(views, names->names[i], NULL, 0, &view, &component));
    }
    return error;
}

double field_value(const struct views *views, const struct chosen_field *field, int64_t index)
{
    double value;
    view_read_component(&views->view[field->view], field->component, index, index + 1, &value);
    return value;
}
