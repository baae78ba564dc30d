/* The run loop: its steps, outputs that only look, stopping and going on, and how it fails. A
 * solver of free flight, in which every particle keeps its velocity, stands in for a method where
 * that is enough. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/results.h"
#include "judged.h"
#include "model/generate.h"
#include "model/particles/fill.h"
#include "model/particles/held.h"
#include "model/solver.h"
#include "populations.h"
#include "run/catalogue.h"
#include "run/estimate.h"
#include "run/run.h"

struct flight_parameters {
    double step, later, heating;
    int64_t fail_at;
};

static const struct parameter flight_table[] = {
    {.key = "step",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct flight_parameters, step),
     .unit = "s",
     .standard = "0.3 s",
     .above = 0.0,
     .below = INFINITY},
    {.key = "later", /* the step after the first */
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct flight_parameters, later),
     .unit = "s",
     .standard = "0.3 s",
     .above = 0.0,
     .below = INFINITY},
    {.key = "heating",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct flight_parameters, heating),
     .unit = "J/kg",
     .standard = "0 J/kg"},
    {.key = "fail_at",
     .kind = PARAMETER_INTEGER,
     .offset = offsetof(struct flight_parameters, fail_at),
     .standard = "0"},
    PARAMETER_END,
};

struct flight {
    struct flight_parameters parameters; /* first: what the steps read */
    struct particles *particles;
};

static struct error *flight_create(void *solver, struct simulation *simulation,
                                   const void *parameters)
{
    struct flight *flight = solver;
    flight->parameters = *(const struct flight_parameters *)parameters;
    return particles_add(simulation, 1.0, NULL, 0, &flight->particles);
}

static struct error *flight_fill(void *solver, struct simulation *simulation)
{
    return generate_particles(simulation, ((struct flight *)solver)->particles);
}

static struct error *flight_start(void *solver, struct simulation *simulation)
{
    (void)solver;
    (void)simulation;
    return NULL;
}

static struct error *flight_prepare(void *solver, struct simulation *simulation,
                                    struct limit *limit)
{
    const struct flight_parameters *flight = solver;
    *limit = (struct limit){simulation->step ? flight->later : flight->step, "wish",
                            particles_of(simulation)->id[0], next_event(simulation)};
    return NULL;
}

static struct error *flight_advance(void *solver, struct simulation *simulation, double dt)
{
    const struct flight_parameters *flight = solver;
    struct particles *p = particles_of(simulation);
    if (simulation->step + 1 == flight->fail_at)
        return error_new(ERROR_STATE, "the wings came off");
    for (int32_t i = 0; i < p->count; i++) {
        p->position[i][0] += dt * p->velocity[i][0];
        p->energy[i] += flight->heating;
    }
    return NULL;
}

static struct error *flight_state(void *solver, struct visitor *visitor)
{
    (void)solver;
    (void)visitor;
    return NULL;
}

static void flight_destroy(void *solver) { particles_drop(((struct flight *)solver)->particles); }

static double flight_bytes(const void *parameters, int dimension)
{
    (void)parameters;
    return 100.0 * dimension;
}

static double flight_step(const void *parameters, const struct simulation_case *input,
                          const struct material *material, const struct point *point,
                          double diameter)
{
    (void)input;
    (void)material;
    (void)point;
    (void)diameter;
    return ((const struct flight_parameters *)parameters)->step;
}

static const struct solver_class flight_class = {.size = sizeof(struct flight),
                                                 .create = flight_create,
                                                 .fill = flight_fill,
                                                 .start = flight_start,
                                                 .prepare = flight_prepare,
                                                 .advance = flight_advance,
                                                 .state = flight_state,
                                                 .destroy = flight_destroy,
                                                 .bytes = flight_bytes,
                                                 .step = flight_step};

static const struct choice flight_choice = {"flight", "free flight", flight_table,
                                            sizeof(struct flight_parameters), &flight_class};

static const char flight_text[] =
    "format: 1\n"
    "dimension: 1\n"
    "resolution: 0.1 m\n"
    "solver: flight\n"
    "materials: {gas: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}}\n"
    "bodies: {slab: {material: gas, pressure: 1 Pa, velocity: [2 m/s],\n"
    "                box: {from: [0 m], to: [1 m]}}}\n"
    "run: {until: 1 s}\n"
    "checks: {momentum: {conserved: momentum, within: 1e-12}}\n";

static const char shock_text[] =
    "format: 1\n"
    "dimension: 1\n"
    "resolution: 1 mm\n"
    "solver: sph\n"
    "materials: {gas: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}}\n"
    "bodies:\n"
    "  left:  {material: gas, density: 1 kg/m^3, pressure: 100 kPa, box: {from: [0 mm], to: [50 "
    "mm]}}\n"
    "  right: {material: gas, density: 1 kg/m^3, pressure: 10 kPa, box: {from: [50 mm], to: [100 "
    "mm]}}\n"
    "walls: {low: {mirror: x, at: 0 mm, side: low}}\n"
    "run: {until: 50 us}\n"
    "output: {every: 20 us, history: 5 us, snapshots: no}\n";

static const char *const case_file = "test_run_case.yaml";

/* Reads TEXT with the solver of flight where it asks for that, under the settings NULL-ended. */
static struct simulation_case *read_text(const char *text, const char *const *settings)
{
    static struct choice_list lists[16];
    struct simulation_case *input;
    FILE *file = fopen(case_file, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
    int count = 0, kinds = 0;
    for (; bolide_catalogue.lists[kinds].kind_of_thing; kinds++) {
        lists[kinds] = bolide_catalogue.lists[kinds];
        if (strstr(text, "flight") && !strcmp(lists[kinds].kind_of_thing, "solver")) {
            lists[kinds].choices = &flight_choice;
            lists[kinds].count = 1;
        }
    }
    lists[kinds] = (struct choice_list){0};
    static struct catalogue catalogue;
    catalogue = (struct catalogue){lists};
    while (settings && settings[count])
        count++;
    struct case_options options = {.settings = settings, .setting_count = count};
    struct error *error = case_read(case_file, &options, &catalogue, &input);
    if (error)
        fail_msg("%s", error_message(error, 0));
    return input;
}

static struct run_result run_text(const char *text, const char *const *settings,
                                  const struct run_options *options)
{
    struct run_result result;
    struct simulation_case *input = read_text(text, settings);
    struct error *error = run_case(input, options, &result);
    if (error)
        fail_msg("%s", error_message(error, 0));
    case_free(input);
    return result;
}

/* The error of a run that must fail, of KIND, with TEXT in its first message. */
static void expect_failure(const char *text, const char *const *settings,
                           const struct run_options *options, enum error_kind kind,
                           const char *words)
{
    struct run_result result;
    struct simulation_case *input = read_text(text, settings);
    struct error *error = run_case(input, options, &result);
    assert_non_null(error);
    assert_int_equal(error_kind(error), kind);
    if (!strstr(error_message(error, 0), words))
        fail_msg("\"%s\" does not speak of \"%s\"", error_message(error, 0), words);
    error_free(error);
    run_result_free(&result);
    case_free(input);
}

/* A fresh folder under the one in which the test runs. */
static const char *fresh_folder(const char *name)
{
    char command[256];
    snprintf(command, sizeof command, "rm -rf '%s'", name);
    assert_int_equal(system(command), 0);
    return name;
}

static char *file_text(const char *folder, const char *name)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    char *text = calloc(1, 1 << 20);
    assert_non_null(text);
    assert_true(fread(text, 1, (1 << 20) - 1, file) > 0);
    fclose(file);
    return text;
}

static bool file_there(const char *folder, const char *name)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return access(path, R_OK) == 0;
}

static void what_remains_is_spread_over_the_last_two_steps(void **state)
{
    (void)state;
    assert_float_equal(step_towards(0.3, 0.0, 1.0), 0.3, 0.0);
    assert_float_equal(step_towards(0.3, 0.6, 1.0), 0.2, 1e-15);
    assert_float_equal(step_towards(0.3, 0.8, 1.0), 1.0 - 0.8, 0.0);
    assert_float_equal(step_towards(INFINITY, 0.0, 1.0), 1.0, 0.0);
}

static void a_run_ends_at_its_time_to_the_bit(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1};
    struct run_result result = run_text(flight_text, NULL, &options);
    assert_true(result.finished);
    assert_true(result.time == 1.0);
    assert_int_equal(result.steps, 4);
    assert_int_equal(result.particles, 10);
    assert_int_equal(result.updates, 40);
    assert_int_equal(result.checks.count, 1);
    assert_int_equal(result.checks.failed, 0);
    run_result_free(&result);
}

/* A wave that steepens divides cells, which are of the widest level at the start. */
static void updates_count_the_cells_of_each_step(void **state)
{
    (void)state;
    static const char text[] =
        "format: 1\ndimension: 1\nresolution: 1 mm\nlevels: 3\nsolver: gas\n"
        "materials: {air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}}\n"
        "bodies: {air: {material: air, box: {from: [0 m], to: [2.048 m]},\n"
        "               energy: '0.2 MJ/kg + 2 MJ/kg*exp(-((x - 1.024 m)/0.2 m)^2)'}}\n"
        "run: {until: 1 ms}\n";
    const int64_t cells_at_start = 2048 / 4;
    struct run_options options = {.threads = 1, .max_steps = 200};
    struct run_result result = run_text(text, NULL, &options);
    assert_int_equal(result.steps, 200);
    assert_true(result.particles > cells_at_start);
    assert_true(result.updates > 200 * cells_at_start && result.updates < 200 * result.particles);
    run_result_free(&result);
}

static void a_step_ends_where_a_body_stops(void **state)
{
    (void)state;
    const char *const settings[] = {"bodies.slab.stop=0.65s", NULL};
    struct run_options options = {.threads = 1, .max_steps = 3};
    struct run_result part = run_text(flight_text, settings, &options);
    assert_true(part.time == 0.65);
    options.max_steps = 0;
    struct run_result whole = run_text(flight_text, settings, &options);
    assert_true(whole.time == 1.0);
    assert_int_equal(whole.steps, 5);
    run_result_free(&part);
    run_result_free(&whole);
}

static void a_check_measured_early_survives_a_resume(void **state)
{
    (void)state;
    const char *const settings[] = {
        "checks.early={mean: position.x, at: 0.3 s, relative: start, at_most: 2}", NULL};
    const char *folder = fresh_folder("test_run_early");
    struct run_options options = {.threads = 1, .output = folder, .max_steps = 2};
    struct run_result whole = run_text(flight_text, settings, &(struct run_options){.threads = 1});
    struct run_result part = run_text(flight_text, settings, &options);
    run_result_free(&part);
    options.resume = true;
    options.max_steps = 0;
    part = run_text(flight_text, settings, &options);
    assert_true(part.checks.item[1].measured == whole.checks.item[1].measured);
    assert_float_equal(whole.checks.item[1].measured, (0.5 + 0.6) / 0.5, 1e-12);
    assert_true(part.checks.item[1].time == 0.3);
    run_result_free(&part);
    run_result_free(&whole);
}

static void a_failed_check_is_no_error(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1};
    const char *const settings[] = {"checks.still={maximum: velocity.x, at_most: 1 m/s}", NULL};
    struct run_result result = run_text(flight_text, settings, &options);
    assert_int_equal(result.checks.count, 2);
    assert_int_equal(result.checks.failed, 1);
    assert_string_equal(result.checks.item[1].name, "still");
    assert_float_equal(result.checks.item[1].measured, 2.0, 1e-15);
    run_result_free(&result);
}

static void watching_a_run_does_not_change_it(void **state)
{
    (void)state;
    struct run_options blind = {.threads = 1};
    struct run_options watched = {.threads = 1, .output = fresh_folder("test_run_watched")};
    const char *const often[] = {"output.every=1.7us", "output.history=0.9us",
                                 "output.checkpoint=1us", NULL};
    struct run_result first = run_text(shock_text, NULL, &blind);
    struct run_result second = run_text(shock_text, often, &watched);
    assert_true(first.steps == second.steps);
    assert_true(first.hash == second.hash);
    run_result_free(&first);
    run_result_free(&second);
}

static void a_stopped_run_goes_on_as_if_nothing_had_happened(void **state)
{
    (void)state;
    struct run_options whole = {.threads = 1, .output = fresh_folder("test_run_whole")};
    struct run_result uncut = run_text(shock_text, NULL, &whole);
    struct run_options part = {
        .threads = 1, .output = fresh_folder("test_run_parts"), .max_steps = uncut.steps / 2};
    struct run_result half = run_text(shock_text, NULL, &part);
    assert_false(half.finished);
    assert_int_equal(half.checks.count, 0);
    part.max_steps = 0;
    part.resume = true;
    struct run_result rest = run_text(shock_text, NULL, &part);
    assert_true(rest.finished);
    assert_true(rest.steps == uncut.steps && rest.updates < uncut.updates);
    assert_true(rest.hash == uncut.hash);
    char *history = file_text("test_run_whole", "history.csv");
    char *joined = file_text("test_run_parts", "history.csv");
    assert_string_equal(history, joined);
    free(history);
    free(joined);
    run_result_free(&uncut);
    run_result_free(&half);
    run_result_free(&rest);
}

static void a_signal_stops_a_run_with_a_checkpoint(void **state)
{
    (void)state;
    volatile sig_atomic_t stop = SIGTERM;
    struct run_options options = {
        .threads = 1, .output = fresh_folder("test_run_signal"), .stop = &stop};
    struct run_result result = run_text(shock_text, NULL, &options);
    assert_false(result.finished);
    assert_int_equal(result.steps, 0);
    assert_true(file_there("test_run_signal", "checkpoint.h5"));
    run_result_free(&result);
}

/* What a listener counts; it asks for a checkpoint when it hears of progress for the first time. */
struct heard {
    int progress, checkpoints;
    volatile sig_atomic_t wanted;
};

static void hear_line(void *context, const char *text)
{
    struct heard *heard = context;
    heard->checkpoints += !strncmp(text, "checkpoint at step ", 19);
}

static void hear_progress(void *context, const char *text)
{
    struct heard *heard = context;
    assert_non_null(strstr(text, "step "));
    heard->wanted += heard->progress++ == 0;
}

static void a_checkpoint_that_is_asked_for_does_not_stop_a_run(void **state)
{
    (void)state;
    struct heard heard = {0};
    const struct listener listener = {hear_line, hear_progress, &heard};
    struct run_options options = {.threads = 1,
                                  .output = fresh_folder("test_run_asked"),
                                  .checkpoints = &heard.wanted,
                                  .listener = &listener};
    struct run_options blind = {.threads = 1};
    struct run_result asked = run_text(shock_text, NULL, &options);
    struct run_result unasked = run_text(shock_text, NULL, &blind);
    assert_true(asked.finished && asked.hash == unasked.hash);
    assert_int_equal(heard.checkpoints, 1);
    run_result_free(&asked);
    run_result_free(&unasked);
}

static void progress_is_told_by_the_fraction_or_after_a_silence(void **state)
{
    (void)state;
    struct heard heard = {0};
    const struct listener listener = {hear_line, hear_progress, &heard};
    struct run_options options = {
        .threads = 1, .listener = &listener, .progress = {0.0, 0.25, 1000.0}};
    struct run_result result = run_text(shock_text, NULL, &options);
    assert_true(result.steps > 20);
    assert_in_range(heard.progress, 3, 4);
    run_result_free(&result);
    heard.progress = 0;
    options.progress.silence = 0.0;
    result = run_text(shock_text, NULL, &options);
    assert_true(heard.progress > 4);
    run_result_free(&result);
}

static void a_step_that_collapses_stops_a_run(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1, .output = fresh_folder("test_run_collapse")};
    const char *const settings[] = {"solver={flight: {later: 1e-12 s}}", NULL};
    expect_failure(flight_text, settings, &options, ERROR_STATE,
                   "the time step has collapsed to 1e-12 s, from 0.3 s at most");
    assert_true(file_there("test_run_collapse", "snapshots/failed.vtkhdf"));
    assert_true(file_there("test_run_collapse", "checkpoint.h5"));
    /* A user who wants few steps gets them; and many steps are no collapse. */
    struct run_options blind = {.threads = 1};
    const char *const few[] = {"solver={flight: {later: 1e-12 s}}", "run.max_steps=3000", NULL};
    struct run_result result = run_text(flight_text, few, &blind);
    assert_true(result.finished && result.steps == 3000);
    run_result_free(&result);
    blind.max_steps = 3000;
    const char *const many[] = {"solver={flight: {step: 1e-11 s, later: 1e-12 s}}", NULL};
    result = run_text(flight_text, many, &blind);
    assert_true(!result.finished && result.steps == 3000);
    run_result_free(&result);
}

static void a_run_that_failed_by_its_drift_goes_on_with_a_larger_limit(void **state)
{
    (void)state;
    const char *const strict[] = {"solver={flight: {heating: 1 J/kg}}", "run.energy_drift=0.2",
                                  "output.history=0.4 s", "output.every=0.3 s", NULL};
    const char *const mild[] = {"solver={flight: {heating: 1 J/kg}}", "run.energy_drift=0",
                                "output.history=0.4 s", "output.every=0.3 s", NULL};
    struct run_options options = {.threads = 1, .output = fresh_folder("test_run_drift")};
    expect_failure(flight_text, strict, &options, ERROR_STATE, "energy has drifted");
    options.resume = true;
    struct run_result resumed = run_text(flight_text, mild, &options);
    assert_true(resumed.finished);
    options = (struct run_options){.threads = 1, .output = fresh_folder("test_run_mild")};
    struct run_result whole = run_text(flight_text, mild, &options);
    assert_true(resumed.hash == whole.hash);
    /* A flight does not find pressures again, which are the last columns. */
    assert_int_equal(system("for f in drift mild; do cut -d, -f1-20 test_run_$f/history.csv "
                            ">test_run_$f/columns; done; "
                            "cmp test_run_drift/columns test_run_mild/columns"),
                     0);
    assert_int_equal(system("cmp test_run_drift/case.yaml test_run_mild/case.yaml"), 0);
    assert_int_equal(
        system("cmp test_run_drift/snapshots.vtkhdf.series test_run_mild/snapshots.vtkhdf.series"),
        0);
    run_result_free(&resumed);
    run_result_free(&whole);
}

/* The drift is looked at again where the run ends, though its outputs have been taken. */
static void a_drift_at_the_end_stops_a_resumed_run_again(void **state)
{
    (void)state;
    const char *const settings[] = {"solver={flight: {heating: 1 J/kg}}", "run.energy_drift=0.2",
                                    "output.history=10 s", NULL};
    struct run_options options = {.threads = 1, .output = fresh_folder("test_run_drift_end")};
    expect_failure(flight_text, settings, &options, ERROR_STATE, "energy has drifted");
    options.resume = true;
    expect_failure(flight_text, settings, &options, ERROR_STATE, "energy has drifted");
}

static void a_folder_takes_one_run_at_a_time(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1, .output = fresh_folder("test_run_locked")};
    struct run_result result = run_text(flight_text, NULL, &options);
    run_result_free(&result);
    struct results_lock lock = {0};
    assert_null(results_lock("test_run_locked", &lock));
    expect_failure(flight_text, NULL, &options, ERROR_INPUT, "is in use by another run");
    options.overwrite = true;
    expect_failure(flight_text, NULL, &options, ERROR_INPUT, "is in use by another run");
    results_unlock(&lock);
    result = run_text(flight_text, NULL, &options);
    run_result_free(&result);
    assert_false(file_there("test_run_locked", ".bolide-lock"));
}

static void results_are_not_overwritten_unasked(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1, .output = fresh_folder("test_run_twice")};
    struct run_result result = run_text(flight_text, NULL, &options);
    run_result_free(&result);
    assert_true(file_there("test_run_twice", "case.yaml"));
    assert_true(file_there("test_run_twice", "checks.csv"));
    expect_failure(flight_text, NULL, &options, ERROR_INPUT, "test_run_twice");
    options.overwrite = true;
    result = run_text(flight_text, NULL, &options);
    run_result_free(&result);
}

static void another_case_cannot_go_on_from_a_checkpoint(void **state)
{
    (void)state;
    struct run_options options = {
        .threads = 1, .output = fresh_folder("test_run_other"), .max_steps = 1};
    struct run_result result = run_text(flight_text, NULL, &options);
    run_result_free(&result);
    const char *const finer[] = {"resolution=1mm", NULL};
    options.resume = true;
    expect_failure(flight_text, finer, &options, ERROR_INPUT, "a resumed run cannot change it");
    options.output = fresh_folder("test_run_none");
    expect_failure(flight_text, NULL, &options, ERROR_INPUT, "nothing to resume");
}

static void the_case_as_run_is_a_case_that_runs_the_same(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1, .output = fresh_folder("test_run_again")};
    struct run_result first = run_text(shock_text, NULL, &options);
    char *written = file_text("test_run_again", "case.yaml");
    assert_non_null(written);
    struct run_options blind = {.threads = 1};
    struct run_result second = run_text(written, NULL, &blind);
    assert_true(first.hash == second.hash);
    free(written);
    run_result_free(&first);
    run_result_free(&second);
}

static void an_impossible_state_leaves_a_snapshot_of_its_moment(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1, .output = fresh_folder("test_run_failed")};
    const char *const settings[] = {"solver={flight: {fail_at: 3}}", NULL};
    expect_failure(flight_text, settings, &options, ERROR_STATE, "the wings came off");
    assert_true(file_there("test_run_failed", "snapshots/failed.vtkhdf"));
}

static void energy_from_nowhere_stops_a_run(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1};
    const char *const limited[] = {"solver={flight: {heating: 10 J/kg}}", "run.energy_drift=5 %",
                                   NULL};
    expect_failure(flight_text, limited, &options, ERROR_STATE, "energy has drifted");
    const char *const allowed[] = {"solver={flight: {heating: 10 J/kg}}", "run.energy_drift=0",
                                   NULL};
    struct run_result result = run_text(flight_text, allowed, &options);
    assert_true(result.finished);
    run_result_free(&result);
}

static void energy_that_drifts_is_a_warning_where_no_limit_is_given(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1, .output = fresh_folder("test_run_drift")};
    const char *const settings[] = {"solver={flight: {heating: 10 J/kg}}", NULL};
    struct run_result result = run_text(flight_text, settings, &options);
    assert_true(result.finished && result.energy_drift > 0.05);
    run_result_free(&result);
    char *log = file_text("test_run_drift", "run.log");
    const char *first = strstr(log, "warning: energy: ");
    assert_non_null(first);
    assert_non_null(strstr(first, "the total energy has drifted by"));
    first = strstr(first + 1, "warning: energy: "); /* once, and again at the end */
    assert_non_null(first);
    assert_null(strstr(first + 1, "warning: energy: "));
    assert_null(strstr(log, "grid")); /* of a solver that has none */
    free(log);
}

/* What a solver says of a drift of its energy, under SETTING. */
static const char *energy_lost_with(const char *setting)
{
    const char *const settings[] = {setting, NULL};
    struct simulation_case *input = read_text(shock_text, settings);
    struct findings findings;
    const char *why = judged(input, &findings).energy_lost;
    findings_free(&findings);
    case_free(input);
    return why;
}

static void every_solver_explains_a_drift_of_its_own_energy(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"solver=mpm", "nodes of the grid"},
        {"solver={sph: {method: hllc}}", "`correction: own`"},
        {"solver={sph: {method: {hllc: {correction: symmetric}}}}", "error of the step"},
        {"solver={sph: {method: monaghan}}", "`correction: own`"},
        {"solver={sph: {method: {monaghan: {correction: symmetric}}}}", "error of the step"},
        {"solver={sph: {method: {muscl: {energy: internal}}}}", "`energy: total` conserves"},
        {"solver={sph: {method: {contact: {energy: internal}}}}", "`energy: total` conserves"},
        {"solver={sph: {method: {standard: {energy: internal}}}}", "`energy: total` conserves"}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const char *why = energy_lost_with(cases[i][0]);
        assert_non_null(why);
        if (!strstr(why, cases[i][1]) || (i > 0 && strstr(why, "grid")))
            fail_msg("%s: %s", cases[i][0], why);
    }
    static const char *const conserving[] = {"solver=sph", "solver={sph: {method: contact}}",
                                             "solver={sph: {method: standard}}"};
    for (size_t i = 0; i < COUNT_OF(conserving); i++)
        assert_null(energy_lost_with(conserving[i]));
}

/* A solid that springs from rest has next to no energy in its first steps. */
static void a_start_from_rest_does_not_stop_a_run(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1};
    const char *const settings[] = {
        "solver.sph.method={muscl: {energy: internal}}",
        "materials.gas.eos={barotropic: {density: 2700 kg/m^3, bulk_modulus: 73 GPa}}",
        "bodies.left={material: gas, pressure: 4 GPa, box: {from: [0 mm], to: [50 mm]}}",
        "bodies.right={material: gas, box: {from: [50 mm], to: [100 mm]}}",
        "run.until=2us",
        "output.history=1ns",
        NULL};
    struct run_result result = run_text(shock_text, settings, &options);
    assert_true(result.finished);
    assert_true(result.energy_drift > 1e-6 && result.energy_drift < 0.02);
    run_result_free(&result);
}

static void a_mistake_in_a_check_is_told_before_the_first_step(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1};
    const char *const settings[] = {"checks.odd={maximum: speeed, at_most: 1 m/s}", NULL};
    expect_failure(flight_text, settings, &options, ERROR_INPUT, "did you mean \"speed\"");
}

static void a_picture_that_cannot_be_is_told_before_anything_is_written(void **state)
{
    (void)state;
    struct run_options options = {.threads = 1, .output = fresh_folder("test_run_picture")};
    const char *const settings[] = {"output.pictures=[pressure, presure]", NULL};
    expect_failure(flight_text, settings, &options, ERROR_INPUT,
                   "output.pictures.presure: the particles have no field \"presure\" (did you mean "
                   "\"pressure\"?)");
    const char *const vector[] = {"output.pictures=velocity", NULL};
    expect_failure(flight_text, vector, &options, ERROR_INPUT, "choose its component: velocity.x");
    assert_false(file_there("test_run_picture", "."));
}

static void all_errors_of_a_run_are_found_before_it(void **state)
{
    (void)state;
    const char *const settings[] = {
        "checks={odd: {maximum: speeed, at_most: 1}, l: {l1: pressure, at_most: 1}}",
        "bodies.more={material: gas, pressure: 1 Pa, box: {from: [0 m], to: [1 m]}}",
        "output.pictures=[velocity]", NULL};
    struct simulation_case *input = read_text(flight_text, settings);
    struct estimate estimate;
    struct error *error = estimate_run(input, &estimate);
    static const char *const words[] = {"overlaps", "speeed", "needs an exact solution",
                                        "velocity.x"};
    assert_non_null(error);
    assert_int_equal(error_count(error), 4);
    for (int i = 0; i < 4; i++)
        if (!strstr(error_message(error, i), words[i]))
            fail_msg("\"%s\" does not speak of \"%s\"", error_message(error, i), words[i]);
    error_free(error);
    case_free(input);
}

static void a_body_thinner_than_the_resolution_is_a_warning(void **state)
{
    (void)state;
    const char *const settings[] = {
        "bodies.film={material: gas, pressure: 1 Pa, box: {from: [1 m], to: [1.06 m]}}", NULL};
    struct simulation_case *input = read_text(flight_text, settings);
    struct findings findings = {.input = input};
    generate_judge(&findings);
    assert_int_equal(findings_count(&findings, FINDING_DOUBTFUL), 1);
    assert_non_null(strstr(findings_text(&findings, FINDING_DOUBTFUL, 0),
                           "bodies.film: smaller than the resolution"));
    findings_free(&findings);
    case_free(input);
    input = read_text(flight_text, NULL);
    findings.input = input;
    generate_judge(&findings);
    assert_int_equal(findings_count(&findings, FINDING_DOUBTFUL), 0);
    case_free(input);
}

static void acoustic_contacts_of_a_strong_shock_are_a_warning(void **state)
{
    (void)state;
    const char *const solver[] = {"solver={sph: {method: contact}}",
                                  "solver={sph: {method: {contact: {riemann: dukowicz}}}}",
                                  "solver=sph"};
    for (int k = 0; k < 3; k++) {
        const char *const settings[] = {solver[k], "bodies.left.pressure=1 GPa", NULL};
        struct simulation_case *input = read_text(shock_text, settings);
        struct findings findings;
        judged(input, &findings);
        assert_int_equal(findings_count(&findings, FINDING_DOUBTFUL), k == 0);
        if (k == 0)
            assert_non_null(
                strstr(findings_text(&findings, FINDING_DOUBTFUL, 0), "times the speed of sound"));
        findings_free(&findings);
        case_free(input);
    }
}

/* Times of objects in HDF5 files count seconds. */
static void two_runs_write_the_same_files(void **state)
{
    (void)state;
    const char *const settings[] = {"output.snapshots=yes", NULL};
    struct run_options options = {.threads = 1, .output = fresh_folder("test_run_first")};
    struct run_result first = run_text(shock_text, settings, &options);
    sleep(1);
    options.output = fresh_folder("test_run_second");
    struct run_result second = run_text(shock_text, settings, &options);
    assert_int_equal(system("cmp test_run_first/checkpoint.h5 test_run_second/checkpoint.h5"), 0);
    assert_int_equal(system("diff -r test_run_first/snapshots test_run_second/snapshots"), 0);
    run_result_free(&first);
    run_result_free(&second);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_remains_is_spread_over_the_last_two_steps),
        cmocka_unit_test(a_run_ends_at_its_time_to_the_bit),
        cmocka_unit_test(updates_count_the_cells_of_each_step),
        cmocka_unit_test(a_step_ends_where_a_body_stops),
        cmocka_unit_test(a_check_measured_early_survives_a_resume),
        cmocka_unit_test(a_failed_check_is_no_error),
        cmocka_unit_test(watching_a_run_does_not_change_it),
        cmocka_unit_test(a_stopped_run_goes_on_as_if_nothing_had_happened),
        cmocka_unit_test(a_signal_stops_a_run_with_a_checkpoint),
        cmocka_unit_test(a_checkpoint_that_is_asked_for_does_not_stop_a_run),
        cmocka_unit_test(progress_is_told_by_the_fraction_or_after_a_silence),
        cmocka_unit_test(a_step_that_collapses_stops_a_run),
        cmocka_unit_test(a_run_that_failed_by_its_drift_goes_on_with_a_larger_limit),
        cmocka_unit_test(a_drift_at_the_end_stops_a_resumed_run_again),
        cmocka_unit_test(a_folder_takes_one_run_at_a_time),
        cmocka_unit_test(results_are_not_overwritten_unasked),
        cmocka_unit_test(another_case_cannot_go_on_from_a_checkpoint),
        cmocka_unit_test(the_case_as_run_is_a_case_that_runs_the_same),
        cmocka_unit_test(an_impossible_state_leaves_a_snapshot_of_its_moment),
        cmocka_unit_test(energy_from_nowhere_stops_a_run),
        cmocka_unit_test(energy_that_drifts_is_a_warning_where_no_limit_is_given),
        cmocka_unit_test(every_solver_explains_a_drift_of_its_own_energy),
        cmocka_unit_test(a_start_from_rest_does_not_stop_a_run),
        cmocka_unit_test(a_mistake_in_a_check_is_told_before_the_first_step),
        cmocka_unit_test(a_picture_that_cannot_be_is_told_before_anything_is_written),
        cmocka_unit_test(all_errors_of_a_run_are_found_before_it),
        cmocka_unit_test(a_body_thinner_than_the_resolution_is_a_warning),
        cmocka_unit_test(acoustic_contacts_of_a_strong_shock_are_a_warning),
        cmocka_unit_test(two_runs_write_the_same_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
