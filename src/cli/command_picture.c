/* bolide picture: pictures of the results in a folder, from its snapshots. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "cli/cli.h"
#include "picture/album.h"
#include "run/pictures.h"

static void print_path(void *context, const char *path)
{
    (void)context;
    printf("%s\n", path);
}

/* Adds TEXT (taken) to the COUNT settings; false when memory is out. */
static bool add_setting(char **settings, int *count, char *text)
{
    settings[*count] = text;
    *count += text != NULL;
    return text != NULL;
}

/* The case of the run in FOLDER as OPTIONS want it: `--set pictures.NAME.KEY=VALUE` means a key of
 * its output, and a name that is no picture of the case stands for the field of that name. */
static struct error *read_results(const struct cli_options *options, const char *folder,
                                  struct simulation_case **input)
{
    const struct text_list *names = &options->names;
    const int most = options->settings.count + names->count;
    char **settings = calloc((size_t)most + 1, sizeof *settings);
    char *path = path_join(folder, "case.yaml");
    int count = 0;
    bool done = settings && path;
    struct simulation_case *written = NULL;
    struct cli_options reading = *options;
    reading.settings = (struct text_list){0};
    struct error *error = done ? read_case(path, &reading, &written) : out_of_memory();
    for (int i = 1; i < names->count && !error && done; i++) {
        bool known = false;
        for (int k = 0; album_name_of(written, k); k++)
            known |= !strcmp(album_name_of(written, k), names->text[i]);
        if (!known)
            done = add_setting(
                settings, &count,
                text_format("output.pictures.%s.field=%s", names->text[i], names->text[i]));
    }
    for (int i = 0; i < options->settings.count && !error && done; i++)
        done = add_setting(
            settings, &count,
            text_format(!strncmp(options->settings.text[i], "pictures.", 9) ? "output.%s" : "%s",
                        options->settings.text[i]));
    if (!done && !error)
        error = out_of_memory();
    case_free(written);
    reading.settings = (struct text_list){count, (const char **)settings};
    if (!error)
        error = read_case(path, &reading, input);
    names_free(settings, count);
    free(path);
    return error;
}

/* `--at`: a time, `last` or `all`. */
static struct error *find_moment(const char *text, struct pictures_request *request)
{
    static const struct dimension seconds = {.time = 1};
    struct quantity time;
    if (!text || !strcmp(text, "all"))
        return NULL;
    if (!strcmp(text, "last")) {
        request->last_alone = true;
        return NULL;
    }
    TRY(error_context(expression_evaluate(text, NULL, &time), "--at"));
    if (!dimension_equal(time.dimension, seconds) && time.value != 0.0)
        return error_new(ERROR_INPUT, "--at: \"%s\" is not a time, such as 5us", text);
    request->at = time.value;
    return NULL;
}

/* `--size`: 1280x720. */
static struct error *find_size(const char *text, int size[2])
{
    enum { LEAST = 200, MOST = 10000 };
    char *end = NULL;
    if (!text)
        return NULL;
    const long width = strtol(text, &end, 10);
    const long height = *end == 'x' ? strtol(end + 1, &end, 10) : 0;
    if (*end || width < LEAST || width > MOST || height < LEAST || height > MOST)
        return error_new(ERROR_INPUT,
                         "--size: \"%s\" is no size of %d to %d pixels, such as 1280x720", text,
                         LEAST, MOST);
    size[0] = (int)width;
    size[1] = (int)height;
    return NULL;
}

struct error *draw_again(const struct cli_options *options, struct pictures_request *request,
                         int64_t *count)
{
    struct simulation_case *input = NULL;
    *count = 0;
    request->folder = options->names.text[0];
    request->ranks = options->ranks;
    request->threads = (int)options->threads;
    request->count = options->names.count - 1;
    request->names = options->names.text + 1;
    request->at = NAN;
    struct error *error = find_size(options->size, request->size);
    if (!error)
        error = read_results(options, request->folder, &input);
    if (!error && request->size[0] && input->dimension == 1)
        error = error_new(ERROR_INPUT, "--size: pictures in 1-D have a size of their own");
    if (!error)
        error = find_moment(options->at, request);
    request->input = input;
    if (!error)
        error = pictures_draw(request, count);
    if (!error && !*count)
        error = error_new(ERROR_INPUT, "%s: there are no snapshots to draw", request->folder);
    case_free(input);
    return error;
}

int command_picture(const struct cli_options *options)
{
    struct pictures_request request = {.drawn = print_path};
    int64_t count;
    char *pictures = path_join(options->names.text[0], "pictures");
    struct error *error = pictures ? folder_make(pictures) : out_of_memory();
    if (!error)
        error = draw_again(options, &request, &count);
    free(pictures);
    return error ? report_error(error) : EXIT_OK;
}
