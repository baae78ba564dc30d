/* One step of a run: how long it may be, the solver's advance, what the ranks then agree on, and
 * the stop of a run whose steps have collapsed. */
#include <stdio.h>

#include "base/clock.h"
#include "model/maps.h"
#include "run/run_internal.h"

double step_towards(double limit, double time, double until)
{
    double remains = until - time;
    if (remains <= limit)
        return remains;
    return remains < 2.0 * limit ? 0.5 * remains : limit;
}

/* WHAT is wrong with the step, the particle that limits it, and ADVICE; NULL where that particle
 * is not here. */
static struct error *stop_at_particle(const struct run *run, const char *what, const char *advice)
{
    const struct population population = simulation_population(&run->simulation), *p = &population;
    int32_t i = 0;
    while (i < p->count && p->id[i] != run->limit.id)
        i++;
    if (i == p->count)
        return NULL;
    return error_new(ERROR_STATE,
                     "step %lld, t = %.6g s: %s; it is limited by %s, particle %llu of body \"%s\" "
                     "at (%g, %g, %g) m: density %g kg/m^3, energy %g J/kg, pressure %g Pa, "
                     "velocity (%g, %g, %g) m/s%s",
                     (long long)run->simulation.step + 1, run->simulation.time, what,
                     run->limit.why ? run->limit.why : "an unknown cause",
                     (unsigned long long)p->id[i], run->input->bodies.names[p->body[i]],
                     p->position[i][0], p->position[i][1], p->position[i][2], p->density[i],
                     p->energy[i], p->pressure[i], p->velocity[i][0], p->velocity[i][1],
                     p->velocity[i][2], advice);
}

/* Collective: the error of a run that stops because of its step. */
static struct error *stop_for_step(const struct run *run, const char *what, const char *advice)
{
    TRY(ranks_agree(&run->ranks, stop_at_particle(run, what, advice)));
    return error_known_to_all(
        error_new(ERROR_STATE, "step %lld, t = %.6g s: %s; it is limited by %s%s",
                  (long long)run->simulation.step + 1, run->simulation.time, what,
                  run->limit.why ? run->limit.why : "an unknown cause", advice));
}

static struct error *no_step(const struct run *run)
{
    char what[64];
    snprintf(what, sizeof what, "no step is possible: %g s", run->limit.dt);
    return stop_for_step(run, what, "");
}

/* The number of steps to the end of the run, at the present limit of the method. */
static double steps_remaining(const struct run *run)
{
    const int64_t most = run->input->run.max_steps;
    double steps = (run->input->run.until - run->simulation.time) / run->limit.dt;
    return most > 0 ? minimum(steps, (double)(most - run->simulation.step)) : steps;
}

void run_warn_of_length(struct run *run)
{
    char step[48];
    if (run->simulation.step != run->first_step + 1 || steps_remaining(run) < RUN_STEPS_HOPELESS)
        return;
    readable(run->limit.dt, "s", step, sizeof step);
    run_say(run, "warning: with steps of %s (%s) the run needs %.2g steps", step,
            run->limit.why ? run->limit.why : "unknown", steps_remaining(run));
}

/* A shock or a detonation shortens steps by the ratio of sound speeds and particle sizes, at most
 * some hundred times, and a tiny first step of a run soon grows. A run cannot end in reasonable
 * time if its steps stay below COLLAPSED of the largest one and too many remain. */
static const double COLLAPSED = 1e-6;
enum { COLLAPSED_STEPS = 1000 };

struct error *run_check_step(struct run *run)
{
    run->largest_step = maximum(run->largest_step, run->step);
    bool collapsed =
        run->limit.dt < COLLAPSED * run->largest_step && steps_remaining(run) > RUN_STEPS_HOPELESS;
    run->collapsed_steps = collapsed ? run->collapsed_steps + 1 : 0;
    if (run->collapsed_steps < COLLAPSED_STEPS)
        return NULL;
    char what[160];
    snprintf(
        what, sizeof what,
        "the time step has collapsed to %.3g s, from %.3g s at most, which leaves %.2g steps to "
        "the end of the run",
        run->limit.dt, run->largest_step, steps_remaining(run));
    return stop_for_step(run, what,
                         "; check the material, the speed and the size of that body, and "
                         "`run.until`");
}

/* A step is taken in any case. */
static bool is_out_of_time(const struct run *run)
{
    const double most = run->options->max_seconds;
    return most > 0.0 && run->simulation.step > run->first_step &&
           clock_seconds() - run->began >= most;
}

struct error *run_agree(struct run *run, struct error *error)
{
    const struct run_options *options = run->options;
    const sig_atomic_t wanted = options->checkpoints ? *options->checkpoints : 0;
    enum { CHANGED, STOP, CHECKPOINT, WANTED, SAID };
    double said[SAID] = {[CHANGED] = simulation_changed(&run->simulation),
                         [STOP] = (options->stop && *options->stop) || is_out_of_time(run),
                         [CHECKPOINT] = run_checkpoint_is_due(run),
                         [WANTED] = wanted != run->checkpoints_requested};
    run->checkpoints_requested = wanted;
    TRY(ranks_agree_on(&run->ranks, error, said, SAID));
    run->stop_requested = said[STOP] > 0.0;
    run->checkpoint_is_due = said[CHECKPOINT] > 0.0;
    run->checkpoint_is_wanted = run->checkpoint_is_wanted || said[WANTED] > 0.0;
    if (said[CHANGED] > 0.0) {
        TRY(ranks_agree(&run->ranks, simulation_commit(&run->simulation)));
        run->particles = simulation_members(&run->simulation);
    }
    return NULL;
}

/* Notes whether the end of the run changes this step, DT to AFTER; and where no checkpoint is there
 * of the state before, that the run cannot be extended. */
static void note_end(struct run *run, double dt, double after)
{
    const double time = run->simulation.time, event = run->limit.event;
    const double other = step_towards(run->limit.dt, time, event);
    const double there = other == event - time ? event : time + other;
    if (run->shortened || (dt == other && after == there))
        return;
    run->shortened = true;
    run->resumes.past_end = run->resumes.past_end || run->checkpoint_step < run->simulation.step;
}

struct error *run_take_step(struct run *run)
{
    struct simulation *simulation = &run->simulation;
    run->sound = false;
    simulation_start_phase(simulation);
    TRY(run->method->prepare(run->solver, simulation, &run->limit));
    if (run->input->levels > 1) /* cells divide and merge */
        run->particles = simulation_members(simulation);
    const double event = minimum(run->limit.event, run->input->run.until);
    double dt = step_towards(run->limit.dt, simulation->time, event);
    double after = dt == event - simulation->time ? event : simulation->time + dt;
    if (!(dt > 0.0) || !(after > simulation->time))
        return no_step(run);
    note_end(run, dt, after);
    TRY(run_agree(run, run->method->advance(run->solver, simulation, dt)));
    simulation->time = after;
    simulation->step++;
    maps_update(simulation, dt);
    run->step = dt;
    run->sound = true;
    run->result->updates += run->particles;
    return NULL;
}
