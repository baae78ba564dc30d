/* Neighbour rows against brute force: random points of very different reach, a gas that expands a
 * thousandfold, bodies in flight, walls and corners. */
#include "scene.h"

/* Of the near rows, where the skin is 0.15. */
static const double NEAR_SKIN = 0.05;

static void scatter(struct scene *scene, double size, double diameter, double spread,
                    struct dice *dice)
{
    struct particles *p = &scene->particles;
    double *d = scene_diameter(scene);
    for (int32_t i = 0; i < p->count; i++) {
        for (int axis = 0; axis < p->dimension; axis++)
            p->position[i][axis] = dice_between(dice, -0.5 * size, 0.5 * size);
        d[i] = diameter * pow(spread, dice_between(dice, 0.0, 1.0));
    }
}

static void rows_hold_all_pairs_of_points_whose_reach_differs_tenfold(void **state)
{
    (void)state;
    static const int count[] = {0, 400, 500, 500};
    static const double size[] = {0.0, 100.0, 12.0, 6.0};
    struct dice dice = {1};
    for (int dimension = 1; dimension <= 3; dimension++)
        for (int trial = 0; trial < 6; trial++) {
            struct scene scene;
            /* The cell of the largest, of the smallest, and of neither. */
            double cell = trial % 3 == 0 ? 2.4 * 1.15 : trial % 3 == 1 ? 0.25 : 9.0;
            scene_create(&scene, dimension, count[dimension], cell, 0.15);
            scatter(&scene, size[dimension], 0.1, 10.0, &dice);
            scene_build(&scene);
            assert_true(scene_judge(&scene, true) > count[dimension]);
            scene_destroy(&scene);
        }
}

static void rows_hold_all_pairs_for_any_skin(void **state)
{
    (void)state;
    struct dice dice = {2};
    for (double skin = 1e-6; skin < 1.0; skin = 4.0 * skin + 0.02) {
        struct scene scene;
        scene_create(&scene, 3, 300, 1.0, skin);
        scatter(&scene, 5.0, 0.2, 4.0, &dice);
        scene_build(&scene);
        scene_judge(&scene, true);
        scene_destroy(&scene);
    }
}

static void rows_are_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    struct dice dice = {3};
    struct scene scene;
    scene_create(&scene, 3, 500, 0.8, 0.15);
    scatter(&scene, 5.0, 0.1, 5.0, &dice);
    scene_build(&scene);
    struct neighbours one = scene.neighbours;
    for (int threads = 2; threads <= 4; threads++) {
        scene.neighbours = (struct neighbours){.skin = 0.15};
        scene.threads = threads;
        scene_build(&scene);
        for (int32_t i = 0; i < scene.particles.count; i++) {
            assert_int_equal(one.row[i].count, scene.neighbours.row[i].count);
            assert_memory_equal(neighbours_row(&one, i), neighbours_row(&scene.neighbours, i),
                                one.row[i].count * sizeof(uint32_t));
        }
        scene_judge(&scene, true);
        neighbours_free(&scene.neighbours);
    }
    scene.neighbours = one;
    scene_destroy(&scene);
}

static void rows_know_which_bodies_meet_under_a_law(void **state)
{
    (void)state;
    struct dice dice = {4};
    struct scene scene;
    scene_create(&scene, 2, 400, 0.5, 0.15);
    scene.groups = (struct contact_groups){scene_group_of_body, scene_law, SCENE_BODIES, NULL};
    scene.mirrors.low[0] = -2.5;
    scene.mirrors.high[1] = 2.5;
    scatter(&scene, 5.0, 0.1, 4.0, &dice);
    scene_build(&scene);
    scene_judge(&scene, true);
    unsigned parts = 0;
    for (int32_t i = 0; i < scene.particles.count; i++)
        for (uint32_t k = 0; k < scene.neighbours.row[i].count; k++)
            parts |= 1u << (neighbours_row(&scene.neighbours, i)[k] >> ENTRY_PART_SHIFT);
    assert_int_equal(parts, 15);
    scene_destroy(&scene);
}

static void points_at_one_place_and_points_far_off_are_found(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; dimension++) {
        struct scene scene;
        scene_create(&scene, dimension, 60, 0.5, 0.15);
        double *d = scene_diameter(&scene);
        static const double far[6] = {0.0, 1e7, -1e7, 1e12, -1e30, 12.5};
        for (int32_t i = 0; i < scene.particles.count; i++) {
            for (int axis = 0; axis < dimension; axis++)
                scene.particles.position[i][axis] = far[i % 6];
            d[i] = i % 2 ? 0.2 : 0.02;
        }
        scene_build(&scene);
        assert_int_equal(scene_judge(&scene, true), 60 * 9);
        scene_destroy(&scene);
    }
}

/* Beyond the cells that can be counted, on one axis or on all. */
static void a_case_far_from_the_origin_is_searched_alike(void **state)
{
    (void)state;
    struct dice dice = {5};
    for (int dimension = 1; dimension <= 3; dimension++)
        for (int axes = 1; axes <= dimension; axes++)
            for (double far = 1e2; fabs(far) < 1e12; far *= -100.0) {
                struct scene scene;
                scene_create(&scene, dimension, 300, 0.02, 0.15);
                scatter(&scene, 0.1, 1e-3, 8.0, &dice);
                for (int32_t i = 0; i < scene.particles.count; i++)
                    for (int axis = 0; axis < axes; axis++)
                        scene.particles.position[i][axis] += far;
                scene_build(&scene);
                scene_judge(&scene, false);
                scene_destroy(&scene);
            }
}

/* A blob whose lengths grow by FACTOR a step, each part at a rate of its own, in a haphazard
 * wind. */
static int expand(struct scene *scene, double factor, int steps, struct dice *dice)
{
    struct particles *p = &scene->particles;
    scene->neighbours.near_skin = NEAR_SKIN;
    for (int step = 0; step < steps; step++) {
        double *d = scene_diameter(scene);
        for (int32_t i = 0; i < p->count; i++) {
            for (int axis = 0; axis < p->dimension; axis++)
                p->position[i][axis] =
                    p->position[i][axis] * factor + 0.02 * d[i] * dice_between(dice, -1.0, 1.0);
            d[i] *= 1.0 + (factor - 1.0) * (0.5 + (double)(p->id[i] % 11) / 10.0);
        }
        scene_refresh(scene);
        scene_judge(scene, false);
    }
    return (int)scene->neighbours.builds;
}

static void rows_hold_while_a_gas_expands_a_thousandfold(void **state)
{
    (void)state;
#if defined(BOLIDE_SANITIZE)
    static const int count[] = {0, 40, 60, 60};
#else
    static const int count[] = {0, 60, 120, 150};
#endif
    struct dice dice = {6};
    for (int dimension = 1; dimension <= 3; dimension++) {
        struct scene scene;
        double d = 1.0;
        scene_create(&scene, dimension, count[dimension], 2.4 * 1.15 * d, 0.15);
        scatter(&scene, pow(count[dimension], 1.0 / dimension) * d, 0.8 * d, 1.25, &dice);
        const double factor = 1.01;
        int steps = (int)ceil(log(1000.0) / dimension / log(factor));
        int builds = expand(&scene, factor, steps, &dice);
        /* In 1-D a block is 64 cells long, and its ends move apart by more than the skin at each
         * step. */
        print_message("%d-D: %d builds in %d steps\n", dimension, builds, steps);
        assert_true(dimension == 1 || builds < steps);
        scene_destroy(&scene);
    }
}

static void rows_hold_while_a_gas_collapses(void **state)
{
    (void)state;
    struct dice dice = {7};
    for (int dimension = 1; dimension <= 3; dimension++) {
        struct scene scene;
        scene_create(&scene, dimension, 80, 2.4 * 1.15, 0.15);
        scatter(&scene, 3.0 * pow(80, 1.0 / dimension), 0.8, 1.25, &dice);
        expand(&scene, 0.98, 120, &dice);
        scene_destroy(&scene);
    }
}

/* Nothing moves, but supports grow, each at its own rate. */
static void rows_hold_while_particles_swell_in_place(void **state)
{
    (void)state;
    struct dice dice = {11};
    for (int dimension = 1; dimension <= 3; dimension++) {
        struct scene scene;
        scene_create(&scene, dimension, 150, 2.4 * 1.15, 0.15);
        scatter(&scene, 2.0 * pow(150, 1.0 / dimension), 0.5, 2.0, &dice);
        scene.mirrors.low[0] = -pow(150, 1.0 / dimension) - 0.3;
        scene.neighbours.near_skin = NEAR_SKIN;
        for (int step = 0; step < 150; step++) {
            double *d = scene_diameter(&scene);
            for (int32_t i = 0; i < scene.particles.count; i++)
                d[i] *= 1.0 + 0.001 * (double)(scene.particles.id[i] % 13);
            scene_refresh(&scene);
            scene_judge(&scene, false);
        }
        assert_true(scene.neighbours.builds < 75);
        scene_destroy(&scene);
    }
}

/* A lattice that shivers slowly: near rows outlive several steps, and are shorter than the rows. */
static void near_rows_are_found_from_the_rows_and_hold_like_these(void **state)
{
    (void)state;
    struct dice dice = {12};
    struct scene scene;
    scene_create(&scene, 3, 216, 2.4 * 1.3, 0.3);
    scene.neighbours.near_skin = NEAR_SKIN;
    struct particles *p = &scene.particles;
    for (int32_t i = 0; i < p->count; i++) {
        const int at[3] = {i % 6, i / 6 % 6, i / 36};
        for (int axis = 0; axis < 3; axis++)
            p->position[i][axis] = at[axis] + dice_between(&dice, -0.1, 0.1);
        scene_diameter(&scene)[i] = 1.0;
    }
    scene.mirrors.high[1] = 6.0;
    int64_t rows = 0, near_rows = 0;
    int found = 0;
    for (int step = 0; step < 60; step++) {
        for (int32_t i = 0; i < p->count; i++)
            for (int axis = 0; axis < 3; axis++)
                p->position[i][axis] += 0.01 * dice_between(&dice, -1.0, 1.0);
        scene_refresh(&scene);
        scene_judge(&scene, false);
        assert_true(scene.neighbours.near);
        found += scene.neighbours.near_steps == 1;
        for (int32_t i = 0; i < p->count; i++) {
            int count;
            neighbours_walk(&scene.neighbours, i, &count);
            rows += scene.neighbours.row[i].count;
            near_rows += count;
        }
    }
    print_message("%d near rows of %d builds in 60 steps\n", found, (int)scene.neighbours.builds);
    assert_true(near_rows < rows - rows / 8);
    assert_true(scene.neighbours.builds < found && found < 25);
    scene_destroy(&scene);
}

/* Two blocks of particles at speeds of SPEED; returns builds over STEPS steps of 1. */
static int64_t fly(struct scene *scene, const double speed[2], int steps)
{
    struct particles *p = &scene->particles;
    scene->neighbours.near_skin = NEAR_SKIN;
    for (int step = 0; step < steps; step++) {
        for (int32_t i = 0; i < p->count; i++)
            p->position[i][0] += speed[p->body[i] % 2];
        scene_refresh(scene);
        scene_judge(scene, false);
    }
    return scene->neighbours.builds;
}

static void two_bodies(struct scene *scene, int dimension, double distance)
{
    struct dice dice = {8};
    scene_create(scene, dimension, 160, 2.4 * 1.15, 0.15);
    struct particles *p = &scene->particles;
    double *d = scene_diameter(scene);
    double size = pow(80, 1.0 / dimension);
    for (int32_t i = 0; i < p->count; i++) {
        p->body[i] = (uint16_t)(i % 2);
        for (int axis = 0; axis < dimension; axis++)
            p->position[i][axis] = dice_between(&dice, 0.0, size);
        p->position[i][0] += i % 2 ? distance : 0.0;
        d[i] = dice_between(&dice, 0.9, 1.0);
    }
}

static void common_motion_costs_no_build(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; dimension++) {
        struct scene scene;
        two_bodies(&scene, dimension, 500.0);
        assert_int_equal(fly(&scene, (double[]){3.0, 3.0}, 60), 1);
        scene_destroy(&scene);
    }
}

static void bodies_far_apart_that_fly_at_each_other_cost_few_builds(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; dimension++) {
        struct scene scene;
        two_bodies(&scene, dimension, 500.0);
        int64_t builds = fly(&scene, (double[]){0.25, -0.25}, 200);
        print_message("%d-D: %d builds in 200 steps of a fifth of the support\n", dimension,
                      (int)builds);
        assert_true(builds <= 25);
        scene_destroy(&scene);
    }
}

static void rows_hold_while_bodies_meet_and_pass_through_each_other(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; dimension++) {
        struct scene scene;
        double size = pow(80, 1.0 / dimension);
        two_bodies(&scene, dimension, size + 20.0);
        int steps = (int)minimum(size + 30.0, 50.0) * 5;
        int64_t builds = fly(&scene, (double[]){0.1, -0.1}, steps);
        print_message("%d-D: %d builds in %d steps\n", dimension, (int)builds, steps);
        assert_true(builds <= steps);
        scene_destroy(&scene);
    }
}

/* Particles of different size bounce about in a box of mirrors. */
static void bounce(int dimension, int count, int steps, unsigned walls, struct dice *dice)
{
    struct scene scene;
    const double size = 6.0;
    scene_create(&scene, dimension, count, 2.4 * 1.15 * 0.6, 0.15);
    scatter(&scene, size, 0.2, 3.0, dice);
    scene.neighbours.near_skin = NEAR_SKIN;
    struct particles *p = &scene.particles;
    for (int axis = 0; axis < dimension; axis++) {
        if (walls >> (2 * axis) & 1)
            scene.mirrors.low[axis] = -0.5 * size;
        if (walls >> (2 * axis + 1) & 1)
            scene.mirrors.high[axis] = 0.5 * size;
    }
    double common[3] = {0.07, -0.05, 0.06};
    for (int32_t i = 0; i < p->count; i++)
        for (int axis = 0; axis < dimension; axis++)
            p->velocity[i][axis] = common[axis] + dice_between(dice, -0.02, 0.02);
    for (int step = 0; step < steps; step++) {
        double *d = scene_diameter(&scene);
        for (int32_t i = 0; i < p->count; i++) {
            for (int axis = 0; axis < dimension; axis++) {
                double *x = &p->position[i][axis], *u = &p->velocity[i][axis];
                *x += *u;
                if (fabs(*x) > 0.5 * size) {
                    *x = copysign(size, *x) - *x;
                    *u = -*u;
                }
            }
            d[i] *= 1.0 + 0.004 * sin(0.05 * step + (double)(p->id[i] % 7));
        }
        scene_refresh(&scene);
        scene_judge(&scene, false);
    }
    assert_true(scene.neighbours.builds < steps + 1);
    scene_destroy(&scene);
}

static void rows_hold_the_images_behind_walls_and_corners(void **state)
{
    (void)state;
#if defined(BOLIDE_SANITIZE)
    enum { STEPS = 12 };
#else
    enum { STEPS = 40 };
#endif
    struct dice dice = {9};
    for (unsigned walls = 1; walls < 4; walls++)
        bounce(1, 40, STEPS, walls, &dice);
    for (unsigned walls = 1; walls < 16; walls += 2)
        bounce(2, 60, STEPS, walls, &dice);
    bounce(3, 60, STEPS, 0x15, &dice);
    bounce(3, 60, STEPS, 0x2a, &dice);
    bounce(3, 60, STEPS, 0x3f, &dice);
}

/* No pair is nearer to each other, by any number of periods, than the rows of I show of J. */
static void judge_distance(const struct scene *scene, int32_t i, int32_t j, unsigned periodic)
{
    const double *diameter = particles_field(&scene->particles, "diameter");
    const double support = scene->reach.smoothing * (diameter[i] + diameter[j]);
    const double *a = scene->particles.position[i], *b = scene->particles.position[j];
    double nearest = 0.0, shown = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double apart = a[axis] - b[axis];
        if (periodic >> axis & 1)
            apart = periodic_nearest(&scene->mirrors, axis, apart, 0.0);
        nearest += square(apart);
    }
    for (int image = 0; image < IMAGE_CODES; image++)
        if (scene_has_image(scene, image))
            shown = minimum(shown, scene_distance2(scene, i, j, image));
    if (sqrt(nearest) < support)
        assert_true(shown == nearest || i == j);
}

/* Particles stream through periodic faces, with shear, those of other axes bounce off walls. */
static void stream(int dimension, int count, int steps, unsigned periodic, double random,
                   struct dice *dice)
{
    struct scene scene;
    const double size = 6.0;
    scene_create(&scene, dimension, count, 2.4 * 1.15 * 0.6, 0.15);
    scatter(&scene, size, 0.2, 3.0, dice);
    scene.neighbours.near_skin = NEAR_SKIN;
    struct particles *p = &scene.particles;
    for (int axis = 0; axis < dimension; axis++) {
        scene.mirrors.low[axis] = -0.5 * size;
        scene.mirrors.high[axis] = 0.5 * size;
        if (periodic >> axis & 1)
            images_make_periodic(&scene.mirrors, axis, -0.5 * size, 0.5 * size);
    }
    for (int32_t i = 0; i < p->count; i++)
        for (int axis = 0; axis < dimension; axis++)
            p->velocity[i][axis] = 0.07 - 0.02 * axis + dice_between(dice, -random, random);
    for (int step = 0; step < steps; step++) {
        for (int32_t i = 0; i < p->count; i++)
            for (int axis = 0; axis < dimension; axis++) {
                double *x = &p->position[i][axis], *u = &p->velocity[i][axis];
                *x += *u;
                if (periodic >> axis & 1) {
                    *x = periodic_inside(&scene.mirrors, axis,
                                         periodic_rounded(&scene.mirrors, axis, *x));
                    assert_true(*x >= -0.5 * size && *x < 0.5 * size);
                } else if (fabs(*x) > 0.5 * size) {
                    *x = copysign(size, *x) - *x;
                    *u = -*u;
                }
            }
        scene_refresh(&scene);
        scene_judge(&scene, false);
        for (int32_t i = 0; i < p->count && step % 8 == 0; i++)
            for (int32_t j = 0; j < p->count; j++)
                judge_distance(&scene, i, j, periodic);
    }
    if (random == 0.0)
        assert_int_equal(scene.neighbours.builds, 1);
    scene_destroy(&scene);
}

static void rows_hold_across_periodic_faces(void **state)
{
    (void)state;
#if defined(BOLIDE_SANITIZE)
    enum { STEPS = 12 };
#else
    enum { STEPS = 40 };
#endif
    struct dice dice = {11};
    stream(1, 40, STEPS, 1, 0.004, &dice);
    for (unsigned periodic = 1; periodic < 4; periodic++)
        stream(2, 60, STEPS, periodic, 0.01, &dice);
    for (unsigned periodic = 1; periodic < 8; periodic += 2)
        stream(3, 60, STEPS, periodic, 0.02, &dice);
}

/* Not even of particles that go round. */
static void common_motion_through_periodic_faces_costs_no_build(void **state)
{
    (void)state;
    struct dice dice = {12};
    stream(1, 40, 100, 1, 0.0, &dice);
    stream(2, 60, 100, 3, 0.0, &dice);
    stream(3, 60, 100, 7, 0.0, &dice);
}

/* A body flies towards a wall, its own image towards it: the approach is twice the motion. */
static void rows_hold_when_a_body_meets_its_own_image(void **state)
{
    (void)state;
    for (int side = 0; side < 2; side++)
        for (int dimension = 1; dimension <= 3; dimension++) {
            struct scene scene;
            two_bodies(&scene, dimension, 0.0);
            double size = pow(80, 1.0 / dimension);
            double speed = side ? 0.1 : -0.1;
            *(side ? &scene.mirrors.high[0] : &scene.mirrors.low[0]) = side ? size + 15.0 : -15.0;
            fly(&scene, (double[]){speed, speed}, 150);
            assert_true(scene.neighbours.ghosts.count > 0);
            scene_destroy(&scene);
        }
}

static void a_build_takes_back_what_it_holds(void **state)
{
    (void)state;
    struct dice dice = {10};
    struct scene scene;
    scene_create(&scene, 2, 200, 0.5, 0.15);
    scatter(&scene, 5.0, 0.1, 4.0, &dice);
    scene_build(&scene);
    size_t bytes = neighbours_bytes(&scene.neighbours);
    assert_true(bytes > 200 * sizeof(struct row));
    for (int k = 0; k < 5; k++)
        scene_build(&scene);
    assert_int_equal(neighbours_bytes(&scene.neighbours), bytes);
    assert_int_equal(scene.neighbours.builds, 6);
    scene_destroy(&scene);
}

static void an_empty_store_has_no_rows(void **state)
{
    (void)state;
    struct scene scene;
    scene_create(&scene, 3, 0, 0.5, 0.15);
    scene_build(&scene);
    scene_refresh(&scene);
    assert_int_equal(scene.neighbours.ghosts.count, 0);
    scene_destroy(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_hold_all_pairs_of_points_whose_reach_differs_tenfold),
        cmocka_unit_test(rows_hold_all_pairs_for_any_skin),
        cmocka_unit_test(rows_are_the_same_for_any_number_of_threads),
        cmocka_unit_test(rows_know_which_bodies_meet_under_a_law),
        cmocka_unit_test(points_at_one_place_and_points_far_off_are_found),
        cmocka_unit_test(a_case_far_from_the_origin_is_searched_alike),
        cmocka_unit_test(rows_hold_while_a_gas_expands_a_thousandfold),
        cmocka_unit_test(rows_hold_while_a_gas_collapses),
        cmocka_unit_test(rows_hold_while_particles_swell_in_place),
        cmocka_unit_test(near_rows_are_found_from_the_rows_and_hold_like_these),
        cmocka_unit_test(common_motion_costs_no_build),
        cmocka_unit_test(bodies_far_apart_that_fly_at_each_other_cost_few_builds),
        cmocka_unit_test(rows_hold_while_bodies_meet_and_pass_through_each_other),
        cmocka_unit_test(rows_hold_the_images_behind_walls_and_corners),
        cmocka_unit_test(rows_hold_across_periodic_faces),
        cmocka_unit_test(common_motion_through_periodic_faces_costs_no_build),
        cmocka_unit_test(rows_hold_when_a_body_meets_its_own_image),
        cmocka_unit_test(a_build_takes_back_what_it_holds),
        cmocka_unit_test(an_empty_store_has_no_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
