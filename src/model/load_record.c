/* Sums of what loads give; see load_record.h. */
#include "model/load_record.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

void load_record_add(struct load_record *record, enum load_sum first, const double impulse[3])
{
    for (int k = 0; k < 3; k++)
        if (impulse[k] != 0.0)
            exact_sum_add(&record->sum[(int)first + k], impulse[k]);
}

void load_record_join(struct load_record *record, const struct load_record *other)
{
    for (int k = 0; k < LOAD_SUMS; k++)
        exact_sum_join(&record->sum[k], &other->sum[k]);
}

struct load_totals load_record_totals(const struct load_record *record, const struct ranks *ranks)
{
    struct load_record all = *record;
    struct load_totals totals = {0};
    ranks_sum_exact(ranks, all.sum, LOAD_SUMS);
    for (int k = 0; k < 3; k++) {
        totals.delivered[k] = exact_sum_value(&all.sum[LOAD_DELIVERED + k]);
        totals.expected[k] = exact_sum_value(&all.sum[LOAD_EXPECTED + k]);
    }
    totals.gross = exact_sum_value(&all.sum[LOAD_GROSS]);
    return totals;
}

double load_deviation(const struct load_totals *totals)
{
    double apart = 0.0, delivered = 0.0;
    for (int k = 0; k < 3; k++) {
        apart += square(totals->delivered[k] - totals->expected[k]);
        delivered += square(totals->delivered[k]);
    }
    const double scale = maximum(totals->gross, sqrt(delivered));
    return scale > 0.0 ? sqrt(apart) / scale : 0.0;
}

struct error *load_records_visit(struct load_record *records, int count, const struct ranks *ranks,
                                 struct visitor *visitor)
{
    if (count == 0)
        return NULL;
    struct exact_sum *sums = &records[0].sum[0];
    const int all = count * LOAD_SUMS;
    ranks_sum_exact(ranks, sums, all);
    TRY(exact_sums_visit(sums, all, "loads", visitor));
    if (ranks->rank != 0)
        memset(records, 0, (size_t)count * sizeof *records);
    return NULL;
}
