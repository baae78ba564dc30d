/* Checks on paper: the table as CSV, its entries as a person reads them, and the pictures that lay
 * the particles over the exact solution. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"
#include "picture/picture.h"
#include "run/checks_internal.h"

enum { CURVE_POINTS = 2000 };

/* The power of 1000 that brings VALUE to 1 .. 1000, for units that take prefixes. */
static void quantity_text(double value, const char *unit, char *buffer, size_t size)
{
    static const struct {
        const char *prefix;
        double factor;
    } prefixes[] = {{"G", 1e9},  {"M", 1e6},  {"k", 1e3},  {"", 1.0},
                    {"m", 1e-3}, {"u", 1e-6}, {"n", 1e-9}, {"p", 1e-12}};
    bool takes_prefix = !strcmp(unit, "Pa") || !strcmp(unit, "m") || !strcmp(unit, "s") ||
                        !strcmp(unit, "J/kg") || !strcmp(unit, "J");
    size_t last = COUNT_OF(prefixes) - 1, i = takes_prefix ? 0 : 3;
    if (takes_prefix && isfinite(value) && value != 0.0)
        while (i < last && fabs(value) < 0.9999995 * prefixes[i].factor)
            i++;
    else
        i = 3;
    snprintf(buffer, size, "%.5g%s%s%s", value / prefixes[i].factor, unit[0] ? " " : "",
             prefixes[i].prefix, unit);
}

void check_measured_text(const struct check_result *result, char *buffer, size_t size)
{
    if (isnan(result->measured))
        snprintf(buffer, size, "nothing");
    else
        quantity_text(result->measured, result->unit, buffer, size);
}

void check_allowed_text(const struct check_result *result, char *buffer, size_t size)
{
    char low[48], high[48], wanted[48], distance[48];
    if (result->verdict == CHECK_MEASURED_ONLY) {
        snprintf(buffer, size, "no limit");
        return;
    }
    quantity_text(result->low, result->unit, low, sizeof low);
    quantity_text(result->high, result->unit, high, sizeof high);
    double above = result->high - result->wanted, below = result->wanted - result->low;
    /* `at_most` and `at_least` may have cut one side of `within`. */
    if (!isnan(result->wanted) &&
        fabs(above - below) <= 1e-9 * (above + below) + 1e-15 * fabs(result->wanted)) {
        quantity_text(result->wanted, result->unit, wanted, sizeof wanted);
        quantity_text(above, result->unit, distance, sizeof distance);
        snprintf(buffer, size, "%s +- %s", result->wanted == 0.0 ? "0" : wanted, distance);
    } else if (isinf(result->low))
        snprintf(buffer, size, "at most %s", high);
    else if (isinf(result->high))
        snprintf(buffer, size, "at least %s", low);
    else
        snprintf(buffer, size, "%s .. %s", low, high);
}

void check_bound_text(const struct check_result *result, char *buffer, size_t size)
{
    const struct quantity *bound = &result->changes;
    if (dimension_equal(bound->dimension, (struct dimension){0}))
        snprintf(buffer, size, "%.6g %%", 100.0 * bound->value);
    else
        quantity_text(bound->value, result->unit, buffer, size);
}

const char *check_verdict_name(enum check_verdict verdict)
{
    return verdict == CHECK_PASSED            ? "passed"
           : verdict == CHECK_KNOWN_DEVIATION ? "known deviation"
           : verdict == CHECK_MEASURED_ONLY   ? "measured only"
                                              : "FAILED";
}

char *check_verdict_text(const struct check_result *result)
{
    const char *name = check_verdict_name(result->verdict);
    if (result->verdict == CHECK_PASSES_NOW)
        return text_format("%s: passes now: remove `known_deviation`", name);
    if (result->verdict == CHECK_PASSED && result->regression_bound)
        return text_format("%s (regression bound)", name);
    const char *why = result->known_deviation ? result->known_deviation : result->nothing;
    return why ? text_format("%s: %s", name, why) : text_copy(name);
}

struct error *check_results_write(const struct check_results *results, const char *path)
{
    static const char *const verdicts[] = {"failed", "passed", "known deviation", "passes now",
                                           "measured only"};
    FILE *file;
    TRY(file_begin(path, &file));
    fprintf(file, "check,measure,unit,measured,wanted,low,high,verdict,source,time,known_deviation,"
                  "regression_bound,nothing\n");
    for (int i = 0; i < results->count; i++) {
        const struct check_result *r = &results->item[i];
        csv_put_text(file, r->name);
        fprintf(file, ",%s,%s,", r->measure, r->unit);
        const double numbers[] = {r->measured, r->wanted, r->low, r->high};
        for (size_t k = 0; k < COUNT_OF(numbers); k++) {
            csv_put_number(file, numbers[k]);
            putc(',', file);
        }
        fprintf(file, "%s,", verdicts[r->verdict]);
        csv_put_text(file, r->source);
        putc(',', file);
        csv_put_number(file, r->time);
        putc(',', file);
        csv_put_text(file, r->known_deviation);
        fprintf(file, ",%s,", r->regression_bound ? "yes" : "no");
        csv_put_text(file, r->nothing);
        putc('\n', file);
    }
    return file_end(path, file);
}

/* The exact solution over the range of the particles. */
static bool find_curve(const struct measurement *m, const struct scatter *particles,
                       struct scatter *curve)
{
    const struct measure_field *parameters = m->check->measure.value;
    const double time = m->simulation->time;
    double low = INFINITY, high = -INFINITY;
    for (int64_t i = 0; i < particles->count; i++) {
        low = minimum(low, particles->x[i]);
        high = maximum(high, particles->x[i]);
    }
    if (!scatter_allocate(curve, CURVE_POINTS))
        return false;
    for (int i = 0; i < CURVE_POINTS; i++) {
        double x = low + (high - low) * i / (CURVE_POINTS - 1);
        struct exact_state state =
            m->exact->sample(m->solved, exact_side_at(m->exact, m->solved, x, time), x, time);
        curve->x[i] = x;
        curve->y[i] = exact_field(&state, parameters->field);
    }
    return true;
}

static struct error *draw(const struct measurement *m, const struct scatter *particles,
                          const char *unit, const char *path)
{
    static const char *const axes[] = {"x", "y", "z"};
    const struct measure_field *parameters = m->check->measure.value;
    struct scatter curve;
    struct error *error = NULL;
    if (find_curve(m, particles, &curve)) {
        struct series series[] = {
            {"exact", curve.count, curve.x, curve.y, LINE_PLAIN},
            {population_members(m->population), particles->count, particles->x, particles->y,
             LINE_NONE},
        };
        struct plot plot = {.title = m->simulation->problem->input->title,
                            .x_name = m->check->about.count ? "distance" : axes[m->check->axis],
                            .x_unit = "m",
                            .y_name = parameters->field,
                            .y_unit = unit,
                            .count = 2,
                            .series = series,
                            .own_folder = true};
        error = picture_plot(path, &plot);
    } else
        error = out_of_memory_for("a picture");
    scatter_free(&curve);
    return error;
}

/* The particles' places and values as dots, on rank 0 those of all. */
static struct error *take_dots(const struct measurement *m, struct scatter *dots)
{
    const struct ranks *ranks = m->simulation->ranks;
    struct samples samples;
    *dots = (struct scatter){0};
    TRY(samples_take(m, &samples));
    bool made = scatter_allocate(dots, samples.count);
    for (int64_t i = 0; i < samples.count && made; i++) {
        dots->x[i] = samples.at[i].at;
        dots->y[i] = samples.at[i].value;
    }
    samples_free(&samples);
    TRY(ranks_agree(ranks, made ? NULL : out_of_memory_for("a picture")));
    return scatter_gather(ranks, dots);
}

/* Takes the samples of a whole field (not of a check's window) and draws them. */
static struct error *draw_field(const struct measurement *measurement, const char *folder,
                                const char *name)
{
    struct check_input everywhere = *measurement->check;
    everywhere.of = NULL;
    everywhere.between.count = 0;
    struct measurement m = *measurement;
    m.check = &everywhere;
    const char *unit;
    struct scatter dots;
    TRY(measure_field_unit(&m, &unit));
    struct error *error = take_dots(&m, &dots);
    if (!error && dots.count > 1) {
        char *path = path_join(folder, name);
        error = path ? draw(&m, &dots, unit, path) : out_of_memory_for("a picture");
        free(path);
    }
    scatter_free(&dots);
    return ranks_agree(m.simulation->ranks, error);
}

/* Whether M compares a field with the exact solution. */
static bool is_drawn(const struct measurement *m)
{
    const struct measure_class *class = m->check->measure.choice->thing;
    return m->exact && class->needs_exact;
}

/* True when an earlier check has drawn this one's field. */
static bool drawn_before(const struct checks *checks, int index)
{
    const struct measure_field *field = checks->item[index].measurement.check->measure.value;
    for (int i = 0; i < index; i++) {
        const struct measurement *m = &checks->item[i].measurement;
        const struct measure_field *other = m->check->measure.value;
        if (is_drawn(m) && !strcmp(other->field, field->field))
            return true;
    }
    return false;
}

char *checks_picture(const struct checks *checks, int index)
{
    const struct measurement *m = &checks->item[index].measurement;
    if (!is_drawn(m) || drawn_before(checks, index))
        return NULL;
    const struct measure_field *parameters = m->check->measure.value;
    return text_format("check-%s.png", parameters->field);
}

struct error *checks_draw(const struct checks *checks, const struct simulation *simulation,
                          const struct population *population, const char *folder)
{
    for (int i = 0; i < checks->count; i++) {
        struct measurement m = checks->item[i].measurement;
        m.simulation = simulation;
        m.population = simulation_seen(simulation, m.check->of, population);
        if (!is_drawn(&m) || drawn_before(checks, i))
            continue;
        char *name = checks_picture(checks, i);
        struct error *error =
            ranks_agree(simulation->ranks, name ? NULL : out_of_memory_for("a picture"));
        if (!error)
            error = draw_field(&m, folder, name);
        free(name);
        TRY(error);
    }
    return NULL;
}
