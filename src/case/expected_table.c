/* The keys of `expected_warnings`. */
#include "case/internal.h"

/* In the order of enum warning_kind. */
static const char *const warning_names[] = {
    "tension", "speed", "temperature", "density", "tensile-instability", "energy", NULL};

const struct parameter case_expected_table[] = {
    {.key = "warning",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct expected_warning_input, warning),
     .standard = PARAMETER_REQUIRED,
     .names = warning_names,
     .help = "what is expected: tension beyond the strength of a material; a speed above three "
             "times that which set the case in motion; a temperature below 0 K; a density outside "
             "the range of the equation of state; tension that lasts longer than SPH holds a "
             "body; energy that is not conserved"},
    {.key = "of",
     .kind = PARAMETER_NAMES,
     .offset = offsetof(struct expected_warning_input, of),
     .standard = PARAMETER_OPTIONAL,
     .help = "the materials in which it is expected; default: all"},
    {.key = "reason",
     .kind = PARAMETER_TEXT,
     .offset = offsetof(struct expected_warning_input, reason),
     .standard = PARAMETER_REQUIRED,
     .help = "why it occurs, and why the checks of the case are valid nevertheless"},
    PARAMETER_END,
};
