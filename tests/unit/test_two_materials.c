/* Sweeps along rows of cells of two materials: a block of detonation products that air carries
 * round a ring, cut into rows whose ghosts are the cells of the next ones. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "ring.h"

enum { STEPS = 1000 };

static const double pressure = 1e8, courant = 0.8, whole[2] = {1.0, 1.0};

/* Products in a quarter of a ring of air. */
static struct ring make_ring(double speed, double density)
{
    static const struct eos_jwl products = EOS_jwl_SAMPLE;
    const struct eos_ideal_gas air = {1.0, 1.4};
    struct ring ring = {
        {eos_make_ideal_gas(&air), eos_make_jwl(&products)}, false, {0.0, 0.0}, speed, {{0.0}}};
    ring_fill(&ring, (const double[2]){1.0, density}, pressure);
    return ring;
}

static void a_mixture_has_the_pressure_of_both_materials(void **state)
{
    (void)state;
    const struct ring ring = make_ring(0.0, 1000.0);
    const struct eos *const eos[2] = {&ring.eos[0], &ring.eos[1]};
    const double none[POINT_HISTORY] = {0.0}, density[2] = {12.0, 700.0};
    for (double fraction = 0.01; fraction < 1.0; fraction += 0.14) {
        const struct mixture mixture = mixture_of(eos, density, fraction, whole);
        double energy = 0.0;
        for (int k = 0; k < 2; k++) {
            const double part = k ? fraction : 1.0 - fraction;
            const double of = (pressure - mixture.part[k].cold) / mixture.part[k].ratio;
            assert_close(eos_evaluate(eos[k], density[k], of, none).pressure, pressure, 1e-10);
            energy += part * density[k] * of;
        }
        assert_close(mixture_energy(&mixture, pressure), energy, 1e-12);
        assert_close(mixture_pressure(&mixture, energy), pressure, 1e-9);
    }
}

/* Both materials are compressed alike, and the work goes into their energy. */
static void the_speed_of_sound_of_a_mixture_is_that_of_its_isentrope(void **state)
{
    (void)state;
    const struct ring ring = make_ring(0.0, 1000.0);
    const struct eos *const eos[2] = {&ring.eos[0], &ring.eos[1]};
    const double rise = 1e-5;
    for (double fraction = 0.01; fraction < 1.0; fraction += 0.14) {
        double at[2];
        const double density[2] = {12.0, 700.0};
        const struct mixture rest = mixture_of(eos, density, fraction, whole);
        for (int side = 0; side < 2; side++) {
            const double by = side ? 1.0 + rise : 1.0 - rise;
            const double there[2] = {by * density[0], by * density[1]};
            const struct mixture mixture = mixture_of(eos, there, fraction, whole);
            /* d(rho e) = (rho e + p) d rho/rho, to second order */
            double energy = mixture_energy(&rest, pressure), now = pressure;
            for (int k = 0; k < 4; k++) {
                const double mean = mixture_energy(&rest, pressure) / rest.density;
                energy = by * rest.density *
                         (mean + 0.5 * (pressure + now) * (1.0 - 1.0 / by) / rest.density);
                now = mixture_pressure(&mixture, energy);
            }
            at[side] = now;
        }
        const double expected = (at[1] - at[0]) / (2.0 * rise * rest.density),
                     found = mixture_sound_square(&rest, pressure);
        if (!(fabs(found / expected - 1.0) < 1e-6))
            fail_msg("fraction %g: %g, expected %g", fraction, found, expected);
    }
}

/* Traces of products that have come from high pressure: their volume grows until they are not
 * colder than 0 K, and nothing else changes. */
static void a_material_that_would_be_colder_than_nothing_takes_more_volume(void **state)
{
    (void)state;
    const struct ring ring = make_ring(0.0, 1000.0);
    const struct eos *const eos[2] = {&ring.eos[0], &ring.eos[1]};
    struct dice dice = {3};
    for (int k = 0; k < 200; k++) {
        const double fraction = pow(10.0, dice_between(&dice, -6.0, -0.1)),
                     density[2] = {dice_between(&dice, 0.01, 10.0),
                                   dice_between(&dice, 1.0, 1500.0)},
                     mass[2] = {(1.0 - fraction) * density[0], fraction * density[1]},
                     heat =
                         mass[0] * dice_between(&dice, 1e5, 2e7) -
                         mass[1] * 0.999 * ring.eos[1].of.jwl.energy / ring.eos[1].of.jwl.density;
        const struct mixture before = mixture_of(eos, density, fraction, whole);
        const double found = mixture_thawed(eos, mass, fraction, heat);
        const double after[2] = {mass[0] / (1.0 - found), mass[1] / found};
        const struct mixture mixture = mixture_of(eos, after, found, whole);
        const bool cold =
            mixture_pressure(&before, heat) < mixture_coldest(eos[1], &before.part[1]);
        assert_true(cold ? found >= fraction : found == fraction);
        if (found > fraction)
            assert_true(mixture_pressure(&mixture, heat) >=
                        0.999 * mixture_coldest(eos[1], &mixture.part[1]));
    }
}

static void a_contact_of_two_materials_keeps_pressure_and_width(void **state)
{
    (void)state;
    static const double speeds[] = {1000.0, -1000.0, 100.0, -3.0, 10e3};
    for (size_t s = 0; s < COUNT_OF(speeds); s++) {
        struct ring ring = make_ring(speeds[s], 1000.0);
        const struct ring start = ring;
        const struct eos *const eos[2] = {&ring.eos[0], &ring.eos[1]};
        for (int step = 0; step < STEPS; step++)
            ring_sweep(&ring, ROW_CELLS, courant / (12e3 + fabs(ring.speed)));
        int between = 0;
        for (int c = 0; c < CELLS; c++) {
            const double fraction = ring.u[GAS_NUMBERS + PART_FRACTION][c],
                         density = ring.u[GAS_DENSITY][c], u = ring.u[GAS_MOMENTUM][c] / density;
            const double here[2] = {1.0, 1000.0};
            const struct mixture mixture = mixture_of(eos, here, fraction, whole);
            const double found =
                mixture_pressure(&mixture, ring.u[GAS_ENERGY][c] - 0.5 * density * square(u));
            if (!(fabs(found - pressure) < 1e-8 * pressure && fabs(u - ring.speed) < 1e-5))
                fail_msg("cell %d: pressure %.12g, velocity %.12g", c, found, u);
            between += fraction > 0.05 && fraction < 0.95;
        }
        if (between > 2 * 4)
            fail_msg("%d cells are in both contacts", between);
        for (int n = 0; n < NUMBERS; n++) {
            const double all = ring_sum(&start, n);
            if (!(fabs(ring_sum(&ring, n) - all) <= 1e-12 * fabs(all)))
                fail_msg("number %d: %.17g, before %.17g", n, ring_sum(&ring, n), all);
        }
        const double air =
            ring_sum(&start, GAS_DENSITY) - ring_sum(&start, GAS_NUMBERS + PART_MASS);
        const double now = ring_sum(&ring, GAS_DENSITY) - ring_sum(&ring, GAS_NUMBERS + PART_MASS);
        if (!(fabs(now - air) <= 1e-12 * air))
            fail_msg("mass of air: %.17g, before %.17g", now, air);
    }
}

/* A tenth of a cell has products at 8 GPa: they fill nearly all of it, and compress the air. */
static void a_shared_cell_begins_with_one_pressure(void **state)
{
    (void)state;
    const struct ring ring = make_ring(0.0, 1000.0);
    const struct eos *const eos[2] = {&ring.eos[0], &ring.eos[1]};
    const double none[POINT_HISTORY] = {0.0}, mass[2] = {0.9 * 1.2, 0.1 * 1630.0},
                 energy[2] = {0.9 * 2.5e5, 0.0};
    const double fraction = gas_relax(ring.eos, mass, energy, 0.1, 1.0);
    const double density[2] = {mass[0] / (1.0 - fraction), mass[1] / fraction};
    const struct mixture mixture = mixture_of(eos, density, fraction, whole);
    const double found = mixture_pressure(&mixture, energy[0] + energy[1]);
    assert_true(fraction > 0.99 && fraction < 1.0);
    /* the air as on its isentrope p ~ rho^1.4 */
    assert_close(found, 1e5 * pow(density[0] / 1.2, 1.4), 1e-3);
    assert_true(found < eos_evaluate(eos[1], density[1], 0.0, none).pressure);
    assert_true(gas_relax(ring.eos, mass, (const double[2]){0.9 * 2.5e5, -1.7e7 * mass[1]}, 0.1,
                          1.0) < 0.1 + 1e-3);
}

static void rows_of_any_length_give_the_same_bits(void **state)
{
    (void)state;
    struct ring ring[2];
    for (int k = 0; k < 2; k++) {
        ring[k] = make_ring(300.0, 1500.0);
        for (int c = 50; c < 100; c++) /* it expands */
            ring[k].u[GAS_ENERGY][c] += 2e9;
        for (int step = 0; step < 100; step++)
            ring_sweep(&ring[k], k ? 7 : ROW_CELLS, 0.2 / 12e3);
    }
    assert_memory_equal(ring[0].u, ring[1].u, sizeof ring[0].u);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mixture_has_the_pressure_of_both_materials),
        cmocka_unit_test(the_speed_of_sound_of_a_mixture_is_that_of_its_isentrope),
        cmocka_unit_test(a_material_that_would_be_colder_than_nothing_takes_more_volume),
        cmocka_unit_test(a_contact_of_two_materials_keeps_pressure_and_width),
        cmocka_unit_test(a_shared_cell_begins_with_one_pressure),
        cmocka_unit_test(rows_of_any_length_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
