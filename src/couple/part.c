/* Parts of a coupling, see part.h. */
#include "couple/part.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "model/maps.h"

void part_surround(struct mpm *mpm, struct mpm_outside *outside, const struct gas_cut *cut)
{
    memcpy(outside->low, cut->low, sizeof outside->low);
    memcpy(outside->high, cut->high, sizeof outside->high);
    memcpy(outside->open, cut->open, sizeof outside->open);
    mpm_surround(mpm, outside);
}

void *owned_new(struct owned *owned, size_t size)
{
    void *memory = memory_allocate(size + 1);
    if (!memory || !memory_reserve((void **)&owned->memory, &owned->capacity, owned->count + 1,
                                   owned->count, sizeof(void *))) {
        free(memory);
        return NULL;
    }
    owned->memory[owned->count++] = memory;
    memset(memory, 0, size + 1);
    return memory;
}

void owned_free(struct owned *owned)
{
    for (int k = 0; k < owned->count; k++)
        free(owned->memory[k]);
    free(owned->memory);
}

struct error *part_begin(const struct part_maker *maker, struct coupled_part *part,
                         const struct simulation_case *input)
{
    part->place = place_whole(input);
    part->place.is_part = true;
    part->elsewhere = owned_new(maker->owned, (size_t)input->bodies.count);
    part->place.elsewhere = part->elsewhere;
    return part->elsewhere ? NULL : out_of_memory_for("the coupling");
}

/* Cells from LOW to HIGH; infinite in dimensions that the case has not. */
static struct bounds box_of(const struct part_maker *maker, const int64_t low[3],
                            const int64_t high[3])
{
    double end[2][3] = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    for (int axis = 0; axis < maker->dimension; axis++) {
        end[0][axis] = (double)low[axis] * maker->edge;
        end[1][axis] = (double)high[axis] * maker->edge;
    }
    return (struct bounds){vector_at(end[0]), vector_at(end[1])};
}

void part_cut_bodies(const struct part_maker *maker, struct coupled_part *part,
                     const int64_t low[3], const int64_t high[3])
{
    const struct simulation_case *input = part->place.input;
    const struct bounds box = part->place.box = box_of(maker, low, high);
    for (int b = 0; b < input->bodies.count; b++) {
        const struct bounds bounds = shape_bounds(&case_body(input, b)->shape);
        for (int axis = 0; axis < maker->dimension; axis++)
            part->elsewhere[b] |= !(vec3_at(bounds.low, axis) < vec3_at(box.high, axis) &&
                                    vec3_at(bounds.high, axis) > vec3_at(box.low, axis));
    }
}

void part_block(const struct part_maker *maker, struct coupled_part *part, const int64_t low[3],
                const int64_t high[3])
{
    bool any = true;
    for (int axis = 0; axis < maker->dimension; axis++)
        any &= low[axis] < high[axis];
    if (any)
        part->place.blocked = box_of(maker, low, high);
}

void part_pin(const struct part_maker *maker, struct place *place, int number, const int64_t low[3],
              const int64_t high[3])
{
    place->pinned[number] = box_of(maker, low, high);
}

void part_close_faces(const struct part_maker *maker, struct coupled_part *part,
                      const struct gas_cut *cut, const struct place *outer)
{
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            struct face *face = &part->place.face[axis][side];
            *face = outer->face[axis][side];
            if (cut->open[axis][side] || axis >= maker->dimension)
                *face = (struct face){.kind = -1, .at = NAN, .pressure = NAN, .boundary = -1};
            else if (face->kind == BOUNDARY_PERIODIC)
                face->kind = BOUNDARY_REFLECTING;
            else if (!face_closes(face))
                *face =
                    (struct face){.kind = BOUNDARY_OUTFLOW,
                                  .at = (double)(side ? cut->high : cut->low)[axis] * maker->edge,
                                  .pressure = NAN,
                                  .boundary = -1};
        }
}

struct error *part_create(const struct part_maker *maker, struct coupled_part *part,
                          const struct simulation *simulation, const struct solver_class *type,
                          const void *parameters)
{
    TRY(simulation_create_at(&part->place, simulation->ranks, simulation->threads,
                             &part->simulation));
    struct judgement judgement = judge_with(type, parameters, &part->simulation);
    struct error *error = findings_refusal(&judgement.findings);
    findings_free(&judgement.findings);
    TRY(error);
    part->solver = owned_new(maker->owned, type->size);
    if (!part->solver)
        return out_of_memory_for("the coupling");
    return type->create(part->solver, &part->simulation, parameters);
}

void part_free(struct coupled_part *part, const struct solver_class *type)
{
    if (part->solver)
        type->destroy(part->solver);
    if (part->simulation.problem)
        simulation_destroy(&part->simulation);
}

void part_show(struct simulation *simulation, const struct coupled_part *part)
{
    const struct population_source *own = &part->simulation.population[0];
    for (int k = 0; k < part->simulation.maps; k++)
        maps_add(simulation, &part->simulation.map[k]);
    simulation_add_population(simulation, own->name, own->type, own->store);
}

void part_share_time(struct coupled_part *part, const struct simulation *simulation)
{
    part->simulation.time = simulation->time;
    part->simulation.step = simulation->step;
    part->simulation.threads = simulation->threads;
}

void part_gather(struct simulation *simulation, struct coupled_part *part)
{
    ledger_join(&simulation->ledger, &part->simulation.ledger);
    memset(&part->simulation.ledger, 0, sizeof part->simulation.ledger);
    for (int i = 0; i < part->simulation.loads; i++) {
        load_record_join(&simulation->load[i], &part->simulation.load[i]);
        part->simulation.load[i] = (struct load_record){0};
    }
    simulation_take_phases(simulation, &part->simulation);
}

double part_edge(const struct mpm_parameters *mpm, const struct simulation_case *input)
{
    return isnan(mpm->cell) ? 2.0 * input->resolution : mpm->cell;
}

struct cell_blocks part_domain(const struct simulation_case *input, double edge)
{
    struct cell_blocks cells = {.dimension = (int)input->dimension, .edge = edge};
    for (int axis = 0; axis < 3; axis++) {
        cells.high[axis] = 1;
        if (axis >= cells.dimension)
            continue;
        cells.low[axis] = (int64_t)floor(domain_face(input, axis, 0).at / edge + 0.5);
        cells.high[axis] = (int64_t)floor(domain_face(input, axis, 1).at / edge + 0.5);
    }
    return cells;
}

double part_cell_volume(const struct part_maker *maker, bool round, const int64_t at[3])
{
    double volume = round ? ((double)at[0] + 0.5) * maker->edge : 1.0;
    for (int axis = 0; axis < maker->dimension; axis++)
        volume *= maker->edge;
    return volume;
}

int part_body_of(const struct place *place, int material)
{
    const struct simulation_case *input = place->input;
    int first = -1;
    for (int body = 0; body < input->bodies.count; body++) {
        if (case_body(input, body)->material_index == material)
            return body;
        if (first < 0 && place_has(place, body))
            first = body;
    }
    return first;
}

int64_t part_particles_across(const struct mpm *mpm, int body)
{
    const double count = 0.5 / mpm_half_size(mpm, body);
    return count < 1.0 ? 1 : (int64_t)(count + 0.5);
}

void part_burn(struct particles *particles, int32_t i)
{
    if (particles->history[HISTORY_lighting_time])
        particles->history[HISTORY_lighting_time][i] = -1.0;
    if (particles->history[HISTORY_burnt])
        particles->history[HISTORY_burnt][i] = 1.0;
}

int32_t part_cell(const struct cell_blocks *cells, const int64_t at[3], int32_t *block)
{
    const struct cell_block *found = cell_block_at(cells, 0, at);
    if (!found)
        return -1;
    int32_t i = found->first;
    for (int axis = 0; axis < cells->dimension; axis++)
        i += (int32_t)(at[axis] - found->corner[axis]) * cell_stride(found, axis);
    *block = (int32_t)(found - cells->block);
    return i;
}

const struct parameter region_table[] = {
    PARAMETER(VECTOR, struct couple_region, low, OPTIONAL, "its lowest corner", .unit = "m"),
    PARAMETER(VECTOR, struct couple_region, high, OPTIONAL, "its highest corner", .unit = "m"),
    PARAMETER_END,
};

struct error *region_check(const struct couple_region *region, const char *key,
                           const struct simulation_case *input, const struct cell_blocks *cells)
{
    if (region->low.count == 0 && region->high.count == 0)
        return NULL;
    if (region->low.count != cells->dimension || region->high.count != cells->dimension)
        return input_error(input, "solver", key,
                           "expected `low` and `high` with %d component%s each, one per dimension",
                           cells->dimension, cells->dimension == 1 ? "" : "s");
    for (int axis = 0; axis < cells->dimension; axis++) {
        const double low = region->low.at[axis], high = region->high.at[axis],
                     domain[2] = {(double)cells->low[axis] * cells->edge,
                                  (double)cells->high[axis] * cells->edge},
                     slack = 1e-6 * cells->edge;
        if (!(low < high))
            return input_error(input, "solver", key, "`low` is not below `high` along %c",
                               "xyz"[axis]);
        if (low < domain[0] - slack || high > domain[1] + slack)
            return input_error(
                input, "solver", key,
                "it reaches from %.6g m to %.6g m along %c, beyond the domain, which "
                "reaches from %.6g m to %.6g m",
                low, high, "xyz"[axis], domain[0], domain[1]);
    }
    return NULL;
}

/* Whether a block of the finest level meets the box from LOW to HIGH. */
static bool meets(const struct cell_block *block, const int64_t low[3], const int64_t high[3])
{
    bool meets = block->level == 0;
    for (int axis = 0; axis < 3; axis++)
        meets &= block->corner[axis] < high[axis] &&
                 block->corner[axis] + block->count[axis] > low[axis];
    return meets;
}

void part_hide_cells(struct cell_blocks *cells, const int64_t low[3], const int64_t high[3])
{
    for (int32_t b = 0; b < cells->blocks; b++) {
        const struct cell_block *block = &cells->block[b];
        if (!meets(block, low, high))
            continue;
        int32_t i = block->first;
        for (int c = 0; c < block->count[2]; c++)
            for (int j = 0; j < block->count[1]; j++)
                for (int k = 0; k < block->count[0]; k++, i++) {
                    const int64_t at[3] = {block->corner[0] + k, block->corner[1] + j,
                                           block->corner[2] + c};
                    bool inside = true;
                    for (int axis = 0; axis < 3; axis++)
                        inside &= at[axis] >= low[axis] && at[axis] < high[axis];
                    if (inside)
                        cells->mass[i] = 0.0;
                }
    }
}

bool part_pick(struct picked *picked, int32_t count, int threads,
               bool (*wanted)(void *context, int32_t i), void *context)
{
    enum { RUN = 4096 }; /* members, whose picks stand at their beginning first */
    const int32_t runs = (count + RUN - 1) / RUN;
    if (!memory_reserve((void **)&picked->index, &picked->capacity, (int64_t)count + runs + 1, 0,
                        sizeof *picked->index))
        return false;
    int32_t *of = picked->index + count; /* each run's number of picks */
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t run = 0; run < runs; run++) {
        const int32_t begin = run * RUN, end = begin + RUN < count ? begin + RUN : count;
        int32_t taken = 0;
        for (int32_t i = begin; i < end; i++)
            if (wanted(context, i))
                picked->index[begin + taken++] = i;
        of[run] = taken;
    }
    picked->count = 0;
    for (int32_t run = 0; run < runs; run++) {
        memmove(picked->index + picked->count, picked->index + (size_t)run * RUN,
                (size_t)of[run] * sizeof *picked->index);
        picked->count += of[run];
    }
    return true;
}

void part_unite(const struct ranks *ranks, int64_t *bits, double *values, int64_t count)
{
    if (ranks->size < 2)
        return;
    memcpy(bits, values, (size_t)count * sizeof *values);
    ranks_sum_of(ranks, bits, (int)count);
    memcpy(values, bits, (size_t)count * sizeof *values);
}
