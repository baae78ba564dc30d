/* The table of rates: solver, settings, dimension, threads, updates_per_second; see rates.h. */
#include "run/rates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"

enum { SOLVER, SETTINGS, DIMENSION, THREADS, RATE, COLUMNS };
static const char *const heads[COLUMNS] = {"solver", "settings", "dimension", "threads",
                                           "updates_per_second"};

/* More than any user collects. */
enum { ROWS_MAX = 1000, BYTES_MAX = 1 << 20 };

/* A run of a kind; the texts are owned. */
struct key {
    const char *solver;
    char *settings;
    int dimension, threads;
};

/* The values of TABLE that choose what is computed, as "key=name " each. */
static void put_settings(FILE *file, const struct parameter *table, const void *values)
{
    for (const struct parameter *p = table; p && !PARAMETER_IS_END(p); p++) {
        const void *value = (const char *)values + p->offset;
        const char *key = p->key ? p->key : p->kind_of_thing;
        if (p->kind == PARAMETER_TABLE)
            put_settings(file, p->table, value);
        else if (p->kind == PARAMETER_CHOICE && *(const int *)value >= 0)
            fprintf(file, "%s=%s ", key, p->names[*(const int *)value]);
        else if (p->kind == PARAMETER_INTEGER)
            fprintf(file, "%s=%lld ", key, (long long)*(const int64_t *)value);
        else if (p->kind == PARAMETER_FLAG)
            fprintf(file, "%s=%d ", key, *(const bool *)value);
        else if (p->kind == PARAMETER_ONE_OF && ((const struct one_of *)value)->choice) {
            const struct one_of *one_of = value;
            fprintf(file, "%s=%s ", key, one_of->choice->name);
            if (one_of->value)
                put_settings(file, one_of->choice->table, one_of->value);
        }
    }
}

static struct key key_of(const struct simulation_case *input, int threads)
{
    size_t size;
    struct key key = {input->solver.choice->name, NULL, (int)input->dimension, threads};
    FILE *file = open_memstream(&key.settings, &size);
    if (file) {
        put_settings(file, input->solver.choice->table, input->solver.value);
        if (fclose(file)) {
            free(key.settings);
            key.settings = NULL;
        }
    }
    return key;
}

/* Fills *TABLE from PATH; false where that is no table of rates. */
static bool read_rates(const char *path, struct csv *table)
{
    *table = (struct csv){0};
    if (!path || file_size(path) == 0 || file_size(path) > BYTES_MAX)
        return false;
    struct error *error = csv_read(path, table);
    bool right = !error && table->columns == COLUMNS;
    for (int i = 0; i < COLUMNS && right; i++)
        right = !strcmp(csv_head(table, i), heads[i]);
    error_free(error);
    if (!right) {
        csv_free(table);
        *table = (struct csv){0};
    }
    return right;
}

/* How far ROW is from KEY: 0 it is that, INFINITY it says nothing about it. Settings change the
 * rate more than threads, which it is taken in proportion to. */
static double distance(const struct csv *table, int64_t row, const struct key *key)
{
    const double threads = csv_number(table, row, THREADS), rate = csv_number(table, row, RATE);
    if (strcmp(csv_field(table, row, SOLVER), key->solver) != 0 ||
        csv_number(table, row, DIMENSION) != key->dimension || !(threads >= 1.0) || !(rate > 0.0) ||
        !isfinite(rate))
        return INFINITY;
    return (strcmp(csv_field(table, row, SETTINGS), key->settings) != 0 ? 100.0 : 0.0) +
           fabs(log(threads / key->threads));
}

double rates_find(const char *path, const struct simulation_case *input, int threads)
{
    struct csv table;
    struct key key = key_of(input, threads);
    double nearest = INFINITY, rate = NAN;
    const bool there = key.settings && read_rates(path, &table);
    for (int64_t row = 0; there && row < table.rows; row++) {
        const double far = distance(&table, row, &key);
        if (far >= nearest)
            continue;
        nearest = far;
        rate = csv_number(&table, row, RATE) * threads / csv_number(&table, row, THREADS);
    }
    if (there)
        csv_free(&table);
    free(key.settings);
    return rate;
}

static void put_row(FILE *file, const char *solver, const char *settings, double dimension,
                    double threads, double rate)
{
    csv_put_text(file, solver);
    putc(',', file);
    csv_put_text(file, settings);
    fprintf(file, ",%.0f,%.0f,%.6g\n", dimension, threads, rate);
}

/* The rows of TABLE, the one of KEY with RATE behind them. */
static void put_table(FILE *file, const struct csv *table, const struct key *key, double rate)
{
    for (int i = 0; i < COLUMNS; i++)
        fprintf(file, "%s%c", heads[i], i + 1 < COLUMNS ? ',' : '\n');
    const int64_t first = table->rows > ROWS_MAX ? table->rows - ROWS_MAX : 0;
    for (int64_t row = first; row < table->rows; row++)
        if (distance(table, row, key) > 0.0)
            put_row(file, csv_field(table, row, SOLVER), csv_field(table, row, SETTINGS),
                    csv_number(table, row, DIMENSION), csv_number(table, row, THREADS),
                    csv_number(table, row, RATE));
    put_row(file, key->solver, key->settings, key->dimension, key->threads, rate);
}

/* A file of this process alone takes the place of the table at once: of several that write at the
 * same time the last one stays, whole. */
static void replace_table(const char *path, const struct csv *table, const struct key *key,
                          double rate)
{
    char *own = text_format("%s.XXXXXX", path);
    const int descriptor = own ? mkstemp(own) : -1;
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "w") : NULL;
    if (file)
        put_table(file, table, key, rate);
    else if (descriptor >= 0)
        close(descriptor);
    bool written = file && !ferror(file);
    if (file)
        written = !fclose(file) && written;
    if (descriptor >= 0 && (!written || rename(own, path)))
        unlink(own);
    free(own);
}

void rates_store(const char *path, const struct simulation_case *input, int threads, double rate)
{
    const char *slash = path ? strrchr(path, '/') : NULL;
    if (!slash || !(rate > 0.0) || !isfinite(rate))
        return;
    char *folder = text_copy_part(path, (size_t)(slash - path));
    struct error *error = folder ? folder_make(folder) : NULL;
    struct key key = key_of(input, threads);
    struct csv table;
    const bool there = read_rates(path, &table);
    if (!error && key.settings)
        replace_table(path, &table, &key, rate);
    if (there)
        csv_free(&table);
    error_free(error);
    free(key.settings);
    free(folder);
}
