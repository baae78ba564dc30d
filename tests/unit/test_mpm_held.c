/* Bodies that something outside holds, by the material point method: pistons that are driven,
 * strikers that stop, ends that keep all of their state; and what the ledger says. */
#include "populations.h"
#include "running.h"

#define METAL                                                                                \
    "  metal:\n"                                                                             \
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: " \
    "2.17, bulk_modulus: 73 GPa}}\n"                                                         \
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.3 GPa}}\n"

static const char push[] =
    "format: 1\n"
    "dimension: 2\n"
    "resolution: 1 mm\n"
    "solver: {mpm: {cell: 2 mm}}\n"
    "materials:\n" METAL "bodies:\n"
    "  piston: {material: metal, box: {from: [-6 mm, 0 mm], to: [0 mm, 12 mm]}, "
    "velocity: [800 m/s, 30 m/s], driven: yes, stop: 1.5 us}\n"
    "  target: {material: metal, box: {from: [0 mm, 0 mm], to: [20 mm, 10 mm]}}\n"
    "  anvil: {material: metal, box: {from: [20 mm, 0 mm], to: [24 mm, 12 mm]}, stop: 0 s}\n"
    "walls:\n"
    "  below: {mirror: y, at: 0 mm, side: low}\n"
    "run: {until: 1 s}\n";

/* A frozen end, a striker that stops, and a contact law with a driven body. */
static const char mixed[] =
    "format: 1\n"
    "dimension: 2\n"
    "resolution: 1 mm\n"
    "solver: {mpm: {cell: 2 mm}}\n"
    "materials:\n" METAL "bodies:\n"
    "  striker: {material: metal, box: {from: [-7 mm, 0 mm], to: [0 mm, 12 mm]}, velocity: [300 "
    "m/s, 0 m/s], stop: 0.8 us}\n"
    "  target: {material: metal, box: {from: [0 mm, 0 mm], to: [20 mm, 10 mm]}}\n"
    "  end: {material: metal, box: {from: [20 mm, 0 mm], to: [25 mm, 10 mm]}, frozen: yes}\n"
    "  saw: {material: metal, box: {from: [0 mm, 10 mm], to: [20 mm, 15 mm]}, velocity: [-200 m/s, "
    "-60 m/s], driven: yes}\n"
    "contacts:\n"
    "  rub: {between: [saw, target], shear: slip, tension: none, friction: 0.3}\n"
    "walls:\n"
    "  below: {mirror: y, at: 0 mm, side: low}\n"
    "run: {until: 1 s}\n";

static const struct variant plain = {"plain", 1, 1.0, NULL, false};

static void assert_closed(const struct running *run, const struct totals *start)
{
    const struct particles *p = particles_of(&run->simulation);
    const struct totals now = population_totals(population_of_particles(p), &run->ranks, -1);
    const struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    for (int entry = LEDGER_MASS; entry <= LEDGER_MOMENTUM_Z; entry++)
        assert_near(now.entry[entry] - booked.entry[entry], start->entry[entry],
                    1e-13 * (entry == LEDGER_MASS ? 1.0 : start->momentum_scale));
}

static void a_piston_keeps_its_velocity_until_it_stops(void **state)
{
    (void)state;
    static const char *const settings[] = {"solver.mpm.scheme=musl", "solver.mpm.scheme=usf",
                                           "solver.mpm.scheme=usl", "solver.mpm.transfer=apic",
                                           "solver.mpm.shape=linear"};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant variant = {"", 1, 1.0, settings[k], false};
        struct running *run = begin_fresh(push, &variant);
        const struct totals start =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        while (run->simulation.time < 1.5e-6) {
            step_of(run, 1.5e-6 - run->simulation.time);
            assert_velocity(run, 0, 800.0, 30.0);
            assert_velocity(run, 2, 0.0, 0.0);
            assert_closed(run, &start);
        }
        const struct totals moving =
            ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_PISTONS);
        const struct totals piston =
            population_totals(simulation_population(&run->simulation), &run->ranks, 0);
        assert_true(moving.entry[LEDGER_ENERGY] > 0.0);
        step(run, 10);
        assert_velocity(run, 0, 0.0, 0.0);
        assert_closed(run, &start);
        const struct totals stopped =
            ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_PISTONS);
        assert_near(stopped.entry[LEDGER_ENERGY] - moving.entry[LEDGER_ENERGY], -piston.kinetic,
                    1e-9 * piston.kinetic);
        end(run);
    }
}

static void a_driven_body_moves_by_its_velocity(void **state)
{
    (void)state;
    struct running *run = begin_fresh(push, &plain);
    const struct particles *p = particles_of(&run->simulation);
    double from = 0.0, to = 0.0;
    int count = 0;
    for (int32_t i = 0; i < p->count; i++)
        from += p->body[i] == 0 ? p->position[i][0] : 0.0;
    step(run, 6); /* before it stops */
    for (int32_t i = 0; i < p->count; i++) {
        to += p->body[i] == 0 ? p->position[i][0] : 0.0;
        count += p->body[i] == 0;
    }
    assert_near((to - from) / count, 800.0 * run->simulation.time, 1e-12);
    end(run);
}

static void held_bodies_that_meet_do_not_strain_each_other(void **state)
{
    (void)state;
    static const char die[] =
        "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: mpm\n"
        "materials:\n" METAL "bodies:\n"
        "  die: {material: metal, box: {from: [0 mm, 0 mm], to: [12 mm, 4 mm]}, stop: 0 s}\n"
        "  piston: {material: metal, box: {from: [0 mm, 4 mm], to: [6 mm, 10 mm]}, driven: yes, "
        "velocity: [500 m/s, -100 m/s]}\n"
        "walls: {end: {mirror: x, at: 12 mm, side: high}}\n"
        "run: {until: 1 s}\n";
    struct running *run = begin_fresh(die, &plain);
    const struct particles *p = particles_of(&run->simulation);
    while (run->simulation.time < 20e-6) /* the piston has come to the wall */
        step(run, 1);
    for (int32_t i = 0; i < p->count; i++) {
        assert_true(p->density[i] == 2700.0 && p->energy[i] == 0.0);
        assert_true(p->position[i][0] <= 12e-3);
    }
    assert_velocity(run, 1, 500.0, -100.0);
    end(run);
}

static void frozen_bodies_keep_their_state(void **state)
{
    (void)state;
    struct running *run = begin_fresh(mixed, &plain);
    const struct particles *p = particles_of(&run->simulation);
    const struct totals start = population_totals(population_of_particles(p), &run->ranks, -1);
    for (int k = 0; k < 40; k++) {
        step_of(run, k == 39 ? 0.8e-6 : (double)INFINITY);
        assert_closed(run, &start);
    }
    assert_velocity(run, 2, 0.0, 0.0);
    assert_velocity(run, 3, -200.0, -60.0);
    for (int32_t i = 0; i < p->count; i++)
        if (p->body[i] == 2)
            assert_true(p->density[i] == 2700.0 && p->energy[i] == 0.0);
    end(run);
}

/* A pulse of 1 % of the speed of sound in a gas between two frozen ends. */
static void waves_run_out_of_frozen_ends(void **state)
{
    (void)state;
    static const char tube[] =
        "format: 1\ndimension: 1\nresolution: 2.5 mm\n"
        "solver: {mpm: {cell: 5 mm, gauge_pressure: 1 Pa, viscosity_quadratic: 0, "
        "viscosity_linear: 0}}\n"
        "materials: {gas: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}}\n"
        "bodies:\n"
        "  gas: {material: gas, pressure: 1 Pa, density: 1 kg/m^3, box: {from: [0 m], to: [1 m]}, "
        "velocity: [0.01 m/s*exp(-((x - 0.5 m)/(0.08 m))^2)]}\n"
        "  low: {material: gas, pressure: 1 Pa, density: 1 kg/m^3, frozen: yes, box: {from: [-2 "
        "cm], to: [0 m]}}\n"
        "  high: {material: gas, pressure: 1 Pa, density: 1 kg/m^3, frozen: yes, box: {from: [1 "
        "m], to: [1.02 m]}}\n"
        "run: {until: 1.5 s}\n";
    struct running *run = begin_fresh(tube, &plain);
    const struct totals start =
        population_totals(simulation_population(&run->simulation), &run->ranks, 0);
    while (run->simulation.time < 1.5)
        step(run, 1);
    const struct totals now =
        population_totals(simulation_population(&run->simulation), &run->ranks, 0);
    assert_true(now.kinetic < 3e-5 * start.kinetic);
    end(run);
}

static void bits_do_not_depend_on_threads_storage_or_a_resume(void **state)
{
    (void)state;
    const char *const texts[] = {push, mixed};
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        const struct variant others[] = {{"three threads", 3, 1.0, NULL, false},
                                         {"other storage", 2, 1.7, NULL, false},
                                         {"resumed", 1, 1.0, NULL, true}};
        const uint64_t hash = hash_after(texts[k], &plain, &plain, 60);
        for (size_t v = 0; v < COUNT_OF(others); v++)
            assert_true(hash_after(texts[k], &plain, &others[v], 60) == hash);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_piston_keeps_its_velocity_until_it_stops),
        cmocka_unit_test(a_driven_body_moves_by_its_velocity),
        cmocka_unit_test(held_bodies_that_meet_do_not_strain_each_other),
        cmocka_unit_test(frozen_bodies_keep_their_state),
        cmocka_unit_test(waves_run_out_of_frozen_ends),
        cmocka_unit_test(bits_do_not_depend_on_threads_storage_or_a_resume),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
