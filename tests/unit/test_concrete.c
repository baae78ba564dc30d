/* Concrete after Holmquist, Johnson and Cook: values of its source, unloading, crushing and
 * tearing. Values: Cui, dissertation (2014), tables 4.1 to 4.3 and (2-61) to (2-63), worked out
 * apart. */
#include "dice.h"

#include "material/material.h"

static const struct eos_hjc pressure_of = {.density = 2400.0,
                                           .crush_pressure = 13.7e6,
                                           .crush_compression = 0.0008,
                                           .lock_pressure = 0.8e9,
                                           .lock_compression = 0.1,
                                           .k1 = 85e9,
                                           .k2 = -171e9,
                                           .k3 = 208e9};
static const struct strength_hjc strength_of = {.shear_modulus = 26e9 / 2.3,
                                                .a = 0.79,
                                                .b = 1.6,
                                                .n = 0.61,
                                                .c = 0.007,
                                                .strength = 25e6,
                                                .rate = 1.0,
                                                .most = 7.0,
                                                .tension = 4e6,
                                                .d1 = 0.04,
                                                .d2 = 1.0,
                                                .damage_limit = 1.0,
                                                .least_strain = 0.01,
                                                .tensile_growth = 7e5,
                                                .tensile_threshold = 2.5e6,
                                                .tensile_exponent = 1.0,
                                                .tensile_start = 1e-3,
                                                .tensile_limit = 0.9};

static struct material concrete(void)
{
    struct material material = {.eos = {EOS_hjc, {.hjc = pressure_of}}};
    material.strength.kind = STRENGTH_hjc;
    material.strength.of.hjc = strength_of;
    material.strength.of.hjc.d1 = 0.004; /* as in table 4.2, doubtful: the usual one is 0.04 */
    return material;
}

static double pressure(double mu, const double *history)
{
    return eos_hjc(&pressure_of, 2400.0 * (1.0 + mu), 0.0, history).pressure;
}

static void loading_passes_through_the_values_of_its_source(void **state)
{
    (void)state;
    const double none[POINT_HISTORY] = {0.0};
    const double rows[][2] = {{0.0004, 6.85},   {0.02, 151.25234},  {0.05, 366.17789},
                              {0.1, 724.38713}, {0.12, 1490.17581}, {0.15, 3529.86476},
                              {0.2, 6470.32307}};
    assert_near(hjc_full_compression(&pressure_of), 0.11055429, 5e-9);
    for (size_t k = 0; k < COUNT_OF(rows); k++)
        assert_near(pressure(rows[k][0], none), 1e6 * rows[k][1], 10.0);
    assert_near(eos_hjc(&pressure_of, 2400.0, 0.0, none).dp_drho * 2400.0, 17125e6, 1.0);
}

static void slopes_are_those_of_the_pressure(void **state)
{
    (void)state;
    const double mu[] = {-0.001, 0.0005, 0.03, 0.08, 0.13, 0.2, 0.05, 0.09, 0.12};
    for (int k = 0; k < 9; k++) {
        double history[POINT_HISTORY] = {0.0};
        history[HISTORY_largest_compression] = k < 6 ? 0.0 : mu[k] + 0.01;
        const struct eos_value value = eos_hjc(&pressure_of, 2400.0 * (1.0 + mu[k]), 0.0, history);
        const double difference = pressure(mu[k] + 1e-6, history) - pressure(mu[k] - 1e-6, history);
        assert_close(value.dp_drho * 2400.0, difference / 2e-6, 1e-6);
    }
}

static void unloading_keeps_what_has_been_crushed(void **state)
{
    (void)state;
    double history[POINT_HISTORY] = {0.0};
    const double full = hjc_full_compression(&pressure_of);
    history[HISTORY_largest_compression] = 0.05;
    const double share = (0.05 - 0.0008) / (full - 0.0008);
    const double slope = (1.0 - share) * 17125e6 + share * 85e9;
    assert_near(pressure(0.05, history), 366.17789e6, 10.0);
    assert_near(pressure(0.048, history), 366.17789e6 - slope * 0.002, 20.0);
    assert_true(pressure(0.03, history) < 0.0);
    history[HISTORY_largest_compression] = 0.15;
    assert_near(pressure(0.14, history), 3529.86476e6 - 0.85e9, 10.0);
    history[HISTORY_largest_compression] = 0.0005; /* elastic: nothing is kept */
    assert_near(pressure(0.0002, history), 3.425e6, 1.0);
}

/* Of any compression: pressure that stays when the density is gone drives particles without end. */
static void no_pressure_is_left_where_the_density_vanishes(void **state)
{
    (void)state;
    for (double most = 1e-4; most < 1e3; most *= 1.5) {
        double history[POINT_HISTORY] = {0.0};
        history[HISTORY_largest_compression] = most;
        const double released = minimum(most - 1e-9, pressure_of.lock_compression);
        assert_true(pressure(-1.0 + 1e-9, history) < 0.0);
        if (most > hjc_full_compression(&pressure_of))
            assert_true(pressure(released, history) <= 1e-6 * pressure(most, history));
    }
}

static void what_is_compacted_does_not_depend_on_the_steps(void **state)
{
    (void)state;
    double whole[POINT_HISTORY] = {0.0}, parts[POINT_HISTORY] = {0.0}, sum = 0.0;
    const double once = eos_hjc_compact(&pressure_of, 2400.0 * 1.0005, whole);
    assert_true(once == 0.0);
    for (int k = 1; k <= 1000; k++)
        sum += eos_hjc_compact(&pressure_of, 2400.0 * (1.0 + 0.15 * k / 1000.0), parts);
    double fine = 0.0, finer[POINT_HISTORY] = {0.0};
    for (int k = 1; k <= 8000; k++)
        fine += eos_hjc_compact(&pressure_of, 2400.0 * (1.0 + 0.15 * k / 8000.0), finer);
    assert_close(sum, fine, 1e-3);
    assert_true(sum > 0.08 && sum < 0.11);
    assert_true(eos_hjc_compact(&pressure_of, 2400.0 * 1.1, parts) == 0.0);
    assert_close(parts[HISTORY_largest_compression], 0.15, 1e-13);
}

static void yield_has_the_values_of_its_source(void **state)
{
    (void)state;
    assert_near(hjc_stress(&strength_of, 25e6, 0.0, 1.0), 59.75e6, 1.0);
    assert_near(hjc_stress(&strength_of, 25e6, 0.0, 1e3), 62.63917e6, 10.0);
    assert_near(hjc_stress(&strength_of, 25e6, 1.0, 1.0), 40e6, 1.0);
    assert_near(hjc_stress(&strength_of, 500e6, 0.0, 1.0), 175e6, 1.0);
    assert_near(hjc_stress(&strength_of, -3e6, 0.0, 1.0), 0.79 * 25e6, 1.0);
}

static void strain_to_failure_has_the_values_of_its_source(void **state)
{
    (void)state;
    struct strength_hjc brittle = strength_of;
    brittle.d1 = 0.004;
    const double at[] = {0.0, 25e6, 100e6};
    const double usual[] = {0.01, 0.0464, 0.1664}, least[] = {0.01, 0.01, 0.01664};
    for (int k = 0; k < 3; k++) {
        assert_near(hjc_failure_strain(&strength_of, at[k]), usual[k], 1e-12);
        assert_near(hjc_failure_strain(&brittle, at[k]), least[k], 1e-12);
    }
    assert_true(hjc_failure_strain(&strength_of, -10e6) == 0.01);
}

static void tension_breaks_in_the_time_that_its_growth_needs(void **state)
{
    (void)state;
    struct strength_hjc whole = strength_of;
    whole.tensile_limit = 1.0;
    assert_near(hjc_tensile_damage(&whole, 0.0, 5e6, 9.867e-6), 0.5, 1e-4);
    assert_near(hjc_tensile_damage(&whole, 0.0, 5e6, 13.006e-6), 0.9, 1e-4);
    assert_true(hjc_tensile_damage(&whole, 0.3, 2.5e6, 1.0) == 0.3);
    assert_true(hjc_tensile_damage(&whole, 0.3, 1e9, 1.0) == 1.0);
    double steps = 0.0;
    for (int k = 0; k < 100; k++)
        steps = hjc_tensile_damage(&whole, steps, 5e6, 0.1e-6);
    assert_close(steps, hjc_tensile_damage(&whole, 0.0, 5e6, 10e-6), 1e-12);
    assert_true(hjc_tensile_damage(&strength_of, 0.899, 5e6, 1e-6) == 1.0);
}

static void the_largest_principal_stress_is_that_of_a_turned_one(void **state)
{
    (void)state;
    struct dice dice = {3};
    for (int k = 0; k < 1000; k++) {
        const double a = dice_between(&dice, -1e6, 1e6), b = dice_between(&dice, -1e6, 1e6);
        struct sym3 s = {a, b, -a - b, 0.0, 0.0, 0.0};
        for (int turn = 0; turn < 5; turn++)
            s = sym3_rotate(s, vec3_make(dice_between(&dice, -0.2, 0.2),
                                         dice_between(&dice, -0.2, 0.2),
                                         dice_between(&dice, -0.2, 0.2)));
        assert_near(sym3_largest(s), maximum(a, maximum(b, -a - b)), 1.0);
    }
    assert_true(sym3_largest((struct sym3){0}) == 0.0);
}

/* Strains MATERIAL uniformly along x to the compression MU in steps of DT. */
static void press(const struct material *material, struct point *point, double mu, int steps,
                  double dt)
{
    const double from = point->density, to = 2400.0 * (1.0 + mu);
    for (int k = 1; k <= steps; k++) {
        const double density = from + (to - from) * k / steps;
        const struct motion motion = {.dt = dt,
                                      .density = density,
                                      .strain_rate = {.xx = -log(density / point->density) / dt}};
        material_step(material, point, &motion);
    }
}

static void pressed_hard_it_crushes_and_keeps_no_tension(void **state)
{
    (void)state;
    const struct material material = concrete();
    struct point point = {.density = 2400.0};
    press(&material, &point, 0.15, 1000, 1e-8);
    assert_true(point.history[HISTORY_damage] == 1.0);
    assert_true(sym3_mises(point.deviator) == 0.0 && point.pressure > 3.5e9);
    press(&material, &point, -0.01, 1000, 1e-8);
    assert_true(point.pressure == 0.0);
    struct point again = point;
    const struct response response = material_evaluate(&material, &again);
    assert_true(again.pressure == 0.0 && response.status == 0 && response.yield == 0.0);
}

static void rubble_keeps_its_friction(void **state)
{
    (void)state;
    struct material material = concrete();
    material.strength.of.hjc.rubble = true;
    struct point point = {.density = 2400.0};
    press(&material, &point, 0.15, 1000, 1e-8);
    assert_true(point.history[HISTORY_damage] == 1.0);
    assert_close(sym3_mises(point.deviator), 175e6, 1e-12);
}

static void pulled_gently_it_bears_its_tension_and_breaks_in_time(void **state)
{
    (void)state;
    const struct material material = concrete();
    struct point point = {.density = 2400.0};
    press(&material, &point, -2e-4, 20, 1e-8);
    assert_close(point.pressure, -17125e6 * 2e-4, 1e-3);
    assert_true(point.history[HISTORY_damage] == 0.0);
    for (int k = 0; k < 3000 && point.history[HISTORY_tensile_damage] < 1.0; k++)
        press(&material, &point, -2e-4, 1, 1e-8);
    assert_true(point.history[HISTORY_tensile_damage] == 1.0 && point.pressure == 0.0);
    assert_true(sym3_mises(point.deviator) == 0.0);
}

static void parameters_that_do_not_meet_are_refused(void **state)
{
    (void)state;
    const char *key;
    struct eos eos = {EOS_hjc, {.hjc = pressure_of}};
    assert_null(eos_wrong(&eos, &key));
    eos.of.hjc.lock_pressure = 10e6;
    assert_non_null(eos_wrong(&eos, &key));
    eos.of.hjc = pressure_of;
    eos.of.hjc.k3 = 0.0;
    eos.of.hjc.lock_pressure = 50e9; /* the curve turns down before */
    assert_non_null(eos_wrong(&eos, &key));
    assert_string_equal(key, "lock_pressure");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loading_passes_through_the_values_of_its_source),
        cmocka_unit_test(slopes_are_those_of_the_pressure),
        cmocka_unit_test(unloading_keeps_what_has_been_crushed),
        cmocka_unit_test(no_pressure_is_left_where_the_density_vanishes),
        cmocka_unit_test(what_is_compacted_does_not_depend_on_the_steps),
        cmocka_unit_test(yield_has_the_values_of_its_source),
        cmocka_unit_test(strain_to_failure_has_the_values_of_its_source),
        cmocka_unit_test(tension_breaks_in_the_time_that_its_growth_needs),
        cmocka_unit_test(the_largest_principal_stress_is_that_of_a_turned_one),
        cmocka_unit_test(pressed_hard_it_crushes_and_keeps_no_tension),
        cmocka_unit_test(rubble_keeps_its_friction),
        cmocka_unit_test(pulled_gently_it_bears_its_tension_and_breaks_in_time),
        cmocka_unit_test(parameters_that_do_not_meet_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
