/* Conduction as a part of the solver: the step that it allows, particles that stand still, one hash
 * for all orders and after a resume, energy that is kept, a cylinder that cools about its axis, and
 * what a case without the constants is told. */
#include "material/material.h"
#include "populations.h"
#include "running.h"

#include "run/estimate.h"

#define MATERIALS                                                                                  \
    "materials:\n"                                                                                 \
    "  aluminium:\n"                                                                               \
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: 2.17, " \
    "bulk_modulus: 73 GPa}}\n"                                                                     \
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.4 GPa}}\n"                   \
    "    heat: {capacity: 880 J/(kg*K), conductivity: 200 W/(m*K)}\n"                              \
    "  steel:\n"                                                                                   \
    "    eos: {barotropic: {density: 7900 kg/m^3, bulk_modulus: 176 GPa}}\n"                       \
    "    strength: {perfect-plastic: {shear_modulus: 83 GPa, yield: 0.5 GPa}}\n"                   \
    "    heat: {capacity: 460 J/(kg*K), conductivity: 50 W/(m*K)}\n"

/* So small that heat limits the step. */
static const char strike[] =
    "format: 1\n"
    "title: A hot block strikes a cold one\n"
    "dimension: 2\n"
    "resolution: 2 nm\n"
    "solver: {sph: {method: contact, smoothing: 1.2, conduction: contact}}\n" MATERIALS "bodies:\n"
    "  striker: {material: steel, box: {from: [-48 nm, 6 nm], to: [0 nm, 66 nm]}, "
    "velocity: [900 m/s, -300 m/s], temperature: 900 K}\n"
    "  target: {material: aluminium, box: {from: [0 nm, 0 nm], to: [60 nm, 90 nm]}}\n"
    "walls:\n"
    "  floor: {mirror: y, at: -0.4 nm, side: low}\n"
    "  back: {mirror: x, at: 62 nm, side: high}\n"
    "run: {until: 1 s}\n";

/* Cylinders about the y axis, all at rest. */
static const char cylinder[] =
    "format: 1\n"
    "dimension: 2\n"
    "geometry: axisymmetric\n"
    "resolution: 1 mm\n"
    "solver: {sph: {method: {contact: {motion: none}}, conduction: contact}}\n" MATERIALS
    "bodies:\n"
    "  rod: {material: aluminium, box: {from: [0 mm, 0 mm], to: [40 mm, 6 mm]}}\n"
    "walls:\n"
    "  below: {mirror: y, at: 0 mm, side: low}\n"
    "  above: {mirror: y, at: 6 mm, side: high}\n"
    "run: {until: 1 s}\n";

static const struct variant plain = {"plain", 1, 1.0, NULL, false};

static void heat_and_motion_have_one_hash(void **state)
{
    (void)state;
    static const struct variant variants[] = {
        {"3 threads, small cells", 3, 0.37, NULL, false},
        {"thick skin", 1, 1.0, "solver.sph.skin=0.6", false},
        {"rows of every step", 2, 1.0, "solver.sph.rebuild=1", false},
        {"resumed, other cells and threads", 2, 1.7, NULL, true}};
    const char *const texts[] = {strike, cylinder};
    for (int k = 0; k < 2; k++) {
        uint64_t wanted = hash_after(texts[k], &plain, &plain, 60);
        for (size_t v = 0; v < COUNT_OF(variants); v++)
            if (hash_after(texts[k], &plain, &variants[v], 60) != wanted)
                fail_msg("%s", variants[v].name);
    }
}

static void energy_is_kept_in_every_geometry(void **state)
{
    (void)state;
    static const struct variant variants[] = {
        {"plane strain", 1, 1.0, NULL, false},
        {"harmonic", 1, 1.0, "solver.sph.conduction=harmonic", false},
        {"plane stress", 1, 1.0, "geometry=plane-stress", false},
        {"rate of energy", 1, 1.0, "solver.sph.method.contact.motion=contact", false}};
    for (size_t v = 0; v < COUNT_OF(variants); v++) {
        struct running *run = begin_fresh(strike, &variants[v]);
        const struct particles *p = particles_of(&run->simulation);
        double start =
            population_totals(population_of_particles(p), &run->ranks, -1).entry[LEDGER_ENERGY];
        step(run, 60);
        double now =
            population_totals(population_of_particles(p), &run->ranks, -1).entry[LEDGER_ENERGY];
        double booked =
            ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES).entry[LEDGER_ENERGY];
        assert_near(now - booked, start, 1e-13 * start);
        end(run);
    }
}

static void the_step_is_the_smaller_of_two(void **state)
{
    (void)state;
    struct running *run = begin_fresh(strike, &plain);
    assert_success(run->solver->prepare(&run->sph, &run->simulation, &run->limit));
    double diffusivity = 200.0 / (2700.0 * 880.0), h = 1.2 * 2e-9;
    assert_string_equal(run->limit.why, "conduction");
    assert_close(run->limit.dt, 0.2 * square(h) / diffusivity, 1e-12);
    end(run);
    static const struct variant other = {"other", 1, 1.0, "solver.sph.conduction_limit=0.9", false};
    run = begin_fresh(strike, &other);
    assert_success(run->solver->prepare(&run->sph, &run->simulation, &run->limit));
    assert_close(run->limit.dt, 0.9 * square(h) / diffusivity, 1e-12);
    end(run);
    static const struct variant wide = {"wide", 1, 1.0, "resolution=6nm", false};
    run = begin_fresh(strike, &wide);
    step(run, 1);
    double small = run->limit.dt;
    end(run);
    static const struct variant without = {"without", 1, 1.0, "solver.sph.conduction=none", false};
    run = begin_fresh(strike, &without);
    step(run, 1);
    assert_string_equal(run->limit.why, "sound speed");
    assert_true(small > run->limit.dt);
    assert_null(run->sph.conduction.record);
    end(run);
}

/* The slowest mode of an insulated cylinder, J_0(j r/R) with J_1(j) = 0, falls by exp(-a j^2
 * t/R^2). */
static void a_cylinder_cools_about_its_axis(void **state)
{
    (void)state;
    const double j = 3.83170597020751, radius = 0.04, diffusivity = 200.0 / (2700.0 * 880.0);
    struct running *run = begin_fresh(cylinder, &plain);
    struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++)
        p->energy[i] = 880.0 * (100.0 + 50.0 * j0(j * p->position[i][0] / radius));
    double start =
        population_totals(population_of_particles(p), &run->ranks, -1).entry[LEDGER_ENERGY];
    double end_time = square(radius / j) / diffusivity;
    while (run->simulation.time < end_time)
        step_of(run, end_time - run->simulation.time);
    double now =
        population_totals(population_of_particles(p), &run->ranks, -1).entry[LEDGER_ENERGY];
    assert_near(now, start, 1e-13 * start);
    for (int32_t i = 0; i < p->count; i++) {
        double mode = j0(j * p->position[i][0] / radius);
        double temperature = heat_temperature(&run->simulation.problem->material[0].heat,
                                              &run->simulation.problem->material[0].eos,
                                              p->density[i], p->energy[i]);
        assert_near(temperature, 393.0 + 50.0 * exp(-1.0) * mode, 0.5);
        assert_true(p->velocity[i][0] == 0.0 && p->density[i] == 2700.0);
    }
    end(run);
}

static void what_conduction_lacks_is_told(void **state)
{
    (void)state;
    static const struct {
        const char *setting, *place, *words;
    } mistakes[] = {
        {"materials.steel.heat={capacity: 460 J/(kg*K)}", "materials.steel", "conductivity"},
        {"materials.steel.heat={conductivity: 50 W/(m*K)}", "materials.steel", "capacity"},
        {"solver.sph={method: {contact: {motion: none}}}", "solver.sph.method.contact.motion",
         "unless heat is conducted"},
        {"checks={hot: {l1: temperature, at_most: 1, against: {gas-riemann: {left: {density: 1 "
         "kg/m^3, pressure: 1 Pa, gamma: 3}, right: {density: 1 kg/m^3, pressure: 1 Pa, gamma: "
         "3}}}}}",
         "checks.hot", "has no temperature"}};
    for (size_t k = 0; k < COUNT_OF(mistakes); k++) {
        struct variant variant = {"mistake", 1, 1.0, mistakes[k].setting, false};
        char path[96];
        snprintf(path, sizeof path, "%s/mistake.yaml", folder);
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        assert_true(fputs(cylinder, file) >= 0);
        assert_int_equal(fclose(file), 0);
        struct case_options options = {.settings = &variant.setting, .setting_count = 1};
        struct simulation_case *input;
        assert_success(case_read(path, &options, &bolide_catalogue, &input));
        struct estimate estimate;
        struct error *error = estimate_run(input, &estimate);
        assert_non_null(error);
        assert_int_equal(error_kind(error), ERROR_INPUT);
        if (!strstr(error_message(error, 0), mistakes[k].place) ||
            !strstr(error_message(error, 0), mistakes[k].words))
            fail_msg("%s", error_message(error, 0));
        error_free(error);
        case_free(input);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heat_and_motion_have_one_hash),
        cmocka_unit_test(energy_is_kept_in_every_geometry),
        cmocka_unit_test(the_step_is_the_smaller_of_two),
        cmocka_unit_test(a_cylinder_cools_about_its_axis),
        cmocka_unit_test(what_conduction_lacks_is_told),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
