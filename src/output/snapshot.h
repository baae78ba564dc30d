/* Snapshots: the particles of one moment as VTKHDF 1.0 (UnstructuredGrid of vertex cells), which
 * VTK 9.1 and ParaView 5.11 open. */
#ifndef BOLIDE_SNAPSHOT_H
#define BOLIDE_SNAPSHOT_H

#include "model/columns.h"
#include "model/simulation.h"

/* Collective: each rank writes all columns of its members of POPULATION to PATH, by slices, so that
 * memory does not grow with the members. Fields have their unit as the attribute `unit`. What the
 * numbers in the fields `body` and `material` stand for is in FieldData, under `bodies` and
 * `materials`. HASH becomes that of the file (base/file.h), unless it is NULL. */
struct error *snapshot_write(const char *path, const struct simulation *simulation,
                             const struct population *population, uint64_t *hash);

/* Whether a snapshot of POPULATION has COLUMN: cells of gas have no stress but their pressure. */
bool snapshot_has(const struct population *population, const char *column);

/* Writes FOLDER/snapshots.vtkhdf.series that lists COUNT snapshots, file names as given, with their
 * times in seconds. */
struct error *snapshot_series_write(const char *path, int count, const char *const *files,
                                    const double *times);

#endif
