/* Noble and Abel's stiffened gas: values worked out by hand, the ideal gas as a limit, and shocks.
 * */
#include "model/particles/fill.h"
#include "populations.h"
#include "running.h"
#include "source_folder.h"

#include "material/heat.h"
#include "riemann/shock_slope.h"

static const struct eos water = {EOS_noble_abel, {.noble_abel = EOS_noble_abel_SAMPLE}};
static const double none[POINT_HISTORY];

static void water_has_the_values_of_its_formulas(void **state)
{
    (void)state;
    /* At 1000 kg/m^3 and 350 K, with C_V = 3610 J/(kg K): v - b = 3.39e-4 m^3/kg, p + p_inf =
     * (gamma - 1) C_V T/(v - b), e = q + C_V T + p_inf (v - b), c^2 = gamma v^2 (p + p_inf)/(v -
     * b). */
    const struct heat heat = {3610.0, 0.6, 293.0};
    const double stiff = 0.19 * 3610.0 * 350.0 / 3.39e-4;
    const double energy = heat_energy(&heat, &water, 1000.0, 350.0);
    assert_near(energy, 323961.2, 1e-3);
    const struct eos_value value = eos_evaluate(&water, 1000.0, energy, none);
    assert_near(value.pressure, stiff - 7028e5, 1e-4);
    assert_near(value.pressure, 5.3563e6, 100.0);
    assert_true(value.status == 0);
    const struct response r = material_response(&value, 1000.0, 0.0, 0.0);
    assert_close(square(r.sound_long), 1.19 * 1e-6 * stiff / 3.39e-4, 1e-12);
    assert_close(heat_temperature(&heat, &water, 1000.0, energy), 350.0, 1e-13);
}

static void derivatives_are_those_of_the_pressure(void **state)
{
    (void)state;
    for (double density = 1.0; density < 1500.0; density *= 1.3)
        for (double energy = -1e6; energy < 1e7; energy += 1e6) {
            const double d = 1e-6 * density, de = 1.0;
            const struct eos_value value = eos_evaluate(&water, density, energy, none);
            const double by_density = (eos_evaluate(&water, density + d, energy, none).pressure -
                                       eos_evaluate(&water, density - d, energy, none).pressure) /
                                      (2.0 * d);
            const double by_energy = (eos_evaluate(&water, density, energy + de, none).pressure -
                                      eos_evaluate(&water, density, energy - de, none).pressure) /
                                     (2.0 * de);
            const double scale = fabs(value.pressure) + 1e9;
            if (!(value.status & POINT_SOUND_HELD))
                assert_near(by_density, value.dp_drho,
                            1e-6 * fabs(value.dp_drho) + 1e-9 * scale / density);
            assert_near(by_energy, value.dp_de, 1e-6 * value.dp_de + 1e-15 * scale);
        }
}

static void molecules_cannot_take_more_than_all_the_volume(void **state)
{
    (void)state;
    const struct eos_value value = eos_evaluate(&water, 1.0 / 6.61e-4, 1e6, none);
    assert_true(isfinite(value.pressure) && value.status == POINT_OUT_OF_RANGE);
    struct eos dense = water;
    const char *key = NULL;
    assert_null(eos_wrong(&dense, &key));
    dense.of.noble_abel.density = 1600.0;
    assert_non_null(eos_wrong(&dense, &key));
    assert_string_equal(key, "covolume");
}

static void without_covolume_and_stiffness_it_is_the_ideal_gas(void **state)
{
    (void)state;
    const struct material plain = {.eos = {EOS_ideal_gas, {.ideal_gas = {1.0, 1.3}}}};
    const struct material noble = {
        .eos = {EOS_noble_abel, {.noble_abel = {.density = 1.0, .gamma = 1.3}}}};
    struct dice dice = {1};
    for (int k = 0; k < 1000; k++) {
        struct point a = {.density = dice_between(&dice, 0.1, 100.0),
                          .energy = dice_between(&dice, 1e3, 1e9)};
        struct point b = a;
        const struct response ra = material_evaluate(&plain, &a),
                              rb = material_evaluate(&noble, &b);
        assert_true(a.pressure == b.pressure && ra.sound_long == rb.sound_long);
        assert_true(ra.dp_drho == rb.dp_drho && ra.dp_de == rb.dp_de);
        const struct heat heat = {718.0, 0.026, 293.0};
        assert_true(heat_temperature(&heat, &plain.eos, a.density, a.energy) ==
                    heat_temperature(&heat, &noble.eos, a.density, a.energy));
    }
    assert_true(riemann_shock_slope(&plain) == riemann_shock_slope(&noble));
    assert_true(eos_ratio_of_heats(&noble.eos) == 1.3);
}

/* Behind a shock into a gas of no pressure the density is that of the strong limit, v - b = (gamma
 * - 1)/(gamma + 1) (v_0 - b). */
static void strong_shocks_run_along_the_slope(void **state)
{
    (void)state;
    const struct eos_noble_abel gas = {1.2, 1.4, 1e-3, 0.0, 0.0};
    const struct material material = {.eos = eos_make_noble_abel(&gas)};
    const double rest = 1.0 / 1.2, particle = 5e3;
    const double volume = 1e-3 + 0.4 / 2.4 * (rest - 1e-3),
                 speed = particle / (1.0 - volume / rest);
    const double pressure = 1.2 * speed * particle, energy = 0.5 * pressure * (rest - volume);
    assert_close(eos_evaluate(&material.eos, 1.0 / volume, energy, none).pressure, pressure, 1e-13);
    assert_close(speed / particle, riemann_shock_slope(&material), 1e-13);
}

/* The hash of the blast wave at its end, with two settings. */
static uint64_t blast(const char *const settings[2], int count)
{
    struct case_options options = {.settings = settings, .setting_count = count};
    struct running *run = calloc(1, sizeof *run);
    run->ranks = ranks_alone();
    assert_success(case_read(blast_wave_case, &options, &bolide_catalogue, &run->input));
    assert_success(simulation_create(run->input, &run->ranks, 1, &run->simulation));
    run->solver = run->input->solver.choice->thing;
    assert_success(run->solver->create(&run->sph, &run->simulation, run->input->solver.value));
    assert_success(generate_particles(&run->simulation, particles_of(&run->simulation)));
    assert_success(run->solver->start(&run->sph, &run->simulation));
    const double until = run->input->run.until;
    while (run->simulation.time < until * (1.0 - 1e-12))
        step_of(run, until - run->simulation.time);
    const uint64_t hash = particles_hash(particles_of(&run->simulation));
    end(run);
    return hash;
}

static void the_blast_wave_of_ideal_gases_is_that_of_noble_and_abels(void **state)
{
    (void)state;
    static const char *const noble[2] = {
        "materials.hot.eos={noble-abel: {density: 1 kg/m^3, gamma: 1.3}}",
        "materials.cold.eos={noble-abel: {density: 1 kg/m^3, gamma: 1.4}}"};
    assert_true(blast(noble, 2) == blast(noble, 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(water_has_the_values_of_its_formulas),
        cmocka_unit_test(derivatives_are_those_of_the_pressure),
        cmocka_unit_test(molecules_cannot_take_more_than_all_the_volume),
        cmocka_unit_test(without_covolume_and_stiffness_it_is_the_ideal_gas),
        cmocka_unit_test(strong_shocks_run_along_the_slope),
        cmocka_unit_test(the_blast_wave_of_ideal_gases_is_that_of_noble_and_abels),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
