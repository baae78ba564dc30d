/* The sweep of a case: which runs it asks for, and the values that one of them takes. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "model/case_internal.h"
#include "model/document_internal.h"

enum { SWEEP_RUNS_MAX = 10000 };

static const char sweep_key[] = "sweep", let_key[] = "let";

static struct error *out_of_memory(void) { return error_new(ERROR_SYSTEM, "out of memory"); }

static struct error *mistake(const struct node *entry, struct place place, const char *text)
{
    char path[512];
    snprintf(path, sizeof path, "%s.%s", sweep_key, entry->key);
    return place_error(place, path, "%s", text);
}

static bool is_key_of_case(const char *key)
{
    for (const struct parameter *p = case_table; !PARAMETER_IS_END(p); p++)
        if (!strcmp(p->key, key))
            return true;
    return false;
}

/* The path that ENTRY is about: a name of `let` before anything else. */
static struct error *find_target(const struct document *document, const struct node *entry,
                                 char **path)
{
    const struct node *let = node_entry(document->root, let_key);
    bool named = let && node_entry(let, entry->key);
    *path = NULL;
    if (named || strchr(entry->key, '.') || is_key_of_case(entry->key)) {
        *path = named ? text_format("%s.%s", let_key, entry->key) : text_copy(entry->key);
        return *path ? NULL : out_of_memory();
    }
    const char *names[KEYS_MAX], *near;
    int count = 0;
    for (; let && let->kind == NODE_MAP && count < KEYS_MAX && count < let->count; count++)
        names[count] = let->child[count]->key;
    for (const struct parameter *p = case_table; !PARAMETER_IS_END(p) && count < KEYS_MAX; p++)
        names[count++] = p->key;
    near = nearest_name(entry->key, names, count);
    char text[256];
    snprintf(text, sizeof text, "\"%.60s\" is neither a name of let nor a path%s%s%s", entry->key,
             near ? " (did you mean \"" : "", near ? near : "", near ? "\"?)" : "");
    return mistake(entry, entry->key_place, text);
}

static struct error *check_values(const struct node *entry)
{
    struct error *error = NULL;
    if (entry->kind != NODE_LIST || entry->count == 0)
        return mistake(entry, node_place(entry), "a list of values is wanted");
    for (int i = 0; i < entry->count; i++)
        if (entry->child[i]->kind != NODE_SCALAR || node_is_empty(entry->child[i]))
            error = error_join(error, mistake(entry, node_place(entry->child[i]),
                                              "a single value is wanted, a number or a text"));
    return error;
}

/* Which value of ENTRY, the entry at INDEX of SWEEP, RUN takes: the last entry changes fastest. */
static const struct node *value_of(const struct node *sweep, int index, int run)
{
    int runs_below = 1;
    for (int i = index + 1; i < sweep->count; i++)
        runs_below *= sweep->child[i]->count;
    const struct node *entry = sweep->child[index];
    return entry->child[(run - 1) / runs_below % entry->count];
}

/* Puts a copy of VALUE, which keeps its place in the file, at PATH. */
static struct error *take_value(struct simulation_case *input, const char *key, const char *path,
                                const struct node *value)
{
    struct sweep_value *taken = &input->sweep[input->sweep_values++];
    taken->key = text_copy(key);
    taken->text = text_copy(value->text);
    taken->quantity.value = NAN;
    struct node *copy = node_new(NODE_SCALAR, value->place);
    if (copy) {
        copy->text = text_copy(value->text);
        copy->plain = value->plain;
    }
    struct error *error = taken->key && taken->text && copy && copy->text
                              ? document_set(input->document, path, &copy)
                              : out_of_memory();
    node_free(copy);
    return error;
}

static struct error *check_entries(struct simulation_case *input, const struct node *sweep)
{
    struct error *error = NULL;
    double runs = 1.0;
    for (int i = 0; i < sweep->count; i++) {
        char *path;
        error = error_join(error, find_target(input->document, sweep->child[i], &path));
        error = error_join(error, check_values(sweep->child[i]));
        runs *= sweep->child[i]->count;
        free(path);
    }
    if (!error && runs > SWEEP_RUNS_MAX)
        error =
            place_error(sweep->key_place, sweep_key, "these are more than %d runs", SWEEP_RUNS_MAX);
    input->sweep_runs = error ? 0 : (int)runs;
    return error;
}

static struct error *take_values(struct simulation_case *input, const struct node *sweep, int run)
{
    struct error *error = NULL;
    input->sweep = memory_allocate((size_t)sweep->count * sizeof *input->sweep);
    if (!input->sweep)
        return out_of_memory();
    for (int i = 0; i < sweep->count; i++) {
        const char *key = sweep->child[i]->key;
        char *path = NULL;
        struct error *wrong = find_target(input->document, sweep->child[i], &path);
        if (!wrong)
            wrong = take_value(input, key, path, value_of(sweep, i, run));
        error = error_join(error, wrong);
        free(path);
    }
    return error;
}

struct error *case_take_sweep(struct simulation_case *input, int run)
{
    struct node *root = input->document->root, *sweep = NULL;
    for (int i = 0; i < root->count && !sweep; i++)
        if (!strcmp(root->child[i]->key, sweep_key))
            sweep = node_take(root, i);
    if (!sweep)
        return NULL;
    struct error *error = NULL;
    if (sweep->kind == NODE_MAP && sweep->count > 0) {
        error = check_entries(input, sweep);
        if (!error && run > 0 && run <= input->sweep_runs)
            error = take_values(input, sweep, run);
    } else if (sweep->kind != NODE_MAP && !node_is_empty(sweep)) {
        error = place_error(node_place(sweep), sweep_key, "a map of names and lists is wanted");
    }
    node_free(sweep);
    return error;
}

void case_measure_sweep(struct simulation_case *input)
{
    for (int i = 0; i < input->sweep_values; i++) {
        struct sweep_value *value = &input->sweep[i];
        struct error *error = document_evaluate(input->document, value->text, &value->quantity);
        if (error)
            value->quantity = (struct quantity){.value = NAN};
        error_free(error);
    }
}

void sweep_values_free(struct sweep_value *values, int count)
{
    for (int i = 0; i < count; i++) {
        free(values[i].key);
        free(values[i].text);
    }
    free(values);
}
