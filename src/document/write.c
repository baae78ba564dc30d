/* From values to YAML, in the order of the tables. A number is written in SI units with the fewest
 * digits that give the same bits again. */
#include <stdlib.h>
#include <string.h>

#include "document/internal.h"

static void write_table(FILE *file, int indent, const struct parameter *table, const void *values);

/* True when TEXT means itself without quotes, in a flow list too. */
static bool is_plain(const char *text)
{
    static const char letters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./ ";
    size_t length = strlen(text);
    return length && strspn(text, letters) == length && text[0] != ' ' && text[0] != '-' &&
           text[length - 1] != ' ' && strcmp(text, "null") != 0 && strncmp(text, "...", 3) != 0;
}

static void write_text(FILE *file, const char *text)
{
    if (is_plain(text)) {
        fputs(text, file);
        return;
    }
    fputc('"', file);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            fprintf(file, "\\%c", *text);
        else if ((unsigned char)*text < ' ' || *text == 0x7f)
            fprintf(file, "\\x%02x", (unsigned char)*text);
        else
            fputc(*text, file);
    }
    fputc('"', file);
}

static void write_number(FILE *file, double value, const char *unit)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    fprintf(file, "%s%s%s", text, unit && unit[0] ? " " : "", unit ? unit : "");
}

static bool is_given(const struct parameter *parameter, const void *value)
{
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        return !isnan(*(const double *)value);
    case PARAMETER_QUANTITY:
        return !isnan(((const struct quantity *)value)->value);
    case PARAMETER_TEXT:
        return *(char *const *)value;
    case PARAMETER_CHOICE:
        return *(const int *)value >= 0;
    case PARAMETER_VECTOR:
        return ((const struct vector_value *)value)->count > 0;
    case PARAMETER_VECTORS:
        return ((const struct vector_list *)value)->count > 0;
    case PARAMETER_FIELD:
        return field_is_given(value);
    case PARAMETER_FIELDS:
        return ((const struct field_list *)value)->count > 0;
    case PARAMETER_NAMES:
        return ((const struct name_list *)value)->count > 0;
    case PARAMETER_ONE_OF:
        return ((const struct one_of *)value)->choice;
    case PARAMETER_MAP: /* an empty list means something */
        return !parameter->listed || ((const struct named_map *)value)->names;
    default:
        return true;
    }
}

static bool table_is_empty(const struct parameter *table, const void *values)
{
    for (; table && !PARAMETER_IS_END(table); table++)
        if (is_given(table, (const char *)values + table->offset))
            return false;
    return true;
}

static void write_indent(FILE *file, int indent) { fprintf(file, "%*s", indent, ""); }

/* What stands behind `key:` for a map: ` {}` or its lines. */
static void write_nested(FILE *file, int indent, const struct parameter *table, const void *values)
{
    if (table_is_empty(table, values)) {
        fputs(" {}\n", file);
        return;
    }
    fputc('\n', file);
    write_table(file, indent + 2, table, values);
}

/* `name:` and its parameters, at the current column, which is INDENT. */
static void write_thing(FILE *file, int indent, const struct one_of *one_of)
{
    write_text(file, one_of->choice->name);
    fputc(':', file);
    write_nested(file, indent, one_of->choice->table, one_of->value);
}

static void write_list(FILE *file, int indent, const struct one_of_list *list)
{
    fputs(list->count ? "\n" : " []\n", file);
    for (int i = 0; i < list->count; i++) {
        write_indent(file, indent + 2);
        fputs("- ", file);
        write_thing(file, indent + 4, &list->items[i]);
    }
}

static void write_map(FILE *file, int indent, const struct parameter *parameter,
                      const struct named_map *map)
{
    fputs(map->count ? "\n" : " {}\n", file);
    for (int i = 0; i < map->count; i++) {
        write_indent(file, indent + 2);
        write_text(file, map->names[i]);
        fputc(':', file);
        write_nested(file, indent + 2, parameter->table,
                     (const char *)map->items + (size_t)i * parameter->size);
    }
}

static void write_names(FILE *file, const struct name_list *list)
{
    fputc('[', file);
    for (int i = 0; i < list->count; i++) {
        fputs(i ? ", " : "", file);
        write_text(file, list->names[i]);
    }
    fputs("]", file);
}

static void write_vector(FILE *file, const struct vector_value *vector, const char *unit)
{
    fputc('[', file);
    for (int i = 0; i < vector->count; i++) {
        fputs(i ? ", " : "", file);
        write_number(file, vector->at[i], unit);
    }
    fputs("]", file);
}

static void write_vectors(FILE *file, const struct vector_list *list, const char *unit)
{
    fputc('[', file);
    for (int i = 0; i < list->count; i++) {
        fputs(i ? ", " : "", file);
        write_vector(file, &list->items[i], unit);
    }
    fputc(']', file);
}

static void write_field(FILE *file, const struct field_value *field, const char *unit)
{
    if (field->varying)
        write_text(file, varying_expression_text(field->varying));
    else
        write_number(file, field->constant, unit);
}

static void write_fields(FILE *file, const struct field_list *list, const char *unit)
{
    fputc('[', file);
    for (int i = 0; i < list->count; i++) {
        fputs(i ? ", " : "", file);
        write_field(file, &list->at[i], unit);
    }
    fputc(']', file);
}

/* A value that stands on its key's line. */
static void write_scalar(FILE *file, const struct parameter *parameter, const void *value)
{
    char unit[DIMENSION_TEXT];
    const struct quantity *quantity = value;
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        write_number(file, *(const double *)value, parameter->unit);
        break;
    case PARAMETER_QUANTITY:
        write_number(file, quantity->value, dimension_text(quantity->dimension, unit));
        break;
    case PARAMETER_INTEGER:
        fprintf(file, "%lld", (long long)*(const int64_t *)value);
        break;
    case PARAMETER_FLAG:
        fputs(*(const bool *)value ? "yes" : "no", file);
        break;
    case PARAMETER_TEXT:
        write_text(file, *(char *const *)value);
        break;
    case PARAMETER_CHOICE:
        write_text(file, parameter->names[*(const int *)value]);
        break;
    case PARAMETER_VECTOR:
        write_vector(file, value, parameter->unit);
        break;
    case PARAMETER_VECTORS:
        write_vectors(file, value, parameter->unit);
        break;
    case PARAMETER_FIELD:
        write_field(file, value, parameter->unit);
        break;
    case PARAMETER_FIELDS:
        write_fields(file, value, parameter->unit);
        break;
    case PARAMETER_NAMES:
        write_names(file, value);
        break;
    default:
        assert(false);
    }
}

static void write_parameter(FILE *file, int indent, const struct parameter *parameter,
                            const void *value)
{
    write_indent(file, indent);
    if (!parameter->key) {
        write_thing(file, indent, value);
        return;
    }
    write_text(file, parameter->key);
    fputc(':', file);
    if (parameter->kind == PARAMETER_TABLE) {
        write_nested(file, indent, parameter->table, value);
    } else if (parameter->kind == PARAMETER_ONE_OF) {
        fputc('\n', file);
        write_indent(file, indent + 2);
        write_thing(file, indent + 2, value);
    } else if (parameter->kind == PARAMETER_LIST) {
        write_list(file, indent, value);
    } else if (parameter->kind == PARAMETER_MAP) {
        write_map(file, indent, parameter, value);
    } else {
        fputc(' ', file);
        write_scalar(file, parameter, value);
        fputc('\n', file);
    }
}

static void write_table(FILE *file, int indent, const struct parameter *table, const void *values)
{
    for (; !PARAMETER_IS_END(table); table++) {
        const void *value = (const char *)values + table->offset;
        if (is_given(table, value))
            write_parameter(file, indent, table, value);
    }
}

struct error *document_write(FILE *file, const struct parameter *table, const void *values)
{
    write_table(file, 0, table, values);
    return ferror(file) ? error_new(ERROR_SYSTEM, "the case could not be written") : NULL;
}
