/* Johnson and Cook's strength: values of its formula worked out apart, and what its return must
 * satisfy. Values: Cui, dissertation (2014), (2-64) with tables 3.2, 4.5 and 5.5. */
#include "dice.h"

#include "material/material.h"

static const struct strength_johnson_cook steel_1006 = {.shear_modulus = 212.68e9 / 2.6,
                                                        .a = 350e6,
                                                        .b = 275e6,
                                                        .n = 0.36,
                                                        .c = 0.022,
                                                        .rate = 1.0,
                                                        .m = NAN};
static const struct strength_johnson_cook rha = {
    .shear_modulus = 82e9, .a = 950e6, .b = 560e6, .n = 0.26, .c = 0.014, .rate = 1.0, .m = NAN};
static const struct strength_johnson_cook aluminium = {
    .shear_modulus = 28e9, .a = 265e6, .b = 426e6, .n = 0.34, .c = 0.015, .rate = 1.0, .m = NAN};

static struct strength_johnson_cook softening(void)
{
    struct strength_johnson_cook steel = steel_1006;
    steel.m = 1.0;
    steel.room = 300.0;
    steel.melt = 1811.0;
    steel.capacity = 452.0;
    return steel;
}

static void yield_has_the_published_values(void **state)
{
    (void)state;
    assert_near(johnson_cook_stress(&steel_1006, 0.1, 1e3, 0.0), 541.4744e6, 50.0);
    assert_near(johnson_cook_stress(&steel_1006, 0.0, 1e4, 0.0), 420.9196e6, 50.0);
    assert_near(johnson_cook_stress(&rha, 0.05, 1e3, 0.0), 1323.7189e6, 50.0);
    assert_near(johnson_cook_stress(&aluminium, 0.1, 1e3, 0.0), 507.3540e6, 50.0);
}

static void slow_flow_is_not_weaker_than_flow_at_the_reference_rate(void **state)
{
    (void)state;
    const double at_rate = johnson_cook_stress(&steel_1006, 0.1, 1.0, 0.0);
    assert_true(johnson_cook_stress(&steel_1006, 0.1, 1e-6, 0.0) == at_rate);
    assert_true(johnson_cook_stress(&steel_1006, 0.1, 0.0, 0.0) == at_rate);
}

static void heat_softens_down_to_nothing_at_the_melting_point(void **state)
{
    (void)state;
    const struct strength_johnson_cook steel = softening();
    const double cold = johnson_cook_stress(&steel, 0.2, 1e4, 0.0);
    assert_close(johnson_cook_stress(&steel, 0.2, 1e4, 0.25 * 1511.0), 0.75 * cold, 1e-14);
    assert_true(johnson_cook_stress(&steel, 0.2, 1e4, 1511.0) == 0.0);
    assert_true(johnson_cook_stress(&steel, 0.2, 1e4, 5000.0) == 0.0);
    assert_true(johnson_cook_stress(&steel_1006, 0.2, 1e4, 5000.0) == cold);
}

/* A point whose trial stress is TRIAL, a step of DT in which nothing moves. */
static struct point returned(const struct strength_johnson_cook *solid, struct sym3 trial,
                             double strain, double heating, double dt)
{
    struct point point = {.density = 7890.0, .deviator = trial};
    const struct motion motion = {.dt = dt, .density = 7890.0};
    point.history[HISTORY_plastic_strain] = strain;
    point.history[HISTORY_plastic_heating] = heating;
    strength_johnson_cook(solid, &motion, 0.0, &point);
    return point;
}

static void the_return_ends_on_the_yield_stress_of_its_own_strain_and_rate(void **state)
{
    (void)state;
    struct dice dice = {11};
    const struct strength_johnson_cook kinds[] = {steel_1006, rha, aluminium, softening()};
    for (int k = 0; k < 4000; k++) {
        const struct strength_johnson_cook *solid = &kinds[k % 4];
        const double dt = pow(10.0, -10.0 + 8.0 * dice_between(&dice, 0.0, 1.0));
        const double strain = k % 3 ? dice_between(&dice, 0.0, 1.0) : 0.0,
                     heating = 400.0 * dice_between(&dice, 0.0, 1.0);
        struct sym3 trial = {0};
        trial.xx = 2.0 / 3.0 * solid->a * pow(10.0, 1.5 * dice_between(&dice, 0.0, 1.0) - 0.3);
        trial.yy = trial.zz = -0.5 * trial.xx;
        const struct point point = returned(solid, trial, strain, heating, dt);
        const double before = sym3_mises(trial), after = sym3_mises(point.deviator);
        const double flow = point.history[HISTORY_plastic_strain] - strain;
        if (before <= johnson_cook_stress(solid, strain, 0.0, heating)) {
            assert_true(flow == 0.0 && after == before);
            continue;
        }
        assert_true(flow > 0.0);
        assert_near(before - 3.0 * solid->shear_modulus * flow, after, 1e-9 * before);
        assert_near(johnson_cook_stress(solid, strain + flow, flow / dt, heating), after,
                    1e-8 * before);
        assert_close(point.deviator.yy, -0.5 * point.deviator.xx, 1e-14);
    }
}

static void what_has_melted_bears_no_shear(void **state)
{
    (void)state;
    const struct strength_johnson_cook steel = softening();
    const struct sym3 trial = {1e6, -1e6, 0.0, 3e5, 0.0, 0.0};
    const struct point point = returned(&steel, trial, 0.3, 1600.0, 1e-8);
    assert_near(sym3_mises(point.deviator), 0.0, 1.0);
}

/* Stretches a bar of constant volume by RATE to STRAIN in equal steps. */
static struct point pulled(const struct strength_johnson_cook *solid, double rate, double strain,
                           int steps)
{
    struct point point = {.density = 7890.0};
    const struct motion motion = {.dt = strain / rate / steps,
                                  .density = 7890.0,
                                  .strain_rate = {rate, -0.5 * rate, -0.5 * rate, 0.0, 0.0, 0.0}};
    for (int k = 0; k < steps; k++)
        strength_johnson_cook(solid, &motion, 0.0, &point);
    return point;
}

static void steady_pulling_follows_the_curve(void **state)
{
    (void)state;
    const struct point point = pulled(&steel_1006, 1e3, 0.2, 20);
    const double plastic = point.history[HISTORY_plastic_strain];
    const double stress = johnson_cook_stress(&steel_1006, plastic, 1e3, 0.0);
    assert_near(sym3_mises(point.deviator), stress, 2e-4 * stress);
    assert_near(plastic + sym3_mises(point.deviator) / (3.0 * steel_1006.shear_modulus), 0.2,
                1e-14);
}

static void the_explicit_return_tends_to_the_implicit_one(void **state)
{
    (void)state;
    struct strength_johnson_cook explicitly = steel_1006;
    explicitly.return_map = JOHNSON_COOK_EXPLICIT;
    const double wanted = sym3_mises(pulled(&steel_1006, 1e4, 0.1, 1000).deviator);
    assert_near(sym3_mises(pulled(&explicitly, 1e4, 0.1, 1000).deviator), wanted, 1e-3 * wanted);
}

static void plastic_work_becomes_heat(void **state)
{
    (void)state;
    const struct strength_johnson_cook steel = softening();
    double work = 0.0, heating = 0.0;
    struct point point = {.density = 7890.0};
    const struct motion motion = {
        .dt = 1e-7, .density = 7890.0, .strain_rate = {1e4, -5e3, -5e3, 0.0, 0.0, 0.0}};
    for (int k = 0; k < 500; k++) {
        const double before = point.history[HISTORY_plastic_strain];
        strength_johnson_cook(&steel, &motion, 0.0, &point);
        work += sym3_mises(point.deviator) * (point.history[HISTORY_plastic_strain] - before);
        heating = point.history[HISTORY_plastic_heating];
    }
    assert_close(heating, work / (7890.0 * 452.0), 1e-12);
    assert_true(heating > 50.0);
}

static void only_softening_steel_remembers_its_heat(void **state)
{
    (void)state;
    struct material plain = {.strength = {STRENGTH_johnson_cook, {.johnson_cook = steel_1006}}};
    struct material soft = {.strength = {STRENGTH_johnson_cook, {.johnson_cook = softening()}}};
    assert_int_equal(material_history(&plain), 0);
    assert_int_equal(material_history(&soft), HISTORY_BIT(plastic_heating));
}

/* What is hot at the start is soft at the start, and what is at rest is as before to the last
 * bit. */
static void a_hot_start_softens_as_plastic_work_does(void **state)
{
    (void)state;
    struct material steel = {
        .strength = {.kind = STRENGTH_johnson_cook, .of.johnson_cook = softening()},
        .eos = {.kind = EOS_mie_grueneisen, .of.mie_grueneisen = EOS_mie_grueneisen_SAMPLE},
        .heat = {452.0, NAN, 300.0}};
    struct point point = {.density = material_density(&steel)};
    assert_true(material_start_heating(&steel, &point) == 0.0);
    point.energy = 452.0 * 500.0;
    assert_close(material_start_heating(&steel, &point), 500.0, 1e-12);
    point.history[HISTORY_plastic_heating] = material_start_heating(&steel, &point);
    assert_close(strength_yield(&steel.strength, &point), 350e6 * (1.0 - 500.0 / 1511.0), 1e-12);
    steel.heat.capacity = NAN; /* it has no temperature */
    assert_true(material_start_heating(&steel, &point) == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(yield_has_the_published_values),
        cmocka_unit_test(slow_flow_is_not_weaker_than_flow_at_the_reference_rate),
        cmocka_unit_test(a_hot_start_softens_as_plastic_work_does),
        cmocka_unit_test(heat_softens_down_to_nothing_at_the_melting_point),
        cmocka_unit_test(the_return_ends_on_the_yield_stress_of_its_own_strain_and_rate),
        cmocka_unit_test(what_has_melted_bears_no_shear),
        cmocka_unit_test(steady_pulling_follows_the_curve),
        cmocka_unit_test(the_explicit_return_tends_to_the_implicit_one),
        cmocka_unit_test(plastic_work_becomes_heat),
        cmocka_unit_test(only_softening_steel_remembers_its_heat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
