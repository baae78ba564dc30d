/* Two cases as run, compared key by key; see changes.h. */
#include "case/changes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "document/nodes.h"

struct comparison {
    struct case_changes *changes;
    const struct catalogue *catalogue;
    bool failed; /* memory was out */
};

/* A key on the way down. CLASS is what it and its entries have. */
struct place {
    const struct place *parent;
    const char *key;
    enum parameter_change class;
};

static size_t put_path(const struct place *place, FILE *file)
{
    const size_t before = place->parent ? put_path(place->parent, file) : 0;
    if (place->key)
        fprintf(file, "%s%s", before ? "." : "", place->key);
    return before + (place->key != NULL);
}

static void put_node(const struct node *node, FILE *file)
{
    if (node->kind == NODE_SCALAR) {
        fputs(node->text ? node->text : "", file);
        return;
    }
    fputc(node->kind == NODE_MAP ? '{' : '[', file);
    for (int i = 0; i < node->count; i++) {
        fputs(i ? ", " : "", file);
        if (node->kind == NODE_MAP)
            fprintf(file, "%s: ", node->child[i]->key);
        put_node(node->child[i], file);
    }
    fputc(node->kind == NODE_MAP ? '}' : ']', file);
}

/* The path of PLACE, or NODE in one line, in fresh memory; NULL when memory is out. */
static char *text_of(const struct place *place, const struct node *node)
{
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return NULL;
    if (place)
        put_path(place, file);
    else if (node)
        put_node(node, file);
    if (fclose(file)) {
        free(text);
        return NULL;
    }
    return text;
}

static void note(struct comparison *c, const struct place *place, const struct node *before,
                 const struct node *after)
{
    struct case_changes *changes = c->changes;
    struct case_change change = {text_of(place, NULL), text_of(NULL, before), text_of(NULL, after),
                                 place->class};
    if (!change.key || !change.before || !change.after ||
        !memory_reserve((void **)&changes->item, &changes->room, changes->count + 1, changes->count,
                        sizeof *changes->item)) {
        free(change.key);
        free(change.before);
        free(change.after);
        c->failed = true;
        return;
    }
    changes->item[changes->count++] = change;
}

static bool same_nodes(const struct node *a, const struct node *b)
{
    if (!a || !b || a->kind != b->kind || a->count != b->count)
        return a == b;
    if (a->kind == NODE_SCALAR)
        return !strcmp(a->text ? a->text : "", b->text ? b->text : "");
    for (int i = 0; i < a->count; i++)
        if ((a->kind == NODE_MAP && strcmp(a->child[i]->key, b->child[i]->key) != 0) ||
            !same_nodes(a->child[i], b->child[i]))
            return false;
    return true;
}

/* The entry KEY of MAP, which is NULL or no map where it has none; first looked for at INDEX. */
static const struct node *entry_at(const struct node *map, int index, const char *key)
{
    if (!map || map->kind != NODE_MAP)
        return NULL;
    if (index < map->count && !strcmp(map->child[index]->key, key))
        return map->child[index];
    return node_entry(map, key);
}

static struct place place_in(const struct place *parent, const char *key,
                             const struct parameter *parameter)
{
    const enum parameter_change class = parameter ? parameter->change : CHANGE_AS_AROUND;
    return (struct place){parent, key, class == CHANGE_AS_AROUND ? parent->class : class};
}

/* PLACE with what is said of the keys in it. */
static struct place within(const struct place *place, const struct parameter *parameter)
{
    struct place inner = *place;
    if (parameter->change_within != CHANGE_AS_AROUND)
        inner.class = parameter->change_within;
    return inner;
}

static void compare_table(struct comparison *c, const struct place *place,
                          const struct parameter *table, const struct node *before,
                          const struct node *after);

/* The name that a ONE_OF has, in {name: {...}} or name. */
static const char *name_of(const struct node *node)
{
    if (node->kind == NODE_SCALAR)
        return node->text ? node->text : "";
    return node->kind == NODE_MAP && node->count == 1 ? node->child[0]->key : "";
}

static void compare_one_of(struct comparison *c, const struct place *place,
                           const struct parameter *parameter, const struct node *before,
                           const struct node *after)
{
    const char *name = name_of(before);
    const struct choice *choice = catalogue_find(c->catalogue, parameter->kind_of_thing, name);
    const struct place around = within(place, parameter), inner = place_in(&around, name, NULL);
    if (choice && !strcmp(name, name_of(after)) && before->kind == NODE_MAP &&
        after->kind == NODE_MAP)
        compare_table(c, &inner, choice->table, before->child[0], after->child[0]);
    else
        note(c, place, before, after);
}

/* Whether entries that both have come in another order, which numbers bodies and materials. */
static bool has_other_order(const struct node *before, const struct node *after)
{
    int last = -1;
    for (int i = 0; i < after->count; i++)
        for (int k = 0; k < before->count; k++) {
            const int at = (i + k) % before->count; /* most are where they were */
            if (strcmp(before->child[at]->key, after->child[i]->key) != 0)
                continue;
            if (at < last)
                return true;
            last = at;
            break;
        }
    return false;
}

static void compare_map(struct comparison *c, const struct place *place,
                        const struct parameter *parameter, const struct node *before,
                        const struct node *after)
{
    const struct place inner = within(place, parameter);
    for (int i = 0; i < before->count; i++) {
        const struct node *old = before->child[i], *new = entry_at(after, i, old->key);
        const struct place own = place_in(new ? &inner : place, old->key, NULL);
        if (new)
            compare_table(c, &own, parameter->table, old, new);
        else
            note(c, &own, old, NULL);
    }
    for (int i = 0; i < after->count; i++) {
        const struct place own = place_in(place, after->child[i]->key, NULL);
        if (!entry_at(before, i, own.key))
            note(c, &own, NULL, after->child[i]);
    }
    if (place->class == CHANGE_NEVER && has_other_order(before, after))
        note(c, place, before, after);
}

static void compare_value(struct comparison *c, const struct place *place,
                          const struct parameter *parameter, const struct node *before,
                          const struct node *after)
{
    if (same_nodes(before, after))
        return;
    const bool maps = before && after && before->kind == NODE_MAP && after->kind == NODE_MAP;
    const struct place inner = within(place, parameter);
    if (parameter->kind == PARAMETER_TABLE && maps)
        compare_table(c, &inner, parameter->table, before, after);
    else if (parameter->kind == PARAMETER_MAP && maps)
        compare_map(c, place, parameter, before, after);
    else if (parameter->kind == PARAMETER_ONE_OF && before && after)
        compare_one_of(c, place, parameter, before, after);
    else
        note(c, place, before, after);
}

/* The row of TABLE that KEY belongs to; of a thing inline its kind's. NULL: there is none. */
static const struct parameter *row_of(const struct comparison *c, const struct parameter *table,
                                      const char *key)
{
    for (const struct parameter *p = table; p && !PARAMETER_IS_END(p); p++)
        if (p->key ? !strcmp(p->key, key)
                   : catalogue_find(c->catalogue, p->kind_of_thing, key) != NULL)
            return p;
    return NULL;
}

static void compare_entry(struct comparison *c, const struct place *place,
                          const struct parameter *table, const char *key, const struct node *before,
                          const struct node *after)
{
    if (same_nodes(before, after))
        return;
    const struct parameter *row = row_of(c, table, key);
    const struct place own = place_in(place, key, row);
    const struct choice *inlined =
        row && !row->key ? catalogue_find(c->catalogue, row->kind_of_thing, key) : NULL;
    if (inlined && before && after && before->kind == NODE_MAP && after->kind == NODE_MAP)
        compare_table(c, &own, inlined->table, before, after);
    else if (row && row->key)
        compare_value(c, &own, row, before, after);
    else
        note(c, &own, before, after);
}

static void compare_table(struct comparison *c, const struct place *place,
                          const struct parameter *table, const struct node *before,
                          const struct node *after)
{
    if (before->kind != NODE_MAP || after->kind != NODE_MAP) {
        if (!same_nodes(before, after))
            note(c, place, before, after);
        return;
    }
    for (int i = 0; i < before->count; i++) {
        const char *key = before->child[i]->key;
        compare_entry(c, place, table, key, before->child[i], entry_at(after, i, key));
    }
    for (int i = 0; i < after->count; i++) {
        const char *key = after->child[i]->key;
        if (!entry_at(before, i, key))
            compare_entry(c, place, table, key, NULL, after->child[i]);
    }
}

struct error *case_compare(const char *before, const char *after, const struct parameter *table,
                           const struct catalogue *catalogue, struct case_changes *changes)
{
    struct comparison comparison = {changes, catalogue, false};
    const struct place top = {NULL, NULL, CHANGE_NEVER};
    struct node *now = NULL;
    *changes = (struct case_changes){0};
    struct error *error =
        node_parse(before, strlen(before), "the earlier case", false, &changes->before);
    if (!error)
        error = node_parse(after, strlen(after), "the case as run", false, &now);
    if (!error)
        compare_table(&comparison, &top, table, changes->before, now);
    node_free(now);
    if (!error && comparison.failed)
        error = out_of_memory();
    if (error)
        case_changes_free(changes);
    return error;
}

void case_changes_free(struct case_changes *changes)
{
    for (int i = 0; i < changes->count; i++) {
        free(changes->item[i].key);
        free(changes->item[i].before);
        free(changes->item[i].after);
    }
    free(changes->item);
    node_free(changes->before);
    *changes = (struct case_changes){0};
}

const char *case_change_class(enum parameter_change class)
{
    return class == CHANGE_FREELY ? "free" : class == CHANGE_FROM_HERE ? "from here" : "fixed";
}

/* The map KEY of the earlier case, NULL where it has none. */
static const struct node *map_of(const struct case_changes *changes, const char *key)
{
    const struct node *root = changes->before;
    const struct node *map = root && root->kind == NODE_MAP ? node_entry(root, key) : NULL;
    return map && map->kind == NODE_MAP ? map : NULL;
}

int case_changes_entries(const struct case_changes *changes, const char *key)
{
    const struct node *map = map_of(changes, key);
    return map ? map->count : 0;
}

int case_changes_place(const struct case_changes *changes, const char *key, const char *name)
{
    const struct node *map = map_of(changes, key);
    for (int i = 0; map && i < map->count; i++)
        if (!strcmp(map->child[i]->key, name))
            return i;
    return -1;
}

/* Whether REST, what a path has after an entry's name, begins with one of NAMES. */
static bool begins_with_one_of(const char *rest, const char *const *names)
{
    for (; *names; names++)
        if (!strncmp(rest, *names, strlen(*names)))
            return true;
    return false;
}

bool case_changes_in(const struct case_changes *changes, const char *key, const char *name,
                     const char *const *except)
{
    const size_t length = strlen(key), own = strlen(name);
    for (int i = 0; i < changes->count; i++) {
        const char *path = changes->item[i].key;
        if (strncmp(path, key, length) != 0 || path[length] != '.' ||
            strncmp(path + length + 1, name, own) != 0)
            continue;
        const char *rest = path + length + 1 + own;
        if (!*rest || (*rest == '.' && !begins_with_one_of(rest + 1, except)))
            return true;
    }
    return false;
}
