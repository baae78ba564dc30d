/* The state of a cell that two materials share by its markers, beside the values of the
 * specification. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "gas/markers.h"

static void mix(int mixing, double of_cell, struct gas_mixed *mixed)
{
    struct eos_jwl products = EOS_jwl_SAMPLE;
    const struct eos_ideal_gas air = {1.0, 1.4};
    products.energy = 0.0; /* energies hold the heat of the detonation */
    const struct eos eos[2] = {eos_make_jwl(&products), eos_make_ideal_gas(&air)};
    const double theta[2] = {0.4, 0.6}, energy[2] = {3.04e6, 2.46e6};
    *mixed = gas_mix(eos, theta, energy, 200.0, of_cell, mixing);
}

static void materials_of_a_mixed_cell_have_one_pressure(void **state)
{
    (void)state;
    struct gas_mixed mixed;
    mix(MIXING_PRINTED, 2.9e6, &mixed);
    assert_float_equal(mixed.density[0], 208.03387388, 1e-7);
    assert_float_equal(mixed.density[1], 194.64408407, 1e-7);
    assert_float_equal(mixed.pressure, 191.52977873e6, 1.0);
    assert_float_equal(mixed.energy[0], 3.04e6, 1e-6);
}

static void a_mixed_cell_keeps_its_energy(void **state)
{
    (void)state;
    struct gas_mixed mixed;
    mix(MIXING_CONSERVATIVE, 2.9e6, &mixed);
    assert_float_equal(mixed.density[0], 208.1097194, 1e-6);
    assert_float_equal(mixed.density[1], 194.5935204, 1e-6);
    assert_float_equal(mixed.pressure, 205.5565908e6, 1.0);
    assert_float_equal(mixed.energy[0] / 3.04e6, 1.0735145446, 1e-9);
    assert_float_equal(0.4 * mixed.density[0] * mixed.energy[0] +
                           0.6 * mixed.density[1] * mixed.energy[1],
                       200.0 * 2.9e6, 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(materials_of_a_mixed_cell_have_one_pressure),
        cmocka_unit_test(a_mixed_cell_keeps_its_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
