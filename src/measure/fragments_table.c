/* Fragments as a field and as a table; see fragments.h. */
#include <stdio.h>
#include <string.h>

#include "base/csv.h"
#include "base/file.h"
#include "measure/fragments.h"
#include "measure/spin.h"

const char fragments_column[] = "fragment";

static void compute_number(const struct population *population, int64_t begin, int64_t end,
                           double *out)
{
    for (int64_t i = begin; i < end; i++)
        *out++ = (double)(population->fragment[i] + 1);
}

struct population fragments_show(const struct population *population,
                                 const struct fragments *fragments,
                                 struct column columns[COLUMNS_MAX])
{
    struct population shown = *population;
    assert(population->columns < COLUMNS_MAX);
    memcpy(columns, population->column, (size_t)population->columns * sizeof *columns);
    columns[shown.columns++] =
        (struct column){.name = fragments_column,
                        .unit = "",
                        .help = "number of the fragment, from 1, heaviest first; 0: dust",
                        .components = 1,
                        .field = -1,
                        .compute = compute_number};
    shown.column = columns;
    shown.fragment = fragments ? fragments->of_member : NULL;
    return shown;
}

static const char axis_names[] = "xyz";

static void put_heads(FILE *file, const char *name, const char *unit, int first, int count)
{
    for (int k = first; k < first + count; k++) {
        char text[32];
        snprintf(text, sizeof text, "%s.%c", name, axis_names[k]);
        putc(',', file);
        csv_put_head(file, text, unit);
    }
}

static void put_numbers(FILE *file, const double *value, int first, int count)
{
    for (int k = first; k < first + count; k++) {
        putc(',', file);
        csv_put_number(file, value[k]);
    }
}

/* How many axes a fragment turns about: a ring of axisymmetry about none. */
static int turns_of(const struct problem *problem)
{
    return problem->geometry == GEOMETRY_AXISYMMETRIC ? 0 : spin_count(problem->dimension);
}

static void put_row(FILE *file, const struct problem *problem, const struct fragment *fragment)
{
    const int dimension = problem->dimension;
    const double width[3] = {fragment->high[0] - fragment->low[0],
                             fragment->high[1] - fragment->low[1],
                             fragment->high[2] - fragment->low[2]};
    putc(',', file);
    csv_put_text(file, fragment->body < 0 ? "" : problem->input->bodies.names[fragment->body]);
    fprintf(file, ",%lld,", (long long)fragment->particles);
    csv_put_number(file, fragment->mass);
    put_numbers(file, &fragment->size, 0, 1);
    put_numbers(file, fragment->center, 0, dimension);
    put_numbers(file, fragment->velocity, 0, dimension);
    put_numbers(file, fragment->spin, spin_first(dimension), turns_of(problem));
    put_numbers(file, width, 0, dimension);
    putc('\n', file);
}

struct error *fragments_write(const char *path, const struct simulation *simulation,
                              const struct fragments *fragments)
{
    const struct problem *problem = simulation->problem;
    const int dimension = problem->dimension;
    FILE *file;
    TRY(file_begin(path, &file));
    fputs("fragment,body,particles,", file);
    csv_put_head(file, "mass", ledger_unit(LEDGER_MASS, dimension, problem->geometry));
    fputs(",size [m]", file);
    put_heads(file, "position", "m", 0, dimension);
    put_heads(file, "velocity", "m/s", 0, dimension);
    put_heads(file, "spin", "rad/s", spin_first(dimension), turns_of(problem));
    put_heads(file, "width", "m", 0, dimension);
    putc('\n', file);
    for (int64_t k = 0; k < fragments->count; k++) {
        fprintf(file, "%lld", (long long)k + 1);
        put_row(file, problem, &fragments->item[k]);
    }
    if (fragments->dust.particles > 0) {
        struct fragment dust = fragments->dust;
        dust.size = NAN;
        for (int k = 0; k < 3; k++)
            dust.spin[k] = dust.low[k] = dust.high[k] = NAN;
        fputs("dust", file);
        put_row(file, problem, &dust);
    }
    return file_end(path, file);
}
