/* Shapes: which points are in, the bounds, the volume, and what is wrong with their parameters. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "sample.h"

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

static void sites_fill_the_area_of_a_polygon(void **state)
{
    (void)state;
    struct shape_polygon triangle = POINTS(VECTOR(0.0, 0.0), VECTOR(3.0, 0.5), VECTOR(1.0, 2.0));
    struct shape_polygon hollow = POINTS(VECTOR(0.0, 0.0), VECTOR(4.0, 0.0), VECTOR(4.0, 3.0),
                                         VECTOR(2.0, 1.0), VECTOR(0.0, 3.0));
    struct shape_polygon bow =
        POINTS(VECTOR(0.0, 0.0), VECTOR(2.0, 2.0), VECTOR(2.0, 0.0), VECTOR(0.0, 2.0));
    struct one_of shape = shape_of("polygon", &triangle);
    assert_near(sampled_volume(&shape, 2, 500), 0.5 * (3.0 * 2.0 - 0.5 * 1.0), 1e-3);
    shape = shape_of("polygon", &hollow);
    assert_near(sampled_volume(&shape, 2, 500), 12.0 - 4.0, 1e-3);
    assert_false(shape_inside(&shape, vec3_make(2.0, 1.1, 0.0)));
    shape = shape_of("polygon", &bow);
    assert_near(sampled_volume(&shape, 2, 500), 2.0, 5e-3);
}

static void polygons_with_a_common_edge_share_no_point_and_miss_none(void **state)
{
    (void)state;
    const double apex[2] = {0.3, 0.7};
    struct shape_polygon part[4] = {
        POINTS(VECTOR(0.0, 0.0), VECTOR(1.0, 0.0), VECTOR(apex[0], apex[1])),
        POINTS(VECTOR(1.0, 0.0), VECTOR(1.0, 1.0), VECTOR(apex[0], apex[1])),
        POINTS(VECTOR(1.0, 1.0), VECTOR(0.0, 1.0), VECTOR(apex[0], apex[1])),
        POINTS(VECTOR(0.0, 1.0), VECTOR(0.0, 0.0), VECTOR(apex[0], apex[1])),
    };
    for (int i = 0; i <= 300; i++)
        for (int k = 0; k < 2; k++) {
            /* On the diagonals, and on a grid whose corners lie on the edges of the square. */
            const double t = i / 300.0;
            const struct vec3 p = k ? vec3_make(t * apex[0], t * apex[1], 0.0)
                                    : vec3_make((i % 10) / 10.0, (i / 10 % 10) / 10.0, 0.0);
            int holders = 0;
            for (int n = 0; n < 4; n++) {
                const struct one_of shape = shape_of("polygon", &part[n]);
                holders += shape_inside(&shape, p);
            }
            assert_int_equal(holders, 1);
        }
}

static void sites_fill_the_volume_of_a_shell(void **state)
{
    (void)state;
    struct shape_shell ring = {VECTOR(0.3, -0.1), 0.2, 0.5};
    struct shape_shell sphere = {VECTOR(0.3, -0.1, 1.0), 0.2, 0.5};
    struct one_of shape = shape_of("shell", &ring);
    assert_near(sampled_volume(&shape, 2, 400), M_PI * (0.25 - 0.04), 1e-3);
    shape = shape_of("shell", &sphere);
    assert_near(sampled_volume(&shape, 3, 120), 4.0 / 3.0 * M_PI * (0.125 - 0.008), 2e-3);
}

static void a_template_is_its_letter_on_the_map(void **state)
{
    (void)state;
    char *rows[3] = {"xo.x", "ooxx", "...o"};
    struct shape_template letter[2] = {{{3, rows}, "x", 0.1, VECTOR(1.0, 2.0), 0, NULL},
                                       {{3, rows}, "o", 0.1, VECTOR(1.0, 2.0), 0, NULL}};
    const struct one_of x = shape_of("template", &letter[0]), o = shape_of("template", &letter[1]);
    assert_near(sampled_volume(&x, 2, 120), 4 * 0.01, 1e-9);
    assert_near(sampled_volume(&o, 2, 120), 4 * 0.01, 1e-9);
    assert_true(shape_inside(&x, vec3_make(1.05, 2.25, 0.0)));
    assert_true(shape_inside(&o, vec3_make(1.35, 2.05, 0.0)));
    assert_false(shape_inside(&x, vec3_make(1.45, 2.25, 0.0)));
    assert_false(shape_inside(&x, vec3_make(1.05, 2.35, 0.0)));
    /* Where sites touch, rounding or not, a point is in one of them. */
    for (int i = 0; i <= 40; i++) {
        const struct vec3 p = vec3_make(1.0 + 0.1 * i / 10.0, 2.0 + 0.1 + 0.05, 0.0);
        const int holders = shape_inside(&x, p) + shape_inside(&o, p);
        assert_true(i < 40 ? holders == 1 : holders <= 1);
    }
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

/* Of a box of whole periods of hexagons or squares, about any center, the walls take
 * 1 - (1 - wall/pitch)^2. */
static void walls_of_a_honeycomb_have_their_area(void **state)
{
    (void)state;
    const double wall = 0.08, wanted = 1.0 - (1.0 - wall) * (1.0 - wall), high = sqrt(3.0);
    for (int cells = 0; cells < 2; cells++)
        for (int k = 0; k < 3; k++) {
            const double height = cells ? 2.0 : high;
            struct shape_honeycomb comb = {VECTOR(0.0, 0.0),
                                           VECTOR(2.0, height),
                                           VECTOR(0.13 * k, -0.7 * k),
                                           1.0,
                                           wall,
                                           k == 2 ? 2.0 * acos(0.0) : 0.0,
                                           !cells ? 0 : 1,
                                           2};
            const struct one_of shape = shape_of("honeycomb", &comb);
            assert_near(sampled_volume(&shape, 2, 1500), wanted * 2.0 * height, 0.01);
        }
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

    struct shape_shell inverted = {VECTOR(0.0, 0.0), 2.0, 1.0}, line = {VECTOR(0.0), 1.0, 2.0};
    assert_wrong("shell", &inverted, 2, "must be smaller");
    assert_wrong("shell", &line, 1, "two or three dimensions");
    struct shape_half_space half = {VECTOR(0.0, 0.0), VECTOR(0.0, 0.0)};
    assert_wrong("half_space", &half, 2, "must not be zero");
    assert_wrong("half_space", &half, 3, "as many numbers");

    struct shape_polygon straight = POINTS(VECTOR(0.0, 0.0), VECTOR(1.0, 0.0), VECTOR(2.0, 0.0));
    struct shape_polygon two = POINTS(VECTOR(0.0, 0.0), VECTOR(1.0, 0.0));
    struct shape_polygon mixed = POINTS(VECTOR(0.0, 0.0), VECTOR(1.0), VECTOR(2.0, 1.0));
    assert_wrong("polygon", &straight, 2, "one line");
    assert_wrong("polygon", &straight, 3, "two dimensions");
    assert_wrong("polygon", &two, 2, "at least three");
    assert_wrong("polygon", &mixed, 2, "two numbers");

    char *uneven[2] = {"xx", "x"}, *even[2] = {"xo", "ox"};
    struct shape_template map = {{2, uneven}, "x", 1.0, VECTOR(0.0, 0.0), 0, NULL};
    assert_wrong("template", &map, 2, "one length");
    map.rows.names = even;
    map.letter = "xo";
    assert_wrong("template", &map, 2, "one character");
    struct shape_honeycomb solid = {VECTOR(0.0, 0.0), VECTOR(1.0, 1.0), {0}, 1.0, 1.0, 0.0, 0, 2};
    assert_wrong("honeycomb", &solid, 2, "thinner");
    map.letter = "z";
    assert_wrong("template", &map, 2, "nowhere");
    assert_wrong("template", &map, 3, "two dimensions");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_has_its_low_faces_and_not_its_high_faces),
        cmocka_unit_test(a_point_between_two_intervals_lies_in_one_of_them),
        cmocka_unit_test(sites_fill_the_volume_of_a_shape),
        cmocka_unit_test(sites_fill_the_area_of_a_polygon),
        cmocka_unit_test(polygons_with_a_common_edge_share_no_point_and_miss_none),
        cmocka_unit_test(sites_fill_the_volume_of_a_shell),
        cmocka_unit_test(a_template_is_its_letter_on_the_map),
        cmocka_unit_test(the_bounds_of_an_oblique_cylinder_hold_it_and_touch_it),
        cmocka_unit_test(walls_of_a_honeycomb_have_their_area),
        cmocka_unit_test(parameters_that_make_no_shape_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
