#include "study/statistics.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"
#include "study/sweep.h"

const char statistics_table_name[] = "statistics.csv";

/* Student's t at 97.5 % for so many degrees of freedom. Above 30 the expansion about the normal
 * distribution, Abramowitz and Stegun (1972), 26.7.5, which is right to four digits. */
static double student(int freedom)
{
    static const double table[] = {NAN,    12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646,
                                   2.3060, 2.2622,  2.2281, 2.2010, 2.1788, 2.1604, 2.1448, 2.1314,
                                   2.1199, 2.1098,  2.1009, 2.0930, 2.0860, 2.0796, 2.0739, 2.0687,
                                   2.0639, 2.0595,  2.0555, 2.0518, 2.0484, 2.0452, 2.0423};
    if (freedom < (int)COUNT_OF(table))
        return table[freedom];
    const double z = 1.959964, cubed = z * z * z;
    return z + (cubed + z) / (4.0 * freedom) +
           (5.0 * cubed * z * z + 16.0 * cubed + 3.0 * z) / (96.0 * freedom * freedom);
}

struct statistic statistic_of(const double *values, int count)
{
    struct statistic statistic = {count, NAN, NAN, NAN};
    double sum = 0.0, squares = 0.0;
    if (count == 0)
        return statistic;
    for (int i = 0; i < count; i++)
        sum += values[i];
    statistic.mean = sum / count;
    for (int i = 0; i < count; i++)
        squares += square(values[i] - statistic.mean);
    if (count > 1) {
        statistic.deviation = sqrt(squares / (count - 1));
        statistic.confidence = student(count - 1) * statistic.deviation / sqrt(count);
    }
    return statistic;
}

int repetitions_entry(const struct repetitions *repetitions)
{
    const struct verify_case *run = &repetitions->runs[0];
    for (int k = 0; k < run->sweep_values && repetitions->key; k++)
        if (!strcmp(run->sweep[k].key, repetitions->key))
            return run->sweep[k].entry;
    return -1;
}

bool repetitions_are_same(const struct repetitions *repetitions, int a, int b)
{
    const struct verify_case *one = &repetitions->runs[a], *other = &repetitions->runs[b];
    const int entry = repetitions_entry(repetitions);
    for (int k = 0; k < one->sweep_values; k++)
        if (one->sweep[k].entry != entry && strcmp(one->sweep[k].text, other->sweep[k].text) != 0)
            return false;
    return true;
}

/* Whether run I came to its end and repeats RUN. */
static bool counts(const struct repetitions *repetitions, int run, int i)
{
    return !repetitions->runs[i].error && repetitions_are_same(repetitions, run, i);
}

struct statistic repetitions_of_check(const struct repetitions *repetitions, int run,
                                      const char *name)
{
    double *values = memory_allocate((size_t)repetitions->count * sizeof *values);
    int count = 0;
    for (int i = 0; i < repetitions->count && values; i++) {
        const struct check_result *check = verify_find_check(&repetitions->runs[i], name);
        if (check && isfinite(check->measured) && counts(repetitions, run, i))
            values[count++] = check->measured;
    }
    const struct statistic statistic = statistic_of(values, count);
    free(values);
    return statistic;
}

static bool is_first(const struct repetitions *repetitions, int run)
{
    for (int i = 0; i < run; i++)
        if (repetitions_are_same(repetitions, i, run))
            return false;
    return true;
}

static void put_heads(FILE *file, const struct repetitions *repetitions,
                      const struct check_results *checks)
{
    static const char *const what[] = {" mean", " deviation", " confidence"};
    const struct verify_case *run = &repetitions->runs[0];
    for (int k = 0; k < run->sweep_values; k++)
        if (run->sweep[k].entry != repetitions_entry(repetitions)) {
            sweep_put_head(file, repetitions, k);
            fputc(',', file);
        }
    fputs("runs", file);
    for (int k = 0; k < checks->count; k++)
        for (size_t i = 0; i < COUNT_OF(what); i++) {
            fputc(',', file);
            csv_put_named_head(file, checks->item[k].name, what[i], checks->item[k].unit);
        }
    fputc('\n', file);
}

static void put_row(FILE *file, const struct repetitions *repetitions, int run,
                    const struct check_results *checks)
{
    const struct verify_case *item = &repetitions->runs[run];
    int runs = 0;
    for (int i = 0; i < repetitions->count; i++)
        runs += counts(repetitions, run, i);
    for (int k = 0; k < item->sweep_values; k++)
        if (item->sweep[k].entry != repetitions_entry(repetitions)) {
            sweep_put_value(file, repetitions, run, k);
            fputc(',', file);
        }
    fprintf(file, "%d", runs);
    for (int k = 0; k < checks->count; k++) {
        const struct statistic statistic =
            repetitions_of_check(repetitions, run, checks->item[k].name);
        csv_add_finite(file, statistic.mean);
        csv_add_finite(file, statistic.deviation);
        csv_add_finite(file, statistic.confidence);
    }
    fputc('\n', file);
}

static void put_table(FILE *file, const void *content)
{
    const struct repetitions *repetitions = content;
    const struct check_results *checks = sweep_checks(repetitions);
    put_heads(file, repetitions, checks);
    for (int run = 0; run < repetitions->count; run++)
        if (is_first(repetitions, run))
            put_row(file, repetitions, run, checks);
}

struct error *repetitions_write(const struct repetitions *repetitions, const char *folder)
{
    return file_write(folder, statistics_table_name, put_table, repetitions);
}
