/* A document: lay the short or long form and the settings over it, find the node of a path, and
 * tell where a mistake stands. */
#include "document/document.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "document/internal.h"

/* The overlays that a document may carry, taken away whether they are wanted or not. */
static const char *const overlay_keys[] = {"short", "long"};

struct error *place_verror(struct mark place, const char *path, const char *format,
                           va_list arguments)
{
    char *message = text_vformat(format, arguments);
    if (!message)
        return out_of_memory();
    struct error *error = error_new(ERROR_INPUT, "%s", message);
    free(message);
    if (path[0])
        error = error_context(error, "%s", path);
    return place.line > 0 ? error_context(error, "%s:%d:%d", place.origin, place.line, place.column)
                          : error_context(error, "%s", place.origin);
}

struct error *place_error(struct mark place, const char *path, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    struct error *error = place_verror(place, path, format, arguments);
    va_end(arguments);
    return error;
}

bool node_is_empty(const struct node *node)
{
    return node->kind == NODE_SCALAR && node->plain &&
           (!node->text[0] || !strcmp(node->text, "~") || !strcmp(node->text, "null"));
}

static int entry_index(const struct node *map, const char *key)
{
    for (int i = 0; map->kind == NODE_MAP && i < map->count; i++)
        if (!strcmp(map->child[i]->key, key))
            return i;
    return -1;
}

struct node *node_entry(const struct node *map, const char *key)
{
    int index = entry_index(map, key);
    return index < 0 ? NULL : map->child[index];
}

struct mark node_place(const struct node *node)
{
    return node->kind == NODE_MAP ? node->key_place : node->place;
}

/* The child of NODE that the start of PATH names; *length tells how much of PATH it takes. A key
 * may hold dots: the longest that fits is meant. */
static int path_step(const struct node *node, const char *path, size_t *length)
{
    int found = -1;
    *length = 0;
    if (node->kind == NODE_LIST) {
        char *end;
        long item = strtol(path, &end, 10);
        if (end > path && (*end == '.' || !*end) && item >= 1 && item <= node->count) {
            *length = (size_t)(end - path);
            found = (int)item - 1;
        }
    }
    for (int i = 0; node->kind == NODE_MAP && i < node->count; i++) {
        size_t size = strlen(node->child[i]->key);
        if (size >= *length && !strncmp(path, node->child[i]->key, size) &&
            (path[size] == '.' || !path[size])) {
            *length = size;
            found = i;
        }
    }
    return found;
}

const struct node *document_find(const struct document *document, const char *path, bool *exact)
{
    const struct node *node = document->root;
    while (*path) {
        size_t length;
        int child = path_step(node, path, &length);
        if (child < 0)
            break;
        node = node->child[child];
        path += length;
        path += *path == '.';
    }
    *exact = !*path;
    return node;
}

bool document_is_wrong(const struct document *document, const char *path)
{
    return path[0] ? name_index_find(&document->marks, path) >= 0 : document->wrong_count > 0;
}

bool document_has(const struct document *document, const char *path)
{
    bool exact;
    document_find(document, path, &exact);
    return exact;
}

struct error *document_error(const struct document *document, const char *path, const char *format,
                             ...)
{
    bool exact;
    const struct node *node = document_find(document, path, &exact);
    va_list arguments;
    va_start(arguments, format);
    struct error *error = place_verror(node_place(node), path, format, arguments);
    va_end(arguments);
    return error;
}

const char *document_keep(struct document *document, char *text)
{
    char **grown =
        realloc(document->origins, ((size_t)document->origin_count + 1) * sizeof(char *));
    if (!grown || !text) {
        document->origins = grown ? grown : document->origins;
        free(text);
        return NULL;
    }
    document->origins = grown;
    grown[document->origin_count++] = text;
    return text;
}

/* Puts ENTRY (taken) into BASE, whose entry at INDEX has the same key, -1 where there is none. */
static struct error *merge_entry(struct node *base, int index, struct node *entry)
{
    struct node *old = index < 0 ? NULL : base->child[index];
    if (old && old->kind == NODE_MAP && entry->kind == NODE_MAP) {
        struct error *error = node_merge(old, entry);
        node_free(entry);
        return error;
    }
    if (!old)
        return node_append(base, entry) ? NULL : out_of_memory();
    /* the index holds the old key: the new one takes its place there */
    free(entry->key);
    entry->key = old->key;
    entry->removes = node_is_empty(entry) && !node_is_empty(old);
    old->key = NULL;
    node_free(old);
    base->child[index] = entry;
    return NULL;
}

struct error *node_merge(struct node *base, struct node *over)
{
    struct name_index index = {0};
    struct error *error = NULL;
    for (int i = 0; i < base->count && !error; i++)
        error = name_index_add(&index, base->child[i]->key, i) ? NULL : out_of_memory();
    int taken = 0;
    while (taken < over->count && !error) {
        struct node *entry = over->child[taken++];
        error = merge_entry(base, name_index_find(&index, entry->key), entry);
    }
    over->count -= taken;
    if (over->count > 0)
        memmove(over->child, over->child + taken, (size_t)over->count * sizeof *over->child);
    name_index_free(&index);
    for (int i = base->count - 1; i >= 0; i--)
        if (base->child[i]->removes)
            node_free(node_take(base, i));
    return error;
}

static bool share_a_key(const struct node *a, const struct node *b)
{
    for (int i = 0; i < a->count; i++)
        if (node_entry(b, a->child[i]->key))
            return true;
    return false;
}

/* Two models of a kind share no key: the own one then replaces the library's. WITHIN a model all
 * its keys go together. */
static struct error *fill_in(struct node *map, struct node *library, bool within)
{
    while (library->count > 0) {
        struct node *entry = node_take(library, 0);
        struct node *own = node_entry(map, entry->key);
        struct error *error = NULL;
        if (!own) {
            error = node_append(map, entry) ? NULL : out_of_memory();
        } else {
            if (own->kind == NODE_MAP && entry->kind == NODE_MAP &&
                (within || share_a_key(own, entry)))
                error = fill_in(own, entry, true);
            node_free(entry);
        }
        TRY(error);
    }
    return NULL;
}

static void mark_included(struct node *node)
{
    node->foreign = true;
    for (int i = 0; i < node->count; i++)
        mark_included(node->child[i]);
}

struct error *document_include(struct document *document, struct node *map,
                               struct document *library)
{
    mark_included(library->root);
    while (library->origin_count > 0) {
        if (!document_keep(document, library->origins[--library->origin_count]))
            return out_of_memory();
    }
    return fill_in(map, library->root, false);
}

/* The wanted one is merged when all are taken, so that none of them can bring another. */
static struct error *merge_overlay(struct document *document, const char *wanted)
{
    struct node *overlay[COUNT_OF(overlay_keys)];
    struct error *error = NULL;
    for (size_t i = 0; i < COUNT_OF(overlay_keys); i++) {
        int index = entry_index(document->root, overlay_keys[i]);
        overlay[i] = index < 0 ? NULL : node_take(document->root, index);
    }
    for (size_t i = 0; i < COUNT_OF(overlay_keys); i++) {
        if (overlay[i] && overlay[i]->kind != NODE_MAP)
            error = error_join(error,
                               place_error(overlay[i]->place, overlay_keys[i], "expected a map"));
        else if (overlay[i] && wanted && !strcmp(overlay_keys[i], wanted)) {
            error = error_join(error, node_merge(document->root, overlay[i]));
            document->overlay = overlay_keys[i];
        }
        node_free(overlay[i]);
    }
    return error;
}

/* Nothing in MAP is called what PATH starts with: suggest, when the word looks like a slip. */
static struct error *no_such_key(const struct node *map, const char *path, const char *segment,
                                 struct mark place)
{
    const char **names = malloc(((size_t)map->count + 1) * sizeof *names);
    if (!names)
        return out_of_memory();
    for (int i = 0; i < map->count; i++)
        names[i] = map->child[i]->key;
    const char *near = nearest_name(segment, names, map->count);
    struct error *error = NULL;
    if (near)
        error =
            place_error(place, path, "there is no \"%s\" (did you mean \"%s\"?)", segment, near);
    free(names);
    return error;
}

/* Makes the entry that the rest of a setting's path starts with: a map if the path goes on, else
 * the value, of which *VALUE is then taken. */
static struct error *add_entry(struct node *map, const char *path, const char *rest,
                               struct node **value, struct mark place)
{
    const char *dot = strchr(rest, '.');
    char *key = text_copy_part(rest, dot ? (size_t)(dot - rest) : strlen(rest));
    struct error *error = key && dot ? no_such_key(map, path, key, place) : NULL;
    if (error) {
        free(key);
        return error;
    }
    struct node *entry = dot ? node_new(NODE_MAP, place) : *value;
    if (!key || !entry) {
        free(key);
        if (dot)
            node_free(entry);
        return out_of_memory();
    }
    entry->implied = dot != NULL;
    entry->key = key;
    entry->key_place = place;
    if (!dot)
        *value = NULL;
    return node_append(map, entry) ? NULL : out_of_memory();
}

/* A scalar on the way of a setting's path: an empty one or the name of the next thing becomes a map
 * (`solver: sph` before `--set solver.sph.contact=acoustic`). */
static bool becomes_map(struct node *node, const char *rest)
{
    size_t length = node->kind == NODE_SCALAR ? strlen(node->text) : 0;
    bool names_next = length && !strncmp(rest, node->text, length) && rest[length] == '.';
    if (node->kind != NODE_SCALAR || (!node_is_empty(node) && !names_next))
        return false;
    free(node->text);
    node->text = NULL;
    node->kind = NODE_MAP;
    return true;
}

static bool is_name(const struct node *node)
{
    return node->kind == NODE_SCALAR && isalpha((unsigned char)node->text[0]) &&
           !strchr(node->text, ' ');
}

/* A list of names on the way of a path that goes on with a name becomes a map of these names
 * (`pictures: [speed]` before `--set output.pictures.speed.log=yes`). */
static bool list_becomes_map(struct node *node, const char *rest)
{
    bool names = isalpha((unsigned char)rest[0]);
    for (int i = 0; i < node->count; i++)
        names = names && is_name(node->child[i]);
    if (!names)
        return false;
    for (int i = 0; i < node->count; i++) {
        struct node *item = node->child[i];
        free(item->key);
        item->key = item->text;
        item->key_place = item->place;
        item->text = NULL;
        item->kind = NODE_MAP;
    }
    node->kind = NODE_MAP;
    return true;
}

/* Puts *VALUE (taken) at PATH. */
static struct error *set_value(struct node *root, const char *path, struct node **value)
{
    struct node *node = root;
    struct mark place = (*value)->place;
    const char *rest = path;
    while (*value) {
        size_t length;
        int child = path_step(node, rest, &length);
        if (child >= 0 && !rest[length]) {
            struct node *old = node->child[child];
            (*value)->key = old->key;
            (*value)->key_place = place;
            old->key = NULL;
            node->child[child] = *value;
            *value = NULL;
            node_free(old);
        } else if (child >= 0) {
            node = node->child[child];
            rest += length + 1;
        } else if (node->kind == NODE_MAP) {
            if (!*rest || *rest == '.')
                return place_error(place, "", "the path has an empty name");
            TRY(add_entry(node, path, rest, value, place));
        } else if (node->kind == NODE_LIST) {
            if (!list_becomes_map(node, rest))
                return place_error(place, path, "the list has items 1 to %d", node->count);
        } else if (!becomes_map(node, rest)) {
            return place_error(place, path, "\"%s\" is a value without keys", node->text);
        }
    }
    return NULL;
}

struct error *document_set(struct document *document, const char *path, struct node **value)
{
    return set_value(document->root, path, value);
}

/* Takes away the entry at PATH, so that its default applies. */
static struct error *remove_value(struct node *root, const char *path, struct mark place)
{
    struct node *node = root;
    const char *rest = path;
    size_t length;
    int child = path_step(node, rest, &length);
    while (child >= 0 && rest[length]) {
        node = node->child[child];
        rest += length + 1;
        child = path_step(node, rest, &length);
    }
    if (child < 0 && node->kind == NODE_LIST)
        return place_error(place, path, "the list has items 1 to %d", node->count);
    if (child < 0) {
        struct error *error = node->kind == NODE_MAP ? no_such_key(node, path, rest, place) : NULL;
        return error ? error
                     : place_error(place, path,
                                   "there is no \"%s\" to remove; a setting is "
                                   "path.to.key=value, and one without a value "
                                   "removes the key",
                                   rest);
    }
    if (node->kind == NODE_LIST)
        return place_error(place, path, "an item of a list cannot be removed; set the whole list");
    node_free(node_take(node, child));
    return NULL;
}

static struct error *apply_setting(struct document *document, const char *setting)
{
    const char *origin = document_keep(document, text_format("--set %s", setting));
    if (!origin)
        return out_of_memory();
    struct mark place = {origin, 0, 0};
    const char *equals = strchr(setting, '=');
    if (!equals || equals == setting)
        return place_error(place, "", "a setting is path.to.key=value");
    const bool removes = !equals[1 + strspn(equals + 1, " ")];
    struct node *value = NULL;
    if (!removes)
        TRY(node_parse(equals + 1, strlen(equals + 1), origin, false, &value));
    char *path = text_copy_part(setting, (size_t)(equals - setting));
    struct error *error = path ? refuse_controls(place, path, true) : out_of_memory();
    if (!error)
        error = removes ? remove_value(document->root, path, place)
                        : set_value(document->root, path, &value);
    free(path);
    node_free(value);
    return error;
}

static struct error *document_new(struct document **document)
{
    *document = calloc(1, sizeof **document);
    return *document ? NULL : out_of_memory();
}

/* Lays the overlay and the settings over *DOCUMENT, which was read with ERROR; on an error frees
 * it. */
static struct error *finish(struct error *error, const char *const *settings, int count,
                            const char *overlay, struct document **document)
{
    if (!error) {
        error = merge_overlay(*document, overlay);
        for (int i = 0; i < count; i++)
            error = error_join(error, apply_setting(*document, settings[i]));
    }
    if (error) {
        document_free(*document);
        *document = NULL;
    }
    return error;
}

struct error *document_open_text(const char *text, const char *name, const char *const *settings,
                                 int count, const char *overlay, struct document **document)
{
    TRY(document_new(document));
    const char *origin = document_keep(*document, text_copy(name));
    struct error *error =
        origin ? node_parse(text, strlen(text), origin, true, &(*document)->root) : out_of_memory();
    if (!error && (*document)->root->kind != NODE_MAP)
        error = place_error((*document)->root->place, "", "expected a map of keys and values");
    return finish(error, settings, count, overlay, document);
}

struct error *document_open_with(const char *path, const struct node *include,
                                 const char *const *settings, int count, const char *overlay,
                                 struct document **document)
{
    TRY(document_new(document));
    struct error *error = document_load(*document, path, include);
    return finish(error, settings, count, overlay, document);
}

struct error *document_open(const char *path, const char *const *settings, int count,
                            const char *overlay, struct document **document)
{
    return document_open_with(path, NULL, settings, count, overlay, document);
}

void document_free(struct document *document)
{
    if (!document)
        return;
    node_free(document->root);
    for (int i = 0; i < document->origin_count; i++)
        free(document->origins[i]);
    free(document->origins);
    for (int i = 0; i < document->wrong_count; i++)
        free(document->wrong[i]);
    free(document->wrong);
    name_index_free(&document->marks);
    free(document);
}
