/* A convergence study on paper: its tables, its page, and the scales of its plot. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <unistd.h>

#include "scratch_folder.h"

#include "base/csv.h"
#include "base/file.h"
#include "page/study.h"

static double resolution[] = {4e-3, 2e-3, 1e-3};
static struct study_run runs[] = {
    {"n=1", 4e-3, 0.5, 10, true}, {"n=2", 2e-3, 2.0, 20, true}, {"n=4", 1e-3, 8.0, 40, true}};

/* Second-order data, one without an exact value, and one that nothing is known of. */
static double norm[] = {16.0, 4.0, 1.0}, norm_order[] = {NAN, 2.0, 2.0};
static double value[] = {8.16e9, 8.04e9, 8.01e9}, error[] = {0.16e9, 0.04e9, 0.01e9};
static double value_order[] = {NAN, NAN, 2.0};
static double nothing[] = {NAN, NAN, NAN};

static struct study make_study(struct study_quantity *quantity)
{
    const struct extrapolation none = {APPROACH_UNKNOWN, NAN, NAN, NAN};
    quantity[0] = (struct study_quantity){.name = "L1 <&> \"pressure\", all",
                                          .kind = STUDY_NORM,
                                          .exact = NAN,
                                          .measured = norm,
                                          .error = norm,
                                          .order = norm_order,
                                          .fitted = 2.0,
                                          .extrapolation = none,
                                          .low = 1.8,
                                          .high = INFINITY,
                                          .source = "theory",
                                          .verdict = STUDY_PASSED,
                                          .verdict_text = "passed"};
    quantity[1] = (struct study_quantity){.name = "rebound",
                                          .unit = "Pa",
                                          .kind = STUDY_ESTIMATE,
                                          .exact = NAN,
                                          .measured = value,
                                          .error = error,
                                          .order = value_order,
                                          .fitted = 2.0,
                                          .extrapolation = extrapolate(resolution, value),
                                          .low = -INFINITY,
                                          .high = INFINITY};
    quantity[2] = (struct study_quantity){.name = "lost",
                                          .kind = STUDY_DISTANCE,
                                          .exact = 0.0,
                                          .measured = nothing,
                                          .error = nothing,
                                          .order = nothing,
                                          .fitted = NAN,
                                          .extrapolation = none,
                                          .low = -INFINITY,
                                          .high = INFINITY};
    return (struct study){"A study", "n", 3, 3, runs, quantity};
}

static struct csv read_table(const char *name)
{
    struct csv csv;
    char *path = path_join(folder, name);
    assert_null(csv_read(path, &csv));
    free(path);
    return csv;
}

static void a_study_is_two_tables_a_plot_and_a_page(void **state)
{
    (void)state;
    struct study_quantity quantity[3];
    struct study study = make_study(quantity);
    assert_null(study_write(folder, &study));
    struct csv table = read_table("convergence.csv"), orders = read_table("convergence-orders.csv");
    assert_int_equal(table.rows, 3);
    assert_string_equal(csv_field(&table, 2, csv_column(&table, "run")), "n=4");
    assert_float_equal(csv_number(&table, 1, csv_column(&table, "resolution [m]")), 2e-3, 0);
    assert_float_equal(csv_number(&table, 2, csv_column(&table, "L1 <&> \"pressure\", all error")),
                       1.0, 0);
    assert_float_equal(csv_number(&table, 2, csv_column(&table, "rebound [Pa]")), 8.01e9, 0);
    assert_float_equal(csv_number(&table, 2, csv_column(&table, "rebound error [Pa]")), 1e7, 0);
    assert_string_equal(csv_field(&table, 0, csv_column(&table, "rebound order")), "");
    assert_int_equal(orders.rows, 3);
    assert_float_equal(csv_number(&orders, 0, csv_column(&orders, "order")), 2.0, 0);
    assert_string_equal(csv_field(&orders, 0, csv_column(&orders, "source")), "theory");
    assert_string_equal(csv_field(&orders, 1, csv_column(&orders, "approach")), "monotone");
    assert_float_equal(csv_number(&orders, 1, csv_column(&orders, "extrapolated")), 8e9, 10.0);
    assert_float_equal(csv_number(&orders, 1, csv_column(&orders, "grid convergence index")),
                       1.25e7, 10.0);
    csv_free(&orders);
    csv_free(&table);

    char *path = path_join(folder, "convergence.html"), *page;
    size_t size;
    assert_null(file_read(path, &page, &size));
    assert_non_null(strstr(page, "Passed: 1 of 1 orders."));
    assert_non_null(strstr(page, "L1 &lt;&amp;&gt; &quot;pressure&quot;, all"));
    assert_non_null(strstr(page, "href=\"convergence/n=2/report.html\""));
    /* pictures are letters and digits without a break, in which it may occur by chance */
    static const char *const numbers[] = {">nan", " nan", ",nan", ":nan", "[nan", "\"nan"};
    for (size_t k = 0; k < COUNT_OF(numbers); k++)
        assert_null(strstr(page, numbers[k]));
    free(page);
    free(path);
}

static void errors_are_drawn_over_what_they_are_errors_of(void **state)
{
    (void)state;
    struct study_quantity quantity[3];
    struct study study = make_study(quantity);
    assert_float_equal(study_scale(&study, &quantity[0]), 1.0, 0);
    assert_float_equal(study_scale(&study, &quantity[1]), 8e9, 10.0);
    quantity[1].kind = STUDY_DISTANCE;
    quantity[1].exact = -5.0;
    assert_float_equal(study_scale(&study, &quantity[1]), 5.0, 0);
    quantity[1].exact = 0.0;
    assert_float_equal(study_scale(&study, &quantity[1]), error[0], 0);
    assert_false(study_scale(&study, &quantity[2]) > 0.0);
}

static void a_folder_that_cannot_be_made_is_told(void **state)
{
    (void)state;
    struct study_quantity quantity[3];
    struct study study = make_study(quantity);
    struct error *failed = study_write("/dev/null/study", &study);
    assert_non_null(failed);
    error_free(failed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_study_is_two_tables_a_plot_and_a_page, make_folder,
                                        remove_folder),
        cmocka_unit_test(errors_are_drawn_over_what_they_are_errors_of),
        cmocka_unit_test(a_folder_that_cannot_be_made_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
