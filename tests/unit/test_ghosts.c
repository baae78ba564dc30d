/* Images behind mirror walls: where they are, how they are signed, and which of them a plan
 * holds. */
#include "dice.h"

#include "parallel/ghosts.h"

static const struct mirrors box = {{-1.0, 2.0, -0.5}, {3.0, 4.5, 0.75}, {0.0}};
static const struct mirrors none = {{NAN, NAN, NAN}, {NAN, NAN, NAN}, {0.0}};

static struct vec3 random_place(struct dice *dice)
{
    /* Multiples of 2^-40, so that reflections are exact. */
    struct vec3 x = {ldexp(floor(ldexp(dice_between(dice, -1.0, 3.0), 40)), -40),
                     ldexp(floor(ldexp(dice_between(dice, 2.0, 4.5), 40)), -40),
                     ldexp(floor(ldexp(dice_between(dice, -0.5, 0.75), 40)), -40)};
    return x;
}

static void an_image_stands_as_far_behind_the_wall(void **state)
{
    (void)state;
    struct vec3 x = {0.25, 3.0, 0.5};
    struct vec3 low = image_position(&box, 1, x), high = image_position(&box, 2, x);
    assert_true(low.x == -2.25 && low.y == 3.0 && low.z == 0.5);
    assert_true(high.x == 5.75 && high.y == 3.0 && high.z == 0.5);
    struct vec3 corner = image_position(&box, 1 + 3 * 2 + 9 * 1, x);
    assert_true(corner.x == -2.25 && corner.y == 6.0 && corner.z == -1.5);
}

static void image_zero_is_the_particle_itself(void **state)
{
    (void)state;
    struct vec3 x = {0.1, 0.2, 0.3}, same = image_position(&none, 0, x),
                sign = image_sign(&none, 0);
    assert_true(same.x == x.x && same.y == x.y && same.z == x.z);
    assert_true(sign.x == 1.0 && sign.y == 1.0 && sign.z == 1.0);
}

static void an_image_of_an_image_is_the_particle(void **state)
{
    (void)state;
    struct dice dice = {1};
    for (int k = 0; k < 200; k++)
        for (image_code image = 0; image < IMAGE_CODES; image++) {
            struct vec3 x = random_place(&dice);
            struct vec3 back = image_position(&box, image, image_position(&box, image, x));
            assert_true(back.x == x.x && back.y == x.y && back.z == x.z);
        }
}

static void signs_follow_the_reflected_axes(void **state)
{
    (void)state;
    for (int z = 0; z < 3; z++)
        for (int y = 0; y < 3; y++)
            for (int x = 0; x < 3; x++) {
                struct vec3 sign = image_sign(&box, (image_code)(x + 3 * y + 9 * z));
                assert_true(sign.x == (x ? -1.0 : 1.0));
                assert_true(sign.y == (y ? -1.0 : 1.0));
                assert_true(sign.z == (z ? -1.0 : 1.0));
            }
}

static void a_plan_without_walls_is_empty(void **state)
{
    (void)state;
    double position[2][3] = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
    struct ghosts ghosts = {0};
    assert_success(ghosts_plan((struct near_walls){&none, 3, 1e9}, 2, (const double(*)[3])position,
                               2, &ghosts));
    assert_int_equal(ghosts.count, 0);
    ghosts_free(&ghosts);
}

static void a_corner_gives_three_images_in_the_plane_and_seven_in_space(void **state)
{
    (void)state;
    double position[1][3] = {{-0.9, 2.1, -0.4}};
    static const image_code wanted[7] = {1, 3, 4, 9, 10, 12, 13};
    struct ghosts ghosts = {0};
    assert_success(ghosts_plan((struct near_walls){&box, 2, 0.2}, 1, (const double(*)[3])position,
                               2, &ghosts));
    assert_int_equal(ghosts.count, 3);
    for (int k = 0; k < 3; k++)
        assert_int_equal(ghosts.image[k], wanted[k]);
    assert_success(ghosts_plan((struct near_walls){&box, 3, 0.2}, 1, (const double(*)[3])position,
                               2, &ghosts));
    assert_int_equal(ghosts.count, 7);
    for (int k = 0; k < 7; k++) {
        assert_int_equal(ghosts.image[k], wanted[k]);
        assert_int_equal(ghosts.source[k], 0);
    }
    ghosts_free(&ghosts);
}

/* Every image whose walls are all near is in the plan, once, and no other. */
static void a_plan_holds_the_images_of_near_walls(void **state)
{
    (void)state;
    enum { COUNT = 300 };
    static double position[COUNT][3];
    struct dice dice = {2};
    for (int i = 0; i < COUNT; i++) {
        struct vec3 x = random_place(&dice);
        position[i][0] = x.x;
        position[i][1] = x.y;
        position[i][2] = x.z;
    }
    for (int dimension = 1; dimension <= 3; dimension++)
        for (double distance = 0.1; distance < 2.0; distance *= 2.0) {
            struct ghosts ghosts = {0};
            assert_success(ghosts_plan((struct near_walls){&box, dimension, distance}, COUNT,
                                       (const double(*)[3])position, 2, &ghosts));
            int next = 0;
            for (int i = 0; i < COUNT; i++)
                for (int image = 1; image < IMAGE_CODES; image++) {
                    int code[3] = {image % 3, image / 3 % 3, image / 9};
                    bool near = true;
                    for (int a = 0; a < 3; a++) {
                        double low = position[i][a] - box.low[a];
                        double high = box.high[a] - position[i][a];
                        near &= code[a] == 0 ||
                                (a < dimension && (code[a] == 1 ? low : high) < distance);
                    }
                    if (!near)
                        continue;
                    bool found = false;
                    for (int g = 0; g < ghosts.count; g++)
                        found |= ghosts.source[g] == i && ghosts.image[g] == image;
                    assert_true(found);
                    next++;
                }
            assert_int_equal(ghosts.count, next);
            ghosts_free(&ghosts);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_image_stands_as_far_behind_the_wall),
        cmocka_unit_test(image_zero_is_the_particle_itself),
        cmocka_unit_test(an_image_of_an_image_is_the_particle),
        cmocka_unit_test(signs_follow_the_reflected_axes),
        cmocka_unit_test(a_plan_without_walls_is_empty),
        cmocka_unit_test(a_corner_gives_three_images_in_the_plane_and_seven_in_space),
        cmocka_unit_test(a_plan_holds_the_images_of_near_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
