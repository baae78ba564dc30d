/* Explosive and products whose pressures add, and what burns it: the parts are those of their own
 * equations of state, the slopes those of differences; the detonation of PETN and of ANFO; when a
 * threshold and a power of the pressure burn. */
#include "dice.h"

#include "exact/detonation.h"
#include "material/material.h"
#include "material/whole.h"

static const struct material petn = {
    .eos = {EOS_blended_jwl, {.blended_jwl = EOS_blended_jwl_SAMPLE}},
    .burn = {BURN_cj_threshold, {.cj_threshold = {NAN, 0.7253, 0.9}}}};

/* The set of blastFoam and Uintah for JWL++. */
static struct material anfo(void)
{
    const struct eos_blended_jwl eos = {1160.0,    sqrt(1.0 / (39e-11 * 1160.0)),
                                        2.1,       0.0,
                                        2.564e9,   EXPLOSIVE_MURNAGHAN,
                                        2.9867e11, 4.11706e9,
                                        4.95,      1.15,
                                        0.35,      4e9};
    return (struct material){
        .eos = eos_make_blended_jwl(&eos),
        .burn = {BURN_pressure_power,
                 {.pressure_power = {NAN, 3.5083e-7 * pow(1e11, 1.3), 1.3, 1.0, 2e8}}}};
}

static double pressure_of(const struct eos *eos, double density, double energy, double burnt)
{
    double history[POINT_HISTORY] = {0.0};
    history[HISTORY_burnt] = burnt;
    return eos_evaluate(eos, density, energy, history).pressure;
}

static void its_ends_are_the_explosive_and_the_products(void **state)
{
    (void)state;
    const struct eos solid = {EOS_mie_grueneisen,
                              {.mie_grueneisen = {1770.0, 2830.0, 1.91, 2.64, 6e9, EOS_EXTENDED}}};
    const struct eos products = {
        EOS_jwl, {.jwl = {1770.0, 617e9, 16.926e9, 4.4, 1.2, 0.25, 10.1e9, EOS_EXTENDED}}};
    for (double ratio = 0.6; ratio < 1.5; ratio += 0.1) {
        const double density = 1770.0 * ratio, energy = 1e6 * ratio;
        const double s = pressure_of(&solid, density, energy, 0.0),
                     g = pressure_of(&products, density, energy, 0.0);
        assert_true(pressure_of(&petn.eos, density, energy, 0.0) == s);
        assert_true(pressure_of(&petn.eos, density, energy, 1.0) == g);
        assert_near(pressure_of(&petn.eos, density, energy, 0.3),
                    0.7 * (s > 0.0 ? s : 0.0) + 0.3 * g, 1e-14 * (fabs(s) + fabs(g)));
    }
    /* Murnaghan: p = [(rho/rho_0)^7.4 - 1]/(7.4 kappa) */
    const struct material of_anfo = anfo();
    assert_close(pressure_of(&of_anfo.eos, 1500.0, 3e6, 0.0),
                 (pow(1500.0 / 1160.0, 7.4) - 1.0) / (7.4 * 39e-11), 1e-10);
    /* products between grains carry no tension, however much both have expanded */
    assert_true(pressure_of(&of_anfo.eos, 10.0, -2e6, 0.0) < -3e8);
    assert_true(pressure_of(&of_anfo.eos, 10.0, -2e6, 0.9) > 0.0);
}

static void slopes_are_those_of_differences(void **state)
{
    (void)state;
    struct dice dice = {5};
    const struct material both[2] = {petn, anfo()};
    for (int k = 0; k < 2000; k++) {
        const struct eos *eos = &both[k % 2].eos;
        double history[POINT_HISTORY] = {0.0};
        history[HISTORY_burnt] = dice_between(&dice, 0.0, 1.0);
        const double density = eos_reference_density(eos) * dice_between(&dice, 1.01, 1.5);
        const double energy = dice_between(&dice, 0.0, 5e6), d = 1e-6 * density, h = 1e-6 * 5e6;
        const struct eos_value value = eos_evaluate(eos, density, energy, history);
        const double by_density = (eos_evaluate(eos, density + d, energy, history).pressure -
                                   eos_evaluate(eos, density - d, energy, history).pressure) /
                                  (2.0 * d);
        const double by_energy = (eos_evaluate(eos, density, energy + h, history).pressure -
                                  eos_evaluate(eos, density, energy - h, history).pressure) /
                                 (2.0 * h);
        assert_near(value.dp_drho, by_density, 1e-5 * (fabs(by_density) + 1e6));
        assert_near(value.dp_de, by_energy, 1e-6 * (fabs(by_energy) + 1e3));
    }
}

/* Table 5.3 of Parshikov (2013): 8300 m/s and 33.5 GPa. For ANFO Guilkey's constant of the
 * isentrope belongs to 5899 m/s. */
static void they_detonate_as_their_sources_say(void **state)
{
    (void)state;
    struct detonation d;
    const struct material of_anfo = anfo();
    assert_true(detonation_solve(&petn, 1770.0, &d));
    assert_close(d.speed, 8301.0, 1e-4);
    assert_close(d.cj.pressure, 33.51e9, 1e-3);
    assert_close(1770.0 / d.cj.density, 0.7253, 1e-3);
    assert_true(detonation_solve(&of_anfo, 1160.0, &d));
    assert_close(d.speed, 5899.0, 1e-3);
    assert_true(d.spike.pressure > 1.4 * d.cj.pressure);
}

static void a_threshold_burns_all_at_once_and_for_good(void **state)
{
    (void)state;
    struct motion motion = {.dt = 1e-9, .length = 1e-5, .energy = 1e6};
    struct point point = {.density = 1770.0};
    motion.density = 1770.0 / (1.0 - 0.89 * (1.0 - 0.7253));
    material_step(&petn, &point, &motion);
    assert_true(point.history[HISTORY_burnt] == 0.0);
    motion.density = 1770.0 / (1.0 - 0.91 * (1.0 - 0.7253));
    material_step(&petn, &point, &motion);
    assert_true(point.history[HISTORY_burnt] == 1.0);
    assert_true(point.pressure > pressure_of(&petn.eos, motion.density, 1e6, 0.0));
    motion.density = 1000.0;
    material_step(&petn, &point, &motion);
    assert_true(point.history[HISTORY_burnt] == 1.0);
}

static void a_power_of_the_pressure_burns_above_its_threshold(void **state)
{
    (void)state;
    const struct burn_pressure_power burn = anfo().burn.of.pressure_power;
    assert_true(pressure_power_rate(&burn, 0.0, 1.9e8) == 0.0);
    assert_close(pressure_power_rate(&burn, 0.4, 10e9), 3.5083e-7 * pow(10e9, 1.3) * 0.6, 1e-9);
    assert_true(pressure_power_rate(&burn, 1.0, 10e9) == 0.0);
    const struct material of_anfo = anfo();
    const struct motion motion = {.dt = 1e-9, .length = 1e-5, .density = 1800.0, .energy = 2e6};
    struct point point = {.density = 1800.0, .energy = 2e6};
    double burnt = 0.0;
    for (int k = 0; k < 5000; k++) {
        material_step(&of_anfo, &point, &motion);
        assert_true(point.history[HISTORY_burnt] >= burnt);
        burnt = point.history[HISTORY_burnt];
    }
    assert_true(burnt > 0.999 && burnt <= 1.0);
}

static void models_that_do_not_go_together_are_named(void **state)
{
    (void)state;
    assert_null(material_burn_wrong(&petn));
    const struct material of_anfo = anfo();
    assert_null(material_burn_wrong(&of_anfo));
    struct material wrong = petn;
    wrong.burn.kind = BURN_ignition_growth;
    assert_non_null(strstr(material_burn_wrong(&wrong), "reactive-jwl"));
    wrong.burn.kind = BURN_INSTANT;
    assert_non_null(strstr(material_burn_wrong(&wrong), "pressure-power"));
    wrong = of_anfo;
    wrong.eos.kind = EOS_jwl;
    assert_non_null(strstr(material_burn_wrong(&wrong), "blended-jwl"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_ends_are_the_explosive_and_the_products),
        cmocka_unit_test(slopes_are_those_of_differences),
        cmocka_unit_test(they_detonate_as_their_sources_say),
        cmocka_unit_test(a_threshold_burns_all_at_once_and_for_good),
        cmocka_unit_test(a_power_of_the_pressure_burns_above_its_threshold),
        cmocka_unit_test(models_that_do_not_go_together_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
