/* The sweep of a case and its convergence study: which runs they ask for, and the values that one
 * of them takes. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/visible.h"
#include "case/internal.h"
#include "document/nodes.h"

enum { SWEEP_RUNS_MAX = 10000, SWEEP_KEYS_MAX = 1000 };

static const char sweep_key[] = "sweep", let_key[] = "let", study_key[] = "convergence",
                  include_key[] = "include";

static bool is_key_of_case(const char *key)
{
    for (const struct parameter *p = case_table; !PARAMETER_IS_END(p); p++)
        if (!strcmp(p->key, key))
            return true;
    return false;
}

struct error *case_find_target(const struct document *document, const char *key, struct mark place,
                               const char *told, char **path)
{
    const struct node *let = node_entry(document->root, let_key);
    bool named = let && node_entry(let, key);
    *path = NULL;
    if (named || strchr(key, '.') || is_key_of_case(key)) {
        *path = named ? text_format("%s.%s", let_key, key) : text_copy(key);
        return *path ? NULL : out_of_memory();
    }
    const char *names[KEYS_MAX], *near;
    int count = 0;
    for (; let && let->kind == NODE_MAP && count < KEYS_MAX && count < let->count; count++)
        names[count] = let->child[count]->key;
    for (const struct parameter *p = case_table; !PARAMETER_IS_END(p) && count < KEYS_MAX; p++)
        names[count++] = p->key;
    near = nearest_name(key, names, count);
    return place_error(place, told, "\"%.60s\" is neither a name of let nor a path%s%s%s", key,
                       near ? " (did you mean \"" : "", near ? near : "", near ? "\"?)" : "");
}

/* True for the files that a case includes, unless a name of `let` is called so. */
static bool is_include(const struct document *document, const char *key)
{
    const struct node *let = node_entry(document->root, let_key);
    return !strcmp(key, include_key) && !(let && node_entry(let, key));
}

static struct error *check_values(const struct node *list, const char *told)
{
    struct error *error = NULL;
    if (list->kind != NODE_LIST || list->count == 0)
        return place_error(node_place(list), told, "expected a list of values");
    for (int i = 0; i < list->count; i++)
        if (list->child[i]->kind == NODE_MAP || node_is_empty(list->child[i]))
            error = error_join(error, place_error(node_place(list->child[i]), told,
                                                  "expected a number, a text or a list of them"));
    return error;
}

/* "2 km/s" of a value, "[2 km/s, 0 m/s]" of a list. In fresh memory; NULL when that is out. */
static char *value_text(const struct node *value)
{
    if (value->kind != NODE_LIST)
        return text_copy(value->text ? value->text : "");
    char *text = text_copy("[");
    for (int i = 0; i < value->count && text; i++) {
        char *item = value_text(value->child[i]);
        char *longer = item ? text_format("%s%s%s", text, i ? ", " : "", item) : NULL;
        free(item);
        free(text);
        text = longer;
    }
    char *whole = text ? text_format("%s]", text) : NULL;
    free(text);
    return whole;
}

/* The lists of an entry of a sweep: its own, or those of the map of keys that change together. */
static int lists_of(const struct node *entry) { return entry->kind == NODE_MAP ? entry->count : 1; }

static const struct node *list_of(const struct node *entry, int k)
{
    return entry->kind == NODE_MAP ? entry->child[k] : entry;
}

static int values_of(const struct node *entry) { return list_of(entry, 0)->count; }

/* Which of the values of the entry at INDEX of SWEEP RUN takes: the last entry changes fastest. */
static int choice_of(const struct node *sweep, int index, int run)
{
    int runs_below = 1;
    for (int i = index + 1; i < sweep->count; i++)
        runs_below *= values_of(sweep->child[i]);
    const int values = values_of(sweep->child[index]);
    assert(values > 0); /* check_values */
    return (run - 1) / runs_below % values;
}

/* Puts a copy of VALUE, which keeps its place in the file, at PATH, unless that is NULL. */
static struct error *take_value(struct simulation_case *input, int entry, const char *key,
                                const char *path, const struct node *value)
{
    struct sweep_value *taken = &input->sweep[input->sweep_values++];
    taken->entry = entry;
    taken->key = text_copy(key);
    taken->text = value_text(value);
    taken->quantity.value = NAN;
    struct node *copy = node_copy(value);
    struct error *error = taken->key && taken->text && copy ? NULL : out_of_memory();
    if (!error && path)
        error = document_set(input->document, path, &copy);
    node_free(copy);
    return error;
}

static struct error *check_list(const struct document *document, const struct node *list)
{
    char *path = NULL, told[512];
    snprintf(told, sizeof told, "%s.%s", sweep_key, list->key);
    struct error *error = is_include(document, list->key)
                              ? NULL
                              : case_find_target(document, list->key, list->key_place, told, &path);
    free(path);
    return error_join(error, check_values(list, told));
}

static struct error *check_entry(const struct document *document, const struct node *entry)
{
    struct error *error = NULL;
    if (lists_of(entry) == 0)
        return place_error(node_place(entry), sweep_key, "\"%s\" names no lists of values",
                           entry->key);
    for (int k = 0; k < lists_of(entry); k++)
        error = error_join(error, check_list(document, list_of(entry, k)));
    for (int k = 1; k < lists_of(entry) && !error; k++)
        if (list_of(entry, k)->count != values_of(entry))
            error = place_error(node_place(list_of(entry, k)), sweep_key,
                                "\"%s\" and \"%s\" change together: expected %d values, not %d",
                                list_of(entry, 0)->key, list_of(entry, k)->key, values_of(entry),
                                list_of(entry, k)->count);
    return error;
}

/* *ALL is the number of runs, 0 for a mistake. */
static struct error *check_entries(const struct document *document, const struct node *sweep,
                                   int *all)
{
    *all = 0;
    struct error *error = NULL;
    double runs = 1.0;
    int lists = 0;
    for (int i = 0; i < sweep->count; i++)
        lists += lists_of(sweep->child[i]);
    if (lists > SWEEP_KEYS_MAX)
        return place_error(sweep->key_place, sweep_key, "these are more than %d keys",
                           SWEEP_KEYS_MAX);
    for (int i = 0; i < sweep->count; i++) {
        struct error *wrong = check_entry(document, sweep->child[i]);
        runs *= wrong ? 1.0 : values_of(sweep->child[i]);
        error = error_join(error, wrong);
    }
    if (!error && runs > SWEEP_RUNS_MAX)
        error =
            place_error(sweep->key_place, sweep_key, "these are more than %d runs", SWEEP_RUNS_MAX);
    *all = error ? 0 : (int)runs;
    return error;
}

/* Puts the value of choice CHOICE of LIST, of the entry ENTRY, where it belongs. */
static struct error *take_choice(struct simulation_case *input, int entry, const struct node *list,
                                 int choice)
{
    char *path = NULL;
    struct error *error =
        is_include(input->document, list->key)
            ? NULL
            : case_find_target(input->document, list->key, list->key_place, sweep_key, &path);
    if (!error)
        error = take_value(input, entry, list->key, path, list->child[choice]);
    free(path);
    return error;
}

static struct error *take_values(struct simulation_case *input, const struct node *sweep, int run)
{
    struct error *error = NULL;
    int lists = 0;
    for (int i = 0; i < sweep->count; i++)
        lists += lists_of(sweep->child[i]);
    input->sweep = memory_allocate((size_t)lists * sizeof *input->sweep);
    if (!input->sweep)
        return out_of_memory();
    for (int i = 0; i < sweep->count; i++)
        for (int k = 0; k < lists_of(sweep->child[i]); k++)
            error = error_join(error, take_choice(input, i, list_of(sweep->child[i], k),
                                                  choice_of(sweep, i, run)));
    return error;
}

const struct node *case_swept_include(const struct document *document, int run, int *runs)
{
    const struct node *sweep = node_entry(document->root, sweep_key);
    *runs = 0;
    if (sweep && sweep->kind == NODE_MAP && sweep->count > 0)
        error_free(check_entries(document, sweep, runs));
    for (int i = 0; run > 0 && run <= *runs && i < sweep->count; i++)
        for (int k = 0; k < lists_of(sweep->child[i]); k++) {
            const struct node *list = list_of(sweep->child[i], k);
            if (is_include(document, list->key))
                return list->child[choice_of(sweep, i, run)];
        }
    return NULL;
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
        error = check_entries(input->document, sweep, &input->sweep_runs);
        if (!error && run > 0 && run <= input->sweep_runs)
            error = take_values(input, sweep, run);
    } else if (sweep->kind != NODE_MAP && !node_is_empty(sweep)) {
        error = place_error(node_place(sweep), sweep_key, "expected a map of names and lists");
    }
    node_free(sweep);
    return error;
}

/* What a study is about: a list of values of KEY, or (VALUES is NULL) the resolution. */
struct varied {
    const char *key;
    struct mark place;
    const struct node *values;
};

/* How many times the resolution of the case stands in each run that nobody chose. */
static const double standard_factors[] = {4.0, 2.0, 1.0};

/* False where the study says nothing that can be understood; the reading tells that. */
static bool find_varied(const struct document *document, struct varied *varied)
{
    const struct node *study = node_entry(document->root, study_key);
    *varied = (struct varied){.key = "resolution"};
    if (!study || node_is_empty(study))
        return true;
    const struct node *vary = node_entry(study, "vary");
    if (study->kind != NODE_MAP || (vary && vary->kind != NODE_SCALAR))
        return false;
    varied->place = node_place(study);
    varied->values = node_entry(study, "values");
    if (vary && !node_is_empty(vary)) {
        varied->key = vary->text;
        varied->place = vary->place;
    }
    return true;
}

/* Tells what is wrong with it that the reading does not; *PATH is what it puts its values to. */
static struct error *check_varied(const struct document *document, const struct varied *varied,
                                  char **path)
{
    const struct node *values = varied->values;
    struct error *error =
        case_find_target(document, varied->key, varied->place, "convergence.vary", path);
    if (values && (values->kind == NODE_SCALAR || (values->kind == NODE_LIST && values->count < 2)))
        return error_join(error, place_error(node_place(values), "convergence.values",
                                             "expected a list of at least two values"));
    if (!error && !values && strcmp(varied->key, "resolution") != 0)
        return place_error(varied->place, "convergence",
                           "`values` is missing: what \"%s\" is in each run", varied->key);
    return error;
}

/* FACTOR times the resolution, as a value of the case. Where it is no length, which the reading
 * tells, it stays. */
static struct error *take_multiple(struct simulation_case *input, double factor)
{
    static const char key[] = "resolution";
    const struct node *node = node_entry(input->document->root, key);
    struct quantity resolution;
    struct unit metre;
    if (!node || node->kind != NODE_SCALAR)
        return NULL;
    TRY(unit_parse("m", &metre));
    struct error *error = document_evaluate(input->document, node->text, &resolution);
    if (error || !dimension_equal(resolution.dimension, metre.dimension)) {
        error_free(error);
        return NULL;
    }
    struct node value = {.kind = NODE_SCALAR, .plain = true, .place = node->place};
    value.text = factor == 1.0 ? text_copy(node->text)
                               : text_format("%.15g mm", 1e3 * factor * resolution.value);
    error = value.text ? take_value(input, 0, key, key, &value) : out_of_memory();
    free(value.text);
    return error;
}

struct error *case_take_study(struct simulation_case *input, const struct case_options *options)
{
    struct varied varied;
    char *path = NULL;
    if (!find_varied(input->document, &varied))
        return NULL;
    struct error *error = check_varied(input->document, &varied, &path);
    if (!error && options->convergence) {
        int run = options->sweep_run;
        input->sweep_runs = varied.values ? varied.values->count : (int)COUNT_OF(standard_factors);
        if (run > 0 && run <= input->sweep_runs) {
            input->sweep = memory_allocate(sizeof *input->sweep);
            if (!input->sweep)
                error = out_of_memory();
            else if (varied.values)
                error = take_value(input, 0, varied.key, path, varied.values->child[run - 1]);
            else
                error = take_multiple(input, standard_factors[run - 1]);
        }
    }
    free(path);
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

/* The last part of the path of the value at INDEX, or the whole where another ends with the
 * same. */
static const char *short_key(const struct sweep_value *values, int count, int index)
{
    const char *dot = strrchr(values[index].key, '.');
    if (!dot || !dot[1])
        return values[index].key;
    for (int i = 0; i < count; i++) {
        const char *other = strrchr(values[i].key, '.');
        if (i != index && !strcmp(other ? other + 1 : values[i].key, dot + 1))
            return values[index].key;
    }
    return dot + 1;
}

/* "U0=500 m/s,pore=1 mm"; with FIRSTS of the first value of every entry. */
static char *values_text(const struct sweep_value *values, int count, bool firsts)
{
    char *text = text_copy("");
    for (int i = 0; i < count && text; i++) {
        if (firsts && i > 0 && values[i].entry == values[i - 1].entry)
            continue;
        char *longer = text_format("%s%s%s=%s", text, text[0] ? "," : "",
                                   short_key(values, count, i), values[i].text);
        free(text);
        text = longer;
    }
    return text;
}

char *sweep_run_name(const struct sweep_value *values, int count)
{
    enum { LONGEST = 120 }; /* a folder has a name of 255 bytes at most */
    char *name = values_text(values, count, false);
    if (name && strlen(name) > LONGEST) {
        free(name);
        name = values_text(values, count, true);
    }
    if (name)
        text_make_file_name(name);
    return name;
}
