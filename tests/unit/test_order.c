/* Orders of accuracy and extrapolation, of errors and values that are made up to have a known
 * order. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/base.h"
#include "exact/order.h"

static const double spacings[] = {4e-3, 2e-3, 1e-3, 0.3e-3}; /* the last step is another one */

static void errors_of_a_known_order_have_that_order(void **state)
{
    (void)state;
    static const double orders[] = {0.5, 1.0, 2.0, 3.7};
    for (size_t k = 0; k < COUNT_OF(orders); k++) {
        double error[4];
        for (int i = 0; i < 4; i++)
            error[i] = 1e9 * pow(spacings[i], orders[k]);
        assert_float_equal(order_fitted(spacings, error, 4), orders[k], 1e-12);
        for (int i = 1; i < 4; i++)
            assert_float_equal(order_between(spacings[i - 1], error[i - 1], spacings[i], error[i]),
                               orders[k], 1e-12);
    }
}

static void the_fitted_order_is_the_line_of_least_squares(void **state)
{
    (void)state;
    /* Of three runs that halve the spacing, the middle one has no say: the published L1 errors of
     * an elastic-plastic impact at 500, 1000 and 2000 particles. */
    const double spacing[] = {4, 2, 1}, error[] = {2.44e-2, 1.60e-2, 1.03e-2};
    assert_float_equal(order_fitted(spacing, error, 3), 0.62, 0.005);
    assert_float_equal(order_fitted(spacing, error, 3), log(2.44 / 1.03) / log(4.0), 1e-12);
}

static void runs_without_an_error_are_left_out(void **state)
{
    (void)state;
    const double error[] = {16.0, NAN, 1.0, 0.0};
    assert_float_equal(order_fitted(spacings, error, 4), 2.0, 1e-12);
    assert_true(isnan(order_fitted(spacings, error + 1, 2)));
    assert_true(isnan(order_between(2.0, 1.0, 1.0, 0.0)));
    assert_true(isnan(order_between(2.0, 1.0, 2.0, 0.5)));
}

static void a_monotone_sequence_gives_its_limit_and_order(void **state)
{
    (void)state;
    static const double orders[] = {0.3, 1.0, 2.0, 4.0};
    for (size_t k = 0; k < COUNT_OF(orders); k++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double value[4];
            for (int i = 0; i < 4; i++)
                value[i] = 8.13e9 + sign * 1e9 * pow(spacings[i] / spacings[0], orders[k]);
            for (int first = 0; first < 2; first++) {
                struct extrapolation e = extrapolate(spacings + first, value + first);
                assert_int_equal(e.approach, APPROACH_MONOTONE);
                assert_float_equal(e.order, orders[k], 1e-5);
                assert_float_equal(e.limit / 8.13e9, 1.0, 1e-5);
                assert_float_equal(e.index / (1.25 * fabs(value[first + 2] - 8.13e9)), 1.0, 1e-4);
            }
        }
}

/* The worked example of NASA's tutorial on grid convergence (NPARC, pressure recovery of an inlet):
 * 0.97050, 0.96854 and 0.96178 from fine to coarse give p = 1.78617, the limit 0.97130, an index of
 * 0.103083 %. */
static void a_worked_example_comes_out_as_published(void **state)
{
    (void)state;
    const double spacing[] = {4, 2, 1}, value[] = {0.96178, 0.96854, 0.97050};
    struct extrapolation e = extrapolate(spacing, value);
    assert_int_equal(e.approach, APPROACH_MONOTONE);
    assert_float_equal(e.order, 1.78617, 1e-5);
    assert_float_equal(e.limit, 0.97130, 5e-6);
    assert_float_equal(100.0 * e.index / value[2], 0.103083, 1e-4);
}

static void what_does_not_converge_is_called_so(void **state)
{
    (void)state;
    static const struct {
        double value[3];
        enum approach approach;
    } cases[] = {
        {{1.0, 2.0, 1.5}, APPROACH_OSCILLATING}, {{1.0, 2.0, 3.0}, APPROACH_DIVERGING},
        {{1.0, 2.0, 4.0}, APPROACH_DIVERGING},   {{1.0, 1.0, 2.0}, APPROACH_DIVERGING},
        {{1.0, 1.0, 1.0}, APPROACH_SETTLED},     {{2.0, 1.0, 1.0}, APPROACH_MONOTONE},
        {{1.0, NAN, 1.0}, APPROACH_UNKNOWN},     {{1.0, 2.0, INFINITY}, APPROACH_UNKNOWN},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        struct extrapolation e = extrapolate(spacings, cases[i].value);
        assert_int_equal(e.approach, cases[i].approach);
        assert_true(isnan(e.order));
        assert_true(e.approach == APPROACH_SETTLED || e.approach == APPROACH_MONOTONE
                        ? e.limit == 1.0
                        : isnan(e.limit));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_of_a_known_order_have_that_order),
        cmocka_unit_test(the_fitted_order_is_the_line_of_least_squares),
        cmocka_unit_test(runs_without_an_error_are_left_out),
        cmocka_unit_test(a_monotone_sequence_gives_its_limit_and_order),
        cmocka_unit_test(a_worked_example_comes_out_as_published),
        cmocka_unit_test(what_does_not_converge_is_called_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
