/* The keys of loads. */
#include "case/internal.h"

static const char *const charge_names[] = {"free-air", "surface", NULL};

static const struct parameter blast_table[] = {
    PARAMETER(NUMBER, struct blast_input, mass, OPTIONAL, "mass of the charge, TNT", .unit = "kg",
              .below = INFINITY),
    PARAMETER(VECTOR, struct blast_input, at, OPTIONAL, "position of the charge", .unit = "m"),
    PARAMETER(CHOICE, struct blast_input, charge, "free-air",
              "free-air: a sphere far from the ground; surface: a hemisphere on the ground",
              .names = charge_names),
    PARAMETER(NUMBER, struct blast_input, time, "0 s",
              "time of the detonation; below zero to begin shortly before the blast arrives",
              .unit = "s"),
    PARAMETER_END,
};

static const struct parameter record_table[] = {
    PARAMETER(TEXT, struct record_input, from, OPTIONAL,
              "a case of the solver gas, or the folder of one, from this file's folder; it is "
              "computed before this run begins",
              .is_path = true),
    PARAMETER(TEXT, struct record_input, probe, OPTIONAL,
              "a probe `line` of that case, with the pressure on the target, which is rigid there"),
    PARAMETER(VECTOR, struct record_input, center, OPTIONAL,
              "where the first point of the line lies here; default: the origin. The pressure at a "
              "place is that at its distance from the line along `axis` through this point",
              .unit = "m"),
    PARAMETER(NUMBER, struct record_input, time, "0 s",
              "time of this run at which that case begins", .unit = "s"),
    PARAMETER(NUMBER, struct record_input, ambient, OPTIONAL,
              "what is subtracted from the pressure, as it acts on the other side too; default: "
              "the pressure of each point at the start",
              .unit = "Pa"),
    PARAMETER_END,
};

const struct parameter case_load_table[] = {
    PARAMETER(TEXT, struct load_input, on, REQUIRED, "the body"),
    PARAMETER(FIELD, struct load_input, pressure, OPTIONAL,
              "pressure on its surface, a number or an expression of the time; give this, a "
              "traction, a blast or a record",
              .arguments = ARGUMENT_TIME, .unit = "Pa"),
    PARAMETER(TABLE, struct load_input, blast, OPTIONAL,
              "overpressure by the curves of Kingery and Bulmash on the surface that faces a "
              "charge, in the positive phase; it follows the body. `between` and `side` leave out "
              "what is elsewhere, or faces elsewhere, at the start",
              .table = blast_table),
    PARAMETER(TABLE, struct load_input, record, OPTIONAL,
              "the pressure over place and time that another case records, on the surface that "
              "faces `side` along `axis` at the start; it follows the body",
              .table = record_table),
    PARAMETER(FIELDS, struct load_input, traction, OPTIONAL,
              "force per area on the surface that faces `side` along `axis`, one value per "
              "dimension, numbers or expressions of the time",
              .arguments = ARGUMENT_TIME, .unit = "Pa"),
    PARAMETER(CHOICE, struct load_input, axis, "x", "the axis of `between` and `side`",
              .names = parameter_axes),
    PARAMETER(CHOICE, struct load_input, side, OPTIONAL,
              "which way the surface faces: to the low or the high end of the axis; default: high "
              "for a traction, any for a blast",
              .names = parameter_sides),
    PARAMETER(VECTOR, struct load_input, between, OPTIONAL,
              "two positions on the axis that bound the surface: of a blast or a record at the "
              "start, else at any time; default: all of it",
              .unit = "m"),
    PARAMETER(NUMBER, struct load_input, after, "0 s", "time at which the load starts", .unit = "s",
              .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct load_input, before, OPTIONAL,
              "time at which the load ends; default: the end of the run", .unit = "s",
              .below = INFINITY),
    PARAMETER_END,
};
