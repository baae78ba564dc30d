/* Curves of equations of state: shocks obey the linear relation where the model has it, a second
 * shock heats less than one of the same pressure from rest, a porous body more; isentropes keep
 * what they must. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "dice.h"
#include "exact/material_curves.h"

static const struct material aluminium = {
    .eos = {EOS_mie_grueneisen,
            {.mie_grueneisen = {2700.0, 5350.0, 1.35, 2.17, 73e9, EOS_EXTENDED}}},
    .heat = {880.0, 200.0, 293.0}};
static const struct material air = {.eos = {EOS_ideal_gas, {.ideal_gas = {1.225, 1.4}}},
                                    .heat = {NAN, NAN, NAN}};

static void shocks_from_rest_obey_the_linear_relation(void **state)
{
    (void)state;
    struct curve_state rest, behind;
    assert_true(curve_rest(&aluminium, &rest));
    assert_close(rest.temperature, 293.0, 1e-14);
    for (double ratio = 1.05; ratio < 3.0; ratio += 0.1) {
        assert_true(curve_shock(&aluminium, &rest, rest.density, ratio * 2700.0, &behind));
        assert_close(behind.shock, 5350.0 + 1.35 * behind.particle, 1e-12);
        assert_close(behind.energy, 0.5 * square(behind.particle), 1e-12);
        assert_close(behind.pressure, 2700.0 * behind.shock * behind.particle, 1e-12);
    }
    assert_false(curve_shock(&aluminium, &rest, rest.density, 2600.0, &behind));
}

static void two_shocks_heat_less_than_one_and_pores_more(void **state)
{
    (void)state;
    struct curve_state rest, first, once, twice, porous;
    assert_true(curve_rest(&aluminium, &rest));
    assert_true(curve_shock(&aluminium, &rest, rest.density, 1.2 * 2700.0, &first));
    assert_true(curve_shock(&aluminium, &rest, rest.density, 1.4 * 2700.0, &once));
    assert_true(curve_shock(&aluminium, &first, first.density, 1.4 * 2700.0, &twice));
    assert_true(curve_shock(&aluminium, &rest, 2700.0 / 1.2, 1.4 * 2700.0, &porous));
    assert_true(twice.temperature < once.temperature && once.temperature < porous.temperature);
    assert_true(twice.pressure < once.pressure && once.pressure < porous.pressure);
    /* from 1.92 times its volume on, pores heat more than compression densifies (1 + 2/gamma) */
    assert_false(curve_shock(&aluminium, &rest, 2700.0 / 3.0, 1.05 * 2700.0, &porous));
}

static void a_gas_follows_its_laws(void **state)
{
    (void)state;
    struct curve_state rest, behind, expanded[2];
    assert_true(curve_rest(&air, &rest));
    assert_close(rest.pressure, 101325.0, 1e-14);
    assert_true(isnan(rest.temperature));
    const double densities[] = {0.6, 0.1};
    curve_isentrope(&air, densities, 2, expanded);
    for (int k = 0; k < 2; k++)
        assert_close(expanded[k].pressure, 101325.0 * pow(densities[k] / 1.225, 1.4), 1e-10);
    assert_true(curve_shock(&air, &rest, rest.density, 4.0 * 1.225, &behind));
    assert_close(behind.pressure, 101325.0 * (6.0 * 4.0 - 1.0) / (6.0 - 4.0), 1e-12);
    assert_false(curve_shock(&air, &rest, rest.density, 6.5 * 1.225, &behind)); /* 6 at most */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shocks_from_rest_obey_the_linear_relation),
        cmocka_unit_test(two_shocks_heat_less_than_one_and_pores_more),
        cmocka_unit_test(a_gas_follows_its_laws),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
