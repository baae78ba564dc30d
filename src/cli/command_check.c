/* bolide check: what a case would compute. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/cli.h"
#include "model/solver.h"
#include "run/forecast.h"
#include "run/grain_cells.h"
#include "run/judge.h"
#include "run/run.h"
#include "study/calibrate.h"
#include "study/sweep.h"

static const char *mass_unit(const struct simulation_case *input)
{
    return ledger_unit(LEDGER_MASS, (int)input->dimension, (enum case_geometry)input->geometry);
}

/* What the solver of the case computes with. */
static const char *members_of(const struct simulation_case *input)
{
    const struct solver_class *class = input->solver.choice->thing;
    return class->members ? class->members : "particles";
}

static void print_bodies(const struct simulation_case *input, const struct estimate *estimate)
{
    printf("  %-20s %-16s %12s %16s %12s %12s %12s %12s\n", "body", "material", members_of(input),
           "mass", "diameter", "density", "C_long", "C_shear");
    for (int i = 0; i < estimate->bodies; i++) {
        const struct body_input *body = case_body(input, i);
        const struct body_estimate *of = &estimate->body[i];
        char diameter[48];
        readable(of->summary.diameter, "m", diameter, sizeof diameter);
        printf("  %-20s %-16s %12lld %10.5g %-5s %12s %7.5g %s %8.5g %s %8.5g %s\n",
               input->bodies.names[i], body->material, (long long)of->summary.counted,
               of->summary.mass, mass_unit(input), diameter, of->summary.fastest.density, "kg/m3",
               of->sound_long, "m/s", of->sound_shear, "m/s");
    }
}

/* `density 2697 to 2699 kg/m3` */
static void print_range(const char *before, const char *what, const struct extremes *range,
                        const char *unit)
{
    if (range->low == range->high)
        printf("%s%s %.5g %s", before, what, range->low, unit);
    else
        printf("%s%s %.5g to %.5g %s", before, what, range->low, range->high, unit);
}

/* What differs from particle to particle of a body at the start, and its temperature where it has
 * one. */
static void print_start(const char *name, const struct body_summary *start)
{
    bool warm = !isnan(start->temperature.low);
    const char *before = "";
    if (!warm && start->speed.low == start->speed.high &&
        start->density.low == start->density.high && start->pressure.low == start->pressure.high)
        return;
    printf("  %s starts with ", name);
    if (start->density.low != start->density.high) {
        print_range(before, "density", &start->density, "kg/m3");
        before = ", ";
    }
    if (start->pressure.low != start->pressure.high) {
        print_range(before, "pressure", &start->pressure, "Pa");
        before = ", ";
    }
    if (start->speed.low != start->speed.high) {
        print_range(before, "speed", &start->speed, "m/s");
        before = ", ";
    }
    if (warm)
        print_range(before, "temperature", &start->temperature, "K");
    printf("\n");
}

/* `mean density 2025 kg/m3 in 20.4 um x 0.8 um; by mass: tungsten 84.2 %, lithium 15.8 %` */
static void print_mixture(const struct simulation_case *input, const struct estimate *estimate)
{
    const struct vec3 extent = vec3_sub(estimate->box.high, estimate->box.low);
    const double length[3] = {extent.x, extent.y, extent.z};
    assert(input->dimension <= 3);
    printf("  mean density %.6g kg/m3 in ", estimate->mean_density);
    for (int axis = 0; axis < input->dimension; axis++) {
        char text[48];
        readable(length[axis], "m", text, sizeof text);
        printf("%s%s", axis ? " x " : "", text);
    }
    const char *before = "; by mass: ";
    for (int i = 0; i < input->materials.count && input->materials.count > 1; i++) {
        if (estimate->material_mass[i] == 0.0)
            continue;
        printf("%s%s %.4g %%", before, input->materials.names[i],
               100.0 * estimate->material_mass[i] / estimate->mass);
        before = ", ";
    }
    printf("\n");
}

/* `grains: 14.3 particles across the mean grain, 10 across the smallest` */
static void print_grains(const struct simulation_case *input)
{
    struct grain_cells cells;
    for (int body = 0; body < input->bodies.count; body++) {
        if (!grain_cells_of(input, body, &cells))
            continue;
        printf("  %s: %.3g %s across the mean grain", input->bodies.names[body], cells.mean,
               members_of(input));
        if (!isnan(cells.smallest))
            printf(", %.3g across the smallest", cells.smallest);
        printf("\n");
    }
}

static void print_explosives(const struct simulation_case *input)
{
    for (int i = 0; i < input->materials.count; i++) {
        char before[128];
        snprintf(before, sizeof before, "  %s: ", input->materials.names[i]);
        print_detonation(before, "; ", case_material(input, i)->material);
    }
}

static void print_run(const struct simulation_case *input, const struct estimate *estimate)
{
    char step[48], until[48];
    readable(estimate->step, "s", step, sizeof step);
    readable(input->run.until, "s", until, sizeof until);
    printf("  %lld %s, ", (long long)estimate->particles, members_of(input));
    if (estimate->cells > 0.0)
        printf("%.15g cells, ", round(estimate->cells));
    printf("%.6g %s; %d checks\n", estimate->mass, mass_unit(input), input->checks.count);
    printf("  until %s; first step about %s (body %s)\n", until, step,
           input->bodies.names[estimate->step_body]);
}

static void print_forecast(const struct forecast *forecast)
{
    char memory[48], *text = forecast_text(forecast);
    readable(forecast->bytes, "B", memory, sizeof memory);
    printf("  %s\n  about %s of memory\n", text ? text : "", memory);
    free(text);
}

static void print_finding(void *context, const char *text)
{
    (void)context;
    printf("  %s\n", text);
}

static void print_warnings(const struct simulation_case *input, const struct estimate *estimate,
                           const struct forecast *forecast)
{
    if (forecast->steps > RUN_STEPS_HOPELESS)
        printf("  warning: about %.2g steps are more than any run takes: look at `run.until`, the "
               "resolution of %s, its speed and its material\n",
               forecast->steps, input->bodies.names[estimate->step_body]);
    const struct solver_class *class = input->solver.choice->thing;
    if (class->count && !run_is_filled_in_check(input))
        printf(
            "  not filled, for it would take too long: `run` looks for gaps between the bodies%s\n",
            input->start.input ? ", and whether the blast of `start` fits" : "");
    const struct ranks alone = ranks_alone();
    struct simulation simulation;
    struct error *error = simulation_create(input, &alone, 1, &simulation);
    if (!error) {
        struct judgement judgement = judge_solver(&simulation);
        judge_bodies(&judgement);
        judge_tell(&judgement.findings, print_finding, NULL);
        findings_free(&judgement.findings);
        simulation_destroy(&simulation);
    }
    error_free(error); /* estimate_run has reported it */
}

/* Before a silence. */
static void print_work(const struct simulation_case *input)
{
    const struct ranks alone = ranks_alone();
    const double work = generate_work(input, &alone);
    if (work <= GENERATE_LONG || work > GENERATE_MOST)
        return;
    printf("%s: counting particles, which may take minutes\n", input->name);
    fflush(stdout);
}

/* The forecast of a run of INPUT as OPTIONS want it: with a pilot, or without. */
static struct forecast forecast_for(const struct simulation_case *input,
                                    const struct estimate *estimate,
                                    const struct cli_options *options)
{
    const struct ranks alone = ranks_alone();
    char *rates = rates_path();
    const struct run_options running = {.ranks = &alone,
                                        .threads = options->threads > 0 ? (int)options->threads : 1,
                                        .stop = options->pilot ? signals_catch() : NULL,
                                        .rates = rates};
    struct forecast forecast = forecast_make(input, estimate, &running);
    struct error *error = forecast_check_memory(input, &forecast, &alone);
    if (options->pilot && (!error || options->force))
        forecast_by_pilot(input, estimate, &running, FORECAST_PILOT_SECONDS, &forecast);
    error_free(error);
    free(rates);
    return forecast;
}

/* The case at PATH, or the run RUN of its sweep; *runs is how many there are. */
static struct error *check_run(const char *path, const struct cli_options *options, int run,
                               int *runs)
{
    struct simulation_case *input;
    struct estimate estimate;
    TRY(read_run_of_sweep(path, options, run, &input));
    *runs = input->sweep_runs;
    if (*runs && !run) {
        case_free(input);
        return NULL;
    }
    char *name = run ? sweep_run_name(input->sweep, input->sweep_values) : NULL;
    print_work(input);
    struct error *error = estimate_run(input, &estimate);
    if (!error) {
        printf("%s%s%s%s%s: %s (%lld-D, %s)\n", colour(COLOUR_STRONG), input->name, name ? "/" : "",
               name ? name : "", colour(COLOUR_NONE), input->title ? input->title : "",
               (long long)input->dimension, input->solver.choice->name);
        print_bodies(input, &estimate);
        for (int i = 0; i < estimate.bodies; i++)
            print_start(input->bodies.names[i], &estimate.body[i].summary);
        print_mixture(input, &estimate);
        print_grains(input);
        print_explosives(input);
        print_run(input, &estimate);
        const struct forecast forecast = forecast_for(input, &estimate, options);
        print_forecast(&forecast);
        print_warnings(input, &estimate, &forecast);
        if (!options->force)
            error = forecast_check_memory(input, &forecast, &(struct ranks){.size = 1});
        estimate_free(&estimate);
    }
    free(name);
    case_free(input);
    return error;
}

/* The targets of `calibrate`, with the files that they name. */
static struct error *check_calibration(const char *path, const struct cli_options *options)
{
    struct simulation_case *input;
    TRY(read_run_of_sweep(path, options, 0, &input));
    char *materials = share_folder("materials");
    const struct verify_options reading = {
        .reading = case_reading(options, (const char *const *)&materials),
        .catalogue = &bolide_catalogue,
    };
    struct error *error =
        input->calibrate.keys.count ? calibrate_validate(input, path, &reading) : NULL;
    free(materials);
    case_free(input);
    return error;
}

static struct error *check_case(const char *path, const struct cli_options *options)
{
    int runs;
    struct error *error = check_run(path, options, 0, &runs);
    for (int run = 1; !error && run <= runs; run++)
        error = check_run(path, options, run, &runs);
    return error ? error : check_calibration(path, options);
}

int command_check(const struct cli_options *options)
{
    struct error *error = NULL;
    for (int i = 0; i < options->names.count; i++)
        error = error_join(error, check_case(options->names.text[i], options));
    return error ? report_error(error) : EXIT_OK;
}
