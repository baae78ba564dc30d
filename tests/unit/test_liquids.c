/* Sweeps along rows of cells of a liquid and a gas. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "ring.h"

static const double vapour = 2340.0, normal = 1e5, densities[2] = {1.0, 1000.0};

static struct eos of_water(void)
{
    static const struct eos_stiffened_gas water = EOS_stiffened_gas_SAMPLE;
    return eos_make_stiffened_gas(&water);
}

static struct eos of_dense_water(void)
{
    static const struct eos_noble_abel water = EOS_noble_abel_SAMPLE;
    return eos_make_noble_abel(&water);
}

/* Water in a quarter of a ring of air. */
static struct ring make_ring(struct eos water, double speed, double pressure)
{
    const struct eos_ideal_gas air = {1.0, 1.4};
    struct ring ring = {
        {eos_make_ideal_gas(&air), water}, true, {-(double)INFINITY, vapour}, speed, {{0.0}}};
    ring_fill(&ring, densities, pressure);
    return ring;
}

/* The pressure in cell C as sweeps have it. */
static double pressure_in(const struct ring *ring, int c)
{
    const struct eos *const eos[2] = {&ring->eos[0], &ring->eos[1]};
    const double density = ring->u[GAS_DENSITY][c], second = ring->u[GAS_NUMBERS + PART_MASS][c],
                 fraction = ring->u[GAS_NUMBERS + PART_FRACTION][c],
                 heat = ring->u[GAS_ENERGY][c] - 0.5 * square(ring->u[GAS_MOMENTUM][c]) / density,
                 whole[2] = {1.0, 1.0}, none[POINT_HISTORY] = {0.0};
    if (fraction <= 0.0 || fraction >= 1.0)
        return eos_evaluate(eos[fraction >= 1.0], density, heat / density, none).pressure;
    const double own[2] = {(density - second) / (1.0 - fraction), second / fraction};
    const struct mixture mixture = mixture_of(eos, own, fraction, whole);
    return mixture_pressure(&mixture, heat);
}

static void check_sums(const struct ring *ring, const struct ring *start)
{
    for (int n = 0; n < NUMBERS; n++) {
        const double all = ring_sum(start, n),
                     scale = n == GAS_MOMENTUM ? 1e6 : fabs(all); /* momentum may be none */
        if (n != GAS_NUMBERS + PART_FRACTION && !(fabs(ring_sum(ring, n) - all) <= 1e-12 * scale))
            fail_msg("number %d: %.17g, before %.17g", n, ring_sum(ring, n), all);
    }
}

/* 1000 : 1 at the pressure of the atmosphere, at rest and moving. */
static void a_surface_of_water_keeps_pressure_and_velocity(void **state)
{
    (void)state;
    static const double speeds[] = {0.0, 1.0, -30.0, 100.0};
    for (size_t s = 0; s < 2 * COUNT_OF(speeds); s++) {
        const struct eos water = s % 2 ? of_water() : of_dense_water();
        struct ring ring = make_ring(water, speeds[s / 2], normal);
        const struct ring start = ring;
        for (int step = 0; step < 1000; step++)
            ring_sweep(&ring, ROW_CELLS, 0.8 / (1600.0 + fabs(ring.speed)));
        for (int c = 0; c < CELLS; c++) {
            const double u = ring.u[GAS_MOMENTUM][c] / ring.u[GAS_DENSITY][c],
                         pressure = pressure_in(&ring, c);
            if (!(fabs(pressure / normal - 1.0) < 1e-10 &&
                  fabs(u - ring.speed) < 1e-10 * maximum(1.0, fabs(ring.speed))))
                fail_msg("cell %d of %zu: pressure less normal %.3g Pa, velocity less %g m/s %.3g",
                         c, s, pressure - normal, ring.speed, u - ring.speed);
        }
        check_sums(&ring, &start);
    }
}

/* Water whose halves fly apart opens bubbles, and closes them when it is pushed back. */
static void water_that_is_pulled_apart_keeps_its_energy(void **state)
{
    (void)state;
    struct ring ring = make_ring(of_water(), 0.0, normal);
    for (int c = 0; c < CELLS; c++)
        ring_put(&ring, c, densities, 1.0, normal, c < 100 ? -20.0 : 20.0);
    const struct ring start = ring;
    double least = normal, lightest = 1000.0;
    for (int step = 0; step < 400; step++) {
        ring_sweep(&ring, ROW_CELLS, 0.8 / 1700.0);
        for (int c = 0; c < CELLS; c++) {
            least = minimum(least, pressure_in(&ring, c));
            lightest = minimum(lightest, ring.u[GAS_DENSITY][c]);
            assert_true(isfinite(ring.u[GAS_ENERGY][c]) && ring.u[GAS_DENSITY][c] > 0.0);
        }
        check_sums(&ring, &start);
    }
    assert_true(least < -1e6); /* what the equation of state alone has */
    assert_true(lightest < 995.0);
}

/* The closure cuts pressures, and nothing is cut above the floor or in the gas. */
static void no_pressure_of_a_liquid_is_below_its_floor(void **state)
{
    (void)state;
    const struct ring ring = make_ring(of_water(), 0.0, normal);
    const struct gas_closure closure = {.eos = &ring.eos[0],
                                        .other = &ring.eos[1],
                                        .liquid = true,
                                        .floor = {ring.floor[0], ring.floor[1]}};
    struct dice dice = {11};
    for (int try = 0; try < 200; try++) {
        double density[ROW_ROOM], energy[ROW_ROOM], own[2][ROW_ROOM], fraction[ROW_ROOM];
        uint8_t kind[ROW_ROOM];
        struct row_values cut, free;
        FOR_ROW (k, 0, 9) {
            kind[k] = (uint8_t)(k % 3);
            own[0][k] = dice_between(&dice, 1e-4, 10.0);
            own[1][k] = dice_between(&dice, 600.0, 1200.0);
            fraction[k] = kind[k] == CONTENT_BOTH     ? dice_between(&dice, 1e-3, 0.999)
                          : kind[k] == CONTENT_SECOND ? 1.0
                                                      : 0.0;
            density[k] = (1.0 - fraction[k]) * own[0][k] + fraction[k] * own[1][k];
            energy[k] = kind[k] == CONTENT_FIRST ? dice_between(&dice, 10.0, 1e6)
                                                 : dice_between(&dice, -1e4, 1e5);
        }
        struct gas_content content = {.kind = kind,
                                      .own = {own[0], own[1]},
                                      .fraction = fraction,
                                      .least = -(double)INFINITY};
        struct gas_closure open = closure;
        open.liquid = false;
        gas_evaluate(&closure, &content, density, energy, 0, 9, &cut);
        gas_evaluate(&open, &content, density, energy, 0, 9, &free);
        FOR_ROW (k, 0, 9) {
            const bool gas = kind[k] == CONTENT_FIRST;
            const double expected = gas ? free.pressure[k] : maximum(free.pressure[k], vapour);
            assert_true(cut.pressure[k] == expected);
            assert_true(
                eos_sound_square(cut.pressure[k], cut.dp_drho[k], cut.dp_de[k], density[k]) > 0.0);
        }
    }
}

/* The liquid of a cell stretched by 2 % takes its own density again, and the gas the rest. */
static void bubbles_open_in_a_cell_that_would_pull(void **state)
{
    (void)state;
    const struct ring ring = make_ring(of_water(), 0.0, normal);
    const struct eos *const eos[2] = {&ring.eos[0], &ring.eos[1]};
    const double whole[2] = {1.0, 1.0};
    for (double fraction = 0.05; fraction < 0.999; fraction += 0.07) {
        const double stretched[2] = {0.98 * densities[0], 0.98 * densities[1]},
                     mass[2] = {(1.0 - fraction) * stretched[0], fraction * stretched[1]};
        const struct mixture before = mixture_of(eos, densities, fraction, whole),
                             pulled = mixture_of(eos, stretched, fraction, whole);
        const double energy = 0.98 * mixture_energy(&before, normal);
        assert_true(mixture_pressure(&pulled, energy) < 0.0);
        const double found = mixture_opened(eos, mass, fraction, energy, 1, vapour),
                     own[2] = {mass[0] / (1.0 - found), mass[1] / found};
        const struct mixture opened = mixture_of(eos, own, found, whole);
        assert_true(found < fraction && found > 0.97 * fraction);
        assert_close(mixture_pressure(&opened, energy), vapour, 1e-3);
        assert_close(own[1], densities[1], 1e-2); /* what gas loses heats it */
    }
}

static void rows_of_any_length_give_the_same_bits(void **state)
{
    (void)state;
    struct ring ring[2];
    for (int k = 0; k < 2; k++) {
        ring[k] = make_ring(of_water(), 30.0, normal);
        for (int c = 0; c < 30; c++) /* air that strikes the water */
            ring_put(&ring[k], c, (const double[2]){100.0, 1000.0}, 0.0, 5e7, 0.0);
        for (int step = 0; step < 300; step++)
            ring_sweep(&ring[k], k ? 7 : ROW_CELLS, 0.5 / 3000.0);
    }
    assert_memory_equal(ring[0].u, ring[1].u, sizeof ring[0].u);
    check_sums(&ring[0], &ring[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_surface_of_water_keeps_pressure_and_velocity),
        cmocka_unit_test(water_that_is_pulled_apart_keeps_its_energy),
        cmocka_unit_test(no_pressure_of_a_liquid_is_below_its_floor),
        cmocka_unit_test(bubbles_open_in_a_cell_that_would_pull),
        cmocka_unit_test(rows_of_any_length_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
