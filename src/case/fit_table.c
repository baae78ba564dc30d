/* The keys of a fit through the runs of a sweep. */
#include "case/internal.h"

static const char *const form_names[] = {"line", "power", NULL};
static const char *const take_names[] = {"slope",     "intercept",  "misfit", "mean",
                                         "deviation", "confidence", NULL};

const struct parameter case_fit_table[] = {
    PARAMETER(TEXT, struct fit_input, of, REQUIRED, "the check whose measured values are fitted"),
    PARAMETER(TEXT, struct fit_input, over, REQUIRED, "a key of the sweep, or another check"),
    PARAMETER(
        CHOICE, struct fit_input, form, "line",
        "line: y = a + b x by least squares; power: y = a x^b, by least squares of logarithms",
        .names = form_names),
    PARAMETER(CHOICE, struct fit_input, take, REQUIRED,
              "slope: b; intercept: a of a line; misfit: root mean square of the residuals over "
              "the mean absolute value of y (power: of the logarithms); mean, deviation: those of "
              "y; confidence: half the width of the 95 % confidence interval of the mean",
              .names = take_names),
    PARAMETER(QUANTITY, struct fit_input, from, OPTIONAL,
              "runs with a smaller value of `over` do not count"),
    PARAMETER(QUANTITY, struct fit_input, to, OPTIONAL,
              "runs with a larger value of `over` do not count"),
    CASE_LIMITS(struct fit_input, check.),
    PARAMETER_END,
};
