/* The material point method step by step: the same bits whatever the threads, the storage, and
 * after a resume; what the steps keep; and what it refuses. */
#include "populations.h"
#include "running.h"

#if defined(BOLIDE_SANITIZE)
enum { STEPS = 16 };
#else
enum { STEPS = 60 };
#endif

#define MATERIALS                                                                            \
    "materials:\n"                                                                           \
    "  gas: {eos: {ideal-gas: {density: 1500 kg/m^3, gamma: 3}}}\n"                          \
    "  aluminium:\n"                                                                         \
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: " \
    "2.17, bulk_modulus: 73 GPa}}\n"                                                         \
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.4 GPa}}\n"

/* A hot gas beside a plate that flies into another, in a corner of walls. */
static const char plane_case[] =
    "format: 1\ntitle: A gas and two plates\ndimension: 2\nresolution: 1 mm\n"
    "solver: {mpm: {cell: 2 mm}}\n" MATERIALS "bodies:\n"
    "  charge: {material: gas, box: {from: [-20 mm, 0 mm], to: [0 mm, 22 mm]}, pressure: 5 GPa}\n"
    "  flyer: {material: aluminium, box: {from: [0 mm, 0 mm], to: [7 mm, 22 mm]}, velocity: "
    "[600 m/s, -300 m/s]}\n"
    "  plate: {material: aluminium, box: {from: [9 mm, 0 mm], to: [31 mm, 30 mm]}}\n"
    "walls:\n"
    "  floor: {mirror: y, at: 0 mm, side: low}\n"
    "  left: {mirror: x, at: -20 mm, side: low}\n"
    "  right: {mirror: x, at: 32 mm, side: high}\n"
    "run: {until: 1 s}\n";

static const char space_case[] =
    "format: 1\ntitle: Two blocks\ndimension: 3\nresolution: 1 mm\n"
    "solver: {mpm: {cell: 2 mm}}\n" MATERIALS "bodies:\n"
    "  flyer: {material: aluminium, box: {from: [-7 mm, 1 mm, 0 mm], to: [0 mm, 8 mm, 10 mm]}, "
    "velocity: [900 m/s, -300 m/s, -200 m/s]}\n"
    "  plate: {material: aluminium, box: {from: [1 mm, 0 mm, 0 mm], to: [9 mm, 13 mm, 13 mm]}}\n"
    "walls:\n"
    "  floor: {mirror: z, at: 0 mm, side: low}\n"
    "run: {until: 1 s}\n";

/* Two rods slip along each other while a third body sticks to one of them, and a fourth strikes; it
 * has friction. */
static const char contact_case[] =
    "format: 1\ntitle: Contacts\ndimension: 2\nresolution: 1 mm\n"
    "solver: {mpm: {cell: 2 mm, courant: 0.3}}\n" MATERIALS "bodies:\n"
    "  rod: {material: aluminium, box: {from: [0 mm, 0 mm], to: [30 mm, 8 mm]}, velocity: [-300 "
    "m/s, 0 m/s]}\n"
    "  slab: {material: aluminium, box: {from: [0 mm, 8 mm], to: [30 mm, 15 mm]}, velocity: [300 "
    "m/s, -100 m/s]}\n"
    "  cap: {material: gas, box: {from: [30 mm, 8 mm], to: [36 mm, 15 mm]}, velocity: [300 m/s, "
    "-100 m/s], density: 1500 kg/m^3, pressure: 0.5 GPa}\n"
    "  ball: {material: aluminium, ball: {center: [14 mm, 22.6 mm], radius: 7 mm}, velocity: [0 "
    "m/s, -400 m/s]}\n"
    "contacts:\n"
    "  slip: {between: [rod, slab], shear: slip, tension: none}\n"
    "  rub: {between: [ball, slab], shear: slip, tension: none, friction: 0.3, normal: first, "
    "touch: surfaces}\n"
    "walls:\n"
    "  floor: {mirror: y, at: 0 mm, side: low}\n"
    "run: {until: 1 s}\n";

static const char line_case[] =
    "format: 1\ntitle: Two gases\ndimension: 1\nresolution: 1 mm\n"
    "solver: {mpm: {shape: linear, cell: 2 mm, courant: 0.1}}\n" MATERIALS "bodies:\n"
    "  left: {material: gas, box: {from: [0 mm], to: [200 mm]}, pressure: 5 GPa}\n"
    "  right: {material: gas, box: {from: [200 mm], to: [400 mm]}, density: 200 kg/m^3, pressure: "
    "1 GPa}\n"
    "walls:\n"
    "  low: {mirror: x, at: 0 mm, side: low}\n"
    "  high: {mirror: x, at: 400 mm, side: high}\n"
    "run: {until: 1 s}\n";

static void check_bits(const char *text, const char *const *settings, int count)
{
    for (int k = 0; k < count; k++) {
        const struct variant variants[] = {{"one thread", 1, 1.0, settings[k], false},
                                           {"three threads", 3, 1.0, settings[k], false},
                                           {"by turns", -3, 1.0, settings[k], false},
                                           {"other storage", 2, 1.7, settings[k], false},
                                           {"resumed", 1, 1.0, settings[k], true}};
        const uint64_t hash = hash_after(text, &variants[0], &variants[0], STEPS);
        for (size_t v = 1; v < COUNT_OF(variants); v++)
            if (hash_after(text, &variants[0], &variants[v], STEPS) != hash)
                fail_msg("%s, %s: other bits", settings[k], variants[v].name);
    }
}

static void bits_do_not_depend_on_threads_storage_or_a_resume(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "solver.mpm.scheme=musl", "solver.mpm.scheme=usl",    "solver.mpm.scheme=usf",
        "solver.mpm.shape=gimp",  "solver.mpm.transfer=apic", "solver.mpm.shear_damping=0.1",
        "solver.mpm.order=2"};
    static const char *const few[] = {"solver.mpm.shape=linear", "solver.mpm.shape=cubic"};
    check_bits(plane_case, settings, COUNT_OF(settings));
    check_bits(space_case, few, COUNT_OF(few));
    check_bits(contact_case, few, COUNT_OF(few));
}

/* Mass, momentum and angular momentum less what the ledger booked, against their scales. */
static void check_kept(struct running *run, const struct totals *start, double tolerance)
{
    const struct totals now =
        population_totals(simulation_population(&run->simulation), &run->ranks, -1);
    const struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    for (int e = LEDGER_MASS; e <= LEDGER_MOMENTUM_Z; e++) {
        const double scale = e == LEDGER_MASS ? start->entry[e] : now.momentum_scale;
        const double change = now.entry[e] - booked.entry[e] - start->entry[e];
        if (fabs(change) > tolerance * scale)
            fail_msg("entry %d: %g of %g", e, change, scale);
    }
}

static void mass_and_momentum_stay_in_contacts(void **state)
{
    (void)state;
    static const char *const settings[] = {"solver.mpm.shape=linear", "solver.mpm.shape=cubic",
                                           "solver.mpm.scheme=usf", "solver.mpm.order=2"};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant variant = {"", 1, 1.0, settings[k], false};
        struct running *run = begin_fresh(contact_case, &variant);
        assert_int_equal(run->mpm.layers, 4);
        const struct totals start =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        step(run, STEPS);
        check_kept(run, &start, 1e-13);
        end(run);
    }
}

static void mass_and_momentum_stay_but_for_what_walls_push(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "solver.mpm.shape=linear",    "solver.mpm.shape=gimp",
        "solver.mpm.shape=quadratic", "solver.mpm.shape=cubic",
        "solver.mpm.scheme=usl",      "solver.mpm.scheme=usf",
        "solver.mpm.flip=0.5",        "solver.mpm.shear_damping=0.1",
        "solver.mpm.order=3",         "solver.mpm={cell: 2 mm, order: 2, flip: 0.5}"};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant variant = {"", 1, 1.0, settings[k], false};
        struct running *run = begin_fresh(plane_case, &variant);
        const struct totals start =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        step(run, STEPS);
        check_kept(run, &start, 1e-13);
        end(run);
    }
}

/* A step with a shock everywhere, against one with none: motion becomes heat, and nothing else. */
static void mixing_in_shocks_turns_motion_into_heat(void **state)
{
    (void)state;
    static const char *const texts[] = {plane_case, space_case, contact_case};
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        struct totals after[2];
        for (int shocked = 0; shocked < 2; shocked++) {
            const struct variant variant = {"", 2, 1.0, NULL, false};
            struct running *run = begin_fresh(texts[k], &variant);
            step(run, STEPS);
            const struct particles *p = particles_of(&run->simulation);
            double *shock = mpm_fields_of(&run->mpm).shock;
            const struct totals before =
                                    population_totals(population_of_particles(p), &run->ranks, -1),
                                booked = ledger_totals(&run->simulation.ledger, &run->ranks,
                                                       LEDGER_CAUSES);
            for (int32_t i = 0; i < p->count; i++)
                shock[i] = shocked;
            step(run, 1);
            const struct totals more =
                ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
            after[shocked] = population_totals(population_of_particles(p), &run->ranks, -1);
            for (int e = LEDGER_MOMENTUM_X; e <= LEDGER_MOMENTUM_Z; e++)
                assert_near(after[shocked].entry[e] - more.entry[e],
                            before.entry[e] - booked.entry[e], 1e-14 * before.momentum_scale);
            assert_near(after[shocked].entry[LEDGER_ENERGY] - more.entry[LEDGER_ENERGY],
                        before.entry[LEDGER_ENERGY] - booked.entry[LEDGER_ENERGY],
                        1e-14 * before.entry[LEDGER_ENERGY]);
            end(run);
        }
        assert_true(after[1].kinetic < after[0].kinetic);
    }
}

/* A dense, cold and a hot gas at the same pressure and at rest: only if they are one material do
 * the nodes that both reach pass energy from one to the other. */
static void mixing_in_shocks_does_not_heat_across_materials(void **state)
{
    (void)state;
    static const char text[] =
        "format: 1\ndimension: 1\nresolution: 1 mm\nsolver: {mpm: {cell: 2 mm}}\nmaterials:\n"
        "  cold: {eos: {ideal-gas: {density: 1500 kg/m^3, gamma: 3}}}\n"
        "  hot: {eos: {ideal-gas: {density: 1500 kg/m^3, gamma: 3}}}\n"
        "bodies:\n"
        "  low: {material: cold, box: {from: [-20 mm], to: [0 mm]}, density: 1500 kg/m^3, "
        "pressure: 1 GPa}\n"
        "  high: {material: MATERIAL, box: {from: [0 mm], to: [20 mm]}, density: 150 kg/m^3, "
        "pressure: 1 GPa}\n"
        "run: {until: 1 s}\n";
    for (int same = 0; same < 2; same++) {
        char with[sizeof text + 16];
        const char *at = strstr(text, "MATERIAL");
        snprintf(with, sizeof with, "%.*s%s%s", (int)(at - text), text, same ? "cold" : "hot",
                 at + strlen("MATERIAL"));
        const struct variant variant = {"", 1, 1.0, NULL, false};
        struct running *run = begin_fresh(with, &variant);
        struct particles *p = particles_of(&run->simulation);
        double *shock = mpm_fields_of(&run->mpm).shock;
        for (int32_t i = 0; i < p->count; i++)
            shock[i] = 1.0;
        const struct totals before = population_totals(population_of_particles(p), &run->ranks, 0);
        assert_success(run->solver->prepare(&run->mpm, &run->simulation, &run->limit));
        mpm_mix_shocks(&run->mpm, &run->simulation, run->limit.dt);
        const struct totals now = population_totals(population_of_particles(p), &run->ranks, 0);
        const double warmer = now.internal / before.internal - 1.0;
        assert_true(same ? warmer > 1e-3 : fabs(warmer) < 1e-14);
        end(run);
    }
}

/* Energy at the end over that at the start. */
static double energy_after(const char *setting, int steps)
{
    const struct variant variant = {"", 1, 1.0, setting, false};
    struct running *run = begin_fresh(line_case, &variant);
    const struct totals start =
        population_totals(simulation_population(&run->simulation), &run->ranks, -1);
    step(run, steps);
    const struct totals now =
        population_totals(simulation_population(&run->simulation), &run->ranks, -1);
    end(run);
    return now.entry[LEDGER_ENERGY] / start.entry[LEDGER_ENERGY];
}

static void usf_gains_energy_and_usl_loses_more_than_musl(void **state)
{
    (void)state;
#define BY_WORK "solver.mpm={cell: 2 mm, courant: 0.1, energy: work, "
    const double usf = energy_after(BY_WORK "shape: linear, scheme: usf}", 800),
                 musl = energy_after(BY_WORK "shape: linear, scheme: musl}", 800),
                 usl = energy_after(BY_WORK "shape: linear, scheme: usl}", 800),
                 smooth = energy_after(BY_WORK "shape: quadratic}", 800);
#undef BY_WORK
    assert_true(usf > 1.0 && 1.0 > musl && musl > usl);
    assert_true(fabs(smooth - 1.0) < 0.2 * fabs(musl - 1.0));
}

/* A gas drives a ring that a plate strikes, about an axis. */
static const char axis_case[] =
    "format: 1\ntitle: A ring\ndimension: 2\ngeometry: axisymmetric\nresolution: 1 mm\n"
    "solver: {mpm: {cell: 2 mm}}\n" MATERIALS "bodies:\n"
    "  charge: {material: gas, box: {from: [0 mm, 0 mm], to: [9 mm, 14 mm]}, pressure: 3 GPa}\n"
    "  ring: {material: aluminium, box: {from: [9 mm, 0 mm], to: [16 mm, 14 mm]}}\n"
    "  plate: {material: aluminium, box: {from: [0 mm, 14 mm], to: [13 mm, 19 mm]}, velocity: "
    "[0 m/s, -700 m/s]}\n"
    "contacts: {sides: {between: [ring, plate], shear: slip, friction: 0.2, tension: none}}\n"
    "walls: {floor: {mirror: y, at: 0 mm, side: low}}\n"
    "run: {until: 1 s}\n";

/* Every scheme, and every shape but the linear one (and about an axis gimp), with walls, contacts,
 * friction, an ambient pressure; in the plane gravity; and damping where there is no contact: of
 * both at one node each works as if alone. */
static void energy_is_conserved(void **state)
{
    (void)state;
    static const char *const texts[] = {space_case, contact_case, axis_case, plane_case};
    static const char *const settings[] = {"solver.mpm.shape=quadratic",
                                           "solver.mpm.shape=cubic",
                                           "solver.mpm.scheme=usl",
                                           "solver.mpm.scheme=usf",
                                           "solver.mpm.shock_mixing=0",
                                           "solver.mpm.viscosity_unresolved=0",
                                           "solver.mpm.gauge_pressure=0.3 GPa",
                                           "solver.mpm.shape=gimp",
                                           "solver.mpm.quadrature=particles",
                                           "gravity=[0 m/s^2, -1e7 m/s^2]",
                                           "solver.mpm.shear_damping=0.1"};
    static const size_t counts[] = {9, 10, 7, 11};
    for (size_t k = 0; k < COUNT_OF(texts); k++)
        for (size_t s = 0; s < counts[k]; s++) {
            const struct variant variant = {"", 2, 1.0, settings[s], false};
            struct running *run = begin_fresh(texts[k], &variant);
            const struct totals start =
                population_totals(simulation_population(&run->simulation), &run->ranks, -1);
            step(run, STEPS);
            const struct totals now = population_totals(simulation_population(&run->simulation),
                                                        &run->ranks, -1),
                                booked = ledger_totals(&run->simulation.ledger, &run->ranks,
                                                       LEDGER_CAUSES);
            const double drift =
                now.entry[LEDGER_ENERGY] - booked.entry[LEDGER_ENERGY] - start.entry[LEDGER_ENERGY];
            if (!(fabs(drift) < 1e-12 * start.entry[LEDGER_ENERGY]))
                fail_msg("case %zu, %s: %g of %g", k, settings[s], drift,
                         start.entry[LEDGER_ENERGY]);
            end(run);
        }
}

static void a_wall_between_planes_of_the_grid_is_a_mistake(void **state)
{
    (void)state;
    const struct variant variant = {"", 1, 1.0, "walls.floor.at=-0.7 mm", false};
    struct running *run = open_case(plane_case, &variant);
    struct error *error =
        run->solver->create(&run->mpm, &run->simulation, run->input->solver.value);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_non_null(strstr(error_message(error, 0), "walls"));
    assert_non_null(strstr(error_message(error, 0), "-0.002 m and 0 m"));
    error_free(error);
    end(run);
}

/* A bar that sounds softly, and whose last particle is hardly beyond a node: by a hundredth of a
 * cell. */
static const char sounding[] =
    "format: 1\ndimension: 1\nresolution: 1 mm\nsolver: {mpm: {cell: 2 mm}}\n" MATERIALS "bodies:\n"
    "  bar: {material: aluminium, box: {from: [0.52 mm], to: [20.52 mm]}, velocity: "
    "[sin(0.2*x/(1 mm))*1 "
    "mm/s]}\n"
    "run: {until: 1 s}\n";

static void a_node_of_next_to_no_mass_is_stable(void **state)
{
    (void)state;
    static const char *const settings[] = {"solver.mpm.shape=linear", "solver.mpm.transfer=apic",
                                           "solver.mpm.transfer=tpic"};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant variant = {"", 1, 1.0, settings[k], false};
        struct running *run = begin_fresh(sounding, &variant);
        const struct totals start =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        step(run, 100);
        const struct totals now =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        assert_true(now.entry[LEDGER_ENERGY] <= start.entry[LEDGER_ENERGY] * (1.0 + 1e-12));
        end(run);
    }
}

static void affine_transfers_want_functions_whose_slopes_do_not_jump(void **state)
{
    (void)state;
    static const char *const settings[] = {"solver.mpm.transfer=apic", "solver.mpm.transfer=tpic"};
    for (int k = 0; k < 2; k++) {
        const struct variant variant = {"", 1, 1.0, settings[k], false};
        struct running *run = open_case(sounding, &variant);
        struct mpm_parameters parameters;
        memcpy(&parameters, run->input->solver.value, sizeof parameters);
        parameters.shape = SHAPE_LINEAR;
        struct error *error = refusal_of(run, &parameters);
        assert_non_null(error);
        assert_int_equal(error_kind(error), ERROR_INPUT);
        assert_non_null(strstr(error_message(error, 0), "unstable with `shape: linear`"));
        error_free(error);
        end(run);
        run = open_case(sounding, &variant);
        parameters.shape = SHAPE_QUADRATIC;
        parameters.shock_mixing = 3.0;
        error = refusal_of(run, &parameters);
        assert_non_null(error);
        assert_non_null(strstr(error_message(error, 0), "mpm.shock_mixing"));
        error_free(error);
        end(run);
    }
}

/* A block that flies at another, half a cell away. */
static void surfaces_that_do_not_meet_are_left_alone(void **state)
{
    (void)state;
    static const char blocks[] =
        "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: mpm\n" MATERIALS "bodies:\n"
        "  flyer: {material: aluminium, box: {from: [-9 mm, 0 mm], to: [-1 mm, 8 mm]}, velocity: "
        "[100 m/s, 0 m/s]}\n"
        "  plate: {material: aluminium, box: {from: [0 mm, 0 mm], to: [8 mm, 8 mm]}}\n"
        "contacts: {faces: {between: [flyer, plate], tension: none}}\n"
        "run: {until: 1 s}\n";
    static const char *const settings[] = {"contacts.faces.touch=nodes",
                                           "contacts.faces.touch=surfaces", NULL};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant variant = {"", 1, 1.0, settings[k], false};
        struct running *run = begin_fresh(blocks, &variant);
        step(run, 2);
        const double moved =
            population_totals(simulation_population(&run->simulation), &run->ranks, 1)
                .entry[LEDGER_MOMENTUM_X];
        assert_true(k ? moved == 0.0 : moved > 0.0);
        while (run->simulation.time < 1.2e-5) /* past the time to meet, 1e-5 s */
            step(run, 1);
        assert_true(population_totals(simulation_population(&run->simulation), &run->ranks, 1)
                        .entry[LEDGER_MOMENTUM_X] > 0.0);
        end(run);
    }
}

/* The same block and a plate of one particle a cell, or of two. */
static void surfaces_meet_where_they_are_however_coarse_the_particles(void **state)
{
    (void)state;
    static const char blocks[] =
        "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: {mpm: {cell: 2 mm}}\n" MATERIALS
        "bodies:\n"
        "  flyer: {material: aluminium, box: {from: [-9 mm, 0 mm], to: [-1 mm, 8 mm]}, velocity: "
        "[100 m/s, 0 m/s]}\n"
        "  plate: {material: aluminium, box: {from: [0 mm, 0 mm], to: [8 mm, 8 mm]}}\n"
        "contacts: {faces: {between: [flyer, plate], tension: none, touch: surfaces}}\n"
        "run: {until: 1 s}\n";
    static const char *const settings[] = {"bodies.plate.resolution=1 mm",
                                           "bodies.plate.resolution=2 mm",
                                           "bodies.flyer.resolution=2 mm"};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant variant = {"", 1, 1.0, settings[k], false};
        struct running *run = begin_fresh(blocks, &variant);
        double moved = 0.0;
        while (moved == 0.0) {
            step(run, 1);
            moved = population_totals(simulation_population(&run->simulation), &run->ranks, 1)
                        .entry[LEDGER_MOMENTUM_X];
        }
        /* they touch at 1e-5 s; a twentieth of a cell takes 1e-6 s */
        assert_near(run->simulation.time, 1e-5, 1e-6);
        end(run);
    }
}

/* Inside a plate of one particle a cell its mass has no slope but rounding, which is no normal. */
static void a_coarse_plate_pushes_along_its_normal(void **state)
{
    (void)state;
    static const char blocks[] =
        "format: 1\ndimension: 3\nresolution: 1 mm\nsolver: {mpm: {cell: 2 mm}}\n" MATERIALS
        "bodies:\n"
        "  block: {material: aluminium, box: {from: [-3.7 mm, 0 mm, -3.9 mm], to: [4.3 mm, 6 mm, "
        "4.1 mm]}, velocity: [500 m/s, -200 m/s, 100 m/s]}\n"
        "  plate: {material: aluminium, resolution: 2 mm, driven: yes, box: {from: [-14 mm, -6 mm, "
        "-14 mm], to: [14 mm, 0 mm, 14 mm]}}\n"
        "contacts: {faces: {between: [block, plate], shear: slip, tension: none, friction: 0, "
        "normal: second, touch: surfaces}}\n"
        "run: {until: 1 s}\n";
    const struct variant variant = {"", 1, 1.0, NULL, false};
    struct running *run = begin_fresh(blocks, &variant);
    const struct totals start =
        population_totals(simulation_population(&run->simulation), &run->ranks, 0);
    step(run, STEPS / 2);
    const struct totals now =
        population_totals(simulation_population(&run->simulation), &run->ranks, 0);
    const double pushed = now.entry[LEDGER_MOMENTUM_X + 1] - start.entry[LEDGER_MOMENTUM_X + 1];
    assert_true(pushed > 0.0);
    for (int axis = 0; axis < 3; axis += 2)
        assert_near(now.entry[LEDGER_MOMENTUM_X + axis], start.entry[LEDGER_MOMENTUM_X + axis],
                    1e-10 * pushed);
    end(run);
}

/* The momentum that a plate gets in STEPS / 2 steps from one that strikes it, both between walls
 * across x, in the geometry of SETTING. */
static double momentum_of_struck_plate(const char *setting)
{
    static const char plates[] =
        "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: {mpm: {cell: 2 mm}}\n" MATERIALS
        "bodies:\n"
        "  struck: {material: aluminium, box: {from: [0 mm, 0 mm], to: [12 mm, 20 mm]}}\n"
        "  plate:  {material: aluminium, box: {from: [0 mm, 20 mm], to: [12 mm, 40 mm]}, "
        "velocity: [0 m/s, -1 m/s]}\n"
        "contacts: {faces: {between: [struck, plate], shear: slip, tension: none}}\n"
        "walls: {inside: {mirror: x, at: 0 mm, side: low}, outside: {mirror: x, at: 12 mm, "
        "side: high}}\n"
        "run: {until: 1 s}\n";
    const struct variant variant = {"", 1, 1.0, setting, false};
    struct running *run = begin_fresh(plates, &variant);
    step(run, STEPS / 2);
    const struct totals now =
        population_totals(simulation_population(&run->simulation), &run->ranks, 0);
    const double got = -now.entry[LEDGER_MOMENTUM_X + 1];
    end(run);
    return got;
}

/* Mass per radian, which grows with the radius, has a slope where there is no surface. The limit
 * leaves room for the kinks of the mass at the axis and at the wall. */
static void plates_about_an_axis_touch_as_those_in_a_plane(void **state)
{
    (void)state;
    const double plane = momentum_of_struck_plate("geometry=plane-strain"),
                 round = momentum_of_struck_plate("geometry=axisymmetric");
    assert_true(plane > 0.0);
    assert_near(round, plane * 0.5 * 12e-3, 0.1 * plane * 0.5 * 12e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_do_not_depend_on_threads_storage_or_a_resume),
        cmocka_unit_test(surfaces_that_do_not_meet_are_left_alone),
        cmocka_unit_test(surfaces_meet_where_they_are_however_coarse_the_particles),
        cmocka_unit_test(a_coarse_plate_pushes_along_its_normal),
        cmocka_unit_test(plates_about_an_axis_touch_as_those_in_a_plane),
        cmocka_unit_test(mass_and_momentum_stay_in_contacts),
        cmocka_unit_test(mass_and_momentum_stay_but_for_what_walls_push),
        cmocka_unit_test(mixing_in_shocks_turns_motion_into_heat),
        cmocka_unit_test(mixing_in_shocks_does_not_heat_across_materials),
        cmocka_unit_test(energy_is_conserved),
        cmocka_unit_test(usf_gains_energy_and_usl_loses_more_than_musl),
        cmocka_unit_test(a_wall_between_planes_of_the_grid_is_a_mistake),
        cmocka_unit_test(a_node_of_next_to_no_mass_is_stable),
        cmocka_unit_test(affine_transfers_want_functions_whose_slopes_do_not_jump),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
