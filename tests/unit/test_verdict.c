/* No verdict over a value that is not finite: every form of a check fails over it and says why. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "stage.h"
#include "study/fits.h"

static const char case_text[] =
    "format: 1\n"
    "dimension: 1\n"
    "resolution: 1 mm\n"
    "solver: sph\n"
    "materials: {gas: {eos: {ideal-gas: {density: 2 kg/m^3, gamma: 1.4}}}}\n"
    "bodies:\n"
    "  left:  {material: gas, pressure: 1 Pa, box: {from: [0 mm], to: [10 mm]}}\n"
    "  right: {material: gas, pressure: 1 Pa, box: {from: [10 mm], to: [20 mm]}}\n"
    "exact: {gas-riemann: {left: {density: 2 kg/m^3, pressure: 2 Pa, gamma: 1.4},\n"
    "        right: {density: 2 kg/m^3, pressure: 1 Pa, gamma: 1.4}, at: 10 mm}}\n"
    "run: {until: 1 s}\n"
    "checks:\n";

/* Each would pass over an infinite value if limits alone decided. */
static const char forms[] =
    "  lower:     {maximum: pressure, at_least: 0 Pa}\n"
    "  upper:     {minimum: velocity.x, at_most: 1 m/s}\n"
    "  mean:      {mean: pressure, at_least: 0 Pa}\n"
    "  median:    {quantile: {field: pressure, fraction: 0.5}, at_most: 2 Pa}\n"
    "  spread:    {spread: pressure, at_least: 0 Pa}\n"
    "  energy:    {total: internal_energy, at_least: 0 J/m^2}\n"
    "  conserved: {conserved: energy, at_least: -1}\n"
    "  decay:     {decay: kinetic_energy, at_most: 1 1/s}\n"
    "  start:     {mean: density, of: left, relative: start, at_least: 0}\n"
    "  divided:   {total: kinetic_energy, of: left, relative: rest, at_least: 0}\n"
    "  rest:      {total: kinetic_energy, of: left, at_most: 1 J/m^2}\n"
    "  less:      {total: internal_energy, of: right, minus: energy, at_most: 1 J/m^2}\n"
    "  both:      {total: internal_energy, of: left, mean_with: [energy], at_least: 0 J/m^2}\n"
    "  excused:   {maximum: pressure, at_most: 1 Pa, known_deviation: the source is coarse}\n"
    "  front:     {front: {field: pressure, value: 1.5 Pa, from: low}, at_least: 0 m}\n"
    "  width:     {width: {field: pressure, ahead: 2 Pa, behind: 1 Pa}, at_most: 20}\n"
    "  nowhere:   {extent: {along: x}, between: [1 m, 2 m], at_most: 1 m}\n"
    "  largest:   {max_error: pressure, at_least: 0}\n"
    "  nothing:   {maximum: pressure, between: [1 m, 2 m], at_least: 0 Pa}\n"
    "  later:     {maximum: pressure, at: 0.9 s, at_least: 0 Pa}\n";

static void spoil(struct stage *s)
{
    struct particles *p = particles_of(&s->simulation);
    for (int32_t i = 0; i < p->count; i++) {
        p->velocity[i][0] = i == p->count - 1 ? -INFINITY : 0.0;
        if (i == 5) {
            p->pressure[i] = INFINITY;
            p->energy[i] = INFINITY;
        }
    }
}

static const struct check_result *result_of(const struct stage *s, const char *name)
{
    for (int i = 0; i < s->results.count; i++)
        if (!strcmp(s->results.item[i].name, name))
            return &s->results.item[i];
    fail_msg("no check %s", name);
    return NULL;
}

static void no_form_passes_over_a_value_that_is_not_finite(void **state)
{
    (void)state;
    struct stage s;
    int failed = 0;
    stage_begin(&s, case_text, forms);
    spoil(&s);
    for (int i = 0; i < s.input->checks.count; i++)
        if (!strcmp(s.input->checks.names[i], "start"))
            s.memory[i].start = 0.0;
    stage_value(&s, 0);
    for (int i = 0; i < s.results.count; i++) {
        const struct check_result *result = &s.results.item[i];
        if (!strcmp(result->name, "rest"))
            continue;
        if (isfinite(result->measured))
            fail_msg("%s measured %g", result->name, result->measured);
        assert_int_equal(result->verdict, CHECK_FAILED);
        assert_non_null(result->nothing);
        failed++;
    }
    assert_true(failed >= 14);
    stage_close(&s);
}

static void expect_reason(const struct stage *s, const char *name, const char *words)
{
    const struct check_result *result = result_of(s, name);
    char *text = check_verdict_text(result);
    if (!strstr(text, words))
        fail_msg("%s: \"%s\" lacks \"%s\"", name, text, words);
    free(text);
}

static void nothing_says_why(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text, forms);
    spoil(&s);
    for (int i = 0; i < s.input->checks.count; i++)
        if (!strcmp(s.input->checks.names[i], "start"))
            s.memory[i].start = 0.0;
    stage_value(&s, 0);
    expect_reason(&s, "start", "the value at the start is 0");
    expect_reason(&s, "divided", "\"rest\" of `relative` measured 0");
    expect_reason(&s, "less", "\"energy\" of `minus` has no finite value");
    expect_reason(&s, "nothing", "no member is there between 1 m and 2 m along x");
    expect_reason(&s, "later", "the run ended before t = 0.9 s");
    expect_reason(&s, "median", "a value among those measured is not a finite number");
    stage_close(&s);
}

/* A bound of change about a recorded infinity, and while the record is made. */
static void no_regression_bound_excuses_an_infinite_value(void **state)
{
    (void)state;
    struct check_input check = {.regression_bound.value = 0.1};
    check.is.value = check.within.value = check.at_least.value = check.at_most.value = NAN;
    for (int k = 0; k < 4; k++) {
        check.recorded.value = k % 2 ? (double)INFINITY : (double)NAN;
        check.is.value = k / 2 ? 1.0 : (double)NAN;
        struct check_result result = {.measured = INFINITY, .low = -INFINITY, .high = INFINITY};
        check_judge(&check, false, &result);
        assert_int_equal(result.verdict, CHECK_FAILED);
    }
}

/* Three runs of a sweep of which one measured an infinite value. */
static void a_fit_fails_over_an_infinite_value(void **state)
{
    (void)state;
    char of[] = "y", over[] = "x", name[] = "slope", *names[] = {name};
    struct fit_input fit = {.of = of, .over = over, .from.value = NAN, .to.value = NAN};
    fit.check.is.value = fit.check.within.value = fit.check.at_least.value = NAN;
    fit.check.regression_bound.value = fit.check.recorded.value = NAN;
    fit.check.at_most.value = 1e300;
    struct simulation_case input = {.fits = {1, names, &fit, {0}}};
    struct check_result item[3][2] = {0};
    struct verify_case runs[3] = {0};
    struct check_results results;
    for (int i = 0; i < 3; i++) {
        item[i][0] = (struct check_result){.name = over, .measured = i};
        item[i][1] = (struct check_result){.name = of, .measured = 2.0 * i};
        runs[i].result.checks = (struct check_results){.count = 2, .item = item[i]};
    }
    assert_null(fits_evaluate(&input, runs, 3, &results));
    assert_int_equal(results.item[0].verdict, CHECK_PASSED);
    check_results_free(&results);
    item[1][1].measured = INFINITY;
    assert_null(fits_evaluate(&input, runs, 3, &results));
    assert_int_equal(results.item[0].verdict, CHECK_FAILED);
    assert_non_null(results.item[0].nothing);
    check_results_free(&results);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_form_passes_over_a_value_that_is_not_finite),
        cmocka_unit_test(nothing_says_why),
        cmocka_unit_test(no_regression_bound_excuses_an_infinite_value),
        cmocka_unit_test(a_fit_fails_over_an_infinite_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
