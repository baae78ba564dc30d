/* A blast that a case of one dimension has computed as the start of this one. It runs on every rank
 * alike. What a shell of it holds goes to the cells by points: each takes the state of the shell at
 * its radius, times the factor that gives all points of a shell together the shell's mass of either
 * material and its energy. Velocities are along the radius. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "gas/gas_internal.h"
#include "material/material.h"
#include "model/maps.h"

/* What a shell's cells have in common with ours, per volume. */
enum { SHELL_FIRST, SHELL_SECOND, SHELL_ENERGY, SHELL_AFTERBURNT, SHELLS };

/* Of the other case: its solver and what its cells hold, by radius. */
struct blast {
    const struct simulation_case *input;
    struct ranks ranks; /* this one alone */
    struct simulation simulation;
    struct gas gas;
    int cells, last; /* all of them; those that the blast has reached */
    double *number[SHELLS], *speed, *fraction;
    struct map_fields map[MAPS_MAX]; /* the cells' own; NULL: none */
    int32_t *cell;                   /* of each shell */
    double low, edge;                /* radius of the first cell's low face, width of a cell */
    int bins, cells_a_bin;
    double *factor[SHELLS]; /* of each bin */
};

/* Our cells, and the points in them. */
struct filling {
    struct gas *gas;
    const struct simulation *simulation;
    double center[3], reach; /* radius up to which cells take from the blast */
    double share;            /* of the ball that the domain holds between its planes of symmetry */
    bool window;             /* the domain holds a part of it: shells keep what they have */
    int points;              /* along an axis of a cell */
    struct exact_sum *sum;   /* [bin * SHELLS + number] over all points */
};

static struct error *wrong(const struct simulation *simulation, const char *key, const char *text)
{
    return input_error(simulation->problem->input, "start", key, "%s", text);
}

/* What the other case must be. */
struct error *gas_check_start(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input, *other = input->start.input;
    if (!other)
        return NULL;
    const bool ball = input->dimension == 3 || input->geometry == GEOMETRY_AXISYMMETRIC;
    if (other->solver.choice->thing != &gas_class || other->dimension != 1)
        return wrong(simulation, "from",
                     "that case must be one of one dimension with the solver gas");
    if (input->dimension == 1)
        return wrong(simulation, "from", "this case has one dimension itself: resume that run");
    if (other->geometry != (ball ? GEOMETRY_SPHERICAL : GEOMETRY_CYLINDRICAL))
        return wrong(simulation, "from",
                     ball ? "a start in 3-D or axisymmetry needs `geometry: spherical` in that case"
                          : "a start in a plane needs `geometry: cylindrical` in that case");
    if (input->geometry == GEOMETRY_AXISYMMETRIC && input->start.center.count &&
        input->start.center.at[0] != 0.0)
        return wrong(simulation, "center", "in axisymmetry the centre lies on the axis, x = 0");
    return NULL;
}

/* Runs the other case. */
static struct error *compute(const struct simulation *simulation, struct blast *blast)
{
    const struct start_input *start = &simulation->problem->input->start;
    const double until = isnan(start->at) ? blast->input->run.until : start->at;
    struct simulation *other = &blast->simulation;
    TRY(gas_class.fill(&blast->gas, other));
    TRY(gas_class.start(&blast->gas, other));
    maps_update(other, 0.0);
    while (other->time < until) {
        struct limit limit = limit_of_nothing();
        TRY(gas_class.prepare(&blast->gas, other, &limit));
        const double left = until - other->time, dt = limit.dt < left ? limit.dt : left;
        TRY(gas_class.advance(&blast->gas, other, dt));
        other->time = dt < left ? other->time + dt : until;
        other->step++;
        maps_update(other, dt);
    }
    return NULL;
}

/* Makes the solver of the other case, whose mistakes name it. It keeps the maps of this one. */
static struct error *open_blast(struct blast *blast, const struct simulation *simulation)
{
    const struct start_input *start = &simulation->problem->input->start;
    blast->input = start->input;
    blast->ranks = ranks_alone();
    const void *parameters = start->input->solver.value;
    struct error *error = simulation_create(start->input, &blast->ranks, 1, &blast->simulation);
    if (!error) {
        struct judgement judgement = judge_with(&gas_class, parameters, &blast->simulation);
        error = findings_refusal(&judgement.findings);
        findings_free(&judgement.findings);
    }
    if (!error) {
        blast->simulation.maps = simulation->maps;
        memcpy(blast->simulation.map, simulation->map, sizeof simulation->map);
        error = gas_class.create(&blast->gas, &blast->simulation, parameters);
    }
    return error_context(error, "start.from: %s", start->from);
}

static void close_blast(struct blast *blast)
{
    gas_class.destroy(&blast->gas);
    simulation_destroy(&blast->simulation);
    for (int n = 0; n < SHELLS; n++) {
        free(blast->number[n]);
        free(blast->factor[n]);
    }
    free(blast->speed);
    free(blast->fraction);
    free(blast->cell);
    free(blast);
}

static bool differs(double a, double b) { return fabs(a - b) > 1e-9 * maximum(fabs(a), fabs(b)); }

/* What the cells of the other case hold, in the order of their radius. */
static struct error *take(struct blast *blast)
{
    const struct cell_blocks *cells = blast->gas.cells;
    const struct gas *gas = &blast->gas;
    const int count = blast->cells = cells->count;
    blast->edge = cells->edge;
    blast->low = (double)cells->low[0] * cells->edge;
    for (int n = 0; n < SHELLS; n++)
        blast->number[n] = memory_allocate((size_t)count * sizeof(double));
    blast->speed = memory_allocate((size_t)count * sizeof(double));
    blast->fraction = memory_allocate((size_t)count * sizeof(double));
    blast->cell = memory_allocate((size_t)count * sizeof *blast->cell);
    for (int n = 0; n < SHELLS; n++)
        if (!blast->number[n] || !blast->speed || !blast->fraction || !blast->cell)
            return out_of_memory_for("a start");
    for (int32_t i = 0; i < count; i++) {
        const int k = (int)((cells->position[i][0] - blast->low) / blast->edge);
        const double density = gas->u[GAS_DENSITY][i],
                     second = gas->layout.two ? gas->u[GAS_SECOND][i] : 0.0;
        blast->cell[k] = i;
        blast->number[SHELL_FIRST][k] = density - second;
        blast->number[SHELL_SECOND][k] = second;
        blast->number[SHELL_ENERGY][k] = gas->u[GAS_ENERGY][i];
        blast->number[SHELL_AFTERBURNT][k] =
            gas->layout.afterburns ? gas->u[GAS_AFTERBURNT][i] : 0.0;
        blast->fraction[k] = gas->layout.two ? gas->u[GAS_FRACTION][i] : 0.0;
        blast->speed[k] = gas->u[GAS_MOMENTUM][i] / density;
    }
    blast->last = count;
    while (blast->last > 0 && fabs(blast->speed[blast->last - 1]) < 1e-6 &&
           !differs(blast->number[SHELL_FIRST][blast->last - 1],
                    blast->number[SHELL_FIRST][count - 1]) &&
           !differs(blast->number[SHELL_ENERGY][blast->last - 1],
                    blast->number[SHELL_ENERGY][count - 1]))
        blast->last--;
    return NULL;
}

/* The shell at RADIUS, -1 for none. */
static int shell_at(const struct blast *blast, double radius)
{
    const double at = (radius - blast->low) / blast->edge;
    return at < 0.0 || at >= blast->last ? -1 : (int)at;
}

/* Volume of shell K per steradian, or per radian and length. */
static double shell_volume(const struct blast *blast, int k)
{
    const double center = blast->low + (k + 0.5) * blast->edge;
    return gas_cell_volume(blast->edge, blast->edge, center, blast->gas.round);
}

/* Calls ACT for each point of cell I within reach: the shell there, the direction from the centre
 * and the weight of the point. Returns the weight of all points. */
typedef void (*act_on_point)(void *context, int shell, const double direction[3], double weight);

static double each_point(const struct filling *f, const struct blast *blast, int32_t i,
                         act_on_point act, void *context)
{
    const struct cell_blocks *cells = f->gas->cells;
    const int dimension = cells->dimension, n = f->points;
    const int64_t all = dimension == 3 ? (int64_t)n * n * n : (int64_t)n * n;
    double total = 0.0;
    for (int64_t p = 0; p < all; p++) {
        double direction[3] = {0.0}, radius = 0.0, weight = 1.0;
        int64_t rest = p;
        for (int axis = 0; axis < dimension; axis++) {
            const double at =
                cells->position[i][axis] + (((double)(rest % n) + 0.5) / n - 0.5) * cells->edge;
            direction[axis] = at - f->center[axis];
            radius += square(direction[axis]);
            if (axis == 0 && f->gas->round == 1)
                weight = at;
            rest /= n;
        }
        radius = sqrt(radius);
        total += weight;
        const int shell = shell_at(blast, radius);
        if (shell < 0)
            continue;
        for (int axis = 0; axis < dimension; axis++)
            direction[axis] /= radius;
        act(context, shell, direction, weight);
    }
    return total;
}

struct summing {
    const struct filling *f;
    const struct blast *blast;
};

static void sum_point(void *context, int shell, const double direction[3], double weight)
{
    const struct summing *s = context;
    const int bin = shell / s->blast->cells_a_bin;
    (void)direction;
    for (int n = 0; n < SHELLS; n++)
        exact_sum_add(&s->f->sum[bin * SHELLS + n], weight * s->blast->number[n][shell]);
}

struct mixing {
    const struct blast *blast;
    double sum[SHELLS], momentum[3], fraction, weight;
};

static void mix_point(void *context, int shell, const double direction[3], double weight)
{
    struct mixing *m = context;
    const struct blast *blast = m->blast;
    const int bin = shell / blast->cells_a_bin;
    double value[SHELLS];
    for (int n = 0; n < SHELLS; n++) {
        value[n] = weight * blast->factor[n][bin] * blast->number[n][shell];
        m->sum[n] += value[n];
    }
    for (int axis = 0; axis < 3; axis++)
        m->momentum[axis] +=
            (value[SHELL_FIRST] + value[SHELL_SECOND]) * blast->speed[shell] * direction[axis];
    m->fraction += weight * blast->fraction[shell];
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

/* How much of the ball the domain holds, and whether it holds that much. */
static struct error *find_share(struct filling *f, const struct blast *blast)
{
    const struct cell_blocks *cells = f->gas->cells;
    const double near = 1e-6 * cells->edge;
    f->share = 1.0;
    f->reach = blast->low + blast->last * blast->edge;
    for (int axis = 0; axis < cells->dimension; axis++) {
        const double low = (double)cells->low[axis] * cells->edge - f->center[axis],
                     high = (double)cells->high[axis] * cells->edge - f->center[axis];
        const bool half_low = fabs(low) < near, half_high = fabs(high) < near;
        if (axis == 0 && f->gas->round == 1) {
            if (!half_low)
                return wrong(f->simulation, "center", "the domain must begin at the axis, x = 0");
        } else
            f->share *= half_low || half_high ? 0.5 : 1.0;
        if (!f->window && ((!half_low && low > -f->reach) || (!half_high && high < f->reach))) {
            char text[200];
            snprintf(text, sizeof text,
                     "the blast has a radius of %.4g m by then, which the domain does not hold: "
                     "give an earlier `at`, or `window: yes`",
                     f->reach);
            return wrong(f->simulation, "from", text);
        }
    }
    if (f->reach > to_region(f)) {
        char text[200];
        snprintf(text, sizeof text,
                 "the blast has a radius of %.4g m by then and the region of the material points, "
                 "which begin at rest, is %.4g m from its centre: give an earlier `at`, or a "
                 "smaller region",
                 f->reach, to_region(f));
        return wrong(f->simulation, "from", text);
    }
    return NULL;
}

/* The factors of each bin: what its shells hold over what the points have of it. */
static void find_factors(const struct filling *f, struct blast *blast)
{
    const double angle = f->gas->cells->dimension == 3 ? 4.0 * M_PI
                         : f->gas->round == 1          ? 2.0
                                                       : 2.0 * M_PI;
    const double point = pow(f->gas->cells->edge / f->points, f->gas->cells->dimension);
    for (int bin = 0; bin < blast->bins; bin++)
        for (int n = 0; n < SHELLS; n++) {
            const double sampled = point * exact_sum_value(&f->sum[bin * SHELLS + n]);
            double held = 0.0;
            for (int k = bin * blast->cells_a_bin;
                 k < (bin + 1) * blast->cells_a_bin && k < blast->last; k++)
                held += blast->number[n][k] * shell_volume(blast, k);
            blast->factor[n][bin] =
                sampled != 0.0 && !f->window ? f->share * angle * held / sampled : 1.0;
        }
}

/* Of the mass of the air, which a cell of one material may hold as air. */
static const double products_left = 1e-3;

static struct error *fill_cell(const struct filling *f, const struct blast *blast, int32_t i)
{
    struct gas *gas = f->gas;
    struct mixing m = {.blast = blast};
    const double all = each_point(f, blast, i, mix_point, &m);
    if (m.weight == 0.0)
        return NULL;
    if (gas->open && gas->open[i] == 0.0)
        return wrong(f->simulation, "from",
                     "an obstacle lies within the blast by then: give an earlier `at`");
    if (!gas->layout.two && m.sum[SHELL_SECOND] > products_left * m.sum[SHELL_FIRST])
        return wrong(f->simulation, "material",
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
            double radius = 0.0;
            for (int axis = 0; axis < cells.dimension; axis++)
                radius += square(cells.position[i][axis] - f->center[axis]);
            const int shell = shell_at(blast, sqrt(radius));
            if (shell < 0)
                continue;
            to.value[i] = from.value[blast->cell[shell]];
            to.memory[i] = from.memory[blast->cell[shell]];
            if (map->kind == MAP_ARRIVAL && to.memory[i] != 0.0)
                to.memory[i] -= there->time;
        }
    }
}

/* The materials of both cases, which must be alike. */
static struct error *check_materials(const struct simulation *simulation, const struct gas *gas,
                                     const struct blast *blast)
{
    const bool alone = simulation->problem->input->start.window && !gas->layout.two;
    const int materials = blast->gas.layout.two && !alone ? 2 : 1;
    if (materials == 2 && !gas->layout.two)
        return wrong(simulation, "material",
                     "that case has two materials: give the one here that "
                     "its denser one is");
    for (int k = 0; k < materials; k++)
        if (memcmp(&gas->eos[k], &blast->gas.eos[k], sizeof gas->eos[k]) != 0)
            return wrong(
                simulation, "from",
                k ? "the equations of state of the denser materials differ"
                  : "the equations of state differ: that case needs the materials of this");
    return NULL;
}

static struct error *transfer(struct filling *f, struct blast *blast)
{
    const struct cell_blocks *cells = f->gas->cells;
    struct summing summing = {f, blast};
    struct error *error = NULL;
    blast->cells_a_bin = (int)ceil(0.5 * cells->edge / blast->edge);
    blast->bins = (blast->last + blast->cells_a_bin - 1) / blast->cells_a_bin;
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
    fill_maps(f, blast);
    return error;
}

/* Whether the centre lies in the domain, whose planes of symmetry belong to it. */
static struct error *check_center(const struct gas *gas, const struct simulation *simulation)
{
    const struct vector_value *center = &simulation->problem->input->start.center;
    const struct cell_blocks *cells = gas->cells;
    for (int axis = 0; axis < cells->dimension && !simulation->problem->input->start.window;
         axis++) {
        const double at = axis < center->count ? center->at[axis] : 0.0,
                     low = (double)cells->low[axis] * cells->edge,
                     high = (double)cells->high[axis] * cells->edge;
        if (at < low - 1e-6 * cells->edge || at > high + 1e-6 * cells->edge)
            return input_error(simulation->problem->input, "start", "center",
                               "the centre of the blast, %c = %.6g m, is outside the domain, which "
                               "goes from %.6g to %.6g m",
                               "xyz"[axis], at, low, high);
    }
    return NULL;
}

struct error *gas_check_source(const struct gas *gas, const struct simulation *simulation)
{
    const struct start_input *start = &simulation->problem->input->start;
    if (!start->input)
        return NULL;
    TRY(check_center(gas, simulation));
    struct blast *blast = memory_allocate(sizeof *blast);
    if (!blast)
        return out_of_memory_for("a start");
    struct error *error = open_blast(blast, simulation);
    if (!error)
        error = check_materials(simulation, gas, blast);
    close_blast(blast);
    return error;
}

struct error *gas_start_from(struct gas *gas, struct simulation *simulation)
{
    const struct start_input *start = &simulation->problem->input->start;
    struct filling f = {
        .gas = gas, .simulation = simulation, .points = gas->cells->dimension == 3 ? 4 : 8};
    if (!start->input)
        return NULL;
    f.window = start->window;
    for (int axis = 0; axis < start->center.count; axis++)
        f.center[axis] = start->center.at[axis];
    struct blast *blast = memory_allocate(sizeof *blast);
    if (!blast)
        return out_of_memory_for("a start");
    struct error *error = open_blast(blast, simulation);
    if (!error)
        error = error_context(compute(simulation, blast), "start.from: %s", start->from);
    if (!error)
        error = take(blast);
    if (!error && blast->gas.unburnt)
        error = wrong(simulation, "from",
                      "the explosive has not burnt by then: compute that case further");
    if (!error)
        error = find_share(&f, blast);
    if (!error)
        error = transfer(&f, blast);
    close_blast(blast);
    free(f.sum);
    return ranks_agree(simulation->ranks, error);
}
