/* The same bits for any number of threads, order of storage, skin, age of rows, and after a resume:
 * one hash of the state after many steps. And what the steps must keep: mass, momentum and
 * energy. */
#include "populations.h"
#include "running.h"

#if defined(BOLIDE_SANITIZE)
enum { STEPS = 30, STRIDE = 2 }; /* every other variant */
#else
enum { STEPS = 60, STRIDE = 1 };
#endif

/* A block strikes another, faces that slip and do not stick, in a corner of mirrors; an inclusion
 * adheres. */
#define BLOCKS(floor)                                                                              \
    "materials:\n"                                                                                 \
    "  aluminium:\n"                                                                               \
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: 2.17, " \
    "bulk_modulus: 73 GPa}}\n"                                                                     \
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.4 GPa}}\n"                   \
    "  steel:\n"                                                                                   \
    "    eos: {barotropic: {density: 7900 kg/m^3, bulk_modulus: 176 GPa}}\n"                       \
    "    strength: {perfect-plastic: {shear_modulus: 83 GPa, yield: 0.5 GPa}}\n"                   \
    "bodies:\n"                                                                                    \
    "  striker: {material: steel, box: {from: [-24 mm, 3 mm], to: [0 mm, 33 mm]}, "                \
    "velocity: [900 m/s, -300 m/s]}\n"                                                             \
    "  target: {material: aluminium, box: {from: [0 mm, 0 mm], to: [30 mm, 45 mm]}, "              \
    "velocity: [0 m/s, 100 m/s]}\n"                                                                \
    "  grain: {material: steel, ball: {center: [14 mm, 20 mm], radius: 5 mm}, replaces: target}\n" \
    "contacts:\n"                                                                                  \
    "  faces: {between: [striker, target], shear: slip, tension: none}\n"                          \
    "walls:\n"                                                                                     \
    "  floor: {mirror: y, at: " floor ", side: low}\n"                                             \
    "  back: {mirror: x, at: 31 mm, side: high}\n"                                                 \
    "run: {until: 1 s}\n"
static const char plane_case[] =
    "format: 1\ntitle: Two blocks in a corner\ndimension: 2\nresolution: 1 mm\n"
    "solver: {sph: {method: contact, smoothing: 1.2}}\n" BLOCKS("-1 mm");

/* The same as thin plates, with spins. */
static const char thin_case[] =
    "format: 1\ntitle: Two plates in a corner\ndimension: 2\nresolution: 1 mm\n"
    "geometry: plane-stress\n"
    "solver: {sph: {method: {contact: {rotation: corrected}}, smoothing: 1.2}}\n" BLOCKS("-0.2 mm");

/* A driven rod with a hot gas before it runs into a target on the axis, and stops. */
static const char round_case[] =
    "format: 1\n"
    "title: A rod strikes along the axis\n"
    "dimension: 2\n"
    "geometry: axisymmetric\n"
    "resolution: 1 mm\n"
    "solver: {sph: {method: {contact: {rotation: corrected}}, smoothing: 1.2}}\n"
    "materials:\n"
    "  gas: {eos: {ideal-gas: {density: 1500 kg/m^3, gamma: 3}}}\n"
    "  aluminium:\n"
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: 2.17, "
    "bulk_modulus: 73 GPa}}\n"
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.4 GPa}}\n"
    "bodies:\n"
    "  rod: {material: aluminium, box: {from: [0 mm, -20 mm], to: [7 mm, -5 mm]}, "
    "velocity: [0 m/s, 900 m/s], driven: yes, stop: 0.4 us}\n"
    "  charge: {material: gas, box: {from: [0 mm, -5 mm], to: [7 mm, 0 mm]}, "
    "density: 1500 kg/m^3, pressure: 5 GPa}\n"
    "  target: {material: aluminium, box: {from: [0 mm, 0 mm], to: [25 mm, 12 mm]}}\n"
    "contacts:\n"
    "  faces: {between: [rod, target], shear: slip, tension: none}\n"
    "walls:\n"
    "  behind: {mirror: y, at: 13 mm, side: high}\n"
    "run: {until: 1 s}\n";

/* A hot gas throws a plate through a channel. */
static const char space_case[] =
    "format: 1\n"
    "title: A gas drives a plate\n"
    "dimension: 3\n"
    "resolution: 1 mm\n"
    "solver: {sph: {method: contact, smoothing: 1.0}}\n"
    "materials:\n"
    "  gas: {eos: {ideal-gas: {density: 1500 kg/m^3, gamma: 3}}}\n"
    "  aluminium:\n"
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: 2.17, "
    "bulk_modulus: 73 GPa}}\n"
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.4 GPa}}\n"
    "bodies:\n"
    "  charge: {material: gas, box: {from: [-12 mm, 0 mm, 0 mm], to: [0 mm, 10 mm, 10 mm]}, "
    "density: 1500 kg/m^3, pressure: 15 GPa}\n"
    "  plate: {material: aluminium, box: {from: [0 mm, 1 mm, 1 mm], to: [8 mm, 10 mm, 10 mm]}, "
    "velocity: [-200 m/s, 50 m/s, 0 m/s]}\n"
    "walls:\n"
    "  left: {mirror: x, at: -12 mm, side: low}\n"
    "  below: {mirror: y, at: 0 mm, side: low}\n"
    "  behind: {mirror: z, at: 0 mm, side: low}\n"
    "  before: {mirror: z, at: 10 mm, side: high}\n"
    "run: {until: 1 s}\n";

static const struct variant base = {"base", 1, 1.0, NULL, false};
static const struct variant variants[] = {
    {"2 threads", 2, 1.0, NULL, false},
    {"3 threads", 3, 1.0, NULL, false},
    {"4 threads", 4, 1.0, NULL, false},
    {"3, 2 and 1 threads by turns", -3, 1.0, NULL, false},
    {"small cells", 1, 0.37, NULL, false},
    {"large cells", 2, 3.0, NULL, false},
    {"thin skin", 1, 1.0, "solver.sph.skin=0.02", false},
    {"other skin", 1, 1.0, "solver.sph.skin=0.15", false},
    {"thick skin", 1, 1.0, "solver.sph.skin=0.6", false},
    {"rows of every step", 1, 1.0, "solver.sph.rebuild=1", false},
    {"rows of 20 steps", 1, 1.0, "solver.sph.rebuild=20", false},
    {"resumed", 1, 1.0, NULL, true},
    {"resumed, other cells and threads", 2, 1.7, NULL, true},
};

/* What must be alike at the end of all variants. */
struct outcome {
    uint64_t hash;
    double time;
    struct totals walls;
};

static struct outcome outcome_of(const char *text, const struct variant *variant, int64_t *builds)
{
    struct running *run = begin_fresh(text, variant->resumed ? &base : variant);
    step(run, STEPS / 2);
    if (variant->resumed)
        run = resume(run, text, variant);
    step(run, STEPS - STEPS / 2);
    struct outcome outcome;
    memset(&outcome, 0, sizeof outcome); /* compared as bytes */
    outcome.hash = particles_hash(particles_of(&run->simulation));
    outcome.time = run->simulation.time;
    outcome.walls = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    *builds = run->sph.neighbours.builds;
    end(run);
    return outcome;
}

static void judge(const char *text)
{
    int64_t builds;
    struct outcome wanted = outcome_of(text, &base, &builds);
    print_message("%016llx after %d steps, rows built %d times\n", (unsigned long long)wanted.hash,
                  STEPS, (int)builds);
    assert_true(wanted.walls.entry[LEDGER_MOMENTUM_X] != 0.0 ||
                wanted.walls.entry[LEDGER_MOMENTUM_Y] != 0.0);
    for (size_t k = 0; k < COUNT_OF(variants); k += STRIDE) {
        struct outcome outcome = outcome_of(text, &variants[k], &builds);
        if (memcmp(&outcome, &wanted, sizeof outcome) != 0)
            print_error("%s: %016llx, rows built %d times\n", variants[k].name,
                        (unsigned long long)outcome.hash, (int)builds);
        assert_memory_equal(&outcome, &wanted, sizeof outcome);
    }
}

static void two_solids_in_the_plane_have_one_hash(void **state)
{
    (void)state;
    judge(plane_case);
}

static void two_thin_plates_that_turn_have_one_hash(void **state)
{
    (void)state;
    judge(thin_case);
}

static void a_driven_rod_on_the_axis_has_one_hash(void **state)
{
    (void)state;
    judge(round_case);
}

static void a_gas_and_a_solid_in_space_have_one_hash(void **state)
{
    (void)state;
    judge(space_case);
}

/* The method that needs a pass of its own for its viscosity. */
static void the_standard_method_has_one_hash(void **state)
{
    (void)state;
    static const struct variant standard[] = {
        {"standard", 1, 1.0, "solver.sph.method=standard", false},
        {"standard, 3 threads, large cells", 3, 3.0, "solver.sph.method=standard", false}};
    int64_t builds;
    struct outcome one = outcome_of(plane_case, &standard[0], &builds);
    struct outcome other = outcome_of(plane_case, &standard[1], &builds);
    assert_memory_equal(&one, &other, sizeof one);
    struct outcome contact = outcome_of(plane_case, &base, &builds);
    assert_true(one.hash != contact.hash);
}

static void mass_momentum_and_energy_are_kept(void **state)
{
    (void)state;
    const char *const texts[] = {plane_case, thin_case, round_case, space_case};
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        struct running *run = begin_fresh(texts[k], &base);
        const struct particles *p = particles_of(&run->simulation);
        struct totals start = population_totals(population_of_particles(p), &run->ranks, -1);
        step(run, STEPS);
        struct totals now = population_totals(population_of_particles(p), &run->ranks, -1);
        struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
        double drift[LEDGER_ENTRIES];
        for (int entry = 0; entry < LEDGER_ENTRIES; entry++)
            drift[entry] = now.entry[entry] - booked.entry[entry] - start.entry[entry];
        print_message("%d-D: %d particles, drift of energy %.2g, of momentum %.2g %.2g %.2g\n",
                      p->dimension, p->count, drift[LEDGER_ENERGY] / start.entry[LEDGER_ENERGY],
                      drift[LEDGER_MOMENTUM_X] / now.momentum_scale,
                      drift[LEDGER_MOMENTUM_Y] / now.momentum_scale,
                      drift[LEDGER_MOMENTUM_Z] / now.momentum_scale);
        assert_true(drift[LEDGER_MASS] == 0.0);
        assert_near(drift[LEDGER_ENERGY], 0.0, 1e-13 * start.entry[LEDGER_ENERGY]);
        for (int axis = 0; axis < 3; axis++)
            assert_near(drift[LEDGER_MOMENTUM_X + axis], 0.0, 1e-13 * now.momentum_scale);
        assert_true(booked.entry[LEDGER_MOMENTUM_X] != 0.0 ||
                    booked.entry[LEDGER_MOMENTUM_Y] != 0.0);
        assert_true(now.kinetic != start.kinetic);
        end(run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_solids_in_the_plane_have_one_hash),
        cmocka_unit_test(two_thin_plates_that_turn_have_one_hash),
        cmocka_unit_test(a_driven_rod_on_the_axis_has_one_hash),
        cmocka_unit_test(a_gas_and_a_solid_in_space_have_one_hash),
        cmocka_unit_test(the_standard_method_has_one_hash),
        cmocka_unit_test(mass_momentum_and_energy_are_kept),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
