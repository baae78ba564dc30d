/* history.csv: its columns, and going on behind an interrupted run. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <sys/resource.h>
#include <unistd.h>

#include "build_simulation.h"
#include "output/history.h"
#include "populations.h"

static char path[] = "/tmp/bolide-test-XXXXXX";

static int make_file(void **state)
{
    (void)state;
    strcpy(path + sizeof path - 7, "XXXXXX");
    return close(mkstemp(path));
}

static int remove_file(void **state)
{
    (void)state;
    return unlink(path);
}

static struct error *write_row(struct history *history, const struct simulation *simulation,
                               const struct totals *start)
{
    const struct totals now = simulation_totals(simulation);
    return history_row(history, simulation, 1e-7, &now, start);
}

/* Writes ROWS rows, one microsecond apart, from FIRST on. */
static void write_rows(int64_t keep, int first, int rows)
{
    struct simulation *simulation = build_simulation(4);
    const struct totals start =
        population_totals(simulation_population(simulation), simulation->ranks, -1);
    struct history *history;
    assert_null(history_open(path, keep, NULL, &history));
    for (int i = first; i < first + rows; i++) {
        simulation->time = i * 1e-6;
        simulation->step = i;
        assert_null(write_row(history, simulation, &start));
    }
    assert_int_equal(history_rows(history), (keep > 0 ? keep : 0) + rows);
    assert_null(history_close(history));
    drop_simulation(simulation);
}

/* The whole file in fresh memory. */
static char *content(void)
{
    char *text = calloc(1, 1 << 16);
    FILE *file = fopen(path, "r");
    assert_true(fread(text, 1, (1 << 16) - 1, file) < (1 << 16) - 1);
    fclose(file);
    return text;
}

/* The number in the column whose head is NAME, in the row ROW from 1 on. */
static double number(const char *name, int row)
{
    char *text = content(), *rest = text;
    char *head = strsep(&rest, "\n"), *line = NULL;
    for (int i = 0; i < row; i++)
        line = strsep(&rest, "\n");
    assert_non_null(line);
    double value = NAN;
    bool found = false;
    for (char *title; (title = strsep(&head, ","));) {
        char *field = strsep(&line, ",");
        assert_non_null(field);
        if (!strcmp(title, name)) {
            value = strtod(field, NULL);
            found = true;
        }
    }
    assert_null(line);
    if (!found)
        fail_msg("there is no column \"%s\"", name);
    free(text);
    return value;
}

static void a_row_tells_the_totals_and_the_extremes(void **state)
{
    (void)state;
    write_rows(-1, 1, 2);
    assert_true(number("time [s]", 2) == 2e-6);
    assert_true(number("step", 2) == 2.0);
    assert_true(number("dt [s]", 1) == 1e-7);
    assert_true(number("particles", 1) == 4.0);
    assert_true(number("mass [kg]", 1) == 8.0);
    assert_true(number("momentum.x [kg*m/s]", 1) == 24.0);
    assert_true(number("momentum.y [kg*m/s]", 1) == 16.0);
    assert_true(number("kinetic_energy [J]", 1) == 9.0 + 25.0 + 9.0 + 25.0);
    assert_true(number("internal_energy [J]", 1) == 120.0);
    assert_true(number("energy [J]", 1) == 188.0);
    assert_true(number("energy_drift", 1) == 0.0);
    assert_true(number("walls.energy [J]", 1) == 0.0);
    assert_true(number("density.min [kg/m^3]", 1) == 1000.0);
    assert_true(number("density.max [kg/m^3]", 1) == 1003.0);
    assert_true(number("pressure.max [Pa]", 1) == 1e9);
    assert_true(number("speed.min [m/s]", 1) == 3.0);
    assert_true(number("speed.max [m/s]", 1) == 5.0);
}

static void drift_counts_what_the_ledger_booked(void **state)
{
    (void)state;
    struct simulation *simulation = build_simulation(4);
    const struct totals start =
        population_totals(simulation_population(simulation), simulation->ranks, -1);
    particles_of(simulation)->energy[0] +=
        47.0; /* of two kilograms: 94 J, half of what was there */
    struct history *history;
    assert_null(history_open(path, -1, NULL, &history));
    assert_null(write_row(history, simulation, &start));
    ledger_book(&simulation->ledger, LEDGER_WALLS, 0.0, vec3_make(1.0, 0.0, 0.0),
                vec3_make(0.0, 0.0, 0.0), 94.0);
    assert_null(write_row(history, simulation, &start));
    assert_null(history_close(history));
    assert_float_equal(number("energy_drift", 1), 94.0 / (188.0 + 94.0), 1e-15);
    assert_true(number("energy_drift", 2) == 0.0);
    assert_true(number("walls.energy [J]", 2) == 94.0);
    assert_true(number("walls.momentum.x [kg*m/s]", 2) == 1.0);
    drop_simulation(simulation);
}

static void units_follow_the_dimension(void **state)
{
    (void)state;
    struct simulation *simulation = build_simulation(1);
    problem_of(simulation)->dimension = 2;
    const struct totals start = {0};
    struct history *history;
    assert_null(history_open(path, -1, NULL, &history));
    assert_null(write_row(history, simulation, &start));
    assert_null(history_close(history));
    assert_true(number("mass [kg/m]", 1) == 2.0);
    number("momentum.x [kg/s]", 1);
    number("energy [J/m]", 1);
    drop_simulation(simulation);
}

static void a_resumed_history_is_the_uninterrupted_one(void **state)
{
    (void)state;
    write_rows(-1, 1, 6);
    char *whole = content();
    write_rows(-1, 1, 5); /* the checkpoint knows three of these */
    FILE *file = fopen(path, "a");
    fputs("4e-6,4,1e-", file); /* and the run was killed while it wrote */
    fclose(file);
    write_rows(3, 4, 3);
    char *resumed = content();
    assert_string_equal(resumed, whole);
    free(resumed);
    write_rows(0, 1, 6);
    resumed = content();
    assert_string_equal(resumed, whole);
    free(resumed);
    free(whole);
}

static void missing_rows_are_an_error(void **state)
{
    (void)state;
    write_rows(-1, 1, 2);
    struct history *history;
    struct error *error = history_open(path, 3, NULL, &history);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_non_null(strstr(error_message(error, 0), "has 2 rows, but 3 were written"));
    error_free(error);
    error = history_open("/nowhere/history.csv", 3, NULL, &history);
    assert_non_null(strstr(error_message(error, 0), "/nowhere/history.csv: No such file"));
    error_free(error);
}

/* Overwrites a byte of the file at PLACE. */
static void change_byte(long place)
{
    FILE *file = fopen(path, "r+");
    assert_int_equal(fseek(file, place, SEEK_SET), 0);
    putc('7', file);
    fclose(file);
}

static void rows_that_were_changed_since_the_checkpoint_are_an_error(void **state)
{
    (void)state;
    struct simulation *simulation = build_simulation(1);
    const struct totals start = {0};
    struct history *history;
    struct csv_mark early, late;
    assert_null(history_open(path, -1, NULL, &history));
    assert_null(write_row(history, simulation, &start));
    assert_null(history_mark(history, &early));
    assert_null(write_row(history, simulation, &start));
    assert_null(history_close(history));

    /* What follows is no row of the checkpoint's. The mark goes on as the rows do. */
    change_byte(early.bytes + 1);
    assert_null(history_open(path, 1, &early, &history));
    assert_null(write_row(history, simulation, &start));
    assert_null(history_mark(history, &late));
    assert_true(early.bytes < late.bytes && early.hash != late.hash);
    assert_null(history_close(history));
    assert_null(history_open(path, 2, &late, &history));
    assert_null(history_close(history));

    change_byte(early.bytes - 2);
    struct error *error = history_open(path, 1, &early, &history);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_non_null(strstr(error_message(error, 0), path));
    assert_non_null(strstr(error_message(error, 0), "its first 1 rows are not those"));
    error_free(error);
    drop_simulation(simulation);
}

static void a_full_disk_is_an_error(void **state)
{
    (void)state;
    struct simulation *simulation = build_simulation(1);
    const struct totals start = {0};
    struct history *history;
    assert_null(history_open(path, -1, NULL, &history));
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit before, few;
    getrlimit(RLIMIT_FSIZE, &before);
    few = before;
    few.rlim_cur = 1;
    setrlimit(RLIMIT_FSIZE, &few);
    struct error *error = write_row(history, simulation, &start);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_SYSTEM);
    assert_non_null(strstr(error_message(error, 0), path));
    assert_non_null(strstr(error_message(error, 0), "File too large"));
    error_free(error);
    error_free(history_close(history));
    drop_simulation(simulation);
}

#define WITH_FILE(test) cmocka_unit_test_setup_teardown(test, make_file, remove_file)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FILE(a_row_tells_the_totals_and_the_extremes),
        WITH_FILE(drift_counts_what_the_ledger_booked),
        WITH_FILE(units_follow_the_dimension),
        WITH_FILE(a_resumed_history_is_the_uninterrupted_one),
        WITH_FILE(missing_rows_are_an_error),
        WITH_FILE(rows_that_were_changed_since_the_checkpoint_are_an_error),
        WITH_FILE(a_full_disk_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
