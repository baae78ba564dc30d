/* Repeatable random numbers and the assertions that the tests of the lower modules share. Includes
 * cmocka with what it needs. */
#ifndef BOLIDE_TEST_DICE_H
#define BOLIDE_TEST_DICE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/error.h"

struct dice {
    uint64_t state;
};

/* splitmix64 */
static inline uint64_t dice_word(struct dice *dice)
{
    uint64_t word = dice->state += 0x9e3779b97f4a7c15u;
    word = (word ^ word >> 30) * 0xbf58476d1ce4e5b9u;
    word = (word ^ word >> 27) * 0x94d049bb133111ebu;
    return word ^ word >> 31;
}

/* Uniform in low .. high. */
static inline double dice_between(struct dice *dice, double low, double high)
{
    return low + (high - low) * ((double)(dice_word(dice) >> 11) * 0x1p-53);
}

/* A whole number of 0 .. count - 1. */
static inline int dice_below(struct dice *dice, int count)
{
    return (int)(dice_word(dice) % (uint64_t)count);
}

static inline void assert_success_at(struct error *error, const char *file, int line)
{
    if (!error)
        return;
    print_error("%s:%d: %s\n", file, line, error_message(error, 0));
    error_free(error);
    fail();
}
#define assert_success(call) assert_success_at((call), __FILE__, __LINE__)

static inline void assert_near_at(double value, double wanted, double tolerance, const char *file,
                                  int line)
{
    if (fabs(value - wanted) <= tolerance)
        return;
    print_error("%s:%d: %.17g differs from %.17g by %.3g, more than %.3g\n", file, line, value,
                wanted, value - wanted, tolerance);
    fail();
}
/* |value - wanted| <= tolerance, and the same relative to |wanted|. */
#define assert_near(value, wanted, tolerance) \
    assert_near_at((value), (wanted), (tolerance), __FILE__, __LINE__)
#define assert_close(value, wanted, fraction) \
    assert_near_at((value), (wanted), (fraction)*fabs(wanted), __FILE__, __LINE__)

#endif
