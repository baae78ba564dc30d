/* bolide help: the parameter tables on the screen. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

static void print_commands(void)
{
    printf("bolide %s: contact and standard SPH for shocks in solids, liquids and gases\n\n",
           BOLIDE_VERSION);
    for (int i = 0; i < command_count; i++)
        printf("  bolide %-7s %-16s %s\n", commands[i].name, commands[i].usage, commands[i].help);
    printf("\nbolide help TOPIC explains a command, `case` (the keys of a case file), `units`,\n"
           "a kind of thing:");
    for (const struct choice_list *list = bolide_catalogue.lists; list->kind_of_thing; list++)
        printf(" %s", list->kind_of_thing);
    printf(",\na thing by its name, or a key of a case by its path: bodies, run.until.\n");
}

/* What a value may be. */
static void kind_text(const struct parameter *p, char *text, size_t size)
{
    static const char *const words[] = {
        [PARAMETER_NUMBER] = "number",
        [PARAMETER_QUANTITY] = "quantity",
        [PARAMETER_INTEGER] = "integer",
        [PARAMETER_FLAG] = "yes or no",
        [PARAMETER_TEXT] = "text",
        [PARAMETER_VECTOR] = "list of numbers",
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
    else if (p->kind == PARAMETER_ONE_OF || p->kind == PARAMETER_LIST)
        snprintf(text, size, "%s %s", p->kind == PARAMETER_LIST ? "list of" : "a",
                 p->kind_of_thing);
    else if (p->kind == PARAMETER_CHOICE)
        for (const char *const *name = p->names; *name && used < size; name++)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? " | " : "", *name);
    else
        snprintf(text, size, "%s", words[p->kind]);
}

static void print_parameter(const struct parameter *p, int indent)
{
    char kind[96], key[64];
    kind_text(p, kind, sizeof kind);
    if (p->key)
        snprintf(key, sizeof key, "%s", p->key);
    else
        snprintf(key, sizeof key, "<%s>", p->kind_of_thing);
    printf("%*s%-*s  %-22s  %s", indent, "", 22 - indent, key, kind, p->help ? p->help : "");
    if (!p->standard)
        printf(" (required)\n");
    else if (p->standard[0])
        printf(" (default: %s)\n", p->standard);
    else
        printf("\n");
}

static void print_table(const struct parameter *table, int indent)
{
    for (const struct parameter *p = table; p && !PARAMETER_IS_END(p); p++) {
        print_parameter(p, indent);
        if (p->kind == PARAMETER_TABLE || p->kind == PARAMETER_MAP)
            print_table(p->table, indent + 2);
    }
}

static void print_choice(const char *kind, const struct choice *choice)
{
    printf("%s%s%s (%s): %s\n", colour(COLOUR_STRONG), choice->name, colour(COLOUR_NONE), kind,
           choice->help);
    print_table(choice->table, 2);
}

static void print_units(void)
{
    for (int i = 0; unit_symbol(i); i++)
        printf("%s%s", unit_symbol(i), (i + 1) % 16 && unit_symbol(i + 1) ? " " : "\n");
    printf("joined by * / ^ and whole numbers: kg/m^3, J/(kg*K), mm/us\n");
}

static bool help_command(const char *topic)
{
    for (int i = 0; i < command_count; i++)
        if (!strcmp(commands[i].name, topic)) {
            printf("bolide %s %s [options]\n%s\n", commands[i].name, commands[i].usage,
                   commands[i].help);
            options_print(&commands[i]);
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

/* A key of the case by its path; names of things in maps are left out: bodies.material. */
static bool help_key(const struct parameter *table, const char *path)
{
    size_t length = strcspn(path, ".");
    for (const struct parameter *p = table; p && !PARAMETER_IS_END(p); p++) {
        if (!p->key || strlen(p->key) != length || strncmp(p->key, path, length) != 0)
            continue;
        if (path[length])
            return help_key(p->table, path + length + 1);
        print_parameter(p, 0);
        print_table(p->table, 2);
        return true;
    }
    return false;
}

/* The nearest of all topics. */
static int unknown_topic(const char *topic)
{
    const char *names[256] = {"case", "units"};
    int count = 2, room = COUNT_OF(names);
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
    return report_error(
        nearest ? error_new(ERROR_INPUT, "no help on \"%s\" (did you mean \"%s\"?)", topic, nearest)
                : error_new(ERROR_INPUT, "no help on \"%s\"; see `bolide help`", topic));
}

int command_help(const struct cli_options *options)
{
    const char *topic = options->names.count ? options->names.text[0] : NULL;
    if (!topic)
        print_commands();
    else if (!strcmp(topic, "case"))
        print_table(case_table, 0);
    else if (!strcmp(topic, "units"))
        print_units();
    else {
        bool found = help_command(topic);
        found = help_thing(topic) || found;
        found = help_key(case_table, topic) || found;
        if (!found)
            return unknown_topic(topic);
    }
    return EXIT_OK;
}
