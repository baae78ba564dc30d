/* Cases of particles that begin where another run has ended, `start: {from: FOLDER}`: what of the
 * case must be as it was there, and the particles of its checkpoint. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "case/internal.h"
#include "model/loaded.h"
#include "model/particles/carry.h"
#include "run/run_internal.h"

bool run_starts_from_folder(const struct run *run)
{
    const struct solver_class *method = run->input->solver.choice->thing;
    return run->input->start.input && method->removes;
}

static bool is_listed(const struct name_list *list, const char *name)
{
    for (int i = 0; i < list->count; i++)
        if (!strcmp(list->names[i], name))
            return true;
    return false;
}

/* INPUT as run, in fresh memory. */
static struct error *text_of(const struct simulation_case *input, char **text)
{
    size_t size;
    *text = NULL;
    FILE *file = open_memstream(text, &size);
    if (!file)
        return out_of_memory();
    struct error *error = case_write(input, file);
    return fclose(file) && !error ? out_of_memory() : error;
}

/* Whether another case may have CHANGE though a resumed run may not: entries that come or go, and
 * what begins anew. */
static bool may_differ(const struct case_change *change)
{
    static const char *const anew[] = {"start", "output", "probes", "loads", NULL};
    static const char *const entries[] = {"bodies.", "materials.", NULL};
    for (int k = 0; anew[k]; k++) {
        const size_t length = strlen(anew[k]);
        if (!strncmp(change->key, anew[k], length) &&
            (!change->key[length] || change->key[length] == '.'))
            return true;
    }
    for (int k = 0; entries[k]; k++) {
        const size_t length = strlen(entries[k]);
        if (!strncmp(change->key, entries[k], length) && !strchr(change->key + length, '.') &&
            (!*change->before || !*change->after))
            return true;
    }
    return change->class != CHANGE_NEVER;
}

static struct error *check_keys(const struct run *run)
{
    struct case_changes changes = {0};
    char *before = NULL, *after = NULL;
    struct error *error = text_of(run->input->start.input, &before);
    if (!error)
        error = text_of(run->input, &after);
    if (!error)
        error = case_compare(before, after, case_table, run->input->catalogue, &changes);
    for (int i = 0; i < changes.count && !error_is_full(error); i++) {
        const struct case_change *change = &changes.item[i];
        if (!may_differ(change))
            error = error_join(
                error, document_error(run->input->document, change->key,
                                      "%.60s in the case that `start` names, %.60s here: what "
                                      "continues from its state keeps this key",
                                      *change->before ? change->before : "nothing",
                                      *change->after ? change->after : "nothing"));
    }
    case_changes_free(&changes);
    free(before);
    free(after);
    return error;
}

static struct error *check_bodies(const struct run *run)
{
    const struct simulation_case *input = run->input, *before = input->start.input;
    const struct name_list *without = &input->start.without;
    struct error *error = NULL;
    for (int b = 0; b < before->bodies.count; b++) {
        const char *name = before->bodies.names[b];
        const bool here = case_find_body(input, name) >= 0, left = is_listed(without, name);
        if (here == left)
            error = error_join(
                error, input_error(input, "start", here ? "without" : NULL,
                                   here ? "the case has the body \"%s\": leave it out of one"
                                        : "the body \"%s\" of that run is missing here: name it "
                                          "in `without` to leave it out",
                                   name));
    }
    for (int i = 0; i < without->count; i++)
        if (case_find_body(before, without->names[i]) < 0)
            error =
                error_join(error, input_error(input, "start", "without",
                                              "that run has no body \"%s\"", without->names[i]));
    return error;
}

struct error *run_check_start(const struct run *run)
{
    if (!run_starts_from_folder(run))
        return NULL;
    const struct start_input *start = &run->input->start;
    const char *own = run->input->solver.choice->name, *other = start->input->solver.choice->name;
    if (strcmp(own, other) != 0)
        return input_error(run->input, "start", NULL,
                           "that case is of the solver %s: with %s the bodies of a run of the same "
                           "solver continue; only the solver gas begins with a blast",
                           other, own);
    if (start->center.count || start->window || start->axis >= 0 || start->material)
        return input_error(run->input, "start", NULL,
                           "`center`, `axis`, `window` and `material` are of a blast, with which "
                           "the solver gas begins: leave them out");
    return error_join(check_bodies(run), check_keys(run));
}

/* The checkpoint beside the case that `start` names, or in the folder that it names. */
static char *checkpoint_path(const char *from)
{
    static const char file[] = "/case.yaml";
    const size_t length = strlen(from), end = strlen(file);
    const bool is_file = length > end && !strcmp(from + length - end, file);
    return text_format("%.*s/checkpoint.h5", (int)(is_file ? length - end : length), from);
}

static bool is_at(double time, double other) { return fabs(time - other) <= 1e-9 * other; }

/* TIME is that of the checkpoint, LARGEST the longest step of that run. */
static struct error *check_time(const struct run *run, double time, double largest)
{
    const struct simulation_case *input = run->input;
    const double at = input->start.at, end = input->start.input->run.until;
    const bool ended = end - time <= RUN_STEPS_BEFORE_END * largest;
    if (!isnan(at) && !is_at(at, time) && !(ended && is_at(at, end)))
        return input_error(input, "start", "at",
                           "the checkpoint of that run is at t = %.9g s; leave `at` out to begin "
                           "there, or end that run at this time (run.until) first",
                           time);
    if (!(input->run.until > time))
        return input_error(input, "run", "until",
                           "the run that `start` names is at t = %.9g s already: the time goes on "
                           "from there",
                           time);
    return NULL;
}

/* Takes the particles of BEFORE, and what else its SOLVER keeps. */
static struct error *take_particles(struct run *run, const struct simulation *before,
                                    const void *solver)
{
    const struct simulation_case *from = run->input->start.input;
    int *body =
        memory_allocate((size_t)(from->bodies.count + from->materials.count) * sizeof *body);
    if (!body)
        return out_of_memory();
    int *material = body + from->bodies.count;
    for (int b = 0; b < from->bodies.count; b++)
        body[b] = case_find_body(run->input, from->bodies.names[b]);
    for (int m = 0; m < from->materials.count; m++)
        material[m] =
            (int)maximum(0.0, named_map_find(&run->input->materials, from->materials.names[m]));
    struct error *error = carry_particles(&run->simulation, before, body, material);
    if (!error && run->method->carry)
        run->method->carry(run->solver, solver, body);
    free(body);
    return error;
}

static struct error *visit_largest_step(void *context, struct visitor *visitor)
{
    return visitor->visit(visitor, "run/largest_step", NUMBER_DOUBLE, context, 1, 1);
}

/* Reads the checkpoint of the run that `start` names as BEFORE with its SOLVER. */
static struct error *read_before(struct run *run, struct simulation *before, void *solver)
{
    const struct simulation_case *from = run->input->start.input;
    TRY(ranks_agree(&run->ranks, run->method->create(solver, before, from->solver.value)));
    char *path = checkpoint_path(run->input->start.from);
    double largest = 0.0;
    const struct checkpoint checkpoint = {.simulation = before,
                                          .method = run->method,
                                          .solver = solver,
                                          .extra = visit_largest_step,
                                          .context = &largest};
    struct error *error = path ? checkpoint_read(path, &checkpoint) : out_of_memory();
    if (!error)
        error =
            ranks_agree(&run->ranks, error_context(simulation_check_loaded(before), "%s", path));
    if (!error)
        error = ranks_agree(&run->ranks, check_time(run, before->time, largest));
    free(path);
    return error_context(error, "start");
}

struct error *run_take_start(struct run *run)
{
    struct simulation before;
    if (!run_starts_from_folder(run) || run->options->resume)
        return NULL;
    TRY(ranks_agree(&run->ranks, simulation_create(run->input->start.input, &run->ranks,
                                                   run->simulation.threads, &before)));
    void *solver = memory_allocate(run->method->size);
    struct error *error = solver ? read_before(run, &before, solver) : out_of_memory();
    if (!error)
        error = take_particles(run, &before, solver);
    if (!error) {
        run->simulation.time = before.time;
        run->simulation.step = before.step;
        interval_is_due(before.time, run_history_interval(run), &run->history_due);
        interval_is_due(before.time, run->input->output.every, &run->snapshots_due);
        probes_catch_up(&run->probes, before.time);
    }
    if (solver)
        run->method->destroy(solver);
    free(solver);
    simulation_destroy(&before);
    return error;
}
