/* What frozen ends do by the second-order contact method: waves run out of them, whatever the
 * pressure of the matter at rest; nothing happens without waves; and the ledger has what they
 * take. */
#include "populations.h"
#include "second_order.h"

#define GAS                                                                   \
    "materials: {gas: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}}\n" \
    "run: {until: 2 s}\n"
#define REST "material: gas, pressure: 1 Pa, density: 1 kg/m^3"

/* A pulse that carries the particles at the ends by a fifth of their distance. */
static const char tube[] =
    "format: 1\ndimension: 1\nresolution: 5 mm\nsolver: {sph: {method: muscl}}\n" GAS "bodies:\n"
    "  gas: {" REST ", velocity: [0.01 m/s*exp(-((x - 0.5 m)/(0.08 m))^2)], box: {from: [0 m], to: "
    "[1 m]}}\n"
    "  low: {" REST ", frozen: yes, box: {from: [-2 cm], to: [0 m]}}\n"
    "  high: {" REST ", frozen: yes, box: {from: [1 m], to: [1.02 m]}}\n";

/* A corner of frozen gas, MOTION in front of it. */
#define CORNER(motion)                                                                            \
    "format: 1\ndimension: 2\nresolution: 2.5 cm\nsolver: {sph: {method: muscl, smoothing: "      \
    "1.2}}\n" GAS "bodies:\n"                                                                     \
    "  gas: {" REST motion ", box: {from: [0 m, 0 m], to: [0.5 m, 0.5 m]}}\n"                     \
    "  end: {" REST ", frozen: yes, difference: [{box: {from: [0 m, 0 m], to: [0.6 m, 0.6 m]}}, " \
    "{box: {from: [0 m, 0 m], to: [0.5 m, 0.5 m]}}]}\n"                                           \
    "walls:\n"                                                                                    \
    "  left: {mirror: x, at: 0 m, side: low}\n"                                                   \
    "  below: {mirror: y, at: 0 m, side: low}\n"

static const char still[] = CORNER("");
static const char moved[] =
    CORNER(", velocity: [\"0.05 m/s*sin(6*x/(1 m))\", \"0.05 m/s*sin(6*y/(1 m))\"]");

static void a_pulse_runs_out_of_a_gas_under_pressure(void **state)
{
    (void)state;
    struct running *run = begin_fresh(tube, &plain);
    const struct totals start =
        population_totals(simulation_population(&run->simulation), &run->ranks, 0);
    while (run->simulation.time < 0.9)
        step(run, 1);
    const struct totals now =
        population_totals(simulation_population(&run->simulation), &run->ranks, 0);
    assert_true(now.kinetic < 1e-5 * start.kinetic);
    end(run);
}

static void matter_at_rest_stays_at_rest(void **state)
{
    (void)state;
    struct running *run = begin_fresh(still, &plain);
    const struct particles *p = particles_of(&run->simulation);
    step(run, 20);
    for (int32_t i = 0; i < p->count; i++)
        for (int axis = 0; axis < 2; axis++)
            assert_near(p->velocity[i][axis], 0.0, 1e-13);
    end(run);
}

static void what_frozen_ends_take_stands_in_the_ledger(void **state)
{
    (void)state;
    struct running *run = begin_fresh(moved, &plain);
    const struct totals start =
        population_totals(simulation_population(&run->simulation), &run->ranks, -1);
    step(run, 60);
    const struct totals now =
        population_totals(simulation_population(&run->simulation), &run->ranks, -1);
    const struct totals taken = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    for (int entry = LEDGER_MASS; entry <= LEDGER_MOMENTUM_Z; entry++)
        assert_near(now.entry[entry] - taken.entry[entry], start.entry[entry], 1e-14);
    assert_close(now.entry[LEDGER_ENERGY] - taken.entry[LEDGER_ENERGY], start.entry[LEDGER_ENERGY],
                 1e-14);
    assert_true(fabs(taken.entry[LEDGER_MOMENTUM_X]) > 1e-3);
    end(run);
}

static void bits_do_not_depend_on_threads_storage_or_a_resume(void **state)
{
    (void)state;
    const struct variant others[] = {{"three threads", 3, 1.0, NULL, false},
                                     {"other storage", 2, 1.7, NULL, false},
                                     {"another skin", 1, 1.0, "solver.sph.skin=0.5", false},
                                     {"resumed", 1, 1.0, NULL, true}};
    const uint64_t hash = hash_after(moved, &plain, &plain, 40);
    for (size_t v = 0; v < COUNT_OF(others); v++)
        assert_true(hash_after(moved, &plain, &others[v], 40) == hash);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pulse_runs_out_of_a_gas_under_pressure),
        cmocka_unit_test(matter_at_rest_stays_at_rest),
        cmocka_unit_test(what_frozen_ends_take_stands_in_the_ledger),
        cmocka_unit_test(bits_do_not_depend_on_threads_storage_or_a_resume),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
