/* The limit of the step: which of two comes first, and what one process alone makes of it. */
#include "dice.h"

#include "model/solver.h"

static bool before(double a, uint64_t a_id, double b, uint64_t b_id)
{
    const struct ranked first = {a, a_id, 0}, second = {b, b_id, 0};
    return ranked_before(&first, &second);
}

static void the_smaller_value_comes_first_and_of_equal_ones_the_smaller_id(void **state)
{
    (void)state;
    assert_true(before(1.0, 9, 2.0, 1));
    assert_false(before(2.0, 1, 1.0, 9));
    assert_true(before(1.0, 1, 1.0, 2));
    assert_false(before(1.0, 2, 1.0, 1));
    assert_false(before(1.0, 1, 1.0, 1));
}

static void not_a_number_comes_before_all_numbers(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    assert_true(before(nan, 5, 0.0, 1));
    assert_false(before(0.0, 1, nan, 5));
    assert_true(before(nan, 1, nan, 2));
    assert_false(before(nan, 2, nan, 1));
}

static void the_limit_of_a_rank_alone_is_its_own(void **state)
{
    (void)state;
    static const char *const reasons[] = {"sound speed", "velocity"};
    const struct ranks alone = ranks_alone();
    const struct limit limit = limit_of_ranks(&alone, (struct ranked){2e-9, 7, 1}, reasons);
    assert_true(limit.dt == 2e-9);
    assert_int_equal(limit.id, 7);
    assert_string_equal(limit.why, "velocity");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_smaller_value_comes_first_and_of_equal_ones_the_smaller_id),
        cmocka_unit_test(not_a_number_comes_before_all_numbers),
        cmocka_unit_test(the_limit_of_a_rank_alone_is_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
