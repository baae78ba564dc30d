/* The table of rates: solver, settings, models, dimension, threads, updates_per_second; see
 * rates.h. */
#include "run/rates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"

enum { SOLVER, SETTINGS, MODELS, DIMENSION, THREADS, RATE, COLUMNS };
static const char *const heads[COLUMNS] = {"solver",    "settings", "models",
                                           "dimension", "threads",  "updates_per_second"};

/* More than any user collects. */
enum { ROWS_MAX = 1000, BYTES_MAX = 1 << 20 };

/* A run of a kind; the texts are owned. */
struct key {
    const char *solver;
    char *settings, *models;
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

static void put_choice(FILE *file, const struct one_of *one_of)
{
    if (one_of->choice)
        fprintf(file, "%s ", one_of->choice->name);
}

/* The models of the materials, whose cost differs. */
static void put_models(FILE *file, const struct simulation_case *input)
{
    for (int i = 0; i < input->materials.count; i++) {
        const struct material_input *material = case_material(input, i);
        put_choice(file, &material->eos);
        put_choice(file, &material->strength);
        put_choice(file, &material->failure);
        put_choice(file, &material->burn);
    }
}

static void free_key(struct key *key)
{
    free(key->settings);
    free(key->models);
}

/* False when memory is out. */
static bool make_key(const struct simulation_case *input, int threads, struct key *key)
{
    size_t size;
    *key = (struct key){.solver = input->solver.choice->name,
                        .dimension = (int)input->dimension,
                        .threads = threads};
    FILE *settings = open_memstream(&key->settings, &size);
    FILE *models = open_memstream(&key->models, &size);
    if (settings)
        put_settings(settings, input->solver.choice->table, input->solver.value);
    if (models)
        put_models(models, input);
    bool made = settings && models;
    made = settings && !fclose(settings) && made;
    made = models && !fclose(models) && made;
    if (!made)
        free_key(key);
    return made;
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
 * rate more than models, and these more than threads, which it is taken in proportion to. */
static double distance(const struct csv *table, int64_t row, const struct key *key)
{
    const double threads = csv_number(table, row, THREADS), rate = csv_number(table, row, RATE);
    if (strcmp(csv_field(table, row, SOLVER), key->solver) != 0 ||
        csv_number(table, row, DIMENSION) != key->dimension || !(threads >= 1.0) || !(rate > 0.0) ||
        !isfinite(rate))
        return INFINITY;
    return (strcmp(csv_field(table, row, SETTINGS), key->settings) != 0 ? 100.0 : 0.0) +
           (strcmp(csv_field(table, row, MODELS), key->models) != 0 ? 10.0 : 0.0) +
           fabs(log(threads / key->threads));
}

double rates_find(const char *path, const struct simulation_case *input, int threads)
{
    struct csv table;
    struct key key;
    double nearest = INFINITY, rate = NAN;
    if (!make_key(input, threads, &key))
        return NAN;
    const bool there = read_rates(path, &table);
    for (int64_t row = 0; there && row < table.rows; row++) {
        const double far = distance(&table, row, &key);
        if (far >= nearest)
            continue;
        nearest = far;
        rate = csv_number(&table, row, RATE) * threads / csv_number(&table, row, THREADS);
    }
    if (there)
        csv_free(&table);
    free_key(&key);
    return rate;
}

static void put_row(FILE *file, const char *const *texts, double dimension, double threads,
                    double rate)
{
    for (int i = SOLVER; i <= MODELS; i++) {
        csv_put_text(file, texts[i]);
        putc(',', file);
    }
    fprintf(file, "%.0f,%.0f,%.6g\n", dimension, threads, rate);
}

/* The rows of TABLE, the one of KEY with RATE behind them. */
static void put_table(FILE *file, const struct csv *table, const struct key *key, double rate)
{
    for (int i = 0; i < COLUMNS; i++)
        fprintf(file, "%s%c", heads[i], i + 1 < COLUMNS ? ',' : '\n');
    const int64_t first = table->rows > ROWS_MAX ? table->rows - ROWS_MAX : 0;
    for (int64_t row = first; row < table->rows; row++) {
        const char *const texts[] = {csv_field(table, row, SOLVER), csv_field(table, row, SETTINGS),
                                     csv_field(table, row, MODELS)};
        if (distance(table, row, key) > 0.0)
            put_row(file, texts, csv_number(table, row, DIMENSION), csv_number(table, row, THREADS),
                    csv_number(table, row, RATE));
    }
    const char *const own[] = {key->solver, key->settings, key->models};
    put_row(file, own, key->dimension, key->threads, rate);
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
    struct key key;
    if (folder && !error && make_key(input, threads, &key)) {
        struct csv table;
        const bool there = read_rates(path, &table);
        replace_table(path, &table, &key, rate);
        if (there)
            csv_free(&table);
        free_key(&key);
    }
    error_free(error);
    free(folder);
}
