/* Reading and writing a case. Its tables stand in case_table.c; what a case means is checked in
 * case_check.c. */
#include "model/case.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "model/case_internal.h"
#include "model/document_internal.h"

static struct error *out_of_memory(void) { return error_new(ERROR_SYSTEM, "out of memory"); }

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
    return document_error(document, "format", "%s is not known; this program reads format %d",
                          format->kind == NODE_SCALAR ? format->text : "a map or list",
                          CASE_FORMAT);
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
    char *name = text_copy_part(start, (size_t)(end - start));
    free(whole);
    return name;
}

/* The file of material NAME in the first folder that has it, NULL if none has. */
static char *library_file(const struct case_options *options, const char *name)
{
    for (int i = 0; i < options->library_count && !strchr(name, '/'); i++) {
        char *path = text_format("%s/%s.yaml", options->library_paths[i], name);
        if (!path || access(path, R_OK) == 0)
            return path;
        free(path);
    }
    return NULL;
}

/* Adds the materials of FOLDER to the list of NAMES; errors only cost a suggestion. */
static void library_list(const char *folder, struct name_list *names)
{
    DIR *directory = opendir(folder);
    const struct dirent *entry;
    while (directory && (entry = readdir(directory))) {
        size_t length = strlen(entry->d_name);
        if (length <= 5 || strcmp(entry->d_name + length - 5, ".yaml") != 0)
            continue;
        char **grown = realloc(names->names, ((size_t)names->count + 1) * sizeof *grown);
        char *name = grown ? text_copy_part(entry->d_name, length - 5) : NULL;
        names->names = grown ? grown : names->names;
        if (name)
            names->names[names->count++] = name;
    }
    if (directory)
        closedir(directory);
}

static struct error *no_such_material(const struct case_options *options,
                                      const struct node *library, const char *path)
{
    struct name_list names = {0};
    for (int i = 0; i < options->library_count; i++)
        library_list(options->library_paths[i], &names);
    const char *near = nearest_name(library->text, (const char *const *)names.names, names.count);
    struct error *error =
        near
            ? place_error(library->place, path,
                          "no material \"%s\" in the library (did you mean \"%s\"?)", library->text,
                          near)
            : place_error(library->place, path, "no material \"%s\" in the library", library->text);
    for (int i = 0; i < names.count; i++)
        free(names.names[i]);
    free(names.names);
    return error;
}

/* What a library file says about itself is for its readers. */
static void drop_entry(struct node *map, const char *key)
{
    for (int i = 0; i < map->count; i++) {
        if (!strcmp(map->child[i]->key, key)) {
            node_free(node_take(map, i));
            return;
        }
    }
}

/* Fills MATERIAL, an entry of `materials`, from the library file that it names, if any. */
static struct error *include_material(struct document *document, struct node *material,
                                      const struct case_options *options)
{
    const struct node *library = node_entry(material, "library");
    if (!library || library->kind != NODE_SCALAR || node_is_empty(library))
        return NULL;
    char *file = library_file(options, library->text);
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
    drop_entry(other->root, "description");
    drop_entry(other->root, "source");
    error = document_include(document, material, other);
    document_free(other);
    return error;
}

/* A material that the library does not give is taken away, so that its parts are not told as missing. */
static struct error *include_library(struct document *document, const struct case_options *options)
{
    struct node *materials = node_entry(document->root, "materials");
    struct error *all = NULL;
    for (int i = 0; materials && materials->kind == NODE_MAP && i < materials->count; i++) {
        struct node *material = materials->child[i];
        struct error *error =
            material->kind == NODE_MAP ? include_material(document, material, options) : NULL;
        if (error)
            node_free(node_take(materials, i--));
        all = error_join(all, error);
    }
    return all;
}

static struct error *read_document(struct simulation_case *input,
                                   const struct case_options *options)
{
    TRY(check_format(input->document));
    struct error *error = include_library(input->document, options);
    error = error_join(error, document_read(input->document, case_table, input->catalogue, input));
    return error ? error : case_check_meaning(input);
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
    struct error *error = input->name
                              ? document_open(path, options->settings, options->setting_count,
                                              options->quick ? "short" : NULL, &input->document)
                              : out_of_memory();
    if (!error)
        error = read_document(input, options);
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
    parameters_release(case_table, input);
    document_free(input->document);
    free(input->name);
    free(input);
}

/* The materials stand in full in what is written, so that the file needs no library. */
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
    struct error *error = document_write(file, case_table, &whole);
    free(materials);
    return error;
}
