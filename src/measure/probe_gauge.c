/* gauge: stands still. A field at its place is the mean over the particles within its radius, by
 * volume, sum V f/sum V with V = m/rho; sums are exact. Beside a pressure stands that of the case's
 * exact solution, if it is that of a blast. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/probes.h"
#include "shape/shape.h"

const struct parameter probe_gauge_table[] = {
    PARAMETER(VECTOR, struct probe_gauge, at, REQUIRED, "its position", .unit = "m"),
    PARAMETER(NUMBER, struct probe_gauge, radius, OPTIONAL,
              "radius within which particles count; default: the resolution of the case",
              .unit = "m", .below = INFINITY),
    PARAMETER_END,
};

/* Solves the exact solution of the case for the gauge where both have a pressure over time. A
 * problem without a solution is reported by the checks. */
static struct error *add_exact(struct probe *probe, const struct simulation_case *input)
{
    const struct exact_class *class = input->exact.choice ? input->exact.choice->thing : NULL;
    bool pressure = false;
    for (int i = 0; i < probe->fields->count; i++)
        pressure |= !strcmp(probe->fields->field[i].name, "pressure");
    if (!pressure || !class || class->known != EXACT_PRESSURE || probe->columns == PROBE_COLUMNS)
        return NULL;
    probe->solved = memory_allocate(class->size);
    if (!probe->solved)
        return out_of_memory_for("an exact solution");
    struct error *error = class->solve(input->exact.value, probe->solved);
    if (error) {
        error_free(error);
        free(probe->solved);
        probe->solved = NULL;
    } else
        probe_add_column(probe, "exact", "Pa");
    return NULL;
}

static double radius_of(const struct probe *probe, const struct simulation *simulation)
{
    const struct probe_gauge *gauge = probe->input->probe.value;
    return isnan(gauge->radius) ? simulation->problem->input->resolution : gauge->radius;
}

/* Whether an open cell of EDGE has its centre within RADIUS of PLACE. */
static bool reaches_cell(const struct simulation_case *input, const struct vector_value *place,
                         double radius, double edge)
{
    enum { MOST = 40 }; /* cells along an axis: as many hold an open one, or all is blocked */
    const struct bounds domain = domain_bounds(input);
    int64_t low[3] = {0, 0, 0}, count[3] = {1, 1, 1}, all = 1;
    for (int axis = 0; axis < place->count; axis++) {
        const double from = maximum(place->at[axis] - radius, vec3_at(domain.low, axis)),
                     to = minimum(place->at[axis] + radius, vec3_at(domain.high, axis));
        low[axis] = (int64_t)ceil(from / edge - 0.5 - 1e-9);
        count[axis] = (int64_t)floor(to / edge - 0.5 + 1e-9) - low[axis] + 1;
        if (count[axis] <= 0)
            return false;
        count[axis] = count[axis] > MOST ? MOST : count[axis];
        all *= count[axis];
    }
    for (int64_t k = 0; k < all; k++) {
        double at[3] = {0.0, 0.0, 0.0};
        int64_t rest = k;
        for (int axis = 0; axis < place->count; axis++) {
            at[axis] = ((double)(low[axis] + rest % count[axis]) + 0.5) * edge;
            rest /= count[axis];
        }
        if (distance_square(place, at) <= square(radius) * (1.0 + 1e-9) &&
            rigid_body_at(input, vector_at(at)) < 0)
            return true;
    }
    return false;
}

/* Cells stay: a gauge that no open one is near records nothing. */
static struct error *check_cells(const struct probe *probe, const struct simulation *simulation,
                                 double edge)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct probe_gauge *gauge = probe->input->probe.value;
    const double radius = radius_of(probe, simulation);
    if (reaches_cell(input, &gauge->at, input->levels > 1 ? maximum(radius, edge) : radius, edge))
        return NULL;
    for (int axis = 0; axis < gauge->at.count; axis++) {
        const double at = gauge->at.at[axis], low = domain_face(input, axis, 0).at,
                     high = domain_face(input, axis, 1).at;
        if (at < low || at > high)
            return probe_error(probe, simulation, "gauge",
                               "%c = %.6g m is outside the domain, which goes from %.6g to %.6g m: "
                               "it would record nothing",
                               "xyz"[axis], at, low, high);
    }
    double at[3] = {0.0, 0.0, 0.0};
    memcpy(at, gauge->at.at, (size_t)gauge->at.count * sizeof *at);
    const int body = rigid_body_at(input, vector_at(at));
    return body >= 0
               ? probe_error(probe, simulation, "gauge",
                             "it is in the rigid body \"%s\", and no open cell of %.4g m has its "
                             "centre within %.4g m: it would record nothing",
                             input->boundaries.names[body], edge, radius)
               : probe_error(probe, simulation, "gauge",
                             "no open cell of %.4g m has its centre within %.4g m: it would record "
                             "nothing; enlarge its `radius`",
                             edge, radius);
}

/* No particle is ever outside a closed or periodic face. */
static struct error *check_faces(const struct probe *probe, const struct simulation *simulation)
{
    const struct probe_gauge *gauge = probe->input->probe.value;
    const double radius = radius_of(probe, simulation);
    for (int axis = 0; axis < gauge->at.count; axis++)
        for (int side = 0; side < 2; side++) {
            const struct face *face = &simulation->problem->place.face[axis][side];
            const double beyond = (side ? 1.0 : -1.0) * (gauge->at.at[axis] - face->at) - radius;
            if (beyond > 0.0 && (face_closes(face) || face->kind == BOUNDARY_PERIODIC))
                return probe_error(
                    probe, simulation, "gauge",
                    "it is outside the wall, axis or periodic face at %c = %.6g m: it would "
                    "record nothing",
                    "xyz"[axis], face -> at);
        }
    return NULL;
}

static struct error *prepare(struct probe *probe, const struct simulation *simulation,
                             const struct population *population)
{
    const struct probe_gauge *gauge = probe->input->probe.value;
    TRY(probe_check_place(probe, simulation, "gauge", &gauge->at));
    TRY(population->kind == POPULATION_OF_CELLS ? check_cells(probe, simulation, population->edge)
                                                : check_faces(probe, simulation));
    probe_add_column(probe, "particles", "");
    TRY(probe_add_fields(probe, simulation, population));
    return add_exact(probe, simulation->problem->input);
}

/* Behind the sums of the fields come the count of particles and their volume. */
static void add_particle(const struct probe *probe, const struct population *population,
                         int32_t index, struct exact_sum *sums)
{
    const int count = probe->fields->count;
    double volume = population->mass[index] / population->density[index];
    for (int i = 0; i < count; i++)
        exact_sum_add(&sums[i], volume * field_value(population, &probe->fields->field[i], index));
    exact_sum_add(&sums[count], 1.0);
    exact_sum_add(&sums[count + 1], volume);
}

/* Where a gauge stands, and its radius. */
struct place_around {
    const struct vector_value *at;
    double radius;
};

static bool is_near(const void *context, const struct population *population, int32_t index)
{
    const struct place_around *place = context;
    return distance_square(place->at, population->position[index]) <=
           square(probe_reach(population, index, place->radius));
}

static struct error *sample(struct probe *probe, const struct simulation *simulation,
                            const struct population *population, double *row)
{
    const struct probe_gauge *gauge = probe->input->probe.value;
    const int count = probe->fields->count;
    const struct place_around place = {&gauge->at, radius_of(probe, simulation)};
    struct exact_sum *sums = memory_allocate(((size_t)count + 2) * sizeof *sums);
    struct error *error = sums ? NULL : out_of_memory_for("a gauge");
    if (!error)
        error = probe_find_near(probe, population, is_near, &place);
    error = ranks_agree(simulation->ranks, error);
    if (error) {
        free(sums);
        return error;
    }
    for (int64_t k = 0; k < probe->nears; k++) {
        const int32_t i = probe->near[k];
        if (population_has(population, i) &&
            (probe->selection.body < 0 || population->body[i] == probe->selection.body))
            add_particle(probe, population, i, sums);
    }
    ranks_sum_exact(simulation->ranks, sums, count + 2);
    double volume = exact_sum_value(&sums[count + 1]);
    row[0] = exact_sum_value(&sums[count]);
    for (int i = 0; i < count; i++)
        row[i + 1] = row[0] > 0.0 ? exact_sum_value(&sums[i]) / volume : NAN;
    if (probe->solved) {
        const struct exact_class *class = simulation->problem->input->exact.choice->thing;
        const double distance = exact_distance(class, probe->solved, &gauge->at);
        row[count + 1] =
            class->sample(probe->solved, SIDE_LEFT, distance, simulation->time).pressure;
    }
    free(sums);
    return NULL;
}

const struct probe_class probe_gauge = {PROBE_TAKES_OF | PROBE_TAKES_FIELDS, prepare, sample};
