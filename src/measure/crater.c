/* crater: depth, diameter or volume of what is missing below the original face of a body, about an
 * axis. The plane of the face is divided into columns; the surface in a column is the outermost
 * edge of the particles within 3/4 of their diameter, so that no gap between neighbours is taken
 * for a crater. The crater is the connected set of columns about the axis that are deeper than half
 * a particle. The reach of the particles brings its rim a quarter of a particle too near to the
 * axis: diameter and volume are corrected for it. */
#include "measure/broken_axis.h"

#include <stdlib.h>

#include "base/memory.h"

enum { TAKE_DEPTH, TAKE_DIAMETER, TAKE_VOLUME };
static const char *const take_names[] = {"depth", "diameter", "volume", NULL};

const struct parameter measure_crater_table[] = {
    PARAMETER(CHOICE, struct measure_crater, along, REQUIRED, "the axis normal to the face",
              .names = parameter_axes),
    PARAMETER(CHOICE, struct measure_crater, side, REQUIRED,
              "the end of the axis at which the face is: low or high", .names = parameter_sides),
    PARAMETER(CHOICE, struct measure_crater, take, "depth",
              "depth, diameter or volume below the original face; in a plane, volume is an area",
              .names = take_names),
    PARAMETER(VECTOR, struct measure_crater, center, OPTIONAL,
              "a point on the axis; default: the origin", .unit = "m"),
    CONNECTED_LINK(offsetof(struct measure_crater, link)),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_crater *parameters = measurement->check->measure.value;
    struct broken_axis axis;
    TRY(broken_find_axis(measurement, parameters->along, &parameters->center, &axis));
    const bool plane = axis.count == 1 && !axis.round;
    *unit = parameters->take != TAKE_VOLUME ? "m" : plane ? "m^2" : "m^3";
    return NULL;
}

/* In particle diameters: the width of a column (at least), how far a particle reaches over columns,
 * and how far that is beyond its edge. */
#define COLUMN_WIDTH 0.125
#define COLUMN_REACH 0.75
#define COLUMN_EXCESS (COLUMN_REACH - 0.5)
enum { COLUMNS_MOST = 1 << 22 };

/* The columns, count[0] by count[1]; surface: above (+) or below the face, -INFINITY: no
 * material. */
struct columns {
    struct broken_axis axis;
    double width, low[2], high[2];
    int64_t count[2];
    double *surface;
};

/* Collective: the range of the plate on the axes across. */
static void find_range(const struct measurement *m, const struct broken_plate *plate,
                       const struct broken_axis *axis, double low[2], double high[2])
{
    const struct population *p = m->population;
    double far[4] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY}, across[2];
    for (int32_t i = 0; i < p->count; i++)
        for (int image = 0; image < BROKEN_IMAGES && plate->is_part[i]; image++) {
            if (!broken_image(axis, p->position[i], image, across))
                continue;
            for (int k = 0; k < 2; k++) {
                far[k] = maximum(far[k], across[k]);
                far[2 + k] = maximum(far[2 + k], -across[k]);
            }
        }
    ranks_maximum_of(m->simulation->ranks, far, 4);
    for (int k = 0; k < 2; k++) {
        low[k] = -far[2 + k];
        high[k] = far[k];
    }
    if (axis->round)
        low[0] = 0.0;
}

static struct error *make_columns(const struct measurement *m, const struct broken_plate *plate,
                                  struct columns *columns)
{
    const double *low = columns->low, *high = columns->high;
    double number;
    find_range(m, plate, &columns->axis, columns->low, columns->high);
    columns->width = COLUMN_WIDTH * m->simulation->problem->input->resolution;
    while (number = (1.0 + (high[0] - low[0]) / columns->width) *
                    (1.0 + (high[1] - low[1]) / columns->width),
           number > COLUMNS_MOST)
        columns->width *= 2.0;
    for (int k = 0; k < 2; k++)
        columns->count[k] = 1 + (int64_t)((high[k] - low[k]) / columns->width);
    const int64_t all = columns->count[0] * columns->count[1];
    columns->surface = memory_allocate((size_t)all * sizeof *columns->surface);
    if (!columns->surface)
        return out_of_memory_for("a check of a crater");
    for (int64_t c = 0; c < all; c++)
        columns->surface[c] = -INFINITY;
    return NULL;
}

/* The column of axis K in which the place AT is, within the range. */
static int64_t column_at(const struct columns *columns, int k, double at)
{
    const double column = floor((at - columns->low[k]) / columns->width);
    return (int64_t)minimum(maximum(column, 0.0), (double)(columns->count[k] - 1));
}

static double middle_of(const struct columns *columns, int k, int64_t column)
{
    return columns->low[k] + ((double)column + 0.5) * columns->width;
}

/* A particle at ACROSS with its top at HEIGHT covers the columns within REACH. */
static void cover(struct columns *columns, const double across[2], double reach, double height)
{
    int64_t first[2], last[2];
    for (int k = 0; k < 2; k++) {
        first[k] = column_at(columns, k, across[k] - reach);
        last[k] = column_at(columns, k, across[k] + reach);
    }
    for (int64_t j = first[1]; j <= last[1]; j++)
        for (int64_t i = first[0]; i <= last[0]; i++) {
            const double x = middle_of(columns, 0, i) - across[0];
            const double y = columns->axis.count > 1 ? middle_of(columns, 1, j) - across[1] : 0.0;
            double *surface = &columns->surface[j * columns->count[0] + i];
            if (x * x + y * y <= reach * reach)
                *surface = maximum(*surface, height);
        }
}

/* Collective: the surface of the plate. */
static void find_surface(const struct measurement *m, const struct broken_plate *plate,
                         struct columns *columns)
{
    const struct measure_crater *parameters = m->check->measure.value;
    const struct population *p = m->population;
    const double face = broken_face(m, parameters->along, parameters->side);
    double across[2];
    for (int32_t i = 0; i < p->count; i++) {
        if (!plate->is_part[i])
            continue;
        const double at = p->position[i][parameters->along] - face;
        const double height = (parameters->side ? at : -at) + 0.5 * plate->diameter[i];
        for (int image = 0; image < BROKEN_IMAGES; image++)
            if (broken_image(&columns->axis, p->position[i], image, across))
                cover(columns, across, COLUMN_REACH * plate->diameter[i], height);
    }
    ranks_maximum_of(m->simulation->ranks, columns->surface,
                     (int)(columns->count[0] * columns->count[1]));
}

/* The sums over the columns of a crater. */
struct crater {
    double depth, area, volume;
    bool open; /* it reaches through the body or to its edge */
};

static double area_of(const struct columns *columns, int64_t column)
{
    const double width = columns->width;
    if (columns->axis.round)
        return 2.0 * M_PI * middle_of(columns, 0, column) * width;
    return columns->axis.count > 1 ? width * width : width;
}

/* Adds column AT, marks it as done, and puts its neighbours on the stack. */
static void take_column(struct columns *columns, int64_t at, struct crater *crater, int64_t *stack,
                        int64_t *waiting)
{
    const int64_t i = at % columns->count[0], j = at / columns->count[0];
    const double depth = -columns->surface[at], area = area_of(columns, i);
    const int64_t neighbour[4][2] = {{i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}};
    crater->depth = maximum(crater->depth, depth);
    crater->area += area;
    crater->volume += area * depth;
    columns->surface[at] = NAN;
    for (int k = 0; k < 2 * columns->axis.count; k++) {
        const int64_t x = neighbour[k][0], y = neighbour[k][1];
        const bool outside = x < 0 || y < 0 || x >= columns->count[0] || y >= columns->count[1];
        if (outside)
            crater->open |= !(columns->axis.round && x < 0);
        else
            stack[(*waiting)++] = y * columns->count[0] + x;
    }
}

/* Whether the plate is beside the axis, farther than REACH from it. */
static bool misses(const struct columns *columns, double reach)
{
    bool is_beside = false;
    for (int k = 0; k < columns->axis.count; k++)
        is_beside |= columns->low[k] > reach || columns->high[k] < -reach;
    return is_beside;
}

/* Walks the columns deeper than LEAST from the axis on. */
static struct error *walk(struct columns *columns, double least, struct crater *crater)
{
    const int64_t all = columns->count[0] * columns->count[1];
    int64_t *stack = memory_allocate((4 * (size_t)all + 1) * sizeof *stack), waiting = 0;
    if (!stack)
        return out_of_memory_for("a check of a crater");
    crater->open = misses(columns, 2.0 * least);
    stack[waiting++] = column_at(columns, 1, 0.0) * columns->count[0] + column_at(columns, 0, 0.0);
    while (waiting > 0 && !crater->open) {
        const int64_t at = stack[--waiting];
        if (isinf(columns->surface[at]))
            crater->open = true;
        else if (-columns->surface[at] > least) /* false of one that is done */
            take_column(columns, at, crater, stack, &waiting);
    }
    free(stack);
    return NULL;
}

/* The value that TAKE names; the crater is wider by EXCESS all round than its columns. */
static double value_of(const struct columns *columns, const struct crater *crater, double excess,
                       int take)
{
    const bool plane = columns->axis.count == 1 && !columns->axis.round;
    const double across = plane ? crater->area : 2.0 * sqrt(crater->area / M_PI);
    const double wide = across + 2.0 * excess, scale = wide / across;
    if (crater->area == 0.0)
        return 0.0;
    return take == TAKE_DEPTH      ? crater->depth
           : take == TAKE_DIAMETER ? wide
                                   : crater->volume * (plane ? scale : scale * scale);
}

static struct error *find_crater(const struct measurement *m, const struct broken_plate *plate,
                                 double *value)
{
    const struct measure_crater *parameters = m->check->measure.value;
    const struct ranks *ranks = m->simulation->ranks;
    const double spacing = m->simulation->problem->input->resolution;
    struct columns columns = {0};
    struct crater crater = {0};
    TRY(broken_find_axis(m, parameters->along, &parameters->center, &columns.axis));
    struct error *error = ranks_agree(ranks, make_columns(m, plate, &columns));
    if (!error) {
        find_surface(m, plate, &columns);
        error = ranks_agree(ranks, walk(&columns, 0.5 * spacing, &crater));
    }
    if (!error)
        *value = crater.open
                     ? measure_nothing(m, NOTHING_OPEN)
                     : value_of(&columns, &crater, COLUMN_EXCESS * spacing, parameters->take);
    free(columns.surface);
    return error;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_crater *parameters = measurement->check->measure.value;
    struct broken_plate plate;
    *value = measure_nothing(measurement, NOTHING_NO_FRAGMENT);
    struct error *error = broken_find_plate(measurement, parameters->link, &plate);
    if (!error && plate.fragments)
        error = find_crater(measurement, &plate, value);
    broken_plate_free(&plate);
    return error;
}

const struct measure_class measure_crater = {.unit = unit, .measure = measure, .of_bodies = true};
