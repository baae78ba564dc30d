/* bolide view: one page that shows the particles of a run from any side. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "cli/cli.h"
#include "page/view.h"

/* "20MB": bytes. */
static struct error *read_limit(const char *text, int64_t *limit)
{
    char *end;
    const double number = text ? strtod(text, &end) : VIEW_BYTES;
    const double factor = !text || !strcmp(end, "")                 ? 1.0
                          : !strcmp(end, "MB") || !strcmp(end, "M") ? 1e6
                          : !strcmp(end, "kB") || !strcmp(end, "k") ? 1e3
                                                                    : (double)NAN;
    if (!(number * factor >= 1e5) || !(number * factor < 1e10))
        return error_new(ERROR_INPUT, "--limit: \"%s\" is not a size, such as 20MB", text);
    *limit = (int64_t)(number * factor);
    return NULL;
}

/* The names in TEXT, "speed,damage", which are cut apart in place. */
static int split_names(char *text, const char **names, int most)
{
    int count = 0;
    char *rest;
    for (char *at = strtok_r(text, ", ", &rest); at && count < most;
         at = strtok_r(NULL, ", ", &rest))
        names[count++] = at;
    return count;
}

static struct error *view_folder(const struct cli_options *options, const char *folder)
{
    enum { FIELDS = 16 };
    struct simulation_case *input = NULL;
    const char *names[FIELDS];
    char *written = path_join(folder, "case.yaml"),
         *fields = text_copy(options->fields ? options->fields : ""),
         *path = options->output ? text_copy(options->output) : path_join(folder, "view.html");
    struct view_request request = {
        .folder = folder, .path = path, .fields = names, .frames = (int)options->frames};
    struct view_result result;
    struct error *error =
        path && written && fields ? read_limit(options->limit, &request.limit) : out_of_memory();
    if (!error)
        error = read_case(written, options, &input);
    if (!error) {
        request.input = input;
        request.field_count = split_names(fields, names, FIELDS);
        error = view_write(&request, &result);
    }
    if (!error)
        printf("%s: %.1f MB, %lld particles, %d of %d snapshots\n", path,
               1e-6 * (double)result.bytes, (long long)result.particles, result.frames,
               result.of_frames);
    case_free(input);
    free(path);
    free(fields);
    free(written);
    return error;
}

int command_view(const struct cli_options *options)
{
    struct error *error = NULL;
    if (options->names.count > 1 && options->output)
        error = error_new(ERROR_INPUT, "--output is for one folder");
    for (int i = 0; i < options->names.count && !error; i++)
        error = view_folder(options, options->names.text[i]);
    return error ? report_error(error) : EXIT_OK;
}
