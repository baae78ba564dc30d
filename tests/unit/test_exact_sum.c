/* Exact sums: what they are against integer and quadruple arithmetic, and that nothing of order,
 * parts or carries shows in them. */
#include "dice.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "parallel/exact_block.h"

enum { MANY = 100000 };

static double sum_of(const double *value, int64_t count)
{
    struct exact_sum sum = {0};
    for (int64_t i = 0; i < count; i++)
        exact_sum_add(&sum, value[i]);
    return exact_sum_value(&sum);
}

static void assert_same(double value, double wanted)
{
    uint64_t a, b;
    memcpy(&a, &value, sizeof a);
    memcpy(&b, &wanted, sizeof b);
    if (a != b)
        print_error("%.17g (%a) is not %.17g (%a)\n", value, value, wanted, wanted);
    assert_true(a == b);
}

/* Of either sign, over 600 orders of magnitude. */
static double *many_numbers(uint64_t seed)
{
    struct dice dice = {seed};
    double *value = malloc(MANY * sizeof *value);
    assert_non_null(value);
    for (int i = 0; i < MANY; i++) {
        double size = pow(10.0, dice_between(&dice, -300.0, 300.0));
        value[i] = dice_word(&dice) & 1 ? size : -size;
    }
    return value;
}

static void a_sum_of_many_at_once_is_that_of_each(void **state)
{
    (void)state;
    double *value = many_numbers(5);
    struct dice dice = {6};
    for (int k = 0; k < 300; k++) {
        const int first = dice_below(&dice, MANY / 2), count = dice_below(&dice, 1500);
        const double span = dice_between(&dice, 0.0, 2.0);
        struct exact_sum one = {0}, many = {0};
        for (int i = first; i < first + count; i++) /* narrow and wide ranges, and some zeros */
            value[i] =
                i % 7 ? copysign(pow(fabs(value[i]), span * span * span / 8.0), value[i]) : 0.0;
        for (int i = first; i < first + count; i++)
            exact_sum_add(&one, value[i]);
        exact_sum_add_all(&many, value + first, count);
        assert_same(exact_sum_value(&many), exact_sum_value(&one));
        if (count == 0)
            continue;
        value[first + count / 2] = k % 2 ? NAN : -INFINITY;
        exact_sum_add_all(&many, value + first, count);
        assert_true(isnan(exact_sum_value(&many)));
        value[first + count / 2] = 1.0;
    }
    free(value);
}

static void shuffle(double *value, int count, struct dice *dice)
{
    for (int i = count - 1; i > 0; i--) {
        int k = dice_below(dice, i + 1);
        double other = value[k];
        value[k] = value[i];
        value[i] = other;
    }
}

static void a_sum_over_600_orders_of_magnitude_does_not_depend_on_the_order(void **state)
{
    (void)state;
    double *value = many_numbers(1);
    double wanted = sum_of(value, MANY);
    struct dice dice = {2};
    for (int k = 0; k < 5; k++) {
        shuffle(value, MANY, &dice);
        assert_same(sum_of(value, MANY), wanted);
    }
    free(value);
}

static void joined_parts_are_the_sum_of_all(void **state)
{
    (void)state;
    double *value = many_numbers(3);
    double wanted = sum_of(value, MANY);
    for (int parts = 2; parts < 9; parts++) {
        struct exact_sum part[8], forward = {0}, backward = {0};
        memset(part, 0, sizeof part);
        for (int i = 0; i < MANY; i++)
            exact_sum_add(&part[i % parts], value[i]);
        for (int k = 0; k < parts; k++) {
            exact_sum_join(&forward, &part[k]);
            exact_sum_join(&backward, &part[parts - 1 - k]);
        }
        assert_same(exact_sum_value(&forward), wanted);
        assert_same(exact_sum_value(&backward), wanted);
    }
    free(value);
}

/* A number as an integer multiple of 2^-1074, two's complement in 32-bit limbs. */
enum { LIMBS = 72 };
struct integer {
    uint32_t limb[LIMBS];
};

static void integer_add(struct integer *sum, double value)
{
    int exponent;
    double fraction = frexp(fabs(value), &exponent);
    uint64_t mantissa = (uint64_t)ldexp(fraction, 53);
    int place = exponent - 53 + 1074;
    if (place < 0) {
        mantissa >>= -place;
        place = 0;
    }
    bool negative = value < 0.0;
    uint64_t carry = negative;
    for (int k = 0; k < LIMBS; k++) {
        int shift = 32 * k - place; /* of the mantissa, to the right */
        uint32_t limb = 0;
        if (shift > -32 && shift < 0)
            limb = (uint32_t)(mantissa << -shift);
        else if (shift >= 0 && shift < 64)
            limb = (uint32_t)(mantissa >> shift);
        carry += (uint64_t)sum->limb[k] + (negative ? ~limb : limb);
        sum->limb[k] = (uint32_t)carry;
        carry >>= 32;
    }
}

/* -1, 0, 1 */
static int integer_sign(const struct integer *a)
{
    if (a->limb[LIMBS - 1] >> 31)
        return -1;
    for (int k = 0; k < LIMBS; k++)
        if (a->limb[k])
            return 1;
    return 0;
}

/* The exact total lies within half a unit in the last place of VALUE. */
static void assert_nearest(const struct integer *total, double value)
{
    double half_below = 0.5 * (value - nextafter(value, -INFINITY));
    double half_above = 0.5 * (nextafter(value, INFINITY) - value);
    struct integer low = *total, high = *total;
    integer_add(&low, -value);
    integer_add(&low, half_below);
    assert_true(integer_sign(&low) >= 0);
    integer_add(&high, -value);
    integer_add(&high, -half_above);
    assert_true(integer_sign(&high) <= 0);
}

static void a_sum_is_the_double_nearest_to_the_integer_sum(void **state)
{
    (void)state;
    double *value = many_numbers(4);
    enum { LENGTH = 500 };
    for (int begin = 0; begin + LENGTH <= MANY; begin += MANY / 20) {
        struct integer total = {{0}};
        for (int i = begin; i < begin + LENGTH; i++)
            integer_add(&total, value[i]);
        assert_nearest(&total, sum_of(value + begin, LENGTH));
    }
    free(value);
}

static void a_sum_rounds_as_quadruple_precision_does(void **state)
{
    (void)state;
    struct dice dice = {5};
    for (int trial = 0; trial < 300; trial++) {
        /* 53 bits at places 0 .. 45, a hundred of them: exact in 113 bits. */
        double value[100];
        _Float128 exact = 0;
        int range = 1 + dice_below(&dice, 45), centre = dice_below(&dice, 1800) - 900;
        for (int i = 0; i < 100; i++) {
            double mantissa = (double)(dice_word(&dice) >> 11);
            value[i] = ldexp(dice_word(&dice) & 1 ? mantissa : -mantissa,
                             centre + dice_below(&dice, range));
            exact += value[i];
        }
        assert_same(sum_of(value, 100), (double)exact);
    }
}

static void large_numbers_cancel_and_leave_the_small(void **state)
{
    (void)state;
    assert_same(sum_of((double[]){1e300, 1.0, -1e300}, 3), 1.0);
    assert_same(sum_of((double[]){1.0, 1e300, 1e-300, -1.0, -1e300}, 5), 1e-300);
    assert_same(sum_of((double[]){DBL_MAX, DBL_MAX, -DBL_MAX, 3.0, -DBL_MAX}, 5), 3.0);
    assert_same(sum_of((double[]){-1e300, -1.0, 1e300}, 3), -1.0);
}

static void ties_round_to_even_and_the_last_bit_breaks_them(void **state)
{
    (void)state;
    double tiny = nextafter(0.0, 1.0);
    assert_same(sum_of((double[]){1.0, 0x1p-53}, 2), 1.0);
    assert_same(sum_of((double[]){1.0 + 0x1p-52, 0x1p-53}, 2), 1.0 + 0x1p-51);
    assert_same(sum_of((double[]){1.0, 0x1p-53, tiny}, 3), 1.0 + 0x1p-52);
    assert_same(sum_of((double[]){1.0, 0x1p-53, -tiny}, 3), 1.0);
    assert_same(sum_of((double[]){-1.0, -0x1p-53, -tiny}, 3), -1.0 - 0x1p-52);
    assert_same(sum_of((double[]){1.0, -tiny}, 2), 1.0);
    assert_same(sum_of((double[]){DBL_MAX, tiny}, 2), DBL_MAX);
}

static void subnormal_numbers_add_up(void **state)
{
    (void)state;
    double tiny = nextafter(0.0, 1.0);
    assert_same(sum_of((double[]){tiny}, 1), tiny);
    assert_same(sum_of((double[]){-tiny, -tiny, -tiny}, 3), -3.0 * tiny);
    assert_same(sum_of((double[]){DBL_MIN, -tiny}, 2), DBL_MIN - tiny);
    assert_same(sum_of((double[]){1.0, tiny, -1.0}, 3), tiny);
    struct exact_sum sum = {0};
    for (int i = 0; i < 1 << 16; i++)
        exact_sum_add(&sum, DBL_MIN / 65536.0);
    assert_same(exact_sum_value(&sum), DBL_MIN);
}

static void negative_totals_are_those_of_the_opposite_numbers(void **state)
{
    (void)state;
    double *value = many_numbers(6);
    double total = sum_of(value, MANY);
    for (int i = 0; i < MANY; i++)
        value[i] = -value[i];
    assert_same(sum_of(value, MANY), -total);
    free(value);
}

static void nothing_and_zeros_sum_to_zero(void **state)
{
    (void)state;
    assert_same(sum_of(NULL, 0), 0.0);
    assert_same(sum_of((double[]){-0.0, 0.0, -0.0}, 3), 0.0);
    assert_same(sum_of((double[]){5.5, -5.5}, 2), 0.0);
}

static void a_number_that_is_not_finite_makes_the_sum_so_for_good(void **state)
{
    (void)state;
    assert_true(isnan(sum_of((double[]){1.0, INFINITY}, 2)));
    assert_true(isnan(sum_of((double[]){-INFINITY, INFINITY, 1.0}, 3)));
    assert_true(isnan(sum_of((double[]){NAN, 1.0}, 2)));
    struct exact_sum sum = {0}, bad = {0};
    exact_sum_add(&sum, 1.0);
    exact_sum_add(&bad, INFINITY);
    exact_sum_join(&sum, &bad);
    assert_true(isnan(exact_sum_value(&sum)));
    /* A total beyond the range of doubles is infinite, until it comes back. */
    assert_same(sum_of((double[]){DBL_MAX, DBL_MAX}, 2), INFINITY);
    assert_same(sum_of((double[]){-DBL_MAX, -DBL_MAX}, 2), -INFINITY);
    assert_same(sum_of((double[]){DBL_MAX, DBL_MAX, -DBL_MAX}, 3), DBL_MAX);
}

static void carries_are_taken_before_they_overflow(void **state)
{
    (void)state;
    /* As if a billion such additions had happened before. */
    struct exact_sum sum = {0};
    double most = (0x1p53 - 1.0) * 0x1p11;
    const int64_t additions = (int64_t)1 << 30;
    exact_sum_add(&sum, most);
    for (int k = 0; k < EXACT_SUM_DIGITS; k++)
        sum.digit[k] *= additions - 1;
    sum.pending = additions - 1;
    for (int i = 0; i < 5; i++)
        exact_sum_add(&sum, most);
    assert_same(exact_sum_value(&sum), (double)((_Float128)most * (additions + 4)));
    for (int k = 0; k < EXACT_SUM_DIGITS; k++)
        assert_true(llabs(sum.digit[k]) < (int64_t)1 << 36);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sum_of_many_at_once_is_that_of_each),
        cmocka_unit_test(a_sum_over_600_orders_of_magnitude_does_not_depend_on_the_order),
        cmocka_unit_test(joined_parts_are_the_sum_of_all),
        cmocka_unit_test(a_sum_is_the_double_nearest_to_the_integer_sum),
        cmocka_unit_test(a_sum_rounds_as_quadruple_precision_does),
        cmocka_unit_test(large_numbers_cancel_and_leave_the_small),
        cmocka_unit_test(ties_round_to_even_and_the_last_bit_breaks_them),
        cmocka_unit_test(subnormal_numbers_add_up),
        cmocka_unit_test(negative_totals_are_those_of_the_opposite_numbers),
        cmocka_unit_test(nothing_and_zeros_sum_to_zero),
        cmocka_unit_test(a_number_that_is_not_finite_makes_the_sum_so_for_good),
        cmocka_unit_test(carries_are_taken_before_they_overflow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
