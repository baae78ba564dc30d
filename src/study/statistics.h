/* Repetitions: runs of a sweep that differ in one key alone, such as the seed of a packing. Their
 * values are taken for independent and normally distributed. */
#ifndef BOLIDE_STATISTICS_H
#define BOLIDE_STATISTICS_H

#include "study/verify.h"

/* The table's file in the folder of a sweep. */
extern const char statistics_table_name[];

struct statistic {
    int count;
    double mean;       /* NAN: of nothing */
    double deviation;  /* from the sample, with count - 1; NAN: of one value */
    double confidence; /* half the width of the 95 % confidence interval of the mean, by Student */
};

struct statistic statistic_of(const double *values, int count);

/* A series of runs and the key in which they are repetitions. */
struct repetitions {
    const struct verify_case *runs;
    int count;
    const char *key; /* NULL: there are none */
};

/* The entry of the sweep with the key; -1: there are no repetitions. */
int repetitions_entry(const struct repetitions *repetitions);

/* Whether the two runs differ in the key alone. */
bool repetitions_are_same(const struct repetitions *repetitions, int a, int b);

/* The statistic of what the check NAME measured in the runs that are the same as RUN. */
struct statistic repetitions_of_check(const struct repetitions *repetitions, int run,
                                      const char *name);

/* Writes the table into FOLDER, a row for each group of runs that are the same, in SI units: the
 * swept values, the number of runs, and of each check the mean, deviation and confidence. */
struct error *repetitions_write(const struct repetitions *repetitions, const char *folder);

#endif
