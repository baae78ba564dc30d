/* The files of the material library. */
#include "case/library.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "case/internal.h"
#include "material/any.h"
#include "material/material.h"

static bool is_yaml(const char *name, size_t length)
{
    return length > 5 && name[0] != '.' && !strcmp(name + length - 5, ".yaml");
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static bool append_name(struct name_list *names, const char *name, size_t length)
{
    char **grown = realloc(names->names, ((size_t)names->count + 1) * sizeof *grown);
    if (!grown)
        return false;
    names->names = grown;
    grown[names->count] = text_copy_part(name, length);
    return grown[names->count] && ++names->count;
}

void library_names_free(struct name_list *names)
{
    for (int i = 0; i < names->count; i++)
        free(names->names[i]);
    free(names->names);
    *names = (struct name_list){0};
}

struct error *library_names(const char *folder, struct name_list *names)
{
    *names = (struct name_list){0};
    DIR *directory = opendir(folder);
    if (!directory)
        return error_new(ERROR_INPUT, "%s: %s", folder, strerror(errno));
    bool enough = true;
    const struct dirent *entry;
    while (enough && (entry = readdir(directory))) {
        size_t length = strlen(entry->d_name);
        if (is_yaml(entry->d_name, length))
            enough = append_name(names, entry->d_name, length - 5);
    }
    closedir(directory);
    if (!enough) {
        library_names_free(names);
        return out_of_memory();
    }
    if (names->count)
        qsort(names->names, (size_t)names->count, sizeof *names->names, compare_names);
    return NULL;
}

char *library_file(const char *const *folders, int count, const char *name)
{
    for (int i = 0; i < count && !strchr(name, '/'); i++) {
        char *path = text_format("%s/%s.yaml", folders[i], name);
        if (!path || access(path, R_OK) == 0)
            return path;
        free(path);
    }
    return NULL;
}

/* Adds the names of which WORD, if it is no mere letter or two, is a part to TEXT, as
 * `"steel-1006", "steel-304"`. */
static void add_containing(const struct name_list *names, const char *word, char *text, size_t size)
{
    for (int i = 0; i < names->count && strlen(word) > 2; i++) {
        const size_t used = strlen(text);
        if (strstr(names->names[i], word))
            snprintf(text + used, size - used, "%s\"%s\"", used ? ", " : "", names->names[i]);
    }
}

/* A folder that cannot be read only costs a suggestion. */
char *library_unknown(const char *const *folders, int count, const char *name)
{
    char *found = NULL, known[2048] = "", part[1024] = "";
    for (int i = 0; i < count && !found; i++) {
        struct name_list names;
        error_free(library_names(folders[i], &names));
        const char *const *all = (const char *const *)names.names;
        size_t used = strlen(known);
        found = text_copy(nearest_name(name, all, names.count));
        add_containing(&names, name, part, sizeof part);
        if (used && used + 2 < sizeof known && names.count)
            used += (size_t)snprintf(known + used, sizeof known - used, ", ");
        list_text(all, names.count, known + used, sizeof known - used);
        library_names_free(&names);
    }
    char *text;
    if (found)
        text = text_format("no material \"%s\" in the library (did you mean \"%s\"?)", name, found);
    else if (part[0])
        text = text_format("no material \"%s\" in the library (did you mean %s?)", name, part);
    else if (known[0])
        text = text_format("no material \"%s\" in the library (known: %s)", name, known);
    else
        text = text_format("no material \"%s\": the library was not found; set BOLIDE_SHARE to the "
                           "folder that holds materials/",
                           name);
    free(found);
    return text;
}

struct error *library_read(const char *path, const struct catalogue *catalogue,
                           struct material_input *material)
{
    struct document *document = NULL;
    *material = (struct material_input){0};
    TRY(document_open(path, NULL, 0, NULL, &document));
    struct error *error = document_read(document, case_material_table, catalogue, material);
    document_free(document);
    return error ? error : case_fill_material(material);
}

void library_release(struct material_input *material)
{
    parameters_release(case_material_table, material);
    free(material->material);
    material->material = NULL;
}

bool library_rest(const struct material *material, struct point *point, struct response *response)
{
    static const double atmosphere = 101325.0;
    const char *key;
    struct start_given given = {
        .density = material_density(material), .pressure = NAN, .energy = 0.0, .temperature = NAN};
    if (start_state(&given, material, point, &key)) {
        given.pressure = atmosphere;
        given.energy = NAN;
        if (start_state(&given, material, point, &key))
            return false;
    }
    *response = any_material_evaluate(material, point);
    return true;
}
