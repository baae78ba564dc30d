/* Measured series; see measured.h. */
#include "page/measured.h"

#include <stdlib.h>
#include <string.h>

#include "base/expression.h"
#include "base/memory.h"
#include "base/units.h"

void compare_data_free(struct compare_data *data)
{
    free(data->path);
    free(data->time);
    free(data->value);
    free(data->probe);
    free(data->field);
    *data = (struct compare_data){0};
}

static struct error *read_shift(const char *text, double *shift)
{
    struct quantity quantity;
    static const struct dimension seconds = {.time = 1};
    TRY(error_context(expression_evaluate(text, NULL, &quantity), "shift"));
    if (!dimension_equal(quantity.dimension, seconds))
        return error_new(ERROR_INPUT, "shift: \"%s\" is not a time, such as 20ns", text);
    *shift = quantity.value;
    return NULL;
}

struct error *compare_data_read(const char *text, struct compare_data *data)
{
    static const char *const keys[] = {"time", "value", "probe", "field", "shift"};
    *data = (struct compare_data){.path = text_copy_part(text, strcspn(text, ","))};
    char **const place[] = {&data->time, &data->value, &data->probe, &data->field};
    for (const char *at = strchr(text, ','); at; at = strchr(at + 1, ',')) {
        const char *key = at + 1, *equals = strchr(key, '=');
        size_t k = 0;
        while (equals && k < COUNT_OF(keys) &&
               (strlen(keys[k]) != (size_t)(equals - key) ||
                strncmp(keys[k], key, strlen(keys[k])) != 0))
            k++;
        if (!equals || k == COUNT_OF(keys))
            return error_new(ERROR_INPUT,
                             "--data: \"%.60s\" is none of time=, value=, probe=, "
                             "field=, shift=",
                             key);
        char *value = text_copy_part(equals + 1, strcspn(equals + 1, ","));
        if (!value)
            return out_of_memory();
        if (k < COUNT_OF(place)) {
            free(*place[k]);
            *place[k] = value;
            continue;
        }
        struct error *error = read_shift(value, &data->shift);
        free(value);
        TRY(error_context(error, "--data"));
    }
    return data->path ? NULL : out_of_memory();
}

char *compare_unit(const char *head)
{
    const char *bracket = strchr(head, '[');
    return bracket ? text_copy_part(bracket + 1, strcspn(bracket + 1, "]")) : text_copy("");
}

/* The length of HEAD without its unit. */
static size_t bare_length(const char *head)
{
    const size_t length = strcspn(head, "[");
    return length > 0 && head[length] && head[length - 1] == ' ' ? length - 1 : length;
}

/* The column whose head, with or without its unit, is the first LENGTH bytes of NAME; -1: none. */
static int column_of(const struct csv *csv, const char *name, size_t length)
{
    for (int i = 0; i < csv->columns; i++) {
        const char *head = csv_head(csv, i);
        if ((strlen(head) == length || bare_length(head) == length) && !strncmp(head, name, length))
            return i;
    }
    return -1;
}

/* What is looked for in a table: the key "time" or "value", what the user GAVE for it (NULL:
 * nothing), and the UNIT of what it must be like. */
struct wanted {
    const struct compare_data *data;
    const char *key, *given, *unit;
};

struct found {
    int column;
    struct unit unit;
};

/* WHAT is wrong (taken; NULL: memory is out), and the columns that there are. */
static struct error *wrong_column(const struct csv *csv, const struct wanted *wanted, char *what)
{
    char *known = csv_heads(csv, 0);
    struct error *error = known && what ? error_new(ERROR_INPUT, "%s: %s (known: %s)",
                                                    wanted->data->path, what, known)
                                        : out_of_memory();
    free(known);
    free(what);
    return error;
}

/* FOUND->column, and the unit that was given behind its name; NULL: none was. */
static struct error *find_column(const struct csv *csv, const struct wanted *wanted, int first,
                                 struct found *found, const char **unit)
{
    const char *given = wanted->given, *field = wanted->data->field;
    *unit = NULL;
    if (given) {
        const char *colon = strrchr(given, ':');
        size_t length = strlen(given);
        found->column = column_of(csv, given, length);
        if (found->column < 0 && colon) {
            length = (size_t)(colon - given);
            found->column = column_of(csv, given, length);
            *unit = colon + 1;
        }
        if (found->column >= 0)
            return NULL;
        return wrong_column(csv, wanted,
                            text_format("there is no column \"%.*s\"", (int)length, given));
    }
    found->column = first > 0 ? column_of(csv, field, bare_length(field)) : -1;
    if (found->column < 0)
        found->column = first;
    return found->column < csv->columns
               ? NULL
               : wrong_column(csv, wanted, text_copy("there is no second column"));
}

static struct error *without_unit(const struct wanted *wanted, const char *head)
{
    const bool in_case = wanted->data->in_case;
    return error_new(ERROR_INPUT, "%s: no unit in `%s`; write `%s%s%s:%s`", wanted->data->path,
                     head, wanted->key, in_case ? ": " : "=", head,
                     strcmp(wanted->key, "time") != 0 ? wanted->unit : "us");
}

/* Fills FOUND->unit from the unit that was GIVEN (NULL: none), else from that in the head. */
static struct error *find_unit(const struct csv *csv, const struct wanted *wanted,
                               const char *given, struct found *found)
{
    const char *head = csv_head(csv, found->column);
    struct unit like, own;
    char *text = compare_unit(head);
    struct error *error = text ? unit_parse(text, &own) : out_of_memory();
    const bool has = text && *text && !error;
    free(text);
    if (given) { /* in place of one that is not known */
        error_free(error);
        error = NULL;
    }
    error = error_context(error, "%s: `%s`", wanted->data->path, head);
    if (!error && given)
        error = error_context(unit_parse(given, &found->unit), "%s: `%s`", wanted->data->path,
                              wanted->given);
    if (!error)
        error = unit_parse(wanted->unit, &like);
    TRY(error);
    if (given && has && !dimension_equal(own.dimension, found->unit.dimension))
        return error_new(ERROR_INPUT, "%s: the unit of `%s` contradicts that of the column, `%s`",
                         wanted->data->path, wanted->given, head);
    if (!given)
        found->unit = own;
    if (dimension_equal(found->unit.dimension, like.dimension))
        return NULL;
    if (!given && !has)
        return without_unit(wanted, head);
    const char *is = given ? wanted->given : head, *field = wanted->data->field;
    if (!strcmp(wanted->key, "time"))
        return wrong_column(csv, wanted, text_format("`%s` is not a time", is));
    return wrong_column(csv, wanted,
                        text_format("`%s` is not a quantity like `%s`, which is in %s", is, field,
                                    *wanted->unit ? wanted->unit : "plain numbers"));
}

static struct error *find(const struct csv *csv, const struct wanted *wanted, int first,
                          struct found *found)
{
    const char *given;
    TRY(find_column(csv, wanted, first, found, &given));
    return find_unit(csv, wanted, given, found);
}

struct error *compare_data_curve(const struct compare_data *data, const char *unit,
                                 struct curve *curve)
{
    struct csv csv;
    struct found time, value;
    TRY(csv_read(data->path, &csv));
    struct error *error =
        csv.columns ? NULL : error_new(ERROR_INPUT, "%s: there is no such table", data->path);
    const struct wanted of_time = {data, "time", data->time, "s"};
    const struct wanted of_value = {data, "value", data->value, unit};
    if (!error)
        error = error_join(find(&csv, &of_time, 0, &time), find(&csv, &of_value, 1, &value));
    if (!error)
        error = curve_make(&csv, time.column, value.column, time.unit.scale, value.unit.scale,
                           data->shift, curve);
    for (int64_t i = 0; !error && i < curve->count; i++)
        curve->value[i] += value.unit.offset;
    csv_free(&csv);
    return error;
}
