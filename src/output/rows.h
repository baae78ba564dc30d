/* The rows of a table that all ranks hold together, handed to the one that writes them. */
#ifndef BOLIDE_ROWS_H
#define BOLIDE_ROWS_H

#include "parallel/ranks.h"

/* COUNT rows of BYTES each on this rank; FILL puts those from BEGIN to END - 1 into OUT. While it
 * works a row may need SPACE bytes. */
struct rows {
    int64_t count;
    size_t bytes, space;
    void (*fill)(const void *context, int64_t begin, int64_t end, void *out);
    const void *context;
};

/* Where they go: COUNT rows that are those from AT on of all. */
typedef struct error *rows_put(void *sink, int64_t at, int64_t count, const void *rows);

/* Collective: calls PUT on rank 0 with the rows of rank 0, 1, ..., some at a time, so that memory
 * does not grow with them. The first error of PUT, or an earlier ERROR (taken), ends the calls, but
 * not the passing; rank 0 alone has it. */
struct error *rows_pass(const struct ranks *ranks, const struct rows *rows, rows_put *put,
                        void *sink, struct error *error);

#endif
