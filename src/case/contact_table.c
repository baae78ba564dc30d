/* The keys of a contact between two bodies. */
#include "case/internal.h"

static const char *const shear_names[] = {"stick", "slip", NULL};
static const char *const tension_names[] = {"carried", "none", NULL};
static const char *const touch_names[] = {"nodes", "surfaces", NULL};
static const char *const normal_names[] = {"mean", "first", "second", NULL};

const struct parameter case_contact_table[] = {
    {.key = "between",
     .kind = PARAMETER_NAMES,
     .offset = offsetof(struct contact_input, between),
     .standard = PARAMETER_REQUIRED,
     .help = "two bodies"},
    {.key = "shear",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct contact_input, shear),
     .standard = "stick",
     .names = shear_names,
     .help = "whether they stick together or slip"},
    {.key = "tension",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct contact_input, tension),
     .standard = "carried",
     .names = tension_names,
     .help = "carried: the contact carries tension; none: it opens"},
    {.key = "friction",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct contact_input, friction),
     .standard = "0",
     .above = 0.0,
     .below = INFINITY,
     .closed = true,
     .help = "coefficient of friction where they slip (solver mpm)"},
    {.key = "normal",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct contact_input, normal),
     .standard = "mean",
     .names = normal_names,
     .help = "whose surface gives the contact normal: that of the first body (the stiffer or the "
             "convex one), of the second, or the mean of both (solver mpm)"},
    {.key = "touch",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct contact_input, touch),
     .standard = "nodes",
     .names = touch_names,
     .help = "where contact begins for bodies that may separate; nodes: where they share nodes, a "
             "cell before they touch; surfaces: where their surfaces touch (solver mpm)"},
    PARAMETER_END,
};
