/* The axes of a fit; see fit_axes.h. */
#include "run/fit_axes.h"

#include <string.h>

const struct sweep_value *fit_swept(const struct sweep_value *values, int count, const char *key)
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

struct dimension fit_dimension(const struct fit_input *fit, struct dimension x, struct dimension y)
{
    if (fit->take == FIT_MISFIT || fit->form == FIT_POWER)
        return (struct dimension){0};
    return fit->take == FIT_SLOPE ? dimension_quotient(y, x) : y;
}

const char *fit_take_name(const struct fit_input *fit)
{
    static const char *const names[] = {
        [FIT_SLOPE] = "slope", [FIT_INTERCEPT] = "intercept", [FIT_MISFIT] = "misfit",
        [FIT_MEAN] = "mean",   [FIT_DEVIATION] = "deviation", [FIT_CONFIDENCE] = "confidence"};
    return names[fit->take];
}

/* The dimensions of `over` and `of`. */
static struct error *find_axes(const struct simulation_case *input, const struct checks *checks,
                               const struct fit_input *fit, struct dimension *x,
                               struct dimension *y)
{
    struct unit unit;
    const struct sweep_value *value = fit_swept(input->sweep, input->sweep_values, fit->over);
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
    return check_find_limits(&fit->check, fit_take_name(fit), fit_dimension(fit, x, y), &wanted,
                             &low, &high);
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
