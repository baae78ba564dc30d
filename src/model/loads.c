/* Forces of loads on elements of surfaces; see loads.h. */
#include "model/loads.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "exact/kingery_curves.h"

bool load_acts_at(const struct load_input *load, double time)
{
    return !(time < load->after || time >= load->before);
}

static bool is_between(const struct load_input *load, struct vec3 place)
{
    const double x = vec3_at(place, load->axis);
    return load->between.count == 0 || (x >= load->between.at[0] && x <= load->between.at[1]);
}

/* Whether NORMAL points to the side of the axis that the load names, if it names one. */
static bool is_of_side(const struct load_input *load, struct vec3 normal)
{
    static const double least = 1e-9;
    const double to = vec3_at(normal, load->axis);
    return load->side < 0 || (load->side == SIDE_HIGH ? to : -to) > least;
}

bool load_takes(const struct load_input *load, const struct surface_element *element)
{
    return element->cover == SURFACE_FREE && is_between(load, element->start.place) &&
           is_of_side(load, element->start.normal);
}

double blast_cosine(const struct blast_input *blast, const struct surface_state *state,
                    double *distance)
{
    double way = 0.0, to = 0.0;
    for (int axis = 0; axis < blast->at.count; axis++) {
        const double step = blast->at.at[axis] - vec3_at(state->place, axis);
        way += square(step);
        to += step * vec3_at(state->normal, axis);
    }
    *distance = sqrt(way);
    return to / *distance;
}

void loads_free(struct loads *loads)
{
    for (int i = 0; i < loads->count && loads->acts; i++)
        free(loads->acts[i]);
    for (int k = 0; k < loads->surfaces; k++)
        surface_free(&loads->surface[k]);
    free(loads->surface);
    free(loads->of);
    free(loads->acts);
    free(loads->push);
    free(loads->force);
    *loads = (struct loads){0};
}

/* The surface of load INDEX: that of an earlier load on the same body, or a new one. */
static struct error *find_surface(struct loads *loads, const struct place *place, int index)
{
    const int body = case_load(place->input, index)->body;
    for (int k = 0; k < loads->surfaces; k++)
        if (loads->surface[k].body == body) {
            loads->of[index] = k;
            return NULL;
        }
    loads->of[index] = loads->surfaces++;
    return surface_create(place, body, &loads->surface[loads->of[index]]);
}

static struct error *choose_elements(struct loads *loads, const struct simulation_case *input,
                                     int index)
{
    const struct body_surface *surface = &loads->surface[loads->of[index]];
    const struct load_input *load = case_load(input, index);
    if (!load_is_local(load))
        return NULL;
    loads->acts[index] = memory_allocate((size_t)surface->elements * sizeof **loads->acts);
    if (!loads->acts[index])
        return out_of_memory_for("loads");
    for (int32_t e = 0; e < surface->elements; e++)
        loads->acts[index][e] = load_takes(load, &surface->element[e]);
    return NULL;
}

struct error *loads_create(const struct simulation *simulation, struct loads *loads)
{
    const struct simulation_case *input = simulation->problem->input;
    const size_t count = (size_t)input->loads.count;
    *loads = (struct loads){.count = input->loads.count};
    if (count == 0)
        return NULL;
    loads->surface = memory_allocate(count * sizeof *loads->surface);
    loads->of = memory_allocate(count * sizeof *loads->of);
    loads->acts = memory_allocate(count * sizeof *loads->acts);
    if (!loads->surface || !loads->of || !loads->acts)
        return out_of_memory_for("loads");
    int32_t most = 0;
    for (int i = 0; i < loads->count; i++) {
        TRY(find_surface(loads, &simulation->problem->place, i));
        TRY(choose_elements(loads, input, i));
        const int32_t elements = loads->surface[loads->of[i]].elements;
        most = elements > most ? elements : most;
    }
    loads->push = memory_allocate((size_t)most * sizeof *loads->push);
    return loads->push ? NULL : out_of_memory_for("loads");
}

void loads_clear(struct loads *loads, const struct population *population)
{
    memset(loads->force, 0, (size_t)population->count * sizeof *loads->force);
}

struct error *loads_follow(struct loads *loads, const struct simulation *simulation,
                           const struct population *population)
{
    const struct simulation_case *input = simulation->problem->input;
    for (int k = 0; k < loads->surfaces; k++) {
        bool acts = false;
        for (int i = 0; i < loads->count; i++)
            acts |= loads->of[i] == k && load_acts_at(case_load(input, i), simulation->time);
        if (acts)
            surface_follow(&loads->surface[k], population, simulation->ranks);
    }
    if (!memory_reserve((void **)&loads->force, &loads->capacity, population->count, 0,
                        sizeof *loads->force))
        return out_of_memory_for("loads");
    return NULL;
}

/* A load in a step: its pressure or traction in the middle, or the times since the detonation. */
struct acting {
    const struct load_input *load;
    const bool *acts;
    const struct load_trace *trace;
    double pressure, traction[3];
    double from, to;
};

static struct error *find_acting(const struct simulation *simulation, int index, double from,
                                 double dt, struct acting *acting)
{
    static const char *const keys[] = {"traction.1", "traction.2", "traction.3"};
    const struct load_input *load = acting->load;
    const char *name = simulation->problem->input->loads.names[index];
    const double middle = from + 0.5 * dt;
    acting->from = from - (load_is_record(load) ? load->record.time : load->blast.time);
    acting->to = acting->from + dt;
    if (load_is_local(load))
        return NULL;
    assert(load->traction.count <= 3);
    for (int k = 0; k < load->traction.count; k++)
        TRY(simulation_value_at(simulation, middle, &load->traction.at[k], name, keys[k],
                                &acting->traction[k]));
    return load->traction.count ? NULL
                                : simulation_value_at(simulation, middle, &load->pressure, name,
                                                      "pressure", &acting->pressure);
}

/* Where element E is for `between`, which may end at the wall that the element is at. */
static struct vec3 window_place(const struct body_surface *surface, int32_t e)
{
    const struct surface_element *element = &surface->element[e];
    return element->cover == SURFACE_AT_WALL ? surface->place[element->site]
                                             : surface->now[e].place;
}

/* How far PLACE is from the line along the axis of LOAD through the centre of its record. */
static double distance_from_center(const struct load_input *load, struct vec3 place)
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const double center = axis < load->record.center.count ? load->record.center.at[axis] : 0.0;
        sum += axis == load->axis ? 0.0 : square(vec3_at(place, axis) - center);
    }
    return sqrt(sum);
}

static struct push push_of(const struct acting *acting, const struct body_surface *surface,
                           int32_t e)
{
    const struct load_input *load = acting->load;
    const struct surface_state *now = &surface->now[e];
    const struct push none = {{0.0, 0.0, 0.0}, 0.0};
    double pressure = acting->pressure, distance;
    if (load_is_blast(load)) {
        if (!acting->acts[e])
            return none;
        const double cosine = blast_cosine(&load->blast, now, &distance);
        pressure = kingery_load_impulse((enum kingery_charge)load->blast.charge, load->blast.mass,
                                        distance, cosine, acting->from, acting->to) /
                   (acting->to - acting->from);
    } else if (load_is_record(load)) {
        if (!acting->acts[e])
            return none;
        const struct vec3 start = surface->element[e].start.place;
        pressure = load_trace_mean(acting->trace, distance_from_center(load, start), acting->from,
                                   acting->to);
    } else if (surface->element[e].cover == SURFACE_COVERED ||
               !is_between(load, window_place(surface, e)))
        return none;
    if (!load->traction.count)
        return (struct push){vec3_scale(-pressure, now->area),
                             fabs(pressure) * vec3_dot(now->area, now->normal)};
    if (!is_of_side(load, now->normal))
        return none;
    const double area = (load->side == SIDE_HIGH ? 1.0 : -1.0) * vec3_at(now->area, load->axis);
    const struct vec3 traction = vector_at(acting->traction);
    return (struct push){vec3_scale(area, traction), sqrt(vec3_dot(traction, traction)) * area};
}

struct error *loads_push(struct loads *loads, struct simulation *simulation, int index, double from,
                         double dt, bool add)
{
    const struct body_surface *surface = &loads->surface[loads->of[index]];
    struct load_record *record = &simulation->load[index];
    struct acting acting = {.load = case_load(simulation->problem->input, index),
                            .acts = loads->acts[index],
                            .trace = &simulation->trace[index]};
    TRY(find_acting(simulation, index, from, dt, &acting));
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t e = 0; e < surface->elements; e++)
        loads->push[e] = push_of(&acting, surface, e);
    loads->pushes = false;
    for (int32_t e = 0; e < surface->elements; e++) {
        const int32_t member = surface->member[surface->element[e].site];
        const struct push *push = &loads->push[e];
        const double impulse[3] = {dt * push->force.x, dt * push->force.y, dt * push->force.z};
        if (member < 0 || push->size == 0.0)
            continue;
        loads->pushes = true;
        if (surface->element[e].cover == SURFACE_AT_WALL) {
            const double back[3] = {-impulse[0], -impulse[1], -impulse[2]};
            if (!add)
                load_record_add(record, LOAD_DELIVERED, back);
            continue;
        }
        load_record_add(record, LOAD_EXPECTED, impulse);
        exact_sum_add(&record->sum[LOAD_GROSS], dt * push->size);
        for (int k = 0; k < 3 && add; k++)
            loads->force[member][k] += impulse[k] / dt;
    }
    return NULL;
}

void loads_deliver(const struct loads *loads, struct simulation *simulation, int index, double dt)
{
    const struct body_surface *surface = &loads->surface[loads->of[index]];
    for (int32_t e = 0; e < surface->elements; e++) {
        const struct vec3 force = loads->push[e].force;
        const double impulse[3] = {dt * force.x, dt * force.y, dt * force.z};
        if (surface->member[surface->element[e].site] >= 0 &&
            surface->element[e].cover != SURFACE_AT_WALL)
            load_record_add(&simulation->load[index], LOAD_DELIVERED, impulse);
    }
}
