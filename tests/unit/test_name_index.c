/* The index of names against a list that is looked through. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/name_index.h"

static void an_empty_index_finds_nothing(void **state)
{
    (void)state;
    const struct name_index index = {0};
    assert_int_equal(name_index_find(&index, "a"), -1);
    assert_int_equal(name_index_find(&index, ""), -1);
}

static void every_name_is_found_among_thousands(void **state)
{
    (void)state;
    enum { NAMES = 5000 };
    static char names[NAMES][16];
    struct name_index index = {0};
    for (int i = 0; i < NAMES; i++) {
        snprintf(names[i], sizeof names[i], "name%d", i);
        assert_int_equal(name_index_find(&index, names[i]), -1);
        assert_true(name_index_add(&index, names[i], i));
    }
    for (int i = 0; i < NAMES; i++)
        assert_int_equal(name_index_find(&index, names[i]), i);
    assert_int_equal(name_index_find(&index, "name"), -1);
    assert_int_equal(name_index_find(&index, "name50000"), -1);
    name_index_free(&index);
}

static void a_part_of_a_text_is_found_without_its_end(void **state)
{
    (void)state;
    struct name_index index = {0};
    assert_true(name_index_add(&index, "bodies", 3));
    assert_true(name_index_add(&index, "", 4));
    assert_int_equal(name_index_find_part(&index, "bodies.flyer", 6), 3);
    assert_int_equal(name_index_find_part(&index, "bodies.flyer", 5), -1);
    assert_int_equal(name_index_find_part(&index, "bodies.flyer", 7), -1);
    assert_int_equal(name_index_find_part(&index, "bodies.flyer", 0), 4);
    name_index_free(&index);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_empty_index_finds_nothing),
        cmocka_unit_test(every_name_is_found_among_thousands),
        cmocka_unit_test(a_part_of_a_text_is_found_without_its_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
