/* Checks made ready; private to the checks_*.c files. */
#ifndef BOLIDE_CHECKS_INTERNAL_H
#define BOLIDE_CHECKS_INTERNAL_H

#include "run/checks.h"

struct prepared_check {
    struct measurement measurement; /* without the totals at the start */
    const char *raw_unit;           /* of what is measured */
    char unit[DIMENSION_TEXT];      /* of the result, which `relative` may have divided */
    void *solved;                   /* owned; NULL: that of an earlier check serves */
    double wanted, low, high;
};

struct checks {
    int count;
    struct prepared_check *item;
    size_t solved_bytes; /* of the exact solutions */
};

/* The number of the check K of those that PREPARED is the mean with. */
int check_mean_with(const struct prepared_check *prepared, int k);

/* Why the check at INDEX, PREPARED, has no finite value; MEMORY holds what all checks measured.
 * Owned by the caller. */
char *check_reason(const struct prepared_check *prepared, const struct check_memory *memory,
                   int index);

#endif
