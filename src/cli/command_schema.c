/* bolide schema: what a case file may hold, as JSON Schema. */
#include <stdio.h>

#include "case/schema.h"
#include "cli/cli.h"

int command_schema(const struct cli_options *options)
{
    (void)options;
    struct error *error = schema_write(stdout, &bolide_catalogue);
    return error ? report_error(error) : EXIT_OK;
}
