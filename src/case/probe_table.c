/* The keys of what is watched while a case runs: probes, profiles and histograms. */
#include "case/internal.h"

static const char *const by_names[] = {"nothing", "material", "body", NULL};

const struct parameter case_probe_table[] = {
    {.kind = PARAMETER_ONE_OF,
     .offset = offsetof(struct probe_input, probe),
     .standard = REQUIRED,
     .kind_of_thing = "probe",
     .help = "what is recorded"},
    PARAMETER(TEXT, struct probe_input, of, OPTIONAL,
              "of a tracer, gauge or front: the body whose particles count; default: all"),
    PARAMETER(NAMES, struct probe_input, fields, OPTIONAL,
              "of a tracer or gauge: fields, or components of them; default: all"),
    PARAMETER(CHOICE, struct probe_input, axis, OPTIONAL,
              "of a front: the axis along which it is located; default: x",
              .names = parameter_axes),
    PARAMETER(VECTOR, struct probe_input, between, OPTIONAL,
              "of a front: two positions on the axis between which it is located", .unit = "m"),
    PARAMETER(NUMBER, struct probe_input, every, OPTIONAL, "time between rows; default: every step",
              .unit = "s", .below = INFINITY, .change = CHANGE_FREELY),
    PARAMETER_END,
};

const struct parameter case_profile_table[] = {
    PARAMETER(NAMES, struct profile_input, fields, REQUIRED, "fields, or components of them"),
    PARAMETER(CHOICE, struct profile_input, along, "x", "the axis along which the bins lie",
              .names = parameter_axes),
    PARAMETER(INTEGER, struct profile_input, bins, "100",
              "number of bins of equal width, if there is no `width`", .above = 1,
              .below = PROFILE_BINS, .closed = true),
    PARAMETER(
        NUMBER, struct profile_input, width, OPTIONAL,
        "width of a bin; bins then start at multiples of it, or at the first position of `between`",
        .unit = "m", .below = INFINITY),
    PARAMETER(TEXT, struct profile_input, of, OPTIONAL,
              "the body whose particles count; default: all"),
    PARAMETER(VECTOR, struct profile_input, between, OPTIONAL,
              "two positions between which the bins lie; default: the extent of all particles",
              .unit = "m"),
    PARAMETER(CHOICE, struct profile_input, by, "nothing",
              "whether each material or body has a profile of its own", .names = by_names),
    PARAMETER_END,
};

const char *const weight_names[] = {"number", "mass", "volume", NULL};

static const struct parameter histogram_range_table[] = {
    PARAMETER(QUANTITY, struct histogram_range, low, OPTIONAL,
              "lower end of the first bin; default: the least value"),
    PARAMETER(QUANTITY, struct histogram_range, high, OPTIONAL,
              "upper end of the last bin; default: the largest value"),
    PARAMETER_END,
};

const struct parameter case_histogram_table[] = {
    PARAMETER(TEXT, struct histogram_input, field, REQUIRED,
              "a field, or one component of it: speed, velocity.x"),
    PARAMETER(NAMES, struct histogram_input, of, OPTIONAL,
              "the bodies whose particles count; default: all"),
    PARAMETER(INTEGER, struct histogram_input, bins, "50", "number of bins", .above = 1,
              .below = PROFILE_BINS, .closed = true),
    PARAMETER(TABLE, struct histogram_input, range, OPTIONAL,
              "where the bins begin and end; values outside count in the total alone",
              .table = histogram_range_table),
    PARAMETER(FLAG, struct histogram_input, log, "no",
              "whether each bin is wider than the one before by the same ratio"),
    PARAMETER(CHOICE, struct histogram_input, weight, "mass",
              "what each particle or cell counts by", .names = weight_names),
    PARAMETER_END,
};
