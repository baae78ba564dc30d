/* Gravity by both solvers: free fall, and what the ledger says of it. */
#include "populations.h"
#include "running.h"

#define MATERIALS                                                                            \
    "materials:\n"                                                                           \
    "  metal:\n"                                                                             \
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: " \
    "2.17, bulk_modulus: 73 GPa}}\n"                                                         \
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.3 GPa}}\n"

/* As of a centrifuge, so that a few steps show it. */
static const char falling[] =
    "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: mpm\n" MATERIALS "bodies:\n"
    "  stone: {material: metal, box: {from: [3 mm, 2 mm], to: [11 mm, 9 mm]}, velocity: [40 m/s, "
    "90 m/s]}\n"
    "gravity: [3e6 m/s^2, -5e7 m/s^2]\n"
    "run: {until: 1 s}\n";

static const char landing[] =
    "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: mpm\n" MATERIALS "bodies:\n"
    "  stone: {material: metal, box: {from: [4 mm, 0 mm], to: [10 mm, 6 mm]}, velocity: [40 m/s, "
    "-90 m/s]}\n"
    "gravity: [0 m/s^2, -5e7 m/s^2]\n"
    "walls:\n  floor: {mirror: y, at: 0 mm, side: low}\n"
    "run: {until: 1 s}\n";

static const struct variant by_mpm = {"mpm", 1, 1.0, NULL, false};
static const struct variant by_affine = {"apic", 1, 1.0, "solver.mpm.transfer=apic", false};
static const struct variant by_usf = {"usf", 1, 1.0, "solver.mpm.scheme=usf", false};
static const struct variant by_linear = {"linear", 1, 1.0, "solver.mpm.shape=linear", false};
static const struct variant by_sph = {"second order", 1, 1.0, "solver=sph", false};
static const struct variant by_contact = {"contact", 1, 1.0, "solver={sph: {method: contact}}",
                                          false};
static const struct variant by_heun = {"hllc", 1, 1.0, "solver={sph: {method: hllc}}", false};

/* Steps of one length: MPM moves with the velocity at their end, SPH with their mean. */
static void check_fall(const struct variant *variant, double part)
{
    enum { FALL = 12 };
    const double dt = 2e-8, t = FALL * dt, u[2] = {40.0, 90.0}, g[2] = {3e6, -5e7};
    struct running *run = begin_fresh(falling, variant);
    struct particles *p = particles_of(&run->simulation);
    const struct totals start = population_totals(population_of_particles(p), &run->ranks, -1);
    struct vec3 before = {0}, after = {0};
    for (int32_t i = 0; i < p->count; i++)
        before = vec3_add(before, vec3_make(p->position[i][0], p->position[i][1], 0.0));
    for (int k = 0; k < FALL; k++)
        step_of(run, dt);
    for (int32_t i = 0; i < p->count; i++) {
        after = vec3_add(after, vec3_make(p->position[i][0], p->position[i][1], 0.0));
        for (int axis = 0; axis < 2; axis++)
            assert_near(p->velocity[i][axis], u[axis] + g[axis] * t, 1e-12 * 90.0);
        assert_near(p->pressure[i], 0.0, 1e-2); /* of 73 GPa */
    }
    const double shift[2] = {(after.x - before.x) / p->count, (after.y - before.y) / p->count};
    for (int axis = 0; axis < 2; axis++)
        assert_near(shift[axis], u[axis] * t + 0.5 * g[axis] * t * (t + part * dt), 1e-15);
    const struct totals now = population_totals(population_of_particles(p), &run->ranks, -1);
    const struct totals booked =
        ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_GRAVITY);
    for (int e = 0; e < LEDGER_ENTRIES; e++) {
        const double scale = e == LEDGER_ENERGY ? now.kinetic : now.momentum_scale;
        assert_near(now.entry[e] - booked.entry[e], start.entry[e],
                    e == LEDGER_MASS ? 0.0 : 1e-13 * scale);
    }
    end(run);
}

static void a_stone_falls_as_the_integrator_has_it(void **state)
{
    (void)state;
    const struct variant *const mpm[] = {&by_mpm, &by_affine, &by_usf, &by_linear}, *const sph[] = {
                                                                                        &by_sph,
                                                                                        &by_contact,
                                                                                        &by_heun};
    for (size_t k = 0; k < COUNT_OF(mpm); k++)
        check_fall(mpm[k], 1.0);
    for (size_t k = 0; k < COUNT_OF(sph); k++)
        check_fall(sph[k], 0.0);
}

/* A stone that lands: momentum stays with what gravity and the floor give; energy, of SPH, too. */
static void check_landing(const struct variant *variant, double energy)
{
    struct running *run = begin_fresh(landing, variant);
    const struct particles *p = particles_of(&run->simulation);
    const struct totals start = population_totals(population_of_particles(p), &run->ranks, -1);
    step(run, 40);
    const struct totals now = population_totals(population_of_particles(p), &run->ranks, -1);
    const struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    const struct totals walls = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_WALLS);
    assert_true(walls.entry[LEDGER_MOMENTUM_Y] > 0.0);
    for (int e = LEDGER_MOMENTUM_X; e <= LEDGER_MOMENTUM_Z; e++)
        assert_near(now.entry[e] - booked.entry[e], start.entry[e], 1e-13 * start.momentum_scale);
    const double kept = now.entry[LEDGER_ENERGY] - booked.entry[LEDGER_ENERGY];
    assert_near(kept, start.entry[LEDGER_ENERGY], energy * now.kinetic);
    end(run);
}

static void a_stone_that_lands_keeps_what_is_booked(void **state)
{
    (void)state;
    check_landing(&by_mpm, (double)INFINITY);
    check_landing(&by_contact, 1e-12);
    check_landing(&by_sph, 1e-12);
}

static void bits_do_not_depend_on_threads_or_a_resume(void **state)
{
    (void)state;
    static const char *const settings[] = {"solver=mpm", "solver=sph",
                                           "solver={sph: {method: hllc}}"};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant one = {"one thread", 1, 1.0, settings[k], false},
                             three = {"three threads", 3, 1.7, settings[k], false},
                             resumed = {"resumed", 1, 1.0, settings[k], true};
        const uint64_t hash = hash_after(landing, &one, &one, 30);
        assert_true(hash_after(landing, &one, &three, 30) == hash);
        assert_true(hash_after(landing, &one, &resumed, 30) == hash);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stone_falls_as_the_integrator_has_it),
        cmocka_unit_test(a_stone_that_lands_keeps_what_is_booked),
        cmocka_unit_test(bits_do_not_depend_on_threads_or_a_resume),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
