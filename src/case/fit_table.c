/* The keys of a fit through the runs of a sweep. */
#include "case/internal.h"

static const char *const form_names[] = {"line", "power", NULL};
static const char *const take_names[] = {"slope",     "intercept",  "misfit", "mean",
                                         "deviation", "confidence", NULL};

const struct parameter case_fit_table[] = {
    {.key = "of",
     .kind = PARAMETER_TEXT,
     .offset = offsetof(struct fit_input, of),
     .standard = PARAMETER_REQUIRED,
     .help = "the check whose measured values are fitted"},
    {.key = "over",
     .kind = PARAMETER_TEXT,
     .offset = offsetof(struct fit_input, over),
     .standard = PARAMETER_REQUIRED,
     .help = "a key of the sweep, or another check"},
    {.key = "form",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct fit_input, form),
     .standard = "line",
     .names = form_names,
     .help =
         "line: y = a + b x by least squares; power: y = a x^b, by least squares of logarithms"},
    {.key = "take",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct fit_input, take),
     .standard = PARAMETER_REQUIRED,
     .names = take_names,
     .help = "slope: b; intercept: a of a line; misfit: root mean square of the residuals over the "
             "mean absolute value of y (power: of the logarithms); mean, deviation: those of y; "
             "confidence: half the width of the 95 % confidence interval of the mean"},
    {.key = "from",
     .kind = PARAMETER_QUANTITY,
     .offset = offsetof(struct fit_input, from),
     .standard = PARAMETER_OPTIONAL,
     .help = "runs with a smaller value of `over` do not count"},
    {.key = "to",
     .kind = PARAMETER_QUANTITY,
     .offset = offsetof(struct fit_input, to),
     .standard = PARAMETER_OPTIONAL,
     .help = "runs with a larger value of `over` do not count"},
    CASE_LIMITS(struct fit_input, check.),
    PARAMETER_END,
};
