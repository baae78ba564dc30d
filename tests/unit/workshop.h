/* A case under construction in C, and its particles: for tests of what bodies become. */
#ifndef BOLIDE_TEST_WORKSHOP_H
#define BOLIDE_TEST_WORKSHOP_H

#include <stdlib.h>

#include "build_case.h"
#include "material/material.h"
#include "model/generate.h"
#include "model/particles/fill.h"
#include "populations.h"

enum { BODIES = 3, WALLS = 6 };

/* A case under construction, with room for a few bodies and walls. */
struct workshop {
    struct simulation_case input;
    char *material_names[1], *body_names[BODIES], *wall_names[WALLS];
    struct body_input bodies[BODIES];
    struct boundary_input walls[WALLS];
    struct material_input material;
    struct material iron;
};

static inline void open_workshop(struct workshop *w, int dimension, double resolution)
{
    *w = (struct workshop){.material_names = {"iron"},
                           .body_names = {"matrix", "grain", "flyer"},
                           .wall_names = {"floor", "lid", "left", "right", "front", "back"}};
    w->material.material = &w->iron;
    w->input.dimension = dimension;
    w->input.resolution = resolution;
    w->input.materials = (struct named_map){1, w->material_names, &w->material, {0}};
    w->input.bodies = (struct named_map){0, w->body_names, w->bodies, {0}};
    w->input.boundaries = (struct named_map){0, w->wall_names, w->walls, {0}};
}

static inline struct body_input *add_body(struct workshop *w, const char *shape, void *value)
{
    struct body_input *body = &w->bodies[w->input.bodies.count++];
    body->shape = shape_of(shape, value);
    body->lattice = lattice_of(LATTICE_SQUARE, NULL);
    body->resolution = NAN;
    body->start.density = 8.0;
    return body;
}

static inline void add_wall(struct workshop *w, int axis, enum face_side side, double at)
{
    w->walls[w->input.boundaries.count++] =
        (struct boundary_input){.axis = axis, .side = side, .at = at, .place = at};
}

/* The generated particles of RANK of SIZE; the simulation is destroyed by the caller. */
static inline struct error *generate(const struct workshop *w, const struct ranks *ranks,
                                     struct simulation *simulation)
{
    assert_null(simulation_create(&w->input, ranks, 1, simulation));
    assert_null(give_particles(simulation, 4.0 * largest_diameter(&w->input), NULL, 0));
    return generate_particles(simulation, particles_of(simulation));
}

static inline void assert_made(const struct workshop *w, const struct ranks *ranks,
                               struct simulation *simulation)
{
    struct error *error = generate(w, ranks, simulation);
    if (error)
        fail_msg("%s", error_message(error, 0));
}

/* Generation fails with COUNT messages, one of which holds WORDS. */
static inline void assert_refused(const struct workshop *w, int count, const char *words)
{
    const struct ranks alone = ranks_alone();
    struct simulation simulation;
    struct error *error = generate(w, &alone, &simulation);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_int_equal(error_count(error), count);
    bool found = false;
    for (int i = 0; i < count; i++)
        found = found || strstr(error_message(error, i), words);
    if (!found)
        fail_msg("\"%s\" does not tell of \"%s\"", error_message(error, 0), words);
    assert_int_equal(particles_of(&simulation)->count, 0);
    error_free(error);
    end_simulation(&simulation);
}

static inline int count_of_body(const struct particles *particles, int body)
{
    int count = 0;
    for (int i = 0; i < particles->count; i++)
        count += particles->body[i] == body;
    return count;
}

static inline int compare_ids(const void *a, const void *b)
{
    const uint64_t first = *(const uint64_t *)a, second = *(const uint64_t *)b;
    return (first > second) - (first < second);
}

/* One rank, twice, and three ranks make the same particles, each with an id of its own. */
static inline void assert_slices_agree(const struct workshop *w)
{
    enum { RUNS = 3, MOST = 20000 };
    static const int sizes[RUNS] = {1, 1, 3};
    uint64_t *ids[RUNS];
    int counts[RUNS] = {0};
    for (int run = 0; run < RUNS; run++) {
        ids[run] = malloc(MOST * sizeof *ids[run]);
        for (int rank = 0; rank < sizes[run]; rank++) {
            const struct ranks ranks = {rank, sizes[run], false};
            struct simulation simulation;
            assert_made(w, &ranks, &simulation);
            assert_true(counts[run] + particles_of(&simulation)->count <= MOST);
            for (int i = 0; i < particles_of(&simulation)->count; i++)
                ids[run][counts[run]++] = particles_of(&simulation)->id[i];
            end_simulation(&simulation);
        }
        qsort(ids[run], (size_t)counts[run], sizeof ids[run][0], compare_ids);
        assert_int_equal(counts[run], counts[0]);
        assert_memory_equal(ids[run], ids[0], (size_t)counts[0] * sizeof ids[0][0]);
    }
    for (int i = 1; i < counts[0]; i++)
        assert_true(ids[0][i - 1] < ids[0][i]);
    for (int run = 0; run < RUNS; run++)
        free(ids[run]);
}

#endif
