/* bolide report: results folders as pages. */
#include <stdio.h>
#include <stdlib.h>

#include "base/file.h"
#include "cli/cli.h"
#include "page/page.h"

static struct error *report_folder(const char *folder)
{
    TRY(page_write(folder));
    char *path = path_join(folder, "report.html");
    if (!path)
        return out_of_memory();
    printf("%s\n", path);
    free(path);
    return NULL;
}

int command_report(const struct cli_options *options)
{
    struct error *error = NULL;
    for (int i = 0; i < options->names.count; i++)
        error = error_join(error, report_folder(options->names.text[i]));
    return error ? report_error(error) : EXIT_OK;
}
