/* The step whose energy comes from the power of stress: adiabats of gases and solids, elastic and
 * plastic work. */
#include "dice.h"

#include "material/material.h"

static const struct material gas = {.eos = {EOS_ideal_gas, {.ideal_gas = {1.225, 1.4}}}};
static const struct material tnt = {
    .eos = {EOS_jwl, {.jwl = {1630.0, 371.2e9, 3.21e9, 4.15, 0.95, 0.3, 6.993e9}}}};
static const struct material steel = {
    .eos = {EOS_grueneisen_polynomial, {.grueneisen_polynomial = {7890.0, 4569.0, 1.49, 2.17}}},
    .strength = {STRENGTH_johnson_cook,
                 {.johnson_cook = {.shear_modulus = 81.8e9,
                                   .a = 350e6,
                                   .b = 275e6,
                                   .n = 0.36,
                                   .c = 0.022,
                                   .rate = 1.0,
                                   .m = NAN}}}};
static const struct material aluminium = {.eos = {EOS_tillotson,
                                                  {.tillotson = {.density = 2700.0,
                                                                 .a = 0.5,
                                                                 .b = 1.63,
                                                                 .bulk_modulus = 75.2e9,
                                                                 .second_modulus = 65e9,
                                                                 .energy = 5e6,
                                                                 .alpha = 5.0,
                                                                 .beta = 5.0,
                                                                 .incipient_energy = 3e6,
                                                                 .complete_energy = 15e6}}}};

static struct point at(const struct material *material, double density, double energy)
{
    struct point point = {.density = density, .energy = energy};
    material_evaluate(material, &point);
    return point;
}

/* Takes POINT to DENSITY by STEPS equal steps of volume without shear. */
static void squeeze(const struct material *material, struct point *point, double density, int steps)
{
    const double first = 1.0 / point->density, change = (1.0 / density - first) / steps;
    for (int k = 1; k <= steps; k++) {
        const struct motion motion = {.dt = 1e-8, .density = 1.0 / (first + k * change)};
        material_step_by_work(material, point, &motion);
    }
}

/* The energy at DENSITY on the adiabat through POINT: de = -p dv by the classical Runge-Kutta
 * method. */
static double adiabat(const struct material *material, struct point point, double density)
{
    enum { STEPS = 4000 };
    double v = 1.0 / point.density, h = (1.0 / density - v) / STEPS, e = point.energy;
    for (int k = 0; k < STEPS; k++, v += h) {
        const double k1 = -at(material, 1.0 / v, e).pressure;
        const double k2 = -at(material, 1.0 / (v + 0.5 * h), e + 0.5 * h * k1).pressure;
        const double k3 = -at(material, 1.0 / (v + 0.5 * h), e + 0.5 * h * k2).pressure;
        const double k4 = -at(material, 1.0 / (v + h), e + h * k3).pressure;
        e += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    return e;
}

static void a_gas_follows_its_adiabat(void **state)
{
    (void)state;
    struct point point = at(&gas, 1.225, 2.0685e5);
    squeeze(&gas, &point, 4.0, 1000);
    assert_near(point.pressure / (0.4 * 1.225 * 2.0685e5 * pow(4.0 / 1.225, 1.4)), 1.0, 1e-6);
}

static void steps_of_half_the_size_leave_a_quarter_of_the_error(void **state)
{
    (void)state;
    const struct {
        const struct material *material;
        double density, energy, end;
    } ways[] = {{&gas, 1.225, 2.0685e5, 3.0},
                {&tnt, 1630.0, 0.0, 600.0},
                {&steel, 7890.0, 1e5, 9500.0},
                {&aluminium, 2700.0, 2e5, 3300.0}};
    for (int k = 0; k < 4; k++) {
        const struct material *material = ways[k].material;
        double error[2];
        const struct point start = at(material, ways[k].density, ways[k].energy);
        const double wanted = adiabat(material, start, ways[k].end);
        for (int fine = 0; fine < 2; fine++) {
            struct point point = start;
            squeeze(material, &point, ways[k].end, fine ? 100 : 50);
            error[fine] = point.energy - wanted;
        }
        assert_near(error[0] / error[1], 4.0, 0.2);
        assert_near(error[1], 0.0, 1e-3 * fabs(wanted - start.energy));
    }
}

static void the_end_of_a_step_is_on_the_mean_of_both_pressures(void **state)
{
    (void)state;
    const struct material *const all[] = {&gas, &tnt, &steel};
    const double energy[] = {2.0685e5, 0.0, 3e5};
    for (int k = 0; k < 3; k++) {
        struct point point = at(all[k], 1.1 * material_density(all[k]), energy[k]);
        const struct point start = point;
        const struct motion motion = {
            .dt = 1e-8, .density = 1.2 * start.density, .viscous_pressure = 3e6};
        material_step_by_work(all[k], &point, &motion);
        const double change = 1.0 / point.density - 1.0 / start.density;
        const double mean = 0.5 * (start.pressure + point.pressure) + 3e6;
        assert_near(point.energy - start.energy, -mean * change, 1e-12 * fabs(point.energy));
    }
}

static void elastic_shear_stores_its_energy(void **state)
{
    (void)state;
    struct point point = at(&steel, 7890.0, 0.0);
    const struct motion motion = {.dt = 1e-8, .density = 7890.0, .strain_rate = {.xy = 1e4}};
    for (int k = 0; k < 10; k++)
        material_step_by_work(&steel, &point, &motion);
    const double stored = sym3_square(point.deviator) / (4.0 * 81.8e9 * 7890.0);
    assert_true(point.history[HISTORY_plastic_strain] == 0.0 && stored > 1.0);
    assert_near(point.energy, stored, 1e-12 * stored);
}

static void plastic_shear_heats(void **state)
{
    (void)state;
    struct point point = at(&steel, 7890.0, 0.0);
    const struct motion motion = {
        .dt = 1e-7, .density = 7890.0, .strain_rate = {1e4, -5e3, -5e3, 0.0, 0.0, 0.0}};
    double work = 0.0;
    for (int k = 0; k < 300; k++) {
        const double before = point.history[HISTORY_plastic_strain];
        material_step_by_work(&steel, &point, &motion);
        work += sym3_mises(point.deviator) * (point.history[HISTORY_plastic_strain] - before);
    }
    const double stored = sym3_square(point.deviator) / (4.0 * 81.8e9 * 7890.0);
    assert_near(point.energy, work / 7890.0 + stored, 2e-3 * point.energy);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_gas_follows_its_adiabat),
        cmocka_unit_test(steps_of_half_the_size_leave_a_quarter_of_the_error),
        cmocka_unit_test(the_end_of_a_step_is_on_the_mean_of_both_pressures),
        cmocka_unit_test(elastic_shear_stores_its_energy),
        cmocka_unit_test(plastic_shear_heats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
