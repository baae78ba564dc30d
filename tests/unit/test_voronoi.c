/* Voronoi grains: volumes, gaps, and that they depend on the seed alone. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "sample.h"
#include "shape/tessellation.h"

static const struct shape_voronoi plane = {.from = VECTOR(-1.0, 2.0),
                                           .to = VECTOR(1.0, 3.0),
                                           .size = 0.1,
                                           .gap = NAN,
                                           .fraction = NAN,
                                           .picked = 1.0,
                                           .seed = 1};
static const struct shape_voronoi block = {.from = VECTOR(0.0, 0.0, 0.0),
                                           .to = VECTOR(1.0, 1.0, 2.0),
                                           .size = 0.2,
                                           .gap = NAN,
                                           .fraction = NAN,
                                           .picked = 1.0,
                                           .seed = 1};

static struct one_of prepared(struct shape_voronoi *grains)
{
    const struct one_of shape = shape_of("voronoi", grains);
    const char *text = shape_wrong(&shape, grains->from.count);
    if (text)
        fail_msg("%s", text);
    return shape;
}

static double box_volume(const struct shape_voronoi *grains)
{
    double volume = 1.0;
    for (int axis = 0; axis < grains->from.count; axis++)
        volume *= grains->to.at[axis] - grains->from.at[axis];
    return volume;
}

static void check_volume(struct shape_voronoi grains, double fraction, int points, double within)
{
    for (grains.seed = 1; grains.seed <= 2; grains.seed++) {
        const struct one_of shape = prepared(&grains);
        assert_near(sampled_volume(&shape, grains.from.count, points),
                    fraction * box_volume(&grains), within);
        free(grains.grains);
        grains.grains = NULL;
    }
}

static void grains_without_a_gap_fill_the_box(void **state)
{
    (void)state;
    check_volume(plane, 1.0, 200, 1e-12);
    check_volume(block, 1.0, 40, 1e-12);
}

static void a_gap_leaves_the_fraction_that_is_wanted(void **state)
{
    (void)state;
    struct shape_voronoi grains = plane;
    grains.periodic = (struct name_list){2, (char *[]){"x", "y"}};
    grains.fraction = 0.9;
    check_volume(grains, 0.9, 701, 5e-3);
    grains.fraction = 0.3;
    check_volume(grains, 0.3, 701, 5e-3);
    grains.fraction = 1e-18; /* hardly anything, and no crash */
    const struct one_of shape = prepared(&grains);
    assert_true(sampled_volume(&shape, 2, 100) < 1e-2);
    free(grains.grains);
    grains = block;
    grains.fraction = 0.7;
    check_volume(grains, 0.7, 101, 5e-3);
}

/* By a slow search: the distance of the planes half-way between the nearest site and all others. */
static bool is_in_grain(const struct tessellation *grains, const double at[3])
{
    double nearest = INFINITY, own[3] = {0.0};
    for (int pass = 0; pass < 2; pass++)
        for (int64_t grain = 0; grain < grains->count; grain++)
            for (int image = 0; image < 9; image++) {
                const double site[2] = {
                    grains->site[grain][0] + (image % 3 - 1) * grains->extent[0],
                    grains->site[grain][1] + (image / 3 - 1) * grains->extent[1]};
                const double distance_square = square(site[0] - at[0]) + square(site[1] - at[1]);
                const double apart = hypot(site[0] - own[0], site[1] - own[1]);
                if (pass == 0 && distance_square < nearest) {
                    nearest = distance_square;
                    own[0] = site[0];
                    own[1] = site[1];
                } else if (pass == 1 && apart > 1e-9 &&
                           (distance_square - nearest) / (2.0 * apart) < grains->half_gap) {
                    return false;
                }
            }
    return true;
}

static void a_slow_search_finds_the_same_grains(void **state)
{
    (void)state;
    struct shape_voronoi grains = plane;
    grains.gap = 0.05;
    grains.periodic = (struct name_list){2, (char *[]){"x", "y"}};
    const struct one_of shape = prepared(&grains);
    uint64_t random = 1;
    for (int i = 0; i < 3000; i++) {
        const double at[3] = {2.0 * random_number(&random) - 1.0, random_number(&random) + 2.0,
                              0.0};
        assert_int_equal(shape_inside(&shape, vec3_make(at[0], at[1], 0.0)),
                         is_in_grain(grains.grains, at));
    }
    free(grains.grains);
}

/* 200 grains of 0.005 of the box each: half a grain is 0.0025. */
static void a_fraction_of_the_grains_can_be_picked(void **state)
{
    (void)state;
    struct shape_voronoi grains = plane;
    grains.picked = 0.3;
    check_volume(grains, 0.3, 400, 1e-2);
    grains.size = 0.02;
    check_volume(grains, 0.3, 1000, 5e-3);
}

static void grains_follow_from_the_seed_alone(void **state)
{
    (void)state;
    struct shape_voronoi first = plane, again = plane, other = plane;
    other.seed = 2;
    prepared(&first);
    prepared(&again);
    prepared(&other);
    const size_t bytes = (size_t)first.grains->count * sizeof *first.grains->site;
    assert_memory_equal(first.grains->site, again.grains->site, bytes);
    assert_memory_not_equal(first.grains->site, other.grains->site, bytes);
    assert_int_equal(first.grains->count, 200);
    free(first.grains);
    free(again.grains);
    free(other.grains);
}

static void grains_that_cannot_be_are_refused(void **state)
{
    (void)state;
    struct shape_voronoi grains = plane;
    grains.size = 0.4;
    assert_wrong("voronoi", &grains, 2, "three grains wide");
    grains.size = 1e-6;
    assert_wrong("voronoi", &grains, 2, "50000 grains");
    grains = plane;
    grains.gap = grains.fraction = 0.01;
    assert_wrong("voronoi", &grains, 2, "`gap` or `fraction`");
    grains = plane;
    assert_wrong("voronoi", &grains, 1, "two or three dimensions");
    assert_wrong("voronoi", &grains, 3, "as many numbers");
    grains.periodic = (struct name_list){1, (char *[]){"z"}};
    assert_wrong("voronoi", &grains, 2, "axes");
    grains = plane;
    grains.to.at[1] = 2.0;
    assert_wrong("voronoi", &grains, 2, "below that of `to`");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grains_without_a_gap_fill_the_box),
        cmocka_unit_test(a_gap_leaves_the_fraction_that_is_wanted),
        cmocka_unit_test(a_slow_search_finds_the_same_grains),
        cmocka_unit_test(a_fraction_of_the_grains_can_be_picked),
        cmocka_unit_test(grains_follow_from_the_seed_alone),
        cmocka_unit_test(grains_that_cannot_be_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
