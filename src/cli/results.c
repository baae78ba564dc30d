/* Where results go: the folder of `--output`, or results/NAME. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "cli/cli.h"

/* The last component of PATH, without the slashes after it. */
static const char *last_component(const char *path, int *length)
{
    const char *end = path + strlen(path);
    while (end > path && end[-1] == '/')
        end--;
    const char *start = end;
    while (start > path && start[-1] != '/')
        start--;
    *length = (int)(end - start);
    return start;
}

static bool is_root(const char *path)
{
    struct stat folder, root;
    return !stat(path, &folder) && !stat("/", &root) && folder.st_dev == root.st_dev &&
           folder.st_ino == root.st_ino;
}

/* A folder that is named by where it is, not by a name of its own, is most likely a slip: an
 * empty variable of a script, a slash too many. What is written would be mixed with everything
 * that is there. */
struct error *own_folder_check(const char *option, const char *folder)
{
    int length;
    const char *last = last_component(folder, &length);
    if (!*folder)
        return error_new(ERROR_INPUT, "%s: the name of the folder is empty", option);
    if (length == 0 || (length == 2 && !strncmp(last, "..", 2)) || is_root(folder))
        return error_new(ERROR_INPUT, "%s %s: choose a folder with a name of its own", option,
                         folder);
    return NULL;
}

struct error *results_folder(const struct cli_options *options, const char *path, const char *name,
                             char **folder)
{
    *folder = NULL;
    if (!options->output && (!*name || !strcmp(name, ".") || !strcmp(name, "..")))
        return error_new(ERROR_INPUT,
                         "%s: the results would go to results/%s; rename the case, or choose a "
                         "folder with --output",
                         path, name);
    *folder = options->output ? text_copy(options->output) : text_format("results/%s", name);
    return *folder ? NULL : out_of_memory();
}
