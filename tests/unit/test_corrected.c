/* SPH with corrected kernel gradients, `hllc` and `monaghan`: the same bits for any threads,
 * storage, rows and after a resume; what corrected gradients must do exactly; what is conserved;
 * frozen ends. */
#include "populations.h"
#include "running.h"

#if defined(BOLIDE_SANITIZE)
enum { STEPS = 12 };
#else
enum { STEPS = 50 };
#endif

#define MATERIALS                                                                             \
    "materials:\n"                                                                            \
    "  gas: {eos: {ideal-gas: {density: 1500 kg/m^3, gamma: 3}}}\n"                           \
    "  aluminium:\n"                                                                          \
    "    eos: {grueneisen-eta: {density: 2785 kg/m^3, sound: 5328 m/s, slope: 1.338, gamma: " \
    "2}}\n"                                                                                   \
    "    strength: {perfect-plastic: {shear_modulus: 27.6 GPa, yield: 0.3 GPa}}\n"            \
    "  copper:\n"                                                                             \
    "    eos: {grueneisen-eta: {density: 8930 kg/m^3, sound: 3940 m/s, slope: 1.49, gamma: "  \
    "2}}\n"                                                                                   \
    "    strength: {perfect-plastic: {shear_modulus: 45 GPa, yield: 0.09 GPa}}\n"
#define ONE_OF_MANY(options) "resolution: 1 mm\nrun: {until: 1 s}\nsolver: {sph: {" options "}}\n"

/* Copper runs into aluminium before a wall; waves run out of the copper. */
static const char line_case[] =
    "format: 1\ndimension: 1\n" ONE_OF_MANY("method: {hllc: {reconstruction: all}}") MATERIALS
    "bodies:\n"
    "  end: {material: copper, velocity: [300 m/s], box: {from: [-33 mm], to: [-30 mm]}, frozen: "
    "yes}\n"
    "  striker: {material: copper, velocity: [300 m/s], box: {from: [-30 mm], to: [0 mm]}}\n"
    "  target: {material: aluminium, box: {from: [0 mm], to: [15 mm]}}\n"
    "walls:\n"
    "  wall: {mirror: x, at: 15 mm, side: high}\n";

/* A block strikes another in a corner of mirrors, with a grain in it. */
#define PLANE(options)                                                                        \
    "format: 1\ndimension: 2\n" ONE_OF_MANY(options) MATERIALS                                \
        "bodies:\n"                                                                           \
        "  striker: {material: copper, box: {from: [-12 mm, 3 mm], to: [0 mm, 18 mm]}, "      \
        "velocity: [600 m/s, -200 m/s]}\n"                                                    \
        "  target: {material: aluminium, box: {from: [0 mm, 0 mm], to: [16 mm, 24 mm]}, "     \
        "velocity: [0 m/s, 100 m/s]}\n"                                                       \
        "  grain: {material: copper, ball: {center: [7 mm, 10 mm], radius: 3 mm}, replaces: " \
        "target}\n"                                                                           \
        "walls:\n"                                                                            \
        "  floor: {mirror: y, at: -1 mm, side: low}\n"                                        \
        "  back: {mirror: x, at: 17 mm, side: high}\n"

static const struct variant base = {"base", 1, 1.0, NULL, false};
static const struct variant variants[] = {
    {"2 threads", 2, 1.0, NULL, false},
    {"3 threads, large cells", 3, 3.0, NULL, false},
    {"small cells", 1, 0.37, NULL, false},
    {"thin skin", 1, 1.0, "solver.sph.skin=0.002", false},
    {"thick skin", 1, 1.0, "solver.sph.skin=0.6", false},
    {"rows of every step", 1, 1.0, "solver.sph.rebuild=1", false},
    {"resumed, other cells and threads", 2, 1.7, NULL, true},
};

static void judge(const char *text)
{
    uint64_t wanted = hash_after(text, &base, &base, STEPS);
    for (size_t k = 0; k < COUNT_OF(variants); k++) {
        uint64_t hash = hash_after(text, &base, &variants[k], STEPS);
        if (hash != wanted)
            print_error("%s: %016llx\n", variants[k].name, (unsigned long long)hash);
        assert_true(hash == wanted);
    }
}

static void two_metals_on_a_line_have_one_hash(void **state)
{
    (void)state;
    judge(line_case);
}

static void two_metals_in_the_plane_have_one_hash(void **state)
{
    (void)state;
    judge(PLANE("method: hllc"));
    judge(PLANE("method: {hllc: {continuity: mass}}"));
    judge(PLANE("method: {hllc: {correction: symmetric, reconstruction: velocity}}"));
    judge(PLANE("method: {monaghan: {pair_stress: product}}"));
}

/* Free surfaces, corners and a disturbed lattice included. */
static void linear_velocities_have_their_gradient_exactly(void **state)
{
    (void)state;
    const char *const texts[] = {line_case, PLANE("method: hllc")};
    for (int dimension = 1; dimension <= 2; dimension++) {
        struct running *run = begin_fresh(texts[dimension - 1], &base);
        struct particles *p = particles_of(&run->simulation);
        struct dice dice = {7};
        double gradient[3][3];
        for (int a = 0; a < dimension; a++)
            for (int b = 0; b < dimension; b++)
                gradient[a][b] = dice_between(&dice, -1e3, 1e3);
        for (int32_t i = 0; i < p->count; i++)
            for (int a = 0; a < dimension; a++)
                p->position[i][a] += dice_between(&dice, -1e-4, 1e-4);
        for (int32_t i = 0; i < p->count; i++)
            for (int a = 0; a < dimension; a++) {
                p->velocity[i][a] = 100.0;
                for (int b = 0; b < dimension; b++)
                    p->velocity[i][a] += gradient[a][b] * p->position[i][b];
            }
        for (int axis = 0; axis < 3; axis++) /* images would not go on with it */
            problem_of(&run->simulation)->images.low[axis] =
                problem_of(&run->simulation)->images.high[axis] = NAN;
        assert_success(run->solver->prepare(&run->sph, &run->simulation, &run->limit));
        double(*strain)[6] = particles_field(p, "strain_rate"),
        (*spin)[3] = particles_field(p, "spin");
        for (int32_t i = 0; i < p->count; i++) {
            assert_near(strain[i][0], gradient[0][0], 1e-7);
            if (dimension < 2)
                continue;
            assert_near(strain[i][1], gradient[1][1], 1e-7);
            assert_near(strain[i][3], 0.5 * (gradient[0][1] + gradient[1][0]), 1e-7);
            assert_near(spin[i][2], 0.5 * (gradient[1][0] - gradient[0][1]), 1e-7);
        }
        end(run);
    }
}

struct drift {
    double mass, energy, momentum;
};
static struct drift drift_of(const char *text, const char *setting)
{
    const struct variant variant = {"", 1, 1.0, setting, false};
    struct running *run = begin_fresh(text, &variant);
    const struct particles *p = particles_of(&run->simulation);
    struct totals start = population_totals(population_of_particles(p), &run->ranks, -1);
    step(run, STEPS);
    struct totals now = population_totals(population_of_particles(p), &run->ranks, -1);
    struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    struct drift drift = {0.0, 0.0, 0.0};
    for (int k = 0; k < LEDGER_ENTRIES; k++) {
        double change = now.entry[k] - booked.entry[k] - start.entry[k];
        if (k == LEDGER_MASS)
            drift.mass = change;
        else if (k == LEDGER_ENERGY)
            drift.energy = change / start.entry[k];
        else if (k <= LEDGER_MOMENTUM_Z)
            drift.momentum = maximum(drift.momentum, fabs(change) / now.momentum_scale);
    }
    end(run);
    return drift;
}

/* Energy to what the step leaves; with the source's matrix of one side neither. */
static void symmetric_correction_conserves(void **state)
{
    (void)state;
    const char *const texts[] = {line_case, PLANE("method: hllc")};
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        struct drift symmetric = drift_of(texts[k], "solver.sph.method.hllc.correction=symmetric");
        struct drift own = drift_of(texts[k], "solver.sph.method.hllc.correction=own");
        print_message("energy %.2g, momentum %.2g; own %.2g, %.2g\n", symmetric.energy,
                      symmetric.momentum, own.energy, own.momentum);
        assert_true(symmetric.mass == 0.0 && own.mass == 0.0);
        assert_true(symmetric.momentum < 1e-12);
        assert_true(fabs(symmetric.energy) < 1e-3);
    }
}

/* What is frozen moves on as it was, whatever strikes it. */
static void a_frozen_body_keeps_its_state(void **state)
{
    (void)state;
    static const char *const methods[] = {"solver.sph.method=hllc", "solver.sph.method=muscl",
                                          "solver.sph.method=contact",
                                          "solver.sph.method=standard"};
    const char *text =
        "format: 1\ndimension: 2\nresolution: 1 mm\nrun: {until: 1 s}\nsolver: {sph: "
        "{}}\n" MATERIALS "bodies:\n"
        "  end: {material: aluminium, velocity: [100 m/s, 20 m/s], stress: [-150 MPa, 75 MPa, 75 "
        "MPa, 0 MPa], box: {from: [0 mm, 0 mm], to: [4 mm, 8 mm]}, frozen: yes}\n"
        "  striker: {material: copper, velocity: [20 m/s, 0 m/s], box: {from: [4 mm, 0 mm], to: "
        "[9 mm, 8 mm]}}\n";
    for (size_t k = 0; k < COUNT_OF(methods); k++) {
        const struct variant variant = {"", 1, 1.0, methods[k], false};
        struct running *run = begin_fresh(text, &variant);
        struct particles *p = particles_of(&run->simulation);
        struct totals start = population_totals(population_of_particles(p), &run->ranks, 0);
        step(run, STEPS);
        struct totals now = population_totals(population_of_particles(p), &run->ranks, 0);
        assert_true(now.kinetic == start.kinetic && now.internal == start.internal);
        for (int32_t i = 0; i < p->count; i++) {
            if (p->body[i] != 0)
                continue;
            assert_true(p->velocity[i][0] == 100.0 && p->velocity[i][1] == 20.0);
            assert_close(p->density[i], 2785.0, 1e-15);
            assert_close(p->deviator[i][0], -150e6, 1e-14);
            assert_true(p->plastic_strain[i] == 0.0);
            double x = p->position[i][0] - 100.0 * run->simulation.time;
            assert_near(x - floor(x * 1e3) * 1e-3, 0.5e-3, 1e-12);
            if (run->sph.scheme != &muscl_scheme)
                continue;
            const struct muscl_kind kind = muscl_kind_of(&run->sph); /* no more half a step ahead */
            const double *record = run->sph.record + (size_t)i * (size_t)muscl_stride(kind);
            assert_true(record[record_velocity(2)] == 100.0 &&
                        record[muscl_next(kind, 0)] == 100.0);
            assert_true(record[record_stress(2)] == p->deviator[i][0] - p->pressure[i]);
        }
        struct totals pistons = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_PISTONS);
        assert_true(pistons.entry[LEDGER_MOMENTUM_X] > 0.0);
        end(run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_metals_on_a_line_have_one_hash),
        cmocka_unit_test(two_metals_in_the_plane_have_one_hash),
        cmocka_unit_test(linear_velocities_have_their_gradient_exactly),
        cmocka_unit_test(symmetric_correction_conserves),
        cmocka_unit_test(a_frozen_body_keeps_its_state),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
