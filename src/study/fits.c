/* Fits through the runs of a sweep; see fits.h. */
#include "study/fits.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "run/fit_axes.h"
#include "study/statistics.h"

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
        const struct sweep_value *value = fit_swept(runs[i].sweep, runs[i].sweep_values, fit->over);
        if (!y || (!value && !other))
            continue;
        TRY(unit_parse(y->unit, &unit));
        points->y_dimension = unit.dimension;
        if (!value)
            TRY(unit_parse(other->unit, &unit));
        points->x_dimension = value ? value->quantity.dimension : unit.dimension;
        const double x = value ? value->quantity.value : other->measured;
        if (isnan(x) || isnan(y->measured) || x < fit->from.value || x > fit->to.value)
            continue; /* an infinite value spoils the fit */
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
    if (fit->take >= FIT_MEAN) {
        const struct statistic statistic = statistic_of(points->y, points->count);
        return fit->take == FIT_MEAN        ? statistic.mean
               : fit->take == FIT_DEVIATION ? statistic.deviation
                                            : statistic.confidence;
    }
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
    const struct dimension dimension = fit_dimension(fit, points->x_dimension, points->y_dimension);
    const double measured = value_of(fit, points);
    *result = (struct check_result){.name = text_copy(name),
                                    .measure = fit_take_name(fit),
                                    .measured = isfinite(measured) ? measured : NAN,
                                    .time = NAN};
    if (!result->name)
        return out_of_memory_for("fits");
    dimension_text(dimension, result->unit);
    if (points->count > 0)
        TRY(check_find_limits(&fit->check, fit_take_name(fit), dimension, &result->wanted,
                              &result->low, &result->high));
    check_judge(&fit->check, fit->take == FIT_MISFIT, result);
    if (isnan(result->measured))
        result->nothing = text_format("no finite value follows from the %d runs that measured "
                                      "both values within the bounds",
                                      points->count);
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
    struct error *error = points.x && points.y && results->item ? NULL : out_of_memory_for("fits");
    for (int i = 0; i < input->fits.count && !error; i++) {
        error = evaluate(case_fit(input, i), input->fits.names[i], runs, count, &points,
                         &results->item[i]);
        check_results_count(results);
    }
    free(points.y);
    free(points.x);
    return error;
}
