/* Numbers with readable units, the progress line, run.log and its listener. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include "output/report.h"

static void numbers_have_readable_units(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *unit, *wanted;
    } cases[] = {
        {3.1e-6, "s", "3.1 us"},
        {6.4359e9, "Pa", "6.436 GPa"},
        {0.0338, "m", "33.8 mm"},
        {50e-6, "m", "50 um"},
        {2e-9, "s", "2 ns"},
        {2e-12, "s", "2 ps"},
        {0.99999999, "m", "1 m"},
        {999.99e-6, "s", "1 ms"},
        {-2.5e6, "J/kg", "-2.5 MJ/kg"},
        {5350, "m/s", "5.35 km/s"},
        {800, "m/s", "800 m/s"},
        {2700, "kg/m^3", "2700 kg/m^3"},
        {0.005, "kg", "0.005 kg"},
        {1e-6, "m^2", "1e-06 m^2"},
        {5000, "1/s", "5000 1/s"},
        {1500, "K", "1500 K"},
        {4000, "s", "4000 s"},
        {0.5, "%", "0.5 %"},
        {1.25e6, "", "1.25e+06"},
        {0, "Pa", "0 Pa"},
        {3e13, "Pa", "3e+04 GPa"},
        {900, "J/(kg*K)", "900 J/(kg*K)"},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char text[64];
        readable(cases[i].value, cases[i].unit, text, sizeof text);
        assert_string_equal(text, cases[i].wanted);
    }
}

static void a_number_that_is_none_is_shown_as_it_is(void **state)
{
    (void)state;
    char text[64];
    readable(NAN, "Pa", text, sizeof text);
    assert_non_null(strstr(text, "nan"));
    readable(INFINITY, "Pa", text, sizeof text);
    assert_string_equal(text, "inf Pa");
    readable(123456, "Pa", text, 5);
    assert_int_equal(strlen(text), 4);
}

static void progress_is_one_line(void **state)
{
    (void)state;
    const struct simulation_case input = {.run = {.until = 5e-6}};
    struct simulation *simulation = calloc(1, sizeof *simulation);
    simulation->problem = &(struct problem){.input = &input};
    simulation->time = 3.1e-6;
    simulation->step = 1200;
    const struct limit limit = {2.1e-9, "sound", 0, INFINITY};
    char text[160];
    progress_text(simulation, &limit, 1.3e6, 12.2, text, sizeof text);
    assert_string_equal(text, "step 1200  t 3.10 us of 5.00 us (62 %)  dt 2.1 ns (sound)  1.3 M "
                              "updates/s  left 0:12");
    simulation->time = 0.0;
    simulation->step = 0;
    progress_text(simulation, &limit, 45.0, NAN, text, sizeof text);
    assert_string_equal(text, "step 0  t 0.00 s of 5.00 us (0 %)  dt 2.1 ns (sound)  45 updates/s  "
                              "left ?");
    progress_text(simulation, &limit, 45.0, 7384.0, text, sizeof text);
    assert_non_null(strstr(text, "left 2:03:04"));
    free(simulation);
}

static void hear(void *context, const char *text) { strcat(context, text); }

static void lines_go_to_the_log_and_to_the_listener(void **state)
{
    (void)state;
    char path[] = "/tmp/bolide-test-XXXXXX", heard[64] = "", text[64];
    close(mkstemp(path));
    const struct listener listener = {hear, NULL, heard};
    struct run_log *log;
    assert_null(run_log_open(path, false, &listener, &log));
    run_log_line(log, "step %d", 1);
    assert_null(run_log_close(log));
    assert_null(run_log_open(path, true, NULL, &log));
    run_log_line(log, "resumed");
    assert_null(run_log_close(log));
    assert_string_equal(heard, "step 1");
    FILE *file = fopen(path, "r");
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    unlink(path);
    assert_string_equal(text, "step 1\nresumed\n");
}

static void a_log_that_cannot_be_written_is_told_at_the_end(void **state)
{
    (void)state;
    struct run_log *log;
    const char *path = "test_report_full.log";
    struct rlimit before, none;
    assert_null(run_log_open(path, false, NULL, &log));
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    none = before;
    none.rlim_cur = 0;
    setrlimit(RLIMIT_FSIZE, &none);
    run_log_line(log, "lost");
    struct error *error = run_log_close(log);
    setrlimit(RLIMIT_FSIZE, &before);
    unlink(path);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_SYSTEM);
    error_free(error);
    error = run_log_open("/nowhere/run.log", false, NULL, &log);
    assert_non_null(strstr(error_message(error, 0), "/nowhere/run.log: No such file"));
    error_free(error);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_have_readable_units),
        cmocka_unit_test(a_number_that_is_none_is_shown_as_it_is),
        cmocka_unit_test(progress_is_one_line),
        cmocka_unit_test(lines_go_to_the_log_and_to_the_listener),
        cmocka_unit_test(a_log_that_cannot_be_written_is_told_at_the_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
