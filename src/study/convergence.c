/* Convergence studies; see convergence.h. The loop over the runs is verify's. */
#include "study/convergence.h"

#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"

static bool is_among(const struct name_list *list, const char *name)
{
    for (int i = 0; i < list->count; i++)
        if (!strcmp(list->names[i], name))
            return true;
    return false;
}

static const struct order_input *order_of(const struct simulation_case *input, const char *name)
{
    const int index = named_map_find(&input->convergence.order, name);
    return index < 0 ? NULL : case_order(input, index);
}

static bool is_norm(const struct check_input *check)
{
    return ((const struct measure_class *)check->measure.choice->thing)->needs_exact;
}

/* Whether the check at INDEX is studied. */
static bool is_studied(const struct simulation_case *input, int index)
{
    const struct convergence_input *convergence = &input->convergence;
    const char *name = input->checks.names[index];
    const struct check_input *check = case_check(input, index);
    if (is_among(&convergence->of, name) || is_among(&convergence->estimate, name) ||
        order_of(input, name))
        return true;
    return !convergence->of.count && (is_norm(check) || !isnan(check->is.value));
}

static enum study_error kind_of(const struct simulation_case *input, int index)
{
    const struct check_input *check = case_check(input, index);
    if (is_among(&input->convergence.estimate, input->checks.names[index]))
        return STUDY_ESTIMATE;
    if (is_norm(check))
        return STUDY_NORM;
    return isnan(check->is.value) ? STUDY_ESTIMATE : STUDY_DISTANCE;
}

/* What is followed of the check at INDEX, its numbers not yet known. */
static struct error *make_quantity(const struct simulation_case *input, int index, int runs,
                                   struct study_quantity *quantity)
{
    const struct check_input *check = case_check(input, index);
    const struct order_input *order = order_of(input, input->checks.names[index]);
    const size_t size = (size_t)runs * sizeof(double);
    *quantity = (struct study_quantity){
        .name = text_copy(input->checks.names[index]),
        .kind = kind_of(input, index),
        .exact = NAN,
        .measured = memory_allocate(size),
        .error = memory_allocate(size),
        .order = memory_allocate(size),
        .fitted = NAN,
        .extrapolation = {APPROACH_UNKNOWN, NAN, NAN, NAN},
        .low = order && !isnan(order->at_least) ? order->at_least : -INFINITY,
        .high = order && !isnan(order->at_most) ? order->at_most : INFINITY,
        .source = order ? text_copy(order->source) : NULL,
    };
    if (quantity->kind == STUDY_DISTANCE)
        quantity->exact = check->is.value;
    return quantity->name && quantity->measured && quantity->error && quantity->order
               ? NULL
               : out_of_memory_for("a convergence study");
}

static struct error *make_quantities(const struct simulation_case *input, int runs,
                                     struct study *study)
{
    study->quantity = memory_allocate(((size_t)input->checks.count + 1) * sizeof *study->quantity);
    study->run = memory_allocate((size_t)runs * sizeof *study->run);
    study->title = text_copy(input->title ? input->title : input->name);
    study->vary = text_copy(input->convergence.vary);
    if (!study->quantity || !study->run || !study->title || !study->vary)
        return out_of_memory_for("a convergence study");
    for (int i = 0; i < input->checks.count; i++)
        if (is_studied(input, i))
            TRY(make_quantity(input, i, runs, &study->quantity[study->quantities++]));
    if (!study->quantities)
        return document_error(input->document, "checks",
                              "none is an error norm or has `is`: name what is to be studied in "
                              "`convergence.of`");
    for (int k = 0; k < study->quantities && runs < 3; k++)
        if (study->quantity[k].kind == STUDY_ESTIMATE)
            return document_error(
                input->document, "convergence.values",
                "at least three runs are needed: the error of \"%s\" has to be estimated",
                study->quantity[k].name);
    return NULL;
}

static bool same(double a, double b) { return fabs(a - b) <= 1e-9 * fabs(a); }

/* A run of a study must be finer than another in all that it is made of. OTHER is an earlier
 * one. */
static struct error *compare_runs(const struct simulation_case *input,
                                  const struct simulation_case *other)
{
    const char *vary = input->convergence.vary;
    if (same(input->resolution, other->resolution))
        return document_error(input->document, "convergence",
                              "\"%s\" = %s and %s give the same resolution, %.9g m", vary,
                              other->sweep->text, input->sweep->text, input->resolution);
    for (int i = 0; i < input->bodies.count && i < other->bodies.count; i++) {
        char path[512];
        snprintf(path, sizeof path, "bodies.%s.resolution", input->bodies.names[i]);
        if (same(case_body(input, i)->resolution, case_body(other, i)->resolution))
            return document_error(input->document, path,
                                  "a convergence study refines all bodies, but this stays as it "
                                  "is: make it an expression of a name of let, and `vary` that");
    }
    return NULL;
}

/* Reads every run and compares it with the others; options->reading is that of the study. */
static struct error *check_runs(const char *path, const struct verify_options *options, int runs)
{
    struct case_options reading = options->reading;
    struct simulation_case **input = memory_allocate((size_t)runs * sizeof(*input));
    struct error *error = input ? NULL : out_of_memory_for("a convergence study");
    for (int i = 0; i < runs && input; i++) {
        reading.sweep_run = i + 1;
        error = error_join(error, case_read(path, &reading, options->catalogue, &input[i]));
        for (int k = 0; k < i && !error; k++)
            error = compare_runs(input[i], input[k]);
    }
    for (int i = 0; i < runs && input; i++)
        case_free(input[i]);
    free(input);
    return error;
}

/* The coarsest first. */
static int compare_resolutions(const void *a, const void *b)
{
    const struct verify_case *one = a, *other = b;
    return (one->resolution < other->resolution) - (one->resolution > other->resolution);
}

/* Errors and orders of QUANTITY, whose measured values are there. */
static void find_orders(const struct study *study, const double *resolution,
                        struct study_quantity *quantity)
{
    const int runs = study->runs;
    if (runs >= 3 && quantity->kind != STUDY_NORM)
        quantity->extrapolation = extrapolate(resolution + runs - 3, quantity->measured + runs - 3);
    const double wanted = quantity->kind == STUDY_NORM       ? 0.0
                          : quantity->kind == STUDY_DISTANCE ? quantity->exact
                                                             : quantity->extrapolation.limit;
    for (int i = 0; i < runs; i++)
        quantity->error[i] = fabs(quantity->measured[i] - wanted);
    for (int i = 0; i < runs; i++)
        if (quantity->kind == STUDY_ESTIMATE)
            quantity->order[i] =
                i < 2 ? NAN : extrapolate(resolution + i - 2, quantity->measured + i - 2).order;
        else
            quantity->order[i] = i < 1 ? NAN
                                       : order_between(resolution[i - 1], quantity->error[i - 1],
                                                       resolution[i], quantity->error[i]);
    quantity->fitted = quantity->kind == STUDY_ESTIMATE
                           ? quantity->extrapolation.order
                           : order_fitted(resolution, quantity->error, runs);
    for (int i = 0; i < runs; i++)
        if (!isfinite(quantity->measured[i]))
            quantity->fitted = NAN;
}

/* What the computing took, without the outputs. */
static double computing_seconds(const struct run_result *result)
{
    return result->updates ? (double)result->updates / result->updates_per_second : 0.0;
}

/* Fills STUDY with the COUNT runs at ITEM, sorted. */
static struct error *take_runs(const struct verify_case *item, int count, struct study *study)
{
    double *resolution = memory_allocate((size_t)count * sizeof *resolution);
    if (!resolution)
        return out_of_memory_for("a convergence study");
    struct error *error = NULL;
    for (int i = 0; i < count; i++) {
        const char *slash = strrchr(item[i].name, '/');
        resolution[i] = item[i].resolution;
        study->run[i] = (struct study_run){text_copy(slash ? slash + 1 : item[i].name),
                                           item[i].resolution, computing_seconds(&item[i].result),
                                           item[i].result.particles, !item[i].error};
        study->runs++;
        if (!study->run[i].name)
            error = out_of_memory_for("a convergence study");
    }
    for (int k = 0; k < study->quantities; k++) {
        struct study_quantity *quantity = &study->quantity[k];
        for (int i = 0; i < count; i++) {
            const struct check_result *check = verify_find_check(&item[i], quantity->name);
            quantity->measured[i] = check ? check->measured : NAN;
            if (check)
                memcpy(quantity->unit, check->unit, sizeof quantity->unit);
        }
        find_orders(study, resolution, quantity);
    }
    free(resolution);
    return error;
}

static struct error *judge(const struct simulation_case *input, struct study_quantity *quantity)
{
    const struct order_input *order = order_of(input, quantity->name);
    if (!order)
        return NULL;
    const bool finite = isfinite(quantity->fitted);
    const bool within =
        finite && quantity->fitted >= quantity->low && quantity->fitted <= quantity->high;
    const bool expected = order->known_deviation && finite;
    struct check_result result = {.verdict =
                                      within ? (expected ? CHECK_PASSES_NOW : CHECK_PASSED)
                                             : (expected ? CHECK_KNOWN_DEVIATION : CHECK_FAILED)};
    char nothing[] = "no order follows from what the runs measured";
    if (result.verdict == CHECK_KNOWN_DEVIATION)
        result.known_deviation = order->known_deviation;
    if (!finite)
        result.nothing = nothing;
    quantity->verdict = check_failed(&result)            ? STUDY_FAILED
                        : result.verdict == CHECK_PASSED ? STUDY_PASSED
                                                         : STUDY_KNOWN_DEVIATION;
    quantity->verdict_text = check_verdict_text(&result);
    return quantity->verdict_text ? NULL : out_of_memory_for("a convergence study");
}

/* Judges all orders; ERROR_CHECK when some fail. */
static struct error *judge_all(const struct simulation_case *input, const char *name,
                               struct study *study)
{
    int judged = 0, failed = 0;
    for (int k = 0; k < study->quantities; k++) {
        TRY(judge(input, &study->quantity[k]));
        judged += study->quantity[k].verdict != STUDY_NOT_JUDGED;
        failed += study->quantity[k].verdict == STUDY_FAILED;
    }
    return failed ? error_new(ERROR_CHECK, "%s: %d of %d orders failed", name, failed, judged)
                  : NULL;
}

/* Runs the study of INPUT. */
static struct error *run_study(const struct simulation_case *input, const char *path,
                               const char *name, const char *folder,
                               const struct verify_options *options, struct study *study)
{
    const int runs = input->sweep_runs;
    TRY(make_quantities(input, runs, study));
    TRY(run_validate(input));
    TRY(check_runs(path, options, runs));
    struct verify_result result = {0};
    char *inside = folder ? path_join(folder, "convergence") : NULL;
    struct error *error = inside || !folder ? verify_case(path, name, inside, options, &result)
                                            : out_of_memory_for("a convergence study");
    const bool whole =
        runs > 0 && result.count == runs && !(options->running.stop && *options->running.stop);
    if (whole) {
        qsort(result.item, (size_t)result.count, sizeof *result.item, compare_resolutions);
        struct error *wrong = take_runs(result.item, result.count, study);
        if (!wrong)
            wrong = judge_all(input, name, study);
        error = error_join(error, wrong);
    }
    verify_result_free(&result);
    free(inside);
    return error;
}

struct error *convergence_run(const char *path, const char *name, const char *folder,
                              const struct verify_options *options, struct study *study)
{
    struct verify_options studying = *options;
    studying.reading.convergence = true;
    *study = (struct study){0};
    struct simulation_case *input;
    TRY(case_read(path, &studying.reading, options->catalogue, &input));
    struct error *error = run_study(input, path, name, folder, &studying, study);
    case_free(input);
    return error;
}
