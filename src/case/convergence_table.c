/* The keys of a convergence study. */
#include "case/internal.h"

static const struct parameter order_table[] = {
    PARAMETER(NUMBER, struct order_input, at_least, OPTIONAL, "smallest order allowed"),
    PARAMETER(NUMBER, struct order_input, at_most, OPTIONAL, "largest order allowed"),
    PARAMETER(TEXT, struct order_input, source, OPTIONAL, "where the limit comes from"),
    PARAMETER(TEXT, struct order_input, known_deviation, OPTIONAL,
              "why the order is expected to be outside its limits: this does not fail the study; "
              "if it is within them, the study fails, so that the key gets removed"),
    PARAMETER_END,
};

const struct parameter case_convergence_table[] = {
    PARAMETER(TEXT, struct convergence_input, vary, "resolution",
              "what changes from run to run: a name of let or a path"),
    PARAMETER(NAMES, struct convergence_input, values, OPTIONAL,
              "its value in each run, at least two; default: 4, 2 and 1 times the resolution"),
    PARAMETER(NAMES, struct convergence_input, of, OPTIONAL,
              "the checks that are studied; default: all with an error norm or with `is`"),
    PARAMETER(NAMES, struct convergence_input, estimate, OPTIONAL,
              "checks whose `is` is not exact: their errors are estimated from the runs"),
    PARAMETER(MAP, struct convergence_input, order, OPTIONAL,
              "limits of the fitted order, by the name of the check", .table = order_table,
              .size = sizeof(struct order_input)),
    PARAMETER_END,
};
