/* The gas solver on cases: what a gas at rest does, that sleeping blocks change no bit, the same
 * bits on any number of threads and after a resume, what must be conserved, and mirror images. */
#include "populations.h"
#include "running.h"

#if defined(BOLIDE_SANITIZE)
enum { STEPS = 8 };
#else
enum { STEPS = 24 };
#endif

#define AIR "materials: {air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}}\n"
#define END "run: {until: 1 s}\n"

/* A small charge of hot gas in air at rest, far from most of the air. */
static const char line[] =
    "format: 1\ndimension: 1\nresolution: 1 mm\nsolver: gas\n" AIR "bodies:\n"
    "  air: {material: air, box: {from: [0 m], to: [0.9 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: air, box: {from: [0.1 m], to: [0.13 m]}, pressure: 5 MPa, replaces: air}\n"
    "walls: {end: {mirror: x, at: 0 m, side: low}}\n" END;
static const char plane[] =
    "format: 1\ndimension: 2\nresolution: 4 mm\nsolver: gas\n" AIR "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m], to: [0.9 m, 0.6 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: air, ball: {center: [0.3 m, 0.2 m], radius: 0.05 m}, pressure: 5 MPa, "
    "replaces: air}\n"
    "boundaries: {sides: {axis: y, kind: periodic}}\n"
    "walls: {end: {mirror: x, at: 0 m, side: low}}\n" END;
static const char blocked[] =
    "format: 1\ndimension: 2\nresolution: 4 mm\n"
    "solver: {gas: {method: muscl-hancock}}\n" AIR "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m], to: [0.9 m, 0.6 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: air, ball: {center: [0.3 m, 0.2 m], radius: 0.05 m}, pressure: 5 MPa, "
    "replaces: air}\n"
    "obstacles:\n"
    "  block: {box: {from: [0.4 m, 0.1 m], to: [0.5 m, 0.3 m]}}\n"
    "  plate: {box: {from: [0.2 m, 0.28 m], to: [0.36 m, 0.288 m]}}\n" END;
static const char ring[] =
    "format: 1\ndimension: 2\ngeometry: axisymmetric\nresolution: 4 mm\nsolver: gas\n" AIR
    "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m], to: [0.6 m, 0.9 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: air, ball: {center: [0 m, 0.3 m], radius: 0.05 m}, pressure: 5 MPa, "
    "replaces: air}\n" END;
static const char space[] =
    "format: 1\ndimension: 3\nresolution: 20 mm\n"
    "solver: {gas: {method: lax-wendroff}}\n" AIR "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m, 0 m], to: [0.9 m, 0.6 m, 0.6 m]}, "
    "pressure: 0.1 MPa}\n"
    "  hot: {material: air, ball: {center: [0.3 m, 0.2 m, 0.2 m], radius: 0.07 m}, "
    "pressure: 5 MPa, replaces: air}\n"
    "walls: {floor: {mirror: z, at: 0 m, side: low}}\n" END;
static const char heavy[] =
    "format: 1\ndimension: 2\nresolution: 8 mm\nsolver: gas\ngravity: [3000 m/s^2, -9000 "
    "m/s^2]\n" AIR "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m], to: [0.48 m, 0.32 m]}, pressure: 0.1 MPa}\n"
    "walls:\n"
    "  left: {mirror: x, at: 0 m, side: low}\n"
    "  right: {mirror: x, at: 0.48 m, side: high}\n"
    "  floor: {mirror: y, at: 0 m, side: low}\n"
    "  lid: {mirror: y, at: 0.32 m, side: high}\n" END;

#define TWO                                                                                 \
    "materials:\n"                                                                          \
    "  air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}\n"                        \
    "  products: {eos: {jwl: {density: 1630 kg/m^3, a: 371.2 GPa, b: 3.231 GPa, r1: 4.15, " \
    "r2: 0.95, omega: 0.3, energy: 6.993 GPa}}}\n"
static const char two[] =
    "format: 1\ndimension: 2\nresolution: 4 mm\nsolver: gas\n" TWO "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m], to: [0.9 m, 0.6 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: products, ball: {center: [0.3 m, 0.2 m], radius: 0.05 m}, energy: 0 J/kg, "
    "replaces: air}\n"
    "obstacles:\n"
    "  block: {box: {from: [0.36 m, 0.1 m], to: [0.5 m, 0.3 m]}}\n"
    "walls: {end: {mirror: x, at: 0 m, side: low}}\n" END;
static const char two_ring[] =
    "format: 1\ndimension: 2\ngeometry: axisymmetric\nresolution: 4 mm\nsolver: gas\n" TWO
    "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m], to: [0.6 m, 0.9 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: products, ball: {center: [0 m, 0.3 m], radius: 0.05 m}, energy: 0 J/kg, "
    "replaces: air}\n" END;

static const char sphere[] =
    "format: 1\ndimension: 1\ngeometry: spherical\nresolution: 1 mm\nsolver: gas\n" TWO "bodies:\n"
    "  air: {material: air, box: {from: [0 m], to: [0.9 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: products, ball: {center: [0 m], radius: 0.05 m}, energy: 0 J/kg, "
    "replaces: air}\n" END;
static const char charge[] =
    "format: 1\ndimension: 2\nresolution: 8 mm\nsolver: gas\n"
    "materials:\n"
    "  air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}\n"
    "  tnt:\n"
    "    eos: {jwl: {density: 1630 kg/m^3, a: 371.2 GPa, b: 3.231 GPa, r1: 4.15, r2: 0.95, omega: "
    "0.3, "
    "energy: 6.993 GPa}}\n"
    "    burn: {programmed: {speed: 6930 m/s}}\n"
    "    afterburn: {energy: 3 MJ/kg, rate: 1e5 1/s, depletion: 1, power: 0.1, "
    "slow_energy: 7 MJ/kg, slow_rate: 1e4 1/s, air: 0.05}\n"
    "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m], to: [0.896 m, 0.6 m]}, pressure: 0.1 MPa, "
    "density: 1.2 kg/m^3}\n"
    "  hot: {material: tnt, box: {from: [0.2 m, 0.2 m], to: [0.33 m, 0.29 m]}, replaces: air}\n"
    "detonations: {end: {at: [0.21 m, 0.22 m]}}\n"
    "obstacles: {block: {box: {from: [0.36 m, 0.1 m], to: [0.5 m, 0.3 m]}}}\n" END;
static const char cylinder[] =
    "format: 1\ndimension: 1\ngeometry: cylindrical\nresolution: 1 mm\nsolver: gas\n" AIR
    "bodies:\n"
    "  air: {material: air, box: {from: [0.1 m], to: [0.9 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: air, box: {from: [0.1 m], to: [0.2 m]}, pressure: 5 MPa, "
    "replaces: air}\n" END;

/* Cells of several levels: domains that cut blocks, negative places, waves across faces. */
static const char line_of_levels[] =
    "format: 1\ndimension: 1\nresolution: 1 mm\nlevels: 3\nsolver: gas\n"
    "fine: {hot: {box: {from: [90 mm], to: [140 mm]}}}\n" AIR "bodies:\n"
    "  air: {material: air, box: {from: [0 m], to: [1.904 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: air, box: {from: [0.1 m], to: [0.13 m]}, pressure: 5 MPa, replaces: air}\n"
    "walls: {end: {mirror: x, at: 0 m, side: low}}\n" END;
static const char plane_of_levels[] =
    "format: 1\ndimension: 2\nresolution: 4 mm\nlevels: 3\nsolver: gas\n"
    "fine: {hot: {ball: {center: [0.3 m, 0.2 m], radius: 0.05 m}}, end: {box: {from: [0.2 m, 0.4 "
    "m], "
    "to: [0.3 m, 0.42 m]}}}\n" AIR "bodies:\n"
    "  air: {material: air, box: {from: [-0.16 m, -0.032 m], to: [1.28 m, 1.056 m]}, "
    "pressure: 0.1 MPa}\n"
    "  hot: {material: air, ball: {center: [0.3 m, 0.2 m], radius: 0.05 m}, pressure: 5 MPa, "
    "replaces: air}\n"
    "walls: {end: {mirror: x, at: -0.16 m, side: low}, floor: {mirror: y, at: -32 mm, side: low}}"
    "\n" END;
static const char levels_that_stay[] =
    "format: 1\ndimension: 2\nresolution: 8 mm\nlevels: 3\nsolver: {gas: {regrid: 0}}\n"
    "fine: {hot: {ball: {center: [0.3 m, 0.2 m], radius: 0.05 m}}}\n" AIR "bodies:\n"
    "  air: {material: air, box: {from: [-0.128 m, 0 m], to: [1.28 m, 1.088 m]}, "
    "pressure: 0.1 MPa}\n"
    "  hot: {material: air, ball: {center: [0.3 m, 0.2 m], radius: 0.05 m}, pressure: 5 MPa, "
    "replaces: air}\n" END;
static const char blocked_levels[] =
    "format: 1\ndimension: 2\nresolution: 4 mm\nlevels: 3\nsolver: gas\n" AIR "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m], to: [1.28 m, 0.8 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: air, ball: {center: [0.3 m, 0.2 m], radius: 0.05 m}, pressure: 5 MPa, "
    "replaces: air}\n"
    "obstacles:\n"
    "  block: {box: {from: [0.384 m, 0.1 m], to: [0.512 m, 0.3 m]}}\n"
    "  plate: {box: {from: [0.2 m, 0.28 m], to: [0.36 m, 0.288 m]}}\n" END;
static const char space_of_levels[] =
    "format: 1\ndimension: 3\nresolution: 40 mm\nlevels: 3\nsolver: gas\n"
    "fine: {hot: {box: {from: [0.3 m, 0.2 m, 0.2 m], to: [0.31 m, 0.21 m, 0.21 m]}}}\n" AIR
    "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m, 0 m], to: [1.6 m, 1.28 m, 1.28 m]}, "
    "pressure: 0.1 MPa}\n"
    "  hot: {material: air, ball: {center: [0.3 m, 0.2 m, 0.2 m], radius: 0.14 m}, "
    "pressure: 5 MPa, replaces: air}\n"
    "walls: {floor: {mirror: z, at: 0 m, side: low}}\n" END;

static const char ring_of_levels[] =
    "format: 1\ndimension: 2\ngeometry: axisymmetric\nresolution: 4 mm\nlevels: 3\nsolver: "
    "gas\n" TWO "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m], to: [1.024 m, 1.28 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: products, ball: {center: [0 m, 0.3 m], radius: 0.05 m}, energy: 0 J/kg, "
    "replaces: air}\n" END;
static const char sphere_of_levels[] =
    "format: 1\ndimension: 1\ngeometry: spherical\nresolution: 1 mm\nlevels: 3\nsolver: gas\n" TWO
    "bodies:\n"
    "  air: {material: air, box: {from: [0 m], to: [2.048 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: products, ball: {center: [0 m], radius: 0.05 m}, energy: 0 J/kg, "
    "replaces: air}\n" END;
static const char inflow_of_levels[] =
    "format: 1\ndimension: 2\nresolution: 4 mm\nlevels: 3\nsolver: gas\n"
    "gravity: [0 m/s^2, -900 m/s^2]\n" AIR "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m], to: [1.28 m, 1.024 m]}, pressure: 0.1 MPa}\n"
    "boundaries:\n"
    "  jet: {axis: x, side: low, kind: inflow, density: 5 kg/m^3, pressure: 1 MPa, velocity: [900 "
    "m/s, 0 m/s], part: {box: {from: [-1 m, 0.2 m], to: [1 m, 0.3 m]}}}\n" END;

static const struct {
    const char *name, *text;
    int steps; /* fewer than the walls of the domain are away */
} cases[] = {{"line", line, STEPS},
             {"plane", plane, STEPS},
             {"blocked", blocked, STEPS},
             {"ring", ring, STEPS},
             {"space", space, STEPS / 4},
             {"two", two, STEPS},
             {"two in a ring", two_ring, STEPS},
             {"sphere", sphere, STEPS},
             {"cylinder", cylinder, STEPS},
             {"charge", charge, STEPS},
             {"line of levels", line_of_levels, 2 * STEPS},
             {"plane of levels", plane_of_levels, STEPS / 2},
             {"levels that stay", levels_that_stay, STEPS / 2},
             {"blocked levels", blocked_levels, STEPS / 2},
             {"space of levels", space_of_levels, STEPS / 4},
             {"sphere of levels", sphere_of_levels, STEPS},
             {"inflow of levels", inflow_of_levels, STEPS / 2},
             {"ring of levels", ring_of_levels, STEPS / 2},
             {"heavy", heavy, STEPS}};

static const struct variant plain = {"plain", 1, 1.0, NULL, false};

/* How many of the blocks are awake between steps. */
static int awake(const struct running *run)
{
    int count = 0;
    for (int32_t b = 0; b < run->gas.cells->blocks; b++)
        count += run->gas.block[b].awake;
    return count;
}

static void sleeping_blocks_change_no_bit(void **state)
{
    (void)state;
    for (size_t c = 0; c < COUNT_OF(cases); c++) {
        uint64_t hash[2];
        struct totals walls[2];
        for (int sleepless = 0; sleepless < 2; sleepless++) {
            struct running *run = begin_fresh(cases[c].text, &plain);
            run->gas.sleepless |= sleepless;
            step(run, cases[c].steps);
            hash[sleepless] = simulation_hash(&run->simulation);
            walls[sleepless] = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
            if (!sleepless && !strstr(cases[c].text, "gravity")) {
                if (awake(run) == 0 || awake(run) == run->gas.cells->blocks)
                    fail_msg("%s: %d of %d blocks are awake", cases[c].name, awake(run),
                             (int)run->gas.cells->blocks);
            }
            end(run);
        }
        if (hash[0] != hash[1])
            fail_msg("%s: sleeping changes the bits", cases[c].name);
        for (int k = 0; k < LEDGER_ENTRIES; k++)
            assert_true(walls[0].entry[k] == walls[1].entry[k]);
    }
}

/* To the bit, for any equation of state, about an axis too. */
static void a_gas_at_rest_stays_at_rest(void **state)
{
    (void)state;
    static const char *const eos[] = {
        NULL,
        "materials.air.eos={noble-abel: {density: 1.2 kg/m^3, gamma: 1.3, covolume: 1e-3 m^3/kg}}",
        "materials.air.eos={stiffened-gas: {density: 1000 kg/m^3, sound: 1500 m/s, gamma: 3}}",
        "materials.air.eos={jwl: {density: 1630 kg/m^3, a: 371.2 GPa, b: 3.231 GPa, r1: 4.15, "
        "r2: 0.95, omega: 0.3, energy: 0 GPa}}",
    };
    for (size_t k = 0; k < COUNT_OF(cases) * COUNT_OF(eos); k++) {
        const size_t c = k / COUNT_OF(eos);
        const char *other = eos[k % COUNT_OF(eos)];
        if (other && strstr(other, "stiffened") && strstr(cases[c].text, "products"))
            continue; /* no gas, and refused beside products */
        if (strstr(cases[c].text, "detonations") || strstr(cases[c].text, "gravity"))
            continue; /* it does not rest */
        const struct variant variant = {"at rest", 1, 1.0, other, false};
        struct running *run = begin_fresh(cases[c].text, &variant);
        const int32_t last = run->gas.cells->count - 1;
        run->gas.sleepless = true;
        run->gas.parameters.regrid = 0;
        for (int n = 0; n < run->gas.layout.written; n++)
            for (int32_t i = 0; i < last; i++)
                if (!run->gas.layout.blocked || run->gas.open[i] != 0.0)
                    run->gas.u[n][i] = run->gas.u[n][last];
        for (int32_t i = 0; i < last; i++)
            run->gas.cells->material[i] = run->gas.cells->material[last];
        const uint64_t hash = simulation_hash(&run->simulation);
        step(run, 5);
        if (simulation_hash(&run->simulation) != hash)
            fail_msg("%s: a gas at rest has changed", cases[c].name);
        end(run);
    }
}

static void an_explosive_beside_an_obstacle_burns_out(void **state)
{
    (void)state;
    struct running *run = begin_fresh(charge, &plain);
    assert_true(run->gas.unburnt);
    while (run->simulation.time < 30e-6) /* the detonation takes 25 us from end to end */
        step(run, 1);
    assert_false(run->gas.unburnt);
    end(run);
}

static void threads_and_resumes_change_no_bit(void **state)
{
    (void)state;
    static const struct variant variants[] = {
        {"2 threads", 2, 1.0, NULL, false},
        {"3, 2 and 1 threads by turns", -3, 1.0, NULL, false},
        {"resumed", 2, 1.0, NULL, true},
    };
    for (size_t c = 0; c < COUNT_OF(cases); c++) {
        const uint64_t hash = hash_after(cases[c].text, &plain, &plain, cases[c].steps);
        for (size_t v = 0; v < COUNT_OF(variants); v++)
            if (hash_after(cases[c].text, &plain, &variants[v], cases[c].steps) != hash)
                fail_msg("%s, %s: other bits", cases[c].name, variants[v].name);
    }
}

/* What is there and what has left are what there was. */
static void nothing_is_lost(void **state)
{
    (void)state;
    for (size_t c = 0; c < COUNT_OF(cases); c++) {
        struct running *run = begin_fresh(cases[c].text, &plain);
        const struct simulation *s = &run->simulation;
        const struct totals start = population_totals(simulation_population(s), &run->ranks, -1);
        step(run, cases[c].steps);
        const struct totals now = population_totals(simulation_population(s), &run->ranks, -1),
                            booked = ledger_totals(&s->ledger, &run->ranks, LEDGER_CAUSES);
        const double kinetic = sqrt(2.0 * now.kinetic * start.entry[LEDGER_MASS]);
        for (int k = 0; k < LEDGER_ENTRIES; k++) {
            const bool momentum = k >= LEDGER_MOMENTUM_X && k < LEDGER_MOMENTUM_X + 3;
            const double size = k == LEDGER_MASS || k == LEDGER_ENERGY ? start.entry[k] : kinetic;
            const double lost = now.entry[k] - booked.entry[k] - start.entry[k];
            if (k == LEDGER_MASS || k == LEDGER_ENERGY || momentum)
                if (!(fabs(lost) <= 1e-12 * size))
                    fail_msg("%s: entry %d is off by %g of %g", cases[c].name, k, lost, size);
        }
        end(run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sleeping_blocks_change_no_bit),
        cmocka_unit_test(a_gas_at_rest_stays_at_rest),
        cmocka_unit_test(an_explosive_beside_an_obstacle_burns_out),
        cmocka_unit_test(threads_and_resumes_change_no_bit),
        cmocka_unit_test(nothing_is_lost),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
