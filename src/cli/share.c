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

char *rates_path(void)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    if (cache && cache[0] == '/')
        return text_format("%s/bolide/rates.csv", cache);
    return home && home[0] == '/' ? text_format("%s/.cache/bolide/rates.csv", home) : NULL;
}

struct error *case_locate(const char *given, char **path)
{
    size_t length = strlen(given);
    *path = is_folder(given) ? NULL : text_copy(given);
    if (*path || !is_folder(given))
        return *path ? NULL : out_of_memory();
    while (length > 1 && given[length - 1] == '/')
        length--;
    bool here = length == 1 && given[0] == '.';
    char *found = here ? text_copy("case.yaml") : text_format("%.*s/case.yaml", (int)length, given);
    if (!found)
        return out_of_memory();
    if (access(found, F_OK) == 0) {
        *path = found;
        return NULL;
    }
    free(found);
    return error_new(ERROR_INPUT,
                     "%s: a folder without a case.yaml; name a case file, or the folder of one",
                     given);
}

struct error *cases_locate(struct cli_options *options)
{
    struct error *error = NULL;
    const int count = options->names.count;
    options->located = calloc((size_t)count + 1, sizeof *options->located);
    if (!options->located)
        return out_of_memory();
    for (int i = 0; i < count; i++) {
        error = error_join(error, case_locate(options->names.text[i], &options->located[i]));
        options->names.text[i] = options->located[i];
    }
    return error;
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
