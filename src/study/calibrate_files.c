/* The files of a calibration; see calibrate.h. */
#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"
#include "output/report.h"
#include "page/page.h"
#include "study/calibrate.h"

const char calibrate_table_name[] = "calibrate.csv";

enum { VALUE_TEXT = 64, VALUE_DIGITS = 9 };

char *calibrate_run_folder(const struct calibration *c, int index)
{
    return text_format("%s/run-%02d", c->folder, index + 1);
}

static int keys_of(const struct calibration *c) { return c->input->calibrate.keys.count; }

static const char *key_name(const struct calibration *c, int k)
{
    return c->input->calibrate.keys.names[k];
}

static void put_head(FILE *file, const struct calibration *c)
{
    char unit[DIMENSION_TEXT];
    fputs("run", file);
    for (int k = 0; k < keys_of(c); k++) {
        fputc(',', file);
        csv_put_named_head(file, key_name(c, k), "", calibrated_unit(c, k, unit));
    }
    for (int v = 0; v < c->values; v++) {
        fputc(',', file);
        csv_put_named_head(file, c->value[v].name, "", c->value[v].unit);
    }
    fputs(",misfit,folder,verdict\n", file);
}

static void put_runs(FILE *file, const void *content)
{
    const struct calibration *c = content;
    put_head(file, c);
    for (int i = 0; i < c->runs; i++) {
        const struct calibrated_run *run = &c->run[i];
        fprintf(file, "%d", i + 1);
        for (int k = 0; k < keys_of(c); k++) {
            fputc(',', file);
            csv_put_number(file, run->key[k]);
        }
        for (int v = 0; v < c->values; v++) {
            fputc(',', file);
            if (!run->failure)
                csv_put_number(file, run->measured[v]);
        }
        fputc(',', file);
        if (!run->failure)
            csv_put_number(file, run->sum / c->values);
        fprintf(file, ",run-%02d,", i + 1);
        csv_put_text(file, run->failure ? run->failure : "done");
        fputc('\n', file);
    }
}

struct error *calibrate_write_runs(const struct calibration *c)
{
    return file_write(c->folder, calibrate_table_name, put_runs, c);
}

/* Whether the table has the columns that the runs of C have. */
static bool same_head(const struct csv *csv, const struct calibration *c)
{
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return false;
    put_head(file, c);
    if (fclose(file))
        return false;
    bool same = true;
    int column = 0;
    for (const char *at = text; *at && same; column++) {
        const bool quoted = *at == '"';
        const char *name = csv_head(csv, column);
        const size_t length = quoted ? strcspn(++at, "\"") : strcspn(at, ",\n");
        same = strlen(name) == length && !strncmp(name, at, length);
        at += length + quoted;
        at += *at == ',' || *at == '\n';
    }
    free(text);
    return same && column == csv->columns;
}

/* Takes row ROW as the next run, for which there is room. */
static struct error *take_row(struct calibration *c, const struct csv *csv, int64_t row)
{
    struct calibrated_run *run = &c->run[c->runs];
    *run = (struct calibrated_run){
        .sum = INFINITY,
        .measured = memory_allocate((size_t)(c->values + 1) * sizeof(double)),
        .residual = memory_allocate((size_t)(c->residuals + 1) * sizeof(double))};
    c->runs++;
    if (!run->measured || !run->residual)
        return out_of_memory();
    const char *verdict = csv_field(csv, row, csv->columns - 1);
    int column = 1;
    for (int k = 0; k < keys_of(c); k++)
        run->key[k] = csv_number(csv, row, column++);
    if (strcmp(verdict, "done") != 0) {
        run->failure = text_copy(verdict);
        return run->failure ? NULL : out_of_memory();
    }
    run->sum = 0.0;
    for (int v = 0; v < c->values; v++) {
        char *folder = calibrate_computation_folder(c, c->runs - 1, c->value[v].computation);
        run->measured[v] = csv_number(csv, row, column++);
        struct error *error = folder ? calibrate_residuals(c, v, folder, run) : out_of_memory();
        free(folder);
        TRY(error);
        run->sum += square(calibrated_misfit(c, v, run));
    }
    return NULL;
}

struct error *calibrate_read_runs(struct calibration *c)
{
    struct csv csv = {0};
    char *path = path_join(c->folder, calibrate_table_name);
    struct error *error = path ? csv_read(path, &csv) : out_of_memory();
    if (!error && csv.columns && !same_head(&csv, c))
        error = error_new(ERROR_INPUT,
                          "%s: this calibration had other keys or targets: begin it anew with "
                          "--overwrite",
                          path);
    if (!error && csv.rows > 0) {
        c->run = memory_allocate((size_t)csv.rows * sizeof *c->run);
        if (!c->run)
            error = out_of_memory();
    }
    for (int64_t row = 0; row < csv.rows && !error; row++)
        error = take_row(c, &csv, row);
    csv_free(&csv);
    free(path);
    return error;
}

static void put_keys(FILE *file, const void *content)
{
    const struct calibration *c = content;
    fputs("key,value,deviation,from,to,unit", file);
    for (int k = 0; k < keys_of(c); k++) {
        fputc(',', file);
        csv_put_named_head(file, "correlation with ", key_name(c, k), "");
    }
    fputs(",note\n", file);
    for (int k = 0; k < keys_of(c); k++) {
        char unit[DIMENSION_TEXT], *note = calibrated_note(c, k);
        csv_put_text(file, key_name(c, k));
        fputc(',', file);
        csv_put_number(file, calibrated_value_of(c, k));
        csv_add_finite(file, calibrated_deviation(c, k));
        csv_add_finite(file, case_calibrated(c->input, k)->from.value);
        csv_add_finite(file, case_calibrated(c->input, k)->to.value);
        fprintf(file, ",%s", calibrated_unit(c, k, unit));
        for (int other = 0; other < keys_of(c); other++)
            csv_add_finite(file, other == k ? 1.0 : calibrated_correlation(c, k, other));
        fputc(',', file);
        csv_put_text(file, note);
        fputc('\n', file);
        free(note);
    }
}

static void put_targets(FILE *file, const void *content)
{
    const struct calibration *c = content;
    const struct calibrated_run *best = &c->run[c->best];
    fputs("target,measured,computed,deviation,misfit,unit\n", file);
    for (int v = 0; v < c->values; v++) {
        const struct calibrated_value *value = &c->value[v];
        csv_put_text(file, value->name);
        csv_add_finite(file, value->is);
        csv_add_finite(file, isnan(value->is) ? (double)NAN : best->measured[v]);
        csv_add_finite(file, value->deviation);
        csv_add_finite(file, calibrated_misfit(c, v, best));
        fprintf(file, ",%s\n", value->unit);
    }
}

/* The part of PATH at DEPTH, and its length. */
static const char *part_of(const char *path, int depth, size_t *length)
{
    for (; depth > 0; depth--)
        path += strcspn(path, ".") + 1;
    *length = strcspn(path, ".");
    return path;
}

static bool same_part(const char *a, const char *b, int depth)
{
    size_t one, other;
    const char *first = part_of(a, depth, &one), *second = part_of(b, depth, &other);
    return one == other && !strncmp(first, second, one);
}

/* Writes as a map the keys of MEMBERS, whose paths are the same up to DEPTH. */
static void put_map(FILE *file, const struct calibration *c, const bool *members, int depth)
{
    bool done[CALIBRATED_KEYS_MAX] = {false};
    for (int k = 0; k < keys_of(c); k++) {
        bool inside[CALIBRATED_KEYS_MAX] = {false};
        if (!members[k] || done[k])
            continue;
        for (int other = k; other < keys_of(c); other++)
            if (members[other] && same_part(c->path[k], c->path[other], depth))
                inside[other] = done[other] = true;
        size_t length;
        const char *part = part_of(c->path[k], depth, &length);
        fprintf(file, "%*s\"%.*s\":", 2 * depth, "", (int)length, part);
        if (part[length] == '.') {
            fputc('\n', file);
            put_map(file, c, inside, depth + 1);
            continue;
        }
        char unit[DIMENSION_TEXT], value[VALUE_TEXT], deviation[VALUE_TEXT];
        calibrated_unit(c, k, unit);
        readable_digits(calibrated_value_of(c, k), unit, VALUE_DIGITS, value, sizeof value);
        const struct calibrated_key *key = case_calibrated(c->input, k);
        if (calibrated_deviation(c, k) <= key->to.value - key->from.value)
            readable(calibrated_deviation(c, k), unit, deviation, sizeof deviation);
        else
            snprintf(deviation, sizeof deviation, "more than its range");
        fprintf(file, " %s # +- %s\n", value, deviation);
    }
}

static void put_include(FILE *file, const void *content)
{
    const struct calibration *c = content;
    bool all[CALIBRATED_KEYS_MAX];
    for (int k = 0; k < keys_of(c); k++)
        all[k] = true;
    fprintf(file,
            "# Calibrated, mean square misfit %.4g. Use: include: [case.yaml, calibrated.yaml]\n",
            c->run[c->best].sum / c->values);
    put_map(file, c, all, 0);
}

struct error *calibrate_write_result(const struct calibration *c)
{
    TRY(file_write(c->folder, "calibrate-keys.csv", put_keys, c));
    TRY(file_write(c->folder, "calibrate-targets.csv", put_targets, c));
    TRY(file_write(c->folder, "calibrated.yaml", put_include, c));
    return page_write(c->folder);
}
