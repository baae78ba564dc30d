/* What each load has given so far beside what it should have given. */
#ifndef BOLIDE_LOAD_RECORD_H
#define BOLIDE_LOAD_RECORD_H

#include "base/visitor.h"
#include "parallel/ranks.h"

/* N s, per metre of depth in 2-D, per square metre in 1-D, per radian about an axis: the impulse
 * that the members got; the integral of pressure times area over the surface as it is; the integral
 * of its magnitude, against which the two are compared. */
enum load_sum { LOAD_DELIVERED, LOAD_EXPECTED = 3, LOAD_GROSS = 6, LOAD_SUMS };

/* Exact sums of what this rank booked. */
struct load_record {
    struct exact_sum sum[LOAD_SUMS];
};

struct load_totals {
    double delivered[3], expected[3], gross;
};

void load_record_add(struct load_record *record, enum load_sum first, const double impulse[3]);
void load_record_join(struct load_record *record, const struct load_record *other);

/* Collective. */
struct load_totals load_record_totals(const struct load_record *record, const struct ranks *ranks);

/* How far the two impulses are apart, relative to the larger of GROSS and what was delivered; zero
 * where there is neither. */
double load_deviation(const struct load_totals *totals);

/* Collective: loads or saves the sums over all ranks of COUNT records. */
struct error *load_records_visit(struct load_record *records, int count, const struct ranks *ranks,
                                 struct visitor *visitor);

#endif
