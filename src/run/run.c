/* The run loop of the design: prepare, choose the step, advance, commit, observe. It knows no
 * method. */
#include "run/run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "base/clock.h"
#include "base/delay.h"
#include "base/memory.h"
#include "material/any.h"
#include "material/material.h"
#include "measure/connected.h"
#include "measure/fragments.h"
#include "model/generate.h"
#include "model/maps.h"
#include "model/particles/held.h"
#include "output/faces.h"
#include "run/fit_axes.h"
#include "run/forecast.h"
#include "run/pictures.h"
#include "run/run_internal.h"

/* A thread with fewer particles costs more in waiting than it gains in work. The second number
 * counts where the user has given the number of threads. Results depend on neither. */
enum { PARTICLES_A_THREAD = 2000, PARTICLES_A_THREAD_AT_LEAST = 64 };

/* Many more threads than processors do not help either, and the system may refuse to start them. */
enum { THREADS_A_PROCESSOR = 4 };

static int threads_at_most(int asked)
{
#ifdef _OPENMP
    int most = THREADS_A_PROCESSOR * omp_get_num_procs();
    int wanted = asked > 0 ? asked : omp_get_max_threads();
    return wanted < most ? wanted : most;
#else
    (void)asked;
    return 1;
#endif
}

/* As many as there is work for. */
int run_threads(int asked, double members)
{
    const int each = asked > 0 ? PARTICLES_A_THREAD_AT_LEAST : PARTICLES_A_THREAD;
    return (int)minimum(threads_at_most(asked), 1.0 + floor(members / each));
}

static void start_threads(struct run *run)
{
    const int most =
        run_threads(run->options->threads, simulation_population(&run->simulation).count);
    const bool fixed = run->options->fixed_threads || most == 1;
    run->threads = threads_start(most, clock_seconds(), fixed ? -1.0 : delay_seconds());
    run->simulation.threads = most;
}

/* Threads that wait for a processor keep the others waiting: then fewer are faster. */
static void adapt_threads(struct run *run)
{
    const double now = clock_seconds();
    if (!threads_are_due(&run->threads, now))
        return;
    threads_adapt(&run->threads, now, delay_seconds());
    run->simulation.threads = run->threads.now;
}

/* True at the end of the run as the case sets it. */
static bool at_end(const struct run *run)
{
    int64_t most = run->input->run.max_steps;
    return run->simulation.time >= run->input->run.until ||
           (most > 0 && run->simulation.step >= most);
}

/* True where this call ends, be it before the end. */
static bool at_stop(const struct run *run)
{
    int64_t most = run->options->max_steps;
    return at_end(run) || run->stop_requested ||
           (most > 0 && run->simulation.step - run->first_step >= most);
}

static struct check_moment moment_of(struct run *run)
{
    return (struct check_moment){&run->simulation, &run->population, &run->start,
                                 run->check_memory};
}

static struct error *watch_checks(struct run *run)
{
    const struct check_moment moment = moment_of(run);
    return checks_watch(run->checks, &moment);
}

/* Takes a step, and says which events happened in it. */
static struct error *take_step(struct run *run)
{
    struct simulation *s = &run->simulation;
    const double before = s->time;
    bool known[EVENTS_MAX];
    for (int k = 0; k < s->events; k++)
        known[k] = !isnan(s->event[k].time);
    TRY(run_take_step(run));
    damp_bodies(s, before);
    for (int k = 0; k < s->events; k++)
        if (!known[k] && !isnan(s->event[k].time))
            run_say(run, "%s begins at t = %.6g s", s->event[k].name, s->event[k].time);
    return NULL;
}

/* Takes away the bodies whose time has come. */
static struct error *remove_due(struct run *run)
{
    struct simulation *s = &run->simulation;
    const bool due = remove_bodies(s, run->removed_until);
    run->removed_until = s->time;
    if (!due)
        return NULL;
    TRY(ranks_agree(&run->ranks, simulation_commit(s)));
    run->particles = simulation_members(s);
    run_observe(run);
    return NULL;
}

static struct error *loop(struct run *run)
{
    const struct check_moment beginning = moment_of(run);
    if (!run->options->resume)
        TRY(checks_start(run->checks, &beginning));
    TRY(run_watch(run, at_end(run)));
    TRY(watch_checks(run));
    TRY(run_agree(run, NULL));
    while (!at_stop(run)) {
        TRY(run_checkpoint_before_end(run));
        TRY(remove_due(run));
        TRY(take_step(run));
        adapt_threads(run);
        run_observe(run);
        TRY(run_watch(run, at_end(run)));
        TRY(watch_checks(run));
        if ((run->checkpoint_is_due || run->checkpoint_is_wanted) && !run->shortened)
            TRY(run_checkpoint(run));
        run_progress(run);
        run_warn_of_length(run);
        TRY(run_check_step(run));
    }
    run->result->finished = at_end(run);
    return NULL;
}

/* The energy that the initial stresses can release: m p^2/(2 rho^2 C^2), the acoustic energy of
 * material that expands to zero pressure, and the elastic energy m S:S/(4 G rho) of its deviator.
 * */
static double released_energy(const struct run *run)
{
    const struct population population = simulation_population(&run->simulation), *p = &population;
    struct exact_sum sum = {0};
    for (int32_t i = 0; i < p->count; i++) {
        if (!population_has(p, i) || population_is_mixed(p, i))
            continue;
        struct point point = {.density = p->density[i], .energy = p->energy[i]};
        if (p->deviator)
            memcpy(&point.deviator, p->deviator[i], sizeof point.deviator);
        point.history[HISTORY_burnt] = 1.0; /* what explosives set free when they burn */
        struct response response =
            any_material_evaluate(&run->simulation.problem->material[p->material[i]], &point);
        exact_sum_add(&sum, 0.5 * p->mass[i] *
                                square(point.pressure / (point.density * response.sound_long)));
        if (response.shear_modulus > 0.0)
            exact_sum_add(&sum, p->mass[i] * sym3_square(point.deviator) /
                                    (4.0 * response.shear_modulus * point.density));
    }
    ranks_sum_exact(&run->ranks, &sum, 1);
    return exact_sum_value(&sum);
}

static struct totals totals_at_start(const struct run *run)
{
    struct totals totals = simulation_totals(&run->simulation);
    totals.released = released_energy(run);
    return totals;
}

/* The state, the solver and the probes, without particles. */
static struct error *make_solver(struct run *run)
{
    TRY(simulation_create(run->input, &run->ranks, threads_at_most(run->options->threads),
                          &run->simulation));
    run->method = run->input->solver.choice->thing;
    run->solver = memory_allocate(run->method->size);
    if (!run->solver)
        return out_of_memory_for("the solver");
    run->judgement = judge_solver(&run->simulation);
    run->warnings = warnings_create(&run->simulation, &run->judgement);
    if (!run->warnings)
        return out_of_memory_for("warnings");
    TRY(probes_create(run->input, &run->probes));
    TRY(findings_refusal(&run->judgement.findings));
    TRY(run_check_start(run));
    return run->method->create(run->solver, &run->simulation, run->input->solver.value);
}

/* The particles, fresh or loaded. */
static struct error *make_particles(struct run *run)
{
    if (!run->options->resume && generate_work(run->input, &run->ranks) > GENERATE_LONG)
        run_say(run, "filling the bodies, which may take minutes");
    TRY(run->options->resume ? run_load(run) : run->method->fill(run->solver, &run->simulation));
    TRY(run_take_start(run));
    if (run->ranks.joined)
        TRY(simulation_distribute(&run->simulation));
    start_threads(run);
    TRY(ranks_agree(&run->ranks, run->method->start(run->solver, &run->simulation)));
    maps_update(&run->simulation, 0.0);
    if (!run->options->resume) {
        run->start = totals_at_start(run);
        warnings_start(run->warnings, &run->simulation);
    }
    run->first_step = run->simulation.step;
    run->particles = simulation_members(&run->simulation);
    run->last_progress_time = run->simulation.time;
    return NULL;
}

/* The pictures that cannot be drawn. */
static struct error *check_pictures(const struct run *run)
{
    const bool fragments = run->input->output.fragments;
    struct column columns[COLUMNS_MAX];
    const struct population shown =
        fragments ? fragments_show(&run->population, NULL, columns) : run->population;
    return pictures_check(&run->simulation, &shown, fragments);
}

static struct error *check_fragments(const struct run *run)
{
    if (!run->input->output.fragments || connected_has_diameters(&run->population))
        return NULL;
    return input_error(run->input, "output", "fragments",
                       "only particles form fragments, not the cells of this solver");
}

static struct error *check_faces(const struct run *run)
{
    const char *wrong = run->input->output.faces ? faces_missing(&run->simulation) : NULL;
    return wrong ? input_error(run->input, "output", "faces", "%s", wrong) : NULL;
}

/* Readies what comes later, probes, checks and pictures: their mistakes are reported now. */
static struct error *look_ahead(struct run *run)
{
    run_observe(run);
    struct error *error = probes_prepare(&run->probes, &run->simulation, &run->population);
    struct probe *kept = run->keeps ? probes_find(&run->probes, run->keeps) : NULL;
    if (kept)
        kept->kept = true;
    error = error_join(error, profiles_prepare(&run->simulation, &run->population, &run->profiles));
    error =
        error_join(error, histograms_prepare(&run->simulation, &run->population, &run->histograms));
    error = error_join(
        error, checks_prepare(&run->simulation, &run->population, &run->probes, &run->checks));
    if (run->checks)
        error = error_join(error, fits_prepare(run->input, run->checks));
    error = error_join(error, check_fragments(run));
    error = error_join(error, check_faces(run));
    error = error_join(error, maps_check(&run->simulation));
    return error_join(error, check_pictures(run));
}

static struct error *begin(struct run *run)
{
    TRY(ranks_agree(&run->ranks, make_solver(run)));
    TRY(ranks_agree(&run->ranks, run_take_records(run)));
    struct error *error = make_particles(run);
    return ranks_agree(&run->ranks, error_join(error, look_ahead(run)));
}

/* Checks and the last files. */
static struct error *conclude(struct run *run)
{
    struct run_result *result = run->result;
    TRY(run_checkpoint_at_end(run));
    TRY(run_draw_pictures(run));
    TRY(ranks_agree(&run->ranks,
                    warnings_conclude(run->warnings, &run->simulation, &result->warnings)));
    if (result->finished) {
        const struct check_moment moment = moment_of(run);
        TRY(checks_evaluate(run->checks, &moment, &result->checks));
        char *path = run_path(run, "checks.csv");
        char *pictures = run_path(run, "pictures");
        struct error *error = NULL;
        if (path && run_writes(run) && result->checks.count)
            error = check_results_write(&result->checks, path);
        error = ranks_agree(&run->ranks, error);
        if (!error && pictures)
            error = checks_draw(run->checks, &run->simulation, &run->population, pictures);
        free(path);
        free(pictures);
        return error;
    }
    return NULL;
}

/* Whether ERROR is known on this rank alone: collective operations would then never end. */
static bool is_local_error(const struct run *run, const struct error *error)
{
    return error && run->ranks.joined && !error_is_known_to_all(error);
}

/* A mistake of the case is left to what follows. */
static struct error *check_memory(const struct run *run)
{
    const struct run_options *options = run->options;
    struct estimate estimate;
    if (options->force || options->resume)
        return NULL;
    struct error *error = estimate_size(run->input, &estimate);
    const bool wrong = error != NULL;
    error_free(error);
    if (ranks_maximum(&run->ranks, wrong) > 0.0) {
        if (!wrong)
            estimate_free(&estimate);
        return NULL;
    }
    const struct forecast forecast = forecast_make(run->input, &estimate, options);
    estimate_free(&estimate);
    return forecast_check_memory(run->input, &forecast, &run->ranks);
}

static struct error *run_through(struct run *run)
{
    TRY(run_check_folder(run));
    TRY(check_memory(run));
    TRY(begin(run));
    TRY(run_open_folder(run));
    run_report_beginning(run);
    run_report_changes(run);
    run->began = run->last_checkpoint = run->last_progress = clock_seconds();
    run->waited_before = delay_seconds();
    run->mark[0] = run->mark[1] =
        (struct progress_mark){run->began, run->simulation.time, run->simulation.step};
    struct error *error = run_summary_begin(run);
    if (!error)
        error = loop(run);
    if (is_local_error(run, error))
        return error;
    run_measure_speed(run);
    if (error && error_kind(error) == ERROR_STATE) {
        error = run_save_failure(run, error);
        error = error_join(error, run_draw_pictures(run));
    }
    if (!error)
        error = conclude(run);
    if (!error) {
        run->result->hash = simulation_hash(&run->simulation);
        run_report_end(run);
    } else
        for (int i = 0; run->log && i < error_count(error); i++)
            run_log_line(run->log, "error: %s", error_message(error, i));
    return error;
}

static void destroy(struct run *run)
{
    checks_free(run->checks);
    warnings_free(run->warnings);
    findings_free(&run->judgement.findings);
    probes_free(&run->probes);
    profiles_free(&run->profiles);
    histograms_free(&run->histograms);
    if (run->solver && run->method)
        run->method->destroy(run->solver);
    free(run->solver);
    simulation_destroy(&run->simulation);
    free(run->snapshot_times);
    free(run->snapshot_hashes);
    free(run->check_memory);
    free(run->case_text);
    case_changes_free(&run->changes);
    results_unlock(&run->lock);
    free(run);
}

static struct run *run_new(const struct simulation_case *input, const struct run_options *options,
                           struct run_result *result)
{
    struct run *run = memory_allocate(sizeof *run);
    memset(result, 0, sizeof *result);
    if (!run)
        return NULL;
    run->check_memory =
        memory_allocate(((size_t)input->checks.count + 1) * sizeof *run->check_memory);
    if (!run->check_memory) {
        free(run);
        return NULL;
    }
    run->input = input;
    run->options = options;
    run->result = result;
    run->ranks = options->ranks ? *options->ranks : ranks_alone();
    run->history_step = run->checkpoint_step = -1;
    run->sound = true;
    run->removed_until = -INFINITY;
    run->checkpoints_requested = options->checkpoints ? *options->checkpoints : 0;
    return run;
}

struct error *run_case(const struct simulation_case *input, const struct run_options *options,
                       struct run_result *result)
{
    struct run *run = run_new(input, options, result);
    if (!run)
        return out_of_memory();
    struct error *error = run_through(run);
    const bool local = is_local_error(run, error);
    error = run_close_files(run, error);
    if (local && options->alarm)
        options->alarm(&run->ranks, error);
    if (!local)
        error = ranks_agree(&run->ranks, error);
    if (!local && run->began > 0.0)
        error = run_report(run, error);
    destroy(run);
    return error;
}

struct error *run_probe(const struct simulation_case *input, const struct run_options *options,
                        const char *name,
                        struct error *(*take)(const struct probe *probe, void *context),
                        void *context)
{
    struct run_result result;
    struct run *run = run_new(input, options, &result);
    if (!run)
        return out_of_memory();
    run->keeps = name;
    struct error *error = run_through(run);
    if (!error && !result.finished)
        error = error_new(ERROR_STATE, "it was told to stop");
    if (!error)
        error = take(probes_find(&run->probes, name), context);
    error = run_close_files(run, error);
    destroy(run);
    run_result_free(&result);
    return error;
}

struct error *run_prepare_probe(const struct simulation_case *input, const char *name,
                                struct error *(*take)(const struct probe *probe, void *context),
                                void *context)
{
    const struct run_options options = {.threads = 1};
    struct run_result result;
    struct run *run = run_new(input, &options, &result);
    if (!run)
        return out_of_memory();
    struct error *error = make_solver(run);
    if (!error)
        error = look_ahead(run);
    if (!error && name)
        error = take(probes_find(&run->probes, name), context);
    if (!error && !name && run_is_filled_in_check(input))
        error = run->method->fill(run->solver, &run->simulation);
    destroy(run);
    return error;
}

struct error *run_validate(const struct simulation_case *input)
{
    return run_prepare_probe(input, NULL, NULL, NULL);
}

void run_result_free(struct run_result *result)
{
    check_results_free(&result->checks);
    warning_results_free(&result->warnings);
}
