/* Measures and checks against small sets of particles whose answers are known by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "exact/choices.h"
#include "exact/gas_riemann.h"
#include "populations.h"
#include "run/checks.h"
#include "shape/kinds.h"

/* Two bodies on [0, 0.5) and [0.5, 1) m, 20 particles each, at rest. */
enum { BODIES = 2, EACH = 20, ALL = BODIES * EACH };

struct bench {
    struct shape_box box[BODIES];
    struct body_input body[BODIES];
    char *names[BODIES];
    struct check_input check;
    char *check_names[1];
    struct simulation_case input;
    struct ranks ranks;
    struct simulation simulation;
    struct population population;
    struct totals start;
    struct check_memory memory;
    struct exact_gas_riemann gas;
};

/* The members as they are now. */
static const struct population *look(struct bench *b)
{
    b->population = simulation_population(&b->simulation);
    return &b->population;
}

static const struct choice *choice_of(const struct choice *choices, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (!strcmp(choices[i].name, name))
            return &choices[i];
    fail_msg("no choice %s", name);
    return NULL;
}

static void place_particles(struct bench *bench)
{
    int32_t first;
    assert_null(give_particles(&bench->simulation, 0.1, NULL, 0));
    struct particles *p = particles_of(&bench->simulation);
    assert_null(particles_append(p, ALL, &first));
    for (int i = 0; i < ALL; i++) {
        p->id[i] = particle_id(i / EACH, i % EACH);
        p->body[i] = (uint16_t)(i / EACH);
        p->mass[i] = 1.0 / ALL;
        p->density[i] = 1.0;
        p->position[i][0] = (i + 0.5) / ALL;
    }
    assert_null(particles_commit(p));
}

static int setup(void **state)
{
    struct bench *b = calloc(1, sizeof *b);
    static char left[] = "left", right[] = "right", it[] = "it";
    char *const names[BODIES] = {left, right};
    for (int i = 0; i < BODIES; i++) {
        b->box[i] = (struct shape_box){{1, {0.5 * i}}, {1, {0.5 * (i + 1)}}};
        b->body[i].shape.choice = choice_of(shape_choices, shape_choice_count, "box");
        b->body[i].shape.value = &b->box[i];
        b->names[i] = names[i];
    }
    b->input.dimension = 1;
    b->input.bodies = (struct named_map){BODIES, b->names, b->body, {0}};
    b->check_names[0] = it;
    b->input.checks = (struct named_map){0, b->check_names, &b->check, {0}};
    b->check.is.value = b->check.within.value = b->check.scale.value = NAN;
    b->check.at_least.value = b->check.at = NAN;
    b->check.regression_bound.value = b->check.recorded.value = NAN;
    b->check.relative_check = -1;
    b->check.at_most.value = 1e300;
    b->ranks = ranks_alone();
    problem_of(&b->simulation)->input = &b->input;
    b->simulation.ranks = &b->ranks;
    problem_of(&b->simulation)->dimension = 1;
    place_particles(b);
    b->start = population_totals(simulation_population(&b->simulation), &b->ranks, -1);
    b->gas = (struct exact_gas_riemann){{{1.0, 0.0, 1.0, 1.4}, {0.125, 0.0, 0.1, 1.4}}, 0.5};
    *state = b;
    return 0;
}

static int teardown(void **state)
{
    struct bench *b = *state;
    end_simulation(&b->simulation);
    free(b);
    return 0;
}

static void choose(struct bench *b, const char *measure, void *parameters)
{
    b->input.checks.count = 1;
    b->check.measure.choice = choice_of(measure_choices, MEASURES, measure);
    b->check.measure.value = parameters;
}

/* Prepares and evaluates the one check. */
static struct error *evaluate(struct bench *b, struct check_result *result)
{
    struct checks *checks;
    struct check_results results;
    TRY(checks_prepare(&b->simulation, look(b), NULL, &checks));
    struct check_moment moment = {&b->simulation, look(b), &b->start, &b->memory};
    struct error *error = checks_evaluate(checks, &moment, &results);
    if (!error) {
        *result = results.item[0];
        result->name = result->source = result->nothing = NULL;
    }
    check_results_free(&results);
    checks_free(checks);
    return error;
}

static double value_of(struct bench *b, const char *measure, void *parameters)
{
    struct check_result result = {0};
    /* Every measure is given a limit of its own dimension, so that it passes preparation. */
    choose(b, measure, parameters);
    assert_null(evaluate(b, &result));
    return result.measured;
}

/* The limit of the check, with the dimension of pressure, length or none. */
static void limit_dimension(struct bench *b, struct dimension dimension)
{
    b->check.at_most.dimension = dimension;
}

static const struct dimension pascal = {-1, 1, -2, 0}, metre = {1, 0, 0, 0}, one = {0, 0, 0, 0};
static struct measure_field pressure = {(char[]){"pressure"}};
static struct measure_weighted counted = {{(char[]){"pressure"}}, WEIGHT_NUMBER};

static void mean_counts_every_particle_of_the_window_once(void **state)
{
    struct bench *b = *state;
    limit_dimension(b, pascal);
    for (int i = 0; i < ALL; i++)
        particles_of(&b->simulation)->pressure[i] = i;
    assert_float_equal(value_of(b, "mean", &counted), (ALL - 1) / 2.0, 1e-13);
    b->check.of = b->names[1];
    assert_float_equal(value_of(b, "mean", &counted), EACH + (EACH - 1) / 2.0, 1e-13);
    b->check.of = NULL;
    b->check.between = (struct vector_value){2, {0.0, 0.1}};
    assert_float_equal(value_of(b, "mean", &counted), 1.5, 1e-14);
    b->check.between = (struct vector_value){2, {2.0, 3.0}};
    assert_true(isnan(value_of(b, "mean", &counted)));
}

static void a_mean_and_a_quantile_may_count_by_mass_or_volume(void **state)
{
    struct bench *b = *state;
    struct particles *p = particles_of(&b->simulation);
    limit_dimension(b, pascal);
    for (int i = 0; i < ALL; i++) {
        p->pressure[i] = i;
        p->mass[i] = i < ALL / 2 ? 1.0 : 3.0;
        p->density[i] = i < ALL / 2 ? 1.0 : 1.5;
    }
    const double low = (ALL / 2 - 1) / 2.0, high = low + ALL / 2;
    struct measure_weighted mean = {{(char[]){"pressure"}}, WEIGHT_MASS};
    assert_float_equal(value_of(b, "mean", &mean), (low + 3.0 * high) / 4.0, 1e-13);
    mean.weight = WEIGHT_VOLUME;
    assert_float_equal(value_of(b, "mean", &mean), (low + 2.0 * high) / 3.0, 1e-13);
    struct measure_quantile quantile = {pressure, 0.25, WEIGHT_MASS};
    assert_float_equal(value_of(b, "quantile", &quantile), ALL / 2 - 1, 0.0);
    mean.weight = WEIGHT_NUMBER;
    assert_float_equal(value_of(b, "spread", &mean), sqrt((ALL * ALL - 1) / 12.0), 1e-13);
}

static void extremes_are_found_and_nonsense_is_not_hidden(void **state)
{
    struct bench *b = *state;
    double *p = particles_of(&b->simulation)->pressure;
    limit_dimension(b, pascal);
    p[3] = -7.0;
    p[30] = 9.0;
    assert_float_equal(value_of(b, "minimum", &pressure), -7.0, 0.0);
    assert_float_equal(value_of(b, "maximum", &pressure), 9.0, 0.0);
    p[17] = NAN;
    p[18] = INFINITY;
    assert_true(isnan(value_of(b, "maximum", &pressure)));
    limit_dimension(b, one);
    assert_float_equal(value_of(b, "finite", &pressure), 2.0, 0.0);
}

static void a_quantile_is_the_value_that_a_fraction_does_not_exceed(void **state)
{
    struct bench *b = *state;
    double *p = particles_of(&b->simulation)->pressure;
    limit_dimension(b, pascal);
    for (int i = 0; i < ALL; i++)
        p[i] = (i * 7) % ALL - 20.0; /* all whole numbers from -20 to 19 */
    struct measure_quantile quantile = {pressure, 0.975, WEIGHT_NUMBER};
    assert_float_equal(value_of(b, "quantile", &quantile), 18.0, 0.0);
    quantile.fraction = 1.0;
    assert_float_equal(value_of(b, "quantile", &quantile), 19.0, 0.0);
    quantile.fraction = 0.1;
    assert_float_equal(value_of(b, "quantile", &quantile), -17.0, 0.0);
    quantile.fraction = 0.525;
    assert_float_equal(value_of(b, "quantile", &quantile), 0.0, 0.0);
    p[17] = NAN;
    assert_true(isnan(value_of(b, "quantile", &quantile)));
}

static void front_lies_between_the_particles_that_straddle_the_value(void **state)
{
    struct bench *b = *state;
    struct measure_front front = {
        .field = (char[]){"pressure"}, .value = {2.5, pascal}, .from = FRONT_FROM_HIGH};
    limit_dimension(b, metre);
    for (int i = 0; i < 10; i++)
        particles_of(&b->simulation)->pressure[i] = 10.0;
    assert_float_equal(value_of(b, "front", &front), (9.5 + 0.75) / ALL, 1e-14);
    particles_of(&b->simulation)->pressure[30] = 10.0;
    assert_float_equal(value_of(b, "front", &front), (30.5 + 0.75) / ALL, 1e-14);
    front.from = FRONT_FROM_LOW;
    assert_float_equal(value_of(b, "front", &front), (9.5 + 0.75) / ALL, 1e-14);
    front.value.value = 11.0;
    assert_true(isnan(value_of(b, "front", &front)));
}

static void width_counts_the_particles_between_a_tenth_and_nine_tenths(void **state)
{
    struct bench *b = *state;
    struct measure_width width = {
        .field = (char[]){"pressure"}, .ahead = {1.0, pascal}, .behind = {11.0, pascal}};
    const double front[] = {11.0, 10.5, 9.9, 6.0, 2.1, 1.9, 1.0};
    limit_dimension(b, one);
    for (int i = 0; i < ALL; i++)
        particles_of(&b->simulation)->pressure[i] = i < 10 ? 11.0 : i < 17 ? front[i - 10] : 1.0;
    assert_float_equal(value_of(b, "width", &width), 3.0, 0.0);
    b->check.between = (struct vector_value){2, {0.0, 13.0 / ALL}};
    assert_float_equal(value_of(b, "width", &width), 1.0, 0.0);
    particles_of(&b->simulation)->pressure[3] = NAN;
    assert_true(isnan(value_of(b, "width", &width)));
}

static void slabs_average_a_ragged_front(void **state)
{
    struct bench *b = *state;
    struct measure_front front = {.field = (char[]){"pressure"},
                                  .value = {2.5, pascal},
                                  .from = FRONT_FROM_HIGH,
                                  .slab = 0.1};
    limit_dimension(b, metre);
    for (int i = 0; i < ALL; i += 2) /* alternately 10 and 0 up to the middle: mean 5 */
        particles_of(&b->simulation)->pressure[i] = i < EACH ? 10.0 : 0.0;
    assert_float_equal(value_of(b, "front", &front), 0.5, 1e-12);
}

static void a_front_is_told_in_the_frame_of_the_matter_ahead(void **state)
{
    struct bench *b = *state;
    struct measure_front front = {.field = (char[]){"pressure"},
                                  .value = {2.5, pascal},
                                  .from = FRONT_FROM_HIGH,
                                  .frame = -0.5};
    limit_dimension(b, metre);
    for (int i = 0; i < 10; i++)
        particles_of(&b->simulation)->pressure[i] = 10.0;
    b->simulation.time = 0.25;
    assert_float_equal(value_of(b, "front", &front), (9.5 + 0.75) / ALL + 0.125, 1e-14);
}

static void use_gas(struct bench *b)
{
    b->input.exact.choice = choice_of(exact_choices, exact_choice_count, "gas-riemann");
    b->input.exact.value = &b->gas;
    limit_dimension(b, one);
}

static void about_a_point_places_are_distances(void **state)
{
    struct bench *b = *state;
    struct measure_front front = {
        .field = (char[]){"pressure"}, .value = {2.5, pascal}, .from = FRONT_FROM_HIGH};
    b->check.about = (struct vector_value){1, {0.5}};
    limit_dimension(b, pascal);
    for (int i = 0; i < ALL; i++) /* 10 within 0.25 of the middle */
        particles_of(&b->simulation)->pressure[i] = i >= 10 && i < 30 ? 10.0 : 0.0;
    b->check.between = (struct vector_value){2, {0.0, 0.2}};
    assert_float_equal(value_of(b, "mean", &counted), 10.0, 0.0);
    b->check.between = (struct vector_value){2, {0.3, 1.0}};
    assert_float_equal(value_of(b, "mean", &counted), 0.0, 0.0);
    b->check.between.count = 0;
    limit_dimension(b, metre);
    assert_float_equal(value_of(b, "front", &front), (9.5 + 0.75) / ALL, 1e-14);
}

/* At time zero the exact solution is the start itself. */
static void error_norms_measure_the_distance_from_the_exact_solution(void **state)
{
    struct bench *b = *state;
    use_gas(b);
    for (int i = 0; i < ALL; i++)
        particles_of(&b->simulation)->pressure[i] = i < EACH ? 1.0 : 0.1;
    assert_float_equal(value_of(b, "l1", &pressure), 0.0, 1e-15);
    particles_of(&b->simulation)->pressure[5] += 0.8;
    b->check.scale = (struct quantity){2.0, pascal};
    assert_float_equal(value_of(b, "l1", &pressure), 0.8 / ALL / 2.0, 1e-15);
    assert_float_equal(value_of(b, "rms", &pressure), sqrt(0.64 / ALL) / 2.0, 1e-15);
    assert_float_equal(value_of(b, "max_error", &pressure), 0.4, 1e-15);
    b->check.scale.value = NAN; /* the range of the exact values: 0.9 */
    assert_float_equal(value_of(b, "max_error", &pressure), 0.8 / 0.9, 1e-15);
}

static void a_particle_is_judged_by_the_side_on_which_its_body_started(void **state)
{
    struct bench *b = *state;
    use_gas(b);
    b->check.scale = (struct quantity){1.0, pascal};
    for (int i = 0; i < ALL; i++)
        particles_of(&b->simulation)->pressure[i] = i < EACH ? 1.0 : 0.1;
    particles_of(&b->simulation)->position[EACH - 1][0] = 0.51; /* strayed over the contact */
    assert_float_equal(value_of(b, "max_error", &pressure), 0.0, 1e-15);
}

static void contact_norms_take_ten_particles_a_side(void **state)
{
    struct bench *b = *state;
    use_gas(b);
    b->simulation.time = 0.1;
    const double star = 0.30313017805064707; /* Sod's problem, Toro's book, test 1 */
    double *p = particles_of(&b->simulation)->pressure;
    for (int i = 0; i < ALL; i++)
        p[i] = i >= EACH - 10 && i < EACH + 10 ? star : 1e6;
    assert_float_equal(value_of(b, "contact_max", &pressure), 0.0, 1e-9);
    p[EACH + 9] = 1.2 * star;
    assert_float_equal(value_of(b, "contact_max", &pressure), 0.2, 1e-9);
    assert_float_equal(value_of(b, "contact_rms", &pressure), 0.2 / sqrt(20.0), 1e-9);
}

static void what_the_ledger_booked_is_conserved(void **state)
{
    struct bench *b = *state;
    struct measure_conserved momentum = {CONSERVED_MOMENTUM}, energy = {CONSERVED_ENERGY};
    struct particles *p = particles_of(&b->simulation);
    limit_dimension(b, one);
    p->velocity[4][0] = 40.0;
    assert_float_equal(value_of(b, "conserved", &momentum), 1.0, 1e-15);
    assert_float_equal(value_of(b, "conserved", &energy), 1.0, 1e-15);
    struct vec3 push = {1.0, 0.0, 0.0}, place = {0.0, 0.0, 0.0};
    ledger_book(&b->simulation.ledger, LEDGER_WALLS, 0.0, push, place, 20.0);
    assert_float_equal(value_of(b, "conserved", &momentum), 0.0, 1e-15);
    assert_float_equal(value_of(b, "conserved", &energy), 0.0, 1e-15);
}

static void within_is_a_fraction_of_what_is_wanted_or_a_quantity(void **state)
{
    struct bench *b = *state;
    struct check_result result = {0};
    choose(b, "mean", &counted);
    for (int i = 0; i < ALL; i++)
        particles_of(&b->simulation)->pressure[i] = -103.0;
    b->check.at_most.value = NAN;
    b->check.is = (struct quantity){-100.0, pascal};
    b->check.within = (struct quantity){0.02, one};
    assert_null(evaluate(b, &result));
    assert_float_equal(result.low, -102.0, 1e-12);
    assert_float_equal(result.high, -98.0, 1e-12);
    assert_int_equal(result.verdict, CHECK_FAILED);
    b->check.within = (struct quantity){5.0, pascal};
    assert_null(evaluate(b, &result));
    assert_int_equal(result.verdict, CHECK_PASSED);
    particles_of(&b->simulation)->pressure[0] = NAN;
    assert_null(evaluate(b, &result));
    assert_int_equal(result.verdict, CHECK_FAILED);
}

static void a_regression_bound_starts_from_what_was_recorded(void **state)
{
    struct bench *b = *state;
    struct check_result result = {0};
    choose(b, "mean", &counted);
    for (int i = 0; i < ALL; i++)
        particles_of(&b->simulation)->pressure[i] = 95.0;
    b->check.at_most.value = NAN;
    b->check.regression_bound = (struct quantity){0.1, one};
    b->check.recorded = (struct quantity){90.0, pascal};
    assert_null(evaluate(b, &result)); /* a value may change by a tenth */
    assert_float_equal(result.low, 81.0, 1e-12);
    assert_float_equal(result.high, 99.0, 1e-12);
    assert_int_equal(result.verdict, CHECK_PASSED);
    assert_true(result.regression_bound);
    b->check.is = (struct quantity){100.0, pascal};
    assert_null(evaluate(b, &result)); /* a distance from what is wanted may grow by a tenth */
    assert_float_equal(result.low, 89.0, 1e-12);
    assert_float_equal(result.high, 111.0, 1e-12);
    b->check.regression_bound = (struct quantity){3.0, pascal};
    assert_null(evaluate(b, &result));
    assert_float_equal(result.low, 87.0, 1e-12);
    b->check.within = (struct quantity){0.04, one};
    assert_null(evaluate(b, &result)); /* other limits hold besides */
    assert_float_equal(result.low, 96.0, 1e-12);
    assert_int_equal(result.verdict, CHECK_FAILED);
}

static void expect_mistake(struct bench *b, const char *text)
{
    struct checks *checks;
    struct error *error = checks_prepare(&b->simulation, look(b), NULL, &checks);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_non_null(strstr(error_message(error, 0), text));
    error_free(error);
}

static void what_is_allowed_reads_as_it_is(void **state)
{
    (void)state;
    static const struct {
        double wanted, low, high;
        const char *text;
    } cases[] = {
        {500.0, 495.0, 505.0, "500 m/s +- 5 m/s"},
        {500.0, 495.0, 501.0, "495 m/s .. 501 m/s"},
        {500.0, 500.0 - 0x1p-30, 500.0 + 0x1p-30, "500 m/s +- 9.3132e-10 m/s"},
        {0.0, -2.0, 2.0, "0 +- 2 m/s"},
        {0.0, -2.0, 1.0, "-2 m/s .. 1 m/s"},
        {NAN, -INFINITY, 1.0, "at most 1 m/s"},
        {NAN, 1.0, INFINITY, "at least 1 m/s"},
        {NAN, 1.0, 2.0, "1 m/s .. 2 m/s"},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        struct check_result result = {
            .unit = "m/s", .wanted = cases[i].wanted, .low = cases[i].low, .high = cases[i].high};
        char text[96];
        check_allowed_text(&result, text, sizeof text);
        assert_string_equal(text, cases[i].text);
    }
}

static void mistakes_in_checks_are_told_before_the_run(void **state)
{
    struct bench *b = *state;
    struct measure_weighted wrong = {{(char[]){"presure"}}, WEIGHT_NUMBER},
                            vector = {{(char[]){"velocity"}}, WEIGHT_NUMBER};
    choose(b, "mean", &wrong);
    expect_mistake(b, "no field \"presure\" (did you mean \"pressure\"?)");
    choose(b, "mean", &vector);
    expect_mistake(b, "choose its component: velocity.x");
    choose(b, "mean", &counted);
    b->check.at_most = (struct quantity){1.0, metre};
    expect_mistake(b, "`at_most` is in m");
    choose(b, "l1", &pressure);
    b->check.at_most = (struct quantity){1.0, one};
    expect_mistake(b, "needs an exact solution");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(mean_counts_every_particle_of_the_window_once),
        TEST(a_mean_and_a_quantile_may_count_by_mass_or_volume),
        TEST(extremes_are_found_and_nonsense_is_not_hidden),
        TEST(a_quantile_is_the_value_that_a_fraction_does_not_exceed),
        TEST(front_lies_between_the_particles_that_straddle_the_value),
        TEST(width_counts_the_particles_between_a_tenth_and_nine_tenths),
        TEST(slabs_average_a_ragged_front),
        TEST(a_front_is_told_in_the_frame_of_the_matter_ahead),
        TEST(about_a_point_places_are_distances),
        TEST(error_norms_measure_the_distance_from_the_exact_solution),
        TEST(a_particle_is_judged_by_the_side_on_which_its_body_started),
        TEST(contact_norms_take_ten_particles_a_side),
        TEST(what_the_ledger_booked_is_conserved),
        TEST(within_is_a_fraction_of_what_is_wanted_or_a_quantity),
        TEST(a_regression_bound_starts_from_what_was_recorded),
        TEST(what_is_allowed_reads_as_it_is),
        TEST(mistakes_in_checks_are_told_before_the_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
