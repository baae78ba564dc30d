/* Tables of comma-separated values, as this program writes them: one line of heads, fields in
 * quotes where they hold commas, quotes or line breaks. */
#ifndef BOLIDE_CSV_H
#define BOLIDE_CSV_H

#include <stdio.h>

#include "base/visitor.h"

struct csv {
    int columns;
    int64_t rows; /* without the heads */
    char *text;   /* holds all fields; owned */
    const char **field;
};

/* Reads PATH as far as it makes sense: a row that is too short is filled up with empty fields, one
 * that is too long is cut. A missing file is a table without columns. ERROR_SYSTEM when the file
 * cannot be read. */
struct error *csv_read(const char *path, struct csv *csv);
void csv_free(struct csv *csv);

/* The head of COLUMN, and the field at ROW and COLUMN; "" where there is none. */
const char *csv_head(const struct csv *csv, int column);
const char *csv_field(const struct csv *csv, int64_t row, int column);

/* The heads from column FIRST on, "time [s], pressure [Pa]", the first two dozen, in fresh
 * memory. */
char *csv_heads(const struct csv *csv, int first);

/* The column headed NAME, -1 if there is none. */
int csv_column(const struct csv *csv, const char *name);

/* The number at ROW and COLUMN, NAN where there is none. */
double csv_number(const struct csv *csv, int64_t row, int column);

/* The bytes at the start of a file that have been accounted for, and a hash of them; zeroed:
 * none. */
struct csv_mark {
    int64_t bytes;
    uint64_t hash;
};

/* Opens PATH for a table that grows: afresh, or with KEEP > 0 to go on after the head and the
 * first KEEP rows; what an interrupted run wrote after them is cut off. ERROR_INPUT when there
 * are fewer, or when they are not those of MARK (NULL: any). */
struct error *csv_grow(const char *path, int64_t keep, const struct csv_mark *mark, FILE **file);

/* Flushes FILE, opened at PATH by csv_grow, and extends MARK to all that it holds. */
struct error *csv_extend(FILE *file, const char *path, struct csv_mark *mark);

/* Shows MARK as NAME_bytes and NAME_hash. */
struct error *csv_visit_mark(struct csv_mark *mark, const char *name, struct visitor *visitor);

/* Writes the head of a column in UNIT, "" for a plain number: `pressure [Pa]`. */
void csv_put_head(FILE *file, const char *name, const char *unit);

/* The same in quotes, with WHAT behind a NAME that a user gave: `"left gauge error [Pa]"`. */
void csv_put_named_head(FILE *file, const char *name, const char *what, const char *unit);

/* Writes TEXT (NULL: nothing) as one field in quotes, and a number with as many digits as reading
 * the same bits again takes; "nan" where there is none. */
void csv_put_text(FILE *file, const char *text);
void csv_put_number(FILE *file, double value);
/* A comma, and VALUE where it is finite. */
void csv_add_finite(FILE *file, double value);

#endif
