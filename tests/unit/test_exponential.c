/* The formulas of base/exponential.h against the library's functions of more digits: errors in
 * units in the last place. */
#include "dice.h"

#include <math.h>

#include "base/exponential.h"

enum { TRIALS = 200000 };

/* The error of VALUE in units in the last place of WANTED. */
static double units_off(double value, long double wanted)
{
    const double size = fabs((double)wanted);
    return (double)(fabsl((long double)value - wanted) / (nextafter(size, INFINITY) - size));
}

static void the_exponential_is_exact_to_a_unit(void **state)
{
    (void)state;
    struct dice dice = {5};
    double worst = 0.0;
    for (int k = 0; k < TRIALS; k++) {
        const double x =
            dice_between(&dice, -1.0, 1.0) * pow(10.0, dice_between(&dice, -6.0, 2.84));
        worst = fmax(worst, units_off(exponential(x), expl(x)));
    }
    assert_true(exponential(0.0) == 1.0);
    assert_true(worst < 1.0);
}

static void the_logarithm_is_exact_to_a_unit(void **state)
{
    (void)state;
    struct dice dice = {6};
    double worst = 0.0;
    for (int k = 0; k < TRIALS; k++) {
        const double near_one = dice_between(&dice, 0.5, 2.0);
        const double any = pow(10.0, dice_between(&dice, -300.0, 300.0));
        worst = fmax(worst, units_off(logarithm(near_one), logl(near_one)));
        worst = fmax(worst, units_off(logarithm(any), logl(any)));
    }
    assert_true(logarithm(1.0) == 0.0);
    assert_true(worst < 1.0);
}

/* n ln x is rounded before its exponential is taken. */
static void a_power_loses_as_many_units_as_its_logarithm(void **state)
{
    (void)state;
    struct dice dice = {7};
    double worst = 0.0;
    for (int k = 0; k < TRIALS; k++) {
        const double x = pow(10.0, dice_between(&dice, -10.0, 10.0));
        const double n = dice_between(&dice, 0.1, 5.0);
        worst = fmax(worst, units_off(power(x, n), powl(x, n)) / (1.0 + n * fabs(log(x))));
    }
    assert_true(power(0.0, 1.4) == 0.0);
    assert_true(worst < 2.0);
}

static void the_exponential_minus_one_is_exact_for_small_arguments_too(void **state)
{
    (void)state;
    struct dice dice = {8};
    double worst = 0.0;
    for (int k = 0; k < TRIALS; k++) {
        const double x =
            dice_between(&dice, -1.0, 1.0) * pow(10.0, dice_between(&dice, -20.0, 2.84));
        const double near = dice_between(&dice, -1.0, 1.0);
        worst = fmax(worst, units_off(exponential_minus_one(x), expm1l(x)));
        worst = fmax(worst, units_off(exponential_minus_one(near), expm1l(near)));
    }
    assert_true(exponential_minus_one(0.0) == 0.0);
    assert_true(exponential_minus_one(-700.0) == -1.0);
    assert_true(worst < 2.5);
}

static void the_cube_root_is_exact_to_a_unit(void **state)
{
    (void)state;
    struct dice dice = {9};
    double worst = 0.0;
    for (int k = 0; k < TRIALS; k++) {
        const double x = pow(10.0, dice_between(&dice, -300.0, 300.0));
        worst = fmax(worst, units_off(cube_root(x), cbrtl(x)));
    }
    assert_true(cube_root(0.0) == 0.0);
    assert_true(cube_root(27.0) == 3.0);
    assert_true(worst < 1.0);
}

static void the_cosine_of_a_third_needs_no_angle(void **state)
{
    (void)state;
    struct dice dice = {10};
    double worst = 0.0;
    for (int k = 0; k < TRIALS; k++) {
        const double near_end = pow(10.0, dice_between(&dice, -16.0, 0.0));
        const double c[] = {dice_between(&dice, -1.0, 1.0), near_end - 1.0, 1.0 - near_end};
        for (int i = 0; i < 3; i++)
            worst = fmax(worst, units_off(cosine_of_third(c[i]), cosl(acosl(c[i]) / 3.0L)));
    }
    assert_true(cosine_of_third(-1.0) == 0.5);
    assert_true(cosine_of_third(1.0) == 1.0);
    assert_true(worst < 1.5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_exponential_is_exact_to_a_unit),
        cmocka_unit_test(the_logarithm_is_exact_to_a_unit),
        cmocka_unit_test(a_power_loses_as_many_units_as_its_logarithm),
        cmocka_unit_test(the_exponential_minus_one_is_exact_for_small_arguments_too),
        cmocka_unit_test(the_cube_root_is_exact_to_a_unit),
        cmocka_unit_test(the_cosine_of_a_third_needs_no_angle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
