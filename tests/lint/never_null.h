/* What the static analyzer cannot see for itself, included before every source by scripts/lint: the
 * functions that make an error never return NULL, so that "no memory, yet no error" is no path. */
#include "base/error.h"

static inline struct error *never_null(struct error *error)
{
    if (!error)
        __builtin_unreachable();
    return error;
}

#define error_new(...) never_null(error_new(__VA_ARGS__))
