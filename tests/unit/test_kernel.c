/* The cubic spline: its integral, its first moment (which sets the numerical viscosity) and its
 * slope. */
#include "dice.h"

#include "sph/kernel.h"

static const double pi = 3.14159265358979323846;

/* Integral of W r^POWER over space, by Gauss' rule of five points, exact up to the ninth degree, on
 * each of the two pieces. */
static double moment(double h, int dimension, int power)
{
    static const double node[5] = {-0.90617984593866399280, -0.53846931010568309104, 0.0,
                                   0.53846931010568309104, 0.90617984593866399280};
    static const double weight[5] = {0.23692688505618908751, 0.47862867049936646804,
                                     0.56888888888888888889, 0.47862867049936646804,
                                     0.23692688505618908751};
    double sum = 0.0;
    for (int piece = 0; piece < 2; piece++)
        for (int k = 0; k < 5; k++) {
            double r = h * (piece + 0.5 + 0.5 * node[k]);
            double shell = dimension == 1 ? 2.0 : dimension == 2 ? 2.0 * pi * r : 4.0 * pi * r * r;
            sum +=
                0.5 * h * weight[k] * kernel_value(r, 1.0 / h, dimension) * shell * pow(r, power);
        }
    return sum;
}

static void the_kernel_integrates_to_one(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; dimension++) {
        assert_near(moment(1.0, dimension, 0), 1.0, 1e-14);
        assert_near(moment(3e-5, dimension, 0), 1.0, 1e-14);
    }
}

static void the_mean_distance_is_as_derived(void **state)
{
    (void)state;
    const double h = 0.01;
    assert_near(moment(h, 1, 1) / h, 7.0 / 15.0, 1e-14);
    assert_near(moment(h, 2, 1) / h, 5.0 / 7.0, 1e-14);
    assert_near(moment(h, 3, 1) / h, 31.0 / 35.0, 1e-14);
}

static void the_slope_is_the_derivative(void **state)
{
    (void)state;
    const double h = 0.3, step = 1e-5;
    for (int dimension = 1; dimension <= 3; dimension++)
        for (double r = 0.01; r < 2.2 * h; r += 0.007) {
            double difference = (kernel_value(r + step, 1.0 / h, dimension) -
                                 kernel_value(r - step, 1.0 / h, dimension)) /
                                (2.0 * step);
            double scale = kernel_value(0.0, 1.0 / h, dimension) / h;
            assert_near(kernel_slope(r, 1.0 / h, dimension), difference, 1e-8 * scale);
            assert_true(kernel_slope(r, 1.0 / h, dimension) <= 0.0);
        }
}

static void the_kernel_ends_at_two_smoothing_lengths(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; dimension++) {
        assert_true(kernel_value(2.0, 1.0, dimension) == 0.0);
        assert_true(kernel_slope(2.0, 1.0, dimension) == 0.0);
        assert_true(kernel_value(1e9, 1.0, dimension) == 0.0);
        assert_true(kernel_slope(1e9, 1.0, dimension) == 0.0);
        assert_true(kernel_value(1.9999, 1.0, dimension) > 0.0);
    }
}

/* Section 0.3 of the acceptance tests: with h = D only the nearest neighbours act, as Godunov's
 * scheme. */
static void the_nearest_neighbour_alone_weighs_one_over_the_diameter(void **state)
{
    (void)state;
    for (double d = 1e-6; d < 10.0; d *= 3.7) {
        assert_close(2.0 * d * kernel_slope(d, 1.0 / d, 1), -1.0 / d, 1e-14);
        assert_near(d * d * kernel_slope(2.0 * d, 1.0 / d, 1), 0.0, 1e-30);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_kernel_integrates_to_one),
        cmocka_unit_test(the_mean_distance_is_as_derived),
        cmocka_unit_test(the_slope_is_the_derivative),
        cmocka_unit_test(the_kernel_ends_at_two_smoothing_lengths),
        cmocka_unit_test(the_nearest_neighbour_alone_weighs_one_over_the_diameter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
