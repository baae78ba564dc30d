/* The material library: every file of materials/ can be used and tells where its values come from;
 * its names; what is said where there is no such material. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/memory.h"
#include "case/library.h"
#include "dice.h"
#include "material/material.h"
#include "small_catalogue.h"
#include "source_folder.h"

enum { MATERIALS = 256 };

static const char *const folders[] = {materials_folder};

struct library {
    struct name_list names;
    struct material_input input[MATERIALS];
};

static int open_library(void **state)
{
    struct library *library = calloc(1, sizeof *library);
    assert_non_null(library);
    assert_null(library_names(materials_folder, &library->names));
    assert_in_range(library->names.count, 38, MATERIALS);
    for (int i = 0; i < library->names.count; i++) {
        char *path = library_file(folders, 1, library->names.names[i]);
        assert_non_null(path);
        struct error *error = library_read(path, &small_catalogue, &library->input[i]);
        if (error)
            fail_msg("%s", error_message(error, 0));
        free(path);
    }
    *state = library;
    return 0;
}

static int close_library(void **state)
{
    struct library *library = *state;
    for (int i = 0; i < library->names.count; i++)
        library_release(&library->input[i]);
    library_names_free(&library->names);
    free(library);
    return 0;
}

static int find(const struct library *library, const char *name)
{
    for (int i = 0; i < library->names.count; i++)
        if (!strcmp(library->names.names[i], name))
            return i;
    fail_msg("no %s", name);
    return -1;
}

static void sound_travels_in_every_material_at_rest(void **state)
{
    const struct library *library = *state;
    for (int i = 0; i < library->names.count; i++) {
        struct point point;
        struct response response;
        const struct material *material = library->input[i].material;
        if (!library_rest(material, &point, &response))
            fail_msg("%s: no state of rest", library->names.names[i]);
        assert_true(response.sound_long > 10.0 && response.sound_long < 20000.0);
        assert_true(response.status == 0);
        assert_true((response.sound_shear > 0.0) == material_has_strength(material));
        assert_true(point.density == material_density(material));
    }
}

static void rest_is_without_energy_but_for_gases(void **state)
{
    const struct library *library = *state;
    struct point point;
    struct response response;
    assert_true(library_rest(library->input[find(library, "water")].material, &point, &response));
    assert_true(point.pressure == 0.0 && point.energy == 0.0);
    assert_true(library_rest(library->input[find(library, "air")].material, &point, &response));
    assert_true(fabs(point.pressure - 101325.0) < 1e-6);
    assert_true(fabs(response.sound_long - sqrt(1.4 * 101325.0 / 1.225)) < 1e-9);
    assert_true(
        library_rest(library->input[find(library, "petn-jwl")].material, &point, &response));
    assert_true(fabs(point.pressure) < 10.0);
}

static void every_material_says_what_it_is_and_whence(void **state)
{
    const struct library *library = *state;
    for (int i = 0; i < library->names.count; i++) {
        const struct material_input *input = &library->input[i];
        assert_non_null(input->description);
        assert_non_null(input->source);
        assert_in_range(strlen(input->description), 4, 80);
        assert_in_range(strlen(input->source), 20, 200);
    }
}

static void names_are_plain_and_no_two_materials_are_the_same(void **state)
{
    const struct library *library = *state;
    for (int i = 0; i < library->names.count; i++) {
        const char *name = library->names.names[i];
        const struct material_input *input = &library->input[i];
        assert_int_equal(strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-."), strlen(name));
        assert_true(i == 0 || strcmp(library->names.names[i - 1], name) < 0);
        for (int k = 0; k < i; k++) {
            if (!memcmp(library->input[k].material, input->material, sizeof *input->material))
                fail_msg("%s is %s", name, library->names.names[k]);
            assert_string_not_equal(library->input[k].description, input->description);
        }
    }
}

/* A case of the material NAME, with MORE after its shape. */
static struct error *read_named(const char *name, const char *more, struct simulation_case **input)
{
    static const char path[] = "test_library_names.yaml";
    static const char text[] =
        "format: 1\ndimension: 1\nresolution: 1 mm\nrun: {until: 1 us}\nsolver: sph\n"
        "let: {s: 2, m: 3, kg: 4, K: 5, J: 6, Pa: 7, GPa: 8, MPa: 9, km: 10, g: 11, cm: 12,\n"
        "      us: 13, mol: 14, kJ: 15, mm: 16, W: 17}\n"
        "materials: {one: {library: %s}}\n"
        "bodies: {body: {material: one, box: {from: [0 mm], to: [5 mm]}%s}}\n";
    const struct case_options options = {.library_paths = folders, .library_count = 1};
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fprintf(file, text, name, more) > 0 && fclose(file) == 0);
    struct error *error = case_read(path, &options, &small_catalogue, input);
    unlink(path);
    return error;
}

/* A file of the library means the same in every case, whatever names that has. Gases want a
 * pressure, explosives a detonation. */
static void names_of_a_case_do_not_reach_into_the_library(void **state)
{
    static const char *const more[][2] = {
        {"sound does not travel", ", pressure: 1 atm"},
        {"nothing ignites this", "}}\ndetonations: {middle: {at: [1 mm]"}};
    const struct library *library = *state;
    for (int i = 0; i < library->names.count; i++) {
        struct simulation_case *input;
        struct error *error = read_named(library->names.names[i], "", &input);
        for (size_t k = 0; k < COUNT_OF(more) && error; k++)
            if (strstr(error_message(error, 0), more[k][0])) {
                error_free(error);
                error = read_named(library->names.names[i], more[k][1], &input);
            }
        if (error)
            fail_msg("%s", error_message(error, 0));
        assert_memory_equal(case_material(input, 0)->material, library->input[i].material,
                            sizeof *library->input[i].material);
        case_free(input);
    }
}

/* The strength computes its own temperature from a heat capacity, so that the material has one. */
static void a_capacity_of_the_strength_is_that_of_the_material(void **state)
{
    (void)state;
    static const struct {
        const char *beside, *start;
        double capacity;
    } cases[] = {
        {"", ", temperature: 500 K", 383.0},
        {", heat: {capacity: 400 J/(kg*K)}", ", temperature: 500 K", 400.0},
        {", strength: none", "", NAN},
    };
    static const char path[] = "test_library_capacity.yaml";
    const struct case_options options = {.library_paths = folders, .library_count = 1};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fprintf(file,
                "format: 1\ndimension: 1\nresolution: 1 mm\nrun: {until: 1 us}\nsolver: sph\n"
                "materials: {one: {library: copper-johnson-cook%s}}\n"
                "bodies: {body: {material: one, box: {from: [0 mm], to: [5 mm]}%s}}\n",
                cases[i].beside, cases[i].start);
        fclose(file);
        struct simulation_case *input;
        assert_success(case_read(path, &options, &small_catalogue, &input));
        unlink(path);
        const struct material *material = case_material(input, 0)->material;
        const struct point start = case_body(input, 0)->start;
        if (isnan(cases[i].capacity)) {
            assert_true(isnan(material->heat.capacity));
        } else {
            assert_true(material->heat.capacity == cases[i].capacity);
            assert_near(material_start_heating(material, &start), 500.0 - 293.0, 1e-9);
        }
        case_free(input);
    }
}

static bool holds_one_of(const char *text, const char *const *words)
{
    for (; *words; words++)
        if (strstr(text, *words))
            return true;
    return false;
}

/* A line whose value holds a digit has a comment that names a place of the source, or another
 * source by its year. */
static void check_line(const char *file, int number, char *line)
{
    static const char *const places[] = {"section ", "table ", "chapter ", "equation ", " test",
                                         "(2-",      " (19",   " (20",     NULL};
    char *comment = strstr(line, " #");
    if (comment)
        *comment++ = '\0';
    const char *value = strchr(line, ':');
    if (!value || line[0] == '#' || !strncmp(line, "source:", 7) ||
        !strncmp(line, "description:", 12))
        return;
    if (strcspn(value, "0123456789") == strlen(value))
        return;
    if (!comment || !holds_one_of(comment, places))
        fail_msg("%s:%d: a value without its source: %s", file, number, line);
}

static void every_value_carries_its_source(void **state)
{
    const struct library *library = *state;
    for (int i = 0; i < library->names.count; i++) {
        char line[512];
        char *path = library_file(folders, 1, library->names.names[i]);
        FILE *file = fopen(path, "r");
        assert_non_null(file);
        for (int number = 1; fgets(line, sizeof line, file); number++)
            check_line(library->names.names[i], number, line);
        fclose(file);
        free(path);
    }
}

static void a_slip_gets_the_nearest_name(void **state)
{
    (void)state;
    assert_null(library_file(folders, 1, "tungsen"));
    assert_null(library_file(folders, 1, "../materials/water"));
    char *text = library_unknown(folders, 1, "tungsen");
    assert_string_equal(text,
                        "no material \"tungsen\" in the library (did you mean \"tungsten\"?)");
    free(text);
    text = library_unknown(folders, 1, "steel");
    assert_non_null(strstr(text, "no material \"steel\" in the library (did you mean "
                                 "\"steel-1006\", \"steel-1006-failure\","));
    free(text);
    text = library_unknown(folders, 1, "unobtainium");
    assert_non_null(
        strstr(text, "no material \"unobtainium\" in the library (known: air, alumina,"));
    free(text);
}

static void a_folder_that_is_not_there_is_told(void **state)
{
    (void)state;
    struct name_list names;
    struct error *error = library_names("no/such/folder", &names);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_string_equal(error_message(error, 0), "no/such/folder: No such file or directory");
    assert_int_equal(names.count, 0);
    error_free(error);
}

static void mistakes_of_a_file_are_told_where_they_stand(void **state)
{
    (void)state;
    struct material_input input;
    struct error *error = library_read(mistaken_material, &small_catalogue, &input);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_int_equal(error_count(error), 3);
    assert_non_null(strstr(error_message(error, 0), "mistaken.yaml:5:14: eos.barotropic.density"));
    error_free(error);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sound_travels_in_every_material_at_rest),
        cmocka_unit_test(rest_is_without_energy_but_for_gases),
        cmocka_unit_test(every_material_says_what_it_is_and_whence),
        cmocka_unit_test(names_of_a_case_do_not_reach_into_the_library),
        cmocka_unit_test(names_are_plain_and_no_two_materials_are_the_same),
        cmocka_unit_test(a_capacity_of_the_strength_is_that_of_the_material),
        cmocka_unit_test(every_value_carries_its_source),
        cmocka_unit_test(a_slip_gets_the_nearest_name),
        cmocka_unit_test(a_folder_that_is_not_there_is_told),
        cmocka_unit_test(mistakes_of_a_file_are_told_where_they_stand),
    };
    return cmocka_run_group_tests(tests, open_library, close_library);
}
