/* Loads on surfaces and faces of outflow by the material point method. */
#include "exact/kingery_curves.h"
#include "populations.h"
#include "running.h"

#define MATERIALS                                                                            \
    "materials:\n"                                                                           \
    "  gas: {eos: {ideal-gas: {density: 1500 kg/m^3, gamma: 3}}}\n"                          \
    "  metal:\n"                                                                             \
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: " \
    "2.17, bulk_modulus: 73 GPa}}\n"                                                         \
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.3 GPa}}\n"

/* A fluid ball under pressure, within and without. */
static const char balanced[] =
    "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: mpm\n" MATERIALS "bodies:\n"
    "  drop: {material: gas, ball: {center: [0 mm, 0 mm], radius: 9.3 mm}, density: 1500 kg/m^3, "
    "pressure: 5 GPa}\n"
    "loads: {around: {on: drop, pressure: 5 GPa}}\n"
    "run: {until: 1 s}\n";

/* A block on a floor, pulled along its top for a while. */
static const char pulled[] =
    "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: mpm\n" MATERIALS "bodies:\n"
    "  block: {material: metal, box: {from: [0 mm, 0 mm], to: [20 mm, 10 mm]}}\n"
    "loads:\n"
    "  pull: {on: block, traction: [50 MPa, 20 MPa], axis: y, between: [6 mm, 14 mm], after: 0.1 "
    "us, before: 1 us}\n"
    "walls: {floor: {mirror: y, at: 0 mm, side: low}}\n"
    "run: {until: 1 s}\n";

/* A jet that leaves through two faces along a floor, and a load behind it. */
static const char leaving[] =
    "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: {mpm: {courant: 0.2}}\n" MATERIALS
    "bodies:\n"
    "  jet: {material: gas, box: {from: [0 mm, 0 mm], to: [20 mm, 10 mm]}, density: 1500 kg/m^3, "
    "pressure: 1 GPa, velocity: [2 km/s, 300 m/s]}\n"
    "loads: {behind: {on: jet, pressure: 1 GPa, between: [-5 mm, 10 mm]}}\n"
    "outflows:\n"
    "  right: {across: x, at: 19.5 mm, side: high}\n"
    "  above: {across: y, at: 10.2 mm, side: high, pressure: 0.5 GPa}\n"
    "walls: {floor: {mirror: y, at: 0 mm, side: low}}\n"
    "run: {until: 1 s}\n";

static const struct variant plain = {"plain", 1, 1.0, NULL, false};

/* Steps as the run loop has them: particles go between two. */
static void step_and_commit(struct running *run, int steps)
{
    for (int k = 0; k < steps; k++) {
        step(run, 1);
        if (particles_of(&run->simulation)->deleted)
            assert_success(particles_commit(particles_of(&run->simulation)));
    }
}

static void pressure_around_balances_pressure_within(void **state)
{
    (void)state;
    static const char *const settings[] = {"solver.mpm.shape=linear", "solver.mpm.shape=quadratic",
                                           "solver.mpm.shape=gimp"};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant variant = {"", 1, 1.0, settings[k], false};
        struct running *run = begin_fresh(balanced, &variant);
        const struct particles *p = particles_of(&run->simulation);
        step(run, 5);
        for (int32_t i = 0; i < p->count; i++)
            assert_near(fabs(p->velocity[i][0]) + fabs(p->velocity[i][1]), 0.0, 1e-8);
        end(run);
    }
}

static void check_kept(struct running *run, const struct totals *start)
{
    const struct totals now =
        population_totals(simulation_population(&run->simulation), &run->ranks, -1);
    const struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    for (int e = LEDGER_MASS; e <= LEDGER_MOMENTUM_Z; e++)
        assert_near(now.entry[e] - booked.entry[e], start->entry[e],
                    1e-13 * (e == LEDGER_MASS
                                 ? start->entry[LEDGER_MASS]
                                 : maximum(now.momentum_scale, start->momentum_scale)));
}

static void a_traction_gives_its_force_while_it_acts(void **state)
{
    (void)state;
    struct running *run = begin_fresh(pulled, &plain);
    const struct totals start =
        population_totals(simulation_population(&run->simulation), &run->ranks, -1);
    double acted = 0.0;
    while (run->simulation.time < 1.3e-6) {
        const double before = run->simulation.time;
        step(run, 1);
        acted += before >= 1e-7 && before < 1e-6 ? run->simulation.time - before : 0.0;
        check_kept(run, &start);
    }
    const struct totals loads = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_LOADS);
    assert_near(loads.entry[LEDGER_MOMENTUM_X], 50e6 * 0.02 * acted, 2e-3 * 50e6 * 0.02 * acted);
    assert_near(loads.entry[LEDGER_MOMENTUM_Y], 20e6 * 0.02 * acted, 2e-3 * 20e6 * 0.02 * acted);
    assert_true(loads.entry[LEDGER_ENERGY] > 0.0);
    end(run);
}

/* A block before a wall of symmetry, which a charge in that plane blasts from above. */
static const char blasted[] =
    "format: 1\ndimension: 2\nresolution: 5 mm\nsolver: mpm\n" MATERIALS "bodies:\n"
    "  block: {material: metal, box: {from: [0 m, 0 m], to: [0.1 m, 0.1 m]}}\n"
    "loads: {blast: {on: block, blast: {mass: 1 kg, at: [0 m, 1.1 m], time: -0.6 ms}}}\n"
    "walls: {middle: {mirror: x, at: 0 m, side: low}}\n"
    "run: {until: 1 s}\n";

/* The wave reaches the top 0.53 ms after the detonation, nearly face-on; sides and bottom face away
 * from the charge. Over some steps the pressure is that of the curve; the last form names the
 * surface. */
static void a_blast_pushes_the_surface_that_faces_it(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "solver.mpm.shape=linear", "solver.mpm.shape=quadratic", "solver.mpm.shape=gimp",
        "loads.blast={on: block, axis: y, side: high, between: [0.09 m, 0.12 m], blast: {mass: 1 "
        "kg, at: [0 m, 1.1 m], time: -0.6 ms}}"};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant variant = {"", 1, 1.0, settings[k], false};
        struct running *run = begin_fresh(blasted, &variant);
        const struct totals start =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        double wanted = 0.0;
        for (int n = 0; n < 10; n++) {
            const double before = run->simulation.time;
            step(run, 1);
            const double dt = run->simulation.time - before;
            for (int i = 0; i < 100; i++) { /* along the top */
                const double x = 0.1 * (i + 0.5) / 100.0, way = sqrt(1.0 + x * x);
                wanted -=
                    dt * 0.1 / 100.0 *
                    kingery_load(KINGERY_FREE_AIR, 1.0, way, 1.0 / way, before + 0.5 * dt + 0.6e-3);
            }
        }
        const struct totals loads =
            ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_LOADS);
        assert_near(loads.entry[LEDGER_MOMENTUM_Y], wanted, 0.002 * fabs(wanted));
        assert_near(loads.entry[LEDGER_MOMENTUM_X], 0.0, 1e-5 * fabs(wanted));
        check_kept(run, &start);
        end(run);
    }
}

/* A block that a pulse pulls, free in space. */
static const char pulse[] =
    "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: mpm\n" MATERIALS "bodies:\n"
    "  block: {material: metal, box: {from: [0 mm, 0 mm], to: [20 mm, 10 mm]}}\n"
    "loads:\n"
    "  pull: {on: block, traction: ['50 MPa*sin(pi*t/0.8 us)', 20 MPa], side: high, between: [10 "
    "mm, 40 mm], "
    "before: 0.8 us}\n"
    "run: {until: 1 s}\n";

/* Half a sine has the impulse 2 T t/pi; that of the steps, each with what its middle has, is booked
 * to rounding. */
static void a_load_follows_the_time(void **state)
{
    (void)state;
    const double area = 0.01, t = 0.8e-6, pi = acos(-1.0);
    struct running *run = begin_fresh(pulse, &plain);
    const struct totals start =
        population_totals(simulation_population(&run->simulation), &run->ranks, -1);
    double impulse = 0.0;
    while (run->simulation.time < t) {
        const double before = run->simulation.time;
        step_of(run, t - before);
        const double dt = run->simulation.time - before;
        impulse += dt * 50e6 * area * sin(pi * (before + 0.5 * dt) / t);
        check_kept(run, &start);
    }
    const struct totals loads = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_LOADS);
    assert_near(loads.entry[LEDGER_MOMENTUM_X], impulse, 2e-3 * impulse); /* of the surface */
    assert_near(loads.entry[LEDGER_MOMENTUM_Y] / loads.entry[LEDGER_MOMENTUM_X],
                20e6 * t / (50e6 * 2.0 * t / pi), 2e-3);
    assert_near(impulse, 50e6 * area * 2.0 * t / pi, 1e-2 * impulse);
    end(run);
}

static void a_load_that_is_not_finite_ends_the_run(void **state)
{
    (void)state;
    const struct variant variant = {"", 1, 1.0, "loads.pull.traction=[1 MPa*sqrt(1 - t/0.5 us), 0]",
                                    false};
    struct running *run = begin_fresh(pulse, &variant);
    struct error *error = NULL;
    while (!error) {
        assert_true(run->simulation.time < 0.8e-6);
        assert_success(run->solver->prepare(&run->sph, &run->simulation, &run->limit));
        error = run->solver->advance(&run->sph, &run->simulation, run->limit.dt);
        run->simulation.time += run->limit.dt;
    }
    assert_int_equal(error_kind(error), ERROR_STATE);
    assert_non_null(
        strstr(error_message(error, 0), "traction.1 of pull, \"(1000000 Pa)*sqrt(1 - t/"));
    assert_non_null(strstr(error_message(error, 0), "is not finite at t = "));
    error_free(error);
    end(run);
}

static void what_leaves_is_booked(void **state)
{
    (void)state;
    struct running *run = begin_fresh(leaving, &plain);
    const struct particles *p = particles_of(&run->simulation);
    const int32_t count = p->count;
    const struct totals start = population_totals(population_of_particles(p), &run->ranks, -1);
    for (int k = 0; k < 60; k++) {
        step_and_commit(run, 1);
        check_kept(run, &start);
    }
    assert_true(p->count < count - 20);
    for (int32_t i = 0; i < p->count; i++)
        assert_true(p->position[i][0] <= 0.0195 && p->position[i][1] <= 0.0102);
    end(run);
}

/* Of a stream faster than sound with the pressure about it, as much leaves as comes, and nothing
 * changes before the face. */
static void a_fast_stream_leaves_as_it_came(void **state)
{
    (void)state;
    static const char stream[] =
        "format: 1\ndimension: 1\nresolution: 1 mm\nsolver: {mpm: {gauge_pressure: 1 Pa}}\n"
        "materials: {gas: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}}\n"
        "bodies: {gas: {material: gas, box: {from: [0 m], to: [0.2 m]}, density: 1 kg/m^3, "
        "pressure: 1 Pa, velocity: [3 m/s]}}\n"
        "outflows: {right: {across: x, at: 0.2 m, side: high}}\n"
        "run: {until: 1 s}\n";
    struct running *run = begin_fresh(stream, &plain);
    const struct particles *p = particles_of(&run->simulation);
    while (run->simulation.time < 0.03)
        step_and_commit(run, 1);
    assert_near(0.001 * p->count, 0.2 - 3.0 * run->simulation.time, 0.0011);
    for (int32_t i = 0; i < p->count; i++) {
        assert_near(p->velocity[i][0], 3.0, 1e-12);
        assert_near(p->pressure[i], 1.0, 1e-12);
    }
    end(run);
}

/* A ball of gas on a floor that expands about the axis, and a ring of metal that it meets. */
static const char round_the_axis[] =
    "format: 1\ndimension: 2\ngeometry: axisymmetric\nresolution: 1 mm\nsolver: mpm\n" MATERIALS
    "bodies:\n"
    "  gas: {material: gas, box: {from: [0 mm, 0 mm], to: [8 mm, 8 mm]}, density: 1500 kg/m^3, "
    "pressure: 3 GPa, velocity: [200 m/s, 0 m/s]}\n"
    "  ring: {material: metal, box: {from: [12 mm, 0 mm], to: [16 mm, 10 mm]}, velocity: [-300 "
    "m/s, 0]}\n"
    "contacts: {face: {between: [gas, ring], shear: slip, tension: none}}\n"
    "walls: {floor: {mirror: y, at: 0 mm, side: low}}\n"
    "run: {until: 1 s}\n";

static void axis_and_hoop_stress_are_booked(void **state)
{
    (void)state;
    static const char *const settings[] = {"solver.mpm.shape=linear",    "solver.mpm.shape=gimp",
                                           "solver.mpm.shape=quadratic", "solver.mpm.shape=cubic",
                                           "solver.mpm.scheme=usf",      "solver.mpm.transfer=apic",
                                           "solver.mpm.flip=0.9",        "bodies.ring.stop=0.5 us"};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant variant = {"", 1, 1.0, settings[k], false};
        struct running *run = begin_fresh(round_the_axis, &variant);
        const struct totals start =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        for (int s = 0; s < 40; s++) {
            step(run, 1);
            check_kept(run, &start);
        }
        const bool held = strstr(settings[k], "stop"); /* it pushes walls too */
        const struct ledger *ledger = &run->simulation.ledger;
        const struct totals axis = ledger_totals(ledger, &run->ranks, LEDGER_AXIS),
                            walls = ledger_totals(ledger, &run->ranks, LEDGER_WALLS);
        assert_true(axis.entry[LEDGER_MOMENTUM_X] > 0.01 * start.momentum_scale);
        assert_near(walls.entry[LEDGER_MOMENTUM_X], 0.0,
                    held ? (double)INFINITY : 1e-15 * start.momentum_scale);
        assert_true(walls.entry[LEDGER_MOMENTUM_Y] > 0.0);
        end(run);
    }
}

/* A block between two floors that a pressure all around it squeezes: floors do no work. */
static const char squeezed[] =
    "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: mpm\n" MATERIALS "bodies:\n"
    "  block: {material: metal, box: {from: [0 mm, 0 mm], to: [20 mm, 10 mm]}}\n"
    "loads: {around: {on: block, pressure: 1 GPa*sin(pi*t/10 us)^2}}\n"
    "walls:\n"
    "  floor: {mirror: y, at: 0 mm, side: low}\n"
    "  side: {mirror: x, at: 0 mm, side: low}\n"
    "run: {until: 1 s}\n";

static void a_load_does_no_work_on_a_wall(void **state)
{
    (void)state;
    struct running *run = begin_fresh(squeezed, &plain);
    while (run->simulation.time < 5e-6) {
        step(run, 1);
        const struct totals now =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        const struct totals loads =
            ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_LOADS);
        assert_near(now.entry[LEDGER_ENERGY], loads.entry[LEDGER_ENERGY],
                    1e-10 * loads.entry[LEDGER_ENERGY]);
    }
    end(run);
}

/* Two loads that meet at an edge, where another block strikes the pushed one. */
static const char edged[] =
    "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: mpm\n" MATERIALS "bodies:\n"
    "  block: {material: metal, box: {from: [0 mm, 0 mm], to: [20 mm, 10 mm]}}\n"
    "  other: {material: metal, box: {from: [20 mm, 0 mm], to: [30 mm, 14 mm]}, velocity: [-100 "
    "m/s, 0]}\n"
    "contacts: {face: {between: [block, other], shear: slip, tension: none}}\n"
    "loads:\n"
    "  around: {on: block, pressure: 0.5 GPa}\n"
    "  above: {on: block, traction: [100 MPa, -400 MPa], axis: y, between: [6 mm, 14 mm]}\n"
    "run: {until: 1 s}\n";

/* The work of one is that along the velocity which all forces give, contact included. */
static void the_work_of_loads_that_meet_is_booked(void **state)
{
    (void)state;
    struct running *run = begin_fresh(edged, &plain);
    const struct totals start =
        population_totals(simulation_population(&run->simulation), &run->ranks, -1);
    for (int k = 0; k < 100; k++) {
        step(run, 1);
        const struct totals now =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        const struct totals loads =
            ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_LOADS);
        assert_near(now.entry[LEDGER_ENERGY] - loads.entry[LEDGER_ENERGY],
                    start.entry[LEDGER_ENERGY], 1e-13 * start.entry[LEDGER_ENERGY]);
    }
    assert_true(
        ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_LOADS).entry[LEDGER_ENERGY] !=
        0.0);
    end(run);
}

static uint64_t hash_of(const char *text, const struct variant *variant)
{
    struct running *run = begin_fresh(text, variant->resumed ? &plain : variant);
    step_and_commit(run, 30);
    if (variant->resumed)
        run = resume(run, text, variant);
    step_and_commit(run, 30);
    const uint64_t hash = particles_hash(particles_of(&run->simulation));
    end(run);
    return hash;
}

static void bits_do_not_depend_on_threads_storage_or_a_resume(void **state)
{
    (void)state;
    const char *const texts[] = {pulled, leaving, pulse, round_the_axis};
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        const struct variant others[] = {{"three threads", 3, 1.0, NULL, false},
                                         {"by turns", -3, 1.0, NULL, false},
                                         {"other storage", 2, 1.7, NULL, false},
                                         {"resumed", 1, 1.0, NULL, true}};
        const uint64_t hash = hash_of(texts[k], &plain);
        for (size_t v = 0; v < COUNT_OF(others); v++)
            assert_true(hash_of(texts[k], &others[v]) == hash);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pressure_around_balances_pressure_within),
        cmocka_unit_test(a_traction_gives_its_force_while_it_acts),
        cmocka_unit_test(a_blast_pushes_the_surface_that_faces_it),
        cmocka_unit_test(a_load_follows_the_time),
        cmocka_unit_test(a_load_that_is_not_finite_ends_the_run),
        cmocka_unit_test(a_load_does_no_work_on_a_wall),
        cmocka_unit_test(the_work_of_loads_that_meet_is_booked),
        cmocka_unit_test(what_leaves_is_booked),
        cmocka_unit_test(a_fast_stream_leaves_as_it_came),
        cmocka_unit_test(axis_and_hoop_stress_are_booked),
        cmocka_unit_test(bits_do_not_depend_on_threads_storage_or_a_resume),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
