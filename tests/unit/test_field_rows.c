/* The rows of a solver's fields: which are declared, with how many components, and where their
 * pointers go. */
#include "dice.h"

#include "model/particles/population.h"
#include "particle/field_rows.h"
#include "particle/particles.h"

enum { WARM = 1, FLAT = 2 };
enum { SIZE_TENSOR = 1 };

struct pointers {
    double *always, *warmth, *both;
    double *tensor;
};

static const struct field_row rows[] = {
    {.field = {"always", "m", "always there", NUMBER_DOUBLE, 1, FIELD_DERIVED},
     .offset = offsetof(struct pointers, always),
     .state_when = WARM},
    {.field = {"warmth", "K", "of warm ones", NUMBER_DOUBLE, 1, FIELD_STATE},
     .when = WARM,
     .offset = offsetof(struct pointers, warmth)},
    {.field = {"both", "", "of warm and flat ones", NUMBER_DOUBLE, 1, FIELD_STATE},
     .when = WARM | FLAT,
     .offset = offsetof(struct pointers, both)},
    {.field = {"tensor", "", "as many components as the run asks for", NUMBER_DOUBLE, 1,
               FIELD_STATE},
     .size = SIZE_TENSOR,
     .offset = offsetof(struct pointers, tensor)},
    FIELD_ROWS_END,
};

static void only_fields_whose_conditions_are_met_exist(void **state)
{
    (void)state;
    const int size[] = {0, 6};
    const struct field_needs none = {0, size}, warm = {WARM, size}, all = {WARM | FLAT, size};
    struct field_declaration fields[8];
    assert_int_equal(field_rows_declare(rows, &none, fields), 2);
    assert_string_equal(fields[1].name, "tensor");
    assert_int_equal(field_rows_declare(rows, &warm, fields), 3);
    assert_int_equal(field_rows_declare(rows, &all, fields), 4);
}

static void sizes_and_kinds_are_those_of_the_run(void **state)
{
    (void)state;
    const int size[] = {0, 6};
    const struct field_needs none = {0, size}, warm = {WARM, size};
    struct field_declaration fields[8];
    field_rows_declare(rows, &none, fields);
    assert_int_equal(fields[0].kind, FIELD_DERIVED);
    assert_int_equal(fields[0].components, 1);
    assert_int_equal(fields[1].components, 6);
    field_rows_declare(rows, &warm, fields);
    assert_int_equal(fields[0].kind, FIELD_STATE);
}

static void pointers_lead_to_the_fields_that_exist(void **state)
{
    (void)state;
    const int size[] = {0, 6};
    const struct field_needs warm = {WARM, size};
    struct field_declaration fields[8];
    struct particles particles;
    struct pointers pointers = {.both = (double *)size};
    int32_t first;
    assert_null(
        particles_create(3, 1.0, fields, field_rows_declare(rows, &warm, fields), &particles));
    assert_null(particles_append(&particles, 2, &first));
    field_rows_bind(rows, &warm, &particles, &pointers);
    assert_ptr_equal(pointers.always, particles_field(&particles, "always"));
    assert_ptr_equal(pointers.warmth, particles_field(&particles, "warmth"));
    assert_ptr_equal(pointers.tensor, particles_field(&particles, "tensor"));
    assert_null(pointers.both);
    particles_destroy(&particles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_fields_whose_conditions_are_met_exist),
        cmocka_unit_test(sizes_and_kinds_are_those_of_the_run),
        cmocka_unit_test(pointers_lead_to_the_fields_that_exist),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
