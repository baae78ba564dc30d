/* Cases that are computed before another one begins: `start: {from: FILE}`, its keys and the case
 * that FILE holds, and those that give the records of loads. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "case/checking.h"
#include "case/internal.h"
#include "document/nodes.h"

const struct parameter case_start_table[] = {
    PARAMETER(
        TEXT, struct start_input, from, OPTIONAL,
        "a case of one dimension, spherical or cylindrical, or for 3-D an axisymmetric one, or "
        "the folder of one, from this file's folder; it is computed before this run begins. With "
        "mpm and sph: a folder of results, from whose checkpoint the bodies continue that this "
        "case has too",
        .is_path = true),
    PARAMETER(
        NUMBER, struct start_input, at, OPTIONAL,
        "time up to which that case is computed; default: its end. With mpm and sph: the time "
        "of the checkpoint, or the end of that run",
        .unit = "s", .below = INFINITY),
    PARAMETER(NAMES, struct start_input, without, OPTIONAL,
              "with mpm and sph: the bodies of that run that are left out"),
    PARAMETER(VECTOR, struct start_input, center, OPTIONAL,
              "where its centre lies here; default: the origin", .unit = "m"),
    PARAMETER(CHOICE, struct start_input, axis, OPTIONAL,
              "of an axisymmetric case: along which axis of this case its own lies; default: y",
              .names = parameter_axes),
    PARAMETER(FLAG, struct start_input, window, "no",
              "the domain is a window on the blast: it need not hold all of it, nor its centre; "
              "faces that cut the blast must let waves through, and disturb what comes to them"),
    PARAMETER(TEXT, struct start_input, material, OPTIONAL,
              "the material of this case that its products are; needed where it has two materials"),
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

/* The case that the one at PATH starts from, to be freed; NULL: none, or the file is wrong, which
 * its reader reports. */
static char *source_of(const char *path)
{
    struct document *document = NULL;
    struct error *error = document_open(path, NULL, 0, NULL, &document);
    error_free(error);
    if (error)
        return NULL;
    const struct node *start = node_entry(document->root, "start");
    const struct node *from = start && start->kind == NODE_MAP ? node_entry(start, "from") : NULL;
    char *source = from && from->kind == NODE_SCALAR ? path_of(path, from->text) : NULL;
    document_free(document);
    return source;
}

static bool same_file(const char *a, const char *b)
{
    struct stat one, other;
    return stat(a, &one) == 0 && stat(b, &other) == 0 && one.st_dev == other.st_dev &&
           one.st_ino == other.st_ino;
}

static char *with_arrow(char *chain, const char *path)
{
    char *longer = chain ? text_format("%s -> %s", chain, path) : text_copy(path);
    free(chain);
    return longer;
}

/* Follows the cases that start from each other, from the one at PATH on; *CHAIN, to be freed,
 * names those that lead back to it or never end, NULL where they end. */
static void find_cycle(const char *path, char **chain)
{
    enum { MOST = 16 };
    char *file[MOST] = {text_copy(path)};
    int count = 1, again = -1;
    *chain = NULL;
    while (again < 0 && count < MOST && file[count - 1]) {
        char *source = source_of(file[count - 1]);
        for (int k = 0; k < count && source; k++)
            again = again < 0 && same_file(file[k], source) ? k : again;
        file[count++] = source;
    }
    for (int k = 0; k < count && (again >= 0 || file[count - 1]) && file[k]; k++)
        *chain = with_arrow(*chain, file[k]);
    for (int k = 0; k < count; k++)
        free(file[k]);
}

/* Reads the case in FILE, which KEY calls FROM, in FORM (NULL: as it is), to be computed first. */
static struct error *read_source(struct checking *checking, const char *key, const char *from,
                                 const char *file, const char *form,
                                 const struct case_options *options,
                                 struct simulation_case **source)
{
    const struct case_options plain = {.form = form,
                                       .recording = true,
                                       .source = true,
                                       .library_paths = options->library_paths,
                                       .library_count = options->library_count};
    if (access(file, R_OK) == 0)
        return case_read(file, &plain, checking->input->catalogue, source);
    const char *slash = strrchr(from, '/');
    case_wrong(checking, key, "there is no case \"%s\"", slash ? slash + 1 : from);
    return checking->error;
}

struct error *case_read_start(struct simulation_case *input, const char *path,
                              const struct case_options *options)
{
    struct start_input *start = &input->start;
    if (!start->from)
        return NULL;
    char *file = path_of(path, start->from);
    if (!file)
        return out_of_memory();
    struct checking checking = {.input = input, .map = "start"};
    struct error *error = NULL;
    char *chain;
    find_cycle(path, &chain);
    if (chain) {
        case_wrong(&checking, "from", "a case cannot start from itself, be it through others: %s",
                   chain);
        error = checking.error;
    } else
        error = read_source(&checking, "from", start->from, file, NULL, options, &start->input);
    free(chain);
    free(file);
    return error;
}

/* Reads the case of the record of the load at INDEX, and looks at its probe. */
static struct error *read_record(struct simulation_case *input, int index, const char *path,
                                 const struct case_options *options)
{
    struct record_input *record = &case_load(input, index)->record;
    struct checking checking = {.input = input, .map = "loads", .name = input->loads.names[index]};
    if (options->source) {
        case_wrong(&checking, "record",
                   "this case is computed for another one, and must not need a third");
        return checking.error;
    }
    char *file = path_of(path, record->from);
    if (!file)
        return out_of_memory();
    struct error *error = read_source(&checking, "record.from", record->from, file, options->form,
                                      options, &record->input);
    free(file);
    TRY(error);
    const int probe =
        case_find_name(&checking, &record->input->probes, "probe", record->probe, "record.probe");
    if (probe >= 0 && strcmp(case_probe(record->input, probe)->probe.choice->name, "line") != 0)
        case_wrong(&checking, "record.probe", "this is a `%s`; a record comes from a `line`",
                   case_probe(record->input, probe)->probe.choice->name);
    return checking.error;
}

struct error *case_read_records(struct simulation_case *input, const char *path,
                                const struct case_options *options)
{
    struct error *error = NULL;
    for (int i = 0; i < input->loads.count; i++)
        if (case_load(input, i)->record.from)
            error = error_join(error, read_record(input, i, path, options));
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
    if (!start->from && (start->material || start->without.count || start->center.count ||
                         !isnan(start->at) || start->window || start->axis >= 0))
        case_wrong(checking, "", "give `from`, the case that is computed first");
    if (start->center.count)
        case_check_components(checking, "center", start->center.count);
}
