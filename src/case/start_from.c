/* `start: {from: FILE}`: its keys, and the case that FILE holds. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "case/checking.h"
#include "case/internal.h"

const struct parameter case_start_table[] = {
    {.key = "from",
     .kind = PARAMETER_TEXT,
     .offset = offsetof(struct start_input, from),
     .standard = PARAMETER_OPTIONAL,
     .help = "a case of one dimension, spherical or cylindrical, or the folder of one, from this "
             "file's folder; it is computed before this run begins"},
    {.key = "at",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct start_input, at),
     .unit = "s",
     .standard = PARAMETER_OPTIONAL,
     .below = INFINITY,
     .help = "time up to which that case is computed; default: its end"},
    {.key = "center",
     .kind = PARAMETER_VECTOR,
     .offset = offsetof(struct start_input, center),
     .unit = "m",
     .standard = PARAMETER_OPTIONAL,
     .help = "where its centre lies here; default: the origin"},
    {.key = "material",
     .kind = PARAMETER_TEXT,
     .offset = offsetof(struct start_input, material),
     .standard = PARAMETER_OPTIONAL,
     .help = "the material of this case that its products are; needed where it has two materials"},
    PARAMETER_END,
};

/* FROM from the folder of the case at PATH; the case of a folder. */
static char *path_of(const char *path, const char *from)
{
    const char *slash = strrchr(path, '/');
    char *joined = from[0] == '/' || !slash
                       ? text_format("%s", from)
                       : text_format("%.*s/%s", (int)(slash - path), path, from);
    struct stat status;
    if (joined && stat(joined, &status) == 0 && S_ISDIR(status.st_mode)) {
        char *file = text_format("%s/case.yaml", joined);
        free(joined);
        joined = file;
    }
    return joined;
}

struct error *case_read_start(struct simulation_case *input, const char *path,
                              const struct case_options *options)
{
    struct start_input *start = &input->start;
    struct case_options plain = {.recording = true,
                                 .library_paths = options->library_paths,
                                 .library_count = options->library_count};
    if (!start->from)
        return NULL;
    char *file = path_of(path, start->from);
    if (!file)
        return error_new(ERROR_SYSTEM, "out of memory");
    struct checking checking = {.input = input, .map = "start"};
    struct error *error = NULL;
    if (access(file, R_OK) == 0) {
        error = case_read(file, &plain, input->catalogue, &start->input);
    } else {
        case_wrong(&checking, "from", "there is no case \"%s\"", start->from);
        error = checking.error;
    }
    free(file);
    return error;
}

void case_check_start(struct checking *checking)
{
    struct simulation_case *input = checking->input;
    struct start_input *start = &input->start;
    checking->map = "start";
    checking->name = NULL;
    start->material_index = -1;
    if (start->material && start->from)
        start->material_index =
            case_find_name(checking, &input->materials, "material", start->material, "material");
    if (!start->from && (start->material || start->center.count || !isnan(start->at)))
        case_wrong(checking, "", "give `from`, the case that is computed first");
    if (case_dimension_known(checking) && start->center.count &&
        start->center.count != input->dimension)
        case_wrong(checking, "center", "expected %d component%s, one for each dimension; found %d",
                   (int)input->dimension, input->dimension == 1 ? "" : "s", start->center.count);
}
