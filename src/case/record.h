/* The record of a case: what its checks measured when `bolide verify --record` last ran it, a CSV
 * file beside the case. Pages are filled from it, and regression bounds start from it. */
#ifndef BOLIDE_RECORD_H
#define BOLIDE_RECORD_H

#include "base/csv.h"

/* What identifies a row, beside the name of the check. */
struct record_key {
    const char *form;     /* "normal", "short", "long" */
    const char *settings; /* those of the command line, joined by blanks; "": none */
    const char *run;      /* of a sweep; "": the case itself */
};

/* The file with the record of the case at PATH: results.csv beside a case.yaml, NAME.results.csv
 * beside NAME.yaml. NULL when memory is out; free it. */
char *record_path(const char *path);

/* Reads the record FILE; one that is not there has no rows. ERROR_INPUT when it is no record. */
struct error *record_read(const char *file, struct csv *record);

/* Whether ROW of RECORD is of KEY, whatever its run. */
bool record_is_of(const struct csv *record, int64_t row, const struct record_key *key);

/* The row of KEY and CHECK in RECORD; -1: none. */
int64_t record_find(const struct csv *record, const struct record_key *key, const char *check);

/* Opens FILE.part for writing and writes the heads; file_end publishes it. */
struct error *record_begin(const char *file, FILE **stream);

/* Writes ROW of RECORD as it is. */
void record_copy(FILE *stream, const struct csv *record, int64_t row);

#endif
