/* The JSON Schema of a case, a loop over the parameter tables. A document may give a part only
 * where something else fills the rest: what `short` lays over a case, a case that includes another,
 * a material that names one of the library. So everything is defined twice, whole and as a part: a
 * part requires nothing. */
#include "case/schema.h"

#include <string.h>

#include "case/case.h"

/* JSON on its way into a file. */
struct writer {
    FILE *file;
    int depth;
    bool started; /* the innermost bracket holds something */
    const struct catalogue *catalogue;
    bool part; /* nothing is required */
};

static void write_string(FILE *file, const char *text)
{
    fputc('"', file);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            fprintf(file, "\\%c", *text);
        else if ((unsigned char)*text < ' ')
            fprintf(file, "\\u%04x", (unsigned char)*text);
        else
            fputc(*text, file);
    }
    fputc('"', file);
}

static void new_line(const struct writer *w) { fprintf(w->file, "\n%*s", w->depth, ""); }

/* Goes on to the next value: the comma before it, and its key where it has one. */
static void next(struct writer *w, const char *key)
{
    if (w->started)
        fputc(',', w->file);
    if (w->depth > 0)
        new_line(w);
    w->started = true;
    if (key) {
        write_string(w->file, key);
        fputs(": ", w->file);
    }
}

static void begin(struct writer *w, const char *key, char bracket)
{
    next(w, key);
    fputc(bracket, w->file);
    w->depth++;
    w->started = false;
}

static void end(struct writer *w, char bracket)
{
    w->depth--;
    if (w->started)
        new_line(w);
    fputc(bracket, w->file);
    w->started = true;
}

static void text(struct writer *w, const char *key, const char *value)
{
    next(w, key);
    write_string(w->file, value);
}

/* A value that is JSON already. */
static void plain(struct writer *w, const char *key, const char *json)
{
    next(w, key);
    fputs(json, w->file);
}

static void number(struct writer *w, const char *key, double value)
{
    next(w, key);
    fprintf(w->file, "%.17g", value);
}

/* The value is one of NAMES, ended by NULL. */
static void names(struct writer *w, const char *const *list)
{
    begin(w, "enum", '[');
    for (; *list; list++)
        text(w, NULL, *list);
    end(w, ']');
}

static void reference(struct writer *w, const char *kind, const char *name)
{
    char target[160];
    snprintf(target, sizeof target, "#/$defs/%s%s%s%s", w->part ? "part." : "", kind,
             name ? "." : "", name ? name : "");
    text(w, "$ref", target);
}

static bool table_requires(const struct parameter *table);

static bool is_required(const struct parameter *p)
{
    return !p->standard || (p->kind == PARAMETER_TABLE && table_requires(p->table));
}

static bool table_requires(const struct parameter *table)
{
    for (; table && !PARAMETER_IS_END(table); table++)
        if (is_required(table))
            return true;
    return false;
}

static void write_table(struct writer *w, const struct parameter *table);

/* Bounds of a JSON number. With a unit it stands in a string, whose worth only the reader knows. */
static void write_range(struct writer *w, const struct parameter *p)
{
    if (p->above == 0.0 && p->below == 0.0)
        return;
    if (isfinite(p->above))
        number(w, p->closed ? "minimum" : "exclusiveMinimum", p->above);
    if (isfinite(p->below))
        number(w, p->closed ? "maximum" : "exclusiveMaximum", p->below);
}

/* An expression; a bare zero has every dimension. */
static void write_number(struct writer *w, const struct parameter *p)
{
    if (p->unit && p->unit[0]) {
        plain(w, "anyOf", "[{\"type\": \"string\", \"minLength\": 1}, {\"const\": 0}]");
        return;
    }
    plain(w, "type", "[\"string\", \"number\"]");
    plain(w, "minLength", "1");
    write_range(w, p);
}

static void write_vector(struct writer *w, const struct parameter *p)
{
    text(w, "type", "array");
    plain(w, "minItems", "1");
    number(w, "maxItems", p->kind == PARAMETER_FIELDS ? FIELD_COMPONENTS : 3);
    begin(w, "items", '{');
    write_number(w, p);
    end(w, '}');
}

static const char scalar[] = "{\"type\": [\"string\", \"number\", \"boolean\"], \"minLength\": 1}";

/* The names of a kind that may stand alone: those that require nothing. */
static void write_lone_names(struct writer *w, const struct choice_list *list)
{
    begin(w, "enum", '[');
    for (int i = 0; i < list->count; i++)
        if (w->part || !table_requires(list->choices[i].table))
            text(w, NULL, list->choices[i].name);
    end(w, ']');
}

/* The entries NAME: {...} of a kind; each thing is defined once, among $defs. */
static void write_thing_properties(struct writer *w, const struct choice_list *list)
{
    for (int i = 0; i < list->count; i++) {
        begin(w, list->choices[i].name, '{');
        text(w, "description", list->choices[i].help);
        reference(w, list->kind_of_thing, list->choices[i].name);
        end(w, '}');
    }
}

static void write_kind_of_thing(struct writer *w, const struct parameter *p)
{
    const struct choice_list *list = catalogue_list(w->catalogue, p->kind_of_thing);
    begin(w, "anyOf", '[');
    begin(w, NULL, '{');
    write_lone_names(w, list);
    end(w, '}');
    begin(w, NULL, '{');
    text(w, "type", "object");
    plain(w, "minProperties", "1");
    plain(w, "maxProperties", "1");
    plain(w, "additionalProperties", "false");
    begin(w, "properties", '{');
    write_thing_properties(w, list);
    end(w, '}');
    end(w, '}');
    end(w, ']');
}

/* A map with the keys of TABLE; in a part of a case it may have no value, which removes it. Where a
 * key is `library`, the file that it names fills the rest. */
static void write_map_of(struct writer *w, const struct parameter *table)
{
    bool has_library = false;
    for (const struct parameter *p = table; !PARAMETER_IS_END(p); p++)
        has_library = has_library || (p->key && !strcmp(p->key, "library"));
    plain(w, "type", w->part ? "[\"object\", \"null\"]" : "\"object\"");
    if (!has_library || w->part) {
        write_table(w, table);
        return;
    }
    plain(w, "if", "{\"required\": [\"library\"]}");
    begin(w, "then", '{');
    w->part = true;
    write_table(w, table);
    w->part = false;
    end(w, '}');
    begin(w, "else", '{');
    write_table(w, table);
    end(w, '}');
}

static void write_value(struct writer *w, const struct parameter *p)
{
    switch (p->kind) {
    case PARAMETER_NUMBER:
    case PARAMETER_FIELD:
        write_number(w, p);
        break;
    case PARAMETER_QUANTITY:
        plain(w, "type", "[\"string\", \"number\"]");
        plain(w, "minLength", "1");
        break;
    case PARAMETER_INTEGER:
        plain(w, "type", "[\"string\", \"integer\"]");
        plain(w, "minLength", "1");
        write_range(w, p);
        break;
    case PARAMETER_FLAG:
        plain(w, "enum", "[\"yes\", \"no\"]");
        break;
    case PARAMETER_TEXT:
        plain(w, "type", "[\"string\", \"number\", \"boolean\"]");
        plain(w, "minLength", "1");
        break;
    case PARAMETER_CHOICE:
        names(w, p->names);
        break;
    case PARAMETER_VECTOR:
    case PARAMETER_FIELDS:
        write_vector(w, p);
        break;
    case PARAMETER_VECTORS:
        text(w, "type", "array");
        begin(w, "items", '{');
        write_vector(w, p);
        end(w, '}');
        break;
    case PARAMETER_NAMES:
        begin(w, "anyOf", '[');
        plain(w, NULL, scalar);
        begin(w, NULL, '{');
        text(w, "type", "array");
        plain(w, "items", scalar);
        end(w, '}');
        end(w, ']');
        break;
    case PARAMETER_TABLE:
        plain(w, "type",
              w->part || !table_requires(p->table) ? "[\"object\", \"null\"]" : "\"object\"");
        write_table(w, p->table);
        break;
    case PARAMETER_ONE_OF:
        write_kind_of_thing(w, p);
        break;
    case PARAMETER_LIST:
        text(w, "type", "array");
        begin(w, "items", '{');
        write_kind_of_thing(w, p);
        end(w, '}');
        break;
    case PARAMETER_MAP:
        plain(w, "type",
              p->listed ? "[\"object\", \"array\", \"string\", \"null\"]"
                        : "[\"object\", \"null\"]");
        begin(w, "additionalProperties", '{');
        write_map_of(w, p->table);
        end(w, '}');
        break;
    }
}

/* The help with the unit behind it, and the default: as a value where the case has a scalar. */
static void write_description(struct writer *w, const struct parameter *p)
{
    const char *unit = p->unit && p->unit[0] ? p->unit : NULL;
    const char *standard = p->standard && p->standard[0] ? p->standard : NULL;
    bool structured = standard && (standard[0] == '[' || standard[0] == '{');
    char words[512];
    snprintf(words, sizeof words, "%s%s%s%s%s%s", p->help ? p->help : "", unit ? " [" : "",
             unit ? unit : "", unit ? "]" : "", structured ? "; default: " : "",
             structured ? standard : "");
    if (words[0])
        text(w, "description", words);
    if (standard && !structured)
        text(w, "default", standard);
}

/* Of the names of a kind that stands inline one is wanted, or one at most. */
static void write_inline_choice(struct writer *w, const struct parameter *p)
{
    const struct choice_list *list = catalogue_list(w->catalogue, p->kind_of_thing);
    bool optional = w->part || p->standard;
    begin(w, NULL, '{');
    begin(w, "oneOf", '[');
    for (int i = 0; i < list->count + optional; i++) {
        begin(w, NULL, '{');
        if (i == list->count) {
            begin(w, "not", '{');
            begin(w, "anyOf", '[');
            for (int k = 0; k < list->count; k++) {
                begin(w, NULL, '{');
                begin(w, "required", '[');
                text(w, NULL, list->choices[k].name);
                end(w, ']');
                end(w, '}');
            }
            end(w, ']');
            end(w, '}');
        } else {
            begin(w, "required", '[');
            text(w, NULL, list->choices[i].name);
            end(w, ']');
        }
        end(w, '}');
    }
    end(w, ']');
    end(w, '}');
}

static void write_properties(struct writer *w, const struct parameter *table)
{
    for (; table && !PARAMETER_IS_END(table); table++) {
        if (!table->key) {
            write_thing_properties(w, catalogue_list(w->catalogue, table->kind_of_thing));
            continue;
        }
        begin(w, table->key, '{');
        write_description(w, table);
        write_value(w, table);
        end(w, '}');
    }
}

static void write_requirements(struct writer *w, const struct parameter *table)
{
    bool choices = false;
    begin(w, "required", '[');
    for (const struct parameter *p = table; p && !PARAMETER_IS_END(p); p++) {
        choices = choices || !p->key;
        if (p->key && is_required(p) && !w->part)
            text(w, NULL, p->key);
    }
    end(w, ']');
    if (!choices)
        return;
    begin(w, "allOf", '[');
    for (const struct parameter *p = table; !PARAMETER_IS_END(p); p++)
        if (!p->key)
            write_inline_choice(w, p);
    end(w, ']');
}

static void write_table(struct writer *w, const struct parameter *table)
{
    plain(w, "additionalProperties", "false");
    begin(w, "properties", '{');
    write_properties(w, table);
    end(w, '}');
    write_requirements(w, table);
}

/* What stands for the first parameter of a thing where it is given alone: `{mean: pressure}`. */
static void write_shorthand(struct writer *w, const struct parameter *table)
{
    const struct parameter *first = table;
    if (!table || !table->key || (!w->part && table_requires(table + 1)) ||
        first->kind == PARAMETER_TABLE || first->kind == PARAMETER_MAP)
        return;
    begin(w, NULL, '{');
    if (first->kind == PARAMETER_ONE_OF)
        write_lone_names(w, catalogue_list(w->catalogue, first->kind_of_thing));
    else
        write_value(w, first);
    end(w, '}');
}

/* The definition of a thing: its map, nothing where it requires nothing, or its first parameter. */
static void write_thing(struct writer *w, const char *kind, const struct choice *choice)
{
    char name[128];
    snprintf(name, sizeof name, "%s%s.%s", w->part ? "part." : "", kind, choice->name);
    begin(w, name, '{');
    begin(w, "anyOf", '[');
    begin(w, NULL, '{');
    plain(w, "type",
          w->part || !table_requires(choice->table) ? "[\"object\", \"null\"]" : "\"object\"");
    write_table(w, choice->table);
    end(w, '}');
    write_shorthand(w, choice->table);
    end(w, ']');
    end(w, '}');
}

/* The keys that shape a case before its table reads it; what they may be is not in any table. */
static void write_shaping_keys(struct writer *w)
{
#define SWEPT                                            \
    "{\"type\": \"array\", \"minItems\": 1, \"items\": " \
    "{\"type\": [\"string\", \"number\", \"boolean\", \"array\"], \"minLength\": 1}}"
    static const char *const schemas[][2] = {
        {"include", "\"anyOf\": [{\"type\": \"string\", \"minLength\": 1}, "
                    "{\"type\": \"array\", \"items\": {\"type\": \"string\", \"minLength\": 1}}]"},
        {"let", "\"type\": [\"object\", \"null\"], "
                "\"propertyNames\": {\"pattern\": \"^[A-Za-z_][A-Za-z0-9_]*$\"}, "
                "\"additionalProperties\": {\"type\": [\"string\", \"number\"], \"minLength\": 1}"},
        {"short", "\"$ref\": \"#/$defs/part.case\", \"properties\": "
                  "{\"short\": false, \"long\": false, \"include\": false}"},
        {"long", "\"$ref\": \"#/$defs/part.case\", \"properties\": "
                 "{\"short\": false, \"long\": false, \"include\": false}"},
        {"sweep", "\"type\": [\"object\", \"null\"], \"additionalProperties\": {\"anyOf\": [" SWEPT
                  ", {\"type\": \"object\", \"minProperties\": 1, "
                  "\"additionalProperties\": " SWEPT "}]}"},
        {"walls", "\"type\": [\"object\", \"null\"]"},
        {"outflows", "\"type\": [\"object\", \"null\"]"},
        {"obstacles", "\"type\": [\"object\", \"null\"]"},
    };
    for (const struct parameter *p = case_shaping_table; !PARAMETER_IS_END(p); p++) {
        begin(w, p->key, '{');
        text(w, "description", p->help);
        for (size_t i = 0; i < COUNT_OF(schemas); i++)
            if (!strcmp(schemas[i][0], p->key)) {
                next(w, NULL);
                fputs(schemas[i][1], w->file);
            }
        end(w, '}');
    }
}

static void write_case(struct writer *w)
{
    begin(w, w->part ? "part.case" : "case", '{');
    text(w, "type", "object");
    plain(w, "additionalProperties", "false");
    begin(w, "properties", '{');
    write_properties(w, case_table);
    write_shaping_keys(w);
    end(w, '}');
    write_requirements(w, case_table);
    end(w, '}');
}

static void write_definitions(struct writer *w)
{
    write_case(w);
    for (const struct choice_list *list = w->catalogue->lists; list->kind_of_thing; list++)
        for (int i = 0; i < list->count; i++)
            write_thing(w, list->kind_of_thing, &list->choices[i]);
}

struct error *schema_write(FILE *file, const struct catalogue *catalogue)
{
    struct writer w = {.file = file, .catalogue = catalogue};
    begin(&w, NULL, '{');
    text(&w, "$schema", "https://json-schema.org/draft/2020-12/schema");
    text(&w, "title", "A case of Bolide");
    plain(&w, "if", "{\"required\": [\"include\"]}");
    plain(&w, "then", "{\"$ref\": \"#/$defs/part.case\"}");
    plain(&w, "else", "{\"$ref\": \"#/$defs/case\"}");
    begin(&w, "$defs", '{');
    write_definitions(&w);
    w.part = true;
    write_definitions(&w);
    end(&w, '}');
    end(&w, '}');
    fputc('\n', file);
    return ferror(file) ? error_new(ERROR_SYSTEM, "the schema could not be written") : NULL;
}
