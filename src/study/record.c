/* What cases measured, stored beside them; see record.h. */
#include "study/record.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"
#include "case/record.h"

static struct error *out_of_memory(void)
{
    return error_new(ERROR_SYSTEM, "out of memory for a record");
}

struct error *record_check(const char *path)
{
    char *file = record_path(path);
    if (!file)
        return out_of_memory();
    char *slash = strrchr(file, '/');
    const size_t length = slash ? (size_t)(slash - file) : 0;
    char *folder = slash ? text_copy_part(file, length ? length : 1) : text_copy(".");
    struct error *error =
        !folder ? out_of_memory()
        : access(folder, W_OK) != 0
            ? error_new(ERROR_SYSTEM,
                        "%s: the record cannot be written here: %s; copy the case "
                        "to a folder of your own",
                        file, strerror(errno))
            : NULL;
    free(folder);
    free(file);
    return error;
}

/* The settings joined by blanks, in the order in which they were given. */
static char *settings_text(const struct case_options *reading)
{
    char *text = text_copy("");
    for (int i = 0; i < reading->setting_count && text; i++) {
        char *longer = text_format("%s%s%s", text, i ? " " : "", reading->settings[i]);
        free(text);
        text = longer;
    }
    return text;
}

/* Seven digits: more than any page shows, fewer than hide what changed in a comparison. */
static void put_number(FILE *stream, double value)
{
    if (isnan(value))
        fputs("nan,", stream);
    else if (isinf(value))
        putc(',', stream);
    else
        fprintf(stream, "%.7g,", value + 0.0); /* -0 is 0 */
}

static void put_result(FILE *stream, const struct record_key *key,
                       const struct check_result *result)
{
    static const char *const verdicts[] = {"failed", "", "known deviation", "passes now",
                                           "measured only"};
    const char *const texts[] = {key->form, key->settings, key->run, result->name};
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        if (strpbrk(texts[i], ",\"\n"))
            csv_put_text(stream, texts[i]);
        else
            fputs(texts[i], stream);
        putc(',', stream);
    }
    put_number(stream, result->measured);
    fprintf(stream, "%s,", result->unit);
    if (isnan(result->wanted))
        putc(',', stream);
    else
        put_number(stream, result->wanted);
    put_number(stream, result->low);
    put_number(stream, result->high);
    char bound[64] = "";
    if (result->regression_bound)
        check_bound_text(result, bound, sizeof bound);
    fprintf(stream, "%s,%s%s\n", verdicts[result->verdict], bound[0] ? "regression bound " : "",
            bound);
}

/* Normal, short, long; of one form first the case as it is, then in the order of the settings. */
static int order(const char *form, const char *settings, const struct record_key *key)
{
    static const char *const forms[] = {"normal", "short", "long"};
    int a = 0, b = 0;
    while (a < (int)COUNT_OF(forms) && strcmp(forms[a], form) != 0)
        a++;
    while (b < (int)COUNT_OF(forms) && strcmp(forms[b], key->form) != 0)
        b++;
    return a != b ? a - b : strcmp(settings, key->settings);
}

static int order_of_row(const struct csv *old, int64_t row, const struct record_key *key)
{
    return order(csv_field(old, row, csv_column(old, "form")),
                 csv_field(old, row, csv_column(old, "settings")), key);
}

/* KEY's run is that of each of RUNS: what stands behind NAME. */
static void put_runs(FILE *stream, const char *name, struct record_key key,
                     const struct verify_case *runs, int count)
{
    const size_t length = strlen(name);
    for (int i = 0; i < count; i++) {
        key.run = runs[i].name[length] == '/' ? runs[i].name + length + 1 : "";
        for (int k = 0; k < runs[i].result.checks.count; k++)
            put_result(stream, &key, &runs[i].result.checks.item[k]);
    }
}

static struct error *write_record(const char *file, const char *name, const struct record_key *key,
                                  const struct verify_case *runs, int count)
{
    struct csv old = {0};
    FILE *stream;
    int64_t row = 0;
    TRY(record_read(file, &old));
    struct error *error = record_begin(file, &stream);
    if (!error) {
        for (; row < old.rows && order_of_row(&old, row, key) < 0; row++)
            record_copy(stream, &old, row);
        put_runs(stream, name, *key, runs, count);
        for (; row < old.rows; row++)
            if (order_of_row(&old, row, key) > 0)
                record_copy(stream, &old, row);
        error = file_end(file, stream);
    }
    csv_free(&old);
    return error;
}

struct error *record_store(const char *path, const char *name, const struct case_options *reading,
                           const struct verify_case *runs, int count)
{
    for (int i = 0; i < count; i++)
        if (runs[i].error) /* it has been reported; half a case is no record */
            return NULL;
    if (count == 0)
        return NULL;
    char *file = record_path(path), *settings = settings_text(reading);
    const struct record_key key = {runs[0].form, settings, ""};
    struct error *error =
        file && settings ? write_record(file, name, &key, runs, count) : out_of_memory();
    free(settings);
    free(file);
    return error;
}
