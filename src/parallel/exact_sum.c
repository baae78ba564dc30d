/* Sums without rounding; see exact_sum.h. */
#include "parallel/exact_sum.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { DIGIT_BITS = 32, LOWEST_BIT = -1088 };

/* A digit takes this many additions of up to 2^32 before its 64 bits may overflow. */
static const int64_t additions_between_carries = (int64_t)1 << 30;

/* Brings every digit but the last into 0 .. 2^32 - 1; the last carries the sign. */
static void take_carries(struct exact_sum *sum)
{
    int64_t carry = 0;
    for (int k = 0; k < EXACT_SUM_DIGITS - 1; k++) {
        int64_t digit = sum->digit[k] + carry;
        carry = digit >> DIGIT_BITS;
        sum->digit[k] = digit & 0xffffffff;
    }
    sum->digit[EXACT_SUM_DIGITS - 1] += carry;
    sum->pending = 0;
}

void exact_sum_add(struct exact_sum *sum, double value)
{
    if (value == 0.0)
        return;
    if (!isfinite(value)) {
        sum->not_finite = true;
        return;
    }
    if (sum->pending >= additions_between_carries)
        take_carries(sum);
    sum->pending++;
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    int exponent = (int)(bits >> 52 & 0x7ff);
    uint64_t mantissa = bits & 0xfffffffffffff;
    if (exponent)
        mantissa |= (uint64_t)1 << 52;
    else
        exponent = 1;
    int place = exponent - 1075 - LOWEST_BIT; /* of the mantissa's last bit */
    unsigned __int128 wide = (unsigned __int128)mantissa << (place % DIGIT_BITS);
    int64_t low = (int64_t)(wide & 0xffffffff), middle = (int64_t)(wide >> 32 & 0xffffffff),
            high = (int64_t)(wide >> 64);
    int64_t *digit = sum->digit + place / DIGIT_BITS;
    bool negative = bits >> 63;
    digit[0] += negative ? -low : low;
    digit[1] += negative ? -middle : middle;
    digit[2] += negative ? -high : high;
}

void exact_sum_join(struct exact_sum *sum, const struct exact_sum *other)
{
    if (other->pending == 0 && !other->not_finite) /* nothing was added */
        return;
    struct exact_sum tidy = *other;
    take_carries(&tidy);
    take_carries(sum);
    for (int k = 0; k < EXACT_SUM_DIGITS; k++)
        sum->digit[k] += tidy.digit[k];
    sum->pending = 1;
    sum->not_finite |= other->not_finite;
}

double exact_sum_value(const struct exact_sum *sum)
{
    if (sum->not_finite)
        return (double)NAN;
    struct exact_sum tidy = *sum;
    take_carries(&tidy);
    bool negative = tidy.digit[EXACT_SUM_DIGITS - 1] < 0;
    if (negative) {
        for (int k = 0; k < EXACT_SUM_DIGITS; k++)
            tidy.digit[k] = -tidy.digit[k];
        take_carries(&tidy);
    }
    int top = EXACT_SUM_DIGITS - 1;
    while (top > 2 && tidy.digit[top] == 0)
        top--;
    unsigned __int128 wide = (unsigned __int128)tidy.digit[top] << 64 |
                             (unsigned __int128)tidy.digit[top - 1] << 32 |
                             (unsigned __int128)tidy.digit[top - 2];
    /* What lies below only matters for rounding: one bit stands for all of it. */
    for (int k = 0; k < top - 2; k++)
        if (tidy.digit[k]) {
            wide |= 1;
            break;
        }
    double value = ldexp((double)wide, DIGIT_BITS * (top - 2) + LOWEST_BIT);
    return negative ? -value : value;
}

/* A sum as a row of whole numbers: its digits, its pending additions, whether it is not finite. */
enum { SUM_NUMBERS = EXACT_SUM_DIGITS + 2 };

/* What additions can have made of a sum: carries keep a digit below 2^32, and each of the pending
 * additions adds less than that. */
static bool sum_possible(const int64_t row[SUM_NUMBERS])
{
    const int64_t pending = row[EXACT_SUM_DIGITS], most = (int64_t)1 << 62;
    bool possible = pending >= 0 && pending <= (int64_t)1 << 30;
    for (int k = 0; k < EXACT_SUM_DIGITS; k++)
        possible = possible && row[k] > -most && row[k] < most + most / 2;
    return possible;
}

struct error *exact_sums_visit(struct exact_sum *sums, int count, const char *name,
                               struct visitor *visitor)
{
    int64_t(*rows)[SUM_NUMBERS] = memory_allocate((size_t)count * sizeof *rows);
    if (!rows)
        return out_of_memory_for("%s", name);
    for (int i = 0; i < count; i++) {
        memcpy(rows[i], sums[i].digit, sizeof sums[i].digit);
        rows[i][EXACT_SUM_DIGITS] = sums[i].pending;
        rows[i][EXACT_SUM_DIGITS + 1] = sums[i].not_finite;
    }
    struct error *error = visitor->visit(visitor, name, NUMBER_INT64, rows, count, SUM_NUMBERS);
    for (int i = 0; i < count && !error; i++) {
        if (!sum_possible(rows[i]))
            error = error_new(ERROR_SYSTEM, "row %d of %s is not the digits of a sum", i, name);
        memcpy(sums[i].digit, rows[i], sizeof sums[i].digit);
        sums[i].pending = rows[i][EXACT_SUM_DIGITS];
        sums[i].not_finite = rows[i][EXACT_SUM_DIGITS + 1] != 0;
    }
    free(rows);
    return error;
}
