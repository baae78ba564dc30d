/* bolide compare: several runs and measurements in one page. */
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "page/compare.h"

static void print_line(void *context, const char *text)
{
    (void)context;
    printf("%s\n", text);
}

int command_compare(const struct cli_options *options)
{
    const int count = options->data.count;
    struct compare_data *data = calloc((size_t)count + 1, sizeof *data);
    struct error *error = data ? NULL : out_of_memory();
    const struct compare_request request = {.runs = options->names.count,
                                            .folder = options->names.text,
                                            .data = count,
                                            .measured = data,
                                            .output = options->output ? options->output : "compare",
                                            .line = print_line};
    for (int i = 0; i < count && !error; i++)
        error = compare_data_read(options->data.text[i], &data[i]);
    if (!error)
        error = compare_write(&request);
    if (!error)
        printf("%s/compare.html\n", request.output);
    for (int i = 0; data && i < count; i++)
        compare_data_free(&data[i]);
    free(data);
    return error ? report_error(error) : EXIT_OK;
}
