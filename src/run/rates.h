/* How fast runs were on this machine: a table of a row each kind of run, which the forecast of the
 * next one takes. It only saves guessing: one that is missing, damaged or cannot be written is no
 * error. Several processes may write it at the same time. */
#ifndef BOLIDE_RATES_H
#define BOLIDE_RATES_H

#include "case/case.h"

/* Updates a second of the last run at PATH (NULL: there is no table) that had the solver of INPUT
 * with these settings, its dimension and THREADS; of one with other settings or threads where there
 * is no such; NAN where there is none either. */
double rates_find(const char *path, const struct simulation_case *input, int threads);

/* Puts RATE into the table at PATH, whose folder is made where it is missing. */
void rates_store(const char *path, const struct simulation_case *input, int threads, double rate);

#endif
