/* Forecasts of runs, the table of rates, and what the machine has. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/machine.h"
#include "base/memory.h"
#include "run/catalogue.h"
#include "run/forecast.h"
#include "run/rates.h"
#include "source_folder.h"

/* A flyer strikes a target. */
static const char plates[] =
    "format: 1\n"
    "dimension: 2\n"
    "resolution: h\n"
    "let: {h: 0.5 mm, speed: 2 km/s, time: 2 us}\n"
    "solver: mpm\n"
    "materials: {metal: {library: aluminium-wilkins}}\n"
    "bodies:\n"
    "  flyer: {material: metal, velocity: [speed, 0 m/s],\n"
    "          box: {from: [-4 mm, 0 mm], to: [0 mm, 8 mm]}}\n"
    "  target: {material: metal, box: {from: [0 mm, 0 mm], to: [8 mm, 8 mm]}}\n"
    "run: {until: time}\n";

static struct simulation_case *read_plates(const char *const *settings)
{
    static const char *const library[] = {materials_folder};
    struct case_options options = {
        .settings = settings, .library_paths = library, .library_count = 1};
    while (settings && settings[options.setting_count])
        options.setting_count++;
    FILE *file = fopen("forecast.yaml", "w");
    assert_non_null(file);
    assert_true(fputs(plates, file) >= 0);
    assert_int_equal(fclose(file), 0);
    struct simulation_case *input = NULL;
    struct error *error = case_read("forecast.yaml", &options, &bolide_catalogue, &input);
    if (error)
        fail_msg("%s", error_message(error, 0));
    return input;
}

static struct forecast forecast_plates(const char *const *settings, const char *rates,
                                       bool by_pilot)
{
    struct simulation_case *input = read_plates(settings);
    struct estimate estimate;
    assert_null(estimate_run(input, &estimate));
    const struct ranks alone = ranks_alone();
    const struct run_options running = {.ranks = &alone, .threads = 1, .rates = rates};
    struct forecast forecast = forecast_make(input, &estimate, &running);
    if (by_pilot)
        forecast_by_pilot(input, &estimate, &running, 20.0, &forecast);
    estimate_free(&estimate);
    case_free(input);
    return forecast;
}

static struct run_result run_plates(const char *const *settings, const char *rates)
{
    struct simulation_case *input = read_plates(settings);
    const struct ranks alone = ranks_alone();
    const struct run_options running = {.ranks = &alone, .threads = 1, .rates = rates};
    struct run_result result;
    assert_null(run_case(input, &running, &result));
    case_free(input);
    return result;
}

static void assert_within(const char *what, double value, double wanted, double factor)
{
    if (!(value <= factor * wanted && value >= wanted / factor))
        fail_msg("%s: %g is not within a factor of %g of %g", what, value, factor, wanted);
}

static void a_fast_impact_takes_twice_the_steps_of_bodies_at_rest(void **state)
{
    (void)state;
    const char *const still[] = {"let.speed=0 m/s", NULL},
                      *const fast[] = {"let.speed=4 km/s", NULL},
                      *const between[] = {"let.speed=1.6 km/s", NULL},
                      *const away[] = {"let.speed=-4 km/s", NULL},
                      *const few[] = {"let.speed=4 km/s", "run.max_steps=7", NULL};
    const double steps = forecast_plates(still, NULL, false).steps;
    assert_true(steps > 10.0);
    assert_within("fast", forecast_plates(fast, NULL, false).steps, 2.0 * steps, 1.05);
    assert_within("between", forecast_plates(between, NULL, false).steps, 1.5 * steps, 1.05);
    assert_within("apart", forecast_plates(away, NULL, false).steps, steps, 1.05);
    assert_float_equal(forecast_plates(few, NULL, false).steps, 7.0, 0.0);
}

static void a_pilot_forecasts_steps_and_updates(void **state)
{
    (void)state;
    const char *const variants[][4] = {
        {NULL},
        {"solver=sph", "let.h=1 mm", NULL},
        {"let.speed=5 km/s", "solver={mpm: {cell: 2*h}}", NULL},
        {"let.speed=1 km/s", "let.h=0.35 mm", "let.time=1 us", NULL}};
    for (size_t k = 0; k < COUNT_OF(variants); k++) {
        struct run_result ran = run_plates(variants[k], NULL);
        const struct forecast forecast = forecast_plates(variants[k], NULL, true);
        assert_int_equal(forecast.rate, RATE_OF_PILOT);
        assert_within("steps", forecast.steps, (double)ran.steps, 1.5);
        run_result_free(&ran);
    }
}

static void a_pilot_that_runs_out_of_time_is_extrapolated(void **state)
{
    (void)state;
    const char *const settings[] = {"let.h=0.4 mm", NULL};
    struct simulation_case *input = read_plates(settings);
    struct estimate estimate;
    assert_null(estimate_run(input, &estimate));
    const struct ranks alone = ranks_alone();
    const struct run_options running = {.ranks = &alone, .threads = 1};
    struct forecast forecast = forecast_make(input, &estimate, &running);
    const double plain = forecast.steps;
    forecast_by_pilot(input, &estimate, &running, 1e-9, &forecast);
    assert_int_equal(forecast.rate, RATE_OF_PILOT);
    assert_within("steps", forecast.steps, plain, 2.0);
    estimate_free(&estimate);
    case_free(input);
}

static void the_rate_of_a_run_is_that_of_the_next_forecast(void **state)
{
    (void)state;
    const char *const here = "cache/of/mine/rates.csv";
    const char *const linear[] = {"solver={mpm: {shape: linear}}", NULL}, *const sph[] = {
                                                                              "solver=sph", NULL};
    const char *const spall[] = {"materials.metal.failure={spall: {strength: 1 GPa}}", NULL};
    struct simulation_case *input = read_plates(NULL), *other = read_plates(linear),
                           *third = read_plates(sph), *brittle = read_plates(spall);
    unlink(here);
    assert_true(isnan(rates_find(here, input, 1)));
    rates_store(here, input, 1, 3e6);
    assert_float_equal(rates_find(here, input, 1), 3e6, 1.0);
    assert_float_equal(rates_find(here, input, 4), 12e6, 1.0); /* in proportion */
    assert_float_equal(rates_find(here, other, 1), 3e6, 1.0);  /* better than nothing */
    assert_true(isnan(rates_find(here, third, 1)));
    assert_float_equal(rates_find(here, brittle, 1), 3e6, 1.0);
    rates_store(here, other, 1, 5e6);
    rates_store(here, input, 4, 9e6);
    rates_store(here, input, 1, 2e6);
    assert_float_equal(rates_find(here, input, 1), 2e6, 1.0);
    assert_float_equal(rates_find(here, input, 4), 9e6, 1.0);
    assert_float_equal(rates_find(here, other, 1), 5e6, 1.0);
    assert_float_equal(rates_find(here, brittle, 1), 2e6, 1.0);
    const struct forecast forecast = forecast_plates(NULL, here, false);
    assert_int_equal(forecast.rate, RATE_OF_EARLIER_RUN);
    assert_within("seconds", forecast.seconds, forecast.steps * 384.0 / 2e6, 1.01);
    struct csv table;
    assert_null(csv_read(here, &table));
    assert_int_equal(table.rows, 3);
    csv_free(&table);
    case_free(input);
    case_free(other);
    case_free(third);
    case_free(brittle);
}

static void a_table_that_is_damaged_or_in_the_way_is_no_error(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "", "solver", "a,b\n1,2\n", "\xff\xfe\n,,,,,,\n\"",
        "solver,settings,models,dimension,threads,updates_per_second\n"
        "\"mpm\",\"\",,2,0,1\n\"mpm\",\"\",,2,1,nan\n"
        "\"mpm\",\"\",,2,1,-1\nmpm,x,2\n"};
    struct simulation_case *input = read_plates(NULL);
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        FILE *file = fopen("damaged.csv", "w");
        assert_non_null(file);
        fputs(wrong[k], file);
        fclose(file);
        assert_true(isnan(rates_find("./damaged.csv", input, 1)));
        rates_store("./damaged.csv", input, 1, 4e6);
        assert_float_equal(rates_find("./damaged.csv", input, 1), 4e6, 1.0);
    }
    rates_store("./damaged.csv/in/a/file.csv", input, 1, 4e6);
    rates_store("/proc/nothing/rates.csv", input, 1, 4e6);
    rates_store(NULL, input, 1, 4e6);
    rates_store("./damaged.csv", input, 1, (double)NAN);
    assert_float_equal(rates_find("./damaged.csv", input, 1), 4e6, 1.0);
    assert_true(isnan(rates_find(NULL, input, 1)));
    assert_true(isnan(rates_find("/proc/nothing/rates.csv", input, 1)));
    case_free(input);
}

static void processes_that_write_it_together_leave_it_whole(void **state)
{
    (void)state;
    enum { PROCESSES = 4, TIMES = 40 };
    struct simulation_case *input = read_plates(NULL);
    rates_store("./together.csv", input, 1, 1e6);
    for (int p = 0; p < PROCESSES; p++)
        if (fork() == 0) {
            for (int k = 0; k < TIMES; k++)
                rates_store("./together.csv", input, 2 + p, 1e6 + k);
            _exit(0);
        }
    for (int k = 0; k < TIMES; k++)
        assert_false(isnan(rates_find("./together.csv", input, 1)));
    for (int p = 0; p < PROCESSES; p++)
        assert_true(wait(NULL) > 0);
    assert_false(isnan(rates_find("./together.csv", input, 1)));
    char **names;
    int count;
    assert_null(folder_names(".", "", &names, &count));
    for (int i = 0; i < count; i++)
        if (strstr(names[i], "together.csv."))
            fail_msg("%s was left", names[i]);
    names_free(names, count);
    case_free(input);
}

static void output_and_probes_are_counted(void **state)
{
    (void)state;
    const char *const none[] = {"output.snapshots=no", NULL},
                      *const many[] = {"output.every=1 ns", NULL},
                      *const drawn[] = {"output={every: 10 ns, pictures: [pressure, speed]}", NULL},
                      *const probed[] = {"probes={all: {body: target}}", NULL},
                      *const profiled[] = {"output={snapshots: no, every: 1 ns}",
                                           "profiles={p: {fields: [pressure], along: x, bins: 10}}",
                                           NULL};
    const double least = forecast_plates(none, NULL, false).output;
    assert_true(forecast_plates(NULL, NULL, false).output > least);
    assert_true(forecast_plates(probed, NULL, false).output > least);
    assert_true(forecast_plates(profiled, NULL, false).output > least);
    const double snapshots = forecast_plates(many, NULL, false).output;
    assert_true(snapshots > forecast_plates(NULL, NULL, false).output);
    assert_true(forecast_plates(drawn, NULL, false).output > snapshots);
}

static void a_run_that_needs_more_memory_than_there_is_is_refused(void **state)
{
    (void)state;
    struct simulation_case *input = read_plates(NULL);
    const struct ranks alone = ranks_alone();
    const double there = machine_memory();
    assert_true(there > 1e8 && isfinite(there));
    struct forecast forecast = {.bytes = 0.9 * there};
    assert_null(forecast_check_memory(input, &forecast, &alone));
    forecast.bytes = 1.1 * there;
    struct error *error = forecast_check_memory(input, &forecast, &alone);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_non_null(strstr(error_message(error, 0), "--force"));
    error_free(error);
    case_free(input);
}

static void a_forecast_is_one_line(void **state)
{
    (void)state;
    const struct forecast pilot = {.steps = 306.0,
                                   .seconds = 24.0,
                                   .output = 4.0,
                                   .threads = 1,
                                   .rate = RATE_OF_PILOT,
                                   .pilot_resolution = 2e-4,
                                   .pilot_seconds = 2.0},
                          plain = {.steps = 9000.0,
                                   .seconds = 8000.0,
                                   .output = 130.0,
                                   .before = 5.0,
                                   .threads = 4,
                                   .rate = RATE_ASSUMED};
    char *text = forecast_text(&pilot);
    assert_string_equal(
        text, "about 306 steps, 24 s + 4 s for output on 1 thread (pilot: resolution 200 um, 2 s)");
    free(text);
    text = forecast_text(&plain);
    assert_string_equal(text, "about 9000 steps, 2.2 h + 2.2 min for output + 5 s for the start on "
                              "4 threads (a guess; --pilot measures)");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fast_impact_takes_twice_the_steps_of_bodies_at_rest),
        cmocka_unit_test(a_pilot_forecasts_steps_and_updates),
        cmocka_unit_test(a_pilot_that_runs_out_of_time_is_extrapolated),
        cmocka_unit_test(the_rate_of_a_run_is_that_of_the_next_forecast),
        cmocka_unit_test(a_table_that_is_damaged_or_in_the_way_is_no_error),
        cmocka_unit_test(processes_that_write_it_together_leave_it_whole),
        cmocka_unit_test(output_and_probes_are_counted),
        cmocka_unit_test(a_run_that_needs_more_memory_than_there_is_is_refused),
        cmocka_unit_test(a_forecast_is_one_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
