/* The gas of a closed room in equilibrium: beside numbers of scripts/room-pressure, which computes
 * them apart, beside gases without reactions, and beside flames in closed vessels. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>

#include "base/base.h"
#include "material/equilibrium.h"

static const struct composition tnt = {7, 5, 3, 6, -63.2e3 / 0.22713};
static const double atmosphere = 101325.0, cool = 288.15;

static struct room_gas room_of(const struct composition *explosive, double load)
{
    const struct room room = {load, equilibrium_density_of_air(atmosphere, cool), cool};
    return equilibrium_of_room(explosive, &room);
}

static void assert_near(double value, double wanted, double within)
{
    if (!(fabs(value - wanted) <= within * fabs(wanted)))
        fail_msg("%.9g instead of %.9g", value, wanted);
}

static void rooms_with_tnt_have_the_pressures_of_the_script(void **state)
{
    (void)state;
    static const double wanted[][2] = {
        {0.01, 58.04e3}, {0.03, 166.5e3}, {0.1, 480.7e3}, {0.2, 833.7e3}, {0.375, 1206e3},
        {0.7, 1645e3},   {1.0, 1971e3},   {2.0, 2922e3},  {5.0, 5680e3},  {10.0, 10428e3}};
    for (size_t k = 0; k < COUNT_OF(wanted); k++)
        assert_near(room_of(&tnt, wanted[k][0]).pressure - atmosphere, wanted[k][1], 5e-4);
}

static void air_alone_stays_what_it_is(void **state)
{
    (void)state;
    const struct room_gas gas = room_of(&tnt, 0.0);
    assert_near(gas.pressure, atmosphere, 1e-6);
    assert_near(gas.temperature, cool, 1e-6);
}

/* Recalled: 2587 and 2755 K from 298 K. The rigid rotor and harmonic oscillator lacks 1 to 2 % of
 * the heat capacity above 2000 K. */
static void flames_in_closed_vessels_are_as_hot_as_published(void **state)
{
    (void)state;
    const struct composition methane = {1, 4, 0, 0, -74.6e3 / 16.043e-3},
                             hydrogen = {0, 2, 0, 0, 0.0};
    const double oxygen = 0.2095 * atmosphere / (8.314462618 * cool); /* mol/m^3 */
    assert_near(room_of(&methane, 0.5 * oxygen * 16.043e-3).temperature, 2587.0, 0.02);
    assert_near(room_of(&hydrogen, 2.0 * oxygen * 2.016e-3).temperature, 2755.0, 0.02);
}

static void pressure_grows_with_the_load(void **state)
{
    (void)state;
    double before = atmosphere;
    for (double load = 1e-4; load < 100.0; load *= 1.1) {
        const double pressure = room_of(&tnt, load).pressure;
        assert_true(pressure > before);
        before = pressure;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rooms_with_tnt_have_the_pressures_of_the_script),
        cmocka_unit_test(air_alone_stays_what_it_is),
        cmocka_unit_test(flames_in_closed_vessels_are_as_hot_as_published),
        cmocka_unit_test(pressure_grows_with_the_load),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
