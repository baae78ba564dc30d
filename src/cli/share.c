/* Where the files that come with the program are, and the reading of cases with them. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "cli/cli.h"

static bool is_folder(const char *path)
{
    struct stat status;
    return path && stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* The folder of the running program, "" when it is not known. */
static void program_folder(char *folder, size_t size)
{
    ssize_t length = readlink("/proc/self/exe", folder, size - 1);
    folder[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(folder, '/');
    if (slash)
        *slash = '\0';
}

/* PATH (which it takes) when it is a folder; else NULL. */
static char *folder_or_none(char *path)
{
    if (is_folder(path))
        return path;
    free(path);
    return NULL;
}

char *share_folder(const char *name)
{
    char program[4096];
    program_folder(program, sizeof program);
    const char *given = getenv("BOLIDE_SHARE");
    char *found = given ? folder_or_none(text_format("%s/%s", given, name)) : NULL;
    if (!found && program[0])
        found = folder_or_none(text_format("%s/../../%s", program, name));
    if (!found && program[0])
        found = folder_or_none(text_format("%s/../share/bolide/%s", program, name));
    if (!found)
        found = folder_or_none(text_copy(name));
    if (!found && !program[0]) /* without /proc the program does not know where it is */
        found = folder_or_none(text_format("/usr/share/bolide/%s", name));
    return found;
}

struct case_options case_reading(const struct cli_options *options, const char *const *materials)
{
    return (struct case_options){
        .settings = options->settings.text,
        .setting_count = options->settings.count,
        .form = options->quick      ? "short"
                : options->thorough ? "long"
                                    : NULL,
        .library_paths = materials,
        .library_count = *materials ? 1 : 0,
    };
}

struct error *read_run_of_sweep(const char *path, const struct cli_options *options, int run,
                                struct simulation_case **input)
{
    char *materials = share_folder("materials");
    const char *const folders[] = {materials};
    struct case_options reading = case_reading(options, folders);
    reading.sweep_run = run;
    struct error *error = case_read(path, &reading, &bolide_catalogue, input);
    free(materials);
    return error;
}

struct error *read_case(const char *path, const struct cli_options *options,
                        struct simulation_case **input)
{
    return read_run_of_sweep(path, options, 0, input);
}
