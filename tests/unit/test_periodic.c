/* Particles in periodic domains: places on the grain, a uniform flow that goes round, the same
 * problem with the seam elsewhere, the same bits however it is run, and what must be conserved. */
#include "populations.h"
#include "running.h"

#include "parallel/periodic.h"

#if defined(BOLIDE_SANITIZE)
enum { STEPS = 10 };
#else
enum { STEPS = 40 };
#endif

#define AIR "materials: {air: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}}\n"
#define END "run: {until: 1 s}\n"

static const struct variant base = {"base", 1, 1.0, NULL, false};

/* The faces are no multiples of any power of two. */
static void places_shift_without_rounding(void **state)
{
    (void)state;
    struct mirrors mirrors = {{NAN, NAN, NAN}, {NAN, NAN, NAN}, {0.0}};
    struct dice dice = {3};
    for (int k = 0; k < 1000; k++) {
        const double low = dice_between(&dice, -7.0, 1.0),
                     high = low + dice_between(&dice, 0.1, 9.0);
        images_make_periodic(&mirrors, 1, low, high);
        assert_true(fabs(mirrors.low[1] - low) < 1e-14 && fabs(mirrors.high[1] - high) < 1e-14);
        const double period = periodic_period(&mirrors, 1);
        const double x =
            periodic_rounded(&mirrors, 1, low + dice_between(&dice, 0.0, 1.0) * period);
        const double inside = periodic_inside(&mirrors, 1, x), above = x + period;
        assert_true(inside >= mirrors.low[1] && inside < mirrors.high[1]);
        assert_true(above - period == x && periodic_inside(&mirrors, 1, above) == inside);
        assert_true(periodic_inside(&mirrors, 1, x - period) == inside);
        assert_true(periodic_nearest(&mirrors, 1, above, x) == x);
        assert_true(image_place(&mirrors, 1, 1, x) == above);
        assert_true(image_place(&mirrors, 2, 1, above) == x);
    }
    assert_true(periodic_inside(&mirrors, 1, mirrors.high[1]) == mirrors.low[1]);
    assert_true(periodic_inside(&mirrors, 1, mirrors.low[1]) == mirrors.low[1]);
}

static void images_are_ordered_by_their_places(void **state)
{
    (void)state;
    struct mirrors mirrors = {{-1.0, -1.0, NAN}, {1.0, 1.0, NAN}, {0.0}};
    images_make_periodic(&mirrors, 0, -1.0, 1.0);
    /* one below, itself, one above; behind the walls of y by code */
    assert_true(image_order(&mirrors, 2) < image_order(&mirrors, 0));
    assert_true(image_order(&mirrors, 0) < image_order(&mirrors, 1));
    assert_true(image_order(&mirrors, 0) < image_order(&mirrors, 3));
    assert_true(image_order(&mirrors, 3) < image_order(&mirrors, 6));
    const struct vec3 sign = image_sign(&mirrors, 1 + 3 * 2);
    assert_true(sign.x == 1.0 && sign.y == -1.0 && sign.z == 1.0);
}

/* A uniform stream, whose particles all go round. */
static const char *const streams[] = {
    "format: 1\ndimension: 1\nresolution: 50 mm\nsolver: sph\n" AIR
    "bodies: {air: {material: air, pressure: 1 Pa, velocity: [3 m/s], box: {from: [0 m], to: [1 "
    "m]}}}\n"
    "boundaries: {x: {axis: x, kind: periodic}}\n" END,
    "format: 1\ndimension: 2\nresolution: 50 mm\nsolver: sph\n" AIR
    "bodies: {air: {material: air, pressure: 1 Pa, velocity: [3 m/s, -3 m/s], "
    "lattice: hexagonal, box: {from: [0.1 m, 0 m], to: [1.1 m, 0.7 m]}}}\n"
    "boundaries: {x: {axis: x, kind: periodic}, y: {axis: y, kind: periodic}}\n" END,
    "format: 1\ndimension: 3\nresolution: 0.1 m\nsolver: sph\n" AIR
    "bodies: {air: {material: air, pressure: 1 Pa, velocity: [3 m/s, 0 m/s, 1.5 m/s], "
    "box: {from: [0 m, 0 m, 0 m], to: [1 m, 0.6 m, 1 m]}}}\n"
    "boundaries: {x: {axis: x, kind: periodic}, z: {axis: z, kind: periodic}}\n"
    "walls: {low: {mirror: y, at: 0 m, side: low}, high: {mirror: y, at: 0.6 m, side: high}}\n" END,
};

static void a_uniform_stream_comes_back_as_it_was(void **state)
{
    (void)state;
    static const double round[][3] = {{1.0, 0.0, 0.0}, {1.0, -1.0, 0.0}, {1.0, 0.0, 0.5}};
    for (size_t c = 0; c < COUNT_OF(streams); c++) {
        struct running *run = begin_fresh(streams[c], &base);
        const struct particles *p = particles_of(&run->simulation);
        const struct mirrors *mirrors = &run->simulation.problem->images;
        double(*start)[3] = calloc((size_t)p->count, sizeof *start);
        uint64_t *id = calloc((size_t)p->count, sizeof *id);
        memcpy(start, p->position, (size_t)p->count * sizeof *start);
        memcpy(id, p->id, (size_t)p->count * sizeof *id);
        const double energy = p->energy[0], until = 1.0 / 3.0;
        while (run->simulation.time < until)
            step_of(run, until - run->simulation.time);
        for (int32_t i = 0; i < p->count; i++) {
            int32_t was = 0;
            while (id[was] != p->id[i])
                was++;
            for (int axis = 0; axis < run->simulation.problem->dimension; axis++) {
                double wanted = start[was][axis] + round[c][axis];
                if (images_repeat(mirrors, axis))
                    wanted = periodic_nearest(mirrors, axis, wanted, p->position[i][axis]);
                assert_true(fabs(p->position[i][axis] - wanted) < 1e-12);
            }
            assert_true(fabs(p->density[i] - 1.0) < 1e-12);
            assert_true(fabs(p->energy[i] / energy - 1.0) < 1e-12);
        }
        free(start);
        free(id);
        end(run);
    }
}

/* A wave, in which the seam cuts a crest or a node; all pairs are the same, in another order. */
static void the_seam_may_be_anywhere(void **state)
{
    (void)state;
    enum { COUNT = 40 };
    static const char text[] =
        "format: 1\ndimension: 1\nresolution: 25 mm\nsolver: {sph: {smoothing: 1.2}}\n"
        "let: {at: 0 m}\n" AIR "bodies: {air: {material: air, "
        "density: 1 kg/m^3 + 0.2 kg/m^3*cos(2*pi*(x - at)/(1 m)), pressure: 1 Pa, "
        "velocity: [0.5 m/s + 0.3 m/s*sin(2*pi*(x - at)/(1 m))], box: {from: [0 m], to: [1 m]}}}\n"
        "boundaries: {x: {axis: x, kind: periodic}}\n" END;
    double density[2][COUNT], velocity[2][COUNT];
    for (int shifted = 0; shifted < 2; shifted++) {
        const struct variant variant = {"", 1, 1.0, shifted ? "let.at=0.5 m" : NULL, false};
        struct running *run = begin_fresh(text, &variant);
        const struct particles *p = particles_of(&run->simulation);
        while (run->simulation.time < 0.5)
            step_of(run, 0.5 - run->simulation.time);
        assert_int_equal(p->count, COUNT);
        for (int32_t i = 0; i < p->count; i++) {
            const uint64_t site = (p->id[i] + (uint64_t)(shifted ? COUNT / 2 : 0)) % COUNT;
            density[shifted][site] = p->density[i];
            velocity[shifted][site] = p->velocity[i][0];
        }
        end(run);
    }
    for (int k = 0; k < COUNT; k++) {
        assert_true(fabs(density[0][k] - density[1][k]) < 1e-11);
        assert_true(fabs(velocity[0][k] - velocity[1][k]) < 1e-11);
    }
}

/* Shear flows through all kinds of faces, some with strength and a contact law across the seam. */
static const char plane[] =
    "format: 1\ndimension: 2\nresolution: 40 mm\nsolver: sph\n" AIR "bodies: {air: {material: air, "
    "density: 1 kg/m^3 + 0.1 kg/m^3*sin(2*pi*x/(1 m))*cos(2*pi*y/(1 m)), pressure: 1 Pa, "
    "velocity: [3 m/s + 1 m/s*sin(2*pi*y/(1 m)), 2 m/s], box: {from: [0 m, 0 m], to: [1 m, 1 "
    "m]}}}\n"
    "boundaries: {x: {axis: x, kind: periodic}, y: {axis: y, kind: periodic}}\n" END;
static const char space[] =
    "format: 1\ndimension: 3\nresolution: 2 mm\nsolver: sph\n"
    "materials:\n"
    "  steel:\n"
    "    eos: {barotropic: {density: 7900 kg/m^3, bulk_modulus: 176 GPa}}\n"
    "    strength: {perfect-plastic: {shear_modulus: 83 GPa, yield: 0.5 GPa}}\n"
    "bodies:\n"
    "  first: {material: steel, box: {from: [0 mm, 0 mm, 0 mm], to: [12 mm, 12 mm, 16 mm]}, "
    "velocity: [900 m/s, 100 m/s, 500 m/s*sin(2*pi*x/(24 mm))]}\n"
    "  second: {material: steel, box: {from: [12 mm, 0 mm, 0 mm], to: [24 mm, 12 mm, 16 mm]}, "
    "velocity: [700 m/s, 0 m/s, 0 m/s]}\n"
    "contacts: {faces: {between: [first, second], shear: slip, tension: none}}\n"
    "domain: {low: [0 mm, 0 mm, 0 mm], high: [24 mm, 12 mm, 16 mm]}\n"
    "boundaries:\n"
    "  x: {axis: x, kind: periodic}\n"
    "  z: {axis: z, kind: periodic}\n"
    "  floor: {axis: y, side: low, kind: reflecting}\n" END;

static void streams_have_one_hash(void **state)
{
    (void)state;
    static const struct variant variants[] = {
        {"3 threads", 3, 1.0, NULL, false},
        {"small cells", 1, 0.37, NULL, false},
        {"large cells", 2, 3.0, NULL, false},
        {"thin skin", 1, 1.0, "solver.sph.skin=0.02", false},
        {"thick skin", 1, 1.0, "solver.sph.skin=0.5", false},
        {"rows of every step", 1, 1.0, "solver.sph.rebuild=1", false},
        {"resumed, other cells and threads", 2, 1.7, NULL, true},
    };
    const char *const texts[] = {plane, space, streams[1]};
    for (size_t c = 0; c < COUNT_OF(texts); c++) {
        const uint64_t wanted = hash_after(texts[c], &base, &base, STEPS);
        for (size_t k = 0; k < COUNT_OF(variants); k++)
            if (hash_after(texts[c], &base, &variants[k], STEPS) != wanted)
                fail_msg("case %d, %s: another hash", (int)c, variants[k].name);
    }
}

static void mass_momentum_and_energy_are_kept(void **state)
{
    (void)state;
    const char *const texts[] = {plane, space};
    for (size_t c = 0; c < COUNT_OF(texts); c++) {
        struct running *run = begin_fresh(texts[c], &base);
        const struct particles *p = particles_of(&run->simulation);
        const struct totals start = population_totals(population_of_particles(p), &run->ranks, -1);
        step(run, STEPS);
        const struct totals now = population_totals(population_of_particles(p), &run->ranks, -1),
                            booked =
                                ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
        for (int k = LEDGER_MOMENTUM_X; k <= LEDGER_MOMENTUM_Z; k++)
            assert_true(fabs(now.entry[k] - booked.entry[k] - start.entry[k]) <
                        1e-13 * start.momentum_scale);
        assert_true(now.entry[LEDGER_MASS] == start.entry[LEDGER_MASS]);
        assert_true(energy_drift(&now, &booked, &start) < 1e-13);
        end(run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_shift_without_rounding),
        cmocka_unit_test(images_are_ordered_by_their_places),
        cmocka_unit_test(a_uniform_stream_comes_back_as_it_was),
        cmocka_unit_test(the_seam_may_be_anywhere),
        cmocka_unit_test(streams_have_one_hash),
        cmocka_unit_test(mass_momentum_and_energy_are_kept),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
