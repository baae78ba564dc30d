/* What `bolide check` tells of a mixture, of memory, and of shapes and lattices that cannot be. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "judged.h"
#include "model/generate.h"
#include "model/particles/fill.h"
#include "populations.h"
#include "run/catalogue.h"
#include "run/estimate.h"
#include "source_folder.h"
#include "sph/lanes.h"
#include "sph/scheme.h"

static const char strip[] =
    "format: 1\n"
    "dimension: 2\n"
    "resolution: d\n"
    "solver: sph\n"
    "let: {d: 10 nm, cell: 16*d, a: 2*d, b: 5.5*d, c: 10.5*d, e: 14*d}\n"
    "materials: {heavy: {library: steel-cube-parshikov}, light: {library: aluminium}}\n"
    "bodies:\n"
    "  carrier: {material: heavy, box: {from: [0, 0], to: [4*cell, cell]}}\n"
    "  inclusions:\n"
    "    material: light\n"
    "    replaces: carrier\n"
    "    repeat:\n"
    "      shape: {polygon: [[a, b], [b, a], [c, a], [e, b], [e, c], [c, e], [b, e], [a, c]]}\n"
    "      count: [4, 1]\n"
    "      step: [cell, cell]\n"
    "run: {until: 1 ns}\n";

/* Reads TEXT and what stands behind it. */
static struct error *read_text(const char *text, const char *more, struct simulation_case **input)
{
    static const char *const library[] = {materials_folder};
    const struct case_options options = {.library_paths = library, .library_count = 1};
    FILE *file = fopen("estimate.yaml", "w");
    assert_non_null(file);
    fprintf(file, "%s%s", text, more);
    fclose(file);
    return case_read("estimate.yaml", &options, &bolide_catalogue, input);
}

static void estimate_strip(const char *walls, struct estimate *estimate,
                           struct simulation_case **input)
{
    struct error *error = read_text(strip, walls, input);
    if (error)
        fail_msg("%s", error_message(error, 0));
    error = estimate_run(*input, estimate);
    if (error)
        fail_msg("%s", error_message(error, 0));
}

static void assert_about(double value, double wanted)
{
    if (!(fabs(value - wanted) <= 1e-12 * fabs(wanted)))
        fail_msg("%.15g is not %.15g", value, wanted);
}

static void a_mixture_has_a_mean_density_and_a_mass_of_each_material(void **state)
{
    (void)state;
    struct simulation_case *input;
    struct estimate estimate;
    estimate_strip("", &estimate, &input);
    const double heavy = case_body(input, 0)->start.density,
                 light = case_body(input, 1)->start.density;
    assert_true(heavy > 2.0 * light);
    assert_about(estimate.material_mass[0], heavy * 4 * 136 * 1e-16);
    assert_about(estimate.material_mass[1], light * 4 * 120 * 1e-16);
    assert_about(estimate.mean_density, (136.0 * heavy + 120.0 * light) / 256.0);
    assert_about(estimate.box.high.x, 64e-8);
    estimate_free(&estimate);
    case_free(input);
}

static void two_walls_bound_the_mean_density_of_their_axis(void **state)
{
    (void)state;
    struct simulation_case *input;
    struct estimate free_strip, walled;
    estimate_strip("", &free_strip, &input);
    case_free(input);
    estimate_strip("walls:\n"
                   "  target: {mirror: x, at: -cell, side: low}\n"
                   "  below: {mirror: y, at: -cell/2, side: low}\n"
                   "  above: {mirror: y, at: 3*cell/2, side: high}\n",
                   &walled, &input);
    assert_about(walled.mean_density, 0.5 * free_strip.mean_density);
    assert_about(walled.box.low.y, -8e-8);
    assert_true(walled.box.low.x == 0.0);
    estimate_free(&free_strip);
    estimate_free(&walled);
    case_free(input);
}

/* A gas beside a metal sets the Courant number of the metal with MPM. */
static void a_fluid_shortens_the_steps_of_solids_with_material_points(void **state)
{
    (void)state;
    static const char text[] =
        "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: mpm\nrun: {until: 1 us}\n"
        "materials:\n  metal: {library: aluminium}\n"
        "  gas: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}\n"
        "bodies:\n  block: {material: metal, box: {from: [0 mm, 0 mm], to: [8 mm, 8 mm]}}\n";
    static const char gas[] =
        "  air: {material: gas, pressure: 1 bar, box: {from: [8 mm, 0 mm], to: [16 mm, 8 mm]}}\n";
    struct simulation_case *input;
    struct estimate mixed;
    assert_success(read_text(text, gas, &input));
    assert_success(estimate_run(input, &mixed));
    assert_true(mixed.step_body == 0);
    assert_about(mixed.step * mixed.body[0].sound_long, 0.2 * 2e-3);
    estimate_free(&mixed);
    case_free(input);
}

static void assert_refused(const char *shape, const char *message)
{
    static const char head[] = "format: 1\n"
                               "dimension: 2\n"
                               "resolution: 1 mm\n"
                               "solver: sph\n"
                               "materials: {iron: {library: aluminium}}\n"
                               "run: {until: 1 ns}\n"
                               "bodies:\n"
                               "  plate: {material: iron, ";
    struct simulation_case *input;
    struct error *error = read_text(head, shape, &input);
    assert_non_null(error);
    assert_string_equal(error_message(error, 0), message);
    assert_int_equal(error_count(error), 1);
    error_free(error);
}

static void a_shape_or_lattice_that_cannot_be_is_told_in_its_place(void **state)
{
    (void)state;
    assert_refused("half_space: {point: [0, 0], normal: [1, 1]}}\n",
                   "estimate.yaml:8:27: bodies.plate.half_space: this shape is infinite: "
                   "intersect it with a bounded one");
    assert_refused("difference: [{half_space: {point: [0, 0], normal: [1, 0]}}, "
                   "{ball: {center: [0, 0], radius: 1 m}}]}\n",
                   "estimate.yaml:8:39: bodies.plate.difference: this shape is infinite: "
                   "intersect it with a bounded one");
    assert_refused(
        "polygon: [[0, 0], [1 mm, 0]]}\n",
        "estimate.yaml:8:36: bodies.plate.polygon: a polygon needs at least three points");
    assert_refused(
        "box: {from: [0, 0], to: [1 m, 1 m]}, lattice: rings}\n",
        "estimate.yaml:8:73: bodies.plate.lattice: the shape has no center: rings need a "
        "ball or shell, cut or not, or their `center`");
}

/* Bytes that a step of a square of the method takes, a particle. */
static double bytes_taken(const char *method, double *estimated)
{
    char more[400];
    snprintf(more, sizeof more,
             "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: {sph: {method: %s}}\n"
             "materials: {iron: {library: aluminium}}\nrun: {until: 1 ns}\n"
             "bodies: {plate: {material: iron, box: {from: [0, 0], to: [60 mm, 60 mm]}}}\n",
             method);
    struct simulation_case *input;
    struct simulation simulation = {0};
    struct sph sph = {0};
    struct limit limit;
    const struct ranks alone = ranks_alone();
    assert_null(read_text("", more, &input));
    const struct solver_class *class = input->solver.choice->thing;
    assert_null(simulation_create(input, &alone, 1, &simulation));
    assert_null(class->create(&sph, &simulation, input->solver.value));
    assert_null(generate_particles(&simulation, particles_of(&simulation)));
    assert_null(class->start(&sph, &simulation));
    assert_null(class->prepare(&sph, &simulation, &limit));
    const struct particles *p = particles_of(&simulation);
    const double taken =
        (double)particles_bytes(p) +
        ((double)p->scratch.size + (double)sph.place_capacity * PLACE_STRIDE * sizeof(double) +
         (double)neighbours_bytes(&sph.neighbours)) /
            p->count;
    *estimated = class->bytes(input->solver.value, 2);
    class->destroy(&sph);
    simulation_destroy(&simulation);
    case_free(input);
    return taken;
}

static void estimated_bytes_match_allocated_ones(void **state)
{
    (void)state;
    const char *const methods[] = {"contact", "muscl", "hllc", "monaghan"};
    for (size_t k = 0; k < COUNT_OF(methods); k++) {
        double estimated, taken = bytes_taken(methods[k], &estimated);
        if (!(fabs(estimated / taken - 1.0) < 0.15))
            fail_msg("%s: %.0f bytes estimated, %.0f taken", methods[k], estimated, taken);
    }
}

static const char plate[] = "format: 1\n"
                            "dimension: 2\n"
                            "resolution: 1 mm\n"
                            "materials: {metal: {library: aluminium}}\n"
                            "run: {until: 1 us}\n";

/* The one warning of the case has WORDS; NULL: there is none. */
static void expect_warning(const char *more, const char *words)
{
    struct simulation_case *input;
    struct error *error = read_text(plate, more, &input);
    if (error)
        fail_msg("%s", error_message(error, 0));
    struct findings findings;
    judged(input, &findings);
    const int count = findings_count(&findings, FINDING_DOUBTFUL);
    const char *first = count ? findings_text(&findings, FINDING_DOUBTFUL, 0) : "";
    if (count != (words != NULL))
        fail_msg("%d warnings, \"%s\", not that of \"%s\"", count, first, words ? words : "");
    if (words && !strstr(first, words))
        fail_msg("\"%s\" does not say \"%s\"", first, words);
    findings_free(&findings);
    case_free(input);
}

static void a_body_that_is_cut_unless_in_half_is_a_warning(void **state)
{
    (void)state;
    static const char axis[] = "geometry: axisymmetric\nsolver: mpm\n";
    static const char wall[] = "walls: {rear: {mirror: y, at: 10 mm, side: high}}\n";
    static const char bodies[] =
        "bodies: {plate: {material: metal, box: {from: [%d mm, 0 mm], to: [10 mm, %d mm]}}}\n";
    char text[512], box[256];
    snprintf(box, sizeof box, bodies, -20, 10);
    snprintf(text, sizeof text, "%s%s", axis, box);
    expect_warning(text, "67 % of its extent along x is left out: it is from -0.02 m to 0.01 m "
                         "and ends at the axis");
    snprintf(box, sizeof box, bodies, -10, 10);
    snprintf(text, sizeof text, "%s%s", axis, box);
    expect_warning(text, NULL);
    snprintf(box, sizeof box, bodies, 0, 40);
    snprintf(text, sizeof text, "%s%s%s", axis, wall, box);
    expect_warning(text, "75 % of its extent along y is left out: it is from 0 m to 0.04 m and "
                         "ends at the wall, y = 0.01 m");
    snprintf(box, sizeof box, bodies, 0, 20);
    snprintf(text, sizeof text, "%s%s%s", axis, wall, box);
    expect_warning(text, NULL);
}

/* Discs and balls, whole and halved by a mirror, with a square hole or without, of 4 to 12
 * particles across. */
static void a_shape_of_another_volume_than_its_particles_is_a_warning(void **state)
{
    (void)state;
    struct dice dice = {3};
    int warned = 0;
    for (int round = 0; round < 60; round++) {
        const int dimension = 2 + round % 2, half = round / 2 % 2, hole = round / 4 % 2;
        const double radius = 5.0, size = 2.0 * radius / dice_between(&dice, 4.0, 12.0);
        const double edge = dice_between(&dice, 0.5, 0.7) * radius; /* of the hole */
        char text[700];
        snprintf(text, sizeof text,
                 "format: 1\ndimension: %d\nresolution: %.17g mm\nsolver: %s\n"
                 "materials: {metal: {library: aluminium}}\nrun: {until: 1 us}\n%s"
                 "bodies:\n  round: {material: metal, ball: {center: [%s], radius: %g mm}}\n",
                 dimension, size, round / 8 % 2 ? "sph" : "mpm",
                 half ? "walls: {w: {mirror: y, at: 0 mm, side: low}}\n" : "",
                 dimension == 2 ? "0 mm, 0 mm" : "0 mm, 0 mm, 0 mm", radius);
        const char *from =
            dimension == 2 ? "[%.17g mm, %.17g mm]" : "[%.17g mm, %.17g mm, %.17g mm]";
        char low[128], high[128], box[512];
        snprintf(low, sizeof low, from, -0.5 * edge, -0.5 * edge, -0.5 * edge);
        snprintf(high, sizeof high, from, 0.5 * edge, 0.5 * edge, 0.5 * edge);
        snprintf(box, sizeof box,
                 "  hole: {material: metal, replaces: round, box: {from: %s, to: %s}}\n", low,
                 high);
        struct simulation_case *input;
        assert_success(read_text(text, hole ? box : "", &input));
        struct body_summary summary[2];
        assert_success(generate_summary(input, NULL, summary));
        const double whole =
            dimension == 2 ? M_PI * square(radius) : 4.0 / 3.0 * M_PI * radius * square(radius);
        const double volume = (whole - hole * pow(edge, dimension)) / (1.0 + half);
        const double density = case_body(input, 0)->start.density;
        const double off = summary[0].mass / (density * volume * pow(1e-3, dimension)) - 1.0;
        struct findings findings = {.input = input};
        generate_judge(&findings);
        bool found = false;
        for (int i = 0; i < findings_count(&findings, FINDING_DOUBTFUL); i++) {
            const char *said = findings_text(&findings, FINDING_DOUBTFUL, i);
            found |= strstr(said, "bodies.round: its particles have") &&
                     strstr(said, off > 0.0 ? "more volume" : "less volume");
        }
        if (fabs(fabs(off) - 0.02) > 0.004 && found != (fabs(off) > 0.02))
            fail_msg("round %d: off by %g, %s", round, off, found ? "a warning" : "no warning");
        warned += found;
        findings_free(&findings);
        case_free(input);
    }
    assert_in_range(warned, 10, 50);
}

/* Gases of a ratio of 1 to 100 in density and in pressure, in 1-D and 2-D, with particles of
 * another size in the denser one; some are apart. Only in 1-D they move with their contacts. */
static void gases_of_too_unequal_particles_are_a_warning(void **state)
{
    (void)state;
    struct dice dice = {62};
    int warned = 0;
    for (int round = 0; round < 100; round++) {
        const int dimension = 1 + round % 2;
        const double finer = dice_between(&dice, 1.0, 3.0), gap = round % 10 == 0 ? 0.5 : 0.0;
        const double denser = pow(10.0, dice_between(&dice, 0.0, 2.0));
        const double higher = pow(10.0, dice_between(&dice, 0.0, 2.0));
        char text[900];
        snprintf(text, sizeof text,
                 "format: 1\ndimension: %d\nresolution: 0.1 m\nsolver: sph\n"
                 "materials: {gas: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}}\n"
                 "run: {until: 1 us}\nbodies:\n"
                 "  dense: {material: gas, density: %.17g kg/m^3, pressure: %.17g Pa, resolution: "
                 "%.17g m,\n          box: {from: [-1 m%s], to: [%g m%s]}}\n"
                 "  thin: {material: gas, pressure: 1 Pa, box: {from: [0 m%s], to: [1 m%s]}}\n",
                 dimension, denser, higher, 0.1 / finer, dimension > 1 ? ", 0 m" : "", -gap,
                 dimension > 1 ? ", 1 m" : "", dimension > 1 ? ", 0 m" : "",
                 dimension > 1 ? ", 1 m" : "");
        struct simulation_case *input;
        assert_success(read_text(text, "", &input));
        struct findings findings;
        judged(input, &findings);
        const double ratio = denser / pow(finer, dimension);
        const bool found =
            findings_count(&findings, FINDING_COARSE) &&
            strstr(findings_text(&findings, FINDING_COARSE, 0), "bodies.dense: its particles are");
        if (found != (dimension == 1 && ratio > 15.0 && higher > 5.0 && gap == 0.0))
            fail_msg("round %d: masses %g, pressures %g, %s", round, ratio, higher,
                     found ? "a warning" : "no warning");
        warned += found;
        findings_free(&findings);
        case_free(input);
    }
    assert_in_range(warned, 5, 25);
}

/* Rods of a metal that yields at 1 GPa and has 8000 kg/m^3: one erodes from 1000 m/s on. About an
 * axis and at a mirror half of it is there. */
static void a_rod_with_few_particles_across_is_a_warning(void **state)
{
    (void)state;
    static const char *const mirrors[] = {
        "", "boundaries: {m: {kind: symmetry, axis: x, at: 0 mm, side: low}}\n"};
    struct dice dice = {67};
    int warned = 0;
    for (int round = 0; round < 100; round++) {
        const bool space = round % 4 == 3, axial = round % 4 == 2, mirror = round % 4 == 1;
        const int across = 1 + (int)dice_between(&dice, 0.0, 14.0); /* particles in the radius */
        const double slender = dice_between(&dice, 2.0, 8.0),
                     speed = dice_between(&dice, 500.0, 2000.0),
                     width = axial || mirror ? 0.0 : 1.0;
        const char *depth = space ? ", -1 mm" : "", *high = space ? ", 1 mm" : "";
        char text[1200];
        snprintf(text, sizeof text,
                 "format: 1\ndimension: %d\n%sresolution: %.17g mm\nsolver: mpm\n%s"
                 "materials: {metal: {eos: {barotropic: {density: 8000 kg/m^3, bulk_modulus: 1e11 "
                 "Pa}},\n  strength: {perfect-plastic: {shear_modulus: 80 GPa, yield: 1 GPa}}}}\n"
                 "run: {until: 1 us}\nbodies:\n"
                 "  rod: {material: metal, velocity: [0 m/s, %.17g m/s%s],\n"
                 "    box: {from: [-%g mm, %.17g mm%s], to: [1 mm, 0 mm%s]}}\n",
                 space ? 3 : 2, axial ? "geometry: axisymmetric\n" : "", 1.0 / across,
                 mirrors[mirror], speed, space ? ", 0 m/s" : "", width, -2.0 * slender, depth,
                 high);
        struct simulation_case *input;
        assert_success(read_text(text, "", &input));
        struct findings findings;
        judged(input, &findings);
        const bool found = findings_count(&findings, FINDING_COARSE) &&
                           strstr(findings_text(&findings, FINDING_COARSE, 0), "bodies.rod: a rod");
        const bool near = fabs(speed - 1000.0) < 1.0 || fabs(slender - 4.0) < 0.1;
        if (!near && found != (across < 10 && slender > 4.0 && speed > 1000.0))
            fail_msg("round %d: %d across, %g long, %g m/s, %s", round, across, slender, speed,
                     found ? "a warning" : "no warning");
        warned += found;
        findings_free(&findings);
        case_free(input);
    }
    assert_in_range(warned, 10, 60);
}

static void a_plate_of_less_than_three_particles_is_a_warning(void **state)
{
    (void)state;
    const char ball[] = "  ball: {material: metal, ball: {center: [-9 mm, 0 mm], radius: 5 mm}}\n";
    char text[512];
    snprintf(text, sizeof text,
             "solver: sph\nbodies:\n%s  plate: {material: metal, box: {from: [0 mm, 0 mm], to: [2 "
             "mm, 20 mm]}}\n",
             ball);
    expect_warning(text, "bodies.plate: 2 particles thick along x");
    snprintf(text, sizeof text,
             "solver: sph\nbodies:\n%s  plate: {material: metal, box: {from: [0 mm, 0 mm], to: [3 "
             "mm, 20 mm]}}\n",
             ball);
    expect_warning(text, NULL);
    /* one row between mirrors stands for many */
    expect_warning("solver: sph\n"
                   "bodies:\n"
                   "  left: {material: metal, box: {from: [0 mm, 0 mm], to: [5 mm, 1 mm]}}\n"
                   "  right: {material: metal, box: {from: [5 mm, 0 mm], to: [9 mm, 1 mm]}}\n",
                   NULL);
}

static void a_start_below_0_k_is_a_warning(void **state)
{
    (void)state;
    expect_warning("solver: sph\n"
                   "bodies: {a: {material: metal, density: 1350 kg/m^3,\n"
                   "             box: {from: [0 mm, 0 mm], to: [9 mm, 9 mm]}}}\n",
                   "bodies.a: it starts at -");
    expect_warning("solver: sph\n"
                   "bodies: {a: {material: metal, density: 2650 kg/m^3,\n"
                   "             box: {from: [0 mm, 0 mm], to: [9 mm, 9 mm]}}}\n",
                   NULL);
}

static void particles_on_nodes_of_linear_functions_are_a_warning(void **state)
{
    (void)state;
    static const char on_nodes[] =
        "bodies: {a: {material: metal, box: {from: [-0.5 mm, 0 mm], to: [9.5 mm, 9 mm]}}}\n"
        "solver: {mpm: {cell: 1 mm, shape: ";
    char text[512];
    snprintf(text, sizeof text, "%slinear}}\n", on_nodes);
    expect_warning(text, "on nodes of the grid along x");
    snprintf(text, sizeof text, "%squadratic}}\n", on_nodes);
    expect_warning(text, NULL);
    expect_warning("bodies: {a: {material: metal, box: {from: [0 mm, 0 mm], to: [9 mm, 9 mm]}}}\n"
                   "solver: {mpm: {cell: 1 mm, shape: linear}}\n",
                   NULL);
}

/* In a tube of 100 cells, the 40 of the region have two particles each; of them 40 less 7 at either
 * face are blocked for the gas. The body that lies beyond the wall is nobody's mistake. */
static void a_coupled_case_counts_the_particles_of_the_region_and_the_cells(void **state)
{
    (void)state;
    struct simulation_case *input = NULL;
    struct estimate estimate;
    struct error *error =
        read_text("format: 1\ndimension: 1\nresolution: 5 mm\n"
                  "materials: {gas: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}}\n"
                  "bodies:\n"
                  "  all: {material: gas, pressure: 1 bar, box: {from: [-1 m], to: [1 m]}}\n"
                  "domain: {low: [0 m], high: [1 m]}\n"
                  "walls: {low: {mirror: x, at: 0 m, side: low}}\n"
                  "run: {until: 1 us}\n",
                  "solver: {cfdmp: {region: {low: [0.4 m], high: [0.8 m]}}}\n", &input);
    if (!error)
        error = estimate_run(input, &estimate);
    if (error)
        fail_msg("%s", error_message(error, 0));
    assert_int_equal(estimate.particles, 80);
    assert_float_equal(estimate.cells, 100.0 - (40.0 - 2.0 * 7.0), 1e-12);
    assert_float_equal(estimate.mass, 1.0, 1e-9);
    estimate_free(&estimate);
    case_free(input);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mixture_has_a_mean_density_and_a_mass_of_each_material),
        cmocka_unit_test(two_walls_bound_the_mean_density_of_their_axis),
        cmocka_unit_test(a_fluid_shortens_the_steps_of_solids_with_material_points),
        cmocka_unit_test(estimated_bytes_match_allocated_ones),
        cmocka_unit_test(a_shape_or_lattice_that_cannot_be_is_told_in_its_place),
        cmocka_unit_test(a_body_that_is_cut_unless_in_half_is_a_warning),
        cmocka_unit_test(a_shape_of_another_volume_than_its_particles_is_a_warning),
        cmocka_unit_test(a_rod_with_few_particles_across_is_a_warning),
        cmocka_unit_test(a_plate_of_less_than_three_particles_is_a_warning),
        cmocka_unit_test(gases_of_too_unequal_particles_are_a_warning),
        cmocka_unit_test(a_start_below_0_k_is_a_warning),
        cmocka_unit_test(particles_on_nodes_of_linear_functions_are_a_warning),
        cmocka_unit_test(a_coupled_case_counts_the_particles_of_the_region_and_the_cells),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
