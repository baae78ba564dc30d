/* Every equation of state that depends on energy, with the constants of its sample and of every
 * material of the library, wherever an impact of 15 km/s, a jet or a reflected shock can take it:
 * rho_0/1000 to 4 rho_0, and from the cold curve to five times the energy of a shock of 15 km/s. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "case/library.h"
#include "dice.h"
#include "every_eos.h"
#include "material/material.h"
#include "small_catalogue.h"
#include "source_folder.h"

static const double none[POINT_HISTORY] = {0.0};
static const double shock_energy = 0.5 * 15e3 * 15e3;
static const struct heat heat = {900.0, 200.0, 293.0};

static double sound2(const struct eos_value *value, double density)
{
    return value->dp_drho + value->dp_de * value->pressure / square(density);
}

/* The energy of the isentrope of the state at rest at RATIO of rho_0, by Heun's method. */
static double cold_energy(const struct eos *eos, double ratio)
{
    enum { STEPS = 2000 };
    const double step = log(ratio) / STEPS;
    double density = eos_reference_density(eos), energy = 0.0;
    for (int i = 0; i < STEPS; i++) {
        const double next = density * exp(step);
        const double first = eos_evaluate(eos, density, energy, none).pressure / density;
        const double second = eos_evaluate(eos, next, energy + step * first, none).pressure / next;
        energy += 0.5 * step * (first + second);
        density = next;
    }
    return energy;
}

static bool depends_on_energy(const struct eos *eos)
{
    return eos_evaluate(eos, 1.1 * eos_reference_density(eos), 0.0, none).dp_de > 0.0;
}

/* Derivatives against differences, at a state away from every kink. */
static void check_derivatives(const struct eos *eos, double density, double energy)
{
    const struct eos_value value = eos_evaluate(eos, density, energy, none);
    const double dr = 1e-5 * density, de = 1e-5 * (fabs(energy) + 1e6);
    const double scale = fabs(value.pressure) + value.dp_de * fabs(energy) + 1e9;
    const double by_density = (eos_evaluate(eos, density + dr, energy, none).pressure -
                               eos_evaluate(eos, density - dr, energy, none).pressure) /
                              (2.0 * dr);
    const double by_energy = (eos_evaluate(eos, density, energy + de, none).pressure -
                              eos_evaluate(eos, density, energy - de, none).pressure) /
                             (2.0 * de);
    if (!(value.status & POINT_SOUND_HELD))
        assert_near(value.dp_drho, by_density, 1e-5 * fabs(value.dp_drho) + 1e-4 * scale / density);
    assert_near(value.dp_de, by_energy, 1e-5 * value.dp_de + 1e-6 * scale / (fabs(energy) + 1e6));
}

static void check_state(const struct eos *eos, double density, double energy)
{
    const struct eos_value value = eos_evaluate(eos, density, energy, none);
    if (!isfinite(value.pressure) || !isfinite(value.dp_drho) || !isfinite(value.dp_de))
        fail_msg("not finite at %g, %g", density, energy);
    /* held only in tension, and then still positive; a gamma below 1/2 is too small for attraction
     * to end before pressure begins */
    const double rest = eos_reference_density(eos);
    const struct eos_value at_rest = eos_evaluate(eos, rest, 0.0, none);
    const double modulus = at_rest.dp_drho * rest;
    if (!(sound2(&value, density) > 0.0))
        fail_msg("c^2 %g at %g of rho_0, %g J/kg, %g Pa", sound2(&value, density),
                 density / eos_reference_density(eos), energy, value.pressure);
    if (at_rest.dp_de > 0.5 * rest && value.status & POINT_SOUND_HELD &&
        value.pressure > 1e-4 * modulus)
        fail_msg("c^2 held at %g of rho_0, %g J/kg, %g Pa", density / eos_reference_density(eos),
                 energy, value.pressure);
    if (heat_wrong(&heat, eos))
        return; /* a mixture, whose history its temperature needs */
    const double temperature = heat_temperature(&heat, eos, density, energy);
    assert_true(isfinite(temperature));
    const double back = heat_energy(&heat, eos, density, temperature);
    assert_near(back, energy, 1e-9 * (fabs(energy) + heat.capacity * fabs(temperature)));
}

static void scan(const struct eos *eos)
{
    const double rest = eos_reference_density(eos);
    for (int i = 0; i <= 96; i++) {
        const double ratio = i < 48 ? pow(10.0, (i - 48) / 16.0) : 1.0 + 3.0 * (i - 48) / 48.0;
        const double cold = cold_energy(eos, ratio);
        for (int k = 0; k <= 32; k++) {
            const double energy = cold + 5.0 * shock_energy * pow((k + 1e-3) / 32.0, 3.0);
            check_state(eos, ratio * rest, energy);
            check_derivatives(eos, ratio * 1.0007 * rest, energy);
        }
    }
}

static void every_sample_holds(void **state)
{
    (void)state;
    for (int k = 0; k < EOS_KINDS; k++)
        if (depends_on_energy(&all[k]))
            scan(&all[k]);
}

static void every_material_of_the_library_holds(void **state)
{
    (void)state;
    const char *const folder = materials_folder;
    struct name_list names;
    assert_null(library_names(folder, &names));
    int scanned = 0;
    for (int i = 0; i < names.count; i++) {
        struct material_input input;
        char *path = library_file(&folder, 1, names.names[i]);
        assert_null(library_read(path, &small_catalogue, &input));
        free(path);
        print_message("%s\n", names.names[i]);
        if (depends_on_energy(&input.material->eos)) {
            scan(&input.material->eos);
            scanned++;
        }
        library_release(&input);
    }
    assert_true(scanned > 20);
    library_names_free(&names);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_sample_holds),
        cmocka_unit_test(every_material_of_the_library_holds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
