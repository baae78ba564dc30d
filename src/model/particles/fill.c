/* The particles of bodies, made in a walk over each lattice; see fill.h. */
#include "model/particles/fill.h"

#include <math.h>
#include <string.h>

#include "material/material.h"
#include "model/walk.h"
#include "particle/particles.h"
#include "shape/shape.h"

/* What the strength of a particle of MATERIAL and VOLUME is beyond the characteristic one,
 * over it. */
static double strength_scatter(const struct material *material, uint64_t id, double volume)
{
    if (!failure_scatters(&material->failure))
        return 0.0;
    return failure_relative_strength(&material->failure, id, volume) - 1.0;
}

/* Whether a particle of SIZE at PLACE is in the outermost layer of the body OF: whether its shape
 * ends within three quarters of that. A ring has no surface at the axis. */
static bool is_outermost(const struct simulation_case *input, const struct body_input *of,
                         struct vec3 place, double size)
{
    const int dimension = (int)input->dimension;
    for (int n = 0, all = dimension == 1 ? 3 : dimension == 2 ? 9 : 27; n < all; n++) {
        const double x = n % 3 - 1, y = dimension > 1 ? n / 3 % 3 - 1 : 0.0,
                     z = dimension > 2 ? n / 9 - 1 : 0.0;
        const double length = sqrt(x * x + y * y + z * z), step = 0.75 * size / length;
        if (length == 0.0)
            continue;
        struct vec3 there = vec3_make(place.x + step * x, place.y + step * y, place.z + step * z);
        if (input->geometry == GEOMETRY_AXISYMMETRIC)
            there.x = fabs(there.x);
        if (!shape_inside(&of->shape, there))
            return true;
    }
    return false;
}

/* Makes the particles of BODY from index *next on, and moves it behind the last. */
static struct error *fill_body(const struct simulation *simulation, struct particles *particles,
                               const struct overlaps *overlaps, int body, int32_t *next)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct body_input *of = case_body(input, body);
    struct walk walk;
    struct error *error = walk_begin(&walk, overlaps, body, simulation->ranks);
    int64_t site;
    struct vec3 place;
    while (!error && walk_next(&walk, &site, &place)) {
        const int32_t i = (*next)++;
        struct point start;
        const char *key;
        walk_start(input, body, place, &start, particles->velocity[i], &key);
        particles->id[i] = particle_id(body, site);
        particles->body[i] = (uint16_t)body;
        particles->material[i] = (uint16_t)of->material_index;
        particles->mass[i] = start.density * walk.volume * walk_depth(input, place);
        particles->density[i] = start.density;
        particles->energy[i] = start.energy;
        particles->pressure[i] = start.pressure;
        memcpy(particles->deviator[i], &start.deviator, sizeof start.deviator);
        if (particles->history[HISTORY_plastic_heating])
            particles->history[HISTORY_plastic_heating][i] =
                material_start_heating(case_material(input, of->material_index)->material, &start);
        if (particles->history[HISTORY_lighting_time])
            particles->history[HISTORY_lighting_time][i] = detonation_arrival(input, body, place);
        if (particles->history[HISTORY_strength_scatter])
            particles->history[HISTORY_strength_scatter][i] =
                strength_scatter(case_material(input, of->material_index)->material,
                                 particles->id[i], walk.volume * walk_depth(input, place));
        if (strength_spreads(&case_material(input, of->material_index)->material->strength) &&
            is_outermost(input, of, place, pow(walk.row.volume, 1.0 / (double)input->dimension)))
            particles->history[HISTORY_damage][i] = 1.0; /* flaws of the surface */
        particles->position[i][0] = place.x;
        particles->position[i][1] = place.y;
        particles->position[i][2] = place.z;
    }
    walk_end(&walk);
    return error;
}

struct error *generate_particles(const struct simulation *simulation, struct particles *particles)
{
    const struct place *place = &simulation->problem->place;
    int64_t total;
    TRY(generate_count(place, simulation->ranks, &total));
    int32_t next = 0;
    struct error *error = particles_append(particles, (int32_t)total, &next);
    struct overlaps overlaps = {0};
    if (!error)
        error = overlaps_make(place, &overlaps);
    for (int body = 0; !error && body < place->input->bodies.count; body++)
        if (place_has(place, body))
            error = fill_body(simulation, particles, &overlaps, body, &next);
    overlaps_free(&overlaps);
    if (!error)
        error = particles_commit(particles);
    return ranks_agree(simulation->ranks, error);
}
