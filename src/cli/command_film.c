/* bolide film: the frames of a picture as a film, with ffmpeg. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"
#include "cli/cli.h"
#include "picture/film.h"
#include "run/pictures.h"

/* "pressure-000012.png" is a frame of pressure. */
static bool is_frame_of(const char *file, const char *name)
{
    const size_t length = strlen(name);
    if (strncmp(file, name, length) != 0 || file[length] != '-')
        return false;
    const size_t digits = strspn(file + length + 1, "0123456789");
    return digits >= 6 && !strcmp(file + length + 1 + digits, ".png");
}

struct frames {
    char **paths;
    int count;
};

/* In the child: ffmpeg, which reads PNG files from INPUT. */
static void become_ffmpeg(int input, double rate, const char *path, const char *format)
{
    char number[32];
    snprintf(number, sizeof number, "%.9g", rate);
    dup2(input, STDIN_FILENO);
    close(input);
    execlp("ffmpeg", "ffmpeg", "-loglevel", "error", "-y", "-f", "image2pipe", "-framerate", number,
           "-c:v", "png", "-i", "-", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v",
           !strcmp(format, "webm") ? "libvpx-vp9" : "libx264", "-pix_fmt", "yuv420p", path,
           (char *)NULL);
    _exit(127);
}

static struct error *send_frames(const struct frames *frames, int output)
{
    struct error *error = NULL;
    for (int i = 0; i < frames->count && !error; i++) {
        char *bytes;
        size_t size, sent = 0;
        error = file_read(frames->paths[i], &bytes, &size);
        while (!error && sent < size) {
            const ssize_t part = write(output, bytes + sent, size - sent);
            if (part <= 0)
                error = error_new(ERROR_SYSTEM, "ffmpeg has stopped");
            else
                sent += (size_t)part;
        }
        if (bytes)
            free(bytes);
    }
    return error;
}

static struct error *run_ffmpeg(const struct frames *frames, double rate, const char *path,
                                const char *format)
{
    int ends[2], status = -1;
    fflush(stdout);
    if (pipe(ends))
        return error_new(ERROR_SYSTEM, "%s: no pipe to ffmpeg", path);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[1]);
        become_ffmpeg(ends[0], rate, path, format);
    }
    close(ends[0]);
    void (*before)(int) = signal(SIGPIPE, SIG_IGN);
    struct error *error = send_frames(frames, ends[1]);
    close(ends[1]);
    signal(SIGPIPE, before);
    if (child < 0 || waitpid(child, &status, 0) < 0 || status != 0) {
        error_free(error);
        error = error_new(ERROR_SYSTEM, "%s: ffmpeg failed", path);
    }
    return error;
}

static bool has_ffmpeg(void) { return system("command -v ffmpeg >/dev/null 2>&1") == 0; }

static struct error *make_film(const struct frames *frames, const struct cli_options *options,
                               const char *folder, const char *name)
{
    const double rate = options->rate ? strtod(options->rate, NULL) : 10.0;
    const char *format = options->format ? options->format : has_ffmpeg() ? "mp4" : "apng";
    const bool apng = !strcmp(format, "apng");
    if (!(rate > 0.0 && rate <= 1000.0))
        return error_new(ERROR_INPUT, "--rate: \"%s\" is no number of frames a second",
                         options->rate);
    if (!apng && strcmp(format, "mp4") != 0 && strcmp(format, "webm") != 0)
        return error_new(ERROR_INPUT, "--format: \"%s\" is none of mp4, webm, apng", format);
    char *path = text_format("%s/%s.%s", folder, name, apng ? "png" : format);
    struct error *error = path ? NULL : out_of_memory();
    if (!error && apng)
        error = film_apng((const char *const *)frames->paths, frames->count, rate, path);
    if (!error && !apng)
        error = film_check((const char *const *)frames->paths, frames->count);
    if (!error && !apng)
        error = run_ffmpeg(frames, rate, path, format);
    if (!error)
        printf("%s: %d frames%s\n", path, frames->count,
               apng && !options->format ? " (an mp4 needs ffmpeg)" : "");
    free(path);
    return error;
}

/* The film of the frames of NAME in the folder PICTURES. */
static struct error *film_of(const struct cli_options *options, const char *pictures,
                             const char *name)
{
    const char *folder = options->names.text[0];
    struct frames frames = {0};
    char **names = NULL;
    int count = 0;
    struct error *error = folder_names(pictures, ".png", &names, &count);
    frames.paths = calloc((size_t)count + 1, sizeof *frames.paths);
    for (int i = 0; i < count && !error && frames.paths; i++)
        if (is_frame_of(names[i], name)) {
            frames.paths[frames.count] = path_join(pictures, names[i]);
            frames.count += frames.paths[frames.count] != NULL;
        }
    if (!error && !frames.count)
        error = error_new(ERROR_INPUT, "%s: there are no frames of \"%s\"", folder, name);
    if (!error)
        error = make_film(&frames, options, folder, name);
    names_free(frames.paths, frames.count);
    names_free(names, count);
    return error;
}

/* The picture of the first frame in the folder. */
static struct error *first_name(const char *pictures, char **name)
{
    char **names = NULL;
    int count = 0;
    struct error *error = folder_names(pictures, ".png", &names, &count);
    *name = NULL;
    for (int i = 0; i < count && !error && !*name; i++) {
        const char *dash = strrchr(names[i], '-');
        char *part = dash ? text_copy_part(names[i], (size_t)(dash - names[i])) : NULL;
        if (part && is_frame_of(names[i], part))
            *name = part;
        else
            free(part);
    }
    if (!error && !*name)
        error = error_new(ERROR_INPUT, "%s: there are no pictures", pictures);
    names_free(names, count);
    return error;
}

/* The films of the frames in the folder PICTURES. */
static struct error *make_films(const struct cli_options *options, const char *pictures)
{
    char *first = NULL;
    struct error *error = NULL;
    if (options->names.count == 1) {
        error = first_name(pictures, &first);
        if (!error)
            error = film_of(options, pictures, first);
    }
    for (int i = 1; i < options->names.count && !error; i++)
        error = film_of(options, pictures, options->names.text[i]);
    free(first);
    return error;
}

static void remove_frames(const char *pictures)
{
    char **names = NULL;
    int count = 0;
    error_free(folder_names(pictures, ".png", &names, &count));
    for (int i = 0; i < count; i++) {
        char *path = path_join(pictures, names[i]);
        if (path)
            unlink(path);
        free(path);
    }
    names_free(names, count);
    rmdir(pictures);
}

/* Frames of a size of their own are drawn for the film alone. */
static struct error *make_sized(const struct cli_options *options)
{
    char *pictures = path_join(options->names.text[0], ".frames");
    struct pictures_request request = {.into = pictures};
    int64_t count;
    struct error *error = pictures ? folder_make(pictures) : out_of_memory();
    if (!error) {
        error = draw_again(options, &request, &count);
        if (!error)
            error = make_films(options, pictures);
        remove_frames(pictures);
    }
    free(pictures);
    return error;
}

int command_film(const struct cli_options *options)
{
    char *pictures = path_join(options->names.text[0], "pictures");
    struct error *error = !pictures       ? out_of_memory()
                          : options->size ? make_sized(options)
                                          : make_films(options, pictures);
    free(pictures);
    return error ? report_error(error) : EXIT_OK;
}
