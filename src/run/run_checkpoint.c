/* checkpoint.h5 of a run: when it is due, what the run loop adds to the state, and what is said
 * of it. */
#include <stdlib.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"
#include "model/loaded.h"
#include "output/snapshot.h"
#include "run/run_internal.h"

/* Shows what the run loop keeps beside the state. */
static struct error *visit_extra(void *context, struct visitor *visitor)
{
    struct run *run = context;
    struct {
        const char *name;
        void *data;
        enum number number;
        int64_t count;
    } arrays[] = {
        {"run/history_due", &run->history_due, NUMBER_INT64, 1},
        {"run/snapshots_due", &run->snapshots_due, NUMBER_INT64, 1},
        {"run/history_rows", &run->history_rows, NUMBER_INT64, 1},
        {"run/history_step", &run->history_step, NUMBER_INT64, 1},
        {"run/snapshots", &run->snapshots, NUMBER_INT64, 1},
        {"run/largest_step", &run->largest_step, NUMBER_DOUBLE, 1},
        {"run/collapsed_steps", &run->collapsed_steps, NUMBER_INT64, 1},
        {"run/resumes", &run->resumes, NUMBER_INT64, 3},
        {"run/start_totals", run->start.entry, NUMBER_DOUBLE, LEDGER_ENTRIES},
        {"run/start_kinetic", &run->start.kinetic, NUMBER_DOUBLE, 1},
        {"run/start_internal", &run->start.internal, NUMBER_DOUBLE, 1},
        {"run/start_momentum_scale", &run->start.momentum_scale, NUMBER_DOUBLE, 1},
        {"run/start_released", &run->start.released, NUMBER_DOUBLE, 1},
    };
    int64_t known = run->snapshots;
    for (size_t i = 0; i < COUNT_OF(arrays); i++)
        TRY(visitor->visit(visitor, arrays[i].name, arrays[i].number, arrays[i].data,
                           arrays[i].count, 1));
    TRY(run_visit_checks(run, visitor));
    TRY(warnings_visit(run->warnings, &run->probes, run_stored_probes(run), visitor));
    TRY(csv_visit_mark(&run->history_mark, "run/history_file", visitor));
    TRY(probes_visit(&run->probes, visitor));
    if (run->snapshots < 1)
        return error_new(ERROR_SYSTEM, "a checkpoint without a first snapshot");
    if (visitor->most && run->snapshots > visitor->most)
        return error_new(ERROR_SYSTEM, "run/snapshots is %lld: a file of this size has 1 to %lld",
                         (long long)run->snapshots, (long long)visitor->most);
    if (!run_reserve_snapshots(run, run->snapshots, minimum(known, run->snapshots)))
        return out_of_memory();
    TRY(visitor->visit(visitor, "run/snapshot_times", NUMBER_DOUBLE, run->snapshot_times,
                       run->snapshots, 1));
    return visitor->visit(visitor, "run/snapshot_hashes", NUMBER_UINT64, run->snapshot_hashes,
                          run->snapshots, 1);
}

static struct checkpoint checkpoint_of(struct run *run)
{
    return (struct checkpoint){&run->simulation, run->method, run->solver,
                               visit_extra,      run,         run->case_text};
}

/* Counts and marks the rows of the tables, which a resumed run goes on after. */
static struct error *mark_tables(struct run *run)
{
    TRY(probes_mark(&run->probes));
    return run->history ? history_mark(run->history, &run->history_mark) : NULL;
}

struct error *run_checkpoint(struct run *run)
{
    if (!run->options->output)
        return NULL;
    TRY(ranks_agree(&run->ranks, mark_tables(run)));
    double begin = run->last_checkpoint = clock_seconds();
    char *path = run_path(run, "checkpoint.h5");
    struct checkpoint checkpoint = checkpoint_of(run);
    struct error *error = path ? checkpoint_write(path, &checkpoint) : out_of_memory();
    free(path);
    run->watching += clock_seconds() - begin;
    TRY(error);
    const bool first = run->checkpoint_step < 0 && run->checkpoint_is_due;
    run->checkpoint_step = run->simulation.step;
    run->checkpoint_time = run->simulation.time;
    if (run->checkpoint_is_wanted || first)
        run_say(run, "checkpoint at step %lld, t = %.9g s%s", (long long)run->checkpoint_step,
                run->checkpoint_time,
                first ? "; if the run is interrupted, --resume continues from the last one" : "");
    run->checkpoint_is_wanted = false;
    return NULL;
}

/* What a kill in the first minutes loses should be a minute. */
static const double FIRST_CHECKPOINT = 60.0;

struct error *run_checkpoint_before_end(struct run *run)
{
    const struct run_input *end = &run->input->run;
    const bool near = end->until - run->simulation.time <= RUN_STEPS_BEFORE_END * run->limit.dt ||
                      (end->max_steps > 0 && run->simulation.step + 1 >= end->max_steps);
    return near && !run->shortened && run->checkpoint_step < run->simulation.step
               ? run_checkpoint(run)
               : NULL;
}

struct error *run_checkpoint_at_end(struct run *run)
{
    if (run->shortened && !run->resumes.past_end)
        return NULL;
    return run->result->finished && run->checkpoint_step + 1 == run->simulation.step &&
                   !run->resumes.past_end
               ? NULL
               : run_checkpoint(run);
}

bool run_checkpoint_is_due(const struct run *run)
{
    const double given = run->input->output.checkpoint;
    const double interval = run->checkpoint_step < 0 ? minimum(given, FIRST_CHECKPOINT) : given;
    return !run->shortened && interval > 0.0 && clock_seconds() - run->last_checkpoint >= interval;
}

/* No more rows than steps; what was measured at the start is finite. */
static struct error *check_extra(const struct run *run)
{
    const int64_t steps = run->simulation.step;
    bool finite = isfinite(run->largest_step) && isfinite(run->start.kinetic) &&
                  isfinite(run->start.internal) && isfinite(run->start.momentum_scale) &&
                  isfinite(run->start.released);
    for (int i = 0; i < LEDGER_ENTRIES; i++)
        finite = finite && isfinite(run->start.entry[i]);
    for (int64_t i = 0; i < run->snapshots; i++)
        finite = finite && isfinite(run->snapshot_times[i]);
    if (!finite)
        return error_new(ERROR_SYSTEM, "a number of the group run is not finite");
    if (run->history_rows < 0 || run->history_rows > steps + 1 || run->history_step > steps ||
        run->history_due < 0 || run->snapshots_due < 0 || run->collapsed_steps < 0)
        return error_new(ERROR_SYSTEM, "a number of the group run does not fit step %lld",
                         (long long)steps);
    TRY(warnings_check_loaded(run->warnings, run->input->bodies.count));
    return probes_check_loaded(&run->probes, steps);
}

struct error *run_load(struct run *run)
{
    char *path = run_path(run, "checkpoint.h5");
    struct checkpoint checkpoint = checkpoint_of(run);
    run_place_probes(run);
    struct error *error = path ? checkpoint_read(path, &checkpoint) : out_of_memory();
    if (!error)
        error = ranks_agree(&run->ranks, run_check_loaded_changes(run));
    if (!error) {
        error = simulation_check_loaded(&run->simulation);
        if (!error)
            error = check_extra(run);
        if (!error)
            error = run_follow_changes(run);
        error = ranks_agree(&run->ranks,
                            error_context(error, "%s: is no checkpoint of this case", path));
    }
    free(path);
    run->checkpoint_step = run->simulation.step;
    run->checkpoint_time = run->simulation.time;
    return error;
}

/* snapshots/failed.vtkhdf: the moment of an impossible state. */
static struct error *snapshot_of_failure(struct run *run)
{
    char *path = run_path(run, "snapshots/failed.vtkhdf");
    struct error *error =
        ranks_agree(&run->ranks, path ? file_check_folder(path) : out_of_memory());
    if (!error) {
        run_observe(run);
        error = snapshot_write(path, &run->simulation, &run->population, NULL);
    }
    free(path);
    return error;
}

/* "; before that the run warned of unlit in tnt, density in tnt", or "": what the models do not
 * cover is where most stops come from. Owned by the caller; NULL where memory is out. */
static char *warned_of(const struct run *run)
{
    struct warning_results warnings;
    char *text = text_copy("");
    struct error *error = warnings_conclude(run->warnings, &run->simulation, &warnings);
    for (int k = 0; !error && k < warnings.count && text; k++) {
        char *longer = text_format("%s%s%s", text, k ? ", " : "; before that the run warned of ",
                                   warnings.item[k].name);
        free(text);
        text = longer;
    }
    if (!error)
        warning_results_free(&warnings);
    error_free(error);
    return text;
}

/* ERROR with what the run had warned of, and what may hold in place of the solver of the case. */
static struct error *with_remedy(const struct run *run, struct error *error)
{
    const char *remedy = run->judgement.instead;
    char *warned = warned_of(run);
    struct error *longer = NULL;
    for (int i = 0; i < error_count(error); i++)
        longer = error_join(longer, error_new(error_kind(error), "%s%s%s%s",
                                              error_message(error, i), warned ? warned : "",
                                              remedy ? "; " : "", remedy ? remedy : ""));
    if (error_is_known_to_all(error))
        longer = error_known_to_all(longer);
    free(warned);
    error_free(error);
    return longer;
}

/* A state in the middle of a step is of no use to a resumed run: then the last checkpoint stays. */
struct error *run_save_failure(struct run *run, struct error *error)
{
    error = with_remedy(run, error);
    if (!run->options->output)
        return error;
    struct error *failure = snapshot_of_failure(run);
    if (!failure && run->sound && run->snapshots > 0)
        failure = run_checkpoint_at_end(run);
    if (run->checkpoint_step >= 0)
        run_say(run, "checkpoint.h5 holds step %lld, t = %.9g s; --resume continues from there",
                (long long)run->checkpoint_step, run->checkpoint_time);
    return error_join(error, failure);
}
