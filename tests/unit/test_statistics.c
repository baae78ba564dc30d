/* Repetitions of a sweep: means, deviations and confidence, in numbers, in the table and as
 * fits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"
#include "run/catalogue.h"
#include "scratch_folder.h"
#include "source_folder.h"
#include "study/sweep.h"

static void assert_near(double value, double wanted, double within)
{
    if (!(fabs(value - wanted) <= within * fabs(wanted)))
        fail_msg("%.9g is not within %g of %.9g", value, within, wanted);
}

/* Student's t at 97.5 %: 12.706 for one degree of freedom, 2.7764 for four, 1.9840 for a
 * hundred. */
static void confidence_is_that_of_student(void **state)
{
    (void)state;
    const double five[] = {1.0, 2.0, 3.0, 4.0, 5.0};
    struct statistic statistic = statistic_of(five, 5);
    assert_int_equal(statistic.count, 5);
    assert_near(statistic.mean, 3.0, 1e-15);
    assert_near(statistic.deviation, sqrt(2.5), 1e-15);
    assert_near(statistic.confidence, 2.7764 * sqrt(0.5), 1e-5);
    statistic = statistic_of(five, 2);
    assert_near(statistic.confidence, 12.7062 * 0.5, 1e-5);
    double many[101];
    for (int i = 0; i < 101; i++)
        many[i] = i % 2;
    statistic = statistic_of(many, 101);
    assert_near(statistic.confidence * sqrt(101.0) / statistic.deviation, 1.98397, 1e-4);
    statistic = statistic_of(five, 1);
    assert_true(statistic.mean == 1.0 && isnan(statistic.deviation) && isnan(statistic.confidence));
    assert_true(isnan(statistic_of(five, 0).mean));
}

#define HEAD                                                                                       \
    "format: 1\ntitle: t\ndimension: 1\nresolution: 1 mm\nsolver: sph\n"                           \
    "let: {speed: 5 m/s, seed: 1}\n"                                                               \
    "materials: {gas: {library: gas-gamma-3}}\n"                                                   \
    "bodies: {all: {material: gas, velocity: [speed*seed], energy: 2 J/kg, box: {from: [0 m], to:" \
    " [20 mm]}}}\n"                                                                                \
    "run: {until: 1 s, max_steps: 2}\noutput: {snapshots: no}\n"                                   \
    "checks: {u: {mean: velocity.x, at_least: 0 m/s}}\n"

static void write_case(const char *text)
{
    char path[128];
    snprintf(path, sizeof path, "%s/case.yaml", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/* Runs all, with LISTENER and STOP, which may be NULL. */
static struct error *run_watched(const struct listener *listener, const volatile sig_atomic_t *stop,
                                 struct verify_result *result)
{
    static const char *const folders[] = {materials_folder};
    const struct verify_options options = {
        .reading = {.library_paths = folders, .library_count = 1},
        .catalogue = &bolide_catalogue,
        .running = {.overwrite = true, .threads = 1, .listener = listener, .stop = stop},
    };
    char path[128], results[128];
    snprintf(path, sizeof path, "%s/case.yaml", folder);
    snprintf(results, sizeof results, "%s/results", folder);
    *result = (struct verify_result){0};
    return verify_case(path, "all", results, &options, result);
}

static struct error *run_all(struct verify_result *result)
{
    return run_watched(NULL, NULL, result);
}

static void read_statistics(struct csv *table)
{
    char path[160];
    snprintf(path, sizeof path, "%s/results/statistics.csv", folder);
    assert_null(csv_read(path, table));
}

/* Seeds 1, 2, 3 at 5 and 10 m/s: means 10 and 20 m/s, deviations 5 and 10 m/s. */
static void repetitions_have_a_table_a_plot_and_fits(void **state)
{
    (void)state;
    struct verify_result result;
    struct csv table;
    char path[160];
    write_case(HEAD
               "sweep: {seed: [1, 2, 3], speed: [5 m/s, 10 m/s]}\nrepetitions: seed\n"
               "fits:\n"
               "  mean: {of: u, over: speed, to: 6 m/s, take: mean, is: 10 m/s, within: 1e-9}\n"
               "  deviation: {of: u, over: speed, from: 6 m/s, take: deviation, is: 10 m/s,"
               " within: 1e-9}\n"
               "  confidence: {of: u, over: speed, to: 6 m/s, take: confidence, is: 12.421 m/s,"
               " within: 1e-4}\n");
    struct error *error = run_all(&result);
    if (error)
        fail_msg("%s", error_message(error, 0));
    verify_result_free(&result);
    read_statistics(&table);
    assert_int_equal(table.rows, 2);
    assert_true(csv_number(&table, 1, csv_column(&table, "speed [m/s]")) == 10.0);
    assert_true(csv_number(&table, 1, csv_column(&table, "runs")) == 3.0);
    assert_near(csv_number(&table, 0, csv_column(&table, "u mean [m/s]")), 10.0, 1e-9);
    assert_near(csv_number(&table, 0, csv_column(&table, "u deviation [m/s]")), 5.0, 1e-9);
    assert_near(csv_number(&table, 1, csv_column(&table, "u confidence [m/s]")), 24.842, 1e-4);
    csv_free(&table);
    snprintf(path, sizeof path, "%s/results/pictures/u.png", folder);
    assert_int_equal(access(path, R_OK), 0);
    char *page = NULL;
    size_t size;
    snprintf(path, sizeof path, "%s/results/report.html", folder);
    assert_null(file_read(path, &page, &size));
    assert_non_null(strstr(page, "Means of repetitions"));
    free(page);
}

/* Of one key: all runs are repetitions of one another. */
static void a_sweep_of_seeds_alone_is_one_group(void **state)
{
    (void)state;
    struct verify_result result;
    struct csv table;
    write_case(HEAD "sweep: {seed: [1, 2, 3, 6]}\nrepetitions: seed\n");
    assert_null(run_all(&result));
    verify_result_free(&result);
    read_statistics(&table);
    assert_int_equal(table.rows, 1);
    assert_near(csv_number(&table, 0, csv_column(&table, "u mean [m/s]")), 15.0, 1e-9);
    csv_free(&table);
}

static volatile sig_atomic_t stop_asked;

static void stop_in_the_third(void *context, const char *line)
{
    (void)context;
    if (strstr(line, "seed=3"))
        stop_asked = 1;
}

static void a_run_that_was_stopped_counts_as_none(void **state)
{
    (void)state;
    struct verify_result result;
    struct csv table;
    char path[160];
    const struct listener listener = {.line = stop_in_the_third};
    write_case(HEAD "sweep: {seed: [1, 2, 3, 6]}\nrepetitions: seed\n");
    struct error *error = run_watched(&listener, &stop_asked, &result);
    assert_non_null(error);
    assert_non_null(strstr(error_message(error, 0), "stopped before its end"));
    error_free(error);
    assert_int_equal(result.count, 3);
    verify_result_free(&result);
    read_statistics(&table);
    assert_true(csv_number(&table, 0, csv_column(&table, "runs")) == 2.0);
    assert_near(csv_number(&table, 0, csv_column(&table, "u mean [m/s]")), 7.5, 1e-9);
    csv_free(&table);
    char *page = NULL;
    size_t size;
    snprintf(path, sizeof path, "%s/results/report.html", folder);
    assert_null(file_read(path, &page, &size));
    assert_non_null(strstr(page, "Not finished: 1 of 3 runs."));
    free(page);
}

static void repetitions_that_are_none_are_refused(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {
        {HEAD "repetitions: seed\n", "repetitions: this needs a `sweep` with the key \"seed\""},
        {HEAD "sweep: {seed: [1, 2]}\nrepetitions: sead\n",
         "repetitions: the sweep has no key \"sead\""},
        {HEAD "sweep: {seed: [1, 2]}\n"
              "fits: {f: {of: u, over: seed, form: power, take: mean}}\n",
         "a mean and its deviation have no form"},
    };
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        struct verify_result result;
        write_case(wrong[i][0]);
        struct error *error = run_all(&result);
        assert_non_null(error);
        if (!strstr(error_message(error, 0), wrong[i][1]))
            fail_msg("\"%s\" does not say \"%s\"", error_message(error, 0), wrong[i][1]);
        error_free(error);
        verify_result_free(&result);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(confidence_is_that_of_student),
        cmocka_unit_test(repetitions_have_a_table_a_plot_and_fits),
        cmocka_unit_test(a_sweep_of_seeds_alone_is_one_group),
        cmocka_unit_test(a_run_that_was_stopped_counts_as_none),
        cmocka_unit_test(repetitions_that_are_none_are_refused),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
