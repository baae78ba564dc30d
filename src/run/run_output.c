/* What a run writes while it goes: outputs take the first step at or past their time and only
 * look. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"
#include "measure/fragments.h"
#include "output/faces.h"
#include "output/snapshot.h"
#include "picture/album.h"
#include "run/run_internal.h"

char *run_path(const struct run *run, const char *name)
{
    return run->options->output ? path_join(run->options->output, name) : NULL;
}

bool run_writes(const struct run *run) { return run->options->output && run->ranks.rank == 0; }

void run_say(struct run *run, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = text_vformat(format, arguments);
    va_end(arguments);
    const struct listener *listener = run->options->listener;
    if (text && run->log)
        run_log_line(run->log, "%s", text);
    if (text && listener && listener->line)
        listener->line(listener->context, text);
    free(text);
}

static struct error *make_case_text(struct run *run)
{
    size_t size;
    FILE *memory = open_memstream(&run->case_text, &size);
    if (!memory)
        return out_of_memory();
    struct error *error = case_write(run->input, memory);
    if (fclose(memory) && !error)
        error = out_of_memory();
    return error;
}

static struct error *make_folder(struct run *run, const char *name)
{
    char *path = run_path(run, name);
    struct error *error = path ? folder_make(path) : out_of_memory();
    free(path);
    return error;
}

static struct error *write_case(struct run *run)
{
    FILE *file;
    char *path = run_path(run, "case.yaml");
    struct error *error = path ? file_begin(path, &file) : out_of_memory();
    if (!error) {
        fputs(run->case_text, file);
        error = file_end(path, file);
    }
    free(path);
    return error;
}

/* A run that is resumed must have left a checkpoint. */
static struct error *look_for_checkpoint(struct run *run)
{
    char *path = run_path(run, "checkpoint.h5");
    if (!path)
        return out_of_memory();
    struct error *error = NULL;
    if (access(path, R_OK))
        error = error_new(ERROR_INPUT, "%s: nothing to resume: there is no checkpoint.h5",
                          run->options->output);
    if (!error)
        error = results_check_links(run->options->output);
    free(path);
    return error;
}

/* Where this rank writes, and the folder is there already. */
static struct error *lock_folder(struct run *run)
{
    const bool wanted = run_writes(run) && !run->lock.path;
    struct stat status;
    return wanted && !stat(run->options->output, &status) && S_ISDIR(status.st_mode)
               ? results_lock(run->options->output, &run->lock)
               : NULL;
}

struct error *run_check_folder(struct run *run)
{
    const struct run_options *options = run->options;
    if (!options->output)
        return options->resume ? error_new(ERROR_INPUT, "a run without a folder cannot be resumed")
                               : NULL;
    struct error *error = make_case_text(run);
    if (!error)
        error = lock_folder(run);
    if (!error)
        error = options->resume ? look_for_checkpoint(run)
                                : results_check(options->output, options->overwrite);
    TRY(ranks_agree(&run->ranks, error));
    return options->resume ? ranks_agree(&run->ranks, run_find_changes(run)) : NULL;
}

static struct error *open_log(struct run *run)
{
    char *path = run_path(run, "run.log");
    struct error *error =
        path ? run_log_open(path, run->options->resume, NULL, &run->log) : out_of_memory();
    free(path);
    return error;
}

static struct error *open_history(struct run *run)
{
    char *path = run_path(run, "history.csv");
    int64_t keep = run->options->resume ? run->history_rows : -1;
    struct error *error =
        path ? history_open(run_writes(run) ? path : NULL, keep, &run->history_mark, &run->history)
             : out_of_memory();
    free(path);
    return error;
}

/* The names of the files that the run may write into the folders of its folder, for
 * results_begin. */
struct names {
    char **text;
    int64_t count, room;
    bool failed; /* memory was out */
};

/* Adds NAME, which is taken. */
static void add_name(struct names *names, char *name)
{
    if (!name || !memory_reserve((void **)&names->text, &names->room, names->count + 2,
                                 names->count, sizeof *names->text)) {
        free(name);
        names->failed = true;
        return;
    }
    names->text[names->count++] = name;
    names->text[names->count] = NULL;
}

static void name_files(const struct run *run, struct names *names)
{
    const struct simulation_case *input = run->input;
    add_name(names, text_copy("snapshots/" RESULTS_NUMBER ".vtkhdf"));
    add_name(names, text_copy("snapshots/failed.vtkhdf"));
    static const char *const populations[] = {"particles", "gas", "detonation"};
    for (size_t i = 0; i < COUNT_OF(populations); i++)
        add_name(names, text_format("snapshots/" RESULTS_NUMBER "-%s.vtkhdf", populations[i]));
    for (int i = 0; album_name_of(input, i); i++)
        add_name(names, text_format("pictures/%s-" RESULTS_NUMBER ".png", album_name_of(input, i)));
    for (int i = 0; i < input->checks.count; i++) {
        char *name = checks_picture(run->checks, i);
        if (name)
            add_name(names, text_format("pictures/%s", name));
        free(name);
    }
    for (int i = 0; i < input->probes.count; i++)
        add_name(names, text_format("probes/%s.csv", input->probes.names[i]));
    for (int i = 0; i < input->profiles.count; i++)
        add_name(names,
                 text_format("profiles/%s-" RESULTS_NUMBER ".csv", input->profiles.names[i]));
    for (int i = 0; i < input->output.histograms.count; i++)
        add_name(names, text_format("histograms/%s-" RESULTS_NUMBER ".csv",
                                    input->output.histograms.names[i]));
}

static struct error *begin_results(struct run *run)
{
    const struct run_options *options = run->options;
    struct names names = {0};
    name_files(run, &names);
    const char *const *text = (const char *const *)names.text;
    struct error *error = names.failed ? out_of_memory()
                          : options->resume
                              ? results_add(options->output, text)
                              : results_begin(options->output, options->overwrite, text);
    names_free(names.text, (int)names.count);
    return error;
}

/* "snapshots/NUMBER.vtkhdf" in fresh memory, and whether it is in the folder. */
static char *snapshot_name(const struct run *run, int64_t number, bool *there)
{
    char *name = text_format("snapshots/%06lld.vtkhdf", (long long)number);
    char *path = name ? run_path(run, name) : NULL;
    *there = path && file_is_plain(path);
    if (!path) {
        free(name);
        name = NULL;
    }
    free(path);
    return name;
}

/* The snapshots that are there: somebody may have removed some before a resume. */
static struct error *write_series(struct run *run)
{
    char **names = memory_allocate(((size_t)run->snapshots + 1) * sizeof *names);
    double *times = memory_allocate(((size_t)run->snapshots + 1) * sizeof *times);
    char *path = run_path(run, "snapshots.vtkhdf.series");
    struct error *error = names && times && path ? NULL : out_of_memory();
    int count = 0;
    for (int64_t i = 0; i < run->snapshots && !error; i++) {
        bool there;
        char *name = snapshot_name(run, i, &there);
        error = name ? NULL : out_of_memory();
        if (there) {
            times[count] = run->snapshot_times[i];
            names[count++] = name;
        } else {
            free(name);
        }
    }
    if (!error)
        error = snapshot_series_write(path, count, (const char *const *)names, times);
    names_free(names, count);
    free(times);
    free(path);
    return error;
}

/* Of each snapshot this rank's part of its hash; 0: it is not there. */
static struct error *hash_snapshots(const struct run *run, uint64_t *hash)
{
    struct error *error = NULL;
    for (int64_t i = 0; i < run->snapshots && !error; i++) {
        bool there;
        char *name = snapshot_name(run, i, &there), *path = name ? run_path(run, name) : NULL;
        error =
            path ? file_hash(path, run->ranks.rank, run->ranks.size, &hash[i]) : out_of_memory();
        free(path);
        free(name);
    }
    return error;
}

/* Rank 0 reports which of the snapshots are not there, or have another HASH than they were written
 * with. */
static struct error *report_missed(struct run *run, const uint64_t *hash)
{
    int64_t gone = 0, first = 0, others = 0, first_other = 0;
    for (int64_t i = 0; i < run->snapshots; i++) {
        const uint64_t written = run->snapshot_hashes[i];
        bool there;
        char *name = snapshot_name(run, i, &there);
        if (!name)
            return out_of_memory();
        free(name);
        first = gone ? first : i;
        gone += !there && written;
        first_other = others ? first_other : i;
        others += there && written && hash[i] != written;
    }
    if (others > 0)
        run_say(run,
                "warning: %lld of %lld snapshots are not what the run wrote, damaged or edited, "
                "snapshots/%06lld.vtkhdf first",
                (long long)others, (long long)run->snapshots, (long long)first_other);
    if (gone == 0)
        return NULL;
    run_say(run,
            "warning: %lld of %lld snapshots that were written are gone, snapshots/%06lld.vtkhdf "
            "first: the series lists those that are left",
            (long long)gone, (long long)run->snapshots, (long long)first);
    return write_series(run);
}

/* Collective: reports which of the snapshots that a resumed run has written are gone, or others
 * than it wrote. All ranks read them. */
static struct error *miss_snapshots(struct run *run)
{
    uint64_t *hash = memory_allocate(((size_t)run->snapshots + 1) * sizeof *hash);
    struct error *error =
        ranks_agree(&run->ranks, hash ? hash_snapshots(run, hash) : out_of_memory());
    if (!error)
        ranks_sum_of(&run->ranks, (int64_t *)hash, (int)run->snapshots);
    if (!error && run_writes(run))
        error = report_missed(run, hash);
    free(hash);
    return ranks_agree(&run->ranks, error);
}

/* What rank 0 does before the others may read anything. */
static struct error *ready_folder(struct run *run)
{
    const struct run_options *options = run->options;
    if (!run_writes(run))
        return NULL;
    TRY(folder_make(options->output));
    TRY(lock_folder(run));
    if (!options->resume || run->changes.count)
        TRY(begin_results(run));
    TRY(make_folder(run, "snapshots"));
    TRY(make_folder(run, "pictures"));
    TRY(run_record_changes(run));
    TRY(write_case(run));
    return open_log(run);
}

struct error *run_open_folder(struct run *run)
{
    const struct run_options *options = run->options;
    if (!options->output)
        return NULL;
    TRY(ranks_agree(&run->ranks, ready_folder(run)));
    if (options->resume && run->input->output.snapshots)
        TRY(miss_snapshots(run));
    struct error *error = open_history(run);
    if (!error)
        error = probes_open(&run->probes, options->output, options->resume, run_writes(run));
    return ranks_agree(&run->ranks, error);
}

struct error *run_close_files(struct run *run, struct error *error)
{
    error = error_join(error, probes_close(&run->probes));
    if (run->history)
        error = error_join(error, history_close(run->history));
    if (run->log)
        error = error_join(error, run_log_close(run->log));
    return error;
}

void run_observe(struct run *run)
{
    simulation_see(&run->simulation);
    run->population = run->simulation.seen[0];
}

double run_history_interval(const struct run *run)
{
    double given = run->input->output.history;
    return isnan(given) ? 0.01 * run->input->run.until : given;
}

/* Writes POPULATION into snapshots/NUMBER and what SUFFIX adds to the name; HASH as
 * snapshot_write's. */
static struct error *write_file(struct run *run, const struct population *population,
                                int64_t number, const char *suffix, uint64_t *hash)
{
    char *name = text_format("snapshots/%06lld%s.vtkhdf", (long long)number, suffix);
    char *path = name ? run_path(run, name) : NULL;
    struct error *error =
        ranks_agree(&run->ranks, path ? file_check_folder(path) : out_of_memory());
    if (!error)
        error = snapshot_write(path, &run->simulation, population, hash);
    free(name);
    free(path);
    return error;
}

/* The others of a coupled run, for its pictures. */
static struct error *write_others(struct run *run, int64_t number)
{
    const struct population *shown[POPULATIONS_MAX];
    const int count = simulation_shown(&run->simulation, &run->population, shown);
    struct error *error = NULL;
    for (int k = 1; k < count && !error; k++) {
        char suffix[40];
        snprintf(suffix, sizeof suffix, "-%s", shown[k]->name);
        error = write_file(run, shown[k], number, suffix, NULL);
    }
    return error;
}

/* The profiles and files of snapshot NUMBER, with the fields of POPULATION. */
static struct error *write_population(struct run *run, const struct population *population,
                                      int64_t number)
{
    TRY(profiles_write(&run->profiles, &run->simulation, &run->population, run->options->output,
                       number));
    TRY(histograms_write(&run->histograms, &run->simulation, &run->population, run->options->output,
                         number));
    const bool kept = run->input->output.snapshots;
    if (!kept && !album_name_of(run->input, 0))
        return NULL;
    struct error *error = write_file(run, population, number, "", &run->snapshot_hashes[number]);
    if (!error)
        error = write_others(run, number);
    if (!error && run_writes(run) && kept)
        error = write_series(run);
    return ranks_agree(&run->ranks, error);
}

/* fragments.csv of this moment, which replaces an earlier one. */
static struct error *write_fragments(const struct run *run, const struct fragments *fragments)
{
    if (!run_writes(run))
        return NULL;
    char *path = run_path(run, "fragments.csv");
    struct error *error =
        path ? fragments_write(path, &run->simulation, fragments) : out_of_memory();
    free(path);
    return error;
}

/* The same as write_population with the column of fragments, and the table of these. */
static struct error *write_with_fragments(struct run *run, int64_t number)
{
    struct fragments fragments;
    struct column columns[COLUMNS_MAX];
    struct error *error = fragments_find(&run->ranks, &run->population, -1,
                                         run->input->output.fragment_link, &fragments);
    if (!error)
        error = ranks_agree(&run->ranks, write_fragments(run, &fragments));
    if (!error) {
        const struct population shown = fragments_show(&run->population, &fragments, columns);
        error = write_population(run, &shown, number);
    }
    fragments_free(&fragments);
    return error;
}

/* faces.csv of this moment, which replaces an earlier one. */
static struct error *write_faces(const struct run *run)
{
    char *path = run_path(run, "faces.csv");
    struct error *error = ranks_agree(&run->ranks, path ? NULL : out_of_memory());
    if (!error)
        error = faces_write(path, &run->simulation, &run->ranks);
    free(path);
    return error;
}

bool run_reserve_snapshots(struct run *run, int64_t count, int64_t kept)
{
    int64_t room = run->snapshot_room;
    return memory_reserve((void **)&run->snapshot_times, &room, count, kept,
                          sizeof *run->snapshot_times) &&
           memory_reserve((void **)&run->snapshot_hashes, &run->snapshot_room, count, kept,
                          sizeof *run->snapshot_hashes);
}

static struct error *write_snapshot(struct run *run)
{
    int64_t number = run->snapshots;
    if (!run_reserve_snapshots(run, number + 1, number))
        return out_of_memory();
    run->snapshot_hashes[number] = 0;
    run->snapshot_times[run->snapshots++] = run->simulation.time;
    if (!run->options->output)
        return NULL;
    if (run->input->output.faces)
        TRY(write_faces(run));
    return run->input->output.fragments ? write_with_fragments(run, number)
                                        : write_population(run, &run->population, number);
}

/* A resumed run stands where outputs have been taken: the row of this step, the snapshot of this
 * time. Those of a moment whose energy has drifted too far are taken too: it may be resumed with
 * another limit. */
struct error *run_watch(struct run *run, bool last)
{
    double clock = clock_seconds(), time = run->simulation.time;
    const int64_t step = run->simulation.step, n = run->snapshots;
    simulation_start_phase(&run->simulation);
    bool row = interval_is_due(time, run_history_interval(run), &run->history_due) || last;
    bool snapshot =
        interval_is_due(time, run->input->output.every, &run->snapshots_due) || last || n == 0;
    struct totals now = {0};
    if (row)
        now = simulation_totals(&run->simulation);
    struct error *drift = row ? run_watch_physics(run, &now) : NULL, *error = NULL;
    if (!run->sound)
        return ranks_agree(&run->ranks, drift);
    row = row && run->history_step < step;
    snapshot = snapshot && (n == 0 || run->snapshot_times[n - 1] < time);
    if (row && run->history)
        error = history_row(run->history, &run->simulation, run->step, &now, &run->start);
    if (row) {
        run->history_step = step;
        error = ranks_agree(&run->ranks, error);
    }
    if (run->history)
        run->history_rows = history_rows(run->history);
    if (!error)
        error = probes_watch(&run->probes, &run->simulation, &run->population, last);
    if (!error && row)
        error = run_watch_tracers(run);
    if (!error && snapshot)
        error = write_snapshot(run);
    run->watching += clock_seconds() - clock;
    if (row || snapshot)
        simulation_end_phase(&run->simulation, PHASE_SHARED, "output");
    error = error_join(drift, error);
    return row || snapshot || drift ? ranks_agree(&run->ranks, error) : error;
}
