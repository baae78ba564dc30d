/* Random particles with reaches of their own, walls and contact groups, and a brute-force judge of
 * their neighbour rows. */
#ifndef BOLIDE_TEST_SCENE_H
#define BOLIDE_TEST_SCENE_H

#include "dice.h"

#include <stdlib.h>
#include <string.h>

#include "model/particles/population.h"
#include "parallel/periodic.h"
#include "particle/neighbours.h"
#include "sph/prune.h"

enum { SCENE_BODIES = 3 };

struct scene {
    struct particles particles;
    struct reach reach;
    struct mirrors mirrors;
    struct contact_groups groups;
    struct neighbours neighbours;
    int threads;
    double largest_reach;
};

static const uint8_t scene_group_of_body[SCENE_BODIES] = {0, 1, 2};
static const uint8_t scene_law[SCENE_BODIES * SCENE_BODIES] = {0, 0, 1, 0, 0, 3, 1, 3, 0};
static const uint8_t scene_one_group[SCENE_BODIES] = {0, 0, 0};
static const uint8_t scene_no_law[1] = {0};

static inline const struct contact_groups *scene_no_groups(void)
{
    static const struct contact_groups none = {scene_one_group, scene_no_law, 1, NULL};
    return &none;
}

static inline double *scene_diameter(struct scene *scene)
{
    return particles_field(&scene->particles, "diameter");
}

/* COUNT particles without places. CELL should hold the largest support, as the solver sees to. */
static inline void scene_create(struct scene *scene, int dimension, int count, double cell,
                                double skin)
{
    static const struct field_declaration more[] = {
        {"diameter", "m", "particle diameter", NUMBER_DOUBLE, 1, FIELD_DERIVED}};
    *scene = (struct scene){.threads = 1, .groups = *scene_no_groups()};
    scene->neighbours.skin = skin;
    scene->reach.smoothing = 1.2;
    for (int axis = 0; axis < 3; axis++)
        scene->mirrors.low[axis] = scene->mirrors.high[axis] = NAN;
    assert_success(particles_create(dimension, cell, more, 1, &scene->particles));
    int32_t first;
    assert_success(particles_append(&scene->particles, count, &first));
    for (int32_t i = 0; i < count; i++) {
        scene->particles.body[i] = (uint16_t)(i % SCENE_BODIES);
        scene->particles.id[i] = particle_id(i % SCENE_BODIES, (i * 7919) % 10007);
    }
    scene->particles.count = count; /* committed with their places, by the first sort */
    scene->particles.pending = 0;
}

static inline void scene_destroy(struct scene *scene)
{
    neighbours_free(&scene->neighbours);
    particles_destroy(&scene->particles);
}

static inline void scene_sort(struct scene *scene)
{
    assert_success(particles_sort(&scene->particles));
    scene->reach.diameter = scene_diameter(scene);
}

static inline void scene_build(struct scene *scene)
{
    scene_sort(scene);
    assert_success(neighbours_build(&scene->neighbours, &scene->particles, scene->reach,
                                    &scene->mirrors, &scene->groups, scene->threads));
}

/* Place of particle I, or of its IMAGE, where the rows have seen it: a particle that has gone round
 * since then is outside.
 * */
static inline struct vec3 scene_place(const struct scene *scene, int32_t i, image_code image)
{
    const struct neighbours *n = &scene->neighbours;
    double at[3];
    for (int axis = 0; axis < 3; axis++) {
        at[axis] = scene->particles.position[i][axis];
        if (images_repeat(&scene->mirrors, axis))
            at[axis] = periodic_nearest(&scene->mirrors, axis, at[axis], n->origin[i][axis]);
    }
    return image_position(&scene->mirrors, image, vec3_make(at[0], at[1], at[2]));
}

/* Finds the near rows from records of places and diameters. */
static inline void scene_prune(struct scene *scene)
{
    enum { STRIDE = 8 };
    const struct particles *p = &scene->particles;
    struct neighbours *n = &scene->neighbours;
    const int32_t count = p->count + n->ghosts.count;
    double *record = calloc((size_t)count, STRIDE * sizeof *record);
    for (int32_t i = 0; i < count; i++) {
        const int32_t j = i < p->count ? i : n->ghosts.source[i - p->count];
        const image_code image = i < p->count ? 0 : n->ghosts.image[i - p->count];
        const struct vec3 at = scene_place(scene, j, image);
        const double place[3] = {at.x, at.y, at.z};
        memcpy(record + (size_t)i * STRIDE, place, (size_t)p->dimension * sizeof *place);
        record[i * STRIDE + p->dimension] = scene->reach.diameter[j];
    }
    const struct prune_loop loop = {record, STRIDE, p->dimension, NULL, scene->reach.smoothing, n};
    for (int32_t b = 0; b < p->blocks; b++)
        prune_loop_run(&loop, p->block, b);
    n->prune = false;
    free(record);
}

/* What the solver does every step. */
static inline void scene_refresh(struct scene *scene)
{
    scene->reach.diameter = scene_diameter(scene);
    if (!neighbours_hold(&scene->neighbours, &scene->particles, scene->reach, scene->threads))
        scene_build(scene);
    if (scene->neighbours.prune)
        scene_prune(scene);
}

static inline bool scene_has_image(const struct scene *scene, int image)
{
    for (int axis = 0; axis < 3; axis++, image /= 3)
        if ((image % 3 == 1 && isnan(scene->mirrors.low[axis])) ||
            (image % 3 == 2 && isnan(scene->mirrors.high[axis])))
            return false;
    return true;
}

static inline double scene_distance2(const struct scene *scene, int32_t i, int32_t j, int image)
{
    const struct vec3 apart =
        vec3_sub(scene_place(scene, j, (image_code)image), scene_place(scene, i, 0));
    return vec3_dot(apart, apart);
}

/* Marks in SEEN (count x 27) the neighbours that a loop walks for I, checking order, parts and that
 * none comes twice. */
static inline void scene_mark_row(const struct scene *scene, int32_t i, uint8_t *seen)
{
    const struct particles *p = &scene->particles;
    const struct neighbours *n = &scene->neighbours;
    int count;
    const uint32_t *entry = neighbours_walk(n, i, &count);
    uint64_t last_part = 0, last_id = 0;
    int last_order = -1;
    memset(seen, 0, (size_t)p->count * IMAGE_CODES);
    for (int k = 0; k < count; k++) {
        int32_t j = (int32_t)(entry[k] & ENTRY_INDEX);
        uint64_t part = entry[k] >> ENTRY_PART_SHIFT;
        int image = 0, order;
        bool walled = false;
        if (j >= p->count) {
            assert_true(j - p->count < n->ghosts.count);
            image = n->ghosts.image[j - p->count];
            j = n->ghosts.source[j - p->count];
        }
        order = image_order(&scene->mirrors, (image_code)image);
        for (int axis = 0; axis < 3; axis++)
            walled |= image_along((image_code)image, axis) && !images_repeat(&scene->mirrors, axis);
        bool after = k == 0 || part > last_part ||
                     (part == last_part &&
                      (p->id[j] > last_id || (p->id[j] == last_id && order > last_order)));
        assert_true(after);
        last_part = part;
        last_id = p->id[j];
        last_order = order;
        const struct contact_groups *g = &scene->groups;
        bool law = g->law[g->of_body[p->body[i]] * g->groups + g->of_body[p->body[j]]] != 0;
        assert_int_equal((part & PART_LAW) != 0, law);
        assert_int_equal((part & PART_IMAGE) != 0, walled);
        assert_false(j == i && image == 0);
        assert_int_equal(seen[j * IMAGE_CODES + image], 0);
        seen[j * IMAGE_CODES + image] = 1;
    }
}

/* Every pair within support, images included, is in the rows; FRESH: and nothing lies beyond the
 * support and the skin. Returns the number of pairs within support. */
static inline int64_t scene_judge(const struct scene *scene, bool fresh)
{
    const struct particles *p = &scene->particles;
    const double *diameter = particles_field(p, "diameter");
    uint8_t *seen = malloc((size_t)p->count * IMAGE_CODES);
    int images[IMAGE_CODES], image_count = 0;
    for (int image = 0; image < IMAGE_CODES; image++)
        if (scene_has_image(scene, image))
            images[image_count++] = image;
    int64_t pairs = 0;
    for (int32_t i = 0; i < p->count; i++) {
        scene_mark_row(scene, i, seen);
        for (int32_t j = 0; j < p->count; j++)
            for (int k = 0; k < image_count; k++) {
                if (i == j && images[k] == 0)
                    continue;
                double support = scene->reach.smoothing * (diameter[i] + diameter[j]);
                double distance = sqrt(scene_distance2(scene, i, j, images[k]));
                bool listed = seen[j * IMAGE_CODES + images[k]];
                double wide = (1.0 + scene->neighbours.skin) * support;
                if (distance < support) {
                    if (!listed)
                        print_error("%d misses %d, image %d, at %g of support\n", i, j, images[k],
                                    distance / support);
                    assert_true(listed);
                    pairs++;
                }
                if (fresh && distance < wide * (1.0 - 1e-12))
                    assert_true(listed);
                if (fresh && distance > wide * (1.0 + 1e-12))
                    assert_false(listed);
            }
    }
    free(seen);
    return pairs;
}

#endif
