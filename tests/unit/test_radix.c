/* The sort of keys: against one that looks at two neighbours at a time, and the same with any
 * number of threads. */
#include "dice.h"

#include <string.h>

#include "particle/radix.h"

/* More than are worth a thread of their own, twice. */
enum { COUNT = 70000 };

static struct keyed entry[COUNT], scratch[COUNT], first[COUNT];
static struct key_run run[COUNT];

/* Keys of some bits here and there, each several times. */
static void fill(uint64_t bits)
{
    struct dice dice = {7};
    for (int32_t i = 0; i < COUNT; i++) {
        uint64_t key = 0;
        for (int part = 0; part < 4; part++)
            key = key << 16 | (uint64_t)dice_below(&dice, 1 << 16);
        entry[i] = (struct keyed){key & bits, i};
    }
}

static void keys_are_sorted_and_equal_ones_keep_their_order(void **state)
{
    (void)state;
    static const uint64_t bits[] = {0, 0xff, 0x8000000000000001u, 0xf0f000f, ~(uint64_t)0};
    for (size_t k = 0; k < COUNT_OF(bits); k++) {
        fill(bits[k]);
        radix_sort(entry, scratch, COUNT, 1);
        for (int32_t i = 1; i < COUNT; i++)
            assert_true(entry[i - 1].key < entry[i].key ||
                        (entry[i - 1].key == entry[i].key && entry[i - 1].index < entry[i].index));
    }
}

static void threads_do_not_show(void **state)
{
    (void)state;
    fill(0xf0000ff00000fu);
    radix_sort(entry, scratch, COUNT, 1);
    memcpy(first, entry, sizeof first);
    for (int threads = 2; threads < 6; threads++) {
        fill(0xf0000ff00000fu);
        radix_sort(entry, scratch, COUNT, threads);
        for (int32_t i = 0; i < COUNT; i++)
            assert_true(entry[i].key == first[i].key && entry[i].index == first[i].index);
    }
}

static void runs_of_equal_keys_follow_each_other(void **state)
{
    (void)state;
    fill(0x3f);
    radix_sort(entry, scratch, COUNT, 2);
    for (int threads = 1; threads < 5; threads++) {
        int32_t runs = radix_runs(entry, COUNT, threads, run), next = 0;
        assert_int_equal(runs, 64);
        for (int32_t r = 0; r < runs; r++) {
            assert_int_equal(run[r].first, next);
            assert_true(run[r].key == (uint64_t)r);
            for (int32_t i = 0; i < run[r].count; i++)
                assert_true(entry[next++].key == run[r].key);
        }
        assert_int_equal(next, COUNT);
    }
}

static void nothing_has_no_runs(void **state)
{
    (void)state;
    radix_sort(entry, scratch, 0, 2);
    assert_int_equal(radix_runs(entry, 0, 2, run), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_are_sorted_and_equal_ones_keep_their_order),
        cmocka_unit_test(threads_do_not_show),
        cmocka_unit_test(runs_of_equal_keys_follow_each_other),
        cmocka_unit_test(nothing_has_no_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
