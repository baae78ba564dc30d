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

struct error *record_check(const char *path)
{
    char *file = record_path(path);
    if (!file)
        return out_of_memory_for("a record");
    char *slash = strrchr(file, '/');
    const size_t length = slash ? (size_t)(slash - file) : 0;
    char *folder = slash ? text_copy_part(file, length ? length : 1) : text_copy(".");
    struct error *error =
        !folder ? out_of_memory_for("a record")
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

/* One row: what a check measured in one run. */
struct row {
    const char *form, *settings, *run, *check, *unit, *verdict;
    char measured[32], wanted[32], low[32], high[32], note[96];
};

/* Seven digits: more than any page shows, fewer than hide what changed in a comparison. */
static void number_text(double value, char text[static 32])
{
    if (isnan(value))
        snprintf(text, 32, "nan");
    else if (isinf(value))
        text[0] = 0;
    else
        snprintf(text, 32, "%.7g", value + 0.0); /* -0 is 0 */
}

static struct row row_of(const struct record_key *key, const struct check_result *result)
{
    static const char *const verdicts[] = {"failed", "", "known deviation", "passes now",
                                           "measured only"};
    struct row row = {.form = key->form,
                      .settings = key->settings,
                      .run = key->run,
                      .check = result->name,
                      .unit = result->unit,
                      .verdict = verdicts[result->verdict]};
    number_text(result->measured, row.measured);
    if (!isnan(result->wanted))
        number_text(result->wanted, row.wanted);
    number_text(result->low, row.low);
    number_text(result->high, row.high);
    if (result->regression_bound) {
        char bound[64] = "";
        check_bound_text(result, bound, sizeof bound);
        if (bound[0])
            snprintf(row.note, sizeof row.note, "regression bound %s", bound);
    }
    return row;
}

static void put_result(FILE *stream, const struct record_key *key,
                       const struct check_result *result)
{
    const struct row row = row_of(key, result);
    const char *const texts[] = {row.form, row.settings, row.run, row.check};
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        if (strpbrk(texts[i], ",\"\n"))
            csv_put_text(stream, texts[i]);
        else
            fputs(texts[i], stream);
        putc(',', stream);
    }
    fprintf(stream, "%s,%s,%s,%s,%s,%s,%s\n", row.measured, row.unit, row.wanted, row.low, row.high,
            row.verdict, row.note);
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
    TRY(record_read(file, &old));
    struct error *error = record_begin(file, &stream);
    if (!error) {
        for (int64_t row = 0; row < old.rows; row++)
            if (order_of_row(&old, row, key) < 0)
                record_copy(stream, &old, row);
        put_runs(stream, name, *key, runs, count);
        for (int64_t row = 0; row < old.rows; row++)
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
    struct error *error = file && settings ? write_record(file, name, &key, runs, count)
                                           : out_of_memory_for("a record");
    free(settings);
    free(file);
    return error;
}

/* Whether the numbers OLD and NOW of a record differ by no more than a unit of their last digit; of
 * measures without a unit also whether both are rounding errors, which cases limit to 1e-12. */
static bool are_equal(const char *old, const char *now, const char *unit)
{
    if (!strcmp(old, now))
        return true;
    char *end_of_old, *end_of_now;
    const double a = strtod(old, &end_of_old), b = strtod(now, &end_of_now);
    if (end_of_old == old || end_of_now == now || !isfinite(a) || !isfinite(b))
        return false;
    const double larger = maximum(fabs(a), fabs(b));
    return fabs(a - b) <= 1e-6 * larger || (!*unit && larger <= 1e-12);
}

/* How ROW differs from what RECORD has at line OLD (-1: nothing); NULL: not at all. */
static struct error *difference(const struct csv *record, int64_t old, const struct row *row,
                                const char *name)
{
    if (old < 0)
        return error_new(ERROR_CHECK, "%s: %s: %s %s, not in the record", name, row->check,
                         row->measured, row->unit);
    const char *measured = csv_field(record, old, csv_column(record, "measured")),
               *verdict = csv_field(record, old, csv_column(record, "verdict"));
    if (!are_equal(measured, row->measured, row->unit) ||
        strcmp(csv_field(record, old, csv_column(record, "unit")), row->unit) != 0)
        return error_new(ERROR_CHECK, "%s: %s: %s %s, recorded: %s", name, row->check,
                         row->measured, row->unit, measured);
    if (strcmp(verdict, row->verdict) != 0)
        return error_new(ERROR_CHECK, "%s: %s: %s, recorded: %s", name, row->check,
                         *row->verdict ? row->verdict : "passed", *verdict ? verdict : "passed");
    const char *const limits[][2] = {
        {"wanted", row->wanted}, {"low", row->low}, {"high", row->high}};
    for (size_t i = 0; i < COUNT_OF(limits); i++) {
        const char *limit = csv_field(record, old, csv_column(record, limits[i][0]));
        if (!are_equal(limit, limits[i][1], row->unit))
            return error_new(ERROR_CHECK, "%s: %s: %s is %s, recorded: %s", name, row->check,
                             limits[i][0], *limits[i][1] ? limits[i][1] : "not there",
                             *limit ? limit : "not there");
    }
    return NULL;
}

/* The differences of COUNT RUNS from RECORD; `matched` counts the rows of it that were found. */
static struct error *differences(const struct csv *record, struct record_key key, const char *name,
                                 const struct verify_case *runs, int count, int *differing,
                                 int64_t *matched)
{
    struct error *all = NULL;
    const size_t length = strlen(name);
    for (int i = 0; i < count; i++) {
        key.run = runs[i].name[length] == '/' ? runs[i].name + length + 1 : "";
        for (int k = 0; k < runs[i].result.checks.count; k++) {
            const struct row row = row_of(&key, &runs[i].result.checks.item[k]);
            const int64_t old = record_find(record, &key, row.check);
            struct error *error = difference(record, old, &row, runs[i].name);
            *matched += old >= 0;
            *differing += error != NULL;
            all = error_join(all, error);
        }
    }
    return all;
}

struct error *record_compare(const char *path, const char *name, const struct case_options *reading,
                             const struct verify_case *runs, int count)
{
    for (int i = 0; i < count; i++)
        if (runs[i].error) /* it has been reported */
            return NULL;
    if (count == 0)
        return NULL;
    char *file = record_path(path), *settings = settings_text(reading);
    const struct record_key key = {runs[0].form, settings, ""};
    struct csv record = {0};
    int differing = 0;
    int64_t rows = 0, matched = 0;
    struct error *error =
        file && settings ? record_read(file, &record) : out_of_memory_for("a record");
    if (!error) {
        for (int64_t row = 0; row < record.rows; row++)
            rows += record_is_of(&record, row, &key);
        error = differences(&record, key, name, runs, count, &differing, &matched);
        if (rows > matched)
            error = error_join(error, error_new(ERROR_CHECK,
                                                "%s: %lld recorded values are no "
                                                "longer measured",
                                                name, (long long)(rows - matched)));
        if (error)
            error = error_join(
                error_new(ERROR_CHECK,
                          "%s: %lld of %lld values differ from the record %s; `bolide verify "
                          "--record` with the same options renews it",
                          name, (long long)(differing + rows - matched), (long long)(rows), file),
                error);
        csv_free(&record);
    }
    free(settings);
    free(file);
    return error;
}
