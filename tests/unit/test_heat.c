/* Temperature of a point: the shock adiabat after Walsh and Christian against its differential equation, the curves of
 * the other equations of state against what thermodynamics asks of them, and energy from temperature. */
#include "dice.h"

#include <string.h>

#include "material/heat.h"

static const struct heat aluminium_heat = {880.0, 200.0, 293.0};
static const struct eos_mie_grueneisen aluminium = {2700.0, 5350.0, 1.35, 2.17, 73e9};
static const struct eos eos[] = {
    {EOS_ideal_gas, {.ideal_gas = {1.2, 1.4}}},
    {EOS_stiffened_gas, {.stiffened_gas = {1000.0, 1480.0, 4.4}}},
    {EOS_barotropic, {.barotropic = {1000.0, 2e9}}},
    {EOS_rubber, {.rubber = {1010.0, 852.0}}},
    {EOS_mie_grueneisen, {.mie_grueneisen = {2700.0, 5350.0, 1.35, 2.17, 73e9}}}};

/* C_V [dT/dv + (gamma/v) T] = (v_0 - v)/2 dp_H/dv + p_H/2, per unit of eta = 1 - v/v_0. */
static double adiabat_slope(const struct eos_mie_grueneisen *s, double eta, double temperature)
{
    double v0 = 1.0 / s->density, v = v0 * (1.0 - eta), dv = v0 - v;
    double under = v0 - s->slope * dv, c2 = square(s->sound);
    double pressure = c2 * dv / square(under);
    double pressure_slope = -c2 * (v0 + s->slope * dv) / (under * square(under));
    double slope = (0.5 * dv * pressure_slope + 0.5 * pressure) / aluminium_heat.capacity -
                   s->gamma / v * temperature;
    return -v0 * slope;
}

static void the_adiabat_obeys_its_differential_equation(void **state)
{
    (void)state;
    const struct eos_mie_grueneisen solids[] = {aluminium,
                                                {7850.0, 4570.0, 1.49, 1.93, 170e9},
                                                {910.0, 3320.0, 1.24, 0.146, 0.73e9},
                                                {1000.0, 1500.0, 0.0, 1.0, 2e9}};
    enum { STEPS = 4000 };
    for (size_t k = 0; k < COUNT_OF(solids); k++) {
        const struct eos_mie_grueneisen *s = &solids[k];
        double temperature = 293.0, step = 0.5 / STEPS;
        for (int i = 0; i < STEPS; i++) { /* Runge-Kutta of fourth order */
            double eta = step * i, half = 0.5 * step;
            double a = adiabat_slope(s, eta, temperature);
            double b = adiabat_slope(s, eta + half, temperature + half * a);
            double c = adiabat_slope(s, eta + half, temperature + half * b);
            double d = adiabat_slope(s, eta + step, temperature + step * c);
            temperature += step / 6.0 * (a + 2.0 * b + 2.0 * c + d);
            if (i % 500 == 499)
                assert_close(heat_adiabat(&aluminium_heat, s, eta + step), temperature, 1e-9);
        }
    }
}

static void the_adiabat_holds_up_to_its_largest_compression(void **state)
{
    (void)state;
    /* The equation of state is held where 1 - S_a eta falls below a thousandth; so is the temperature's integral. */
    double last = 0.0;
    for (double eta = 0.7; eta < 0.9; eta += 1e-3) {
        double temperature = heat_adiabat(&aluminium_heat, &aluminium, eta);
        assert_true(isfinite(temperature) && temperature > last);
        last = temperature;
    }
}

static void shocked_aluminium_has_its_temperature(void **state)
{
    (void)state;
    struct eos solid = eos[4];
    /* On the adiabat the energy is p_H (v_0 - v)/2, at rest and in tension (1.68). */
    double eta = 0.2, pressure = 2700.0 * square(5350.0) * eta / square(1.0 - 1.35 * eta);
    assert_close(heat_temperature(&aluminium_heat, &solid, 2700.0 / (1.0 - eta),
                                  0.5 * pressure * eta / 2700),
                 heat_adiabat(&aluminium_heat, &aluminium, eta), 1e-13);
    assert_close(heat_temperature(&aluminium_heat, &solid, 2700.0, 0.0), 293.0, 1e-15);
    assert_close(heat_temperature(&aluminium_heat, &solid, 2700.0, 8800.0), 303.0, 1e-15);
    double thin = 2500.0, cold = 73e9 * square(1.0 - 2700.0 / thin) / (2.0 * 2700.0);
    assert_close(heat_temperature(&aluminium_heat, &solid, thin, cold), 293.0, 1e-15);
}

static void energy_and_temperature_are_inverse(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(eos); k++)
        for (double ratio = 0.8; ratio < 1.5; ratio += 0.1)
            for (double temperature = 100.0; temperature < 2e4; temperature *= 3.0) {
                double density = ratio * eos[k].of.reference_density;
                double energy = heat_energy(&aluminium_heat, &eos[k], density, temperature);
                double back = heat_temperature(&aluminium_heat, &eos[k], density, energy);
                assert_near(back, temperature, 1e-14 * (temperature + fabs(energy) / 880.0));
            }
}

/* Where T does not depend on how a state was reached, (de/drho)_T = (p - T (dp/dT)_rho)/rho^2. */
static void curves_agree_with_their_pressure(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(eos) - 1; k++)
        for (double ratio = 0.8; ratio < 1.5; ratio += 0.1) {
            const double none[POINT_HISTORY] = {0.0};
            double density = ratio * eos[k].of.reference_density, d = 1e-4 * density, t = 700.0;
            double energy = heat_energy(&aluminium_heat, &eos[k], density, t);
            double slope = (heat_energy(&aluminium_heat, &eos[k], density + d, t) -
                            heat_energy(&aluminium_heat, &eos[k], density - d, t)) /
                           (2.0 * d);
            struct eos_value p = eos_evaluate(&eos[k], density, energy, none);
            double wanted = (p.pressure - t * p.dp_de * 880.0) / square(density);
            assert_near(slope, wanted,
                        1e-6 * (fabs(p.pressure) + p.dp_drho * density) / square(density));
        }
}

static void others_say_why_they_have_no_temperature(void **state)
{
    (void)state;
    const struct heat nothing = {NAN, NAN, NAN};
    struct eos jwl = {EOS_jwl, {.jwl = {1630.0, 371e9, 3.2e9, 4.15, 0.95, 0.3, 7e9}}};
    assert_non_null(strstr(heat_wrong(&aluminium_heat, &jwl), "equation of state"));
    assert_true(isnan(heat_temperature(&aluminium_heat, &jwl, 1630.0, 0.0)));
    for (size_t k = 0; k < COUNT_OF(eos); k++) {
        assert_null(heat_wrong(&aluminium_heat, &eos[k]));
        assert_non_null(strstr(heat_wrong(&nothing, &eos[k]), "capacity"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_adiabat_obeys_its_differential_equation),
        cmocka_unit_test(the_adiabat_holds_up_to_its_largest_compression),
        cmocka_unit_test(shocked_aluminium_has_its_temperature),
        cmocka_unit_test(energy_and_temperature_are_inverse),
        cmocka_unit_test(curves_agree_with_their_pressure),
        cmocka_unit_test(others_say_why_they_have_no_temperature),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
