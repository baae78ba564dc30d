/* The keys of output.pictures.NAME; picture/ draws what they say. */
#include "case/internal.h"

static const char *const views[] = {
    [VIEW_SECTION] = "section", [VIEW_PERSPECTIVE] = "perspective", NULL};

static const char *const palettes[] = {[PALETTE_SEQUENTIAL] = "sequential",
                                       [PALETTE_DIVERGING] = "diverging",
                                       [PALETTE_CATEGORIES] = "categories",
                                       [PALETTE_GREY] = "grey",
                                       NULL};

static const char *const directions[] = {"x", "y", "z", "-x", "-y", "-z", NULL};

static const struct parameter plane_table[] = {
    PARAMETER_AS("x", NUMBER, struct picture_plane, at[0], OPTIONAL, "a plane of constant x",
                 .unit = "m"),
    PARAMETER_AS("y", NUMBER, struct picture_plane, at[1], OPTIONAL, "a plane of constant y",
                 .unit = "m"),
    PARAMETER_AS("z", NUMBER, struct picture_plane, at[2], OPTIONAL, "a plane of constant z",
                 .unit = "m"),
    PARAMETER_END,
};

static const struct parameter window_table[] = {
    PARAMETER(VECTOR, struct picture_window, from, OPTIONAL, "corner with the low coordinates",
              .unit = "m"),
    PARAMETER(VECTOR, struct picture_window, to, OPTIONAL, "corner with the high coordinates",
              .unit = "m"),
    PARAMETER_END,
};

static const struct parameter range_table[] = {
    PARAMETER(QUANTITY, struct picture_range, low, OPTIONAL, "value of the first colour"),
    PARAMETER(QUANTITY, struct picture_range, high, OPTIONAL, "value of the last colour"),
    PARAMETER(VECTOR, struct picture_range, percentiles, "[0.5, 99.5]",
              "percentiles, by mass, of each body and frame that the colours contain", .above = 0.0,
              .below = 100.0, .closed = true),
    PARAMETER_END,
};

static const struct parameter schlieren_table[] = {
    PARAMETER(TEXT, struct picture_schlieren, field, "density",
              "the field whose gradient is drawn"),
    PARAMETER(NUMBER, struct picture_schlieren, strength, "15",
              "darkness of the steepest gradients", .below = INFINITY),
    PARAMETER_END,
};

const struct parameter case_picture_table[] = {
    PARAMETER(NAMES, struct picture_input, field, OPTIONAL,
              "a field, a component (`velocity.x`), body, material, fragment or schlieren; several "
              "are drawn side by side. Default: the name of the picture"),
    PARAMETER(CHOICE, struct picture_input, view, OPTIONAL,
              "default: section in 2-D, perspective in 3-D", .names = views),
    PARAMETER(VECTOR, struct picture_input, direction, "[30, 25]",
              "azimuth and elevation of the eye, degrees", .above = -360.0, .below = 360.0,
              .closed = true),
    PARAMETER(CHOICE, struct picture_input, up, OPTIONAL,
              "the direction that points up on the page; default: against the velocity of the "
              "fastest body at the start, else z",
              .names = directions),
    PARAMETER(FLAG, struct picture_input, parallel, "no",
              "whether the perspective is a parallel projection"),
    PARAMETER(TABLE, struct picture_input, plane, OPTIONAL,
              "the plane of a section in 3-D; default: a plane of symmetry, else through the "
              "centre of the fastest body at the start",
              .table = plane_table),
    PARAMETER(NUMBER, struct picture_input, slab, OPTIONAL,
              "thickness of what a section in 3-D shows; default: the particles that the plane "
              "cuts",
              .unit = "m", .below = INFINITY),
    PARAMETER(NAMES, struct picture_input, cut, OPTIONAL,
              "sides that a perspective removes, what is on all of them: [+x, -y]; none: nothing. "
              "Default: what faces the viewer between planes of symmetry"),
    PARAMETER(TABLE, struct picture_input, window, OPTIONAL,
              "what of space is drawn; default: the bodies at the start and 99 % of the mass of "
              "each at the end",
              .table = window_table),
    PARAMETER(TABLE, struct picture_input, range, OPTIONAL, "the values that the colours span",
              .table = range_table),
    PARAMETER(FLAG, struct picture_input, log, "no", "whether colours are logarithmic"),
    PARAMETER(CHOICE, struct picture_input, palette, OPTIONAL,
              "the colours; default: those that suit the field", .names = palettes),
    PARAMETER(NAMES, struct picture_input, bodies, OPTIONAL, "the bodies that are drawn"),
    PARAMETER(NAMES, struct picture_input, without, OPTIONAL, "bodies that are not drawn"),
    PARAMETER(FLAG, struct picture_input, mirror, "yes",
              "whether axisymmetric cases, and cases with planes of symmetry, are drawn whole"),
    PARAMETER(NUMBER, struct picture_input, dot, "1.6",
              "smallest diameter of a particle on the page, in points", .below = 100.0),
    PARAMETER(FLAG, struct picture_input, outlines, "yes",
              "whether bodies and free surfaces have outlines"),
    PARAMETER(TABLE, struct picture_input, schlieren, OPTIONAL,
              "how the field `schlieren` is drawn", .table = schlieren_table),
    PARAMETER_END,
};
