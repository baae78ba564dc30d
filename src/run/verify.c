/* Verification of cases; see verify.h. */
#include "run/verify.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "output/file.h"

/* "riemann/gas" of ".../riemann/gas/case.yaml"; the path itself where it has no such folders. */
static char *short_name(const char *path)
{
    const char *end = path + strlen(path);
    if (end - path > 10 && !strcmp(end - 10, "/case.yaml"))
        end -= 10;
    const char *start = end;
    for (int slashes = 0; start > path; start--)
        if (start[-1] == '/' && ++slashes == 2)
            break;
    return text_copy_part(start, (size_t)(end - start));
}

static struct error *run_one(const char *path, const struct verify_options *options,
                             struct verify_case *verified)
{
    struct simulation_case *input;
    TRY(case_read(path, &options->reading, options->catalogue, &input));
    char *folder = options->output ? path_join(options->output, verified->name) : NULL;
    struct listener quiet = {0};
    if (options->listener)
        quiet = (struct listener){NULL, options->listener->progress, options->listener->context};
    struct run_options running = {
        .output = folder,
        .overwrite = true,
        .threads = options->threads,
        .stop = options->stop,
        .listener = &quiet,
        .progress = options->progress,
    };
    struct error *error = run_case(input, &running, &verified->result);
    verified->passed = !error && verified->result.finished && !verified->result.checks.failed;
    if (!error && !verified->result.finished)
        error = error_new(ERROR_SYSTEM, "stopped before its end");
    free(folder);
    case_free(input);
    return error;
}

static bool told_to_stop(const struct verify_options *options)
{
    return options->stop && *options->stop;
}

/* What the results come to as one error. */
static struct error *sum_up(struct verify_result *result)
{
    struct error *error = NULL;
    for (int i = 0; i < result->count; i++) {
        const struct verify_case *verified = &result->item[i];
        result->passed += verified->passed;
        result->checks += verified->result.checks.count;
        result->checks_passed += verified->result.checks.count - verified->result.checks.failed;
        for (int k = 0; verified->error && k < error_count(verified->error); k++)
            error = error_join(error, error_new(error_kind(verified->error), "%s: %s",
                                                verified->name, error_message(verified->error, k)));
        if (!verified->error && verified->result.checks.failed)
            error = error_join(error, error_new(ERROR_CHECK, "%s: %d of %d checks failed",
                                                verified->name, verified->result.checks.failed,
                                                verified->result.checks.count));
    }
    return error;
}

struct error *verify_cases(const char *const *paths, int count,
                           const struct verify_options *options, struct verify_result *result)
{
    *result = (struct verify_result){0};
    result->item = memory_allocate(((size_t)count + 1) * sizeof *result->item);
    if (!result->item)
        return error_new(ERROR_SYSTEM, "out of memory");
    for (int i = 0; i < count && !told_to_stop(options); i++) {
        struct verify_case *verified = &result->item[result->count++];
        verified->name = short_name(paths[i]);
        verified->error = verified->name ? run_one(paths[i], options, verified)
                                         : error_new(ERROR_SYSTEM, "out of memory");
        if (options->ended)
            options->ended(options->context, verified);
    }
    return sum_up(result);
}

void verify_result_free(struct verify_result *result)
{
    for (int i = 0; i < result->count; i++) {
        free(result->item[i].name);
        error_free(result->item[i].error);
        run_result_free(&result->item[i].result);
    }
    free(result->item);
    *result = (struct verify_result){0};
}
