/* bolide materials: the library as a table, and a material's file with its sources or its
 * curves. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "case/library.h"
#include "cli/cli.h"
#include "material/material.h"
#include "run/judge.h"

static const char row_format[] = "%-26s %-21s %-15s %-16s %9s %8s %8s  %s\n";

static void print_header(void)
{
    printf("%s", colour(COLOUR_STRONG));
    printf(row_format, "name", "eos", "strength", "failure", "density", "C_long", "C_shear",
           "description");
    printf("%s", colour(COLOUR_NONE));
    printf(row_format, "", "", "", "", "kg/m^3", "m/s", "m/s", "");
}

static struct error *print_row(const char *name, const struct material_input *input)
{
    struct point point;
    struct response rest;
    char density[32], sound_long[32], sound_shear[32] = "-";
    if (!library_rest(input->material, &point, &rest))
        return error_new(ERROR_INPUT, "%s: sound does not travel at rest", name);
    snprintf(density, sizeof density, "%.6g", point.density);
    snprintf(sound_long, sizeof sound_long, "%.5g", rest.sound_long);
    if (rest.sound_shear > 0.0)
        snprintf(sound_shear, sizeof sound_shear, "%.5g", rest.sound_shear);
    printf(row_format, name, input->eos.choice->name,
           input->strength.choice ? input->strength.choice->name : "none",
           input->failure.choice ? input->failure.choice->name : "none", density, sound_long,
           sound_shear, input->description ? input->description : "");
    return NULL;
}

/* Files with mistakes are reported after the table. */
static struct error *list_materials(const char *folder)
{
    struct name_list names;
    TRY(library_names(folder, &names));
    print_header();
    struct error *all = NULL;
    for (int i = 0; i < names.count; i++) {
        struct material_input input;
        char *path = library_file(&folder, 1, names.names[i]);
        struct error *error =
            path ? library_read(path, &bolide_catalogue, &input)
                 : error_new(ERROR_INPUT, "%s/%s.yaml: cannot be read", folder, names.names[i]);
        if (!error) {
            error = print_row(names.names[i], &input);
            library_release(&input);
        }
        free(path);
        all = error_join(all, error);
    }
    printf("%d materials in %s, at rest; gases at 101.325 kPa. `bolide materials NAME` prints one "
           "with "
           "the sources of its values.\n",
           names.count, folder);
    library_names_free(&names);
    return all;
}

static struct error *print_file(const char *path)
{
    char buffer[4096];
    size_t length;
    FILE *file = fopen(path, "r");
    if (!file)
        return file_error(path, errno);
    while ((length = fread(buffer, 1, sizeof buffer, file)) > 0)
        fwrite(buffer, 1, length, stdout);
    struct error *error = ferror(file) ? file_error(path, errno) : NULL;
    fclose(file);
    return error;
}

static struct error *print_curves_of(const char *path, const char *name)
{
    struct material_input input;
    TRY(library_read(path, &bolide_catalogue, &input));
    const bool printed = print_curves(input.material);
    library_release(&input);
    return printed ? NULL : error_new(ERROR_INPUT, "%s: sound does not travel at rest", name);
}

/* What follows from the constants of an explosive, as a comment of YAML. */
static struct error *print_explosive(const char *path)
{
    struct material_input input;
    TRY(library_read(path, &bolide_catalogue, &input));
    char *wrong = detonation_wrong(input.material);
    if (print_detonation("# computed from these values:\n#   ", "\n#   ", input.material) && wrong)
        printf("# warning: %s\n", wrong);
    free(wrong);
    library_release(&input);
    return NULL;
}

static struct error *print_file_of(const char *path)
{
    TRY(print_file(path));
    return print_explosive(path);
}

static struct error *print_material(const char *folder, const char *name, bool curves)
{
    char *path = library_file(&folder, 1, name);
    if (path) {
        struct error *error = curves ? print_curves_of(path, name) : print_file_of(path);
        free(path);
        return error;
    }
    char *text = library_unknown(&folder, 1, name);
    struct error *error = text ? error_new(ERROR_INPUT, "%s", text) : out_of_memory();
    free(text);
    return error;
}

int command_materials(const struct cli_options *options)
{
    char *folder = share_folder("materials");
    struct error *error;
    if (options->curves && !options->names.count)
        error = error_new(ERROR_INPUT, "materials: --curves needs the name of a material");
    else if (!folder)
        error = error_new(ERROR_INPUT, "no materials found; set BOLIDE_SHARE to the folder that "
                                       "holds examples/ and materials/");
    else if (options->names.count)
        error = print_material(folder, options->names.text[0], options->curves);
    else
        error = list_materials(folder);
    free(folder);
    return error ? report_error(error) : EXIT_OK;
}
