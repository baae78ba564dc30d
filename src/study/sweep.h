/* What the runs of a sweep come to together: a table, and a plot of each measured value over the
 * first of the swept ones. */
#ifndef BOLIDE_SWEEP_H
#define BOLIDE_SWEEP_H

#include "study/statistics.h"

/* The table's file in the folder of a sweep. */
extern const char sweep_table_name[];

/* The checks of the first run that has any: all runs have the same. */
const struct check_results *sweep_checks(const struct repetitions *sweep);

/* The unit of the swept value at INDEX where all runs have a quantity of one dimension; else
 * NULL. */
const char *sweep_unit(const struct repetitions *sweep, int index, char *buffer);

/* Writes the head of the column of the swept value at INDEX, and the value of RUN. */
void sweep_put_head(FILE *file, const struct repetitions *sweep, int index);
void sweep_put_value(FILE *file, const struct repetitions *sweep, int run, int index);

/* Writes the table of the runs into FOLDER, a row a run in SI units: the swept values, what each
 * check measured and its verdict, the verdict of the run; FITS, if there are any, as checks.csv;
 * and the table of repetitions. And FOLDER/pictures/CHECK.png for every check that measured
 * something in two runs: the measured values as dots, one series for each choice of the other swept
 * values, the limits behind them where there is one series only, and means of repetitions with
 * their confidence. */
struct error *sweep_write(const char *folder, const struct repetitions *sweep,
                          const struct check_results *fits);

#endif
