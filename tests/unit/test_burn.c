/* Burning: values of the products, the share burnt against its formulas, and when a detonation
 * arrives. Values: Cui, dissertation (2014), table 3.1, (3-1), (3-2). */
#include "dice.h"

#include "build_case.h"
#include "material/material.h"

static const struct eos tnt_products = {
    EOS_jwl, {.jwl = {1630.0, 371.2e9, 3.21e9, 4.15, 0.95, 0.3, 6.993e9}}};
static const struct material programmed = {
    .eos = {EOS_jwl, {.jwl = {1630.0, 371.2e9, 3.21e9, 4.15, 0.95, 0.3, 6.993e9}}},
    .burn = {BURN_programmed, {.programmed = {6930.0}}}};
static const struct material beta = {
    .eos = {EOS_jwl, {.jwl = {1630.0, 371.2e9, 3.21e9, 4.15, 0.95, 0.3, 6.993e9}}},
    .burn = {BURN_beta, {.beta = {6930.0, 21e9}}}};

static void products_have_the_values_of_their_source(void **state)
{
    (void)state;
    const struct eos *eos = &tnt_products;
    const double rest = 6.993e9 / 1630.0; /* e of the source is E/rho_0 */
    assert_near(eos_evaluate(eos, 1630.0, 0.0, NULL).pressure, 8376.0386e6, 50.0);
    assert_near(eos_evaluate(eos, 163.0, 2e6 - rest, NULL).pressure, 98.03269e6, 5.0);
    assert_near(eos_evaluate(eos, 16.3, 1.5e6 - rest, NULL).pressure, 7.335e6, 50.0);
}

/* POINT after a step to TIME at DENSITY. */
static struct response burn_to(const struct material *material, struct point *point, double density,
                               double time)
{
    const struct motion motion = {.dt = 1e-9, .density = density, .time = time, .length = 1e-4};
    return material_step(material, point, &motion);
}

static void nothing_burns_before_the_detonation_arrives(void **state)
{
    (void)state;
    struct point point = {.density = 1630.0};
    point.history[HISTORY_lighting_time] = 1e-6;
    const struct response response = burn_to(&programmed, &point, 1700.0, 0.999e-6);
    assert_true(point.pressure == 0.0 && point.history[HISTORY_burnt] == 0.0);
    assert_close(response.sound_long, 6930.0, 1e-14);
    assert_true(response.status == 0);
}

static void the_burn_takes_the_time_that_the_front_needs_for_one_and_a_half_lengths(void **state)
{
    (void)state;
    const double last = 1.5e-4 / 6930.0;
    struct point point = {.density = 1630.0};
    point.history[HISTORY_lighting_time] = 1e-6;
    burn_to(&programmed, &point, 1630.0, 1e-6);
    assert_true(point.history[HISTORY_burnt] == 0.0);
    burn_to(&programmed, &point, 1630.0, 1e-6 + 0.25 * last);
    assert_close(point.history[HISTORY_burnt], 0.25, 1e-9);
    assert_near(point.pressure, 0.25 * 8376.0386e6, 50.0);
    burn_to(&programmed, &point, 1630.0, 1e-6 + 1.01 * last);
    assert_true(point.history[HISTORY_burnt] == 1.0);
    assert_near(point.pressure, 8376.0386e6, 50.0);
    burn_to(&programmed, &point, 1630.0, 0.5e-6);
    assert_true(point.history[HISTORY_burnt] == 1.0);
}

static void what_has_burnt_is_its_products(void **state)
{
    (void)state;
    const struct material products = {.eos = tnt_products};
    struct point burnt = {.density = 1200.0, .energy = 1e5}, plain = burnt;
    burnt.history[HISTORY_burnt] = 1.0;
    const struct response a = material_evaluate(&programmed, &burnt);
    const struct response b = material_evaluate(&products, &plain);
    assert_true(burnt.pressure == plain.pressure && a.sound_long == b.sound_long);
    assert_int_equal(material_history(&products), 0);
}

static void the_instant_burn_is_a_material_without(void **state)
{
    (void)state;
    const struct burn instant = {.kind = BURN_INSTANT};
    const struct burning before = {.passed = -1.0, .length = 1e-3, .volume = 1.0, .rest = 1630.0};
    assert_true(burn_fraction(&instant, &before, 0.0) == 1.0);
}

static void compression_sets_off_a_beta_burn_before_its_time(void **state)
{
    (void)state;
    struct point point = {.density = 1630.0};
    point.history[HISTORY_lighting_time] = 1.0;
    burn_to(&beta, &point, 1500.0, 1e-6);
    assert_true(point.history[HISTORY_burnt] == 0.0);
    burn_to(&beta, &point, 1800.0, 2e-6);
    const double wanted = (1.0 - 1630.0 / 1800.0) * 1630.0 * square(6930.0) / 21e9;
    assert_close(point.history[HISTORY_burnt], wanted, 1e-13);
    burn_to(&beta, &point, 1630.0, 3e-6);
    assert_close(point.history[HISTORY_burnt], wanted, 1e-13);
    burn_to(&beta, &point, 2200.0, 4e-6); /* 0.968 */
    assert_true(point.history[HISTORY_burnt] == 1.0);
}

static void the_power_of_stress_gives_the_same_state_as_its_energy_given(void **state)
{
    (void)state;
    struct point point = {.density = 1630.0};
    for (int k = 1; k <= 40; k++) {
        const struct point before = point;
        const struct motion motion = {
            .dt = 1e-9, .density = 1630.0 + 5.0 * k, .time = 1e-9 * k, .length = 1e-4};
        material_step_by_work(&programmed, &point, &motion);
        const double change = 1.0 / point.density - 1.0 / before.density;
        assert_near(point.energy - before.energy,
                    -0.5 * (before.pressure + point.pressure) * change,
                    1e-13 * fabs(point.energy) + 1e-9);
    }
    assert_true(point.history[HISTORY_burnt] == 1.0 && point.energy > 0.0);
}

static void the_nearest_place_lights_first(void **state)
{
    (void)state;
    struct material burning = programmed, inert = {.burn = {0}};
    struct material_input materials[2] = {{.material = &burning}, {.material = &inert}};
    struct body_input bodies[3] = {
        {.material_index = 0}, {.material_index = 0}, {.material_index = 1}};
    struct detonation_input detonations[2] = {
        {.at = VECTOR(0.0, 0.0), .to = VECTOR(0.0, 0.1), .time = 1e-6, .body = -1},
        {.at = VECTOR(0.3, 0.0), .time = 0.0, .body = 1}};
    const struct simulation_case input = {.materials = {2, NULL, materials},
                                          .bodies = {3, NULL, bodies},
                                          .detonations = {2, NULL, detonations}};
    const struct vec3 beside = {0.06, 0.05, 0.0}, beyond = {0.03, 0.14, 0.0},
                      near = {0.24, 0.0, 0.0};
    assert_close(detonation_arrival(&input, 0, beside), 1e-6 + 0.06 / 6930.0, 1e-14);
    assert_close(detonation_arrival(&input, 0, beyond), 1e-6 + 0.05 / 6930.0, 1e-14);
    assert_close(detonation_arrival(&input, 0, near), 1e-6 + 0.24 / 6930.0, 1e-14);
    assert_close(detonation_arrival(&input, 1, near), 0.06 / 6930.0, 1e-12);
    assert_true(detonation_arrival(&input, 2, near) == 0.0);
    assert_false(detonation_lights(&input, 0, 2));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products_have_the_values_of_their_source),
        cmocka_unit_test(nothing_burns_before_the_detonation_arrives),
        cmocka_unit_test(the_burn_takes_the_time_that_the_front_needs_for_one_and_a_half_lengths),
        cmocka_unit_test(what_has_burnt_is_its_products),
        cmocka_unit_test(the_instant_burn_is_a_material_without),
        cmocka_unit_test(compression_sets_off_a_beta_burn_before_its_time),
        cmocka_unit_test(the_power_of_stress_gives_the_same_state_as_its_energy_given),
        cmocka_unit_test(the_nearest_place_lights_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
