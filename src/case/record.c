/* The record of a case as a file; see record.h. */
#include "case/record.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"

/* Other columns than these are not read here: scripts/figures shows them. */
enum { FORM, SETTINGS, RUN, CHECK, MEASURED, COLUMNS = 11 };
static const char *const heads[COLUMNS] = {"form",     "settings", "run",    "check",
                                           "measured", "unit",     "wanted", "low",
                                           "high",     "verdict",  "note"};

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

double record_find(const struct csv *record, const struct record_key *key, const char *check)
{
    for (int64_t row = 0; row < record->rows; row++)
        if (record_is_of(record, row, key) && !strcmp(csv_field(record, row, RUN), key->run) &&
            !strcmp(csv_field(record, row, CHECK), check))
            return csv_number(record, row, MEASURED);
    return NAN;
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
