/* Columns: the fields of the store by name, quantities computed from them, and single
 * components. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "model/columns.h"
#include "populations.h"

enum { COUNT = 700 };

static const struct field_declaration solver_fields[] = {
    {"sound_speed", "m/s", "longitudinal sound speed", NUMBER_DOUBLE, 1, FIELD_DERIVED},
    {"hidden", NULL, "not shown", NUMBER_DOUBLE, 1, FIELD_STATE},
};

static const struct problem three = {.dimension = 3};

static void set_up(struct simulation *simulation, struct population *population)
{
    *simulation = (struct simulation){.problem = &three};
    int32_t first;
    assert_null(give_particles(simulation, 1.0, solver_fields, (int)COUNT_OF(solver_fields)));
    struct particles *p = particles_of(simulation);
    assert_null(particles_append(p, COUNT, &first));
    double *sound_speed = particles_field(p, "sound_speed");
    for (int i = 0; i < COUNT; i++) {
        p->pressure[i] = 100.0 + i;
        sound_speed[i] = 5000.0 + i;
        for (int k = 0; k < 3; k++)
            p->velocity[i][k] = (i + 1) * (k + 1);
        for (int k = 0; k < 6; k++)
            p->deviator[i][k] = i * (k + 1);
    }
    p->count = COUNT;
    *population = simulation_population(simulation);
}

static void every_double_field_with_a_unit_is_a_column(void **state)
{
    (void)state;
    struct simulation simulation;
    struct population population;
    set_up(&simulation, &population);
    static const char *const shown[] = {"mass",     "density",  "energy",      "pressure",
                                        "position", "velocity", "deviator",    "plastic_strain",
                                        "stress",   "speed",    "sound_speed", "equivalent_stress"};
    int component;
    for (size_t i = 0; i < COUNT_OF(shown); i++) {
        assert_non_null(column_find(&population, shown[i], &component));
        assert_int_equal(component, -1);
    }
    assert_int_equal(population.columns, (int)COUNT_OF(shown));
    const struct column *pressure = column_find(&population, "pressure", &component);
    assert_ptr_equal(population.field[pressure->field].data, particles_of(&simulation)->pressure);
    assert_string_equal(column_find(&population, "sound_speed", &component)->unit, "m/s");
    free_particles(&simulation);
}

static void names_that_are_no_column_are_not_found(void **state)
{
    (void)state;
    struct simulation simulation;
    struct population population;
    set_up(&simulation, &population);
    static const char *const unknown[] = {
        "id",         "hidden",   "press",     "pressures", "pressure.x", "velocity.xx",
        "velocity.w", "stress.x", "velocity.", "",          ".x"};
    int component;
    for (size_t i = 0; i < COUNT_OF(unknown); i++)
        assert_null(column_find(&population, unknown[i], &component));
    free_particles(&simulation);
}

static void a_component_reads_as_part_of_the_whole(void **state)
{
    (void)state;
    struct simulation simulation;
    struct population population;
    set_up(&simulation, &population);
    static const char *const names[] = {"velocity.x", "velocity.z", "stress.xx",
                                        "stress.zz",  "stress.zx",  "pressure"};
    for (size_t n = 0; n < COUNT_OF(names); n++) {
        int component;
        const struct column *column = column_find(&population, names[n], &component);
        assert_non_null(column);
        double whole[6 * COUNT], part[COUNT];
        const int64_t begin = 13, end = COUNT - 5;
        column_read(&population, column, begin, end, whole);
        column_read_component(&population, column, component, begin, end, part);
        for (int64_t i = 0; i < end - begin; i++)
            assert_true(part[i] == whole[i * column->components + (component < 0 ? 0 : component)]);
    }
    free_particles(&simulation);
}

static void stress_and_speed_follow_from_the_fields(void **state)
{
    (void)state;
    struct simulation simulation;
    struct population population;
    set_up(&simulation, &population);
    int component;
    double stress[6], mises, speed;
    const int i = 2;
    column_read(&population, column_find(&population, "stress", &component), i, i + 1, stress);
    column_read(&population, column_find(&population, "equivalent_stress", &component), i, i + 1,
                &mises);
    column_read(&population, column_find(&population, "speed", &component), i, i + 1, &speed);
    const double wanted[6] = {2.0 - 102.0, 4.0 - 102.0, 6.0 - 102.0, 8.0, 10.0, 12.0};
    assert_memory_equal(stress, wanted, sizeof wanted);
    const double square_sum = 4.0 + 16.0 + 36.0 + 2.0 * (64.0 + 100.0 + 144.0);
    assert_true(fabs(mises - sqrt(1.5 * square_sum)) < 1e-12);
    assert_true(fabs(speed - 3.0 * sqrt(14.0)) < 1e-12);
    free_particles(&simulation);
}

static void a_field_that_cannot_be_chosen_is_told_with_what_could(void **state)
{
    (void)state;
    struct simulation simulation;
    struct population population;
    set_up(&simulation, &population);
    static const struct {
        const char *field, *told;
    } cases[] = {
        {"presure", "the particles have no field \"presure\" (did you mean \"pressure\"?)"},
        {"velocty.x", "the particles have no field \"velocty.x\" (did you mean \"velocity\"?)"},
        {"materal", "the particles have no field \"materal\" (did you mean \"material\"?)"},
        {"velocity.q", "\"velocity\" is a vector, choose one of its components: velocity.x, "
                       "velocity.y, velocity.z"},
        {"stress", "\"stress\" is a tensor, choose one of its components: stress.xx, stress.yy, "
                   "stress.zz, stress.xy, stress.yz, stress.zx"},
        {"pressure.x", "\"pressure.x\": pressure has no components"},
    };
    static const char *const more[] = {"material"};
    const struct column *column;
    int component;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        struct error *error =
            column_choose(&population, cases[i].field, more, 1, &column, &component);
        assert_non_null(error);
        assert_string_equal(error_message(error, 0), cases[i].told);
        error_free(error);
    }
    struct error *error = column_choose(&population, "colour", NULL, 0, &column, &component);
    assert_non_null(strstr(error_message(error, 0), "(known: mass, "));
    error_free(error);
    assert_null(column_choose(&population, "pressure", NULL, 0, &column, &component));
    assert_int_equal(component, 0);
    assert_null(column_choose(&population, "stress.zx", NULL, 0, &column, &component));
    assert_int_equal(component, 5);
    free_particles(&simulation);
}

static void only_components_that_a_case_has_are_offered(void **state)
{
    (void)state;
    static const struct {
        int dimension;
        const char *field, *told;
    } cases[] = {
        {1, "velocity", "\"velocity\" is a vector, choose its component: velocity.x"},
        {1, "stress",
         "\"stress\" is a tensor, choose one of its components: stress.xx, stress.yy, stress.zz"},
        {2, "velocity",
         "\"velocity\" is a vector, choose one of its components: velocity.x, velocity.y"},
        {2, "stress",
         "\"stress\" is a tensor, choose one of its components: stress.xx, stress.yy, "
         "stress.zz, stress.xy"},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        struct simulation simulation = {.problem =
                                            &(struct problem){.dimension = cases[i].dimension}};
        const struct column *column;
        int component;
        assert_null(give_particles(&simulation, 1.0, NULL, 0));
        const struct population population = simulation_population(&simulation);
        struct error *error =
            column_choose(&population, cases[i].field, NULL, 0, &column, &component);
        assert_non_null(error);
        assert_string_equal(error_message(error, 0), cases[i].told);
        error_free(error);
        free_particles(&simulation);
    }
}

static void a_particle_has_a_mass_in_the_unit_of_the_totals(void **state)
{
    (void)state;
    static const struct {
        int dimension;
        enum case_geometry geometry;
        const char *unit;
    } cases[] = {{1, GEOMETRY_PLANE_STRAIN, "kg/m^2"},
                 {2, GEOMETRY_PLANE_STRAIN, "kg/m"},
                 {2, GEOMETRY_AXISYMMETRIC, "kg/rad"},
                 {3, GEOMETRY_PLANE_STRAIN, "kg"}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        struct simulation simulation = {
            .problem =
                &(struct problem){.dimension = cases[i].dimension, .geometry = cases[i].geometry}};
        int component;
        assert_null(give_particles(&simulation, 1.0, NULL, 0));
        const struct population population = simulation_population(&simulation);
        assert_string_equal(column_find(&population, "mass", &component)->unit, cases[i].unit);
        free_particles(&simulation);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_double_field_with_a_unit_is_a_column),
        cmocka_unit_test(names_that_are_no_column_are_not_found),
        cmocka_unit_test(a_component_reads_as_part_of_the_whole),
        cmocka_unit_test(stress_and_speed_follow_from_the_fields),
        cmocka_unit_test(a_field_that_cannot_be_chosen_is_told_with_what_could),
        cmocka_unit_test(only_components_that_a_case_has_are_offered),
        cmocka_unit_test(a_particle_has_a_mass_in_the_unit_of_the_totals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
