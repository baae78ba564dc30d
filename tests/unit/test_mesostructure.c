/* The mesostructures of Parshikov (2013), chapters 3 to 5, composed of shapes: how many particles
 * they have. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "workshop.h"

static const double l = 0.4e-6; /* pore size or cell size, m */

/* The particles of each body of the workshop. */
static void count_bodies(const struct workshop *w, int64_t *count)
{
    struct body_summary summary[BODIES];
    struct error *error = generate_summary(&w->input, NULL, summary);
    if (error)
        fail_msg("%s", error_message(error, 0));
    for (int body = 0; body < w->input.bodies.count; body++)
        count[body] = summary[body].particles;
}

/* 25 square pores l x l in cells 2l x 2l, and a solid column: figure 3.3. */
static void a_plate_with_square_pores_has_1232_particles_per_25_pores(void **state)
{
    (void)state;
    struct shape_box plate = {VECTOR(0.0, 0.0), VECTOR(51.0 * l, 2.0 * l)};
    struct shape_box pore = {VECTOR(l, 0.5 * l), VECTOR(2.0 * l, 1.5 * l)};
    struct shape_repeat pores = {shape_of("box", &pore), VECTOR(25.0, 1.0),
                                 VECTOR(2.0 * l, 2.0 * l), 0};
    struct one_of items[2] = {shape_of("box", &plate), shape_of("repeat", &pores)};
    struct shape_difference rest = {{2, items}};
    for (int finer = 1; finer <= 2; finer++) {
        struct workshop w;
        int64_t count[BODIES];
        open_workshop(&w, 2, l / (4 * finer));
        add_body(&w, "difference", &rest);
        count_bodies(&w, count);
        assert_int_equal(count[0], 1232 * finer * finer);
    }
}

/* Octagons of 120 sites in cells of 16 x 16: a block of 12 x 12 less 3 + 2 + 1 sites at each
 * corner. */
static void an_octagon_takes_120_of_256_sites_of_its_cell(void **state)
{
    (void)state;
    const double d = l / 16.0, a = 2.0 * d, b = 5.5 * d, c = 10.5 * d, e = 14.0 * d;
    struct vector_value corners[8] = {VECTOR(a, b), VECTOR(b, a), VECTOR(c, a), VECTOR(e, b),
                                      VECTOR(e, c), VECTOR(c, e), VECTOR(b, e), VECTOR(a, c)};
    struct shape_polygon octagon = {{8, corners}};
    struct shape_repeat inclusions = {shape_of("polygon", &octagon), VECTOR(32.0, 1.0),
                                      VECTOR(l, l), 0};
    struct shape_box strip = {VECTOR(0.0, 0.0), VECTOR(32.0 * l, l)};
    struct workshop w;
    int64_t count[BODIES];
    open_workshop(&w, 2, d);
    add_body(&w, "box", &strip);
    add_body(&w, "repeat", &inclusions)->replaces = (struct name_list){1, (char *[]){"matrix"}};
    count_bodies(&w, count);
    assert_int_equal(count[0], 32 * 136);
    assert_int_equal(count[1], 32 * 120);
}

/* Chains of round pores, every second one shifted by half a period: two pores 20.8 d wide in 40 d x
 * 40 d leave 1006 of 1750 kg/m^3. */
static void staggered_round_pores_leave_the_mean_density(void **state)
{
    (void)state;
    const double d = 48e-6;
    struct shape_box strip = {VECTOR(0.0, 0.0), VECTOR(400.0 * d, 40.0 * d)};
    struct shape_ball pore = {VECTOR(10.0 * d, 10.0 * d), 10.4 * d};
    struct shape_repeat chains = {shape_of("ball", &pore), VECTOR(10.0, 2.0),
                                  VECTOR(40.0 * d, 20.0 * d), 1};
    struct one_of items[2] = {shape_of("box", &strip), shape_of("repeat", &chains)};
    struct shape_difference rest = {{2, items}};
    struct workshop w;
    int64_t count[BODIES];
    open_workshop(&w, 2, d / 4.0);
    add_body(&w, "difference", &rest);
    count_bodies(&w, count);
    assert_true(fabs(1750.0 * (double)count[0] / 256000.0 - 1006.0) < 0.01 * 1006.0);
}

static void a_channel_takes_its_rectangle_of_sites(void **state)
{
    (void)state;
    const double d = 10e-6;
    struct shape_box explosive = {VECTOR(0.0, 0.0), VECTOR(240.0 * d, 120.0 * d)};
    struct shape_box channel = {VECTOR(20.0 * d, 50.0 * d), VECTOR(220.0 * d, 70.0 * d)};
    struct one_of items[2] = {shape_of("box", &explosive), shape_of("box", &channel)};
    struct shape_difference rest = {{2, items}};
    struct workshop w;
    int64_t count[BODIES];
    open_workshop(&w, 2, d);
    add_body(&w, "difference", &rest);
    count_bodies(&w, count);
    assert_int_equal(count[0], 24800);
}

/* Square inclusions, one a cell of 32 x 32 sites, every second one half a cell higher, where the
 * walls cut it: 20, 18, 14, 10 sites wide. */
static void staggered_squares_keep_their_sites_between_walls(void **state)
{
    (void)state;
    static const int side[4] = {20, 18, 14, 10};
    const double d = 1e-4;
    for (int i = 0; i < 4; i++) {
        const double low = 0.5 * (32 - side[i]) * d, high = low + side[i] * d;
        struct shape_box strip = {VECTOR(0.0, 0.0), VECTOR(6.0 * 32.0 * d, 32.0 * d)};
        struct shape_box inclusion = {VECTOR(low, low - 32.0 * d), VECTOR(high, high - 32.0 * d)};
        struct shape_repeat chain = {shape_of("box", &inclusion), VECTOR(6.0, 2.0),
                                     VECTOR(32.0 * d, 32.0 * d), 2};
        struct one_of items[2] = {shape_of("box", &strip), shape_of("repeat", &chain)};
        struct shape_intersection between = {{2, items}};
        struct workshop w;
        int64_t count[BODIES];
        open_workshop(&w, 2, d);
        add_body(&w, "box", &strip);
        add_body(&w, "intersection", &between)->replaces =
            (struct name_list){1, (char *[]){"matrix"}};
        count_bodies(&w, count);
        assert_int_equal(count[1], 6 * side[i] * side[i]);
        assert_int_equal(count[0] + count[1], 6 * 1024);
    }
}

/* Maps of 10 x 10 sites with 18 of one material, 28 of another and 54 empty, in 45 x 5 tiles. */
static void a_template_is_tiled_without_a_lost_site(void **state)
{
    (void)state;
    const double d = 60e-6;
    char *rows[10] = {"nn.n..n.r.", "r...n....n", "..rn..n.r.", "n....r...n", ".nr.n..n.r",
                      "n..n.r..nr", ".r.n.n.rn.", "n.n..r.n..", "..r.n...rn", "nr.nr.nrnr"};
    char *letters[2] = {"r", "n"};
    struct shape_template map[2];
    struct shape_repeat tiles[2];
    struct workshop w;
    int64_t count[BODIES];
    open_workshop(&w, 2, d);
    for (int i = 0; i < 2; i++) {
        map[i] = (struct shape_template){{10, rows}, letters[i], d, VECTOR(0.0, 0.0), 0, NULL};
        tiles[i] = (struct shape_repeat){shape_of("template", &map[i]), VECTOR(45.0, 5.0),
                                         VECTOR(10.0 * d, 10.0 * d), 0};
        add_body(&w, "repeat", &tiles[i]);
    }
    count_bodies(&w, count);
    assert_int_equal(count[0], 225 * 18);
    assert_int_equal(count[1], 225 * 28);
}

/* A shuffled map keeps the number of each letter; each site has one letter, the same one whichever
 * letter is asked for. */
static void a_shuffled_template_keeps_the_number_of_each_letter(void **state)
{
    (void)state;
    char *rows[10] = {"rrrrrrrrrr", "rrrrrrrrnn", "nnnnnnnnnn", "nnnnnnnnnn", "nnnnnn....",
                      "..........", "..........", "..........", "..........", ".........."};
    char *letters[3] = {"r", "n", "."};
    const int counts[3] = {18, 28, 54};
    for (int64_t seed = 1; seed <= 3; seed++) {
        int taken[100] = {0}, moved = 0;
        for (int i = 0; i < 3; i++) {
            struct shape_template map = {{10, rows}, letters[i], 1.0, VECTOR(0.0, 0.0), seed, NULL};
            const struct one_of shape = shape_of("template", &map);
            assert_null(shape_wrong(&shape, 2));
            int found = 0;
            for (int site = 0; site < 100; site++)
                if (shape_inside(&shape, vec3_make(site % 10 + 0.5, 9.5 - site / 10, 0.0))) {
                    found++;
                    taken[site]++;
                    moved += rows[site / 10][site % 10] != letters[i][0];
                }
            assert_int_equal(found, counts[i]);
            free(map.shuffled);
        }
        for (int site = 0; site < 100; site++)
            assert_int_equal(taken[site], 1);
        assert_in_range(moved, 40, 80); /* 100 - (18^2 + 28^2 + 54^2)/100 = 60 on average */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plate_with_square_pores_has_1232_particles_per_25_pores),
        cmocka_unit_test(an_octagon_takes_120_of_256_sites_of_its_cell),
        cmocka_unit_test(staggered_round_pores_leave_the_mean_density),
        cmocka_unit_test(a_channel_takes_its_rectangle_of_sites),
        cmocka_unit_test(staggered_squares_keep_their_sites_between_walls),
        cmocka_unit_test(a_template_is_tiled_without_a_lost_site),
        cmocka_unit_test(a_shuffled_template_keeps_the_number_of_each_letter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
