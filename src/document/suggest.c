/* Suggestions for a key in the wrong place: the paths of entries and of keys that have its name. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "document/internal.h"

/* How deep keys lie that are suggested: bodies.flyer.box.from. */
enum { DEEPEST = 4 };

/* "PREFIX.KEY" in fresh memory; KEY for an empty prefix. */
static char *joined(const char *prefix, const char *key)
{
    return text_format("%s%s%s", prefix, *prefix ? "." : "", key);
}

/* The path of an entry KEY, but for UNKNOWN itself, DEPTH maps below MAP, which is at PREFIX. */
static char *entry_path(const struct node *map, const struct node *unknown, const char *prefix,
                        int depth)
{
    char *found = NULL;
    for (int i = 0; map->kind == NODE_MAP && i < map->count && !found; i++) {
        const struct node *entry = map->child[i];
        if (entry == unknown)
            continue;
        char *path = joined(prefix, entry->key);
        if (path && depth > 0)
            found = entry_path(entry, unknown, path, depth - 1);
        else if (path && !strcmp(entry->key, unknown->key))
            found = text_copy(path);
        free(path);
    }
    return found;
}

static char *choice_path(const struct reading *reading, const struct parameter *p, const char *name,
                         const char *prefix, int depth);

/* Whether the document leaves it open which choice is at PATH, or chooses NAME. */
static bool may_choose(const struct document *document, const char *path, const char *name)
{
    bool exact;
    const struct node *chosen = document_find(document, path, &exact);
    if (!exact)
        return true;
    return chosen->kind == NODE_MAP ? node_entry(chosen, name) != NULL
                                    : chosen->text && !strcmp(chosen->text, name);
}

/* The path of a key NAME of TABLE, which is at PREFIX, or of the tables and choices within it. Keys
 * of the entries of maps are left out: their paths have a name that the user chooses. */
static char *key_path(const struct reading *reading, const struct parameter *table,
                      const char *name, const char *prefix, int depth)
{
    char *found = NULL;
    for (const struct parameter *p = table; p && !PARAMETER_IS_END(p) && depth && !found; p++) {
        char *path = p->key ? joined(prefix, p->key) : NULL;
        if (!path)
            continue;
        if (!strcmp(p->key, name))
            found = text_copy(path);
        else if (p->kind == PARAMETER_TABLE)
            found = key_path(reading, p->table, name, path, depth - 1);
        else if (p->kind == PARAMETER_ONE_OF)
            found = choice_path(reading, p, name, path, depth - 1);
        free(path);
    }
    return found;
}

/* The same of the choices for P, which is at PREFIX. */
static char *choice_path(const struct reading *reading, const struct parameter *p, const char *name,
                         const char *prefix, int depth)
{
    const struct choice_list *list = catalogue_list(reading->catalogue, p->kind_of_thing);
    char *found = NULL;
    for (int i = 0; list && i < list->count && !found; i++) {
        const struct choice *choice = &list->choices[i];
        char *path = may_choose(reading->document, prefix, choice->name)
                         ? joined(prefix, choice->name)
                         : NULL;
        if (path)
            found = !strcmp(choice->name, name)
                        ? text_copy(path)
                        : key_path(reading, choice->table, name, path, depth);
        free(path);
    }
    return found;
}

char *document_suggest_inside(const struct reading *reading, const struct parameter *table,
                              const char *name, const char *prefix)
{
    enum { BELOW = 2 }; /* the key of a choice, and the key inside */
    return key_path(reading, table, name, prefix, BELOW);
}

char *document_suggest(const struct reading *reading, const struct parameter *table,
                       const struct node *unknown)
{
    char *path = NULL;
    for (int depth = 1; depth <= DEEPEST && !path; depth++)
        path = entry_path(reading->document->root, unknown, "", depth);
    if (!path)
        path = key_path(reading, table, unknown->key, "", DEEPEST);
    /* A setting goes on: flyer.velocity=... wants bodies.flyer.velocity. */
    for (const struct node *node = unknown; path && node->implied && node->count == 1;) {
        node = node->child[0];
        char *longer = joined(path, node->key);
        free(path);
        path = longer;
    }
    return path;
}
