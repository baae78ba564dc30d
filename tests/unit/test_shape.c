/* Shapes: which points are in, the bounds, the volume, and what is wrong with their parameters. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "build_case.h"

/* A repeatable random number in 0 .. 1. */
static double random_number(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static struct vec3 random_point(uint64_t *state, double low, double high)
{
    const double x = low + (high - low) * random_number(state);
    const double y = low + (high - low) * random_number(state);
    const double z = low + (high - low) * random_number(state);
    return vec3_make(x, y, z);
}

/* Volume (area, length) of the cells with their center inside, COUNT along each axis. */
static double sampled_volume(const struct one_of *shape, int dimension, int count)
{
    const struct bounds bounds = shape_bounds(shape);
    const struct vec3 cell = vec3_scale(1.0 / count, vec3_sub(bounds.high, bounds.low));
    int64_t inside = 0;
    for (int k = 0; k < (dimension > 2 ? count : 1); k++)
        for (int j = 0; j < (dimension > 1 ? count : 1); j++)
            for (int i = 0; i < count; i++)
                inside += shape_inside(shape, vec3_make(bounds.low.x + (i + 0.5) * cell.x,
                                                        bounds.low.y + (j + 0.5) * cell.y,
                                                        bounds.low.z + (k + 0.5) * cell.z));
    return (double)inside * cell.x * (dimension > 1 ? cell.y : 1.0) *
           (dimension > 2 ? cell.z : 1.0);
}

static void assert_near(double value, double wanted, double within)
{
    if (!(fabs(value - wanted) <= within * fabs(wanted)))
        fail_msg("%.9g is not within %g of %.9g", value, within, wanted);
}

static void a_box_has_its_low_faces_and_not_its_high_faces(void **state)
{
    (void)state;
    struct shape_box box = {VECTOR(0.0, 1.0), VECTOR(0.5, 3.0)};
    const struct one_of shape = shape_of("box", &box);
    assert_true(shape_inside(&shape, vec3_make(0.0, 1.0, 0.0)));
    assert_true(shape_inside(&shape, vec3_make(nextafter(0.5, 0.0), nextafter(3.0, 0.0), 0.0)));
    assert_false(shape_inside(&shape, vec3_make(0.5, 1.0, 0.0)));
    assert_false(shape_inside(&shape, vec3_make(0.0, 3.0, 0.0)));
    assert_false(shape_inside(&shape, vec3_make(nextafter(0.0, -1.0), 1.0, 0.0)));
}

static void a_point_between_two_intervals_lies_in_one_of_them(void **state)
{
    (void)state;
    struct shape_ball ball = {VECTOR(0.3), 0.1};
    struct shape_box left = {VECTOR(0.0), VECTOR(0.3 - 0.1)};
    struct shape_box right = {VECTOR(0.3 + 0.1), VECTOR(1.0)};
    const struct one_of shapes[3] = {shape_of("box", &left), shape_of("ball", &ball),
                                     shape_of("box", &right)};
    const double faces[2] = {0.3 - 0.1, 0.3 + 0.1};
    for (int face = 0; face < 2; face++)
        for (int side = -1; side <= 1; side++) {
            const double x = side ? nextafter(faces[face], side * 2.0) : faces[face];
            int holders = 0;
            for (int i = 0; i < 3; i++)
                holders += shape_inside(&shapes[i], vec3_make(x, 0.0, 0.0));
            assert_int_equal(holders, 1);
        }
}

static void sites_fill_the_volume_of_a_shape(void **state)
{
    (void)state;
    struct shape_ball interval = {VECTOR(0.3), 0.25}, disc = {VECTOR(0.3, -0.1), 0.25},
                      ball = {VECTOR(0.3, -0.1, 2.0), 0.25};
    struct shape_cylinder bar = {VECTOR(0.0, 0.0, -1.0), VECTOR(0.0, 0.0, 1.0), 0.5, 0.0};
    struct shape_cylinder pipe = {VECTOR(0.0, 0.0, 0.0), VECTOR(1.0, 2.0, -0.5), 0.5, 0.3};
    struct one_of shape = shape_of("ball", &interval);
    assert_near(sampled_volume(&shape, 1, 100), 0.5, 1e-12);
    shape = shape_of("ball", &disc);
    assert_near(sampled_volume(&shape, 2, 400), M_PI * square(0.25), 5e-4);
    shape = shape_of("ball", &ball);
    assert_near(sampled_volume(&shape, 3, 100), 4.0 / 3.0 * M_PI * pow(0.25, 3), 1e-3);
    shape = shape_of("cylinder", &bar);
    assert_near(sampled_volume(&shape, 3, 100), M_PI * square(0.5) * 2.0, 2e-3);
    shape = shape_of("cylinder", &pipe);
    assert_near(sampled_volume(&shape, 3, 120), M_PI * (0.25 - 0.09) * sqrt(5.25), 2e-3);
}

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

static void the_bounds_of_an_oblique_cylinder_hold_it_and_touch_it(void **state)
{
    (void)state;
    struct shape_cylinder bar = {VECTOR(0.1, 0.2, 0.3), VECTOR(-0.8, 0.9, 0.7), 0.4, 0.0};
    const struct one_of shape = shape_of("cylinder", &bar);
    const struct bounds bounds = shape_bounds(&shape);
    struct vec3 low = bounds.high, high = bounds.low;
    uint64_t seed = 7;
    for (int i = 0; i < 1000000; i++) {
        const struct vec3 p = random_point(&seed, -1.5, 1.5);
        if (!shape_inside(&shape, p))
            continue;
        low = vec3_make(minimum(low.x, p.x), minimum(low.y, p.y), minimum(low.z, p.z));
        high = vec3_make(maximum(high.x, p.x), maximum(high.y, p.y), maximum(high.z, p.z));
    }
    const struct vec3 below = vec3_sub(low, bounds.low), above = vec3_sub(bounds.high, high);
    assert_true(below.x >= 0.0 && below.y >= 0.0 && below.z >= 0.0);
    assert_true(above.x >= 0.0 && above.y >= 0.0 && above.z >= 0.0);
    assert_true(below.x < 0.05 && below.y < 0.05 && below.z < 0.05);
    assert_true(above.x < 0.05 && above.y < 0.05 && above.z < 0.05);
}

/* The repetition by a loop over every copy. */
static bool inside_any_copy(const struct shape_repeat *repeat, struct vec3 point)
{
    const struct vec3 count = vec3_of(&repeat->count), step = vec3_of(&repeat->step);
    for (int k = 0; k < maximum(count.z, 1.0); k++)
        for (int j = 0; j < maximum(count.y, 1.0); j++)
            for (int i = 0; i < maximum(count.x, 1.0); i++)
                if (shape_inside(&repeat->shape,
                                 vec3_sub(point, vec3_make(i * step.x, j * step.y, k * step.z))))
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
    struct shape_repeat apart = {shape_of("box", &box), VECTOR(10.0, 7.0), VECTOR(0.1, 0.41)};
    compare_with_all_copies(&apart, box_edges, 3);
    struct shape_repeat side_by_side = {shape_of("box", &box), VECTOR(10.0, 9.0),
                                        VECTOR(0.17 - 0.1, 0.3)};
    compare_with_all_copies(&side_by_side, box_edges, 3);

    struct shape_ball ball = {VECTOR(0.2, 0.3), 0.35};
    const double ball_edges[] = {0.2 - 0.35, 0.2, 0.3, 0.3 + 0.35};
    struct shape_repeat crowded = {shape_of("ball", &ball), VECTOR(11.0, 3.0), VECTOR(0.1, 0.9)};
    compare_with_all_copies(&crowded, ball_edges, 4);
    struct shape_repeat row = {shape_of("ball", &ball), VECTOR(1.0, 4.0), VECTOR(0.0, 0.8)};
    compare_with_all_copies(&row, ball_edges, 4);

    struct shape_ball grain = {VECTOR(0.2, 0.3, 0.1), 0.35};
    struct shape_repeat cubic = {shape_of("ball", &grain), VECTOR(4.0, 3.0, 5.0),
                                 VECTOR(0.8, 0.9, 0.65)};
    compare_with_all_copies(&cubic, ball_edges, 4);
}

static void a_repetition_holds_a_billion_copies(void **state)
{
    (void)state;
    struct shape_ball ball = {VECTOR(0.5, 0.5, 0.5), 0.5};
    struct shape_repeat repeat = {shape_of("ball", &ball), VECTOR(1e3, 1e3, 1e3),
                                  VECTOR(1.0, 1.0, 1.0)};
    const struct one_of shape = shape_of("repeat", &repeat);
    uint64_t seed = 3;
    int inside = 0;
    for (int i = 0; i < 200000; i++)
        inside += shape_inside(&shape, random_point(&seed, 0.0, 1000.0));
    assert_near(inside / 200000.0, M_PI / 6.0, 0.01);
    const struct bounds bounds = shape_bounds(&shape);
    assert_true(bounds.low.x == 0.0 && bounds.high.z == 1000.0);
}

static void assert_wrong(const char *name, void *value, int dimension, const char *words)
{
    const struct one_of shape = shape_of(name, value);
    const char *text = shape_wrong(&shape, dimension);
    if (!text || !strstr(text, words))
        fail_msg("\"%s\" does not tell of \"%s\"", text ? text : "nothing", words);
}

static void parameters_that_make_no_shape_are_told(void **state)
{
    (void)state;
    struct shape_box flat = {VECTOR(0.0, 1.0), VECTOR(1.0, 1.0)};
    assert_wrong("box", &flat, 2, "must lie above");
    assert_wrong("box", &flat, 3, "as many numbers");
    struct shape_ball disc = {VECTOR(0.0, 1.0), 1.0};
    assert_wrong("ball", &disc, 1, "as many numbers");
    struct shape_cylinder thick = {VECTOR(0.0, 0.0, 0.0), VECTOR(0.0, 0.0, 1.0), 1.0, 1.0};
    assert_wrong("cylinder", &thick, 3, "inner");
    assert_wrong("cylinder", &thick, 2, "three dimensions");
    struct shape_cylinder point = {VECTOR(1.0, 0.0, 0.0), VECTOR(1.0, 0.0, 0.0), 1.0, 0.0};
    assert_wrong("cylinder", &point, 3, "different points");

    struct one_of items[2] = {shape_of("ball", &disc), shape_of("box", &flat)};
    struct shape_union none = {{0, NULL}}, mixed = {{2, items}};
    struct shape_difference alone = {{1, items}};
    assert_wrong("union", &none, 2, "at least one");
    assert_wrong("union", &mixed, 2, "must lie above");
    assert_wrong("difference", &alone, 2, "at least two");

    struct shape_repeat half = {items[0], VECTOR(2.5, 1.0), VECTOR(1.0, 0.0)};
    assert_wrong("repeat", &half, 2, "whole numbers");
    struct shape_repeat still = {items[0], VECTOR(2.0, 1.0), VECTOR(0.0, 0.0)};
    assert_wrong("repeat", &still, 2, "positive");
    struct shape_repeat nested = {items[1], VECTOR(2.0, 1.0), VECTOR(1.0, 0.0)};
    assert_wrong("repeat", &nested, 2, "must lie above");
    nested.shape = items[0];
    const struct one_of good = shape_of("repeat", &nested);
    assert_null(shape_wrong(&good, 2));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_has_its_low_faces_and_not_its_high_faces),
        cmocka_unit_test(a_point_between_two_intervals_lies_in_one_of_them),
        cmocka_unit_test(sites_fill_the_volume_of_a_shape),
        cmocka_unit_test(sites_fill_the_volume_of_a_union_once),
        cmocka_unit_test(a_difference_leaves_its_holes_empty),
        cmocka_unit_test(the_bounds_of_an_oblique_cylinder_hold_it_and_touch_it),
        cmocka_unit_test(a_repetition_is_the_union_of_all_its_copies),
        cmocka_unit_test(a_repetition_holds_a_billion_copies),
        cmocka_unit_test(parameters_that_make_no_shape_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
