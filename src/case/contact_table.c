/* The keys of a contact between two bodies. */
#include "case/internal.h"

static const char *const shear_names[] = {"stick", "slip", NULL};
static const char *const tension_names[] = {"carried", "none", NULL};
static const char *const touch_names[] = {"nodes", "surfaces", NULL};
static const char *const normal_names[] = {"mean", "first", "second", NULL};

const struct parameter case_contact_table[] = {
    PARAMETER(NAMES, struct contact_input, between, REQUIRED, "two bodies"),
    PARAMETER(CHOICE, struct contact_input, shear, "stick", "whether they stick together or slip",
              .names = shear_names),
    PARAMETER(CHOICE, struct contact_input, tension, "carried",
              "carried: the contact carries tension; none: it opens", .names = tension_names),
    PARAMETER(NUMBER, struct contact_input, friction, "0",
              "coefficient of friction where they slip (solver mpm)", .above = 0.0,
              .below = INFINITY, .closed = true),
    PARAMETER(CHOICE, struct contact_input, normal, "mean",
              "whose surface gives the contact normal: that of the first body (the stiffer or the "
              "convex one), of the second, or the mean of both (solver mpm)",
              .names = normal_names),
    PARAMETER(CHOICE, struct contact_input, touch, OPTIONAL,
              "where contact begins; surfaces: where surfaces touch, for bodies that may separate; "
              "nodes: where bodies share nodes, a cell before they touch (solver mpm); default: "
              "surfaces with `tension: none`, else nodes",
              .names = touch_names),
    PARAMETER_END,
};
