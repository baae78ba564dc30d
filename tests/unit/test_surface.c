/* Surfaces of bodies and the loads on them. */
#include "model/loads.h"
#include "running.h"

#define METAL                                                                                \
    "materials:\n"                                                                           \
    "  metal:\n"                                                                             \
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: " \
    "2.17, bulk_modulus: 73 GPa}}\n"                                                         \
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.3 GPa}}\n"

static const struct variant plain = {"plain", 1, 1.0, NULL, false};

/* A body of SHAPE in DIMENSION, particles 1 mm apart. */
static struct running *body_of(const char *head, const char *shape)
{
    char text[2048];
    snprintf(text, sizeof text,
             "format: 1\n%s\nresolution: 1 mm\nsolver: mpm\n" METAL
             "bodies: {body: {material: metal, %s}}\nrun: {until: 1 s}\n",
             head, shape);
    return begin_fresh(text, &plain);
}

/* The area of the parts of SURFACE whose normal has a component along AXIS of LEAST or more. */
static double area_towards(const struct body_surface *surface, int axis, double least)
{
    double area = 0.0;
    for (int32_t e = 0; e < surface->elements; e++) {
        const struct surface_state *now = &surface->now[e];
        const double normal[3] = {now->normal.x, now->normal.y, now->normal.z};
        if (surface->element[e].cover == SURFACE_FREE && normal[axis] >= least)
            area += vec3_dot(now->area, now->normal);
    }
    return area;
}

static struct vec3 vector_area(const struct body_surface *surface)
{
    struct vec3 sum = {0.0, 0.0, 0.0};
    for (int32_t e = 0; e < surface->elements; e++)
        sum = vec3_add(sum, surface->now[e].area);
    return sum;
}

static struct body_surface surface_of(struct running *run)
{
    struct body_surface surface;
    const struct population population = population_of_particles(particles_of(&run->simulation));
    assert_success(surface_create(&run->simulation.problem->place, 0, &surface));
    surface_follow(&surface, &population, &run->ranks);
    return surface;
}

/* Forces go with the vectors of areas; the areas of elements are not smooth in 3-D. */
static void areas_are_those_of_the_shape(void **state)
{
    (void)state;
    static const double pi = 3.14159265358979;
    const struct {
        const char *head, *shape;
        double area, within, x; /* all of it; its projection along x on one side */
    } bodies[] = {
        {"dimension: 1", "box: {from: [0 mm], to: [5 mm]}", 2.0, 1e-12, 1.0},
        {"dimension: 2", "box: {from: [0 mm, 0 mm], to: [20 mm, 3 mm]}", 0.046, 1e-12, 0.003},
        {"dimension: 2",
         "rotate: {shape: {box: {from: [0 mm, 0 mm], to: [20 mm, 4 mm]}}, angle: 30 deg, about: "
         "[0 mm, 0 mm]}",
         0.048, 0.01, 0.0134641},
        {"dimension: 2",
         "rotate: {shape: {box: {from: [0 mm, 0 mm], to: [20 mm, 2 mm]}}, angle: 60 deg, about: "
         "[3 mm, 0 mm]}",
         0.044, 0.01, 0.0183205},
        {"dimension: 2", "ball: {center: [0.3 mm, 0 mm], radius: 8.2 mm}", 0.0164 * pi, 0.01,
         0.0164},
        {"dimension: 3", "box: {from: [0 mm, 0 mm, 0 mm], to: [9 mm, 8 mm, 2 mm]}", 212e-6, 1e-12,
         16e-6},
        {"dimension: 3", "ball: {center: [0 mm, 0 mm, 0 mm], radius: 8 mm}", 256e-6 * pi, 0.025,
         64e-6 * pi},
        {"dimension: 3",
         "rotate: {shape: {box: {from: [0 mm, 0 mm, 0 mm], to: [12 mm, 12 mm, 3 mm]}}, angle: 30 "
         "deg, about: [0 mm, 0 mm, 0 mm], axis: y}",
         432e-6, 0.025, 12e-3 * 8.5981e-3},
        /* about an axis: a disc, and a ball, per radian */
        {"dimension: 2\ngeometry: axisymmetric", "box: {from: [0 mm, 0 mm], to: [10 mm, 2 mm]}",
         120e-6, 1e-6, 20e-6},
        {"dimension: 2\ngeometry: axisymmetric", "ball: {center: [0 mm, 0 mm], radius: 9 mm}",
         162e-6, 0.01, 40.5e-6 * pi},
    };
    for (size_t k = 0; k < COUNT_OF(bodies); k++) {
        struct running *run = body_of(bodies[k].head, bodies[k].shape);
        struct body_surface surface = surface_of(run);
        const double area = area_towards(&surface, 0, -2.0);
        double x = 0.0;
        for (int32_t e = 0; e < surface.elements; e++)
            x += surface.now[e].normal.x > 0.0 ? surface.now[e].area.x : 0.0;
        assert_near(area, bodies[k].area, bodies[k].within * bodies[k].area);
        assert_near(x, bodies[k].x, 0.01 * bodies[k].x);
        surface_free(&surface);
        end(run);
    }
}

/* Moves each particle of RUN by the map of F, columns, and a flight. */
static void deform(struct running *run, const double f[3][3], const double flight[3])
{
    const struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++) {
        double x[3];
        for (int a = 0; a < 3; a++)
            x[a] = flight[a] + f[a][0] * p->position[i][0] + f[a][1] * p->position[i][1] +
                   f[a][2] * p->position[i][2];
        memcpy(p->position[i], x, sizeof x);
    }
}

/* A sheet of one particle and a plate of three, turned by 90 degrees and stretched by 1.2. */
static void a_surface_follows_its_body(void **state)
{
    (void)state;
    static const double turned[3][3] = {{0.0, -1.0, 0.0}, {1.2, 0.0, 0.0}, {0.0, 0.0, 1.0}},
                        flight[3] = {1.0, 2.0, 0.0};
    static const char *const shapes[] = {"box: {from: [0 mm, 0 mm], to: [20 mm, 1 mm]}",
                                         "box: {from: [0 mm, 0 mm], to: [20 mm, 3 mm]}"};
    for (size_t k = 0; k < COUNT_OF(shapes); k++) {
        struct running *run = body_of("dimension: 2", shapes[k]);
        struct body_surface surface = surface_of(run);
        const struct population population =
            population_of_particles(particles_of(&run->simulation));
        deform(run, turned, flight);
        surface_follow(&surface, &population, &run->ranks);
        assert_near(area_towards(&surface, 0, 0.9), 0.024, 1e-7);
        assert_near(-vector_area(&surface).x + 1.0, 1.0, 1e-7);
        for (int32_t e = 0; e < surface.elements; e++)
            if (surface.now[e].normal.x > 0.9)
                assert_near(surface.now[e].place.x, 1.0, 1e-8);
        surface_free(&surface);
        end(run);
    }
}

/* Two bodies side by side on a floor: where they touch and where the floor is, nothing is free. */
static void what_is_covered_is_not_free(void **state)
{
    (void)state;
    static const char pair[] =
        "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: mpm\n" METAL "bodies:\n"
        "  left: {material: metal, box: {from: [0 mm, 0 mm], to: [10 mm, 4 mm]}}\n"
        "  right: {material: metal, box: {from: [10 mm, 0 mm], to: [15 mm, 9 mm]}}\n"
        "walls: {floor: {mirror: y, at: 0 mm, side: low}}\nrun: {until: 1 s}\n";
    struct running *run = begin_fresh(pair, &plain);
    struct body_surface surface = surface_of(run);
    double area[SURFACE_COVERS] = {0.0};
    for (int32_t e = 0; e < surface.elements; e++)
        area[surface.element[e].cover] += vec3_dot(surface.now[e].area, surface.now[e].normal);
    assert_near(area[SURFACE_FREE], 0.014, 1e-12);
    assert_near(area[SURFACE_AT_WALL], 0.010, 1e-12);
    assert_near(area[SURFACE_COVERED], 0.004, 1e-12);
    surface_free(&surface);
    end(run);
}

/* A plate that flies while a pressure and a traction push it, with SPH: the ledger closes, and the
 * loads deliver what they should. */
static const char pushed[] =
    "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: {sph: {method: contact}}\n" METAL
    "bodies:\n"
    "  plate: {material: metal, box: {from: [0 mm, 0 mm], to: [20 mm, 4 mm]}, velocity: [0, 50 "
    "m/s]}\n"
    "loads:\n"
    "  above: {on: plate, axis: y, between: [3 mm, 9 mm], pressure: 100 MPa}\n"
    "  pull: {on: plate, axis: y, side: low, between: [-1 mm, 1 mm], traction: [20 MPa, 10 "
    "MPa]}\n"
    "run: {until: 1 s}\n";

static void loads_push_particles_of_sph(void **state)
{
    (void)state;
    static const char *const settings[] = {NULL, "solver.sph.method=muscl",
                                           "solver.sph.method=hllc"};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const struct variant variant = {"", 1, 1.0, settings[k], false};
        struct running *run = begin_fresh(pushed, &variant);
        const struct totals start =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        while (run->simulation.time < 1e-6)
            step(run, 1);
        const double time = run->simulation.time;
        const struct totals now =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        const struct totals booked =
            ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_LOADS);
        const struct load_totals above = load_record_totals(&run->simulation.load[0], &run->ranks),
                                 pull = load_record_totals(&run->simulation.load[1], &run->ranks);
        assert_near(above.expected[1], -100e6 * 0.020 * time, 1e-2 * 100e6 * 0.020 * time);
        assert_near(pull.expected[0], 20e6 * 0.020 * time, 1e-2 * 20e6 * 0.020 * time);
        assert_near(pull.expected[1], 10e6 * 0.020 * time, 1e-2 * 10e6 * 0.020 * time);
        assert_near(load_deviation(&above), 0.0, 1e-12);
        assert_near(load_deviation(&pull), 0.0, 1e-12);
        assert_near(booked.entry[LEDGER_MOMENTUM_Y], above.delivered[1] + pull.delivered[1],
                    1e-12 * fabs(above.delivered[1]));
        /* hllc does not conserve at free surfaces, whatever pushes */
        const double conserved = k < 2 ? 1e-12 : (double)INFINITY;
        assert_near(now.entry[LEDGER_MOMENTUM_Y] - booked.entry[LEDGER_MOMENTUM_Y],
                    start.entry[LEDGER_MOMENTUM_Y], conserved * now.momentum_scale);
        assert_near(now.entry[LEDGER_ENERGY] - booked.entry[LEDGER_ENERGY],
                    start.entry[LEDGER_ENERGY], conserved * now.entry[LEDGER_ENERGY]);
        end(run);
    }
}

static const char blasted[] =
    "format: 1\ndimension: 2\nresolution: 5 mm\nsolver: mpm\n" METAL "bodies:\n"
    "  plate: {material: metal, rotate: {shape: {box: {from: [0 m, 0 m], to: [0.1 m, 0.02 m]}}, "
    "angle: 30 deg, about: [0 m, 0 m]}}\n"
    "loads: {blast: {on: plate, blast: {mass: 1 kg, at: [0 m, 1.1 m], time: -0.6 ms}}}\n"
    "run: {until: 1 s}\n";

static uint64_t hash_of(const struct variant *variant)
{
    struct running *run = begin_fresh(blasted, variant->resumed ? &plain : variant);
    step(run, 20);
    if (variant->resumed)
        run = resume(run, blasted, variant);
    step(run, 20);
    const struct load_totals load = load_record_totals(&run->simulation.load[0], &run->ranks);
    uint64_t bits;
    memcpy(&bits, &load.delivered[1], sizeof bits);
    assert_true(load.delivered[1] < 0.0);
    assert_near(load_deviation(&load), 0.0, 1e-10);
    bits += particles_hash(particles_of(&run->simulation));
    end(run);
    return bits;
}

static void bits_do_not_depend_on_threads_storage_or_a_resume(void **state)
{
    (void)state;
    static const char *const solvers[] = {"solver=mpm", "solver=sph"};
    for (size_t k = 0; k < COUNT_OF(solvers); k++) {
        const struct variant one = {"plain", 1, 1.0, solvers[k], false},
                             others[] = {{"three threads", 3, 1.0, solvers[k], false},
                                         {"other storage", 2, 1.7, solvers[k], false}};
        const uint64_t hash = hash_of(&one);
        for (size_t v = 0; v < COUNT_OF(others); v++)
            assert_true(hash_of(&others[v]) == hash);
    }
    assert_true(hash_of(&plain) == hash_of(&(struct variant){"resumed", 1, 1.0, NULL, true}));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_are_those_of_the_shape),
        cmocka_unit_test(a_surface_follows_its_body),
        cmocka_unit_test(what_is_covered_is_not_free),
        cmocka_unit_test(loads_push_particles_of_sph),
        cmocka_unit_test(bits_do_not_depend_on_threads_storage_or_a_resume),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
