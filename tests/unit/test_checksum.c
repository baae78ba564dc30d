/* Checksums: parts of an array may be summed apart, and no changed number is missed. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/checksum.h"

enum { COUNT = 200000 };

static void parts_add_up_to_the_whole(void **state)
{
    (void)state;
    uint64_t *number = malloc(COUNT * sizeof *number);
    assert_non_null(number);
    for (int i = 0; i < COUNT; i++)
        number[i] = (uint64_t)i % 7;
    static const size_t sizes[] = {1, 2, 8};
    for (size_t k = 0; k < COUNT_OF(sizes); k++) {
        const size_t bytes = sizes[k];
        const char *data = (const char *)number;
        const uint64_t whole = checksum_of(data, bytes, 0, COUNT, 1);
        for (int cut = 0; cut <= COUNT; cut += 12345)
            assert_true(checksum_of(data, bytes, 0, cut, 1) +
                            checksum_of(data + (size_t)cut * bytes, bytes, cut, COUNT - cut, 2) ==
                        whole);
        assert_true(checksum_of(data, bytes, 0, COUNT, 3) == whole);
    }
    free(number);
}

static void a_changed_number_or_place_is_seen(void **state)
{
    (void)state;
    uint16_t number[50] = {0};
    const uint64_t zeros = checksum_of(number, sizeof *number, 0, 50, 1);
    for (int i = 0; i < 50; i++)
        for (int bit = 0; bit < 16; bit++) {
            number[i] = (uint16_t)(1u << bit);
            assert_true(checksum_of(number, sizeof *number, 0, 50, 1) != zeros);
            number[i] = 0;
        }
    number[3] = 1;
    const uint64_t one = checksum_of(number, sizeof *number, 0, 50, 1);
    number[4] = 1;
    number[3] = 0;
    assert_true(checksum_of(number, sizeof *number, 0, 50, 1) != one);
    assert_true(checksum_of(number, sizeof *number, 0, 49, 1) !=
                checksum_of(number, sizeof *number, 0, 50, 1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_add_up_to_the_whole),
        cmocka_unit_test(a_changed_number_or_place_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
