/* What the runs of a sweep come to together: a table, and a plot of each measured value over the
 * first of the swept ones. */
#ifndef BOLIDE_SWEEP_H
#define BOLIDE_SWEEP_H

#include "study/verify.h"

/* The table's file in the folder of a sweep. */
extern const char sweep_table_name[];

/* Writes the table of the COUNT runs into FOLDER, a row a run in SI units: the swept values, what
 * each check measured and its verdict, the verdict of the run; and FITS, if there are any, as
 * checks.csv. And FOLDER/pictures/CHECK.png for every check that measured something in two runs:
 * the measured values as dots, one series for each choice of the other swept values, and the limits
 * behind them where there is one series only. */
struct error *sweep_write(const char *folder, const struct verify_case *runs, int count,
                          const struct check_results *fits);

#endif
