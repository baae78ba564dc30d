/* bolide help: the parameter tables on the screen. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "material/material.h"
#include "model/particles/population.h"
#include "model/solver.h"

static void print_topics(void)
{
    int column = 22;
    printf("bolide help TOPIC explains\n"
           "  a command           run, verify, ...\n"
           "  case, units, fields the keys of a case file; the units; the fields of particles and "
           "cells\n"
           "  a kind of thing    ");
    for (const struct choice_list *list = bolide_catalogue.lists; list->kind_of_thing; list++) {
        const char *kind = list->kind_of_thing, *comma = list[1].kind_of_thing ? "," : "";
        column += 2 + (int)strlen(kind);
        printf("%s %s%s", column > 100 ? "\n                     " : "", kind, comma);
        if (column > 100)
            column = 24 + (int)strlen(kind);
    }
    printf("\n"
           "  a thing             johnson-cook, muscl, box, ...\n"
           "  a key of a case     bodies, run.until, bodies.flyer.velocity, ...\n"
           "  a word              spall, crater, restart, film, ParaView, MPI, units of stress, "
           "...\n");
}

static void print_commands(void)
{
    printf("bolide %s: shocks in solids, liquids and gases, with SPH, the material point method or "
           "a grid\n\n",
           BOLIDE_VERSION);
    for (int i = 0; i < command_count; i++)
        printf("  bolide %-9s %-16s %s\n", commands[i].name, commands[i].usage, commands[i].help);
    printf("\n");
    print_topics();
}

/* What a value may be; TEXT has room for the longest list of choices. */
static void kind_text(const struct parameter *p, char *text, size_t size)
{
    static const char *const words[] = {
        [PARAMETER_NUMBER] = "number",
        [PARAMETER_QUANTITY] = "quantity",
        [PARAMETER_INTEGER] = "integer",
        [PARAMETER_FLAG] = "yes or no",
        [PARAMETER_TEXT] = "text",
        [PARAMETER_VECTOR] = "list of numbers",
        [PARAMETER_VECTORS] = "list of lists of numbers",
        [PARAMETER_FIELD] = "field",
        [PARAMETER_FIELDS] = "list of fields",
        [PARAMETER_NAMES] = "list of names",
        [PARAMETER_TABLE] = "map",
        [PARAMETER_MAP] = "map by name",
        [PARAMETER_CHOICE] = "",
        [PARAMETER_ONE_OF] = "",
        [PARAMETER_LIST] = "",
    };
    const char *unit = p->unit ? p->unit : "";
    size_t used = 0;
    text[0] = '\0';
    if (p->kind == PARAMETER_NUMBER && unit[0])
        snprintf(text, size, "%s", unit);
    else if (p->kind == PARAMETER_VECTOR && unit[0])
        snprintf(text, size, "list of %s", unit);
    else if (p->kind == PARAMETER_VECTORS && unit[0])
        snprintf(text, size, "list of lists of %s", unit);
    else if ((p->kind == PARAMETER_FIELD || p->kind == PARAMETER_FIELDS) && unit[0])
        snprintf(text, size, "%s, %s", words[p->kind], unit);
    else if (p->kind == PARAMETER_ONE_OF || p->kind == PARAMETER_LIST)
        snprintf(text, size, "%s<%s>", p->kind == PARAMETER_LIST ? "list of " : "",
                 p->kind_of_thing);
    else if (p->kind == PARAMETER_CHOICE)
        for (const char *const *name = p->names; *name && used < size; name++)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? " | " : "", *name);
    else
        snprintf(text, size, "%s", words[p->kind]);
}

/* What P has of the class that is AROUND it. */
static enum parameter_change change_of(const struct parameter *p, enum parameter_change around)
{
    return p->change == CHANGE_AS_AROUND ? around : p->change;
}

/* The class of what is in P. */
static enum parameter_change change_in(const struct parameter *p, enum parameter_change around)
{
    return p->change_within == CHANGE_AS_AROUND ? change_of(p, around) : p->change_within;
}

/* AROUND is the class that the keys beside P have. */
static void print_parameter(const struct parameter *p, int indent, enum parameter_change around)
{
    static const char *const words[] = {"", " [fixed]", " [from here]", " [free]"};
    enum { WIDTH = 22 };
    char kind[512], key[96];
    kind_text(p, kind, sizeof kind);
    snprintf(key, sizeof key, "%.*s", (int)sizeof key - 1, p->key ? p->key : kind);
    if (!p->key)
        snprintf(kind, sizeof kind, "by its name");
    printf("%*s%-*s  %-*s", indent, "", WIDTH - indent, key, WIDTH, kind);
    if (strlen(kind) > WIDTH)
        printf("\n%*s", 2 * WIDTH + 2, "");
    printf("  %s", p->help ? p->help : "");
    if (!p->standard)
        printf(" (required)");
    else if (p->standard[0])
        printf(" (default: %s)", p->standard);
    const enum parameter_change own = change_of(p, around);
    printf("%s\n", own == around ? "" : words[own]);
}

static void print_table(const struct parameter *table, int indent, enum parameter_change around)
{
    for (const struct parameter *p = table; p && !PARAMETER_IS_END(p); p++) {
        print_parameter(p, indent, around);
        if (p->kind == PARAMETER_TABLE || p->kind == PARAMETER_MAP)
            print_table(p->table, indent + 2, change_in(p, around));
    }
}

/* P by itself, with the class that it has where AROUND is that of what it is in. */
static void print_key(const struct parameter *p, enum parameter_change around)
{
    struct parameter key = *p;
    key.change = change_of(p, around);
    print_parameter(&key, 0, CHANGE_NEVER);
    print_table(p->table, 2, change_in(p, around));
}

/* A line about the classes of keys that may change in a resumed run. */
static void print_classes(void)
{
    printf(
        "With --resume keys marked [free] may have another value than before; those marked\n"
        "[from here] with --change too, from the checkpoint on; all others, and [fixed] ones in\n"
        "a map that is marked, may not.\n");
}

static void print_choice(const char *kind, const struct choice *choice)
{
    printf("%s%s%s (%s): %s\n", colour(COLOUR_STRONG), choice->name, colour(COLOUR_NONE), kind,
           choice->help);
    print_table(choice->table, 2, CHANGE_NEVER);
}

static void print_units(void)
{
    for (int i = 0; unit_symbol(i); i++)
        printf("%s%s", unit_symbol(i), (i + 1) % 16 && unit_symbol(i + 1) ? " " : "\n");
    printf("combined with *, / and ^ with a whole exponent: kg/m^3, J/(kg*K), mm/us\n");
}

/* A line about a field; WHERE says when the store has it, NULL: always. */
static void print_field(const struct field_declaration *field, const char *where)
{
    printf("  %-22s  %-16s  %s%s", field->name, field->unit[0] ? field->unit : "number",
           field->help ? field->help : "",
           field->components == 3   ? ": .x .y .z"
           : field->components == 6 ? ": .xx .yy .zz .xy .yz .zx"
                                    : "");
    if (where)
        printf(" (%s)", where);
    printf("\n");
}

/* A field that a solver shows. */
struct shown {
    struct field_declaration field;
    const char *where;
};
enum { SHOWN_MAX = 64 };

static int fields_of_solver(const struct solver_class *class, struct shown *shown)
{
    int count = 0;
    for (const struct field_row *const *table = class->fields; table && *table; table++)
        for (const struct field_row *row = *table; row->field.name; row++)
            if (row->field.unit && count < SHOWN_MAX)
                shown[count++] = (struct shown){row->field, row->where};
    return count;
}

static bool lists(const struct solver_class *class, const struct shown *one)
{
    struct shown shown[SHOWN_MAX];
    const int count = fields_of_solver(class, shown);
    for (int k = 0; k < count; k++)
        if (!strcmp(shown[k].field.name, one->field.name) && !shown[k].where == !one->where &&
            (!one->where || !strcmp(shown[k].where, one->where)))
            return true;
    return false;
}

static bool every_solver_lists(const struct choice_list *solvers, const struct shown *one)
{
    for (int i = 0; i < solvers->count; i++) {
        const struct solver_class *class = solvers->choices[i].thing;
        if (class->fields && !lists(class, one)) /* couplings have those of others */
            return false;
    }
    return true;
}

/* The fields of solver INDEX that all solvers have, or with OWN the others, under HEADING; KNOWN
 * are listed already. */
static void print_solver_fields(const struct choice_list *solvers, int index, bool own,
                                const char *heading, const struct population *known)
{
    struct shown shown[SHOWN_MAX];
    const int count = fields_of_solver(solvers->choices[index].thing, shown);
    int component;
    bool started = false;
    for (int k = 0; k < count; k++) {
        if (every_solver_lists(solvers, &shown[k]) == own ||
            column_find(known, shown[k].field.name, &component))
            continue;
        if (!started)
            printf("with %s%s:\n", heading, own ? solvers->choices[index].name : "");
        started = true;
        print_field(&shown[k].field, shown[k].where);
    }
}

/* What all particles show: the core's fields, and columns computed from them. */
static struct error *print_common_fields(struct simulation *empty, struct particles **particles,
                                         struct population *common)
{
    TRY(particles_add(empty, 1.0, NULL, 0, particles));
    *common = simulation_population(empty);
    printf("fields of the particles, for checks and output.pictures:\n");
    for (int i = 0; i < common->columns; i++) {
        const struct column *column = &common->column[i];
        print_field(&(struct field_declaration){.name = column->name,
                                                .unit = column->unit,
                                                .help = column->help,
                                                .components = column->components},
                    NULL);
    }
    return NULL;
}

/* The common fields, those of materials, then those that a solver adds. */
static struct error *print_fields(void)
{
    const struct choice_list *solvers = catalogue_list(&bolide_catalogue, "solver");
    const struct simulation_case no_case = {0};
    struct material gas = {.heat.capacity = 1.0}; /* an ideal gas, so that there is a temperature */
    struct simulation *empty = memory_allocate(sizeof *empty);
    struct particles *particles = NULL;
    struct population common = {0};
    if (!empty)
        return out_of_memory();
    const struct problem problem = {
        .input = &no_case, .dimension = 3, .materials = 1, .material = &gas};
    empty->problem = &problem;
    struct error *error = print_common_fields(empty, &particles, &common);
    if (!error) {
        printf("where a material has it:\n");
        for (int slot = 1; slot < POINT_HISTORY; slot++) /* the first is the core's */
            print_field(&(struct field_declaration){.name = history_slots[slot].name,
                                                    .unit = history_slots[slot].unit,
                                                    .help = history_slots[slot].help,
                                                    .components = 1},
                        NULL);
        print_solver_fields(solvers, 0, false, "every solver", &common);
        for (int i = 0; i < solvers->count; i++)
            print_solver_fields(solvers, i, true, "the solver ", &common);
        printf("pictures also take material, body, schlieren, and fragment with\n"
               "output.fragments\n");
    }
    particles_drop(particles);
    free(empty);
    return error;
}

static bool help_command(const char *topic)
{
    for (int i = 0; i < command_count; i++)
        if (!strcmp(commands[i].name, topic)) {
            printf("bolide %s %s [options]\n%s\n", commands[i].name, commands[i].usage,
                   commands[i].help);
            options_print(&commands[i]);
            if (commands[i].bit == COMMAND_HELP)
                print_topics();
            return true;
        }
    return false;
}

/* A kind, or every thing of that name. */
static bool help_thing(const char *topic)
{
    bool found = false;
    for (const struct choice_list *list = bolide_catalogue.lists; list->kind_of_thing; list++) {
        bool whole = !strcmp(list->kind_of_thing, topic);
        if (whole)
            printf("%s: %s\n", list->kind_of_thing, list->help);
        for (int i = 0; i < list->count; i++)
            if (whole || !strcmp(list->choices[i].name, topic)) {
                print_choice(list->kind_of_thing, &list->choices[i]);
                found = true;
            }
    }
    return found;
}

static bool help_key(const struct parameter *table, const char *path, enum parameter_change around);
static bool help_inside(const struct parameter *p, const char *path, enum parameter_change around);

static bool starts_with(const char *path, const char *word)
{
    size_t length = strcspn(path, ".");
    return strlen(word) == length && !strncmp(path, word, length);
}

static bool is_number(const char *path)
{
    size_t length = strcspn(path, ".");
    return length && strspn(path, "0123456789") == length;
}

/* What stands behind the first dot of PATH, NULL if nothing does. */
static const char *behind_dot(const char *path)
{
    const char *dot = strchr(path, '.');
    return dot ? dot + 1 : NULL;
}

/* A path that goes on with the name of a thing of KIND: sph.skin. */
static bool help_thing_key(const char *kind, const char *path, enum parameter_change around)
{
    const struct choice_list *list = catalogue_list(&bolide_catalogue, kind);
    const char *rest = behind_dot(path);
    for (int i = 0; i < list->count; i++) {
        if (!starts_with(path, list->choices[i].name))
            continue;
        const struct parameter *table = list->choices[i].table;
        if (rest && table && is_number(rest)) /* an item of the first parameter: union.2 */
            return help_inside(table, rest, around);
        if (rest)
            return help_key(table, rest, around);
        print_choice(kind, &list->choices[i]);
        return true;
    }
    return false;
}

/* The keys behind P. Names that a user chose and numbers of items stand for any word, or are left
 * out: bodies.flyer.velocity, bodies.velocity. */
static bool help_inside(const struct parameter *p, const char *path, enum parameter_change around)
{
    const char *rest = behind_dot(path);
    const enum parameter_change within = change_in(p, around);
    if (p->kind == PARAMETER_ONE_OF)
        return help_thing_key(p->kind_of_thing, path, within);
    if (p->table && help_key(p->table, path, within))
        return true;
    bool items = p->kind == PARAMETER_LIST || p->kind == PARAMETER_VECTOR ||
                 p->kind == PARAMETER_VECTORS || p->kind == PARAMETER_FIELDS ||
                 p->kind == PARAMETER_NAMES;
    if (p->kind != PARAMETER_MAP && !(items && is_number(path)))
        return false;
    if (rest && p->table)
        return help_key(p->table, rest, within);
    if (rest && p->kind == PARAMETER_LIST)
        return help_thing_key(p->kind_of_thing, rest, within);
    if (rest && items)
        return help_inside(p, rest, around);
    print_key(p, around);
    return true;
}

/* A key of TABLE by its path. */
static bool help_key(const struct parameter *table, const char *path, enum parameter_change around)
{
    const char *rest = behind_dot(path);
    for (const struct parameter *p = table; p && !PARAMETER_IS_END(p); p++) {
        if (!p->key && help_thing_key(p->kind_of_thing, path, around))
            return true;
        if (!p->key || !starts_with(path, p->key))
            continue;
        if (rest)
            return help_inside(p, rest, around);
        print_key(p, around);
        return true;
    }
    return false;
}

static bool is_top_key(const struct parameter *table, const char *name)
{
    for (const struct parameter *p = table; !PARAMETER_IS_END(p); p++)
        if (p->key && !strcmp(p->key, name))
            return true;
    return false;
}

/* All that TOPIC names: a word, a command, things, and a key of a case. */
static bool help_topic(const char *topic)
{
    bool found = help_word(topic);
    found = help_command(topic) || found;
    found = help_thing(topic) || found;
    if (found && (is_top_key(case_table, topic) || is_top_key(case_shaping_table, topic)))
        printf("\nas a key of a case:\n");
    return help_key(case_table, topic, CHANGE_NEVER) ||
           help_key(case_shaping_table, topic, CHANGE_NEVER) || found;
}

/* The same with hyphens for blanks: johnson cook. */
static bool help_hyphenated(const char *topic)
{
    char name[128];
    snprintf(name, sizeof name, "%s", topic);
    for (char *c = name; *c; c++)
        if (*c == ' ')
            *c = '-';
    return strcmp(name, topic) != 0 && help_topic(name);
}

/* The nearest of all topics, or what mentions TOPIC. */
static int unknown_topic(const char *topic)
{
    const char *names[256] = {"case", "units", "fields", "let", "short", "long"};
    int count = 6, room = COUNT_OF(names);
    for (int i = 0; i < command_count && count < room; i++)
        names[count++] = commands[i].name;
    for (const struct choice_list *list = bolide_catalogue.lists; list->kind_of_thing; list++) {
        if (count < room)
            names[count++] = list->kind_of_thing;
        for (int i = 0; i < list->count && count < room; i++)
            names[count++] = list->choices[i].name;
    }
    for (const struct parameter *p = case_table; !PARAMETER_IS_END(p) && count < room; p++)
        if (p->key)
            names[count++] = p->key;
    const char *nearest = nearest_name(topic, names, count);
    if ((!nearest || is_library_material(topic)) && help_search(topic))
        return EXIT_OK;
    return report_error(
        nearest ? error_new(ERROR_INPUT, "no help on \"%s\" (did you mean \"%s\"?)", topic, nearest)
                : error_new(ERROR_INPUT, "no help on \"%s\"; see `bolide help`", topic));
}

/* The words of `bolide help units of stress` as one text in BUFFER; NULL without any. */
static const char *topic_of(const struct text_list *names, char *buffer, size_t size)
{
    size_t used = 0;
    for (int i = 0; i < names->count && used < size; i++)
        used += (size_t)snprintf(buffer + used, size - used, "%s%s", i ? " " : "", names->text[i]);
    return names->count ? buffer : NULL;
}

int command_help(const struct cli_options *options)
{
    char topic_buffer[128];
    const char *topic = topic_of(&options->names, topic_buffer, sizeof topic_buffer);
    if (!topic)
        print_commands();
    else if (!strcmp(topic, "case")) {
        print_table(case_table, 0, CHANGE_NEVER);
        print_table(case_shaping_table, 0, CHANGE_NEVER);
        print_classes();
    } else if (!strcmp(topic, "units"))
        print_units();
    else if (!strcmp(topic, "fields")) {
        struct error *error = print_fields();
        return error ? report_error(error) : EXIT_OK;
    } else {
        if (!strncmp(topic, "short.", 6)) /* the keys of a form are those of a case */
            topic += 6;
        else if (!strncmp(topic, "long.", 5))
            topic += 5;
        if (!help_topic(topic) && !help_hyphenated(topic))
            return unknown_topic(topic);
    }
    return EXIT_OK;
}
