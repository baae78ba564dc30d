/* The catalogue's look-ups and the release of what parameter tables own; see parameter.h. */
#include "base/parameter.h"

#include <stdlib.h>
#include <string.h>

const char *const parameter_axes[] = {"x", "y", "z", NULL};
const char *const parameter_sides[] = {"low", "high", NULL};

const struct choice_list *catalogue_list(const struct catalogue *catalogue, const char *kind)
{
    for (const struct choice_list *list = catalogue->lists; list->kind_of_thing; list++)
        if (!strcmp(list->kind_of_thing, kind))
            return list;
    return NULL;
}

const struct choice *catalogue_find(const struct catalogue *catalogue, const char *kind,
                                    const char *name)
{
    const struct choice_list *list = catalogue_list(catalogue, kind);
    for (int i = 0; list && i < list->count; i++)
        if (!strcmp(list->choices[i].name, name))
            return &list->choices[i];
    return NULL;
}

int named_map_find(const struct named_map *map, const char *name)
{
    if (map->index.slots)
        return name_index_find(&map->index, name);
    for (int i = 0; i < map->count; i++)
        if (!strcmp(map->names[i], name))
            return i;
    return -1;
}

static void names_release(int count, char **names)
{
    for (int i = 0; i < count; i++)
        free(names[i]);
    free(names);
}

static void field_release(struct field_value *field)
{
    varying_expression_free(field->varying);
    field->varying = NULL;
}

static void one_of_release(struct one_of *one_of)
{
    if (one_of->choice && one_of->choice->table && one_of->value)
        parameters_release(one_of->choice->table, one_of->value);
    free(one_of->value);
    *one_of = (struct one_of){.index = -1};
}

/* What a value owns is emptied too, so that releasing twice does no harm. */
static void value_release(const struct parameter *parameter, void *value)
{
    switch (parameter->kind) {
    case PARAMETER_TEXT: {
        char **text = value;
        free(*text);
        *text = NULL;
        break;
    }
    case PARAMETER_NAMES: {
        struct name_list *list = value;
        names_release(list->count, list->names);
        *list = (struct name_list){0};
        break;
    }
    case PARAMETER_VECTORS: {
        struct vector_list *list = value;
        free(list->items);
        *list = (struct vector_list){0};
        break;
    }
    case PARAMETER_FIELD:
        field_release(value);
        break;
    case PARAMETER_FIELDS: {
        struct field_list *list = value;
        for (int i = 0; i < list->count; i++)
            field_release(&list->at[i]);
        break;
    }
    case PARAMETER_TABLE:
        parameters_release(parameter->table, value);
        break;
    case PARAMETER_ONE_OF:
        one_of_release(value);
        break;
    case PARAMETER_LIST: {
        struct one_of_list *list = value;
        for (int i = 0; i < list->count; i++)
            one_of_release(&list->items[i]);
        free(list->items);
        *list = (struct one_of_list){0};
        break;
    }
    case PARAMETER_MAP: {
        struct named_map *map = value;
        for (int i = 0; i < map->count; i++)
            parameters_release(parameter->table, (char *)map->items + (size_t)i * parameter->size);
        names_release(map->count, map->names);
        free(map->items);
        name_index_free(&map->index);
        *map = (struct named_map){0};
        break;
    }
    default: /* numbers, flags, choices and vectors stand in the struct itself */
        break;
    }
}

void parameters_release(const struct parameter *table, void *values)
{
    for (const struct parameter *parameter = table; !PARAMETER_IS_END(parameter); parameter++) {
        value_release(parameter, (char *)values + parameter->offset);
        if (parameter->owned) {
            void **memory = (void **)((char *)values + parameter->owned);
            free(*memory);
            *memory = NULL;
        }
    }
}
