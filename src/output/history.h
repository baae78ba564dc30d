/* history.csv: one row a moment with energies, momentum, ledger and extremes; column names carry
 * units. */
#ifndef BOLIDE_HISTORY_H
#define BOLIDE_HISTORY_H

#include "base/csv.h"
#include "model/simulation.h"

struct history;

/* Starts the table at PATH, NULL for a rank that writes none; with KEEP > 0 goes on after the
 * first KEEP rows of an interrupted run, which are those of MARK (NULL: any). */
struct error *history_open(const char *path, int64_t keep, const struct csv_mark *mark,
                           struct history **history);

/* Collective. One row: time, step, dt, count, mass, momentum, angular momentum, kinetic, internal
 * and total energy, relative energy drift (ledger counted), the ledger's causes, smallest and
 * largest density, pressure and speed, and the impulse that each load has delivered and that it
 * should have. START are the totals at time zero, NOW those of the row. Rows reach the disk at
 * once. */
struct error *history_row(struct history *history, const struct simulation *simulation, double dt,
                          const struct totals *now, const struct totals *start);

/* What a checkpoint must know of the rows up to now. */
struct error *history_mark(struct history *history, struct csv_mark *mark);

int64_t history_rows(const struct history *history);
struct error *history_close(struct history *history);

#endif
