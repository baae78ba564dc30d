/* Temperature of a point: the shock adiabat after Walsh and Christian against its differential
 * equation, the curves of the other equations of state against what thermodynamics asks of them,
 * and energy from temperature. */
#include "dice.h"

#include <string.h>

#include "every_eos.h"
#include "material/heat.h"

static const struct heat aluminium_heat = {880.0, 200.0, 293.0};
static const struct eos_mie_grueneisen aluminium = {2700.0, 5350.0, 1.35, 2.17, 73e9, EOS_EXTENDED};
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
                                                {7850.0, 4570.0, 1.49, 1.93, 170e9, EOS_EXTENDED},
                                                {910.0, 3320.0, 1.24, 0.146, 0.73e9, EOS_EXTENDED},
                                                {1000.0, 1500.0, 0.0, 1.0, 2e9, EOS_EXTENDED}};
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
                assert_close(mie_grueneisen_adiabat_temperature(&aluminium_heat, s, eta + step),
                             temperature, 1e-9);
        }
    }
}

static void the_adiabat_holds_up_to_its_largest_compression(void **state)
{
    (void)state;
    /* The equation of state is held where 1 - S_a eta falls below a thousandth; so is the
     * temperature's integral. */
    double last = 0.0;
    for (double eta = 0.7; eta < 0.9; eta += 1e-3) {
        double temperature = mie_grueneisen_adiabat_temperature(&aluminium_heat, &aluminium, eta);
        assert_true(isfinite(temperature) && temperature > last);
        last = temperature;
    }
}

static void shocked_aluminium_has_its_temperature(void **state)
{
    (void)state;
    struct eos solid = all[EOS_mie_grueneisen];
    /* On the adiabat the energy is p_H (v_0 - v)/2, at rest and in tension (1.68). */
    double eta = 0.2, pressure = 2700.0 * square(5350.0) * eta / square(1.0 - 1.35 * eta);
    assert_close(heat_temperature(&aluminium_heat, &solid, 2700.0 / (1.0 - eta),
                                  0.5 * pressure * eta / 2700),
                 mie_grueneisen_adiabat_temperature(&aluminium_heat, &aluminium, eta), 1e-13);
    assert_close(heat_temperature(&aluminium_heat, &solid, 2700.0, 0.0), 293.0, 1e-15);
    assert_close(heat_temperature(&aluminium_heat, &solid, 2700.0, 8800.0), 303.0, 1e-15);
    double thin = 2500.0, cold = 73e9 * square(1.0 - 2700.0 / thin) / (2.0 * 2700.0);
    assert_close(heat_temperature(&aluminium_heat, &solid, thin, cold), 293.0, 1e-15);
}

/* A mixture of two phases has none: its temperature depends on what has burnt. */
static bool has_curve(int kind) { return kind != EOS_reactive_jwl && kind != EOS_blended_jwl; }

static void energy_and_temperature_are_inverse(void **state)
{
    (void)state;
    for (int k = 0; k < EOS_KINDS; k++)
        for (double ratio = 0.8; ratio < 1.5 && has_curve(k); ratio += 0.1)
            for (double temperature = 100.0; temperature < 2e4; temperature *= 3.0) {
                double density = ratio * all[k].of.reference_density;
                double energy = heat_energy(&aluminium_heat, &all[k], density, temperature);
                double back = heat_temperature(&aluminium_heat, &all[k], density, energy);
                assert_near(back, temperature, 1e-14 * (temperature + fabs(energy) / 880.0));
            }
}

static void what_rests_without_energy_has_its_temperature(void **state)
{
    (void)state;
    const double none[POINT_HISTORY] = {0.0};
    for (int k = 0; k < EOS_KINDS; k++) {
        const double density = eos_reference_density(&all[k]);
        const struct eos_value rest = eos_evaluate(&all[k], density, 0.0, none);
        if (rest.pressure == 0.0 && rest.dp_drho > 0.0 && has_curve(k))
            assert_close(heat_temperature(&aluminium_heat, &all[k], density, 0.0), 293.0, 1e-14);
    }
}

/* PETN that has not reacted: its E_0 makes the pressure vanish at rest (Parshikov (2013), table
 * 5.1). */
static const struct eos_jwl petn = {1750.0, 3756e9, -131.3e9,  7.2,
                                    3.6,    1.173,  60.7965e6, EOS_EXTENDED};

EOS_ISENTROPE(isentrope_of_stiffened_gas, stiffened_gas)
EOS_ISENTROPE(isentrope_of_mie_grueneisen, mie_grueneisen)
EOS_ISENTROPE(isentrope_of_grueneisen_eta, grueneisen_eta)
EOS_ISENTROPE(isentrope_of_grueneisen_polynomial, grueneisen_polynomial)
EOS_ISENTROPE(isentrope_of_jwl, jwl)
EOS_ISENTROPE(isentrope_of_barotropic, barotropic)
EOS_ISENTROPE(isentrope_of_polynomial, polynomial)

/* Temperatures counted from the isentrope and from the curve of a model, whose pressure is linear
 * in energy, are equal. */
#define ASSERT_SAME(name, eos, ratio)                                                           \
    do {                                                                                        \
        const double density = (ratio) * (eos).density;                                         \
        const struct heat_curve one = isentrope_of_##name(&(eos), &aluminium_heat, density),    \
                                two = eos_##name##_curve(&(eos), &aluminium_heat, density);     \
        assert_near(two.temperature - two.energy / 880.0, one.temperature - one.energy / 880.0, \
                    1e-6 * (293.0 + one.energy / 880.0));                                       \
    } while (0)

static void temperatures_from_isentropes_are_those_from_other_curves(void **state)
{
    (void)state;
    for (double ratio = 0.91; ratio < 1.4; ratio += 0.05) { /* the form of the source */
        ASSERT_SAME(stiffened_gas, all[EOS_stiffened_gas].of.stiffened_gas, ratio);
        ASSERT_SAME(grueneisen_eta, all[EOS_grueneisen_eta].of.grueneisen_eta, ratio);
        ASSERT_SAME(grueneisen_polynomial, all[EOS_grueneisen_polynomial].of.grueneisen_polynomial,
                    ratio);
        ASSERT_SAME(jwl, petn, ratio);
        ASSERT_SAME(barotropic, all[EOS_barotropic].of.barotropic, ratio);
        ASSERT_SAME(polynomial, all[EOS_polynomial].of.polynomial, ratio);
        if (ratio > 1.01) /* its T_r in tension is that of its source */
            ASSERT_SAME(mie_grueneisen, all[EOS_mie_grueneisen].of.mie_grueneisen, ratio);
    }
}

/* Where T does not depend on how a state was reached, (de/drho)_T = (p - T (dp/dT)_rho)/rho^2. */
static void curves_agree_with_their_pressure(void **state)
{
    (void)state;
    for (int k = 0; k < EOS_KINDS; k++) {
        /* C_V is not constant; crushing heats */
        if (k == EOS_tillotson || k == EOS_hjc)
            continue;
        for (double ratio = 0.3; ratio < 3.2 && has_curve(k); ratio += 0.0994) {
            if (k == EOS_mie_grueneisen && ratio < 1.0)
                continue; /* T_r in tension is that of the source */
            if (k == EOS_noble_abel && ratio > 1.4)
                continue; /* the molecules take all the volume */
            const double none[POINT_HISTORY] = {0.0};
            double density = ratio * all[k].of.reference_density, d = 1e-5 * density, t = 700.0;
            double energy = heat_energy(&aluminium_heat, &all[k], density, t);
            double slope = (heat_energy(&aluminium_heat, &all[k], density + d, t) -
                            heat_energy(&aluminium_heat, &all[k], density - d, t)) /
                           (2.0 * d);
            struct eos_value p = eos_evaluate(&all[k], density, energy, none);
            double wanted = (p.pressure - t * p.dp_de * 880.0) / square(density);
            /* beyond the source's form the curve is integrated in steps */
            const double within = ratio < 2.5 ? 1e-6 : 2e-5;
            assert_near(slope, wanted,
                        within * (fabs(p.pressure) + p.dp_drho * density) / square(density));
        }
    }
}

/* The adiabatic work from rest to RATIO of the reference density and back to BACK, by pressure
 * alone. */
static double crushing_work(const struct eos *eos, double ratio, double back)
{
    enum { STEPS = 20000 };
    double history[POINT_HISTORY] = {0.0}, energy = 0.0, rest = eos_reference_density(eos);
    double density = rest, pressure = 0.0;
    for (int k = 1; k <= 2 * STEPS; k++) {
        const double part = (double)k / STEPS;
        const double next = rest * (part <= 1.0 ? 1.0 + (ratio - 1.0) * part
                                                : ratio + (back - ratio) * (part - 1.0));
        eos_compact(eos, next, history);
        const double after = eos_evaluate(eos, next, 0.0, history).pressure;
        energy += 0.5 * (pressure + after) * (1.0 / density - 1.0 / next);
        density = next;
        pressure = after;
    }
    return energy;
}

static void crushed_concrete_is_warm(void **state)
{
    (void)state;
    const struct eos *concrete = &all[EOS_hjc];
    const double rest = eos_reference_density(concrete);
    const double ratios[] = {1.0005, 1.05, 1.3};
    for (size_t k = 0; k < COUNT_OF(ratios); k++) {
        const double history[POINT_HISTORY] = {[HISTORY_largest_compression] = ratios[k] - 1.0};
        double low = 1.0 - 1e-9, high = ratios[k]; /* where it is unloaded */
        for (int round = 0; round < 60; round++) {
            const double middle = 0.5 * (low + high);
            *(eos_evaluate(concrete, rest * middle, 0.0, history).pressure > 0.0 ? &high : &low) =
                middle;
        }
        /* what is left of the work once it is unloaded is the heat of the crushed */
        const double whole = crushing_work(concrete, ratios[k], ratios[k]);
        const double left = crushing_work(concrete, ratios[k], high);
        assert_near(heat_temperature(&aluminium_heat, concrete, rest * ratios[k], whole),
                    293.0 + left / 880.0, 1e-6 * (293.0 + whole / 880.0));
        assert_true(k == 0 ? fabs(left) < 1e-3 * whole : left > 0.1 * whole);
    }
}

static void products_of_an_explosive_are_hot(void **state)
{
    (void)state;
    /* T = (E - E_c)/(rho_0 C_V), by hand: E_0 = 6.993, E_c = 1.410 + 1.307 GPa */
    assert_near(heat_temperature(&aluminium_heat, &all[EOS_jwl], 1630.0, 0.0),
                (6.993e9 - 371.2e9 / 4.15 * exp(-4.15) - 3.21e9 / 0.95 * exp(-0.95)) / 1630.0 /
                    880.0,
                1e-9);
    assert_near(heat_temperature(&aluminium_heat, &all[EOS_jwl], 1630.0, 0.0), 2981.0, 2.0);
}

/* Drawn out cold, metal takes up to the energy of vaporisation, and no more: what has more is warm
 * vapour. */
static void tillotsons_vapour_is_warm(void **state)
{
    (void)state;
    const struct eos *metal = &all[EOS_tillotson];
    for (double ratio = 0.9; ratio > 1e-3; ratio *= 0.8) {
        const struct heat_curve curve = eos_curve(metal, &aluminium_heat, ratio * 2700.0);
        assert_true(curve.energy > 0.0 && curve.energy < 13.9e6);
        assert_true(curve.temperature > 0.0 && curve.temperature <= 293.0);
    }
    assert_true(heat_temperature(&aluminium_heat, metal, 27.0, 20e6) > 6e6 / 880.0);
}

static void a_material_without_capacity_has_no_temperature(void **state)
{
    (void)state;
    const struct heat nothing = {NAN, NAN, NAN};
    for (int k = 0; k < EOS_KINDS; k++) {
        assert_true(!heat_wrong(&aluminium_heat, &all[k]) == has_curve(k));
        assert_non_null(
            strstr(heat_wrong(&nothing, &all[k]), has_curve(k) ? "capacity" : "no temperature"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_adiabat_obeys_its_differential_equation),
        cmocka_unit_test(the_adiabat_holds_up_to_its_largest_compression),
        cmocka_unit_test(shocked_aluminium_has_its_temperature),
        cmocka_unit_test(energy_and_temperature_are_inverse),
        cmocka_unit_test(what_rests_without_energy_has_its_temperature),
        cmocka_unit_test(temperatures_from_isentropes_are_those_from_other_curves),
        cmocka_unit_test(curves_agree_with_their_pressure),
        cmocka_unit_test(crushed_concrete_is_warm),
        cmocka_unit_test(products_of_an_explosive_are_hot),
        cmocka_unit_test(tillotsons_vapour_is_warm),
        cmocka_unit_test(a_material_without_capacity_has_no_temperature),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
