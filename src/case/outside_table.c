/* The keys of loads. */
#include "case/internal.h"

static const char *const axis_names[] = {"x", "y", "z", NULL};
static const char *const side_names[] = {"low", "high", NULL};

static const char *const charge_names[] = {"free-air", "surface", NULL};

static const struct parameter blast_table[] = {
    {.key = "mass",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct blast_input, mass),
     .unit = "kg",
     .standard = PARAMETER_OPTIONAL,
     .below = INFINITY,
     .help = "mass of the charge, TNT"},
    {.key = "at",
     .kind = PARAMETER_VECTOR,
     .offset = offsetof(struct blast_input, at),
     .unit = "m",
     .standard = PARAMETER_OPTIONAL,
     .help = "position of the charge"},
    {.key = "charge",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct blast_input, charge),
     .standard = "free-air",
     .names = charge_names,
     .help = "free-air: a sphere far from the ground; surface: a hemisphere on the ground"},
    {.key = "time",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct blast_input, time),
     .unit = "s",
     .standard = "0 s",
     .help = "time of the detonation; below zero to begin shortly before the blast arrives"},
    PARAMETER_END,
};

const struct parameter case_load_table[] = {
    {.key = "on",
     .kind = PARAMETER_TEXT,
     .offset = offsetof(struct load_input, on),
     .standard = PARAMETER_REQUIRED,
     .help = "the body"},
    {.key = "pressure",
     .kind = PARAMETER_FIELD,
     .offset = offsetof(struct load_input, pressure),
     .arguments = ARGUMENT_TIME,
     .unit = "Pa",
     .standard = PARAMETER_OPTIONAL,
     .help =
         "pressure on its surface, a number or an expression of the time; give this, a traction or "
         "a blast"},
    {.key = "blast",
     .kind = PARAMETER_TABLE,
     .offset = offsetof(struct load_input, blast),
     .standard = PARAMETER_OPTIONAL,
     .table = blast_table,
     .help =
         "overpressure by the curves of Kingery and Bulmash on the surface that faces a charge, "
         "in the positive phase; it follows the body. `between` and `side` leave out what is "
         "elsewhere, or faces elsewhere, at the start"},
    {.key = "traction",
     .kind = PARAMETER_FIELDS,
     .offset = offsetof(struct load_input, traction),
     .arguments = ARGUMENT_TIME,
     .unit = "Pa",
     .standard = PARAMETER_OPTIONAL,
     .help = "force per area on the surface that faces `side` along `axis`, one value per "
             "dimension, numbers or expressions of the time"},
    {.key = "axis",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct load_input, axis),
     .standard = "x",
     .names = axis_names,
     .help = "the axis of `between` and `side`"},
    {.key = "side",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct load_input, side),
     .standard = PARAMETER_OPTIONAL,
     .names = side_names,
     .help = "which way the surface faces: to the low or the high end of the axis; default: high "
             "for a traction, any for a blast"},
    {.key = "between",
     .kind = PARAMETER_VECTOR,
     .offset = offsetof(struct load_input, between),
     .unit = "m",
     .standard = PARAMETER_OPTIONAL,
     .help = "two positions on the axis that bound the surface: of a blast at the start, else at "
             "any time; default: all of it"},
    {.key = "after",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct load_input, after),
     .unit = "s",
     .standard = "0 s",
     .below = INFINITY,
     .closed = true,
     .help = "time at which the load starts"},
    {.key = "before",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct load_input, before),
     .unit = "s",
     .standard = PARAMETER_OPTIONAL,
     .below = INFINITY,
     .help = "time at which the load ends; default: the end of the run"},
    PARAMETER_END,
};
