/* bolide view: one page that shows the particles of a run from any side. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "cli/cli.h"
#include "page/view.h"

enum { FRAMES = 40, FRAMES_MOST = 10000 };
static const double LIMIT = 20e6;

/* "20MB": bytes. */
static struct error *read_limit(const char *text, int64_t *limit)
{
    char *end;
    const double number = text ? strtod(text, &end) : LIMIT;
    const double factor = !text || !strcmp(end, "")                 ? 1.0
                          : !strcmp(end, "MB") || !strcmp(end, "M") ? 1e6
                          : !strcmp(end, "kB") || !strcmp(end, "k") ? 1e3
                                                                    : (double)NAN;
    if (!(number * factor >= 1e5) || !(number * factor < 1e10))
        return error_new(ERROR_INPUT, "--limit: \"%s\" is not a size, such as 20MB", text);
    *limit = (int64_t)(number * factor);
    return NULL;
}

/* The case of FOLDER with the bodies and the FIELDS as its pictures. */
static struct error *read_shown(const struct cli_options *options, const char *folder,
                                struct simulation_case **input)
{
    char *path = path_join(folder, "case.yaml");
    char *pictures = text_format("output.pictures=[body, %s]",
                                 options->fields ? options->fields : "speed, pressure");
    const char *settings[] = {pictures};
    struct cli_options reading = *options;
    reading.settings = (struct text_list){1, settings};
    struct error *error = path && pictures ? read_case(path, &reading, input) : out_of_memory();
    free(path);
    free(pictures);
    return error;
}

static struct error *view_folder(const struct cli_options *options, const char *folder)
{
    struct simulation_case *input = NULL;
    char *path = options->output ? text_copy(options->output) : path_join(folder, "view.html");
    struct view_request request = {
        .folder = folder, .path = path, .frames = options->frames ? (int)options->frames : FRAMES};
    struct view_result result;
    struct error *error = path ? read_limit(options->limit, &request.limit) : out_of_memory();
    if (!error)
        error = read_shown(options, folder, &input);
    request.input = input;
    if (!error)
        error = view_write(&request, &result);
    if (!error)
        printf("%s: %.1f MB, %lld particles, %d of %d snapshots\n", path,
               1e-6 * (double)result.bytes, (long long)result.particles, result.frames,
               result.of_frames);
    case_free(input);
    free(path);
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
