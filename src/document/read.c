/* From a tree of nodes to the structs that parameter tables describe: maps, things of the catalogue
 * and `let`. A mistake does not stop the reading: every value that can be judged is judged, and all
 * messages come joined, in the order of the file. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "document/internal.h"

static const char let_key[] = "let";

static void read_table(struct reading *reading, const struct node *map, const struct path *path,
                       const struct parameter *table, void *values);

static int thing_names(const struct choice_list *list, const char **names)
{
    int count = 0;
    for (int i = 0; i < list->count && count < KEYS_MAX; i++)
        names[count++] = list->choices[i].name;
    return count;
}

static const struct choice_list *things(const struct reading *reading, const char *kind)
{
    const struct choice_list *list = catalogue_list(reading->catalogue, kind);
    assert(list && "a table names an unknown kind of thing");
    return list;
}

/* The thing CHOICE with the parameters of NODE: a map, nothing, or the first parameter alone. */
static void read_thing(struct reading *reading, const struct node *node, const struct path *path,
                       const struct choice_list *list, const struct choice *choice,
                       struct one_of *value)
{
    static const struct parameter no_parameters[] = {PARAMETER_END};
    const struct parameter *table = choice->table ? choice->table : no_parameters;
    assert(choice->size || PARAMETER_IS_END(table));
    value->index = (int)(choice - list->choices);
    value->choice = choice;
    value->value = choice->size ? memory_allocate(choice->size) : NULL;
    if (choice->size && !value->value) {
        complain_memory(reading);
        return;
    }
    struct node map = *node;
    struct node first = *node;
    struct node *entries[1] = {&first};
    if (node->kind != NODE_MAP) {
        map.kind = NODE_MAP;
        map.count = 0;
        if (!node_is_empty(node)) {
            if (!table->key) {
                complain_kind(reading, node, path, "a map");
                return;
            }
            first.key = (char *)table->key;
            map.count = 1;
            map.child = entries;
        }
    }
    read_table(reading, &map, path, table, value->value);
}

/* `{name: {...}}` or `name`. */
static void read_one_of(struct reading *reading, const struct node *node, const struct path *path,
                        const struct parameter *parameter, struct one_of *value)
{
    const struct choice_list *list = things(reading, parameter->kind_of_thing);
    const char *names[KEYS_MAX];
    int count = thing_names(list, names);
    bool is_map = node->kind == NODE_MAP && node->count == 1;
    if ((node->kind != NODE_SCALAR || node_is_empty(node)) && !is_map) {
        char known[1024], wanted[1100];
        list_text(names, count, known, sizeof known);
        snprintf(wanted, sizeof wanted, "one of %s", known);
        if (node->kind == NODE_MAP && node->count > 1)
            complain(reading, node_place(node), path, "expected one %s, found %d keys (%s)",
                     list->kind_of_thing, node->count, wanted);
        else
            complain_kind(reading, node, path, wanted);
        return;
    }
    const char *name = is_map ? node->child[0]->key : node->text;
    const struct choice *choice = catalogue_find(reading->catalogue, list->kind_of_thing, name);
    if (!choice) {
        char what[TEXT_MAX];
        snprintf(what, sizeof what, "unknown %s", list->kind_of_thing);
        complain_unknown(reading, is_map ? node->child[0]->key_place : node->place, path, what,
                         name, names, count);
        return;
    }
    struct path inside = {path, choice->name, 0};
    struct node nothing = {.kind = NODE_SCALAR,
                           .plain = true,
                           .text = "",
                           .place = node->place,
                           .key_place = node->place};
    read_thing(reading, is_map ? node->child[0] : &nothing, &inside, list, choice, value);
}

static void read_list(struct reading *reading, const struct node *node, const struct path *path,
                      const struct parameter *parameter, struct one_of_list *value)
{
    if (node->kind != NODE_LIST) {
        complain_kind(reading, node, path, "a list");
        return;
    }
    value->items = memory_allocate((size_t)node->count * sizeof *value->items);
    if (!value->items) {
        complain_memory(reading);
        return;
    }
    for (int i = 0; i < node->count; i++) {
        struct path item = {path, NULL, i + 1};
        value->items[i].index = -1;
        value->count = i + 1;
        read_one_of(reading, node->child[i], &item, parameter, &value->items[i]);
    }
}

/* The next entry of the map, called NAME; of a list of names it has no keys. */
static void read_map_entry(struct reading *reading, const struct node *entry, const char *name,
                           const struct path *path, const struct parameter *parameter,
                           struct named_map *value)
{
    struct path item = {path, name, 0};
    const int i = value->count++;
    void *values = (char *)value->items + (size_t)i * parameter->size;
    const struct node empty = {.kind = NODE_MAP, .place = entry->place, .key_place = entry->place};
    value->names[i] = text_copy(name);
    if (!value->names[i] || !name_index_add(&value->index, value->names[i], i))
        complain_memory(reading);
    else if (entry->broken)
        mark_wrong(reading, &item);
    else if (!name[0])
        complain(reading, entry->key_place, path, "a name cannot be empty");
    else if (entry->implied && !parameter->listed)
        complain(reading, entry->key_place, &item, "there is no such entry");
    else if (entry->kind != NODE_MAP && name != entry->text)
        complain_kind(reading, entry, &item, "a map");
    else
        read_table(reading, entry->kind == NODE_MAP ? entry : &empty, &item, parameter->table,
                   values);
}

static void read_map(struct reading *reading, const struct node *node, const struct path *path,
                     const struct parameter *parameter, struct named_map *value)
{
    const bool empty = node_is_empty(node), alone = parameter->listed && node->kind == NODE_SCALAR;
    const bool list = parameter->listed && node->kind == NODE_LIST;
    if (node->kind != NODE_MAP && !empty && !list && !alone) {
        complain_kind(reading, node, path, "a map of names");
        return;
    }
    int count = empty ? 0 : alone ? 1 : node->count;
    value->names = calloc((size_t)count + 1, sizeof *value->names);
    value->items = memory_allocate((size_t)count * parameter->size);
    if (!value->names || !value->items) {
        complain_memory(reading);
        return;
    }
    for (int i = 0; i < count; i++) {
        const struct node *entry = alone ? node : node->child[i];
        struct path item = {path, NULL, i + 1};
        if (node->kind == NODE_MAP)
            read_map_entry(reading, entry, entry->key, path, parameter, value);
        else if (entry->kind != NODE_SCALAR || node_is_empty(entry))
            complain_kind(reading, entry, &item, "a name");
        else if (name_index_find(&value->index, entry->text) >= 0)
            complain(reading, entry->place, &item, "\"%.60s\" is there twice", entry->text);
        else
            read_map_entry(reading, entry, entry->text, path, parameter, value);
    }
}

static void read_nested(struct reading *reading, const struct node *node, const struct path *path,
                        const struct parameter *parameter, void *values)
{
    struct node map = *node;
    if (node_is_empty(node)) {
        map.kind = NODE_MAP;
        map.count = 0;
    }
    if (map.kind == NODE_MAP)
        read_table(reading, &map, path, parameter->table, values);
    else
        complain_kind(reading, node, path, "a map");
}

static void read_value(struct reading *reading, const struct node *node, const struct path *path,
                       const struct parameter *parameter, void *value)
{
    if (parameter->kind == PARAMETER_TABLE)
        read_nested(reading, node, path, parameter, value);
    else if (parameter->kind == PARAMETER_ONE_OF)
        read_one_of(reading, node, path, parameter, value);
    else if (parameter->kind == PARAMETER_LIST)
        read_list(reading, node, path, parameter, value);
    else if (parameter->kind == PARAMETER_MAP)
        read_map(reading, node, path, parameter, value);
    else
        read_scalar(reading, node, path, parameter, value);
}

/* What a value is when nobody gives it. */
static void clear_value(const struct parameter *parameter, void *value)
{
    if (parameter->kind == PARAMETER_NUMBER)
        *(double *)value = NAN;
    else if (parameter->kind == PARAMETER_FIELD)
        *(struct field_value *)value = (struct field_value){NAN, NULL};
    else if (parameter->kind == PARAMETER_QUANTITY)
        *(struct quantity *)value = (struct quantity){.value = NAN};
    else if (parameter->kind == PARAMETER_CHOICE)
        *(int *)value = -1;
    else if (parameter->kind == PARAMETER_ONE_OF)
        *(struct one_of *)value = (struct one_of){.index = -1};
}

static void read_standard(struct reading *reading, const struct path *path,
                          const struct parameter *parameter, void *value)
{
    if (parameter->kind == PARAMETER_TABLE) {
        struct node nothing = {.kind = NODE_MAP};
        nothing.place.origin = nothing.key_place.origin = path->key;
        read_table(reading, &nothing, path, parameter->table, value);
        return;
    }
    if (!parameter->standard[0])
        return;
    struct node *node = NULL;
    struct error *error =
        node_parse(parameter->standard, strlen(parameter->standard), "the default", false, &node);
    reading->error = error_join(reading->error, error);
    if (node) {
        node->foreign = true; /* a name of `let` may be that of its unit */
        for (int i = 0; i < node->count; i++)
            node->child[i]->foreign = true;
        read_value(reading, node, path, parameter, value);
    }
    node_free(node);
}

/* All keys of TABLE and the names of things that stand inline; returns how many. OWNER tells which
 * parameter of the table a name belongs to. */
static int table_names(const struct reading *reading, const struct parameter *table,
                       const char **names, int *owner)
{
    int count = 0;
    for (int k = 0; !PARAMETER_IS_END(&table[k]); k++) {
        int before = count;
        if (table[k].key) {
            names[count++] = table[k].key;
        } else {
            const struct choice_list *list = things(reading, table[k].kind_of_thing);
            assert(count + list->count < KEYS_MAX);
            count += thing_names(list, names + count);
        }
        assert(count < KEYS_MAX);
        for (int i = before; i < count; i++)
            owner[i] = k;
    }
    return count;
}

/* The parameter at VALUE was given by ENTRY; *given tells whether it was before. */
static void read_entry(struct reading *reading, const struct node *entry, const struct path *path,
                       const struct parameter *parameter, bool given, void *value)
{
    struct path inside = {path, entry->key, 0};
    if (parameter->key) {
        read_value(reading, entry, &inside, parameter, value);
        return;
    }
    struct one_of *one_of = value;
    const struct choice_list *list = things(reading, parameter->kind_of_thing);
    if (given && one_of->choice) { /* without one a slip was given, and told */
        complain(reading, entry->key_place, path, "\"%s\" beside \"%s\": only one %s is allowed",
                 entry->key, one_of->choice->name, list->kind_of_thing);
        return;
    }
    read_thing(reading, entry, &inside, list,
               catalogue_find(reading->catalogue, list->kind_of_thing, entry->key), one_of);
}

static void complain_missing(struct reading *reading, const struct node *map,
                             const struct path *path, const struct parameter *parameter)
{
    if (parameter->key) {
        complain(reading, node_place(map), path, "\"%s\" is missing%s%s", parameter->key,
                 parameter->help ? ": " : "", parameter->help ? parameter->help : "");
        return;
    }
    const struct choice_list *list = things(reading, parameter->kind_of_thing);
    const char *names[KEYS_MAX];
    char known[1024];
    list_text(names, thing_names(list, names), known, sizeof known);
    complain(reading, node_place(map), path, "a %s is missing, one of %s", list->kind_of_thing,
             known);
}

/* Each search for a suggestion walks the document: a file of nothing but unknown keys must not take
 * indefinitely. */
static bool may_search(const struct reading *reading)
{
    enum { SEARCHES = 20 };
    return !reading->error || error_count(reading->error) < SEARCHES;
}

/* Complains about ENTRY with the path that it may be meant for, unless one of NAMES is like it. */
static bool suggest_path(struct reading *reading, const struct node *entry,
                         const struct parameter *table, const char *const *names, int count)
{
    const bool search = may_search(reading) && !nearest_name(entry->key, names, count);
    char *meant = search ? document_suggest(reading, table, entry) : NULL;
    if (meant)
        complain(reading, entry->key_place, NULL, "unknown key \"%.60s\" (did you mean \"%s\"?)",
                 entry->key, meant);
    const bool told = meant != NULL;
    free(meant);
    return told;
}

/* The same of an entry of the table at PATH whose key belongs to a choice in the table: an option
 * of one scheme given among those of all. */
static bool suggest_choice(struct reading *reading, const struct node *entry,
                           const struct path *path, const struct parameter *table)
{
    char prefix[1024];
    path_text(path, prefix, sizeof prefix);
    char *meant =
        may_search(reading) ? document_suggest_inside(reading, table, entry->key, prefix) : NULL;
    if (meant)
        complain(reading, entry->key_place, path, "unknown key \"%.60s\" (did you mean \"%s\"?)",
                 entry->key, meant);
    const bool told = meant != NULL;
    free(meant);
    return told;
}

/* Complains about ENTRY of MAP where it is a key of the thing that stands inline in the map. */
static bool suggest_within(struct reading *reading, const struct node *map,
                           const struct node *entry, const struct path *path,
                           const struct parameter *table)
{
    for (int k = 0; !PARAMETER_IS_END(&table[k]); k++)
        for (int i = 0; i < map->count && !table[k].key; i++) {
            const struct choice *thing =
                catalogue_find(reading->catalogue, table[k].kind_of_thing, map->child[i]->key);
            for (const struct parameter *p = thing ? thing->table : NULL; p && !PARAMETER_IS_END(p);
                 p++)
                if (p->key && !strcmp(p->key, entry->key)) {
                    complain(reading, entry->key_place, path,
                             "unknown key \"%s\"; \"%s\" has it: {%s: {%s: ..., %s: ...}}",
                             entry->key, thing->name, thing->name, thing->table[0].key, entry->key);
                    return true;
                }
        }
    return false;
}

/* A misspelt key counts as given, so that one slip gives one message. */
static void read_table(struct reading *reading, const struct node *map, const struct path *path,
                       const struct parameter *table, void *values)
{
    const char *names[KEYS_MAX];
    int owner[KEYS_MAX];
    bool given[KEYS_MAX] = {false};
    int count = table_names(reading, table, names, owner);
    for (int k = 0; !PARAMETER_IS_END(&table[k]); k++)
        clear_value(&table[k], (char *)values + table[k].offset);
    for (int i = 0; i < map->count; i++) {
        const struct node *entry = map->child[i];
        int at = 0;
        while (at < count && strcmp(names[at], entry->key) != 0)
            at++;
        if (at < count) {
            const struct parameter *parameter = &table[owner[at]];
            read_entry(reading, entry, path, parameter, given[owner[at]],
                       (char *)values + parameter->offset);
            given[owner[at]] = true;
        } else if (path || strcmp(entry->key, let_key) != 0) {
            if (path && suggest_within(reading, map, entry, path, table))
                continue;
            if (path ? suggest_choice(reading, entry, path, table)
                     : suggest_path(reading, entry, table, names, count))
                continue;
            complain_unknown(reading, entry->key_place, path,
                             strchr(entry->key, ':') ? "a blank is missing after the colon in"
                                                     : "unknown key",
                             entry->key, names, count);
            const char *near = nearest_name(entry->key, names, count);
            for (at = 0; near && at < count; at++)
                given[owner[at]] = given[owner[at]] || !strcmp(near, names[at]);
        }
    }
    for (int k = 0; !PARAMETER_IS_END(&table[k]); k++) {
        struct path inside = {path, table[k].key, 0};
        if (given[k])
            continue;
        if (!table[k].standard)
            complain_missing(reading, map, path, &table[k]);
        else
            read_standard(reading, &inside, &table[k], (char *)values + table[k].offset);
    }
}

static bool is_identifier(const char *text)
{
    if (!isalpha((unsigned char)text[0]) && text[0] != '_')
        return false;
    for (; *text; text++)
        if (!isalnum((unsigned char)*text) && *text != '_')
            return false;
    return true;
}

/* Evaluates the names in their order. One that is wrong stays as NAN, so that what rests on it is
 * not told as wrong once more. */
static void read_let(struct reading *reading, const struct node *let)
{
    struct path top = {NULL, let_key, 0};
    if (let->kind != NODE_MAP) {
        if (!node_is_empty(let))
            complain_kind(reading, let, &top, "a map of names and quantities");
        return;
    }
    reading->name = calloc((size_t)let->count + 1, sizeof *reading->name);
    reading->names.at = reading->name;
    if (!reading->name) {
        complain_memory(reading);
        return;
    }
    for (int i = 0; i < let->count; i++) {
        const struct node *entry = let->child[i];
        struct path path = {&top, entry->key, 0};
        struct quantity quantity = {.value = NAN};
        if (!is_identifier(entry->key)) {
            complain(reading, entry->key_place, &path,
                     "a name is made of letters, digits and _, and starts with a letter%s",
                     strchr(entry->key, ':') ? "; a blank is missing after the colon" : "");
            continue;
        }
        if (!read_quantity(reading, entry, &path, "a quantity", &quantity)) {
            quantity.value = NAN;
            reading->wrong_names++;
        }
        reading->name[reading->names.count] = (struct named_quantity){entry->key, quantity};
        if (!name_index_add(&reading->names.index, entry->key, reading->names.count++))
            complain_memory(reading);
    }
}

static void forget_names(struct reading *reading)
{
    free(reading->name);
    name_index_free(&reading->names.index);
}

struct error *document_evaluate(const struct document *document, const char *text,
                                struct quantity *quantity)
{
    const struct node *let = node_entry(document->root, let_key);
    struct reading reading = {.document = (struct document *)document, .let = let};
    if (let)
        read_let(&reading, let);
    struct error *error = reading.error;
    if (!error)
        error = expression_evaluate(text, &reading.names, quantity);
    forget_names(&reading);
    return error;
}

struct error *document_read_partly(struct document *document, const struct parameter *table,
                                   const struct catalogue *catalogue, void *values)
{
    struct reading reading = {.document = document, .catalogue = catalogue};
    const struct node *let = node_entry(document->root, let_key);
    reading.let = let;
    if (let)
        read_let(&reading, let);
    read_table(&reading, document->root, NULL, table, values);
    forget_names(&reading);
    return reading.error;
}

struct error *document_read(struct document *document, const struct parameter *table,
                            const struct catalogue *catalogue, void *values)
{
    struct error *error = document_read_partly(document, table, catalogue, values);
    if (error)
        parameters_release(table, values);
    return error;
}
