/* Reading and writing a case. Its tables are in table.c; what a case means is checked in
 * check.c. */
#include "case/case.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/visible.h"
#include "case/internal.h"
#include "case/library.h"
#include "document/nodes.h"

/* Before anything else: a file of another format would only give misleading messages. */
static struct error *check_format(const struct document *document)
{
    const struct node *format = node_entry(document->root, "format");
    if (!format)
        return document_error(document, "", "\"format: %d\" is missing: is this a case?",
                              CASE_FORMAT);
    char *end = NULL;
    if (format->kind == NODE_SCALAR && strtol(format->text, &end, 10) == CASE_FORMAT && !*end)
        return NULL;
    return document_error(document, "format", "%.60s is not known; this program reads format %d",
                          format->kind == NODE_SCALAR ? format->text : "a map or list",
                          CASE_FORMAT);
}

static bool is_key_of_case(const char *key)
{
    const struct parameter *const tables[] = {case_table, case_shaping_table};
    for (size_t i = 0; i < COUNT_OF(tables); i++)
        for (const struct parameter *p = tables[i]; !PARAMETER_IS_END(p); p++)
            if (!strcmp(p->key, key))
                return true;
    return false;
}

/* An included file of which no key is one of a case is another kind of file, and perhaps not the
 * user's own: none of its lines may come to be quoted. */
static struct error *check_included(const struct document *document)
{
    const struct node *root = document->root;
    struct error *error = NULL;
    for (int o = 1; o < document->origin_count; o++) {
        const char *origin = document->origins[o];
        int known = 0, unknown = 0;
        struct mark first = {0};
        for (int i = 0; i < root->count; i++) {
            if (root->child[i]->key_place.origin != origin)
                continue;
            if (is_key_of_case(root->child[i]->key))
                known++;
            else if (unknown++ == 0)
                first = root->child[i]->key_place;
        }
        if (unknown > 0 && known == 0 && first.line > 0)
            error = error_join(error, place_error(first, "",
                                                  "an included file must have keys of a case, and "
                                                  "this has none"));
    }
    return error;
}

/* The name of the folder for a `case.yaml`, else the file's name without its ending. */
static char *case_name(const char *path)
{
    char *whole = realpath(path, NULL);
    const char *slash = whole ? strrchr(whole, '/') : NULL;
    const char *start = slash ? slash + 1 : path;
    const char *end = start + strlen(start);
    if (slash && slash > whole && !strcmp(start, "case.yaml")) {
        end = slash;
        for (start = slash; start > whole && start[-1] != '/';)
            start--;
    } else if (end - start > 5 && !strcmp(end - 5, ".yaml")) {
        end -= 5;
    }
    char *raw = text_copy_part(start, (size_t)(end - start));
    char *name = raw ? text_visible(raw) : NULL;
    free(raw);
    free(whole);
    return name;
}

static struct error *no_such_material(const struct case_options *options,
                                      const struct node *library, const char *path)
{
    char *text = library_unknown(options->library_paths, options->library_count, library->text);
    struct error *error = text ? place_error(library->place, path, "%s", text) : out_of_memory();
    free(text);
    return error;
}

/* Fills MATERIAL, an entry of `materials`, from the library file that it names, if any. */
static struct error *include_material(struct document *document, struct node *material,
                                      const struct case_options *options)
{
    const struct node *library = node_entry(material, "library");
    if (!library || library->kind != NODE_SCALAR || node_is_empty(library))
        return NULL;
    char *file = library_file(options->library_paths, options->library_count, library->text);
    if (!file) {
        char *path = text_format("materials.%s.library", material->key);
        struct error *error = path ? no_such_material(options, library, path) : out_of_memory();
        free(path);
        return error;
    }
    struct document *other = NULL;
    struct error *error = document_open(file, NULL, 0, NULL, &other);
    free(file);
    if (error)
        return error;
    error = document_include(document, material, other);
    document_free(other);
    return error;
}

/* A material that the library does not give is broken, so that its parts are not told as
 * missing. */
static struct error *include_library(struct document *document, const struct case_options *options)
{
    struct node *materials = node_entry(document->root, "materials");
    struct error *all = NULL;
    for (int i = 0; materials && materials->kind == NODE_MAP && i < materials->count; i++) {
        struct node *material = materials->child[i];
        struct error *error =
            material->kind == NODE_MAP ? include_material(document, material, options) : NULL;
        material->broken = error != NULL;
        all = error_join(all, error);
    }
    return all;
}

static struct error *read_document(struct simulation_case *input,
                                   const struct case_options *options)
{
    TRY(check_included(input->document));
    TRY(check_format(input->document));
    struct error *error = case_take_sweep(input, options->convergence ? 0 : options->sweep_run);
    error = error_join(error, case_take_study(input, options));
    error = error_join(error, case_take_spellings(input));
    error = error_join(error, include_library(input->document, options));
    error = error_join(error,
                       document_read_partly(input->document, case_table, input->catalogue, input));
    if (!error_is_full(error))
        error = error_join(error, case_check_meaning(input));
    if (!error)
        case_measure_sweep(input);
    return error;
}

/* PATH is that of the case, for the record beside it. */
static struct error *read_all(struct simulation_case *input, const char *path,
                              const struct case_options *options)
{
    TRY(read_document(input, options));
    TRY(case_read_start(input, path, options));
    TRY(case_read_records(input, path, options));
    return options->recording || options->convergence ? NULL : case_take_record(input, path);
}

/* Opens the case, with the files that run sweep_run of its sweep includes. */
static struct error *open_case(const char *path, const struct case_options *options,
                               struct document **document)
{
    TRY(document_open(path, options->settings, options->setting_count, options->form, document));
    int runs, runs_with;
    const struct node *include =
        options->convergence ? NULL : case_swept_include(*document, options->sweep_run, &runs);
    if (!include)
        return NULL;
    struct document *first = *document;
    struct error *error = document_open_with(path, include, options->settings,
                                             options->setting_count, options->form, document);
    if (!error &&
        !(case_swept_include(*document, options->sweep_run, &runs_with) && runs_with == runs)) {
        error = place_error(include->place, "sweep.include",
                            "with this the case has another sweep; write the sweep in the case "
                            "itself");
        document_free(*document);
        *document = NULL;
    }
    document_free(first);
    return error;
}

struct error *case_read(const char *path, const struct case_options *options,
                        const struct catalogue *catalogue, struct simulation_case **result)
{
    *result = NULL;
    struct simulation_case *input = memory_allocate(sizeof *input);
    if (!input)
        return out_of_memory();
    input->catalogue = catalogue;
    input->name = case_name(path);
    struct error *error =
        input->name ? open_case(path, options, &input->document) : out_of_memory();
    if (!error) {
        input->form = input->document->overlay ? input->document->overlay : "normal";
        error = read_all(input, path, options);
    }
    if (error)
        case_free(input);
    else
        *result = input;
    return error;
}

void case_free(struct simulation_case *input)
{
    if (!input)
        return;
    for (int i = 0; i < input->materials.count; i++)
        free(case_material(input, i)->material);
    for (int i = 0; i < input->loads.count; i++)
        case_free(case_load(input, i)->record.input);
    parameters_release(case_table, input);
    case_free(input->start.input);
    sweep_values_free(input->sweep, input->sweep_values);
    document_free(input->document);
    error_free(input->notes);
    free(input->name);
    free(input);
}

/* The keys that case_write writes. It leaves out the convergence study and the calibration, which
 * may use names that no longer exist, and the fits and repetitions, which need a sweep. */
static void written_table(struct parameter *table)
{
    for (const struct parameter *p = case_table; !PARAMETER_IS_END(p); p++)
        if (p->offset != offsetof(struct simulation_case, convergence) &&
            p->offset != offsetof(struct simulation_case, calibrate) &&
            p->offset != offsetof(struct simulation_case, fits) &&
            p->offset != offsetof(struct simulation_case, repetitions))
            *table++ = *p;
    *table = (struct parameter)PARAMETER_END;
}

/* The materials stand in full in what is written, so that the file needs no library. */
/* Whether NAME may be a title: what is drawn from results in a folder of another name has the title
 * of the run. */
static bool is_plain(const char *name)
{
    enum { MOST = 60 };
    static const char letters[] =
        "-0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const size_t length = strspn(name, letters);
    return length > 0 && length < MOST && !name[length] && name[0] != '-';
}

struct error *case_write(const struct simulation_case *input, FILE *file)
{
    struct simulation_case whole = *input;
    size_t size = (size_t)input->materials.count * sizeof(struct material_input);
    struct material_input *materials = memory_allocate(size);
    if (!materials)
        return out_of_memory();
    memcpy(materials, input->materials.items, size);
    for (int i = 0; i < input->materials.count; i++)
        materials[i].library = NULL;
    whole.materials.items = materials;
    if (!input->title && input->name && is_plain(input->name))
        whole.title = input->name;
    struct parameter table[KEYS_MAX];
    written_table(table);
    struct error *error = document_write(file, table, &whole);
    free(materials);
    return error;
}

int case_find_body(const struct simulation_case *input, const char *name)
{
    return name ? named_map_find(&input->bodies, name) : -1;
}
