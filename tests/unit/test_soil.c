/* Drucker and Prager's soil: values of its source, and what its pressure remembers.
 * Values: Cui, dissertation (2014), table 4.4 and (2-67) to (2-71), worked out apart. */
#include "dice.h"

#include "material/material.h"

static const struct strength_drucker_prager soil = {
    .shear_modulus = 100e6 / 2.6, .friction = 0.35452, .cohesion = 97400.0, .tension = 2748.0};
static const double bulk = 100e6 / 1.2;

static struct material material_of(struct strength_drucker_prager strength)
{
    struct material material = {.eos = {EOS_barotropic, {.barotropic = {1200.0, bulk}}}};
    material.strength.kind = STRENGTH_drucker_prager;
    material.strength.of.drucker_prager = strength;
    return material;
}

/* What becomes of a trial of mean stress MEAN (tension positive) and pure shear TAU. */
static struct point returned(const struct strength_drucker_prager *strength, double mean,
                             double tau)
{
    const struct motion still = {.dt = 1e-6, .density = 1200.0};
    struct point point = {.density = 1200.0, .pressure = -mean, .deviator = {.xy = tau}};
    strength_drucker_prager(strength, &still, bulk, &point);
    return point;
}

static void moduli_are_those_of_its_source(void **state)
{
    (void)state;
    assert_near(soil.shear_modulus, 38.46154e6, 5.0);
    assert_near(bulk, 83.33333e6, 5.0);
    assert_near(soil.cohesion - soil.friction * soil.tension, 0.0964258e6, 0.05);
    assert_near(sqrt(1.0 + square(soil.friction)) - soil.friction, 0.7064628, 5e-8);
    assert_near(soil.cohesion / soil.friction, 0.2747377e6, 0.05);
}

static void shear_returns_to_the_cone(void **state)
{
    (void)state;
    const struct point point = returned(&soil, -0.2e6, 0.3e6);
    assert_near(point.deviator.xy, 0.168304e6, 0.5);
    assert_near(point.history[HISTORY_plastic_strain], 0.00197690, 5e-9);
    assert_near(point.history[HISTORY_plastic_strain] * sqrt(3.0), 0.003424096, 5e-9);
    assert_true(point.pressure == 0.2e6);
}

static void what_lies_inside_the_cone_stays(void **state)
{
    (void)state;
    const struct point point = returned(&soil, -0.2e6, 0.16e6);
    assert_true(point.deviator.xy == 0.16e6 && point.pressure == 0.2e6);
    assert_true(point.history[HISTORY_plastic_strain] == 0.0);
}

static void dilatancy_presses_what_cannot_expand(void **state)
{
    (void)state;
    struct strength_drucker_prager loose = soil;
    loose.dilatancy = 0.2;
    const struct point point = returned(&loose, -0.2e6, 0.3e6);
    const double flow =
        (0.3e6 - 0.35452 * 0.2e6 - 97400.0) / (soil.shear_modulus + bulk * 0.35452 * 0.2);
    assert_close(point.pressure, 0.2e6 + bulk * 0.2 * flow, 1e-13);
    assert_close(point.deviator.xy, 97400.0 + 0.35452 * point.pressure, 1e-13);
}

static void tension_is_cut(void **state)
{
    (void)state;
    const struct point point = returned(&soil, 0.05e6, 0.05e6);
    assert_true(point.pressure == -2748.0 && point.deviator.xy == 0.05e6);
    assert_close(point.history[HISTORY_plastic_strain], sqrt(2.0) / 3.0 * (0.05e6 - 2748.0) / bulk,
                 1e-13);
}

static void no_return_leaves_more_than_the_strength(void **state)
{
    (void)state;
    struct dice dice = {5};
    for (int k = 0; k < 20000; k++) {
        const double mean = dice_between(&dice, -1e6, 1e6), tau = dice_between(&dice, 0.0, 1e6);
        struct strength_drucker_prager kind = soil;
        kind.dilatancy = k % 2 ? 0.3 : 0.0;
        kind.tension = k % 3 ? soil.tension : 1e9;
        const struct point point = returned(&kind, mean, tau);
        assert_true(-point.pressure <= drucker_prager_tension(&kind) * (1.0 + 1e-14));
        assert_true(point.deviator.xy >= -1e-9);
        /* a return in tension leaves its shear to the next step, as in the source */
        if (point.deviator.xy != tau)
            assert_true(sqrt(3.0) * point.deviator.xy <=
                        strength_drucker_prager_yield(&kind, &point) + 1e-6);
        assert_true(point.history[HISTORY_plastic_strain] >= 0.0);
    }
}

static struct response squeeze(const struct material *material, struct point *point, double density)
{
    const double change = -log(density / point->density) / 3.0 / 1e-6;
    const struct motion motion = {
        .dt = 1e-6, .density = density, .strain_rate = {change, change, change, 0.0, 0.0, 0.0}};
    return material_step(material, point, &motion);
}

static void torn_soil_bears_pressure_again_as_soon_as_it_is_pressed(void **state)
{
    (void)state;
    const struct material material = material_of(soil);
    struct point point = {.density = 1200.0};
    for (int k = 1; k <= 10; k++)
        squeeze(&material, &point, 1200.0 - k);
    assert_near(point.pressure, -2748.0, 1e-5);
    const double dilation = point.history[HISTORY_dilation];
    assert_near(dilation, 10.0 / 1190.0 - 2748.0 / bulk, 1e-6);
    squeeze(&material, &point, 1190.1);
    assert_close(point.history[HISTORY_dilation], dilation, 1e-14);
    assert_near(point.pressure, -2748.0 + bulk * 0.1 / 1190.0, 20.0);
    struct point again = point;
    material_evaluate(&material, &again); /* the state alone says the same */
    assert_true(again.pressure == point.pressure);
}

static void sound_in_soil_has_its_moduli(void **state)
{
    (void)state;
    const struct material material = material_of(soil);
    struct point point = {.density = 1200.0};
    const struct response response = material_evaluate(&material, &point);
    assert_close(response.sound_long, sqrt((bulk + 4.0 / 3.0 * soil.shear_modulus) / 1200.0),
                 1e-14);
    assert_int_equal(material_history(&material), HISTORY_BIT(dilation));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moduli_are_those_of_its_source),
        cmocka_unit_test(shear_returns_to_the_cone),
        cmocka_unit_test(what_lies_inside_the_cone_stays),
        cmocka_unit_test(dilatancy_presses_what_cannot_expand),
        cmocka_unit_test(tension_is_cut),
        cmocka_unit_test(no_return_leaves_more_than_the_strength),
        cmocka_unit_test(torn_soil_bears_pressure_again_as_soon_as_it_is_pressed),
        cmocka_unit_test(sound_in_soil_has_its_moduli),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
