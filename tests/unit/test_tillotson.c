/* Tillotson's equation of state with the constants of aluminium (Melosh 1989, table AII.3): values
 * worked out by hand from the formulas, continuity where its regions meet, and its derivatives
 * against differences. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "material/material.h"

static const struct eos_tillotson aluminium = {.density = 2700.0,
                                               .a = 0.5,
                                               .b = 1.63,
                                               .bulk_modulus = 75.2e9,
                                               .second_modulus = 65e9,
                                               .energy = 5e6,
                                               .alpha = 5.0,
                                               .beta = 5.0,
                                               .incipient_energy = 3e6,
                                               .complete_energy = 13.9e6,
                                               .tension = NAN};

static double pressure(double density, double energy)
{
    return eos_tillotson(&aluminium, density, energy, NULL).pressure;
}

static void pressure_vanishes_at_rest(void **state)
{
    (void)state;
    assert_true(pressure(2700.0, 0.0) == 0.0);
    struct eos_value rest = eos_tillotson(&aluminium, 2700.0, 0.0, NULL);
    assert_float_equal(rest.dp_drho, 75.2e9 / 2700.0, 1e-3);
}

static void condensed_and_vapour_values_are_those_worked_out_by_hand(void **state)
{
    (void)state;
    /* eta = 1.2, e = 2 MJ/kg: w = 1 + 0.4/1.44, p = (0.5 + 1.63/w) 3240 2e6 + 15.04e9 + 2.6e9 */
    double w = 1.0 + 0.4 / 1.44;
    assert_float_equal(pressure(3240.0, 2e6), (0.5 + 1.63 / w) * 6.48e9 + 17.64e9, 1.0);
    /* eta = 1/2, e = 20 MJ/kg: w = 17, thin = 1, fade = cold = exp(-5) */
    double fade = exp(-5.0);
    double expected = 0.5 * 1350.0 * 2e7 + (1.63 * 1350.0 * 2e7 / 17.0 - 37.6e9 * fade) * fade;
    assert_float_equal(pressure(1350.0, 2e7), expected, 1.0);
}

static void regions_meet_without_a_jump(void **state)
{
    (void)state;
    const double energies[] = {3e6, 13.9e6};
    for (int k = 0; k < 2; k++)
        for (double density = 500.0; density < 2700.0; density += 100.0) {
            double below = pressure(density, energies[k] * (1.0 - 1e-12));
            double above = pressure(density, energies[k] * (1.0 + 1e-12));
            assert_true(fabs(below - above) < 1e-9 * (fabs(below) + 1e9));
        }
    for (double energy = 0.0; energy < 3e7; energy += 1e6)
        assert_true(fabs(pressure(2700.0 * (1.0 - 1e-13), energy) - pressure(2700.0, energy)) <
                    1.0);
}

static void derivatives_are_those_of_the_pressure(void **state)
{
    (void)state;
    for (double density = 700.0; density < 4000.0; density += 290.0)
        for (double energy = 0.2e6; energy < 3e7; energy += 0.77e6) {
            struct eos_value value = eos_tillotson(&aluminium, density, energy, NULL);
            double dr = 1e-5 * density, de = 1e-5 * energy;
            double by_density =
                (pressure(density + dr, energy) - pressure(density - dr, energy)) / (2.0 * dr);
            double by_energy =
                (pressure(density, energy + de) - pressure(density, energy - de)) / (2.0 * de);
            if (!(value.status & POINT_SOUND_HELD))
                assert_true(fabs(by_density - value.dp_drho) < 1e-6 * (fabs(value.dp_drho) + 1e6));
            assert_true(fabs(by_energy - value.dp_de) < 1e-6 * (fabs(value.dp_de) + 1e2));
        }
}

/* However cold matter is said to be, compressed it has pressure at last. */
static void no_energy_makes_tension_without_bound(void **state)
{
    (void)state;
    const double cold = 0.2 * 75.2e9 + 0.04 * 65e9, most = (0.5 + 1.63) * 3240.0 * 1e6;
    for (double energy = -1e3; energy > -1e12; energy *= 10.0) {
        assert_true(pressure(3240.0, energy) > cold - most);
        assert_true(pressure(3240.0, energy) < pressure(3240.0, 0.1 * energy));
    }
    struct eos_tillotson source = aluminium;
    source.form = EOS_SOURCE;
    assert_true(eos_tillotson(&source, 3240.0, -1e9, NULL).pressure < -1e11);
}

static void it_bears_no_more_tension_than_it_is_given(void **state)
{
    (void)state;
    struct eos_tillotson weak = aluminium;
    weak.tension = 1e9;
    struct eos_value drawn = eos_tillotson(&weak, 2500.0, 1e5, NULL);
    assert_true(pressure(2500.0, 1e5) < -1e9);
    assert_true(drawn.pressure == -1e9);
    assert_true(drawn.dp_de == 0.0);
    assert_true(drawn.dp_drho == 75.2e9 / 2700.0);
    assert_true(eos_tillotson(&weak, 2690.0, 1e5, NULL).pressure == pressure(2690.0, 1e5));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pressure_vanishes_at_rest),
        cmocka_unit_test(condensed_and_vapour_values_are_those_worked_out_by_hand),
        cmocka_unit_test(regions_meet_without_a_jump),
        cmocka_unit_test(derivatives_are_those_of_the_pressure),
        cmocka_unit_test(no_energy_makes_tension_without_bound),
        cmocka_unit_test(it_bears_no_more_tension_than_it_is_given),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
