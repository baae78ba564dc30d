/* Bodies that something outside holds: pistons that are driven and strikers that stop, and what the
 * ledger says. */
#include "populations.h"
#include "running.h"

static const char push[] =
    "format: 1\n"
    "dimension: 2\n"
    "resolution: 1 mm\n"
    "solver: {sph: {method: contact, smoothing: 1.2}}\n"
    "materials:\n"
    "  metal:\n"
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: 2.17, "
    "bulk_modulus: 73 GPa}}\n"
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.3 GPa}}\n"
    "bodies:\n"
    "  piston: {material: metal, box: {from: [-6 mm, 0 mm], to: [0 mm, 12 mm]}, "
    "velocity: [800 m/s, 30 m/s], driven: yes, stop: 1.5 us}\n"
    "  target: {material: metal, box: {from: [0 mm, 0 mm], to: [20 mm, 10 mm]}}\n"
    "  anvil: {material: metal, box: {from: [20 mm, 0 mm], to: [24 mm, 12 mm]}, stop: 0 s}\n"
    "walls:\n"
    "  below: {mirror: y, at: 0 mm, side: low}\n"
    "run: {until: 1 s}\n";

static const struct variant plain = {"plain", 1, 1.0, NULL, false};
static const struct variant by_contact = {"moved by contacts", 1, 1.0,
                                          "solver.sph.method.contact.motion=contact", false};
static const struct variant of_second_order = {"second order", 1, 1.0, "solver.sph.method=muscl",
                                               false};

static void assert_closed(const struct running *run, const struct totals *start)
{
    const struct particles *p = particles_of(&run->simulation);
    struct totals now = population_totals(population_of_particles(p), &run->ranks, -1);
    struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    for (int entry = LEDGER_MOMENTUM_X; entry <= LEDGER_MOMENTUM_Z; entry++)
        assert_near(now.entry[entry] - booked.entry[entry], start->entry[entry],
                    1e-13 * start->momentum_scale);
    assert_near(now.entry[LEDGER_ENERGY] - booked.entry[LEDGER_ENERGY], start->entry[LEDGER_ENERGY],
                1e-12 * start->kinetic);
}

static void a_piston_keeps_its_velocity_until_it_stops(void **state)
{
    (void)state;
    const struct variant *const variants[] = {&plain, &by_contact, &of_second_order};
    for (size_t k = 0; k < COUNT_OF(variants); k++) {
        struct running *run = begin_fresh(push, variants[k]);
        struct totals start =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        while (run->simulation.time < 1.5e-6) {
            step_of(run, 1.5e-6 - run->simulation.time);
            assert_velocity(run, 0, 800.0, 30.0);
            assert_velocity(run, 2, 0.0, 0.0);
            assert_closed(run, &start);
        }
        struct totals moving = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_PISTONS);
        assert_true(moving.entry[LEDGER_ENERGY] > 0.0);
        struct totals piston =
            population_totals(simulation_population(&run->simulation), &run->ranks, 0);
        step(run, 1);
        assert_velocity(run, 0, 0.0, 0.0);
        assert_closed(run, &start);
        struct totals stopped = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_PISTONS);
        assert_near(stopped.entry[LEDGER_ENERGY] - moving.entry[LEDGER_ENERGY], -piston.kinetic,
                    1e-9 * piston.kinetic);
        step(run, 30);
        assert_velocity(run, 0, 0.0, 0.0);
        assert_closed(run, &start);
        struct totals resting = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_PISTONS);
        assert_true(resting.entry[LEDGER_ENERGY] == stopped.entry[LEDGER_ENERGY]);
        assert_true(resting.entry[LEDGER_MOMENTUM_X] != stopped.entry[LEDGER_MOMENTUM_X]);
        end(run);
    }
}

static void a_driven_body_moves_by_its_velocity(void **state)
{
    (void)state;
    struct running *run = begin_fresh(push, &plain);
    const struct particles *p = particles_of(&run->simulation);
    double from = 0.0, to = 0.0;
    for (int32_t i = 0; i < p->count; i++)
        from += p->body[i] == 0 ? p->position[i][0] : 0.0;
    step(run, 10);
    int count = 0;
    for (int32_t i = 0; i < p->count; i++) {
        to += p->body[i] == 0 ? p->position[i][0] : 0.0;
        count += p->body[i] == 0;
    }
    assert_near((to - from) / count, 800.0 * run->simulation.time, 1e-12);
    end(run);
}

/* Its particles do not deform each other, so that no pressure runs into it. */
static void the_thickness_of_a_driven_body_does_not_matter(void **state)
{
    (void)state;
    const struct variant variants[] = {
        {"thin", 1, 1.0, "solver.sph.method=muscl", false},
        {"thick", 1, 1.0, "solver.sph.method=muscl", false},
    };
    double velocity[2], pressure[2];
    for (int k = 0; k < 2; k++) {
        const char *at = strstr(push, "-6 mm");
        char *text =
            text_format("%.*s%s%s", (int)(at - push), push, k ? "-24 mm" : "-6 mm", at + 5);
        struct running *run = begin_fresh(text, &variants[k]);
        const struct particles *p = particles_of(&run->simulation);
        free(text);
        while (run->simulation.time < 1.4e-6)
            step_of(run, 1.4e-6 - run->simulation.time);
        velocity[k] = pressure[k] = 0.0;
        for (int32_t i = 0; i < p->count; i++)
            if (p->body[i] == 1) {
                velocity[k] += p->velocity[i][0];
                pressure[k] += p->pressure[i];
            }
        end(run);
    }
    assert_near(velocity[1], velocity[0], 1e-7 * velocity[0]);
    assert_near(pressure[1], pressure[0], 1e-7 * pressure[0]);
}

static const struct variant of_heun = {"hllc", 1, 1.0, "solver={sph: {method: hllc}}", false};
static const struct variant of_mpm = {"mpm", 1, 1.0, "solver=mpm", false};

/* The piston goes to and fro along x, keeps its velocity along y and stops. */
static char *swung(void)
{
    const char *at = strstr(push, "800 m/s");
    return text_format("%.*s100 m/s + 700 m/s*cos(t/0.4 us)%s", (int)(at - push), push, at + 7);
}

/* It moves by the rule of trapezoids, and what that takes is booked: momentum to rounding where the
 * method keeps it, which hllc does not, and energy by SPH that keeps it. */
static void a_driven_body_follows_the_time(void **state)
{
    (void)state;
    const struct variant *const variants[] = {&plain, &by_contact, &of_second_order, &of_heun,
                                              &of_mpm};
    char *text = swung();
    for (size_t k = 0; k < COUNT_OF(variants); k++) {
        struct running *run = begin_fresh(text, variants[k]);
        const struct particles *p = particles_of(&run->simulation);
        const struct totals start = population_totals(population_of_particles(p), &run->ranks, -1);
        double way = 0.0, longest = 0.0;
        while (run->simulation.time < 1.5e-6) {
            const double before = run->simulation.time;
            step_of(run, 1.5e-6 - before);
            const double u[2] = {100.0 + 700.0 * cos(before / 0.4e-6),
                                 100.0 + 700.0 * cos(run->simulation.time / 0.4e-6)};
            const double dt = run->simulation.time - before;
            way += 0.5 * dt * (u[0] + u[1]);
            longest = maximum(longest, dt);
            for (int32_t i = 0; i < p->count; i++)
                if (p->body[i] == 0)
                    assert_near(fabs(p->velocity[i][0] - u[1]) + fabs(p->velocity[i][1] - 30.0),
                                0.0, 1e-12);
            if (k < 3)
                assert_closed(run, &start);
            const struct totals now =
                population_totals(population_of_particles(p), &run->ranks, -1);
            const struct totals booked =
                ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
            for (int e = LEDGER_MOMENTUM_X; e <= LEDGER_MOMENTUM_Z && k != 3; e++)
                assert_near(now.entry[e] - booked.entry[e], start.entry[e],
                            1e-12 * start.momentum_scale);
        }
        double moved = 0.0, mass = 0.0;
        for (int32_t i = 0; i < p->count; i++)
            if (p->body[i] == 0) {
                moved += p->mass[i] * p->position[i][0];
                mass += p->mass[i];
            }
        assert_near(moved / mass + 3e-3, way, 1e-15);
        /* the error of the rule: T dt^2/12 times the largest second derivative */
        assert_near(way, 100.0 * 1.5e-6 + 700.0 * 0.4e-6 * sin(1.5 / 0.4),
                    1.5e-6 * square(longest) / 12.0 * 700.0 / square(0.4e-6));
        step(run, 2);
        assert_velocity(run, 0, 0.0, 0.0);
        end(run);
    }
    free(text);
}

static void a_driven_body_has_the_same_bits_after_a_resume(void **state)
{
    (void)state;
    static const char *const settings[] = {"solver={sph: {method: contact}}", "solver=sph",
                                           "solver=mpm"};
    char *text = swung();
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant one = {"one thread", 1, 1.0, settings[k], false},
                             three = {"three threads", 3, 1.7, settings[k], false},
                             resumed = {"resumed", 1, 1.0, settings[k], true};
        const uint64_t hash = hash_after(text, &one, &one, 30);
        assert_true(hash_after(text, &one, &three, 30) == hash);
        assert_true(hash_after(text, &one, &resumed, 30) == hash);
    }
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_piston_keeps_its_velocity_until_it_stops),
        cmocka_unit_test(a_driven_body_moves_by_its_velocity),
        cmocka_unit_test(the_thickness_of_a_driven_body_does_not_matter),
        cmocka_unit_test(a_driven_body_follows_the_time),
        cmocka_unit_test(a_driven_body_has_the_same_bits_after_a_resume),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
