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

/* Takes the entry KEY out of the document; NULL where it has none. */
static struct node *take_entry(struct node *root, const char *key)
{
    for (int i = 0; i < root->count; i++)
        if (!strcmp(root->child[i]->key, key))
            return node_take(root, i);
    return NULL;
}

/* Appends to MAP the entry KEY: a scalar with TEXT, or a map; NULL when memory is out. */
static struct node *append_entry(struct node *map, struct mark place, const char *key,
                                 const char *text)
{
    struct node *node = node_new(text ? NODE_SCALAR : NODE_MAP, place);
    if (!node)
        return NULL;
    node->key = text_copy(key);
    node->text = text_copy(text);
    node->plain = text != NULL;
    return node_append(map, node) && node->key && (node->text || !text) ? node : NULL;
}

/* Makes ENTRY, of the map of SPELLING, one of `boundaries`. */
static bool rewrite(struct node *entry, const struct spelling *spelling)
{
    const struct mark place = node_place(entry);
    const int count = entry->count;
    for (int i = 0; i < count && spelling->key; i++)
        if (!strcmp(entry->child[i]->key, spelling->key)) {
            free(entry->child[i]->key);
            if (!(entry->child[i]->key = text_copy(spelling->as)))
                return false;
        }
    if (!spelling->key) {
        struct node *shape = append_entry(entry, place, spelling->as, NULL);
        for (int i = 0; i < count; i++)
            if (!shape || !node_append(shape, node_take(entry, 0)))
                return false;
    }
    return append_entry(entry, place, "kind", spelling->kind);
}

/* Moves the entries of MAP to BOUNDARIES, those of a SPELLING rewritten. */
static struct error *move_entries(struct node *boundaries, struct node *map,
                                  const struct spelling *spelling)
{
    struct error *error = NULL;
    while (map && map->count > 0) {
        struct node *entry = node_take(map, 0);
        if (node_entry(boundaries, entry->key))
            error = error_join(error, place_error(entry->key_place, "boundaries",
                                                  "there is another boundary \"%s\"", entry->key));
        if ((spelling && entry->kind == NODE_MAP && !rewrite(entry, spelling)) ||
            !node_append(boundaries, entry))
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
    if (map && map->kind != NODE_MAP && !node_is_empty(map))
        error = place_error(node_place(map), spelling->map, "expected a map of names");
    else if (map && map->count > 0) {
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
    struct node *root = input->document->root, *own = take_entry(root, "boundaries");
    struct error *error = NULL;
    if (own && own->kind != NODE_MAP && !node_is_empty(own))
        return node_append(root, own) ? NULL : out_of_memory();
    struct node *all = append_entry(root, own ? own->key_place : root->place, "boundaries", NULL);
    if (!all)
        return out_of_memory();
    /* Those of `boundaries` itself come last: where several give a position, the last counts. */
    for (size_t k = 0; k < COUNT_OF(spellings); k++)
        error = error_join(error, take_spelling(input, all, &spellings[k]));
    error = error_join(error, move_entries(all, own, NULL));
    node_free(own);
    return error;
}
