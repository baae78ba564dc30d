/* Fragments, against particles that are moved and broken by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "measure/fragments.h"
#include "stage.h"

#define METAL                                                                            \
    "materials: {metal: {eos: {barotropic: {density: 2 kg/m^3, bulk_modulus: 1 kPa}},\n" \
    "  strength: {perfect-plastic: {shear_modulus: 1 kPa, yield: 1 Pa}},\n"              \
    "  failure: {spall: {strength: 1 Pa}}}}\n"

static struct error *find(const struct simulation *simulation, int body, struct fragments *found)
{
    const struct population population = simulation_population(simulation);
    return fragments_find(simulation->ranks, &population, body, 0.8, found);
}

/* A bar of 20 x 4 particles and a block of 3 x 3 that touches it. */
static const char plane[] =
    "format: 1\n"
    "dimension: 2\n"
    "resolution: 1 mm\n"
    "solver: {mpm: {}}\n" METAL "bodies:\n"
    "  bar:   {material: metal, box: {from: [0 mm, 0 mm], to: [20 mm, 4 mm]}}\n"
    "  block: {material: metal, box: {from: [20 mm, 0 mm], to: [23 mm, 3 mm]}}\n"
    "run: {until: 1 s}\n"
    "checks:\n";

/* Two cubes of 3 x 3 x 3 particles. */
static const char space[] =
    "format: 1\n"
    "dimension: 3\n"
    "resolution: 1 mm\n"
    "solver: {mpm: {}}\n" METAL "bodies:\n"
    "  cube: {material: metal, box: {from: [0 mm, 0 mm, 0 mm], to: [3 mm, 3 mm, 3 mm]}}\n"
    "  next: {material: metal, box: {from: [3 mm, 0 mm, 0 mm], to: [6 mm, 3 mm, 3 mm]}}\n"
    "run: {until: 1 s}\n"
    "checks:\n";

/* A disc of 4 x 2 particles about the axis. */
static const char round_case[] =
    "format: 1\n"
    "dimension: 2\n"
    "geometry: axisymmetric\n"
    "resolution: 1 mm\n"
    "solver: {mpm: {}}\n" METAL
    "bodies: {disc: {material: metal, box: {from: [0 mm, 0 mm], to: [4 mm, 2 mm]}}}\n"
    "run: {until: 1 s}\n"
    "checks:\n";

static const char no_check[] = "  it: {finite: pressure, at_most: 0}";

/* The particles of column X of the bar (in mm) fail. */
static void break_at(struct stage *s, double x)
{
    struct particles *p = particles_of(&s->simulation);
    double *damage = particles_field(p, "damage");
    assert_non_null(damage);
    for (int32_t i = 0; i < p->count; i++)
        if (fabs(p->position[i][0] - 1e-3 * (x + 0.5)) < 1e-6)
            damage[i] = 1.0;
}

static void whole_bodies_are_a_fragment_each(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, plane,
                "  all: {fragments: {}, at_most: 2}\n"
                "  heavy: {fragments: {above: 0.1 g/m}, at_most: 1}\n"
                "  mass: {largest_fragment: mass, at_least: 0 kg/m}\n"
                "  size: {largest_fragment: size, of: block, at_least: 0 m}\n"
                "  length: {length: x, at_least: 0 m}\n");
    assert_float_equal(stage_value(&s, 0), 2.0, 0.0);
    assert_float_equal(stage_value(&s, 1), 1.0, 0.0);
    assert_float_equal(stage_value(&s, 2), 160e-6, 1e-12);
    assert_float_equal(stage_value(&s, 3), 2.0 * sqrt(9e-6 / M_PI), 1e-12);
    assert_float_equal(stage_value(&s, 4), 20e-3, 1e-12);
    stage_close(&s);
}

static void failed_particles_part_a_body(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, plane,
                "  bar: {fragments: {}, of: bar, at_most: 1}\n"
                "  pieces: {pieces: 0.8, of: bar, at_most: 1}\n"
                "  length: {length: x, of: bar, at_least: 0 m}\n"
                "  speed: {largest_fragment: speed, of: bar, at_most: 1 m/s}\n"
                "  along: {largest_fragment: velocity.x, of: bar, at_most: 1 m/s}\n"
                "  number: {largest_fragment: particles, of: bar, at_most: 100}\n"
                "  light: {fragments: {below: 50 mg/m}, of: bar, at_most: 3}\n"
                "  mass: {fragments: {take: mass, above: 40 mg/m}, of: bar, at_most: 1 kg/m}\n"
                "  dust: {fragments: {take: dust}, of: bar, at_most: 1 kg/m}\n"
                "  angle: {largest_fragment: angle.y, of: bar, at_most: 60 deg}\n");
    struct particles *p = particles_of(&s.simulation);
    break_at(&s, 4.0);
    break_at(&s, 15.0);
    for (int32_t i = 0; i < p->count; i++) {
        p->velocity[i][0] = p->position[i][0] < 10e-3 ? -3.0 : -1.0;
        p->velocity[i][1] = 2.0 / sqrt(3.0);
    }
    assert_float_equal(stage_value(&s, 0), 3.0, 0.0);
    assert_float_equal(stage_value(&s, 1), 1.0, 0.0); /* failed particles connect pieces */
    assert_float_equal(stage_value(&s, 2), 10e-3, 1e-12);
    assert_float_equal(stage_value(&s, 3), 4.0 / sqrt(3.0), 1e-12);
    assert_float_equal(stage_value(&s, 4), -2.0, 1e-12);
    assert_float_equal(stage_value(&s, 5), 40.0, 0.0);
    assert_float_equal(stage_value(&s, 6), 2.0, 0.0);
    assert_float_equal(stage_value(&s, 7), 80e-6, 1e-15);
    assert_float_equal(stage_value(&s, 8), 16e-6, 1e-15);
    assert_float_equal(stage_value(&s, 9), M_PI / 3.0, 1e-12);
    stage_close(&s);
}

static void distance_parts_a_body_too(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, plane,
                "  bar: {fragments: {}, of: bar, at_most: 1}\n"
                "  wide: {fragments: {link: 1.5}, of: bar, at_most: 1}\n");
    struct particles *p = particles_of(&s.simulation);
    for (int32_t i = 0; i < p->count; i++)
        p->position[i][0] += p->position[i][0] > 10e-3 ? 1e-3 : 0.0;
    assert_float_equal(stage_value(&s, 0), 2.0, 0.0);
    assert_float_equal(stage_value(&s, 1), 1.0, 0.0);
    stage_close(&s);
}

static void a_body_that_failed_as_a_whole_has_no_fragment(void **state)
{
    (void)state;
    struct stage s;
    stage_begin(&s, plane,
                "  number: {fragments: {}, of: block, at_most: 1}\n"
                "  mass: {largest_fragment: mass, of: block, at_most: 1 kg/m}\n"
                "  length: {length: x, of: block, at_most: 1 m}\n");
    for (int x = 20; x < 23; x++)
        break_at(&s, x);
    assert_float_equal(stage_value(&s, 0), 0.0, 0.0);
    assert_true(isnan(stage_value(&s, 1)));
    assert_true(isnan(stage_value(&s, 2)));
    stage_close(&s);
}

static void fragments_are_listed_heaviest_first(void **state)
{
    (void)state;
    struct stage s;
    struct fragments found;
    stage_begin(&s, plane, no_check);
    struct particles *p = particles_of(&s.simulation);
    break_at(&s, 4.0);
    for (int32_t i = 0; i < p->count; i++)
        if (p->position[i][0] < 4e-3) { /* rotates at 5 rad/s about its moving centre */
            p->velocity[i][0] = 7.0 - 5.0 * (p->position[i][1] - 2e-3);
            p->velocity[i][1] = 5.0 * (p->position[i][0] - 2e-3);
        }
    expect_success(find(&s.simulation, -1, &found));
    assert_int_equal(found.count, 3);
    assert_int_equal(found.item[0].particles, 60);
    assert_int_equal(found.item[1].particles, 16);
    assert_int_equal(found.item[2].particles, 9);
    assert_int_equal(found.item[2].body, 1);
    const struct fragment *end = &found.item[1];
    assert_float_equal(end->center[0], 2e-3, 1e-12);
    assert_float_equal(end->velocity[0], 7.0, 1e-12);
    assert_float_equal(end->velocity[1], 0.0, 1e-12);
    /* The particles are squares: those at rest about their own centres add 1/16 to the inertia. */
    assert_float_equal(end->spin[2], 5.0 * 15.0 / 16.0, 1e-9);
    assert_float_equal(end->low[0], 0.0, 1e-12);
    assert_float_equal(end->high[1], 4e-3, 1e-12);
    assert_int_equal(found.dust.particles, 4);
    assert_float_equal(found.dust.mass, 8e-6, 1e-15);
    assert_float_equal(found.dust.center[0], 4.5e-3, 1e-12);
    for (int32_t i = 0; i < p->count; i++) {
        const double x = p->position[i][0];
        const int64_t wanted = x < 4e-3 ? 1 : x < 5e-3 ? FRAGMENT_NONE : x < 20e-3 ? 0 : 2;
        assert_int_equal(found.of_member[i], wanted);
    }
    fragments_free(&found);
    stage_close(&s);
}

static void fragments_of_space_have_the_size_and_spin_of_cubes(void **state)
{
    (void)state;
    struct stage s;
    struct fragments found;
    stage_begin(&s, space, no_check);
    struct particles *p = particles_of(&s.simulation);
    for (int32_t i = 0; i < p->count; i++) {
        const double y = p->position[i][1] - 1.5e-3, z = p->position[i][2] - 1.5e-3;
        p->velocity[i][1] = p->body[i] ? 0.0 : -9.0 * z;
        p->velocity[i][2] = p->body[i] ? 0.0 : 9.0 * y;
    }
    expect_success(find(&s.simulation, 0, &found));
    assert_int_equal(found.count, 1);
    assert_float_equal(found.item[0].size, cbrt(6.0 / M_PI * 27e-9), 1e-12);
    assert_float_equal(found.item[0].mass, 54e-9, 1e-18);
    assert_float_equal(found.item[0].spin[0], 9.0 * 8.0 / 9.0, 1e-9);
    assert_float_equal(found.item[0].spin[1], 0.0, 1e-9);
    fragments_free(&found);
    stage_close(&s);
}

static void size_in_axisymmetry_is_that_of_the_sphere(void **state)
{
    (void)state;
    struct stage s;
    struct fragments found;
    stage_begin(&s, round_case, no_check);
    expect_success(find(&s.simulation, -1, &found));
    assert_int_equal(found.count, 1);
    assert_float_equal(found.item[0].size, cbrt(6.0 * 32e-9), 1e-9);
    assert_float_equal(found.item[0].low[0], 0.0, 1e-12);
    fragments_free(&found);
    stage_close(&s);
}

/* Fragments do not depend on where their particles are stored. */
static void the_order_of_storage_does_not_matter(void **state)
{
    (void)state;
    struct stage s[2];
    struct fragments found[2];
    for (int k = 0; k < 2; k++) {
        stage_begin(&s[k], plane, no_check);
        struct particles *p = particles_of(&s[k].simulation);
        break_at(&s[k], 7.0);
        for (int32_t i = 0; i < p->count; i++)
            p->velocity[i][0] = 1.0 / (3.0 + (double)(p->id[i] % 97));
        if (k == 1)
            for (int32_t i = 0, j = p->count - 1; i < j; i++, j--) {
                for (int f = 0; f < p->fields; f++) {
                    const struct field *field = &p->field[f];
                    const size_t bytes = field_bytes(field);
                    char *a = (char *)field->data + (size_t)i * bytes, kept[256];
                    char *b = (char *)field->data + (size_t)j * bytes;
                    assert_true(bytes <= sizeof kept);
                    memcpy(kept, a, bytes);
                    memcpy(a, b, bytes);
                    memcpy(b, kept, bytes);
                }
            }
        expect_success(find(&s[k].simulation, -1, &found[k]));
    }
    assert_int_equal(found[0].count, 3);
    assert_int_equal(found[1].count, 3);
    assert_memory_equal(found[0].item, found[1].item, 3 * sizeof *found[0].item);
    for (int k = 0; k < 2; k++) {
        fragments_free(&found[k]);
        stage_close(&s[k]);
    }
}

static void the_field_numbers_fragments_from_one(void **state)
{
    (void)state;
    struct stage s;
    struct fragments found;
    struct column columns[COLUMNS_MAX];
    int component;
    double number;
    stage_begin(&s, plane, no_check);
    break_at(&s, 4.0);
    expect_success(find(&s.simulation, -1, &found));
    const struct population shown = fragments_show(look(&s), &found, columns);
    const struct column *column = column_find(&shown, fragments_column, &component);
    assert_non_null(column);
    for (int32_t i = 0; i < shown.count; i++) {
        column_read(&shown, column, i, i + 1, &number);
        assert_float_equal(number, (double)(found.of_member[i] + 1), 0.0);
    }
    fragments_free(&found);
    stage_close(&s);
}

static void the_table_ends_with_the_dust(void **state)
{
    (void)state;
    static const char path[] = "fragments.csv";
    static const char *const lines[] = {
        "fragment,body,particles,mass [kg/m],size [m],position.x [m],position.y [m],"
        "velocity.x [m/s],velocity.y [m/s],spin.z [rad/s],width.x [m],width.y [m]\n",
        "1,\"bar\",60,", "2,\"bar\",16,", "3,\"block\",9,", "dust,\"\",4,"};
    struct stage s;
    struct fragments found;
    char line[512];
    stage_begin(&s, plane, no_check);
    break_at(&s, 4.0);
    expect_success(find(&s.simulation, -1, &found));
    expect_success(fragments_write(path, &s.simulation, &found));
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    for (size_t i = 0; i < COUNT_OF(lines); i++) {
        assert_non_null(fgets(line, sizeof line, file));
        assert_true(!strncmp(line, lines[i], strlen(lines[i])));
    }
    assert_null(fgets(line, sizeof line, file));
    fclose(file);
    remove(path);
    fragments_free(&found);
    stage_close(&s);
}

static void mistakes_are_told_before_the_run(void **state)
{
    (void)state;
    static const struct {
        const char *check, *message;
    } cases[] = {
        {"  it: {fragments: {above: 1 kg}, at_most: 1}", "`above`: the mass of a fragment is in"},
        {"  it: {fragments: {take: dust, above: 1 kg/m}, at_most: 1 kg/m}", "no meaning for dust"},
        {"  it: {fragments: {}, between: [0 m, 1 m], at_most: 1}", "`between` has no meaning"},
        {"  it: {largest_fragment: velocity.z, at_most: 1 m/s}", "the case has 2 dimensions"},
        {"  it: {largest_fragment: mass, at_most: 1 kg}", "`at_most` is in"},
        {"  it: {length: z, at_most: 1 m}", "`along`: the case has 2 dimensions"},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        struct stage s;
        struct error *error = stage_open(&s, plane, cases[i].check);
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
        cmocka_unit_test(whole_bodies_are_a_fragment_each),
        cmocka_unit_test(failed_particles_part_a_body),
        cmocka_unit_test(distance_parts_a_body_too),
        cmocka_unit_test(a_body_that_failed_as_a_whole_has_no_fragment),
        cmocka_unit_test(fragments_are_listed_heaviest_first),
        cmocka_unit_test(fragments_of_space_have_the_size_and_spin_of_cubes),
        cmocka_unit_test(size_in_axisymmetry_is_that_of_the_sphere),
        cmocka_unit_test(the_order_of_storage_does_not_matter),
        cmocka_unit_test(the_field_numbers_fragments_from_one),
        cmocka_unit_test(the_table_ends_with_the_dust),
        cmocka_unit_test(mistakes_are_told_before_the_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
