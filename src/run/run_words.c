/* What a run says when it begins, on its way and when it ends: size, threads, progress, speed,
 * verdicts, warnings. */
#include <stdio.h>
#include <stdlib.h>

#include "base/clock.h"
#include "base/delay.h"
#include "run/estimate.h"
#include "run/rates.h"
#include "run/run_internal.h"

static void say_finding(void *run, const char *text) { run_say(run, "%s", text); }

void run_report_beginning(struct run *run)
{
    const struct simulation *s = &run->simulation;
    const int threads = (int)ranks_maximum(&run->ranks, s->threads);
    char until[48], workers[64] = "";
    if (run->ranks.size > 1)
        snprintf(workers, sizeof workers, "%d ranks, each ", run->ranks.size);
    readable(run->input->run.until, "s", until, sizeof until);
    run_say(run, "%s: %s", run->input->name ? run->input->name : "case",
            run->input->title ? run->input->title : "");
    const struct population population = simulation_population(s);
    run_say(run, "%lld %s, %d-D, %s, until %s, %s%d thread%s%s", (long long)simulation_members(s),
            population_members(&population), s->problem->dimension, run->input->solver.choice->name,
            until, workers, threads, threads == 1 ? "" : "s",
            run->options->resume ? ", resumed" : "");
    judge_bodies(&run->judgement);
    judge_tell(&run->judgement.findings, say_finding, run);
    if (run->options->resume)
        run_say(run, "resumed at step %lld, t = %.9g s", (long long)s->step, s->time);
}

/* Seconds to the end of the run at its present pace, outputs included: that of the last tenth of
 * what it has taken, since steps get shorter and members more. */
static double seconds_left(struct run *run, double now)
{
    const struct simulation *s = &run->simulation;
    const struct progress_mark *since = &run->mark[0];
    const double most = (double)run->input->run.max_steps, taken = now - since->clock;
    double left = taken * (run->input->run.until - s->time) / (s->time - since->time);
    if (most > 0.0 && s->step > since->step)
        left = minimum(left, taken * (most - (double)s->step) / (double)(s->step - since->step));
    if (now - run->mark[1].clock > maximum(1.0, 0.1 * (now - run->began))) {
        run->mark[0] = run->mark[1];
        run->mark[1] = (struct progress_mark){now, s->time, s->step};
    }
    return left;
}

void run_progress(struct run *run)
{
    const struct listener *listener = run->options->listener;
    if (!listener || !listener->progress)
        return;
    double now = clock_seconds(), time = run->simulation.time, until = run->input->run.until;
    const struct progress_pace *pace = &run->options->progress;
    double silent = now - run->last_progress;
    double longest = minimum(maximum(pace->silence, 0.05 * (now - run->began)), 600.0);
    if (silent < pace->seconds ||
        (silent < longest && time - run->last_progress_time < pace->fraction * until))
        return;
    run->last_progress = now;
    run->last_progress_time = time;
    double elapsed = now - run->began;
    char text[256];
    progress_text(&run->simulation, &run->limit,
                  (double)run->result->updates / maximum(elapsed - run->watching, 1e-9),
                  seconds_left(run, now), text, sizeof text);
    listener->progress(listener->context, text);
}

/* Steps of less say little about those of another run, s. */
static const double WORTH_A_RATE = 0.5;

static bool run_writes_rates(const struct run *run)
{
    return run->options->rates && run->ranks.rank == 0;
}

void run_measure_speed(struct run *run)
{
    struct run_result *result = run->result;
    const struct simulation *s = &run->simulation;
    result->steps = s->step;
    result->time = s->time;
    result->particles = simulation_members(s);
    result->seconds = clock_seconds() - run->began;
    double stepping = maximum(result->seconds - run->watching, 1e-9);
    result->updates_per_second = result->updates > 0 ? (double)result->updates / stepping : 0.0;
    result->step = run->step;
    result->threads = run->threads.most;
    const double waited = run->waited_before < 0.0 ? 0.0 : delay_seconds() - run->waited_before;
    const double share =
        maximum(waited, 0.0) / (run->threads.most * maximum(result->seconds, 1e-9));
    const double undisturbed = stepping * maximum(1.0 - share, 0.01);
    result->undisturbed_rate = (double)result->updates / undisturbed;
    if (run_writes_rates(run) && undisturbed > WORTH_A_RATE)
        rates_store(run->options->rates, run->input, run->ranks.size * run->threads.most,
                    result->undisturbed_rate);
}

/* For the log alone: it is no concern of the results. */
static void report_threads(const struct run *run)
{
    const double mean = threads_mean(&run->threads, clock_seconds());
    if (run->log && mean < 0.95 * run->threads.most)
        run_log_line(run->log, "%.1f of %d threads on average: others kept the processors busy",
                     mean, run->threads.most);
}

/* No verdict stands alone over what the models do not cover. */
static void report_warnings(struct run *run)
{
    const struct warning_results *warnings = &run->result->warnings;
    for (int i = 0; i < warnings->count; i++) {
        const struct warning *warning = &warnings->item[i];
        if (warning->expected)
            run_say(run, "  expected warning: %s: %s", warning->name, warning->expected);
        else
            run_say(run, "  warning: %s", warning->text);
    }
}

void run_report_end(struct run *run)
{
    const struct run_result *result = run->result;
    const struct simulation *s = &run->simulation;
    const struct population population = simulation_population(s);
    run_say(run,
            "%s at step %lld, t = %.9g s, after %.1f s; %.3g M updates/s of %s; energy drift %.2g",
            result->finished ? "finished" : "stopped", (long long)result->steps, result->time,
            result->seconds, 1e-6 * result->updates_per_second, population_members(&population),
            result->energy_drift);
    for (int i = 0; i < s->phases; i++)
        run_say(run, "  %-18s %8.2f s  %4.1f %%", s->phase[i].name, s->phase[i].seconds,
                100.0 * s->phase[i].seconds / maximum(result->seconds, 1e-9));
    report_threads(run);
    for (int i = 0; i < result->checks.count; i++) {
        char measured[96], allowed[96];
        const struct check_result *check = &result->checks.item[i];
        check_measured_text(check, measured, sizeof measured);
        check_allowed_text(check, allowed, sizeof allowed);
        if (check->verdict == CHECK_MEASURED_ONLY) {
            run_say(run, "  measured only: %s: %s%s%s", check->name, measured,
                    check->nothing ? ": " : "", check->nothing ? check->nothing : "");
            continue;
        }
        run_say(run, "  check %s: %s: %s (%s)%s%s", check_verdict_name(check->verdict), check->name,
                measured, allowed, check->known_deviation || check->nothing ? ": " : "",
                check->known_deviation               ? check->known_deviation
                : check->nothing                     ? check->nothing
                : check->verdict == CHECK_PASSES_NOW ? "; passes now: remove `known_deviation`"
                : check->regression_bound            ? "; regression bound"
                                                     : "");
    }
    run_report_loads(run);
    report_warnings(run);
}
