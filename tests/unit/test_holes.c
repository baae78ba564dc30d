/* Holes, craters and bulges of plates, against shapes of known size. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "stage.h"

#define METAL                                                                            \
    "materials: {metal: {eos: {barotropic: {density: 2 kg/m^3, bulk_modulus: 1 kPa}},\n" \
    "  strength: {perfect-plastic: {shear_modulus: 1 kPa, yield: 1 Pa}},\n"              \
    "  failure: {spall: {strength: 1 Pa}}}}\n"

#define SPACE "format: 1\ndimension: 3\nresolution: 1 mm\nsolver: {mpm: {}}\n" METAL
#define PLANE "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: {mpm: {}}\n" METAL
#define ROUND \
    "format: 1\ndimension: 2\ngeometry: axisymmetric\nresolution: 1 mm\nsolver: {mpm: {}}\n" METAL
#define CHECKS "run: {until: 1 s}\nchecks:\n"

enum { VALUES = 5 };

/* Opens the case TEXT with CHECKS and closes it when COUNT of them have been measured. */
static void measure_all(const char *text, const char *checks, int count, double *value)
{
    struct stage s;
    stage_begin(&s, text, checks);
    for (int i = 0; i < count; i++)
        value[i] = stage_value(&s, i);
    stage_close(&s);
}

/* A hole of 6 mm in the lower half of a plate and of 10 mm in the upper one. */
#define STEPPED                                                                      \
    "    difference:\n"                                                              \
    "      - box: {from: [-9 mm, -9 mm, 0 mm], to: [9 mm, 9 mm, 4 mm]}\n"            \
    "      - cylinder: {from: [0 mm, 0 mm, -1 mm], to: [0 mm, 0 mm, 5 mm], radius: " \
    "3 mm}\n"                                                                        \
    "      - cylinder: {from: [0 mm, 0 mm, 2 mm], to: [0 mm, 0 mm, 5 mm], radius: "  \
    "5 mm}\n"
static const char hole_checks[] =
    "  clear: {hole: z, of: plate, at_least: 0 m}\n"
    "  low: {hole: {along: z, at: 1 mm}, of: plate, at_least: 0 m}\n"
    "  high: {hole: {along: z, at: 3 mm}, of: plate, at_least: 0 m}\n";

static void a_hole_has_the_diameter_of_its_cylinder(void **state)
{
    (void)state;
    static const char whole[] = SPACE "bodies:\n  plate:\n    material: metal\n" STEPPED CHECKS;
    double value[VALUES];
    measure_all(whole, hole_checks, 3, value);
    assert_float_equal(value[0], 6e-3, 0.5e-3);
    assert_float_equal(value[1], 6e-3, 0.5e-3);
    assert_float_equal(value[2], 10e-3, 0.5e-3);
}

static void a_quarter_of_a_plate_has_the_hole_of_the_whole(void **state)
{
    (void)state;
    static const char whole[] = SPACE "bodies:\n  plate:\n    material: metal\n" STEPPED CHECKS;
    static const char quarter[] = SPACE
        "bodies:\n  plate:\n    material: metal\n    intersection:\n"
        "     - box: {from: [0 mm, 0 mm, 0 mm], to: [9 mm, 9 mm, 4 mm]}\n"
        "     - difference:\n"
        "        - box: {from: [-9 mm, -9 mm, 0 mm], to: [9 mm, 9 mm, 4 mm]}\n"
        "        - cylinder: {from: [0 mm, 0 mm, -1 mm], to: [0 mm, 0 mm, 5 mm], radius: 3 mm}\n"
        "        - cylinder: {from: [0 mm, 0 mm, 2 mm], to: [0 mm, 0 mm, 5 mm], radius: 5 mm}\n"
        "walls:\n  left: {mirror: x, at: 0 mm, side: low}\n"
        "  front: {mirror: y, at: 0 mm, side: low}\n" CHECKS;
    static const char craters[] =
        "  clear: {hole: z, of: plate, at_least: 0 m}\n"
        "  high: {hole: {along: z, at: 3 mm}, of: plate, at_least: 0 m}\n";
    double value[VALUES], wanted[VALUES];
    measure_all(whole, craters, 2, wanted);
    measure_all(quarter, craters, 2, value);
    for (int i = 0; i < 2; i++)
        assert_float_equal(value[i], wanted[i], 1e-12);
}

static void a_whole_plate_has_no_hole_and_no_crater(void **state)
{
    (void)state;
    static const char text[] =
        SPACE "bodies: {plate: {material: metal, "
              "box: {from: [-5 mm, -5 mm, 0 mm], to: [5 mm, 5 mm, 3 mm]}}}\n" CHECKS;
    double value[VALUES];
    measure_all(
        text,
        "  hole: {hole: z, of: plate, at_most: 0 m}\n"
        "  off: {hole: {along: z, center: [1.3 mm, 0.4 mm, 0 mm]}, of: plate, at_most: 0 m}\n"
        "  deep: {crater: {along: z, side: high}, of: plate, at_most: 0 m}\n"
        "  space: {crater: {along: z, side: low, take: volume}, of: plate, at_most: 0 m^3}\n"
        "  none: {hole: {along: z, at: 10 mm}, of: plate, at_most: 0 m}\n",
        5, value);
    for (int i = 0; i < 4; i++)
        assert_float_equal(value[i], 0.0, 0.0);
    assert_true(isnan(value[4])); /* no particle is there */
}

static void a_hole_divides_a_plane_plate(void **state)
{
    (void)state;
    static const char text[] = PLANE
        "bodies:\n  plate: {material: metal, union: [box: {from: [-9 mm, 0 mm], to: [-3 mm, 2 "
        "mm]}, box: {from: [4 mm, 0 mm], to: [11 mm, 2 mm]}]}\n" CHECKS;
    double value[VALUES];
    measure_all(text,
                "  hole: {hole: y, of: plate, at_least: 0 m}\n"
                "  open: {crater: {along: y, side: low}, of: plate, at_least: 0 m}\n",
                2, value);
    assert_float_equal(value[0], 7e-3, 1e-9);
    assert_true(isnan(value[1])); /* it goes through */
}

static const char wall_checks[] =
    "  hole: {perforation: {along: y, side: high}, of: plate, at_least: 0 m}\n"
    "  left: {perforation: {along: y, side: high, take: thickness}, of: plate, at_least: 0 m}\n";

static void a_wall_keeps_its_thickness_and_a_groove_takes_some(void **state)
{
    (void)state;
    static const char *const texts[][2] = {
        {PLANE, "box: {from: [-15 mm, 0 mm], to: [15 mm, 4 mm]}"},
        {ROUND, "box: {from: [0 mm, 0 mm], to: [15 mm, 4 mm]}"},
        {PLANE, "difference: [box: {from: [-15 mm, 0 mm], to: [15 mm, 4 mm]}, box: {from: [-4 mm, "
                "-1 mm], to: [4 mm, 3 mm]}]"},
        {ROUND, "difference: [box: {from: [0 mm, 0 mm], to: [15 mm, 4 mm]}, box: {from: [0 mm, -1 "
                "mm], to: [4 mm, 3 mm]}]"},
        {PLANE, "difference: [box: {from: [-15 mm, 0 mm], to: [15 mm, 4 mm]}, box: {from: [-4 mm, "
                "-1 mm], to: [4 mm, 5 mm]}]"},
        {ROUND, "difference: [box: {from: [0 mm, 0 mm], to: [15 mm, 4 mm]}, box: {from: [0 mm, -1 "
                "mm], to: [4 mm, 5 mm]}]"}};
    static const double wanted[][2] = {{0.0, 4e-3}, {0.0, 4e-3}, {0.0, 1e-3},
                                       {0.0, 1e-3}, {8e-3, 0.0}, {8e-3, 0.0}};
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        char *text = text_format("%sbodies:\n  plate:\n    material: metal\n    %s\n%s",
                                 texts[k][0], texts[k][1], CHECKS);
        double value[VALUES];
        measure_all(text, wall_checks, 2, value);
        free(text);
        assert_float_equal(value[0], wanted[k][0], 0.6e-3);
        assert_float_equal(value[1], wanted[k][1], 1e-8);
    }
}

/* Behind the wall: debris from its middle, and some that flew past its rim. */
static void debris_that_flew_past_the_rim_did_not_come_through(void **state)
{
    (void)state;
    static const char text[] = ROUND
        "bodies:\n  plate: {material: metal, box: {from: [0 mm, 0 mm], to: [15 mm, 4 mm]}}\n"
        "  through: {material: metal, velocity: [100 m/s, 100 m/s], box: {from: [18 mm, 16 mm], "
        "to: "
        "[20 mm, 18 mm]}}\n"
        "  past: {material: metal, velocity: [10 m/s, 100 m/s], box: {from: [18 mm, 10 mm], to: "
        "[20 mm, 12 mm]}}\n"
        "  before: {material: metal, velocity: [0 m/s, 100 m/s], box: {from: [0 mm, -8 mm], to: [2 "
        "mm, -6 mm]}}\n" CHECKS;
    double value[VALUES];
    measure_all(text,
                "  mass: {perforation: {along: y, side: high, take: mass}, of: plate, at_least: 0 "
                "kg}\n",
                1, value);
    assert_float_equal(value[0], 2.0 * 0.5 * (400e-6 - 324e-6) * 2e-3, 1e-12);
}

static void debris_in_a_hole_does_not_count(void **state)
{
    (void)state;
    static const char text[] = ROUND
        "bodies: {plate: {material: metal, box: {from: [0 mm, 0 mm], to: [12 mm, 3 mm]}}}\n" CHECKS;
    struct stage s;
    stage_begin(&s, text,
                "  hole: {hole: y, of: plate, at_least: 0 m}\n"
                "  bulge: {bulge: {along: y, side: low}, of: plate, at_least: -1 m}\n");
    assert_float_equal(stage_value(&s, 0), 0.0, 0.0);
    struct particles *p = particles_of(&s.simulation);
    double *damage = particles_field(p, "damage");
    for (int32_t i = 0; i < p->count; i++) {
        const double r = p->position[i][0];
        if (r > 3e-3 && r < 4e-3) /* what has failed is no part of the plate */
            damage[i] = 1.0;
        if (r < 3e-3) /* nor is the plug */
            p->position[i][1] -= 1e-3;
    }
    assert_float_equal(stage_value(&s, 0), 8e-3, 1e-9);
    assert_float_equal(stage_value(&s, 1), 0.0, 1e-12);
    stage_close(&s);
}

static void a_crater_has_the_size_of_its_ball(void **state)
{
    (void)state;
    static const char text[] =
        SPACE "bodies:\n  target:\n    material: metal\n    difference:\n"
              "      - box: {from: [-9 mm, -9 mm, 0 mm], to: [9 mm, 9 mm, 9 mm]}\n"
              "      - ball: {center: [1 mm, 0 mm, 9 mm], radius: 6 mm}\n" CHECKS;
    double value[VALUES];
    measure_all(
        text,
        "  depth: {crater: {along: z, side: high}, of: target, at_least: 0 m}\n"
        "  width: {crater: {along: z, side: high, take: diameter}, of: target, at_least: 0 m}\n"
        "  space: {crater: {along: z, side: high, take: volume}, of: target, at_least: 0 m^3}\n"
        "  far: {crater: {along: z, side: high, center: [8 mm, 8 mm, 0 mm]}, of: target, "
        "at_least: 0 m}\n",
        4, value);
    const double volume = 2.0 / 3.0 * M_PI * 216e-9;
    assert_float_equal(value[0], 6e-3, 0.5e-3);
    assert_float_equal(value[1], 12e-3, 0.5e-3);
    assert_float_equal(value[2], volume, 0.05 * volume);
    assert_float_equal(value[3], 0.0, 0.0);
}

static void a_crater_about_the_axis_of_symmetry(void **state)
{
    (void)state;
    static const char text[] = ROUND "bodies:\n  target:\n    material: metal\n    difference:\n"
                                     "      - box: {from: [0 mm, 0 mm], to: [14 mm, 9 mm]}\n"
                                     "      - ball: {center: [0 mm, 0 mm], radius: 6 mm}\n" CHECKS;
    double value[VALUES];
    measure_all(
        text,
        "  depth: {crater: {along: y, side: low}, of: target, at_least: 0 m}\n"
        "  width: {crater: {along: y, side: low, take: diameter}, of: target, at_least: 0 m}\n"
        "  space: {crater: {along: y, side: low, take: volume}, of: target, at_least: 0 m^3}\n",
        3, value);
    const double volume = 2.0 / 3.0 * M_PI * 216e-9;
    assert_float_equal(value[0], 6e-3, 0.5e-3);
    assert_float_equal(value[1], 12e-3, 0.5e-3);
    assert_float_equal(value[2], volume, 0.1 * volume);
}

static void a_crater_in_a_plane_has_an_area(void **state)
{
    (void)state;
    static const char text[] =
        PLANE "bodies:\n  target:\n    material: metal\n    difference:\n"
              "      - box: {from: [-10 mm, 0 mm], to: [10 mm, 9 mm]}\n"
              "      - box: {from: [-4 mm, 6 mm], to: [3 mm, 9 mm]}\n" CHECKS;
    double value[VALUES];
    measure_all(
        text,
        "  depth: {crater: {along: y, side: high}, of: target, at_least: 0 m}\n"
        "  width: {crater: {along: y, side: high, take: diameter}, of: target, at_least: 0 m}\n"
        "  space: {crater: {along: y, side: high, take: volume}, of: target, at_least: 0 m^2}\n",
        3, value);
    assert_float_equal(value[0], 3e-3, 1e-9);
    assert_float_equal(value[1], 7e-3, 0.2e-3);
    assert_float_equal(value[2], 21e-6, 0.6e-6);
}

static void a_bulge_is_measured_from_the_face_at_the_start(void **state)
{
    (void)state;
    static const char text[] = PLANE
        "bodies: {plate: {material: metal, box: {from: [-9 mm, 1 mm], to: [9 mm, 4 mm]}}}\n" CHECKS;
    struct stage s;
    stage_begin(&s, text,
                "  low: {bulge: {along: y, side: low}, of: plate, at_least: -1 m}\n"
                "  high: {bulge: {along: y, side: high}, of: plate, at_least: -1 m}\n");
    assert_float_equal(stage_value(&s, 0), 0.0, 1e-12);
    struct particles *p = particles_of(&s.simulation);
    for (int32_t i = 0; i < p->count; i++)
        p->position[i][1] -= 2e-3 * exp(-square(p->position[i][0] / 4e-3));
    const double most = 2e-3 * exp(-square(0.5 / 4.0));
    assert_float_equal(stage_value(&s, 0), most, 1e-12);
    assert_float_equal(stage_value(&s, 1), -2e-3 * exp(-square(8.5 / 4.0)), 1e-12);
    stage_close(&s);
}

/* The damage of particles that stood within half the WIDTH of the axis ALONG, times 1 + ELLIPSE in
 * x. */
static void damage_about(struct stage *s, int along, double width, double ellipse)
{
    struct particles *p = particles_of(&s->simulation);
    for (int32_t i = 0; i < p->count; i++) {
        const double *x = p->position[i];
        const double at = x[0] / (1.0 + ellipse), up = along == 1 ? x[2] : x[1];
        p->history[HISTORY_damage][i] = square(at) + square(up) < square(0.5 * width) ? 1.0 : 0.5;
        p->position[i][along] -= 1e-3; /* where they stood counts */
    }
}

static void a_zone_has_the_size_of_its_circle(void **state)
{
    (void)state;
    static const char *const texts[] = {
        SPACE "bodies: {plate: {material: metal,\n"
              "  box: {from: [-9 mm, -9 mm, 0 mm], to: [9 mm, 9 mm, 2 mm]}}}\n" CHECKS,
        SPACE "bodies: {plate: {material: metal,\n"
              "  box: {from: [0 mm, 0 mm, 0 mm], to: [9 mm, 9 mm, 2 mm]}}}\n"
              "walls: {a: {mirror: x, at: 0 mm, side: low}, b: {mirror: y, at: 0 mm, side: "
              "low}}\n" CHECKS};
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        struct stage s;
        stage_begin(
            &s, texts[i],
            "  width: {zone: {field: damage, value: 1, along: z, side: high}, of: plate}\n"
            "  all: {zone: {field: damage, value: 0.5, along: z, side: low}, of: plate}\n"
            "  ratio: {zone: {field: damage, value: 1, along: z, side: high, take: ratio},\n"
            "    of: plate}\n"
            "  deviation: {zone: {field: damage, value: 1, along: z, side: low,\n"
            "    take: deviation}, of: plate}\n");
        damage_about(&s, 2, 14e-3, 0.0);
        assert_float_equal(stage_value(&s, 0), 14e-3, 0.3e-3);
        assert_float_equal(stage_value(&s, 1), 2.0 * sqrt(18e-3 * 18e-3 / M_PI), 1e-12);
        assert_true(stage_value(&s, 2) >= 1.0 && stage_value(&s, 2) < 1.2);
        assert_true(stage_value(&s, 3) < 0.1);
        stage_close(&s);
    }
}

static void a_zone_has_the_shape_of_its_ellipse(void **state)
{
    (void)state;
    static const char text[] =
        SPACE "bodies: {plate: {material: metal,\n"
              "  box: {from: [-15 mm, -15 mm, 0 mm], to: [15 mm, 15 mm, 2 mm]}}}\n" CHECKS;
    struct stage s;
    stage_begin(&s, text,
                "  ratio: {zone: {field: damage, value: 1, along: z, side: high, take: ratio},\n"
                "    of: plate}\n");
    damage_about(&s, 2, 14e-3, 1.0);
    assert_float_equal(stage_value(&s, 0), 2.0, 0.15);
    stage_close(&s);
}

static void a_zone_about_the_axis_of_symmetry(void **state)
{
    (void)state;
    static const char *const texts[] = {
        ROUND
        "bodies: {plate: {material: metal, box: {from: [0 mm, 0 mm], to: [9 mm, 2 mm]}}}\n" CHECKS,
        PLANE "bodies: {plate: {material: metal, box: {from: [-9 mm, 0 mm], to: [9 mm, 2 "
              "mm]}}}\n" CHECKS};
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        struct stage s;
        stage_begin(&s, texts[i],
                    "  width: {zone: {field: damage, value: 1, along: y, side: low}, of: plate}\n");
        damage_about(&s, 1, 14e-3, 0.0);
        assert_float_equal(stage_value(&s, 0), 14e-3, 1e-9);
        stage_close(&s);
    }
}

/* Two plates meet at 4 mm; then a row of each changes its place with one of the other, or both
 * planes of particles move apart. */
static void an_interface_balances_what_is_beyond_it(void **state)
{
    (void)state;
    static const char bodies[] =
        ROUND "bodies:\n"
              "  lower: {material: metal, box: {from: [0 mm, 0 mm], to: [6 mm, 4 mm]}}\n"
              "  upper: {material: metal, box: {from: [0 mm, 4 mm], to: [6 mm, 9 mm]}}\n" CHECKS;
    static const char checks[] =
        "  up: {interface: {along: y, with: lower, radius: 3 mm}, of: upper, at_least: 0 m}\n"
        "  down: {interface: {along: y, with: upper, radius: 3 mm}, of: lower, at_least: 0 m}\n";
    struct stage s;
    stage_begin(&s, bodies, checks);
    assert_float_equal(stage_value(&s, 0), 4e-3, 1e-9);
    assert_float_equal(stage_value(&s, 1), 4e-3, 1e-9);
    struct particles *p = particles_of(&s.simulation);
    for (int32_t i = 0; i < p->count; i++) {
        double *y = &p->position[i][1];
        *y = fabs(*y - 2.5e-3) < 1e-6 ? 6.5e-3 : fabs(*y - 6.5e-3) < 1e-6 ? 2.5e-3 : *y;
    }
    assert_float_equal(stage_value(&s, 0), 4e-3, 1e-9);
    for (int32_t i = 0; i < p->count; i++)
        p->position[i][1] += 1e-3;
    assert_float_equal(stage_value(&s, 0), 5e-3, 1e-9);
    assert_float_equal(stage_value(&s, 1), 5e-3, 1e-9);
    for (int32_t i = 0; i < p->count; i++)
        p->position[i][0] += 10e-3;
    assert_true(isnan(stage_value(&s, 0)));
    stage_close(&s);
}

static void mistakes_are_told_before_the_run(void **state)
{
    (void)state;
    static const char flat[] = PLANE
        "bodies: {plate: {material: metal, box: {from: [1 mm, 1 mm], to: [9 mm, 4 mm]}}}\n" CHECKS;
    static const char disc[] = ROUND
        "bodies: {plate: {material: metal, box: {from: [0 mm, 1 mm], to: [9 mm, 4 mm]}}}\n" CHECKS;
    static const struct {
        const char *text, *check, *message;
    } cases[] = {
        {flat, "  it: {hole: y, at_most: 1 m}", "`hole` needs `of`"},
        {flat, "  it: {bulge: {along: y, side: low}, at_most: 1 m}", "`bulge` needs `of`"},
        {flat, "  it: {hole: y, of: plate, at_most: 1 m}", "misses \"plate\": give its `center`"},
        {flat, "  it: {hole: z, of: plate, at_most: 1 m}", "`along`: the case has 2 dimensions"},
        {flat, "  it: {hole: {along: y, center: [2 mm]}, of: plate, at_most: 1 m}",
         "`center`: expected 2 components"},
        {flat,
         "  it: {crater: {along: y, side: low, take: volume, center: [2 mm, 0 mm]}, of: plate, "
         "at_most: 1 m}",
         "`at_most` is in m"},
        {disc, "  it: {hole: x, of: plate, at_most: 1 m}", "`along` must be y"},
        {disc, "  it: {interface: {along: y, with: rod, radius: 1 m}, of: plate, at_most: 1 m}",
         "`with`: there is no body \"rod\""},
        {disc, "  it: {hole: {along: y, center: [2 mm, 0 mm]}, of: plate, at_most: 1 m}",
         "the axis of symmetry is at x = 0"},
        {disc, "  it: {zone: {field: pressure, value: 1, along: y, side: low}, of: plate}",
         "`field` must be one without a unit"},
        {disc,
         "  it: {zone: {field: damage, value: 1, along: y, side: low, take: ratio}, of: plate}",
         "only a face in 3-D has a shape"},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        struct stage s;
        struct error *error = stage_open(&s, cases[i].text, cases[i].check);
        assert_non_null(error);
        assert_int_equal(error_kind(error), ERROR_INPUT);
        if (!strstr(error_message(error, 0), cases[i].message))
            fail_msg("\"%s\" does not say \"%s\"", error_message(error, 0), cases[i].message);
        error_free(error);
        stage_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hole_has_the_diameter_of_its_cylinder),
        cmocka_unit_test(a_quarter_of_a_plate_has_the_hole_of_the_whole),
        cmocka_unit_test(a_whole_plate_has_no_hole_and_no_crater),
        cmocka_unit_test(a_hole_divides_a_plane_plate),
        cmocka_unit_test(a_wall_keeps_its_thickness_and_a_groove_takes_some),
        cmocka_unit_test(debris_that_flew_past_the_rim_did_not_come_through),
        cmocka_unit_test(debris_in_a_hole_does_not_count),
        cmocka_unit_test(a_crater_has_the_size_of_its_ball),
        cmocka_unit_test(a_crater_about_the_axis_of_symmetry),
        cmocka_unit_test(a_crater_in_a_plane_has_an_area),
        cmocka_unit_test(a_bulge_is_measured_from_the_face_at_the_start),
        cmocka_unit_test(a_zone_has_the_size_of_its_circle),
        cmocka_unit_test(a_zone_has_the_shape_of_its_ellipse),
        cmocka_unit_test(a_zone_about_the_axis_of_symmetry),
        cmocka_unit_test(an_interface_balances_what_is_beyond_it),
        cmocka_unit_test(mistakes_are_told_before_the_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
