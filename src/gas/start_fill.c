/* The blast of another case in our cells. What a shell or ring of it holds goes to them by points:
 * each takes the state of the shell at its radius, times the factor that gives all points of a
 * shell together the shell's mass of either material and its energy. Rings near the axis are too
 * small for that: all of them have one factor. Velocities are along the radius and the axis. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "gas/start_blast.h"

/* Our cells, and the points in them. */
struct filling {
    struct gas *gas;
    const struct simulation *simulation;
    double center[3];
    double reach;          /* radius up to which cells take from the blast */
    double height[2];      /* of rings: from where to where along the axis */
    int axis;              /* that of rings; 3: the blast has shells */
    double share;          /* of the blast that the domain holds between its planes of symmetry */
    bool window;           /* the domain holds a part of it: shells keep what they have */
    int points;            /* along an axis of a cell */
    struct exact_sum *sum; /* [bin * SHELLS + number] over all points */
};

/* The cell of the blast at OFFSET from its centre, -1 for none; *RADIUS becomes the distance from
 * the centre, or from the axis. */
static int source_at(const struct filling *f, const struct blast *blast, const double offset[3],
                     double *radius)
{
    double sum = 0.0;
    for (int axis = 0; axis < f->gas->cells->dimension; axis++)
        if (axis != f->axis)
            sum += square(offset[axis]);
    *radius = sqrt(sum);
    const double at = (*radius - blast->low[0]) / blast->edge;
    if (at < 0.0 || at >= blast->last[0])
        return -1;
    if (f->axis == 3)
        return (int)at;
    const double up = (offset[f->axis] - blast->low[1]) / blast->edge;
    if (up < 0.0 || up >= blast->last[1])
        return -1;
    const int k = (int)at + blast->count[0] * (int)up;
    return blast->reached[k] ? k : -1;
}

/* Volume of cell K of the blast: of a shell per steradian, or per radian and length, of a ring per
 * radian. */
static double source_volume(const struct blast *blast, int k)
{
    const double center = blast->low[0] + (k % blast->count[0] + 0.5) * blast->edge,
                 size = blast->rings ? square(blast->edge) : blast->edge;
    return gas_cell_volume(size, blast->edge, center, blast->gas.round);
}

/* Calls ACT for each point of cell I within reach: the source there, the direction of its radius
 * and the weight of the point. Returns the weight of all points. */
typedef void (*act_on_point)(void *context, int source, const double direction[3], double weight);

static double each_point(const struct filling *f, const struct blast *blast, int32_t i,
                         act_on_point act, void *context)
{
    const struct cell_blocks *cells = f->gas->cells;
    const int dimension = cells->dimension, n = f->points;
    const int64_t all = dimension == 3 ? (int64_t)n * n * n : (int64_t)n * n;
    const double edge = cells->size ? cells->size[i] : cells->edge, wide = edge / cells->edge,
                 whole = dimension == 3 ? wide * wide * wide : wide * wide;
    double total = 0.0;
    for (int64_t p = 0; p < all; p++) {
        double direction[3] = {0.0}, radius, weight = whole;
        int64_t rest = p;
        for (int axis = 0; axis < dimension; axis++) {
            const double at =
                cells->position[i][axis] + (((double)(rest % n) + 0.5) / n - 0.5) * edge;
            direction[axis] = at - f->center[axis];
            if (axis == 0 && f->gas->round == 1)
                weight *= at;
            rest /= n;
        }
        total += weight;
        const int source = source_at(f, blast, direction, &radius);
        if (source < 0)
            continue;
        for (int axis = 0; axis < dimension; axis++)
            direction[axis] = axis == f->axis ? 0.0 : direction[axis] / radius;
        act(context, source, direction, weight);
    }
    return total;
}

struct summing {
    const struct filling *f;
    const struct blast *blast;
};

static void sum_point(void *context, int source, const double direction[3], double weight)
{
    const struct summing *s = context;
    const int bin = source / s->blast->cells_a_bin;
    (void)direction;
    for (int n = 0; n < SHELLS; n++)
        exact_sum_add(&s->f->sum[bin * SHELLS + n], weight * s->blast->number[n][source]);
}

struct mixing {
    const struct blast *blast;
    int axis;
    double sum[SHELLS], momentum[3], fraction, weight;
};

static void mix_point(void *context, int source, const double direction[3], double weight)
{
    struct mixing *m = context;
    const struct blast *blast = m->blast;
    const int bin = source / blast->cells_a_bin;
    double value[SHELLS];
    for (int n = 0; n < SHELLS; n++) {
        value[n] = weight * blast->factor[n][bin] * blast->number[n][source];
        m->sum[n] += value[n];
    }
    const double mass = value[SHELL_FIRST] + value[SHELL_SECOND];
    for (int axis = 0; axis < 3; axis++)
        m->momentum[axis] += axis == m->axis ? mass * blast->speed[1][source]
                                             : mass * blast->speed[0][source] * direction[axis];
    m->fraction += weight * blast->fraction[source];
    m->weight += weight;
}

/* The distance from the centre to what another solver computes; infinite where all is the gas's. */
static double to_region(const struct filling *f)
{
    const struct gas_cut *cut = f->gas->cut;
    double sum = 0.0;
    for (int axis = 0; cut && axis < f->gas->cells->dimension; axis++) {
        const double low = (double)cut->low[axis] * f->gas->cells->edge - f->center[axis],
                     high = (double)cut->high[axis] * f->gas->cells->edge - f->center[axis];
        sum += square(maximum(maximum(low, -high), 0.0));
    }
    return cut ? sqrt(sum) : (double)INFINITY;
}

static bool has_wall(const struct simulation_case *input, int axis, int side)
{
    for (int b = 0; b < input->boundaries.count; b++) {
        const struct boundary_input *boundary = case_boundary(input, b);
        if (boundary_kind_closes(boundary->kind) && boundary->axis == axis &&
            boundary->side == side)
            return true;
    }
    return false;
}

/* A face of the domain that cuts the blast must be a wall: it would leave through any other. */
static struct error *check_wall(const struct filling *f, int axis, int side)
{
    char text[200];
    if (has_wall(f->simulation->problem->input, axis, side))
        return NULL;
    snprintf(text, sizeof text,
             "the %s face of the domain along %c cuts the blast, which would leave through it: "
             "make it `symmetry` or `reflecting`, or give `window: yes`",
             side ? "high" : "low", "xyz"[axis]);
    return gas_wrong_start(f->simulation, "from", text);
}

/* Whether the domain, from LOW to HIGH along the axis of rings, holds them. Where they end at a
 * face of the other case, this one must have its face there, too. */
static struct error *check_heights(const struct filling *f, const struct blast *blast, double low,
                                   double high)
{
    const struct simulation_case *from = f->simulation->problem->input->start.input;
    const double near = 1e-6 * f->gas->cells->edge, face[2] = {low, high};
    char text[240];
    for (int side = 0; side < 2; side++) {
        const bool beyond = side ? face[1] > f->height[1] + near : face[0] < f->height[0] - near,
                   within = side ? face[1] < f->height[1] - near : face[0] > f->height[0] + near,
                   cut = side ? blast->last[1] == blast->count[1] : blast->from[1] == 0;
        if (cut && !within && !beyond && has_wall(from, 1, side))
            TRY(check_wall(f, f->axis, side));
        if (!within && !(cut && beyond))
            continue;
        snprintf(text, sizeof text,
                 within ? "the blast reaches to %.4g m along the axis by then, which the domain "
                          "does not hold: give an earlier `at`, or `window: yes`"
                        : "the blast has met the face of that case %.4g m along the axis by then, "
                          "and the domain goes on: end it there, or give an earlier `at`",
                 f->height[side]);
        return gas_wrong_start(f->simulation, "from", text);
    }
    return NULL;
}

/* How much of the blast the domain holds, and whether it holds that much. */
static struct error *find_share(struct filling *f, const struct blast *blast)
{
    const struct cell_blocks *cells = f->gas->cells;
    const double near = 1e-6 * cells->edge;
    f->share = 1.0;
    f->reach = blast->low[0] + blast->last[0] * blast->edge;
    f->height[0] = blast->low[1] + blast->from[1] * blast->edge;
    f->height[1] = blast->low[1] + blast->last[1] * blast->edge;
    if (blast->rings && blast->last[0] == blast->count[0] && !f->window)
        return gas_wrong_start(f->simulation, "from",
                               "the blast has reached the face of that case that is farthest from "
                               "its axis by then: give an earlier `at`");
    for (int axis = 0; axis < cells->dimension; axis++) {
        const double low = (double)cells->low[axis] * cells->edge - f->center[axis],
                     high = (double)cells->high[axis] * cells->edge - f->center[axis];
        const bool half_low = fabs(low) < near, half_high = fabs(high) < near;
        if (axis == f->axis) {
            if (!f->window)
                TRY(check_heights(f, blast, low, high));
            continue;
        }
        if (axis == 0 && f->gas->round == 1) {
            if (!half_low)
                return gas_wrong_start(f->simulation, "center",
                                       "the domain must begin at the axis, x = 0");
        } else
            f->share *= half_low || half_high ? 0.5 : 1.0;
        if (!f->window && (half_low || half_high) && !(axis == 0 && f->gas->round == 1))
            TRY(check_wall(f, axis, half_high));
        if (!f->window && ((!half_low && low > -f->reach) || (!half_high && high < f->reach))) {
            char text[200];
            snprintf(text, sizeof text,
                     "the blast has a radius of %.4g m by then, which the domain does not hold: "
                     "give an earlier `at`, or `window: yes`",
                     f->reach);
            return gas_wrong_start(f->simulation, "from", text);
        }
    }
    const double farthest =
        blast->rings ? hypot(f->reach, maximum(fabs(f->height[0]), fabs(f->height[1]))) : f->reach;
    if (farthest > to_region(f)) {
        char text[200];
        snprintf(text, sizeof text,
                 "the blast has a radius of %.4g m by then and the region of the material points, "
                 "which begin at rest, is %.4g m from its centre: give an earlier `at`, or a "
                 "smaller region",
                 farthest, to_region(f));
        return gas_wrong_start(f->simulation, "from", text);
    }
    return NULL;
}

/* The factors of each bin: what its cells hold over what the points have of it. */
static void find_factors(const struct filling *f, struct blast *blast)
{
    const double angle = blast->rings                    ? 2.0 * M_PI
                         : f->gas->cells->dimension == 3 ? 4.0 * M_PI
                         : f->gas->round == 1            ? 2.0
                                                         : 2.0 * M_PI;
    const double point = pow(f->gas->cells->edge / f->points, f->gas->cells->dimension);
    for (int bin = 0; bin < blast->bins; bin++)
        for (int n = 0; n < SHELLS; n++) {
            const double sampled = point * exact_sum_value(&f->sum[bin * SHELLS + n]);
            double held = 0.0;
            for (int k = bin * blast->cells_a_bin;
                 k < (bin + 1) * blast->cells_a_bin && k < blast->cells; k++)
                if (blast->reached[k])
                    held += blast->number[n][k] * source_volume(blast, k);
            blast->factor[n][bin] =
                sampled != 0.0 && !f->window ? f->share * angle * held / sampled : 1.0;
        }
}

/* Of the mass of the air, which a cell of one material may hold as air. */
static const double products_left = 1e-3;

static struct error *fill_cell(const struct filling *f, const struct blast *blast, int32_t i)
{
    struct gas *gas = f->gas;
    struct mixing m = {.blast = blast, .axis = f->axis};
    const double all = each_point(f, blast, i, mix_point, &m);
    if (m.weight == 0.0)
        return NULL;
    if (gas->open && gas->open[i] == 0.0)
        return gas_wrong_start(f->simulation, "from",
                               "an obstacle lies within the blast by then: give an earlier `at`");
    if (!gas->layout.two && m.sum[SHELL_SECOND] > products_left * m.sum[SHELL_FIRST])
        return gas_wrong_start(
            f->simulation, "material",
            "the products have come into the domain by then: give the material here that "
            "they are, or a domain farther away");
    const double own = (all - m.weight) / all;
    for (int n = 0; n < gas->layout.written; n++)
        gas->u[n][i] *= own;
    gas->u[GAS_DENSITY][i] += (m.sum[SHELL_FIRST] + m.sum[SHELL_SECOND]) / all;
    for (int axis = 0; axis < gas->cells->dimension; axis++)
        gas->u[GAS_MOMENTUM + axis][i] += m.momentum[axis] / all;
    gas->u[GAS_ENERGY][i] += m.sum[SHELL_ENERGY] / all;
    gas->u[GAS_SHOCK][i] = 0.0;
    if (gas->layout.two) {
        const double fraction = gas->u[GAS_FRACTION][i] + m.fraction / all;
        gas->u[GAS_SECOND][i] += m.sum[SHELL_SECOND] / all;
        gas->u[GAS_FRACTION][i] = m.sum[SHELL_FIRST] <= 0.0 && own == 0.0 ? 1.0 : fraction;
    }
    if (gas->layout.afterburns)
        gas->u[GAS_AFTERBURNT][i] += m.sum[SHELL_AFTERBURNT] / all;
    if (gas->layout.lit)
        gas->u[gas->layout.burnt][i] = 1.0;
    return NULL;
}

/* What cells within the blast have of their maps is what the other case has kept at their radius,
 * but of components, which point along the radius there. Arrivals count from the start here. */
static void fill_maps(const struct filling *f, const struct blast *blast)
{
    const struct simulation *here = f->simulation, *there = &blast->simulation;
    const struct population cells = simulation_population(here),
                            shells = simulation_population(there);
    for (int k = 0; k < here->maps; k++) {
        const struct map *map = &here->map[k];
        struct map_fields to, from;
        if (strchr(map->field, '.') || !maps_find(map, &cells, &to) ||
            !maps_find(map, &shells, &from))
            continue;
        for (int32_t i = 0; i < cells.count; i++) {
            double offset[3] = {0.0}, radius;
            for (int axis = 0; axis < cells.dimension; axis++)
                offset[axis] = cells.position[i][axis] - f->center[axis];
            const int source = source_at(f, blast, offset, &radius);
            if (source < 0)
                continue;
            to.value[i] = from.value[blast->cell[source]];
            to.memory[i] = from.memory[blast->cell[source]];
            if (map->kind == MAP_ARRIVAL && to.memory[i] != 0.0)
                to.memory[i] -= there->time;
        }
    }
}

static struct error *transfer(struct filling *f, struct blast *blast)
{
    const struct cell_blocks *cells = f->gas->cells;
    struct summing summing = {f, blast};
    struct error *error = NULL;
    blast->cells_a_bin = blast->rings ? blast->cells : (int)ceil(0.5 * cells->edge / blast->edge);
    blast->bins = blast->rings ? 1 : (blast->last[0] + blast->cells_a_bin - 1) / blast->cells_a_bin;
    f->sum = memory_allocate(((size_t)blast->bins * SHELLS + 1) * sizeof *f->sum);
    for (int n = 0; n < SHELLS; n++)
        blast->factor[n] = memory_allocate(((size_t)blast->bins + 1) * sizeof(double));
    if (!f->sum || !blast->factor[SHELLS - 1])
        error = out_of_memory_for("a start");
    for (int32_t i = 0; i < cells->count && !error; i++)
        each_point(f, blast, i, sum_point, &summing);
    TRY(ranks_agree(f->simulation->ranks, error));
    ranks_sum_exact(f->simulation->ranks, f->sum, blast->bins * SHELLS);
    find_factors(f, blast);
    for (int32_t i = 0; i < cells->count && !error; i++)
        error = fill_cell(f, blast, i);
    TRY(ranks_agree(f->simulation->ranks, error));
    fill_maps(f, blast);
    return NULL;
}

struct error *gas_fill_blast(struct gas *gas, const struct simulation *simulation,
                             struct blast *blast)
{
    const struct start_input *start = &simulation->problem->input->start;
    struct filling f = {.gas = gas,
                        .simulation = simulation,
                        .window = start->window,
                        .axis = !blast->rings     ? 3
                                : start->axis < 0 ? 1
                                                  : start->axis,
                        .points = gas->cells->dimension == 3 ? 4 : 8};
    for (int axis = 0; axis < start->center.count; axis++)
        f.center[axis] = start->center.at[axis];
    struct error *error = find_share(&f, blast);
    if (!error)
        error = transfer(&f, blast);
    free(f.sum);
    return error;
}
