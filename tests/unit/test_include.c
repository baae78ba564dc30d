/* Cases that include others: what lies over what, and where the files are looked for. Mistakes have
 * their messages in tests/data/bad. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/memory.h"
#include "small_catalogue.h"
#include "source_folder.h"

static const char common[] = "format: 1\n"
                             "title: the common part\n"
                             "dimension: 1\n"
                             "resolution: d\n"
                             "let: {d: 1 mm, speed: 2*slow, slow: 10 m/s}\n"
                             "solver: sph\n"
                             "materials: {a: {library: aluminium}}\n"
                             "bodies: {flyer: {material: a, box: {from: [0 m], to: [20*d]}}}\n"
                             "run: {until: 1 us}\n"
                             "short: {run: {until: 3 ns}, resolution: 2*d}\n";

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, strlen(text), file), strlen(text));
    assert_int_equal(fclose(file), 0);
}

static struct error *read_with(const char *path, bool quick, struct simulation_case **input)
{
    static const char *const folders[] = {materials_folder};
    const struct case_options options = {
        .form = quick ? "short" : NULL, .library_paths = folders, .library_count = 1};
    return case_read(path, &options, &small_catalogue, input);
}

static struct simulation_case *read_good(const char *path, bool quick)
{
    struct simulation_case *input = NULL;
    struct error *error = read_with(path, quick, &input);
    for (int i = 0; error && i < error_count(error); i++)
        print_error("%s\n", error_message(error, i));
    assert_null(error);
    return input;
}

static int enter_folder(void **state)
{
    (void)state;
    static char folder[] = "/tmp/bolide-include-XXXXXX";
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    assert_int_equal(mkdir("parts", 0777), 0);
    write_file("parts/common.yaml", "include: order.yaml\nlet: {slow: 10 m/s}\nformat: 1\n");
    write_file("parts/order.yaml", common);
    return 0;
}

static int leave_folder(void **state)
{
    (void)state;
    static const char *const files[] = {"case.yaml",        "second.yaml",       "link.yaml",
                                        "parts/order.yaml", "parts/common.yaml", "parts"};
    char folder[4096];
    for (size_t i = 0; i < COUNT_OF(files); i++)
        remove(files[i]);
    assert_non_null(getcwd(folder, sizeof folder));
    assert_int_equal(chdir("/"), 0);
    return rmdir(folder);
}

/* `order.yaml` alone is wrong, since `speed` stands before what it rests on. */
static void the_case_lies_over_what_it_includes(void **state)
{
    (void)state;
    write_file("parts/order.yaml", common);
    write_file("case.yaml", "include: parts/common.yaml\n"
                            "title: mine\n"
                            "let: {speed: 30 m/s, mine: speed + slow}\n"
                            "bodies: {flyer: {velocity: [mine]}, target: {material: a, box: {from: "
                            "[20*d], to: [30*d]}}}\n");
    struct simulation_case *input = read_good("case.yaml", false);
    assert_string_equal(input->title, "mine");
    assert_int_equal(input->bodies.count, 2);
    assert_string_equal(input->bodies.names[0], "flyer");
    assert_true(case_body(input, 0)->velocity.at[0].constant == 40.0);
    assert_true(input->run.until == 1e-6 && input->resolution == 1e-3);
    case_free(input);
}

static void later_files_lie_over_earlier_ones(void **state)
{
    (void)state;
    write_file("second.yaml", "let: {speed: 7 m/s}\ntitle: second\nresolution: 2*d\n");
    write_file("case.yaml", "include: [parts/common.yaml, second.yaml]\nresolution: 4*d\n"
                            "bodies: {flyer: {velocity: [speed]}}\n");
    struct simulation_case *input = read_good("case.yaml", false);
    assert_string_equal(input->title, "second");
    assert_true(input->resolution == 4e-3);
    assert_true(case_body(input, 0)->velocity.at[0].constant == 7.0);
    case_free(input);
}

static void a_key_without_a_value_removes_what_is_included(void **state)
{
    (void)state;
    write_file("case.yaml", "include: parts/common.yaml\nlet: {speed: 1 m/s}\ntitle:\nshort:\n");
    struct simulation_case *input = read_good("case.yaml", true);
    assert_true(!input->title || !input->title[0]);
    assert_true(input->run.until == 1e-6);
    case_free(input);
    write_file("case.yaml", "include: parts/common.yaml\nlet: {speed: 1 m/s}\nresolution:\n");
    struct error *error = read_with("case.yaml", false, &input);
    assert_non_null(error);
    assert_non_null(strstr(error_message(error, 0), "resolution"));
    error_free(error);
}

static void short_forms_are_merged_too(void **state)
{
    (void)state;
    write_file("case.yaml", "include: parts/common.yaml\nlet: {speed: 1 m/s}\n"
                            "short: {run: {until: 5 ns}, title: quick}\n");
    struct simulation_case *input = read_good("case.yaml", true);
    assert_string_equal(input->title, "quick");
    assert_true(input->run.until == 5e-9 && input->resolution == 2e-3);
    case_free(input);
}

static void a_file_may_be_included_twice_but_not_for_ever(void **state)
{
    (void)state;
    write_file("second.yaml",
               "include: [parts/common.yaml, parts/common.yaml]\nlet: {speed: 1 m/s}\n");
    write_file("case.yaml", "include: [second.yaml, second.yaml]\n");
    case_free(read_good("case.yaml", false));

    char text[1024] = "include: [";
    for (int i = 0; i < 20; i++)
        strcat(text, "second.yaml, ");
    strcat(text, "second.yaml]\n");
    write_file("case.yaml", text);
    struct simulation_case *input = NULL;
    struct error *error = read_with("case.yaml", false, &input);
    assert_non_null(error);
    assert_non_null(strstr(error_message(error, 0), "more than 64 files"));
    error_free(error);
}

static void a_file_is_known_by_more_than_its_name(void **state)
{
    (void)state;
    write_file("case.yaml", "include: link.yaml\nformat: 1\n");
    assert_int_equal(symlink("case.yaml", "link.yaml"), 0);
    struct simulation_case *input = NULL;
    struct error *error = read_with("case.yaml", false, &input);
    assert_non_null(error);
    assert_string_equal(error_message(error, 0),
                        "case.yaml:1:10: include: link.yaml: a file cannot include itself");
    error_free(error);
}

static void a_written_case_includes_nothing(void **state)
{
    (void)state;
    write_file("case.yaml", "include: parts/common.yaml\nlet: {speed: 1 m/s}\n");
    struct simulation_case *input = read_good("case.yaml", false);
    FILE *file = fopen("second.yaml", "w");
    assert_non_null(file);
    assert_null(case_write(input, file));
    assert_int_equal(fclose(file), 0);
    case_free(input);
    remove("parts/order.yaml");
    input = read_good("second.yaml", false);
    assert_string_equal(input->title, "the common part");
    case_free(input);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_case_lies_over_what_it_includes),
        cmocka_unit_test(later_files_lie_over_earlier_ones),
        cmocka_unit_test(a_key_without_a_value_removes_what_is_included),
        cmocka_unit_test(short_forms_are_merged_too),
        cmocka_unit_test(a_file_may_be_included_twice_but_not_for_ever),
        cmocka_unit_test(a_file_is_known_by_more_than_its_name),
        cmocka_unit_test(a_written_case_includes_nothing),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
