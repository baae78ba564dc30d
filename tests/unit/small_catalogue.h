/* A catalogue for tests of cases. It is small and stays as it is, so that new shapes and measures
 * leave the messages that list them alone. */
#ifndef BOLIDE_TESTS_SMALL_CATALOGUE_H
#define BOLIDE_TESTS_SMALL_CATALOGUE_H

#include "case/case.h"
#include "material/choices.h"
#include "shape/lattice.h"

struct box {
    struct vector_value from, to;
};
static const struct parameter box_table[] = {
    {.key = "from", .kind = PARAMETER_VECTOR, .offset = offsetof(struct box, from), .unit = "m"},
    {.key = "to", .kind = PARAMETER_VECTOR, .offset = offsetof(struct box, to), .unit = "m"},
    PARAMETER_END,
};
static const char *box_wrong(const void *shape, int dimension)
{
    const struct box *box = shape;
    return box->from.count == dimension && box->to.count == dimension
               ? NULL
               : "a corner of the box lacks components or has too many";
}
static struct bounds unit_bounds(const void *shape)
{
    (void)shape;
    return (struct bounds){vec3_make(0.0, 0.0, 0.0), vec3_make(1.0, 1.0, 1.0)};
}
static const struct shape_class box_class = {.bounds = unit_bounds, .wrong = box_wrong};

struct ball {
    double radius;
};
static const struct parameter ball_table[] = {
    {.key = "radius", .kind = PARAMETER_NUMBER, .offset = 0, .unit = "m", .below = INFINITY},
    PARAMETER_END,
};
static const char *ball_wrong(const void *shape, int dimension)
{
    (void)shape;
    (void)dimension;
    return NULL;
}
static const struct shape_class ball_class = {.bounds = unit_bounds, .wrong = ball_wrong};

struct unite {
    struct one_of_list shapes;
};
static const struct parameter unite_table[] = {
    {.key = "shapes", .kind = PARAMETER_LIST, .offset = 0, .kind_of_thing = "shape"},
    PARAMETER_END,
};

static const struct choice shapes[] = {
    {"box", "a box", box_table, sizeof(struct box), &box_class},
    {"ball", "a ball", ball_table, sizeof(struct ball), &ball_class},
    {"union", "several shapes", unite_table, sizeof(struct unite), &ball_class},
};

struct sph {
    int contact;
    double smoothing;
};
static const char *const contact_names[] = {"acoustic", "standard", NULL};
static const struct parameter sph_table[] = {
    {.key = "contact",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph, contact),
     .standard = "acoustic",
     .names = contact_names},
    {.key = "smoothing",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph, smoothing),
     .standard = "1.2",
     .above = 1.0,
     .below = 2.0,
     .closed = true},
    PARAMETER_END,
};
static const struct choice solvers[] = {
    {"sph", "particles", sph_table, sizeof(struct sph), NULL},
    {"mpm", "points and a grid", NULL, 0, NULL},
};

struct mean {
    char *field;
};
static const struct parameter mean_table[] = {
    {.key = "field", .kind = PARAMETER_TEXT, .offset = 0},
    PARAMETER_END,
};
static const struct choice measures[] = {
    {"mean", "the mean of a field", mean_table, sizeof(struct mean), NULL},
    {"conserved", "a total", mean_table, sizeof(struct mean), NULL},
};

static const struct parameter tracer_table[] = {
    {.key = "at", .kind = PARAMETER_VECTOR, .offset = 0, .unit = "m"},
    PARAMETER_END,
};
static const struct choice probes[] = {
    {"tracer", "a particle", tracer_table, sizeof(struct vector_value), NULL},
    {"body", "a body", mean_table, sizeof(struct mean), NULL},
};

static const struct choice exact[] = {{"impact", "two plates", NULL, 0, NULL}};

static const struct choice_list lists[] = {
    {"eos", "equations of state", eos_choices, EOS_KINDS},
    {"strength", "strength models", strength_choices, STRENGTH_KINDS},
    {"failure", "failure models", failure_choices, FAILURE_KINDS},
    {"burn", "burn models", burn_choices, BURN_KINDS},
    {"shape", "shapes", shapes, COUNT_OF(shapes)},
    {"lattice", "lattices", lattice_choices, LATTICE_KINDS},
    {"solver", "solvers", solvers, COUNT_OF(solvers)},
    {"probe", "probes", probes, COUNT_OF(probes)},
    {"measure", "measures", measures, COUNT_OF(measures)},
    {"exact", "exact solutions", exact, COUNT_OF(exact)},
    {0},
};
static const struct catalogue small_catalogue = {lists};

#endif
