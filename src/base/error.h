/* Errors as values: a function that can fail returns NULL on success, else an error that its caller
 * owns. An error carries one or more messages, so that all mistakes of a file come in one go, but
 * no more than fifty. A message is one line: controls in what it quotes are written out
 * (base/visible.h). */
#ifndef BOLIDE_ERROR_H
#define BOLIDE_ERROR_H

#include <stdarg.h>

#include "base/base.h"

/* What kind of failure; the values are the exit statuses of the program. */
enum error_kind {
    ERROR_CHECK = 1,  /* a case ran, but one of its checks failed */
    ERROR_INPUT = 2,  /* a mistake of the user, in a case file or on the command line */
    ERROR_STATE = 3,  /* an impossible state in a run: NaN, negative density, energy drift */
    ERROR_SYSTEM = 4, /* a disk, memory or library that failed */
};

struct error;

/* A new error with one message. */
struct error *error_new(enum error_kind kind, const char *format, ...) BOLIDE_PRINTF(2, 3);

/* ERROR_SYSTEM: "out of memory", and "out of memory for ...". */
struct error *out_of_memory(void);
struct error *out_of_memory_for(const char *format, ...) BOLIDE_PRINTF(1, 2);

/* ERROR_SYSTEM: what NUMBER, a value of errno, says of the file PATH; 0: it cannot be written. */
struct error *file_error(const char *path, int number);

/* Puts "context: " before every message of ERROR and returns it; NULL stays NULL. */
struct error *error_context(struct error *error, const char *format, ...) BOLIDE_PRINTF(2, 3);

/* Joins the messages of two errors, either may be NULL; the graver kind (the larger) wins. Beyond
 * the first fifty they are only counted, by a last message. */
struct error *error_join(struct error *first, struct error *second);

/* True when further messages are only counted, so that there is no need to make them. NULL is not
 * full. */
bool error_is_full(const struct error *error);

enum error_kind error_kind(const struct error *error);

/* Marks ERROR as one that all ranks of a run have, and tells whether it is. */
struct error *error_known_to_all(struct error *error);
bool error_is_known_to_all(const struct error *error);

/* Number of messages, and the one at INDEX. The text belongs to the error. */
int error_count(const struct error *error);
const char *error_message(const struct error *error, int index);

void error_free(struct error *error);

/* Return an error to the caller at once: `TRY(store_open(...));`. */
#define TRY(call)                         \
    do {                                  \
        struct error *try_error = (call); \
        if (try_error)                    \
            return try_error;             \
    } while (0)

#endif
