/* bolide new: a case to start from, out of the templates that come with the program. */
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "cli/cli.h"

enum { TEMPLATES = 64 };

static const char usual_template[] = "impact";

/* Names of the templates in FOLDER, without their ending; the caller frees each. */
static int template_names(const char *folder, char **names)
{
    int count = 0;
    struct dirent **entries;
    int found = scandir(folder, &entries, NULL, alphasort);
    for (int i = 0; i < found; i++) {
        const char *ending = strrchr(entries[i]->d_name, '.');
        if (ending && !strcmp(ending, ".yaml") && count < TEMPLATES) {
            names[count] =
                text_copy_part(entries[i]->d_name, (size_t)(ending - entries[i]->d_name));
            count += names[count] != NULL;
        }
        free(entries[i]);
    }
    if (found >= 0)
        free(entries);
    return count;
}

static struct error *unknown_template(const char *folder, const char *name)
{
    char *names[TEMPLATES], known[1024] = "";
    int count = template_names(folder, names);
    const char *nearest = nearest_name(name, (const char *const *)names, count);
    size_t used = 0;
    for (int i = 0; i < count && used < sizeof known; i++)
        used +=
            (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", names[i]);
    struct error *error =
        nearest ? error_new(ERROR_INPUT, "no template \"%s\" (did you mean \"%s\"?)", name, nearest)
                : error_new(ERROR_INPUT, "no template \"%s\" (known: %s)", name, known);
    for (int i = 0; i < count; i++)
        free(names[i]);
    return error;
}

/* Copies FROM into the new file PATH, which must not be there yet. */
static struct error *copy_file(FILE *from, const char *path)
{
    FILE *file = fopen(path, "wxe");
    if (!file && errno == EEXIST)
        return error_new(ERROR_INPUT, "%s: exists already and is left unchanged", path);
    if (!file)
        return file_error(path, errno);
    char bytes[4096];
    size_t got;
    while ((got = fread(bytes, 1, sizeof bytes, from)) > 0 && fwrite(bytes, 1, got, file) == got)
        ;
    bool failed = ferror(from) || ferror(file);
    failed = fclose(file) || failed;
    if (!failed)
        return NULL;
    struct error *error = file_error(path, errno);
    remove(path);
    return error;
}

static struct error *write_case(FILE *from, const char *folder, const char *name)
{
    TRY(folder_make(folder));
    char *path = path_join(folder, "case.yaml");
    struct error *error = path ? copy_file(from, path) : out_of_memory();
    if (!error)
        printf("%s, from the template %s: change it, then `bolide check %s` and `bolide run %s`\n",
               path, name, path, path);
    free(path);
    return error;
}

static struct error *new_case(const char *folder, const char *name)
{
    char *templates = share_folder("templates");
    if (!templates)
        return error_new(ERROR_INPUT, "no templates found; set BOLIDE_SHARE to the folder that "
                                      "holds templates/");
    char *path = strchr(name, '/') ? NULL : text_format("%s/%s.yaml", templates, name);
    FILE *from = path ? fopen(path, "re") : NULL;
    struct error *error = from ? write_case(from, folder, name) : unknown_template(templates, name);
    if (from)
        fclose(from);
    free(path);
    free(templates);
    return error;
}

/* The template with the name of FOLDER, else the usual one. */
static const char *template_of(const char *folder)
{
    const char *slash = strrchr(folder, '/'), *name = slash ? slash + 1 : folder;
    char *templates = share_folder("templates"), *names[TEMPLATES];
    const char *chosen = usual_template;
    int count = templates ? template_names(templates, names) : 0;
    for (int i = 0; i < count; i++) {
        if (!strcmp(names[i], name))
            chosen = name;
        free(names[i]);
    }
    free(templates);
    return chosen;
}

int command_new(const struct cli_options *options)
{
    const char *folder = options->names.text[0];
    struct error *error = own_folder_check("new", folder);
    if (!error)
        error =
            new_case(folder, options->template_name ? options->template_name : template_of(folder));
    return error ? report_error(error) : EXIT_OK;
}
