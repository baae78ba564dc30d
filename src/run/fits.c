/* Fits through the runs of a sweep; see fits.h. */
#include "run/fits.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* The swept value called KEY of COUNT; NULL: none. */
static const struct sweep_value *swept(const struct sweep_value *values, int count, const char *key)
{
    for (int k = 0; k < count; k++)
        if (!strcmp(values[k].key, key))
            return &values[k];
    return NULL;
}

static int check_called(const struct simulation_case *input, const char *name)
{
    for (int i = 0; i < input->checks.count; i++)
        if (!strcmp(input->checks.names[i], name))
            return i;
    return -1;
}

/* Of what FIT takes, from those of both axes. */
static struct dimension dimension_of(const struct fit_input *fit, struct dimension x,
                                     struct dimension y)
{
    if (fit->take == FIT_MISFIT || fit->form == FIT_POWER)
        return (struct dimension){0};
    return fit->take == FIT_SLOPE ? dimension_quotient(y, x) : y;
}

static const char *take_name(const struct fit_input *fit)
{
    return fit->take == FIT_SLOPE ? "slope" : fit->take == FIT_INTERCEPT ? "intercept" : "misfit";
}

/* The dimensions of `over` and `of`. */
static struct error *find_axes(const struct simulation_case *input, const struct checks *checks,
                               const struct fit_input *fit, struct dimension *x,
                               struct dimension *y)
{
    struct unit unit;
    const struct sweep_value *value = swept(input->sweep, input->sweep_values, fit->over);
    TRY(unit_parse(checks_unit(checks, check_called(input, fit->of)), &unit));
    *y = unit.dimension;
    if (value && isnan(value->quantity.value))
        return error_new(ERROR_INPUT, "`over`: the values of \"%s\" are no quantities", fit->over);
    if (value)
        *x = value->quantity.dimension;
    else {
        TRY(unit_parse(checks_unit(checks, check_called(input, fit->over)), &unit));
        *x = unit.dimension;
    }
    return NULL;
}

static struct error *prepare(const struct simulation_case *input, const struct checks *checks,
                             const struct fit_input *fit)
{
    struct dimension x, y;
    double wanted, low, high;
    TRY(find_axes(input, checks, fit, &x, &y));
    TRY(check_same_dimension("over", "from", &fit->from, x));
    TRY(check_same_dimension("over", "to", &fit->to, x));
    return check_find_limits(&fit->check, take_name(fit), dimension_of(fit, x, y), &wanted, &low,
                             &high);
}

struct error *fits_prepare(const struct simulation_case *input, const struct checks *checks)
{
    struct error *all = NULL;
    for (int i = 0; i < input->fits.count && input->sweep_values > 0; i++) {
        struct error *error = prepare(input, checks, case_fit(input, i));
        if (error)
            all = error_join(all, input_error(input, "fits", input->fits.names[i], "%s",
                                              error_message(error, 0)));
        error_free(error);
    }
    return all;
}

struct points {
    int count;
    double *x, *y;
    struct dimension x_dimension, y_dimension;
};

/* The runs that have both values, in the bounds of FIT. */
static struct error *take_points(const struct fit_input *fit, const struct verify_case *runs,
                                 int count, struct points *points)
{
    struct unit unit;
    for (int i = 0; i < count; i++) {
        const struct check_result *y = verify_find_check(&runs[i], fit->of);
        const struct check_result *other = verify_find_check(&runs[i], fit->over);
        const struct sweep_value *value = swept(runs[i].sweep, runs[i].sweep_values, fit->over);
        if (!y || (!value && !other))
            continue;
        TRY(unit_parse(y->unit, &unit));
        points->y_dimension = unit.dimension;
        if (!value)
            TRY(unit_parse(other->unit, &unit));
        points->x_dimension = value ? value->quantity.dimension : unit.dimension;
        const double x = value ? value->quantity.value : other->measured;
        if (!isfinite(x) || !isfinite(y->measured) || x < fit->from.value || x > fit->to.value)
            continue;
        points->x[points->count] = x;
        points->y[points->count++] = y->measured;
    }
    return NULL;
}

/* y = a + b x by least squares; NAN where no line is determined. */
static void fit_line(const struct points *points, double *a, double *b)
{
    const double n = points->count;
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (int i = 0; i < points->count; i++) {
        x += points->x[i] / n;
        y += points->y[i] / n;
    }
    for (int i = 0; i < points->count; i++) {
        xx += square(points->x[i] - x);
        xy += (points->x[i] - x) * (points->y[i] - y);
    }
    *b = xx > 0.0 ? xy / xx : NAN;
    *a = y - *b * x;
}

/* What FIT takes of POINTS, whose values become logarithms where it is a power law. */
static double value_of(const struct fit_input *fit, struct points *points)
{
    double a, b, off = 0.0, scale = 0.0;
    if (points->count < (fit->take == FIT_MISFIT ? 3 : 2))
        return NAN;
    for (int i = 0; i < points->count && fit->form == FIT_POWER; i++) {
        points->x[i] = log(points->x[i]); /* NAN and -INFINITY where there is none */
        points->y[i] = log(points->y[i]);
    }
    fit_line(points, &a, &b);
    if (fit->take != FIT_MISFIT)
        return fit->take == FIT_SLOPE ? b : a;
    for (int i = 0; i < points->count; i++) {
        off += square(points->y[i] - a - b * points->x[i]) / points->count;
        scale += fabs(points->y[i]) / points->count;
    }
    return fit->form == FIT_POWER ? sqrt(off) : sqrt(off) / scale;
}

static struct error *evaluate(const struct fit_input *fit, const char *name,
                              const struct verify_case *runs, int count, struct points *points,
                              struct check_result *result)
{
    points->count = 0;
    TRY(take_points(fit, runs, count, points));
    const struct dimension dimension = dimension_of(fit, points->x_dimension, points->y_dimension);
    const double measured = value_of(fit, points);
    *result = (struct check_result){.name = text_copy(name),
                                    .measure = take_name(fit),
                                    .measured = isfinite(measured) ? measured : NAN,
                                    .time = NAN};
    if (!result->name)
        return error_new(ERROR_SYSTEM, "out of memory for fits");
    dimension_text(dimension, result->unit);
    if (points->count > 0)
        TRY(check_find_limits(&fit->check, take_name(fit), dimension, &result->wanted, &result->low,
                              &result->high));
    check_judge(&fit->check, fit->take == FIT_MISFIT, result);
    return NULL;
}

struct error *fits_evaluate(const struct simulation_case *input, const struct verify_case *runs,
                            int count, struct check_results *results)
{
    const size_t places = (size_t)count + 1;
    struct points points = {.x = memory_allocate(places * sizeof(double)),
                            .y = memory_allocate(places * sizeof(double))};
    *results = (struct check_results){0};
    results->item = memory_allocate(((size_t)input->fits.count + 1) * sizeof *results->item);
    struct error *error = points.x && points.y && results->item
                              ? NULL
                              : error_new(ERROR_SYSTEM, "out of memory for fits");
    for (int i = 0; i < input->fits.count && !error; i++) {
        error = evaluate(case_fit(input, i), input->fits.names[i], runs, count, &points,
                         &results->item[i]);
        check_results_count(results);
    }
    free(points.y);
    free(points.x);
    return error;
}
