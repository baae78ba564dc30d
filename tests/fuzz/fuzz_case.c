/* The reader of cases under libFuzzer: whatever the bytes, it returns a case or an error and gives
 * all memory back. What stands behind a first zero byte is a setting as of --set. A case that is
 * right is looked at as a run does before it makes particles, and read again as a run of its sweep,
 * and as the program would write it, which must be right too. */
#define _GNU_SOURCE /* memfd_create */
#include <sys/mman.h>
#include <unistd.h>

#include "case/case.h"
#include "fuzz.h"
#include "run/catalogue.h"
#include "run/run.h"
#include "source_folder.h"

static const char *const library_paths[] = {materials_folder};

/* Every message of an error says something. */
static void look_at(struct error *error)
{
    for (int i = 0; error && i < error_count(error); i++)
        insist(error_message(error, i)[0], "an empty message");
    error_free(error);
}

/* Reads the file behind DESCRIPTOR; NULL when it is no case. */
static struct simulation_case *read_case(int descriptor, struct case_options options, bool must_be)
{
    char path[64];
    snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    options.library_paths = library_paths;
    options.library_count = COUNT_OF(library_paths);
    struct simulation_case *input = NULL;
    struct error *error = case_read(path, &options, &bolide_catalogue, &input);
    insist(!error == !!input, "neither a case nor an error, or both");
    insist(!must_be || !error, error ? error_message(error, 0) : "");
    look_at(error);
    return input;
}

/* INPUT as the program writes it beside its results, read again. */
static void read_as_written(const struct simulation_case *input)
{
    int descriptor = memfd_create("written", MFD_CLOEXEC);
    FILE *file = fdopen(descriptor, "wb");
    insist(file, "no file in memory");
    struct error *error = case_write(input, file);
    insist(!error && !fflush(file), "a case cannot be written");
    case_free(read_case(descriptor, (struct case_options){0}, true));
    fclose(file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const forms[] = {NULL, "short", "long"};
    const uint8_t *zero = memchr(data, '\0', size);
    size_t length = zero ? (size_t)(zero - data) : size;
    char *setting = zero ? strndup((const char *)zero + 1, size - length - 1) : NULL;
    const char *const settings[] = {setting};
    struct case_options options = {
        .settings = settings, .setting_count = zero != NULL, .form = forms[size % 3]};

    int descriptor = memfd_create("case", MFD_CLOEXEC);
    insist(write(descriptor, data, length) == (ssize_t)length, "no file in memory");
    struct simulation_case *input = read_case(descriptor, options, false);
    if (input) {
        look_at(run_validate(input));
        read_as_written(input);
        options.sweep_run = input->sweep_runs;
        if (options.sweep_run)
            case_free(read_case(descriptor, options, false));
    }
    case_free(input);
    close(descriptor);
    free(setting);
    return 0;
}
