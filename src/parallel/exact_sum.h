/* Sums of doubles without rounding: a number is split into 32-bit digits of one wide integer,
 * integers are added, the result is rounded once. So a sum is the same for any order, threads and
 * ranks. */
#ifndef BOLIDE_EXACT_SUM_H
#define BOLIDE_EXACT_SUM_H

#include "base/base.h"
#include "base/visitor.h"

enum { EXACT_SUM_DIGITS = 68 };

/* digit[k] counts 2^(32 k - 1088); `pending` additions happened since carries were taken. A zeroed
 * struct is the sum of nothing. */
struct exact_sum {
    int64_t digit[EXACT_SUM_DIGITS];
    int64_t pending;
    bool not_finite;
};

void exact_sum_add(struct exact_sum *sum, double value);
void exact_sum_join(struct exact_sum *sum, const struct exact_sum *other);
double exact_sum_value(const struct exact_sum *sum);

/* Loads or saves COUNT sums as NAME, each as a row of whole numbers; ERROR_SYSTEM when what was
 * loaded is no sum. */
struct error *exact_sums_visit(struct exact_sum *sums, int count, const char *name,
                               struct visitor *visitor);

#endif
