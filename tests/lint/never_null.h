/* What the static analyzer cannot see for itself, included before every source by scripts/lint: a function
 * that makes an error, or adds to one, never returns NULL, so that "no memory, yet no error" is no path. */
#include "base/error.h"

static inline struct error *never_null(struct error *error)
{
    if (!error)
        __builtin_unreachable();
    return error;
}

static inline struct error *joined(struct error *first, struct error *second)
{
    struct error *error = error_join(first, second);
    return first || second ? never_null(error) : error;
}

#define error_new(...) never_null(error_new(__VA_ARGS__))
#define error_join(first, second) joined(first, second)
#define error_context(known, ...)                                   \
    ({                                                              \
        struct error *bare = (known);                               \
        bare ? never_null(error_context(bare, __VA_ARGS__)) : NULL; \
    })
