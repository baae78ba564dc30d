/* What the static analyzer cannot see for itself, included before every source by scripts/lint: a
 * function that makes an error, or adds to one, never returns NULL, so that "no memory, yet no
 * error" is no path. Nor do ranks_agree and ranks_agree_on where this rank has an error. */
#include "parallel/ranks.h"

static inline struct error *never_null(struct error *error)
{
    if (!error)
        __builtin_unreachable();
    return error;
}

static inline struct error *never_null_of_two(struct error *first, struct error *second)
{
    struct error *error = error_join(first, second);
    return first || second ? never_null(error) : error;
}

#define error_new(...) never_null(error_new(__VA_ARGS__))
#define error_join(first, second) never_null_of_two(first, second)
#define error_context(known, ...)                                   \
    ({                                                              \
        struct error *bare = (known);                               \
        bare ? never_null(error_context(bare, __VA_ARGS__)) : NULL; \
    })

/* Bodies for the analyzer alone: GNU inline gives way to the definitions in src/parallel/. */
#define MODEL extern inline __attribute__((gnu_inline))

struct error *error_of_all_ranks(struct error *own, double *values);

MODEL struct error *ranks_agree_on(const struct ranks *ranks, struct error *error, double *values,
                                   int count)
{
    (void)ranks;
    (void)count;
    struct error *agreed = error_of_all_ranks(error, values);
    if (error && !agreed)
        __builtin_unreachable();
    return agreed;
}

MODEL struct error *ranks_agree(const struct ranks *ranks, struct error *error)
{
    return ranks_agree_on(ranks, error, NULL, 0);
}
