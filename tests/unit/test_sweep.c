/* Sweeps: the values that their runs take, and what the runs come to together. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"
#include "run/catalogue.h"
#include "shape/kinds.h"
#include "source_folder.h"
#include "study/sweep.h"

#define BODIES                                                                                     \
    "format: 1\ndimension: 1\nresolution: 1 mm\nsolver: sph\n"                                     \
    "let: {slow: 10 m/s, speed: 5 m/s, gap: 1 mm}\n"                                               \
    "materials: {gas: {library: gas-gamma-3}}\n"                                                   \
    "bodies: {all: {material: gas, velocity: [speed], energy: 2 J/kg, box: {from: [0 m], to: [20 " \
    "mm]}}}\n"                                                                                     \
    "run: {until: 1 s, max_steps: 2}\n"                                                            \
    "output: {snapshots: no}\n"
#define HEAD                                                                                   \
    BODIES "checks: {\"the speed\": {mean: velocity.x, is: speed, within: 1 %}, slow: {mean: " \
           "velocity.x, at_most: 15 m/s}}\n"

static const char two_ways[] =
    HEAD "sweep: {speed: [2*slow, 10 m/s], bodies.all.energy: [1 J/kg, 3 kJ/kg]}\n"
         "short: {sweep: {speed: [7 m/s], bodies.all.energy: [4 J/kg]}}\n";

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, strlen(text), file), strlen(text));
    assert_int_equal(fclose(file), 0);
}

static void write_case(const char *text) { write_file("case.yaml", text); }

static int enter_folder(void **state)
{
    (void)state;
    static char folder[] = "/tmp/bolide-sweep-XXXXXX";
    assert_non_null(mkdtemp(folder));
    return chdir(folder);
}

static int leave_folder(void **state)
{
    (void)state;
    char folder[4096], command[4200];
    assert_non_null(getcwd(folder, sizeof folder));
    assert_int_equal(chdir("/"), 0);
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command);
}

static const char *const folders[] = {materials_folder};

static struct error *read_run(int run, bool quick, struct simulation_case **input)
{
    const struct case_options options = {.form = quick ? "short" : NULL,
                                         .sweep_run = run,
                                         .library_paths = folders,
                                         .library_count = 1};
    return case_read("case.yaml", &options, &bolide_catalogue, input);
}

static void the_last_key_changes_fastest(void **state)
{
    (void)state;
    static const double speeds[] = {5.0, 20.0, 20.0, 10.0, 10.0};
    static const double energies[] = {2.0, 1.0, 3000.0, 1.0, 3000.0};
    write_case(two_ways);
    for (int run = 0; run <= 4; run++) {
        struct simulation_case *input = NULL;
        assert_null(read_run(run, false, &input));
        const struct body_input *body = case_body(input, 0);
        assert_int_equal(input->sweep_runs, 4);
        assert_int_equal(input->sweep_values, run ? 2 : 0);
        assert_true(body->velocity.at[0].constant == speeds[run]);
        assert_true(body->energy.constant == energies[run]);
        case_free(input);
    }
}

static void keys_that_change_together_are_one(void **state)
{
    (void)state;
    static const double speeds[] = {7.0, 7.0, 8.0, 8.0}, energies[] = {1.0, 1.0, 4.0, 4.0};
    write_case(HEAD "sweep:\n"
                    "  cold: {speed: [7 m/s, 8 m/s], bodies.all.energy: [1 J/kg, 4 J/kg]}\n"
                    "  resolution: [1 mm, 2 mm]\n");
    for (int run = 1; run <= 4; run++) {
        struct simulation_case *input = NULL;
        assert_null(read_run(run, false, &input));
        assert_int_equal(input->sweep_runs, 4);
        assert_int_equal(input->sweep_values, 3);
        assert_true(input->sweep[1].entry == 0 && input->sweep[2].entry == 1);
        assert_true(case_body(input, 0)->velocity.at[0].constant == speeds[run - 1]);
        assert_true(case_body(input, 0)->energy.constant == energies[run - 1]);
        assert_true(input->resolution == (run % 2 ? 1e-3 : 2e-3));
        case_free(input);
    }
}

static void a_value_may_be_a_list(void **state)
{
    (void)state;
    write_case(HEAD "sweep: {bodies.all.box.to: [[10 mm], [2*gap]], speed: [1 m/s]}\n");
    for (int run = 1; run <= 2; run++) {
        struct simulation_case *input = NULL;
        struct error *error = read_run(run, false, &input);
        if (error)
            fail_msg("%s", error_message(error, 0));
        assert_string_equal(input->sweep[0].text, run == 1 ? "[10 mm]" : "[2*gap]");
        assert_true(isnan(input->sweep[0].quantity.value));
        const struct shape_box *box = case_body(input, 0)->shape.value;
        assert_true(box->to.at[0] == (run == 1 ? 10e-3 : 2e-3));
        case_free(input);
    }
}

static void assert_run(int run, double density, double speed)
{
    struct simulation_case *input = NULL;
    struct error *error = read_run(run, false, &input);
    if (error)
        fail_msg("%s", error_message(error, 0));
    assert_true(case_body(input, 0)->density.constant == density);
    assert_true(case_body(input, 0)->velocity.at[0].constant == speed);
    case_free(input);
}

static void the_files_that_a_case_includes_may_change(void **state)
{
    (void)state;
    write_file("thin.yaml", "bodies: {all: {density: 1 kg/m^3}}\n");
    write_file("thick.yaml", "bodies: {all: {density: 7 kg/m^3}}\nlet: {speed: 6 m/s}\n");
    write_case("include: thin.yaml\n" BODIES
               "sweep: {include: [thin.yaml, thick.yaml, [thick.yaml, thin.yaml]], speed: [5 m/s, "
               "20 m/s]}\n");
    assert_run(0, 1.0, 5.0);
    assert_run(1, 1.0, 5.0);
    assert_run(2, 1.0, 20.0);
    assert_run(3, 7.0, 5.0);
    assert_run(4, 7.0, 20.0);
    assert_run(6, 1.0, 20.0);

    /* Values of the case stay above those of the files. */
    write_case("include: thin.yaml\n" BODIES "sweep: {include: [thin.yaml, thick.yaml]}\n");
    assert_run(2, 7.0, 5.0);
}

static void mistakes_of_swept_files_are_told(void **state)
{
    (void)state;
    static const struct {
        const char *sweep, *text;
    } wrong[] = {
        {"{include: [thin.yaml, missing.yaml]}", "missing.yaml: No such file or directory"},
        {"{include: [thin.yaml, swept.yaml]}", "with this the case has another sweep"},
        {"{include: [thin.yaml, '']}", "expected a file or a list of files"},
        {"{include: thick.yaml}", "expected a list of values"},
    };
    write_file("thin.yaml", "bodies: {all: {density: 1 kg/m^3}}\n");
    write_file("swept.yaml", "sweep: {speed: [1 m/s, 2 m/s]}\n");
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        struct simulation_case *input = NULL;
        char *text = text_format("include: thin.yaml\n" BODIES "sweep: %s\n", wrong[i].sweep);
        assert_non_null(text);
        write_case(text);
        free(text);
        struct error *error = read_run(2, false, &input);
        assert_non_null(error);
        if (!strstr(error_message(error, 0), wrong[i].text))
            fail_msg("%s", error_message(error, 0));
        error_free(error);
    }
}

static void keys_that_change_together_have_as_many_values(void **state)
{
    (void)state;
    struct simulation_case *input = NULL;
    write_case(HEAD "sweep:\n  cold: {speed: [7 m/s, 8 m/s], resolution: [1 mm]}\n");
    struct error *error = read_run(0, false, &input);
    assert_non_null(error);
    assert_string_equal(
        error_message(error, 0),
        "case.yaml:12:45: sweep: \"speed\" and \"resolution\" change together: expected "
        "2 values, not 1");
    error_free(error);
    write_case(HEAD "sweep:\n  cold: {}\n");
    error = read_run(0, false, &input);
    assert_non_null(error);
    assert_non_null(strstr(error_message(error, 0), "\"cold\" names no lists of values"));
    error_free(error);
}

static void a_run_knows_its_values(void **state)
{
    (void)state;
    struct simulation_case *input = NULL;
    write_case(HEAD
               "sweep: {speed: [2*slow], solver.sph.method: [standard], resolution: [1 mm]}\n");
    assert_null(read_run(1, false, &input));
    const struct sweep_value *values = input->sweep;
    assert_int_equal(input->sweep_values, 3);
    assert_string_equal(values[0].key, "speed");
    assert_string_equal(values[0].text, "2*slow");
    assert_true(values[0].quantity.value == 20.0 && values[0].quantity.dimension.time == -1);
    assert_true(isnan(values[1].quantity.value));
    char *name = sweep_run_name(values, 3);
    assert_string_equal(name, "speed=2_slow,method=standard,resolution=1_mm");
    free(name);
    case_free(input);
}

static void the_short_form_has_a_sweep_of_its_own(void **state)
{
    (void)state;
    struct simulation_case *input = NULL;
    write_case(two_ways);
    assert_null(read_run(1, true, &input));
    assert_int_equal(input->sweep_runs, 1);
    assert_true(case_body(input, 0)->velocity.at[0].constant == 7.0);
    case_free(input);
    write_case(HEAD "sweep: {speed: [1 m/s, 2 m/s]}\nshort: {sweep: }\n");
    assert_null(read_run(0, true, &input));
    assert_int_equal(input->sweep_runs, 0);
    case_free(input);
}

static void a_mistake_stands_where_its_value_does(void **state)
{
    (void)state;
    struct simulation_case *input = NULL;
    write_case(HEAD "sweep:\n  speed: [1 m/s, 2 s]\n");
    assert_null(read_run(1, false, &input));
    case_free(input);
    struct error *error = read_run(2, false, &input);
    assert_non_null(error);
    assert_non_null(strstr(error_message(error, 0), "bodies.all.velocity.1: \"speed\" is a time"));
    error_free(error);
    write_case(HEAD "sweep:\n  resolution: [1 mm, 2 s]\n");
    error = read_run(2, false, &input);
    assert_non_null(error);
    assert_string_equal(
        error_message(error, 0),
        "case.yaml:12:22: resolution: \"2 s\" is a time (s), expected a length (m)");
    error_free(error);
}

static struct error *run_all(bool overwrite, bool resume, struct verify_result *result)
{
    const struct verify_options options = {
        .reading = {.library_paths = folders, .library_count = 1},
        .catalogue = &bolide_catalogue,
        .running = {.overwrite = overwrite, .resume = resume, .threads = 1},
    };
    *result = (struct verify_result){0};
    return verify_case("case.yaml", "all", "results", &options, result);
}

static void the_runs_make_one_table(void **state)
{
    (void)state;
    struct verify_result result;
    struct csv table;
    write_case(two_ways);
    struct error *error = run_all(false, false, &result);
    assert_int_equal(error_kind(error), ERROR_CHECK); /* two runs are not slow */
    assert_int_equal(error_count(error), 2);
    error_free(error);
    assert_int_equal(result.count, 4);
    assert_int_equal(result.passed, 2);
    assert_string_equal(result.item[3].name, "all/speed=10_m_s,energy=3_kJ_kg");
    verify_result_free(&result);

    assert_null(csv_read("results/sweep.csv", &table));
    assert_int_equal(table.rows, 4);
    assert_string_equal(csv_field(&table, 1, 0), "speed=2_slow,energy=3_kJ_kg");
    assert_true(csv_number(&table, 2, csv_column(&table, "speed [m/s]")) == 10.0);
    assert_true(csv_number(&table, 1, csv_column(&table, "bodies.all.energy [J/kg]")) == 3000.0);
    assert_true(fabs(csv_number(&table, 0, csv_column(&table, "the speed [m/s]")) - 20.0) < 1e-9);
    assert_string_equal(csv_field(&table, 0, csv_column(&table, "slow verdict")), "FAILED");
    assert_string_equal(csv_field(&table, 0, csv_column(&table, "verdict")), "FAILED");
    assert_string_equal(csv_field(&table, 3, csv_column(&table, "verdict")), "passed");
    csv_free(&table);
    assert_int_equal(access("results/pictures/the_speed.png", R_OK), 0);
    assert_int_equal(access("results/report.html", R_OK), 0);
    assert_int_equal(access("results/speed=10_m_s,energy=1_J_kg/run.log", R_OK), 0);
}

static void a_known_deviation_holds_in_the_runs_that_it_names(void **state)
{
    (void)state;
    struct verify_result result;
    struct csv table;
    write_case(BODIES
               "checks: {fast: {mean: velocity.x, at_least: 20 m/s, known_deviation: too slow, "
               "known_deviation_if: 2 - speed/slow}}\n"
               "sweep: {speed: [slow, 3*slow]}\n");
    assert_null(run_all(true, false, &result));
    assert_int_equal(result.passed, 2);
    assert_int_equal(result.checks, 2);
    assert_int_equal(result.checks_passed, 1);
    assert_int_equal(result.known_deviations, 1);
    verify_result_free(&result);
    assert_null(csv_read("results/sweep.csv", &table));
    const int verdict = csv_column(&table, "fast verdict");
    assert_string_equal(csv_field(&table, 0, verdict), "known deviation: too slow");
    assert_string_equal(csv_field(&table, 1, verdict), "passed");
    csv_free(&table);
    char *page = NULL;
    size_t size;
    assert_null(file_read("results/report.html", &page, &size));
    assert_non_null(strstr(page, "△ </span>fast known deviation: too slow"));
    free(page);
    assert_int_equal(system("rm -r results"), 0);
}

static const char fitted[] = BODIES
    "checks: {u: {mean: velocity.x, at_least: 0 m/s}, e: {maximum: energy, at_least: 0 J/kg}}\n"
    "sweep: {all: {speed: [1 m/s, 2 m/s, 4 m/s, 8 m/s],"
    " bodies.all.energy: [3 J/kg, 12 J/kg, 48 J/kg, 1 kJ/kg]}}\n"
    "fits: {";

/* u is the speed; e is 3 J/kg (speed/(1 m/s))^2 in the first three runs. */
static void lines_and_power_laws_go_through_the_runs(void **state)
{
    (void)state;
    struct verify_result result;
    char text[4096];
    snprintf(text, sizeof text, "%s%s", fitted,
             "line: {of: u, over: speed, take: slope, is: 1, within: 1e-12},"
             " start: {of: u, over: speed, take: intercept, is: 0 m/s, within: 1e-12 m/s},"
             " square: {of: e, over: u, form: power, take: slope, to: 5 m/s, is: 2, within: 1e-12},"
             " exact: {of: e, over: u, form: power, take: misfit, to: 5 m/s, at_most: 1e-12},"
             " off: {of: e, over: speed, take: misfit, to: 5 m/s, is: 0.13226, within: 1e-4},"
             " one: {of: e, over: speed, take: slope, from: 5 m/s, at_least: 0 J*s/(kg*m)},"
             " late: {of: e, over: speed, take: slope, at_most: 0 m/s, known_deviation: is}}\n");
    write_case(text);
    struct error *error = run_all(true, false, &result);
    assert_int_equal(error_kind(error), ERROR_CHECK);
    error_free(error);
    assert_int_equal(result.cases, 4);
    assert_int_equal(result.passed, 4);
    assert_int_equal(result.count, 5);
    const struct check_results *fits = &result.item[4].result.checks;
    const enum check_verdict wanted[] = {CHECK_PASSED,         CHECK_PASSED, CHECK_PASSED,
                                         CHECK_PASSED,         CHECK_PASSED, CHECK_FAILED,
                                         CHECK_KNOWN_DEVIATION};
    assert_int_equal(fits->count, COUNT_OF(wanted));
    for (int i = 0; i < fits->count; i++)
        if (fits->item[i].verdict != wanted[i])
            fail_msg("%s: %g", fits->item[i].name, fits->item[i].measured);
    assert_true(isnan(fits->item[5].measured));
    assert_string_equal(fits->item[1].unit, "m/s");
    verify_result_free(&result);
    char *page = NULL;
    size_t size;
    assert_null(file_read("results/report.html", &page, &size));
    assert_non_null(strstr(page, "Passed: 4 of 4 runs.</strong> <strong>Failed: 1 of 7 fits."));
    assert_non_null(strstr(page, "Fits through the runs"));
    free(page);
    assert_int_equal(system("rm -r results"), 0);
}

static void dimensions_of_fits_are_compared_before_the_first_step(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {
        {"f: {of: u, over: speed, take: slope, at_most: 1 m}}\n",
         "but `slope` is in plain numbers"},
        {"f: {of: u, over: speed, take: slope, from: 1 s, at_most: 1}}\n", "`from` is in s"},
        {"f: {of: u, over: sped, take: slope, at_most: 1}}\n", "no swept key or check \"sped\""},
    };
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        struct verify_result result;
        char text[4096];
        snprintf(text, sizeof text, "%s%s", fitted, wrong[i][0]);
        write_case(text);
        struct error *error = run_all(true, false, &result);
        assert_int_equal(error_kind(error), ERROR_INPUT);
        if (!strstr(error_message(error, 0), wrong[i][1]))
            fail_msg("\"%s\" does not say \"%s\"", error_message(error, 0), wrong[i][1]);
        error_free(error);
        verify_result_free(&result);
    }
    assert_int_equal(system("rm -rf results"), 0);
}

static void results_give_way_only_when_asked(void **state)
{
    (void)state;
    struct verify_result result;
    struct error *error = run_all(false, false, &result);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_non_null(strstr(error_message(error, 0), "already contains the results of a sweep"));
    error_free(error);
    verify_result_free(&result);
    error_free(run_all(true, false, &result));
    assert_int_equal(result.passed, 2);
    verify_result_free(&result);
}

/* Of four runs two have ended, which repeat their last steps, and one has only begun. */
static void a_sweep_goes_on_where_it_was_left(void **state)
{
    (void)state;
    struct verify_result result;
    assert_int_equal(system("rm -r results/speed=2_slow,energy=3_kJ_kg "
                            "results/speed=10_m_s,energy=1_J_kg/checkpoint.h5 "
                            "results/sweep.csv"),
                     0);
    error_free(run_all(false, true, &result));
    assert_int_equal(result.count, 4);
    assert_int_equal(result.passed, 2);
    const int64_t first = result.item[0].result.updates, last = result.item[3].result.updates;
    assert_true(result.item[1].result.updates > first && result.item[2].result.updates > first);
    assert_true(first < 40 && last < 40);
    verify_result_free(&result);
    assert_int_equal(access("results/sweep.csv", R_OK), 0);
}

static void names_of_runs_are_short(void **state)
{
    (void)state;
    char digits[121];
    memset(digits, '1', sizeof digits);
    digits[120] = '\0';
    struct sweep_value values[] = {{.entry = 0, .key = "a", .text = "1 m"},
                                   {.entry = 0, .key = "b", .text = "2"},
                                   {.entry = 1, .key = "c", .text = "3"}};
    char *name = sweep_run_name(values, 3);
    assert_string_equal(name, "a=1_m,b=2,c=3");
    free(name);
    values[0].key = "bodies.a.energy";
    values[1].key = "bodies.b.energy";
    values[2].key = "solver.sph.method";
    name = sweep_run_name(values, 3);
    assert_string_equal(name, "bodies.a.energy=1_m,bodies.b.energy=2,method=3");
    free(name);
    values[0].key = "a";
    values[1].key = "b";
    values[2].key = "c";
    values[1].text = digits;
    name = sweep_run_name(values, 3);
    assert_string_equal(name, "a=1_m,c=3");
    free(name);
}

static void runs_of_one_name_are_a_mistake(void **state)
{
    (void)state;
    struct verify_result result;
    write_case(HEAD "sweep: {speed: [(slow), ' slow ']}\n");
    struct error *error = run_all(true, false, &result);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_non_null(strstr(error_message(error, 0), "two runs of the sweep would be called"));
    error_free(error);
    verify_result_free(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_key_changes_fastest),
        cmocka_unit_test(keys_that_change_together_are_one),
        cmocka_unit_test(a_value_may_be_a_list),
        cmocka_unit_test(keys_that_change_together_have_as_many_values),
        cmocka_unit_test(the_files_that_a_case_includes_may_change),
        cmocka_unit_test(mistakes_of_swept_files_are_told),
        cmocka_unit_test(a_run_knows_its_values),
        cmocka_unit_test(the_short_form_has_a_sweep_of_its_own),
        cmocka_unit_test(a_mistake_stands_where_its_value_does),
        cmocka_unit_test(a_known_deviation_holds_in_the_runs_that_it_names),
        cmocka_unit_test(lines_and_power_laws_go_through_the_runs),
        cmocka_unit_test(dimensions_of_fits_are_compared_before_the_first_step),
        cmocka_unit_test(the_runs_make_one_table),
        cmocka_unit_test(results_give_way_only_when_asked),
        cmocka_unit_test(a_sweep_goes_on_where_it_was_left),
        cmocka_unit_test(names_of_runs_are_short),
        cmocka_unit_test(runs_of_one_name_are_a_mistake),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
