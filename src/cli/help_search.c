/* Help by a word that is no topic: whatever has it in its name or its help. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "case/library.h"
#include "cli/cli.h"

struct help_search {
    const char *text;
    int found;
};

static bool contains(const char *whole, const char *part)
{
    const size_t length = strlen(part);
    for (; *whole; whole++)
        if (!strncasecmp(whole, part, length))
            return true;
    return false;
}

/* Prints TOPIC, which ends with NAME, if it is looked for. */
static void try_entry(struct help_search *search, const char *topic, const char *name,
                      const char *help)
{
    if (!contains(name, search->text) && !(help && contains(help, search->text)))
        return;
    if (search->found++ == 0)
        printf("\"%s\" is no topic, but is in:\n", search->text);
    printf("  %-34s  %s\n", topic, help ? help : "");
}

static void try_option(struct help_search *search, const char *command, const char *option,
                       const char *help)
{
    char *topic = text_format("%s %s", command, option);
    if (topic)
        try_entry(search, topic, option, help);
    free(topic);
}

static void try_table(struct help_search *search, const struct parameter *table, const char *prefix)
{
    for (const struct parameter *p = table; p && !PARAMETER_IS_END(p); p++) {
        char *topic = p->key ? text_format("%s%s%s", prefix, *prefix ? "." : "", p->key) : NULL;
        if (!topic)
            continue;
        try_entry(search, topic, p->key, p->help);
        if (p->kind == PARAMETER_TABLE || p->kind == PARAMETER_MAP)
            try_table(search, p->table, topic);
        free(topic);
    }
}

static void try_materials(struct help_search *search)
{
    struct name_list names = {0};
    char *folder = share_folder("materials");
    if (folder)
        error_free(library_names(folder, &names)); /* the help does without a library */
    for (int i = 0; i < names.count; i++) {
        char *topic = text_format("bolide materials %s", names.names[i]);
        if (topic)
            try_entry(search, topic, names.names[i], "prints this material of the library");
        free(topic);
    }
    library_names_free(&names);
    free(folder);
}

bool is_library_material(const char *name)
{
    char *folder = share_folder("materials");
    const char *const folders[] = {folder};
    char *path = folder ? library_file(folders, 1, name) : NULL;
    const bool found = path != NULL;
    free(path);
    free(folder);
    return found;
}

bool help_search(const char *text)
{
    struct help_search search = {text, 0};
    for (int i = 0; i < command_count; i++)
        try_entry(&search, commands[i].name, commands[i].name, commands[i].help);
    const char *option, *help;
    unsigned takers;
    for (int i = 0; options_at(i, &option, &help, &takers); i++)
        for (int k = 0; k < command_count; k++)
            if (takers & commands[k].bit)
                try_option(&search, commands[k].name, option, help);
    try_table(&search, case_table, "");
    try_table(&search, case_shaping_table, "");
    for (const struct choice_list *list = bolide_catalogue.lists; list->kind_of_thing; list++) {
        try_entry(&search, list->kind_of_thing, list->kind_of_thing, list->help);
        for (int i = 0; i < list->count; i++) {
            const struct choice *choice = &list->choices[i];
            try_entry(&search, choice->name, choice->name, choice->help);
            try_table(&search, choice->table, choice->name);
        }
    }
    try_materials(&search);
    return search.found > 0;
}
