/* The keys of `expected_warnings`. */
#include "case/internal.h"

/* In the order of enum warning_kind. */
static const char *const warning_names[] = {
    "tension", "speed",  "temperature", "density", "tensile-instability",
    "unlit",   "region", "energy",      "tracer",  "coarse",
    "input",   "load",   NULL};

const struct parameter case_expected_table[] = {
    PARAMETER(CHOICE, struct expected_warning_input, warning, REQUIRED,
              "what is expected: tension above the strength of a material; a speed above three "
              "times what the case can cause; a temperature below 0 K; a density outside the range "
              "of the equation of state; tension for longer than SPH is reliable; an explosive "
              "that is compressed before its detonation arrives; a solid at the edge of the region "
              "of a coupling; a drift of the total energy; a tracer whose particle has failed; "
              "cells too coarse for a plate or a charge; input without effect, or constants that "
              "contradict each other; a load that does not deliver its impulse",
              .names = warning_names),
    PARAMETER(NAMES, struct expected_warning_input, of, OPTIONAL,
              "the materials in which it is expected; default: all"),
    PARAMETER(TEXT, struct expected_warning_input, reason, REQUIRED,
              "why it occurs, and why the checks of the case are valid nevertheless"),
    PARAMETER_END,
};
