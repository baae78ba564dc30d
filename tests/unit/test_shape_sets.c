/* Shapes made of shapes: joined, cut, repeated, turned. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "sample.h"

static void sites_fill_the_volume_of_a_union_once(void **state)
{
    (void)state;
    struct shape_box first = {VECTOR(0.0, 0.0), VECTOR(1.0, 1.0)};
    struct shape_box second = {VECTOR(0.5, 0.5), VECTOR(2.0, 2.0)};
    struct one_of items[2] = {shape_of("box", &first), shape_of("box", &second)};
    struct shape_union both = {{2, items}};
    const struct one_of shape = shape_of("union", &both);
    assert_near(sampled_volume(&shape, 2, 100), 1.0 + 2.25 - 0.25, 1e-12);
}

static void a_difference_leaves_its_holes_empty(void **state)
{
    (void)state;
    struct shape_box block = {VECTOR(-1.0, -1.0), VECTOR(1.0, 1.0)};
    struct shape_ball pore = {VECTOR(0.0, 0.0), 0.5}, bite = {VECTOR(1.0, 1.0), 0.4};
    struct one_of items[3] = {shape_of("box", &block), shape_of("ball", &pore),
                              shape_of("ball", &bite)};
    struct shape_difference rest = {{3, items}};
    const struct one_of shape = shape_of("difference", &rest);
    assert_near(sampled_volume(&shape, 2, 400), 4.0 - M_PI * (0.25 + 0.04), 5e-4);
    assert_false(shape_inside(&shape, vec3_make(0.0, 0.0, 0.0)));
    const struct bounds bounds = shape_bounds(&shape);
    assert_true(bounds.low.x == -1.0 && bounds.high.y == 1.0);
}

static void an_intersection_is_what_its_shapes_have_in_common(void **state)
{
    (void)state;
    struct shape_ball left = {VECTOR(0.0, 0.0), 1.0}, right = {VECTOR(1.0, 0.0), 1.0};
    struct one_of items[2] = {shape_of("ball", &left), shape_of("ball", &right)};
    struct shape_intersection lens = {{2, items}};
    const struct one_of shape = shape_of("intersection", &lens);
    assert_near(sampled_volume(&shape, 2, 500), 2.0 * M_PI / 3.0 - 0.5 * sqrt(3.0), 1e-3);
    const struct bounds bounds = shape_bounds(&shape);
    assert_true(bounds.low.x == 0.0 && bounds.high.x == 1.0 && bounds.high.y == 1.0);
}

static void a_half_space_cuts_what_it_meets_in_two(void **state)
{
    (void)state;
    struct shape_ball ball = {VECTOR(0.0, 0.0, 0.0), 1.0};
    struct shape_half_space side[2] = {{VECTOR(0.1, 0.1, 0.1), VECTOR(1.0, 2.0, -0.5)},
                                       {VECTOR(0.1, 0.1, 0.1), VECTOR(-1.0, -2.0, 0.5)}};
    double volume[2];
    for (int i = 0; i < 2; i++) {
        struct one_of items[2] = {shape_of("half_space", &side[i]), shape_of("ball", &ball)};
        struct shape_intersection part = {{2, items}};
        const struct one_of shape = shape_of("intersection", &part);
        assert_null(shape_wrong(&shape, 3));
        volume[i] = sampled_volume(&shape, 3, 120);
    }
    /* The cap beyond the plane at distance d: pi (1 - d)^2 (2 + d)/3. */
    const double d = 0.25 / sqrt(5.25), cap = M_PI * square(1.0 - d) * (2.0 + d) / 3.0;
    assert_near(volume[0], 4.0 / 3.0 * M_PI - cap, 2e-3);
    assert_near(volume[1], cap, 2e-3);

    struct shape_half_space above = {VECTOR(0.0, 0.25), VECTOR(0.0, -3.0)};
    struct shape_box square_box = {VECTOR(-1.0, -1.0), VECTOR(1.0, 1.0)};
    struct one_of halves[2] = {shape_of("box", &square_box), shape_of("half_space", &above)};
    struct shape_intersection upper = {{2, halves}};
    const struct one_of shape = shape_of("intersection", &upper);
    const struct bounds bounds = shape_bounds(&shape), endless = shape_bounds(&halves[1]);
    assert_true(bounds.low.y == 0.25 && bounds.high.y == 1.0 && bounds.low.x == -1.0);
    assert_true(bounds_finite(&bounds) && !bounds_finite(&endless));
    assert_true(shape_inside(&shape, vec3_make(0.0, 0.25, 0.0)));
    above.normal.at[1] = 3.0;
    assert_false(shape_inside(&shape, vec3_make(0.0, 0.25, 0.0)));
}

static void a_turned_shape_keeps_its_volume(void **state)
{
    (void)state;
    struct shape_box plate = {VECTOR(0.0, 0.0), VECTOR(4.0, 1.0)};
    struct shape_rotate turned = {shape_of("box", &plate), M_PI / 6.0, VECTOR(2.0, 0.5), 2};
    struct one_of shape = shape_of("rotate", &turned);
    assert_near(sampled_volume(&shape, 2, 500), 4.0, 1e-3);
    /* The middle stays; the right end goes up. */
    assert_true(shape_inside(&shape, vec3_make(2.0 + 1.9 * cos(M_PI / 6.0), 0.5 + 0.95, 0.0)));
    assert_false(shape_inside(&shape, vec3_make(2.0 + 1.9 * cos(M_PI / 6.0), 0.5 - 0.95, 0.0)));

    struct shape_box block = {VECTOR(0.0, 0.0, 0.0), VECTOR(1.0, 2.0, 3.0)};
    for (int axis = 0; axis < 3; axis++) {
        struct shape_rotate oblique = {shape_of("box", &block), -0.7, {0, {0.0}}, axis};
        shape = shape_of("rotate", &oblique);
        assert_null(shape_wrong(&shape, 3));
        assert_near(sampled_volume(&shape, 3, 120), 6.0, 3e-3);
    }
}

static void a_quarter_turn_is_exact(void **state)
{
    (void)state;
    struct shape_box block = {VECTOR(1.0, 0.0, 0.0), VECTOR(3.0, 1.0, 0.5)};
    const struct vec3 high[3] = {{3.0, 0.0, 1.0}, {0.5, 1.0, -1.0}, {0.0, 3.0, 0.5}};
    for (int axis = 0; axis < 3; axis++) {
        struct shape_rotate turned = {shape_of("box", &block), M_PI / 2.0, {0, {0.0}}, axis};
        const struct one_of shape = shape_of("rotate", &turned);
        const struct bounds bounds = shape_bounds(&shape);
        assert_true(bounds.high.x == high[axis].x && bounds.high.y == high[axis].y &&
                    bounds.high.z == high[axis].z);
    }
}

static struct vec3 copy_place(const struct shape_repeat *repeat, struct vec3 step, int i, int j,
                              int k)
{
    double at[3] = {i * step.x, j * step.y, k * step.z};
    if (repeat->stagger && (i + j + k - (int[]){i, j, k}[repeat->stagger - 1]) % 2)
        at[repeat->stagger - 1] += 0.5 * repeat->step.at[repeat->stagger - 1];
    return vec3_make(at[0], at[1], at[2]);
}

/* The repetition by a loop over every copy. */
static bool inside_any_copy(const struct shape_repeat *repeat, struct vec3 point)
{
    const struct vec3 count = vec3_of(&repeat->count), step = vec3_of(&repeat->step);
    for (int k = 0; k < maximum(count.z, 1.0); k++)
        for (int j = 0; j < maximum(count.y, 1.0); j++)
            for (int i = 0; i < maximum(count.x, 1.0); i++)
                if (shape_inside(&repeat->shape,
                                 vec3_sub(point, copy_place(repeat, step, i, j, k))))
                    return true;
    return false;
}

static void compare_with_all_copies(const struct shape_repeat *repeat, const double *edges,
                                    int edge_count)
{
    const struct one_of shape = shape_of("repeat", (void *)repeat);
    uint64_t seed = 11;
    int inside = 0;
    for (int i = 0; i < 20000; i++) {
        const struct vec3 p = random_point(&seed, -0.5, 4.0);
        const bool found = shape_inside(&shape, p);
        assert_int_equal(found, inside_any_copy(repeat, p));
        inside += found;
    }
    assert_true(inside > 100 && inside < 19900);
    /* Points on the very faces of copies, where rounding could lose one. */
    for (int k = -1; k < 12; k++)
        for (int j = -1; j < 12; j++)
            for (int e = 0; e < edge_count * edge_count; e++) {
                const struct vec3 p =
                    vec3_make(edges[e % edge_count] + k * repeat->step.at[0],
                              edges[e / edge_count] + j * repeat->step.at[1], 0.0);
                assert_int_equal(shape_inside(&shape, p), inside_any_copy(repeat, p));
            }
}

static void a_repetition_is_the_union_of_all_its_copies(void **state)
{
    (void)state;
    struct shape_box box = {VECTOR(0.1, -0.2), VECTOR(0.17, 0.1)};
    const double box_edges[] = {0.1, 0.17, -0.2};
    struct shape_repeat apart = {shape_of("box", &box), VECTOR(10.0, 7.0), VECTOR(0.1, 0.41), 0};
    compare_with_all_copies(&apart, box_edges, 3);
    struct shape_repeat side_by_side = {shape_of("box", &box), VECTOR(10.0, 9.0),
                                        VECTOR(0.17 - 0.1, 0.3), 0};
    compare_with_all_copies(&side_by_side, box_edges, 3);

    struct shape_ball ball = {VECTOR(0.2, 0.3), 0.35};
    const double ball_edges[] = {0.2 - 0.35, 0.2, 0.3, 0.3 + 0.35};
    struct shape_repeat crowded = {shape_of("ball", &ball), VECTOR(11.0, 3.0), VECTOR(0.1, 0.9), 0};
    compare_with_all_copies(&crowded, ball_edges, 4);
    struct shape_repeat row = {shape_of("ball", &ball), VECTOR(1.0, 4.0), VECTOR(0.0, 0.8), 0};
    compare_with_all_copies(&row, ball_edges, 4);

    struct shape_ball grain = {VECTOR(0.2, 0.3, 0.1), 0.35};
    struct shape_repeat cubic = {shape_of("ball", &grain), VECTOR(4.0, 3.0, 5.0),
                                 VECTOR(0.8, 0.9, 0.65), 0};
    compare_with_all_copies(&cubic, ball_edges, 4);
}

static void a_staggered_repetition_shifts_every_second_row(void **state)
{
    (void)state;
    struct shape_ball pore = {VECTOR(0.2, 0.3), 0.35};
    const double edges[] = {0.2 - 0.35, 0.2, 0.3, 0.3 + 0.35};
    struct shape_ball grain = {VECTOR(0.2, 0.3, 0.1), 0.35};
    for (int axis = 1; axis <= 3; axis++) {
        struct shape_repeat crowded = {shape_of("ball", &pore), VECTOR(3.0, 3.0), VECTOR(0.6, 0.9),
                                       axis};
        struct shape_repeat cubic = {shape_of("ball", &grain), VECTOR(4.0, 3.0, 5.0),
                                     VECTOR(0.8, 0.9, 0.65), axis};
        if (axis < 3)
            compare_with_all_copies(&crowded, edges, 4);
        compare_with_all_copies(&cubic, edges, 4);
        const struct one_of shape = shape_of("repeat", &cubic);
        const struct bounds bounds = shape_bounds(&shape);
        const double high[3] = {bounds.high.x, bounds.high.y, bounds.high.z};
        const double straight[3] = {0.55 + 3 * 0.8, 0.65 + 2 * 0.9, 0.45 + 4 * 0.65};
        for (int i = 0; i < 3; i++)
            assert_near(high[i], straight[i] + (i == axis - 1 ? 0.5 * cubic.step.at[i] : 0.0),
                        1e-12);
    }
}

static void a_repetition_holds_a_billion_copies(void **state)
{
    (void)state;
    struct shape_ball ball = {VECTOR(0.5, 0.5, 0.5), 0.5};
    struct shape_repeat repeat = {shape_of("ball", &ball), VECTOR(1e3, 1e3, 1e3),
                                  VECTOR(1.0, 1.0, 1.0), 0};
    const struct one_of shape = shape_of("repeat", &repeat);
    uint64_t seed = 3;
    int inside = 0;
    for (int i = 0; i < 200000; i++)
        inside += shape_inside(&shape, random_point(&seed, 0.0, 1000.0));
    assert_near(inside / 200000.0, M_PI / 6.0, 0.01);
    const struct bounds bounds = shape_bounds(&shape);
    assert_true(bounds.low.x == 0.0 && bounds.high.z == 1000.0);
}

static void parameters_that_make_no_set_are_told(void **state)
{
    (void)state;
    struct shape_box flat = {VECTOR(0.0, 1.0), VECTOR(1.0, 1.0)};
    struct shape_ball disc = {VECTOR(0.0, 1.0), 1.0};
    struct one_of items[2] = {shape_of("ball", &disc), shape_of("box", &flat)};
    struct shape_union none = {{0, NULL}}, mixed = {{2, items}};
    struct shape_difference alone = {{1, items}};
    assert_wrong("union", &none, 2, "at least one");
    assert_wrong("union", &mixed, 2, "must lie above");
    assert_wrong("difference", &alone, 2, "at least two");

    struct shape_repeat half = {items[0], VECTOR(2.5, 1.0), VECTOR(1.0, 0.0), 0};
    assert_wrong("repeat", &half, 2, "whole numbers");
    struct shape_repeat still = {items[0], VECTOR(2.0, 1.0), VECTOR(0.0, 0.0), 0};
    assert_wrong("repeat", &still, 2, "positive");
    struct shape_repeat nested = {items[1], VECTOR(2.0, 1.0), VECTOR(1.0, 0.0), 0};
    assert_wrong("repeat", &nested, 2, "must lie above");
    nested.shape = items[0];
    const struct one_of good = shape_of("repeat", &nested);
    assert_null(shape_wrong(&good, 2));
    nested.stagger = 2;
    assert_wrong("repeat", &nested, 2, "positive along its `stagger`");
    nested.stagger = 3;
    assert_wrong("repeat", &nested, 2, "needs its axis");
}

static void parameters_that_make_no_cut_are_told(void **state)
{
    (void)state;
    struct shape_ball left = {VECTOR(0.0, 0.0), 1.0}, right = {VECTOR(3.0, 0.0), 1.0};
    struct one_of items[2] = {shape_of("ball", &left), shape_of("ball", &right)};
    struct shape_intersection none = {{2, items}}, alone = {{1, items}};
    assert_wrong("intersection", &none, 2, "lie apart");
    assert_wrong("intersection", &alone, 2, "at least two");
    struct shape_rotate about_x = {items[0], 1.0, {0, {0.0}}, 0};
    assert_wrong("rotate", &about_x, 2, "`axis` z");
    struct shape_rotate bare = {items[0], 1.0, VECTOR(1.0), 2};
    assert_wrong("rotate", &bare, 2, "as many numbers");

    struct shape_half_space half = {VECTOR(0.0, 0.0), VECTOR(1.0, 0.0)};
    struct shape_repeat halves = {shape_of("half_space", &half), VECTOR(2.0, 1.0), VECTOR(1.0, 0.0),
                                  0};
    assert_wrong("repeat", &halves, 2, "an infinite shape");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sites_fill_the_volume_of_a_union_once),
        cmocka_unit_test(a_difference_leaves_its_holes_empty),
        cmocka_unit_test(an_intersection_is_what_its_shapes_have_in_common),
        cmocka_unit_test(a_half_space_cuts_what_it_meets_in_two),
        cmocka_unit_test(a_turned_shape_keeps_its_volume),
        cmocka_unit_test(a_quarter_turn_is_exact),
        cmocka_unit_test(a_repetition_is_the_union_of_all_its_copies),
        cmocka_unit_test(a_staggered_repetition_shifts_every_second_row),
        cmocka_unit_test(a_repetition_holds_a_billion_copies),
        cmocka_unit_test(parameters_that_make_no_set_are_told),
        cmocka_unit_test(parameters_that_make_no_cut_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
