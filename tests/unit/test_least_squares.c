/* Least squares with bounds: curved and singular problems, places without a value, bounds, few
 * runs; and covariances. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "study/least_squares.h"

/* How often the residuals were asked for, and what they are of. */
struct asked {
    int runs, stop_at;
    double forbidden; /* the first unknown must be below */
};

/* A curved valley with its end at (0.3, 0.7). */
static enum residuals_end valley(void *context, const double *u, double *r)
{
    struct asked *asked = context;
    if (++asked->runs == asked->stop_at)
        return RESIDUALS_STOP;
    if (u[0] >= asked->forbidden)
        return RESIDUALS_FAILED;
    const double x = u[0] - 0.3, y = u[1] - 0.7;
    r[0] = 10.0 * (y + 0.5 * x - 0.4 * x * x);
    r[1] = 10.0 * (x + 0.3 * y * y);
    r[2] = 2.0 * (x - y) * (1.0 + x);
    return RESIDUALS_DONE;
}

static struct least_squares_result fit(struct asked *asked, const double *start, int most)
{
    const struct least_squares problem = {
        .unknowns = 2,
        .residuals = 3,
        .start = start,
        .within = 1e-3,
        .most = most,
        .evaluate = valley,
        .context = asked,
    };
    struct least_squares_result result;
    assert_null(least_squares(&problem, &result));
    return result;
}

static void the_end_of_a_valley_is_found_in_few_runs(void **state)
{
    (void)state;
    struct asked asked = {.forbidden = 2.0};
    struct least_squares_result result = fit(&asked, (const double[]){0.9, 0.1}, 20);
    assert_int_equal(result.end, LEAST_SQUARES_WITHIN);
    assert_true(fabs(result.at[0] - 0.3) < 1e-2 && fabs(result.at[1] - 0.7) < 1e-2);
    assert_true(asked.runs <= 10);
    least_squares_free(&result);
}

static void a_step_to_where_there_is_no_value_is_shortened(void **state)
{
    (void)state;
    struct asked asked = {.forbidden = 0.32};
    struct least_squares_result result = fit(&asked, (const double[]){0.0, 0.0}, 40);
    assert_int_equal(result.end, LEAST_SQUARES_WITHIN);
    assert_true(fabs(result.at[0] - 0.3) < 1e-2);
    least_squares_free(&result);
    asked = (struct asked){.forbidden = 0.0};
    result = fit(&asked, (const double[]){0.5, 0.5}, 40);
    assert_int_equal(result.end, LEAST_SQUARES_NO_START);
    assert_int_equal(asked.runs, 1);
    least_squares_free(&result);
}

static void it_ends_when_the_runs_are_used_up_or_it_is_stopped(void **state)
{
    (void)state;
    struct asked asked = {.forbidden = 2.0};
    struct least_squares_result result = fit(&asked, (const double[]){0.9, 0.1}, 4);
    assert_int_equal(result.end, LEAST_SQUARES_MOST_RUNS);
    assert_int_equal(asked.runs, 4);
    least_squares_free(&result);
    asked = (struct asked){.forbidden = 2.0, .stop_at = 3};
    result = fit(&asked, (const double[]){0.9, 0.1}, 40);
    assert_int_equal(result.end, LEAST_SQUARES_STOPPED);
    assert_false(result.differentiated);
    least_squares_free(&result);
}

/* r = (10 (u0 - 1.4), 10 (u1 - 0.5) + 5 (u0 - 1.4)): the best is at (1, 0.7). */
static enum residuals_end outside(void *context, const double *u, double *r)
{
    (void)context;
    r[0] = 10.0 * (u[0] - 1.4);
    r[1] = 10.0 * (u[1] - 0.5) + 5.0 * (u[0] - 1.4);
    return RESIDUALS_DONE;
}

static void an_unknown_stays_at_its_bound_and_the_others_move_on(void **state)
{
    (void)state;
    const struct least_squares problem = {.unknowns = 2,
                                          .residuals = 2,
                                          .start = (const double[]){0.2, 0.2},
                                          .within = 1e-6,
                                          .most = 40,
                                          .evaluate = outside};
    struct least_squares_result result;
    assert_null(least_squares(&problem, &result));
    assert_int_equal(result.end, LEAST_SQUARES_NEAREST);
    assert_true(result.at[0] == 1.0 && fabs(result.at[1] - 0.7) < 2e-3);
    least_squares_free(&result);
}

/* J'J of these rows is ((2, 1), (1, 1)), whose inverse is ((1, -1), (-1, 2)). */
static void covariances_are_the_inverse(void **state)
{
    (void)state;
    double covariance[4];
    least_squares_covariance(2, 2, (const double[]){1.0, 0.0, 1.0, 1.0}, covariance);
    assert_true(fabs(covariance[0] - 1.0) < 1e-8 && fabs(covariance[3] - 2.0) < 1e-8);
    assert_true(fabs(covariance[1] + 1.0) < 1e-8 && covariance[1] == covariance[2]);
    least_squares_covariance(2, 2, (const double[]){1.0, 2.0, 2.0, 4.0}, covariance);
    assert_true(covariance[1] / sqrt(covariance[0] * covariance[3]) < -0.999);
    least_squares_covariance(2, 2, (const double[]){1.0, 0.0, 2.0, 0.0}, covariance);
    assert_true(isinf(covariance[3]) && covariance[1] == 0.0);
    assert_true(fabs(covariance[0] - 0.2) < 1e-8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_end_of_a_valley_is_found_in_few_runs),
        cmocka_unit_test(a_step_to_where_there_is_no_value_is_shortened),
        cmocka_unit_test(it_ends_when_the_runs_are_used_up_or_it_is_stopped),
        cmocka_unit_test(an_unknown_stays_at_its_bound_and_the_others_move_on),
        cmocka_unit_test(covariances_are_the_inverse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
