/* The record of a case as a file; see record.h. */
#include "case/record.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "case/internal.h"

/* Other columns than these are not read here: scripts/figures shows them. */
enum { FORM, SETTINGS, RUN, CHECK, MEASURED, UNIT, COLUMNS = 11 };
static const char *const heads[COLUMNS] = {"form",     "settings", "run",    "check",
                                           "measured", "unit",     "wanted", "low",
                                           "high",     "verdict",  "note"};

/* The longest that comes with the program has a hundredth of it. */
enum { RECORD_BYTES_MAX = 1 << 24 };

char *record_path(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const size_t length = strlen(path);
    if (!strcmp(name, "case.yaml"))
        return text_format("%.*sresults.csv", (int)(name - path), path);
    const bool yaml = length > 5 && !strcmp(path + length - 5, ".yaml");
    return text_format("%.*s.results.csv", (int)(yaml ? length - 5 : length), path);
}

struct error *record_read(const char *file, struct csv *record)
{
    if (file_size(file) > RECORD_BYTES_MAX)
        return error_new(ERROR_INPUT,
                         "%s: not a record of a case: it has more than %d MB; remove the file or "
                         "restore it",
                         file, RECORD_BYTES_MAX >> 20);
    TRY(csv_read(file, record));
    for (int i = 0; i < COLUMNS && record->columns > 0; i++)
        if (strcmp(csv_head(record, i), heads[i]) != 0 || record->columns != COLUMNS) {
            csv_free(record);
            return error_new(
                ERROR_INPUT,
                "%s: not a record of a case: column %d must be \"%s\"; remove the file "
                "or restore it",
                file, i + 1, heads[i]);
        }
    return NULL;
}

bool record_is_of(const struct csv *record, int64_t row, const struct record_key *key)
{
    return !strcmp(csv_field(record, row, FORM), key->form) &&
           !strcmp(csv_field(record, row, SETTINGS), key->settings);
}

int64_t record_find(const struct csv *record, const struct record_key *key, const char *check)
{
    for (int64_t row = 0; row < record->rows; row++)
        if (record_is_of(record, row, key) && !strcmp(csv_field(record, row, RUN), key->run) &&
            !strcmp(csv_field(record, row, CHECK), check))
            return row;
    return -1;
}

struct error *record_begin(const char *file, FILE **stream)
{
    TRY(file_begin(file, stream));
    for (int i = 0; i < COLUMNS; i++)
        fprintf(*stream, "%s%c", heads[i], i < COLUMNS - 1 ? ',' : '\n');
    return NULL;
}

static void put_field(FILE *stream, const char *text)
{
    if (strpbrk(text, ",\"\n"))
        csv_put_text(stream, text);
    else
        fputs(text, stream);
}

void record_copy(FILE *stream, const struct csv *record, int64_t row)
{
    for (int i = 0; i < record->columns; i++) {
        put_field(stream, csv_field(record, row, i));
        putc(i < record->columns - 1 ? ',' : '\n', stream);
    }
}

/* What a record is asked for, and by whom. */
struct lookup {
    const struct simulation_case *input;
    const char *path, *map; /* of the case; "checks" or "fits" */
    struct csv record;
    struct record_key key;
};

static struct error *no_record(const struct lookup *lookup, const char *name)
{
    const char *form = lookup->key.form;
    char *at = text_format("%s.%s.regression_bound", lookup->map, name);
    const bool normal = !strcmp(form, "normal");
    struct error *error =
        at ? document_error(lookup->input->document, at,
                            "there is no record of this value%s%s%s: `bolide verify --record%s%s "
                            "%s` makes it",
                            normal ? "" : " in the ", normal ? "" : form, normal ? "" : " form",
                            normal ? "" : " --", normal ? "" : form, lookup->path)
           : out_of_memory_for("a record");
    free(at);
    return error;
}

/* Fills what CHECK, called NAME, compares with. */
static struct error *take_recorded(const struct lookup *lookup, const char *name,
                                   struct check_input *check)
{
    struct unit unit;
    if (isnan(check->regression_bound.value) || !isnan(check->recorded.value))
        return NULL;
    const int64_t row = record_find(&lookup->record, &lookup->key, name);
    const double value = row < 0 ? NAN : csv_number(&lookup->record, row, MEASURED);
    if (isnan(value))
        return no_record(lookup, name);
    TRY(unit_parse(csv_field(&lookup->record, row, UNIT), &unit));
    check->recorded = (struct quantity){.value = value, .dimension = unit.dimension};
    return NULL;
}

static struct error *take_all(struct simulation_case *input, struct lookup *lookup, const char *run)
{
    struct error *error = NULL;
    lookup->map = "checks";
    lookup->key.run = run;
    for (int i = 0; i < input->checks.count; i++)
        error =
            error_join(error, take_recorded(lookup, input->checks.names[i], case_check(input, i)));
    lookup->map = "fits";
    lookup->key.run = "fits";
    for (int i = 0; i < input->fits.count; i++)
        error = error_join(error,
                           take_recorded(lookup, input->fits.names[i], &case_fit(input, i)->check));
    return error;
}

static bool has_bounds(const struct simulation_case *input)
{
    for (int i = 0; i < input->checks.count; i++)
        if (!isnan(case_check(input, i)->regression_bound.value))
            return true;
    for (int i = 0; i < input->fits.count; i++)
        if (!isnan(case_fit(input, i)->check.regression_bound.value))
            return true;
    return false;
}

/* The case of a sweep runs with the values of one of its runs only. */
struct error *case_take_record(struct simulation_case *input, const char *path)
{
    if (!has_bounds(input) || (input->sweep_runs > 0 && input->sweep_values == 0))
        return NULL;
    struct lookup lookup = {.input = input, .path = path, .key = {input->form, "", ""}};
    char *file = record_path(path);
    char *run =
        input->sweep_values ? sweep_run_name(input->sweep, input->sweep_values) : text_copy("");
    struct error *error =
        file && run ? record_read(file, &lookup.record) : out_of_memory_for("a record");
    if (!error) {
        error = take_all(input, &lookup, run);
        csv_free(&lookup.record);
    }
    free(run);
    free(file);
    return error;
}
