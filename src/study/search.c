/* Searches; see search.h. */
#include "study/search.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/sweep.h"

/* Bisections at most: more would divide what rounding leaves. */
enum { BISECTIONS_MOST = 40 };

/* A search in progress. */
struct bisection {
    const char *path, *name, *folder;
    const struct search *search;
    struct verify_options options; /* with room for our own settings behind the user's */
    const char **settings;
    struct unit unit;
    double from, to, within; /* within: in UNIT, or a fraction */
    bool relative;
    struct search_result *result;
};

/* The settings that make the case a sweep of one run with VALUE. Free *SWEEP. */
static struct error *set_value(struct bisection *bisection, const char *value, char **sweep)
{
    struct case_options *reading = &bisection->options.reading;
    *sweep = text_format("sweep={\"%s\": [\"%s\"]}", bisection->search->key, value);
    if (!*sweep)
        return out_of_memory();
    bisection->settings[reading->setting_count - 2] = "fits={}";
    bisection->settings[reading->setting_count - 1] = *sweep;
    return NULL;
}

static struct error *find_check(const struct simulation_case *input, const char *check)
{
    const struct named_map *checks = &input->checks;
    const int found = named_map_find(checks, check);
    if (found >= 0)
        return check_has_limit(case_check(input, found))
                   ? NULL
                   : error_new(ERROR_INPUT,
                               "--check: \"%s\" has no limit: give it `at_most`, `at_least` or "
                               "`is` and `within`",
                               check);
    const char *nearest = nearest_name(check, (const char *const *)checks->names, checks->count);
    return error_new(ERROR_INPUT, "--check: the case has no check \"%s\"%s%s%s", check,
                     nearest ? " (did you mean \"" : "", nearest ? nearest : "",
                     nearest ? "\"?)" : "");
}

/* ERROR (taken) with the user's OPTION VALUE wherever it names our own setting SWEEP. */
static struct error *in_words_of_user(struct error *error, const char *sweep, const char *option,
                                      const char *value)
{
    struct error *told = NULL;
    char *setting = error ? text_format("--set %s", sweep) : NULL;
    for (int i = 0; setting && i < error_count(error); i++) {
        const char *text = error_message(error, i), *found = strstr(text, setting);
        told = error_join(told,
                          found ? error_new(error_kind(error), "%.*s%s %s%s", (int)(found - text),
                                            text, option, value, found + strlen(setting))
                                : error_new(error_kind(error), "%s", text));
    }
    free(setting);
    if (!told)
        return error;
    error_free(error);
    return told;
}

/* Reads the case with VALUE, of OPTION, for the key, and gives the quantity that it comes to. */
static struct error *read_value(struct bisection *bisection, const char *option, const char *value,
                                struct quantity *quantity)
{
    char *sweep = NULL;
    struct simulation_case *input = NULL;
    struct error *error = set_value(bisection, value, &sweep);
    if (!error) {
        struct case_options reading = bisection->options.reading;
        reading.sweep_run = 1;
        error = in_words_of_user(
            case_read(bisection->path, &reading, bisection->options.catalogue, &input), sweep,
            option, value);
    }
    if (!error)
        error = find_check(input, bisection->search->check);
    if (!error) {
        *quantity = input->sweep[0].quantity;
        if (isnan(quantity->value))
            error =
                error_new(ERROR_INPUT, "%s: \"%s\" is not a number or a quantity", option, value);
    }
    case_free(input);
    free(sweep);
    return error;
}

/* The unit behind the number in TEXT, NULL where it is no number with a unit. */
static const char *unit_behind(const char *text)
{
    char *end;
    strtod(text, &end);
    if (end == text)
        return NULL;
    end += strspn(end, " ");
    struct unit unit;
    struct error *error = unit_parse(end, &unit);
    const bool fits = !error && unit.offset == 0.0 && strlen(end) < DIMENSION_TEXT;
    error_free(error);
    return fits ? end : NULL;
}

/* Values of the search are in the unit of its ends where both have the same, else in SI units. */
static struct error *choose_unit(struct bisection *bisection, const struct quantity *from)
{
    const char *one = unit_behind(bisection->search->from),
               *other = unit_behind(bisection->search->to);
    char *unit = bisection->result->unit;
    if (one && other && !strcmp(one, other))
        strcpy(unit, one);
    else
        dimension_text(from->dimension, unit);
    return unit_parse(unit, &bisection->unit);
}

static struct error *read_within(struct bisection *bisection, const struct quantity *from)
{
    const char *text = bisection->search->within;
    const struct dimension none = {0};
    struct quantity within;
    bisection->within = 0.01 * fabs(bisection->to - bisection->from);
    if (!text)
        return NULL;
    TRY(error_context(expression_evaluate(text, NULL, &within), "--within"));
    bisection->relative =
        dimension_equal(within.dimension, none) && !dimension_equal(from->dimension, none);
    if (!bisection->relative && !dimension_equal(within.dimension, from->dimension)) {
        char unit[DIMENSION_TEXT];
        return error_new(ERROR_INPUT, "--within: \"%s\" is no quantity in %s, as the values are",
                         text, dimension_text(from->dimension, unit));
    }
    bisection->within = bisection->relative ? within.value : within.value / bisection->unit.scale;
    return bisection->within > 0.0
               ? NULL
               : error_new(ERROR_INPUT, "--within: \"%s\" must be more than 0", text);
}

/* The interval at which a search between A and B ends. */
static double interval(const struct bisection *bisection, double a, double b)
{
    return bisection->relative ? bisection->within * maximum(fabs(a), fabs(b)) : bisection->within;
}

/* Reads what the user wants. No run yet. */
static struct error *prepare(struct bisection *bisection)
{
    const struct search *search = bisection->search;
    struct quantity from, to;
    const char *texts[] = {search->key, search->from, search->to};
    for (size_t i = 0; i < COUNT_OF(texts); i++)
        if (strpbrk(texts[i], "\"\\"))
            return error_new(ERROR_INPUT, "%s: quotes and backslashes are not allowed here",
                             texts[i]);
    TRY(read_value(bisection, "--from", search->from, &from));
    TRY(read_value(bisection, "--to", search->to, &to));
    if (!dimension_equal(from.dimension, to.dimension))
        return error_new(ERROR_INPUT, "--from %s --to %s: values of different dimensions",
                         search->from, search->to);
    TRY(choose_unit(bisection, &from));
    bisection->from = from.value / bisection->unit.scale;
    bisection->to = to.value / bisection->unit.scale;
    if (bisection->from == bisection->to)
        return error_new(ERROR_INPUT, "--from %s --to %s: there is nothing between", search->from,
                         search->to);
    TRY(read_within(bisection, &from));
    const double steps = ceil(log2(fabs(bisection->to - bisection->from) /
                                   interval(bisection, bisection->from, bisection->to)));
    if (steps > BISECTIONS_MOST)
        return error_new(ERROR_INPUT, "--within: \"%s\" takes more than %d runs", search->within,
                         BISECTIONS_MOST);
    bisection->result->expected = 2 + (int)maximum(steps, 0.0);
    return NULL;
}

/* Collective: the table and plots of all runs so far. */
static struct error *write_runs(const struct bisection *bisection)
{
    const struct verify_result *runs = &bisection->result->runs;
    const struct repetitions all = {runs->item, runs->count, NULL};
    const bool writes =
        verify_ranks(&bisection->options)->rank == 0 && runs->count && runs->item[0].sweep_values;
    return ranks_agree(verify_ranks(&bisection->options),
                       writes ? sweep_write(bisection->folder, &all, &(struct check_results){0})
                              : NULL);
}

/* Why RUN did not come to its end; NULL: it did. */
static struct error *run_error(const struct verify_case *run)
{
    struct error *error = NULL;
    for (int i = 0; run->error && i < error_count(run->error); i++)
        error = error_join(error, error_new(error_kind(run->error), "%s: %s", run->name,
                                            error_message(run->error, i)));
    return error;
}

/* Runs the case with VALUE and tells whether the check passes. */
static struct error *try_value(struct bisection *bisection, double value, bool *passes)
{
    struct verify_result *runs = &bisection->result->runs;
    const int before = runs->count;
    char text[96], *sweep = NULL;
    snprintf(text, sizeof text, "%.10g%s%s", value, *bisection->result->unit ? " " : "",
             bisection->result->unit);
    struct error *error =
        ranks_agree(verify_ranks(&bisection->options), set_value(bisection, text, &sweep));
    if (!error)
        error = verify_case(bisection->path, bisection->name, bisection->folder,
                            &bisection->options, runs);
    if (runs->count > before) { /* that checks fail is no error here */
        error_free(error);
        error = run_error(&runs->item[before]);
    }
    free(sweep);
    if (!bisection->options.running.resume)
        bisection->options.running.overwrite = true; /* the table of the run before */
    const struct check_result *check =
        runs->count > before ? verify_find_check(&runs->item[before], bisection->search->check)
                             : NULL;
    *passes = check && (check->verdict == CHECK_PASSED || check->verdict == CHECK_PASSES_NOW);
    return error_join(error, write_runs(bisection));
}

static struct error *same_at_both(const struct bisection *bisection, bool passes)
{
    const struct search *search = bisection->search;
    return error_new(ERROR_INPUT,
                     "check \"%s\" %s with %s = %s and with %s: choose values between which it "
                     "changes",
                     search->check, passes ? "passes" : "fails", search->key, search->from,
                     search->to);
}

static struct error *bisect(struct bisection *bisection)
{
    struct search_result *result = bisection->result;
    double low = bisection->from, high = bisection->to;
    bool at_low, at_high, at_middle;
    TRY(try_value(bisection, low, &at_low));
    if (verify_stop_requested(&bisection->options))
        return NULL;
    TRY(try_value(bisection, high, &at_high));
    if (verify_stop_requested(&bisection->options))
        return NULL;
    if (at_low == at_high)
        return same_at_both(bisection, at_low);
    while (fabs(high - low) > (1.0 + 1e-9) * interval(bisection, low, high)) {
        const double middle = 0.5 * (low + high);
        TRY(try_value(bisection, middle, &at_middle));
        if (verify_stop_requested(&bisection->options))
            return NULL;
        if (at_middle == at_low)
            low = middle;
        else
            high = middle;
    }
    result->found = true;
    result->passes = at_low ? low : high;
    result->fails = at_low ? high : low;
    return NULL;
}

struct error *search_run(const char *path, const char *name, const char *folder,
                         const struct verify_options *options, const struct search *search,
                         struct search_result *result)
{
    struct bisection bisection = {
        path, name, folder, search, .options = *options, .result = result};
    struct case_options *reading = &bisection.options.reading;
    *result = (struct search_result){0};
    bisection.settings =
        memory_allocate(((size_t)reading->setting_count + 2) * sizeof *bisection.settings);
    if (!bisection.settings)
        return out_of_memory();
    for (int i = 0; i < reading->setting_count; i++)
        bisection.settings[i] = reading->settings[i];
    reading->settings = bisection.settings;
    reading->setting_count += 2;
    struct error *error = ranks_agree(verify_ranks(options), prepare(&bisection));
    if (!error)
        error = bisect(&bisection);
    free(bisection.settings);
    return error;
}

void search_result_free(struct search_result *result)
{
    verify_result_free(&result->runs);
    *result = (struct search_result){0};
}
