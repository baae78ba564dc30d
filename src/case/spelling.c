/* Other spellings of boundaries: walls, outflows and obstacles have maps of their own. What they
 * say is put under `boundaries` before the case is read, so that nothing else needs to know
 * them. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "case/internal.h"
#include "document/nodes.h"

static const struct spelling {
    const char *map;
    const char *key, *as; /* its name of the axis */
    const char *kind;     /* of boundary */
} spellings[] = {{"walls", "mirror", "axis", "reflecting"},
                 {"outflows", "across", "axis", "outflow"},
                 {"obstacles", NULL, "part", "rigid-body"}};

static struct error *out_of_memory(void) { return error_new(ERROR_SYSTEM, "out of memory"); }

/* Takes the entry KEY out of the document; NULL where it has none. */
static struct node *take_entry(struct node *root, const char *key)
{
    for (int i = 0; i < root->count; i++)
        if (!strcmp(root->child[i]->key, key))
            return node_take(root, i);
    return NULL;
}

/* A map KEY at PLACE, or a scalar with TEXT; NULL when memory is out. */
static struct node *new_entry(struct place place, const char *key, const char *text)
{
    struct node *node = node_new(text ? NODE_SCALAR : NODE_MAP, place);
    if (!node)
        return NULL;
    node->key = text_copy(key);
    node->text = text_copy(text);
    node->plain = text != NULL;
    if (node->key && (node->text || !text))
        return node;
    node_free(node);
    return NULL;
}

/* Makes ENTRY, of the map of SPELLING, one of `boundaries`. */
static struct error *rewrite(struct node *entry, const struct spelling *spelling)
{
    struct node *kind = new_entry(node_place(entry), "kind", spelling->kind), *shape;
    if (!spelling->key) {
        if (!(shape = new_entry(node_place(entry), spelling->as, NULL))) {
            node_free(kind);
            return out_of_memory();
        }
        while (entry->count > 0)
            if (!node_append(shape, node_take(entry, 0)))
                return out_of_memory();
        if (!node_append(entry, shape))
            return out_of_memory();
    }
    for (int i = 0; i < entry->count && spelling->key; i++)
        if (!strcmp(entry->child[i]->key, spelling->key)) {
            char *key = text_copy(spelling->as);
            if (!key)
                return out_of_memory();
            free(entry->child[i]->key);
            entry->child[i]->key = key;
        }
    return kind && node_append(entry, kind) ? NULL : out_of_memory();
}

/* Moves the entries of MAP, of SPELLING, to BOUNDARIES. */
static struct error *move_entries(struct node *boundaries, struct node *map,
                                  const struct spelling *spelling)
{
    struct error *error = NULL;
    while (map->count > 0) {
        struct node *entry = node_take(map, 0);
        if (node_entry(boundaries, entry->key)) {
            char path[256];
            snprintf(path, sizeof path, "%s.%.200s", spelling->map, entry->key);
            error = error_join(
                error, place_error(entry->key_place, path, "`boundaries` has this name, too"));
            node_free(entry);
            continue;
        }
        if (entry->kind == NODE_MAP)
            error = error_join(error, rewrite(entry, spelling));
        if (!node_append(boundaries, entry))
            return out_of_memory();
    }
    return error;
}

/* Moves what the document says in SPELLING. */
static struct error *take_spelling(struct simulation_case *input, struct node *boundaries,
                                   const struct spelling *spelling)
{
    struct node *map = take_entry(input->document->root, spelling->map);
    struct error *error = NULL;
    if (!map)
        return NULL;
    if (map->kind != NODE_MAP && !node_is_empty(map))
        error = place_error(node_place(map), spelling->map, "expected a map of names");
    else if (map->kind == NODE_MAP && map->count > 0) {
        if (boundaries->count == 0)
            boundaries->place = boundaries->key_place = map->key_place;
        input->notes = error_join(
            input->notes, place_error(node_place(map), spelling->map,
                                      "read as `boundaries`, for example {%s: {kind: %s, %s: ...}}",
                                      map->child[0]->key, spelling->kind, spelling->as));
        error = move_entries(boundaries, map, spelling);
    }
    node_free(map);
    return error;
}

struct error *case_take_spellings(struct simulation_case *input)
{
    struct node *root = input->document->root, *own = take_entry(root, "boundaries"), *all;
    struct error *error = NULL;
    if (own && own->kind != NODE_MAP && !node_is_empty(own))
        return node_append(root, own) ? NULL : out_of_memory();
    all = new_entry(own ? own->place : root->place, "boundaries", NULL);
    if (!all)
        return out_of_memory();
    if (own)
        all->key_place = own->key_place;
    /* the entries of the case itself are later, for the last that names a position counts */
    for (size_t k = 0; k < COUNT_OF(spellings); k++)
        error = error_join(error, take_spelling(input, all, &spellings[k]));
    while (own && own->count > 0) {
        struct node *entry = node_take(own, 0);
        if (node_entry(all, entry->key))
            error =
                error_join(error, place_error(entry->key_place, "boundaries",
                                              "\"%s\" is in another spelling, too", entry->key));
        if (!node_append(all, entry))
            return out_of_memory();
    }
    node_free(own);
    if (all->count == 0)
        node_free(all);
    else if (!node_append(root, all))
        return out_of_memory();
    return error;
}
