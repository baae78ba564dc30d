/* What a resumed run has otherwise than the one whose checkpoint it loads: whether it may, which
 * numbers of the checkpoint belong to which probe and check, and the record, changes.csv and the
 * cases before. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "case/internal.h"
#include "model/particles/held.h"
#include "run/run_internal.h"

/* Keys of a check that say what it is compared with, and not what is measured. */
static const char *const limits[] = {
    "is",     "within",          "at_most",        "at_least",
    "source", "known_deviation", "recorded_value", "regression_bound",
    NULL};

/* VALUE for a message, of which TEXT takes the first characters. */
static const char *shown(const char *value, char *text, size_t size)
{
    if (!*value)
        return "nothing";
    snprintf(text, size, "\"%s\"", value);
    if (strlen(text) + 1 == size)
        memcpy(text + size - 5, "...\"", 5);
    return text;
}

static bool starts_with(const char *text, const char *start)
{
    return !strncmp(text, start, strlen(start));
}

/* Why a boundary may not change so, though others may; NULL: it may. The order of the store depends
 * on what is periodic and on where the domain ends. */
static const char *boundary_stays(const struct run *run, const struct case_change *change)
{
    const bool entry = !strchr(change->key + strlen("boundaries."), '.');
    const struct solver_class *method = run->input->solver.choice->thing;
    if (strstr(change->before, "periodic") || strstr(change->after, "periodic"))
        return "a resumed run keeps its periodic faces";
    if (entry && !*change->before)
        return "a resumed run gets no new boundary; a case with `start: {from: FOLDER}` may have "
               "one";
    return entry && !method->removes ? "with this solver a resumed run keeps its boundaries; their "
                                       "`kind` and what is outside may change"
                                     : NULL;
}

/* The error of a change that may not be; NULL where it may. */
static struct error *refuse(const struct run *run, const struct case_change *change)
{
    const char *why = NULL;
    char before[64], after[64];
    const bool entry = starts_with(change->key, "loads.") || (starts_with(change->key, "bodies.") &&
                                                              !(*change->before && *change->after));
    if (change->class == CHANGE_NEVER)
        why = starts_with(change->key, "probes.")
                  ? "a probe that has begun keeps its keys; give the new one another name"
              : entry
                  ? "a resumed run cannot change it; another case can, with `start: {from: FOLDER}`"
                  : "a resumed run cannot change it; run the case from the start into another "
                    "folder";
    else if (change->class == CHANGE_FROM_HERE && starts_with(change->key, "boundaries."))
        why = boundary_stays(run, change);
    if (!why && change->class == CHANGE_FROM_HERE && !run->options->change)
        why = "--change lets the run continue with the new value";
    if (!why)
        return NULL;
    return document_error(run->input->document, change->key, "%s until the checkpoint, %s now: %s",
                          shown(change->before, before, sizeof before),
                          shown(change->after, after, sizeof after), why);
}

/* The body whose `remove_at` CHANGE is of; -1: it is of another key. */
static int body_to_remove(const struct run *run, const struct case_change *change)
{
    static const char start[] = "bodies.", end[] = ".remove_at";
    const size_t length = strlen(change->key);
    if (!starts_with(change->key, start) || length <= strlen(start) + strlen(end) ||
        strcmp(change->key + length - strlen(end), end) != 0)
        return -1;
    const char *name = change->key + strlen(start);
    const size_t own = length - strlen(start) - strlen(end);
    for (int b = 0; b < run->input->bodies.count; b++)
        if (strlen(run->input->bodies.names[b]) == own &&
            !strncmp(run->input->bodies.names[b], name, own))
            return b;
    return -1;
}

/* When a body is to go means nothing once it has gone. Collective. */
static struct error *check_removals(struct run *run)
{
    struct error *error = NULL;
    for (int i = 0; i < run->changes.count; i++) {
        struct case_change *change = &run->changes.item[i];
        const int body = body_to_remove(run, change);
        if (body < 0)
            continue;
        const double at = case_body(run->input, body)->remove_at;
        const bool has_gone = body_members(&run->simulation, body) == 0;
        if (has_gone && !(at > run->simulation.time))
            change->class = CHANGE_FREELY;
        error = error_join(error, refuse(run, change));
    }
    return error;
}

struct error *run_find_changes(struct run *run)
{
    char *path = run_path(run, "checkpoint.h5"), *before = NULL;
    if (!path)
        return out_of_memory();
    struct error *error = checkpoint_case(path, &run->ranks, &before);
    if (!error && strcmp(before, run->case_text) != 0) {
        error =
            case_compare(before, run->case_text, case_table, run->input->catalogue, &run->changes);
        error = error_context(error, "%s: its case is damaged", path);
    }
    for (int i = 0; i < run->changes.count; i++)
        if (body_to_remove(run, &run->changes.item[i]) < 0) /* run_check_loaded_changes does that */
            error = error_join(error, refuse(run, &run->changes.item[i]));
    free(before);
    free(path);
    return error;
}

void run_place_probes(struct run *run)
{
    for (int i = 0; i < run->probes.count && run->changes.count; i++)
        run->probes.item[i].stored =
            case_changes_place(&run->changes, "probes", run->probes.item[i].name);
}

int run_stored_probes(const struct run *run)
{
    return run->changes.count ? case_changes_entries(&run->changes, "probes") : run->probes.count;
}

/* What the check at INDEX remembers, of all those of the checkpoint, BEFORE. */
static struct check_memory memory_of(const struct run *run, int index,
                                     const struct check_memory *before)
{
    const char *name = run->input->checks.names[index];
    const int place = case_changes_place(&run->changes, "checks", name);
    if (place >= 0 && !case_changes_in(&run->changes, "checks", name, limits))
        return before[place];
    struct check_memory fresh = {NAN, NAN, NAN, NOTHING_SAID};
    if (run->simulation.time > case_check(run->input, index)->at) {
        fresh.time = run->simulation.time;
        fresh.why = NOTHING_ADDED_LATE;
    }
    return fresh;
}

struct error *run_visit_checks(struct run *run, struct visitor *visitor)
{
    const bool loads = visitor->most && run->changes.count;
    const int count =
        loads ? case_changes_entries(&run->changes, "checks") : run->input->checks.count;
    struct check_memory *memory =
        loads ? memory_allocate(((size_t)count + 1) * sizeof *memory) : run->check_memory;
    if (!memory)
        return out_of_memory();
    struct error *error = count ? visitor->visit(visitor, "run/checks", NUMBER_DOUBLE, memory,
                                                 count, CHECK_MEMORY_NUMBERS)
                                : NULL;
    if (!loads)
        return error;
    for (int i = 0; i < run->input->checks.count && !error; i++)
        run->check_memory[i] = memory_of(run, i, memory);
    free(memory);
    return error;
}

/* The end of the run, where it has changed: nothing can end before the checkpoint, and no run can
 * continue from a step that was shortened to end elsewhere. */
static struct error *check_end(const struct run *run)
{
    const double time = run->simulation.time;
    for (int i = 0; i < run->changes.count; i++) {
        if (strcmp(run->changes.item[i].key, "run.until") != 0)
            continue;
        if (!(run->input->run.until > time))
            return document_error(run->input->document, "run.until",
                                  "the checkpoint is at t = %.9g s already", time);
        if (run->resumes.past_end)
            return document_error(run->input->document, "run.until",
                                  "the run cannot be extended: its checkpoint is of a step that "
                                  "was shortened to end at the earlier time; run the case from the "
                                  "start");
    }
    return NULL;
}

struct error *run_check_loaded_changes(struct run *run)
{
    struct error *error = check_removals(run);
    return error_join(error, check_end(run));
}

struct error *run_follow_changes(struct run *run)
{
    enum { MOST = 1000000 }; /* resumes that a damaged file may claim */
    if (run->resumes.changed < 0 || run->resumes.changed > MOST || run->resumes.segment < 0 ||
        run->resumes.segment > run->resumes.changed)
        return error_new(ERROR_SYSTEM, "run/resumes is not what a run counts");
    run->simulation.segment = run->resumes.segment;
    if (!run->changes.count)
        return NULL;
    bool from_here = false;
    for (int i = 0; i < run->changes.count; i++)
        from_here = from_here || run->changes.item[i].class == CHANGE_FROM_HERE;
    run->resumes.changed++;
    run->resumes.segment += from_here;
    run->simulation.segment = run->resumes.segment;
    const double time = run->simulation.time;
    run->history_due = run->snapshots_due = 0;
    interval_is_due(time, run_history_interval(run), &run->history_due);
    interval_is_due(time, run->input->output.every, &run->snapshots_due);
    probes_catch_up(&run->probes, time);
    return NULL;
}

/* Keeps the case before as case-N.yaml; a run that was killed before its first checkpoint may have
 * done it already. */
static struct error *keep_case(const struct run *run)
{
    char *from = run_path(run, "case.yaml");
    char *name = text_format("case-%lld.yaml", (long long)run->resumes.changed);
    char *to = name ? run_path(run, name) : NULL, *text = NULL;
    size_t size;
    FILE *file;
    struct error *error = from && to ? NULL : out_of_memory();
    if (!error && !file_is_plain(to)) {
        error = file_read(from, &text, &size);
        if (!error && text) {
            error = file_begin(to, &file);
            if (!error) {
                fwrite(text, 1, size, file);
                error = file_end(to, file);
            }
        }
    }
    free(text);
    free(to);
    free(name);
    free(from);
    return error;
}

static void put_changes(const struct run *run, FILE *file)
{
    for (int i = 0; i < run->changes.count; i++) {
        const struct case_change *change = &run->changes.item[i];
        fprintf(file, "%lld,%lld,", (long long)run->resumes.changed,
                (long long)run->simulation.step);
        csv_put_number(file, run->simulation.time);
        fputc(',', file);
        csv_put_text(file, change->key);
        fputc(',', file);
        csv_put_text(file, change->before);
        fputc(',', file);
        csv_put_text(file, change->after);
        fprintf(file, ",%s\n", case_change_class(change->class));
    }
}

/* The rows of TABLE of resumes before this one. */
static void put_earlier(const struct run *run, const struct csv *table, FILE *file)
{
    for (int64_t row = 0; row < table->rows; row++) {
        if (!(csv_number(table, row, 0) < (double)run->resumes.changed))
            continue;
        for (int k = 0; k < table->columns; k++) {
            fputs(k ? "," : "", file);
            if (k >= 3 && k < 6)
                csv_put_text(file, csv_field(table, row, k));
            else
                fputs(csv_field(table, row, k), file);
        }
        fputc('\n', file);
    }
}

static struct error *write_changes(const struct run *run)
{
    struct csv earlier = {0};
    FILE *file;
    char *path = run_path(run, "changes.csv");
    struct error *error = path ? csv_read(path, &earlier) : out_of_memory();
    if (!error)
        error = file_begin(path, &file);
    if (!error) {
        fputs("resume,step,time [s],key,before,after,class\n", file);
        put_earlier(run, &earlier, file);
        put_changes(run, file);
        error = file_end(path, file);
    }
    csv_free(&earlier);
    free(path);
    return error;
}

struct error *run_record_changes(struct run *run)
{
    if (!run->changes.count)
        return NULL;
    TRY(keep_case(run));
    return write_changes(run);
}

void run_report_changes(struct run *run)
{
    char before[64], after[64];
    for (int i = 0; i < run->changes.count; i++) {
        const struct case_change *change = &run->changes.item[i];
        run_say(run, "changed at step %lld, t = %.9g s: %s: %s until then, %s now",
                (long long)run->simulation.step, run->simulation.time, change->key,
                shown(change->before, before, sizeof before),
                shown(change->after, after, sizeof after));
    }
}
