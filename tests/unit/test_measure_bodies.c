/* Measures of whole bodies, and checks that are measured at a time or divided by another value,
 * against particles that are moved by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "exact/stokes_layer.h"
#include "stage.h"

/* Two squares of 10 x 10 particles, side by side with a gap of one, and a ring. */
static const char case_text[] =
    "format: 1\n"
    "dimension: 2\n"
    "resolution: 1 mm\n"
    "solver: {sph: {smoothing: 1}}\n"
    "materials: {gas: {eos: {ideal-gas: {density: 2 kg/m^3, gamma: 1.4}}}}\n"
    "bodies:\n"
    "  left:  {material: gas, pressure: 1 Pa, box: {from: [-10.5 mm, -5 mm], to: [-0.5 mm, 5 "
    "mm]}}\n"
    "  right: {material: gas, pressure: 1 Pa, box: {from: [0.5 mm, -5 mm], to: [10.5 mm, 5 mm]}}\n"
    "  ring:  {material: gas, pressure: 1 Pa, lattice: {rings: {count: 24}},\n"
    "          shell: {center: [0 mm, 40 mm], inner: 3 mm, outer: 5 mm}}\n"
    "run: {until: 1 s}\n"
    "checks:\n";

static void places_at_the_start_are_those_of_the_lattice(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text, "  it: {minimum: displacement.x, at_least: -1 m}");
    struct particles *p = particles_of(&s.simulation);
    double(*place)[3] = calloc((size_t)p->count, sizeof *place);
    start_places(look(&s), 0, p->count, place);
    assert_memory_equal(place, p->position, (size_t)p->count * sizeof *place);
    free(place);
    assert_true(stage_value(&s, 0) == 0.0);
    p->position[70][0] -= 0.25;
    assert_float_equal(stage_value(&s, 0), -0.25, 1e-15);
    stage_close(&s);
}

static void a_total_is_that_of_a_body(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text,
                "  push: {total: momentum.y, of: right, at_most: 1 kg/s}\n"
                "  spin: {total: angular_momentum.z, at_most: 1 kg*m/s}\n"
                "  motion: {total: kinetic_energy, of: left, at_most: 1 J/m}\n"
                "  part: {total: kinetic_energy, of: left, between: [-1 m, 1 m], at_most: 1 J/m}\n"
                "  none: {total: mass, of: left, between: [1 m, 2 m], at_most: 1 kg/m}\n");
    struct particles *p = particles_of(&s.simulation);
    for (int32_t i = 0; i < p->count; i++)
        p->velocity[i][1] = p->body[i] == 1 ? 3.0 : p->body[i] == 0 ? -2.0 : 0.0;
    assert_float_equal(stage_value(&s, 0), 3.0 * 2e-4, 1e-16);
    assert_float_equal(stage_value(&s, 1), 5.0 * 2e-4 * 5.5e-3, 1e-17);
    assert_float_equal(stage_value(&s, 2), 0.5 * 4.0 * 2e-4, 1e-16);
    assert_float_equal(stage_value(&s, 3), 0.5 * 4.0 * 2e-4, 1e-16);
    assert_true(stage_value(&s, 4) == 0.0);
    stage_close(&s);
}

static void turn_is_the_angle_of_a_rigid_rotation(void **state)
{
    (void)state;
    static const double angles[] = {0.0, 0.3, -3.0, 3.1};
    struct stage s;
    stage_begin(&s, case_text, "  it: {turn: z, of: left, at_most: 1}");
    struct particles *p = particles_of(&s.simulation);
    for (size_t k = 0; k < COUNT_OF(angles); k++) {
        for (int32_t i = 0; i < p->count; i++) {
            const struct vec3 x = start_of(&s, i);
            const double c = cos(angles[k]), n = sin(angles[k]);
            move_to(&s, i, 3.0 + c * x.x - n * x.y, -7.0 + n * x.x + c * x.y);
        }
        assert_float_equal(stage_value(&s, 0), angles[k], 1e-12);
    }
    stage_close(&s);
}

static void extent_is_measured_between_centers_of_particles(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text,
                "  width: {extent: x, of: left, at_most: 1 m}\n"
                "  all: {extent: y, at_most: 1 m}\n"
                "  radius: {extent: radius, of: ring, at_most: 1 m}\n");
    assert_float_equal(stage_value(&s, 0), 9e-3, 1e-17);
    assert_true(stage_value(&s, 1) > 45e-3);
    assert_true(stage_value(&s, 2) > 4e-3 && stage_value(&s, 2) < 5e-3);
    stage_close(&s);
}

static void extent_reaches_edges_and_keeps_to_a_slice(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text,
                "  edges: {extent: {along: x, edges: yes}, of: left, at_most: 1 m}\n"
                "  slice: {extent: x, of: left, between: [2.6 mm, 5.4 mm], at_most: 1 m}\n"
                "  centres: {extent: radius, of: ring, at_most: 1 m}\n"
                "  radius: {extent: {along: radius, edges: yes}, of: ring, at_most: 1 m}\n");
    assert_float_equal(stage_value(&s, 0), 10e-3, 1e-16);
    assert_float_equal(stage_value(&s, 1), 2e-3, 1e-16);
    assert_true(stage_value(&s, 3) > stage_value(&s, 2) + 0.3e-3);
    stage_close(&s);
}

static void radius_follows_a_surface_that_no_particle_stands_on(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text,
                "  inner: {radius: {start: 3 mm, center: [0 mm, 40 mm]}, of: ring, at_most: 1 m}\n"
                "  outer: {radius: {start: 5 mm, center: [0 mm, 40 mm]}, of: ring, at_most: 1 m}\n"
                "  round: {radius: {start: 5 mm, take: spread, center: [0 mm, 40 mm]}, "
                "of: ring, at_most: 1 m}\n"
                "  none: {radius: {start: 5 mm, layer: 1 um}, of: ring, at_most: 1 m}\n");
    assert_float_equal(stage_value(&s, 0), 3e-3, 1e-16);
    assert_float_equal(stage_value(&s, 1), 5e-3, 1e-16);
    assert_true(stage_value(&s, 2) < 1e-16);
    assert_true(isnan(stage_value(&s, 3)));
    /* A flow of constant area: r^2 - R^2 is the same everywhere. */
    struct particles *p = particles_of(&s.simulation);
    for (int32_t i = 0; i < p->count; i++) {
        const struct vec3 x = start_of(&s, i);
        const double then = hypot(x.x, x.y - 40e-3);
        const double scale = sqrt(1.0 - 5e-6 / square(then));
        move_to(&s, i, scale * x.x, 40e-3 + scale * (x.y - 40e-3));
    }
    assert_float_equal(stage_value(&s, 0), 2e-3, 1e-15);
    assert_float_equal(stage_value(&s, 1), sqrt(20e-6), 1e-15);
    assert_true(stage_value(&s, 2) < 1e-15);
    /* Every other particle a little farther out. */
    for (int32_t i = 0; i < p->count; i++) {
        const struct vec3 x = start_of(&s, i);
        const double then = hypot(x.x, x.y - 40e-3);
        const double surface = p->id[i] % 2 ? 6e-3 : 5.8e-3;
        const double scale = sqrt(1.0 + (square(surface) - 25e-6) / square(then));
        move_to(&s, i, scale * x.x, 40e-3 + scale * (x.y - 40e-3));
    }
    assert_float_equal(stage_value(&s, 1), 5.9e-3, 1e-15);
    assert_float_equal(stage_value(&s, 2), 0.1e-3, 1e-15);
    /* About an axis the matter lies on spheres. */
    problem_of(&s.simulation)->geometry = GEOMETRY_AXISYMMETRIC;
    for (int32_t i = 0; i < p->count; i++) {
        const struct vec3 x = start_of(&s, i);
        const double then = hypot(x.x, x.y - 40e-3);
        const double scale = cbrt(1.0 + (1000e-9 - 125e-9) / (then * square(then)));
        move_to(&s, i, scale * x.x, 40e-3 + scale * (x.y - 40e-3));
    }
    assert_float_equal(stage_value(&s, 1), 10e-3, 1e-15);
    stage_close(&s);
}

static void spread_is_the_standard_deviation(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text, "  it: {spread: pressure, of: left, at_most: 1 GPa}");
    struct particles *p = particles_of(&s.simulation);
    for (int32_t i = 0; i < p->count; i++)
        p->pressure[i] = 1e9 + (p->id[i] % 2 ? 3.0 : -3.0);
    assert_float_equal(stage_value(&s, 0), 3.0, 1e-12);
    stage_close(&s);
}

/* A slow loop: every particle takes the smallest mark of those that it hangs together with. */
static int count_slowly(const struct particles *p, const double *diameter, double link)
{
    int *mark = calloc((size_t)p->count + 1, sizeof *mark), pieces = 0;
    bool changed = true;
    for (int32_t i = 0; i < p->count; i++)
        mark[i] = i;
    while (changed) {
        changed = false;
        for (int32_t i = 0; i < p->count; i++)
            for (int32_t j = 0; j < p->count; j++) {
                const double *a = p->position[i], *b = p->position[j];
                double apart = hypot(a[0] - b[0], a[1] - b[1]);
                if (p->body[i] == p->body[j] && mark[j] < mark[i] &&
                    apart < link * (diameter[i] + diameter[j])) {
                    mark[i] = mark[j];
                    changed = true;
                }
            }
    }
    for (int32_t i = 0; i < p->count; i++)
        pieces += mark[i] == i;
    free(mark);
    return pieces;
}

static void pieces_are_what_hangs_together(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text,
                "  all: {pieces: {link: 0.8}, at_most: 1}\n"
                "  one: {pieces: 0.8, of: right, at_most: 1}\n");
    struct particles *p = particles_of(&s.simulation);
    const double *diameter = particles_field(p, "diameter");
    assert_float_equal(stage_value(&s, 0), 3.0, 0.0); /* the squares do not hang together */
    assert_float_equal(stage_value(&s, 1), 1.0, 0.0);
    for (int32_t i = 0; i < p->count; i++) /* broken across, and one particle flies away */
        if (p->body[i] == 1 && start_of(&s, i).y > 0.0)
            p->position[i][1] += 0.7e-3;
    assert_float_equal(stage_value(&s, 1), 2.0, 0.0);
    p->position[11][0] += 1e9;
    assert_float_equal(stage_value(&s, 0), 5.0, 0.0);
    uint64_t dice = 1;
    for (int round = 0; round < 5; round++) {
        for (int32_t i = 0; i < p->count; i++) {
            dice = dice * 6364136223846793005u + 1442695040888963407u;
            move_to(&s, i, 25e-3 * (double)(dice >> 40) / 0x1p24,
                    25e-3 * (double)(dice >> 20 & 0xffff) / 0x1p16);
        }
        assert_float_equal(stage_value(&s, 0), count_slowly(p, diameter, 0.8), 0.0);
    }
    stage_close(&s);
}

static void asymmetry_compares_with_the_particle_that_stood_at_the_image(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text,
                "  it: {asymmetry: {field: velocity.x, across: x, parity: odd}, of: left, "
                "at_most: 1}\n"
                "  ring: {asymmetry: {field: velocity.x, across: xy, center: [0 mm, 40 mm]}, "
                "of: ring, at_most: 1}\n"
                "  none: {asymmetry: {field: velocity.x, across: y}, of: ring, at_most: 1}\n");
    struct particles *p = particles_of(&s.simulation);
    for (int32_t i = 0; i < p->count; i++) {
        const struct vec3 x = start_of(&s, i);
        p->velocity[i][0] = p->body[i] < 2 ? x.x * (1.0 + x.y * x.y) : x.x * (x.y - 40e-3);
        p->position[i][0] += 1.0; /* wherever they are now */
    }
    assert_true(stage_value(&s, 0) < 1e-12);
    assert_true(stage_value(&s, 1) < 1e-12);
    assert_true(isnan(stage_value(&s, 2)));
    double largest = 0.0;
    int32_t chosen = 0;
    for (int32_t i = 0; i < p->count; i++)
        if (p->body[i] == 0) {
            largest = maximum(largest, fabs(p->velocity[i][0]));
            chosen = fabs(p->velocity[i][0]) < largest ? i : chosen;
        }
    p->velocity[chosen][0] += 0.01 * largest;
    assert_float_equal(stage_value(&s, 0), 0.01, 1e-12);
    stage_close(&s);
}

static void stokes_layer_gives_the_printed_displacement(void **state)
{
    (void)state;
    assert_float_equal(250.0 * stokes_layer_displacement(10e-3, 100e-6, 0.7), 19.737149e-3, 1e-9);
    assert_true(stokes_layer_displacement(-10e-3, 100e-6, 0.7) ==
                -stokes_layer_displacement(10e-3, 100e-6, 0.7));
    /* The displacement is the integral of the velocity. */
    double sum = 0.0;
    for (int i = 0; i < 20000; i++)
        sum += 100e-6 / 20000 * stokes_layer_velocity(3e-3, 100e-6 * (i + 0.5) / 20000, 0.7);
    assert_float_equal(sum, stokes_layer_displacement(3e-3, 100e-6, 0.7), 1e-10);
}

static void shear_layer_finds_the_viscosity_that_moved_the_rows(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text,
                "  viscosity: {shear_layer: {speed: 2 m/s, plane: 1 mm}, of: left, "
                "between: [-8 mm, -3 mm], at_most: 1 m^2/s}\n"
                "  misfit: {shear_layer: {value: displacement, speed: 2 m/s, plane: 1 mm}, "
                "of: left, between: [-8 mm, -3 mm], at_most: 1 m}\n"
                "  velocity: {shear_layer: {value: velocity, speed: 2 m/s, plane: 1 mm}, "
                "of: left, between: [-8 mm, -3 mm], at_most: 1 m/s}\n");
    struct particles *p = particles_of(&s.simulation);
    static const double viscosity = 0.031;
    s.simulation.time = 3e-4;
    for (int32_t i = 0; i < p->count; i++) {
        const struct vec3 x = start_of(&s, i);
        const double y = x.y - 1e-3;
        p->position[i][0] = x.x + 2.0 * stokes_layer_displacement(y, s.simulation.time, viscosity);
        p->velocity[i][0] = 2.0 * stokes_layer_velocity(y, s.simulation.time, viscosity);
        if (x.x < -8e-3 || x.x > -3e-3) /* outside the columns nothing counts */
            p->position[i][0] = 1.0;
    }
    assert_float_equal(stage_value(&s, 0), viscosity, 1e-8 * viscosity);
    assert_true(stage_value(&s, 1) < 1e-12);
    assert_true(stage_value(&s, 2) < 1e-8);
    stage_close(&s);
}

static void a_check_is_measured_at_its_time_and_remembered(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text,
                "  early: {mean: velocity.x, of: left, at: 0.2 s, at_most: 4 m/s}\n"
                "  last: {mean: velocity.x, of: left, at_most: 4 m/s}\n");
    struct particles *p = particles_of(&s.simulation);
    for (int step = 0; step <= 10; step++) {
        for (int32_t i = 0; i < p->count; i++)
            p->velocity[i][0] = step;
        stage_watch(&s, 0.099 * step); /* past 0.2 s in step 3 */
    }
    assert_float_equal(stage_value(&s, 0), 3.0, 1e-15);
    assert_float_equal(s.results.item[0].time, 0.297, 1e-15);
    assert_float_equal(stage_value(&s, 1), 10.0, 1e-15);
    assert_int_equal(s.results.item[0].verdict, CHECK_PASSED);
    assert_int_equal(s.results.item[1].verdict, CHECK_FAILED);
    stage_close(&s);
}

static void a_known_deviation_is_no_failure_until_it_passes(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(
        &s, case_text,
        "  short: {mean: velocity.x, at_most: -1 m/s, known_deviation: it creeps}\n"
        "  now: {mean: velocity.x, at_most: 4 m/s, known_deviation: it creeps}\n"
        "  here: {mean: velocity.x, at_most: 4 m/s, known_deviation: it creeps, "
        "known_deviation_if: 1 - 1}\n"
        "  there: {mean: velocity.x, at_most: -1 m/s, known_deviation: it creeps, "
        "known_deviation_if: -2}\n"
        "  never: {mean: velocity.x, at: 0.9 s, at_most: 4 m/s, known_deviation: it creeps}\n");
    for (int32_t i = 0; i < particles_of(&s.simulation)->count; i++)
        particles_of(&s.simulation)->velocity[i][0] = 0.0;
    stage_watch(&s, 0.1);
    stage_value(&s, 0);
    const enum check_verdict wanted[] = {CHECK_KNOWN_DEVIATION, CHECK_PASSES_NOW, CHECK_PASSED,
                                         CHECK_FAILED, CHECK_FAILED};
    for (int i = 0; i < 5; i++)
        assert_int_equal(s.results.item[i].verdict, wanted[i]);
    assert_int_equal(s.results.failed, 3);
    assert_int_equal(s.results.known_deviations, 1);
    char *text = check_verdict_text(&s.results.item[0]);
    assert_string_equal(text, "known deviation: it creeps");
    free(text);
    text = check_verdict_text(&s.results.item[1]);
    assert_string_equal(text, "FAILED: passes now: remove `known_deviation`");
    free(text);
    stage_close(&s);
}

static void a_check_without_a_limit_only_measures(void **state)
{
    (void)state;
    struct stage s;
    char text[96];
    stage_begin(&s, case_text,
                "  speed: {mean: velocity.x}\n  never: {mean: velocity.x, at: 0.9 s}\n");
    for (int32_t i = 0; i < particles_of(&s.simulation)->count; i++)
        particles_of(&s.simulation)->velocity[i][0] = 2.0;
    stage_watch(&s, 0.1);
    assert_float_equal(stage_value(&s, 0), 2.0, 0.0);
    for (int i = 0; i < 2; i++)
        assert_int_equal(s.results.item[i].verdict, CHECK_MEASURED_ONLY);
    assert_int_equal(s.results.failed, 0);
    assert_int_equal(s.results.measured_only, 2);
    check_allowed_text(&s.results.item[0], text, sizeof text);
    assert_string_equal(text, "no limit");
    stage_close(&s);
}

static void a_check_whose_time_never_came_fails(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text, "  it: {mean: velocity.x, at: 0.2 s, at_most: 4 m/s}\n");
    stage_watch(&s, 0.1);
    assert_true(isnan(stage_value(&s, 0)));
    assert_int_equal(s.results.item[0].verdict, CHECK_FAILED);
    stage_close(&s);
}

static void a_value_is_compared_with_that_at_the_start_or_of_another_check(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, case_text,
                "  grown: {extent: x, of: left, relative: start, is: 2, within: 1 %}\n"
                "  slope: {mean: position.y, of: left, relative: way, is: 3, within: 1 %}\n"
                "  way: {mean: position.x, of: left, at_most: 1 m}\n"
                "  rate: {decay: mass, of: left, at_most: 1 s^-1}\n"
                "  ahead: {mean: position.y, of: left, minus: way, is: 1 m, within: 100 m}\n"
                "  gain: {mean: position.y, of: left, minus: way, relative: way, at_least: 1}\n"
                "  middle: {mean: position.y, of: left, mean_with: [way], is: 1 m, within: 9 m}\n");
    struct particles *p = particles_of(&s.simulation);
    for (int32_t i = 0; i < p->count; i++) {
        const struct vec3 x = start_of(&s, i);
        move_to(&s, i, 2.0 * x.x, 6.0 * x.x);
        p->mass[i] *= 0.5;
    }
    s.simulation.time = 0.25;
    assert_float_equal(stage_value(&s, 0), 2.0, 1e-12);
    assert_float_equal(stage_value(&s, 1), 3.0, 1e-12);
    assert_float_equal(stage_value(&s, 3), log(2.0) / 0.25, 1e-12);
    assert_float_equal(stage_value(&s, 4), 2.0 * stage_value(&s, 2), 1e-12);
    assert_float_equal(stage_value(&s, 5), 2.0, 1e-12);
    assert_float_equal(stage_value(&s, 6), 2.0 * stage_value(&s, 2), 1e-12);
    assert_int_equal(s.results.item[0].verdict, CHECK_PASSED);
    assert_int_equal(s.results.item[1].verdict, CHECK_PASSED);
    assert_string_equal(s.results.item[0].unit, "");
    assert_string_equal(s.results.item[4].unit, "m");
    stage_close(&s);
}

static void what_makes_no_sense_of_a_body_is_told_before_the_run(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"  it: {turn: x, at_most: 1}\n", "a plane turns about z alone"},
        {"  it: {extent: z, at_most: 1 m}\n", "the case has 2 dimensions"},
        {"  it: {radius: {start: 1 m, center: [0 m]}, at_most: 1 m}\n",
         "`center`: expected 2 components, one per dimension; found 1"},
        {"  it: {turn: z, between: [0 m, 1 m], at_most: 1}\n", "`between` has no meaning"},
        {"  it: {extent: x, at_most: 1 s}\n", "`at_most` is in s"},
        {"  it: {total: mass, relative: start, at_most: 1 kg/m}\n", "`at_most` is in"},
        {"  it: {mean: pressure, relative: at, at_most: 1}\n  at: {mean: position.x, at_most: 1 m}",
         "`at_most` is in plain numbers, but `mean` is in kg/(m^2*s^2)"},
        {"  it: {mean: pressure, mean_with: at, at_most: 1 Pa}\n  at: {mean: position.x}",
         "`mean_with`: the check \"at\" is in m, and this one in Pa"},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        struct stage s;
        struct error *error = stage_open(&s, case_text, cases[i][0]);
        assert_non_null(error);
        assert_int_equal(error_kind(error), ERROR_INPUT);
        if (!strstr(error_message(error, 0), cases[i][1]))
            fail_msg("\"%s\" does not say \"%s\"", error_message(error, 0), cases[i][1]);
        error_free(error);
        stage_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_at_the_start_are_those_of_the_lattice),
        cmocka_unit_test(a_total_is_that_of_a_body),
        cmocka_unit_test(turn_is_the_angle_of_a_rigid_rotation),
        cmocka_unit_test(extent_is_measured_between_centers_of_particles),
        cmocka_unit_test(extent_reaches_edges_and_keeps_to_a_slice),
        cmocka_unit_test(radius_follows_a_surface_that_no_particle_stands_on),
        cmocka_unit_test(spread_is_the_standard_deviation),
        cmocka_unit_test(pieces_are_what_hangs_together),
        cmocka_unit_test(asymmetry_compares_with_the_particle_that_stood_at_the_image),
        cmocka_unit_test(stokes_layer_gives_the_printed_displacement),
        cmocka_unit_test(shear_layer_finds_the_viscosity_that_moved_the_rows),
        cmocka_unit_test(a_check_is_measured_at_its_time_and_remembered),
        cmocka_unit_test(a_known_deviation_is_no_failure_until_it_passes),
        cmocka_unit_test(a_check_without_a_limit_only_measures),
        cmocka_unit_test(a_check_whose_time_never_came_fails),
        cmocka_unit_test(a_value_is_compared_with_that_at_the_start_or_of_another_check),
        cmocka_unit_test(what_makes_no_sense_of_a_body_is_told_before_the_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
