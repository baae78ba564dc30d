/* Errors as values, and the memory and texts beneath them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"

static void an_error_carries_its_kind_and_message(void **state)
{
    (void)state;
    struct error *error = error_new(ERROR_STATE, "density %g at step %d", -1.5, 7);
    assert_int_equal(error_kind(error), ERROR_STATE);
    assert_int_equal(error_count(error), 1);
    assert_string_equal(error_message(error, 0), "density -1.5 at step 7");
    error_free(error);
    error_free(NULL);
}

static void context_goes_before_every_message(void **state)
{
    (void)state;
    struct error *error = error_join(error_new(ERROR_INPUT, "one"), error_new(ERROR_INPUT, "two"));
    error = error_context(error, "case.yaml:%d", 14);
    error = error_context(error, "run");
    assert_int_equal(error_count(error), 2);
    assert_string_equal(error_message(error, 0), "run: case.yaml:14: one");
    assert_string_equal(error_message(error, 1), "run: case.yaml:14: two");
    error_free(error);
    assert_null(error_context(NULL, "nothing"));
}

static void joined_errors_keep_their_order_and_the_graver_kind(void **state)
{
    (void)state;
    struct error *all = NULL;
    assert_null(error_join(NULL, NULL));
    for (int i = 0; i < 20; i++)
        all = error_join(all, error_new(i == 5 ? ERROR_SYSTEM : ERROR_INPUT, "message %d", i));
    all = error_join(all, NULL);
    assert_int_equal(error_count(all), 20);
    assert_int_equal(error_kind(all), ERROR_SYSTEM);
    assert_string_equal(error_message(all, 0), "message 0");
    assert_string_equal(error_message(all, 19), "message 19");
    error_free(all);
}

static void beyond_fifty_messages_they_are_only_counted(void **state)
{
    (void)state;
    struct error *all = NULL, *more = NULL;
    for (int i = 0; i < 50; i++) {
        assert_false(error_is_full(all));
        all = error_join(all, error_new(ERROR_INPUT, "message %d", i));
    }
    assert_true(error_is_full(all));
    assert_int_equal(error_count(all), 50);
    for (int i = 0; i < 70; i++)
        more = error_join(more, error_new(ERROR_STATE, "later"));
    assert_string_equal(error_message(more, 50), "20 more are not shown");
    all = error_context(error_join(all, more), "run");
    assert_int_equal(error_count(all), 51);
    assert_int_equal(error_kind(all), ERROR_STATE);
    assert_string_equal(error_message(all, 49), "run: message 49");
    assert_string_equal(error_message(all, 50), "70 more are not shown");
    error_free(all);
}

static void a_message_is_one_visible_line(void **state)
{
    (void)state;
    struct error *error = error_new(ERROR_INPUT, "no \"%s\"", "a\x1b[2J\nb");
    error = error_context(error, "%s", "x\ny.yaml");
    assert_string_equal(error_message(error, 0), "x\\x0ay.yaml: no \"a\\x1b[2J\\x0ab\"");
    error_free(error);
}

static struct error *fails_unless(bool good) { return good ? NULL : error_new(ERROR_CHECK, "bad"); }

static struct error *tries(bool first, bool second, int *reached)
{
    *reached = 0;
    TRY(fails_unless(first));
    *reached = 1;
    TRY(fails_unless(second));
    *reached = 2;
    return NULL;
}

static void try_returns_the_first_error_at_once(void **state)
{
    (void)state;
    int reached;
    assert_null(tries(true, true, &reached));
    assert_int_equal(reached, 2);
    struct error *error = tries(true, false, &reached);
    assert_non_null(error);
    assert_int_equal(reached, 1);
    error_free(error);
    error = tries(false, true, &reached);
    assert_int_equal(reached, 0);
    error_free(error);
}

static void memory_is_aligned_and_zeroed(void **state)
{
    (void)state;
    const size_t sizes[] = {0, 1, 63, 64, 65, 1000};
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        unsigned char *memory = memory_allocate(sizes[i]);
        assert_non_null(memory);
        assert_int_equal((uintptr_t)memory % MEMORY_ALIGNMENT, 0);
        for (size_t byte = 0; byte < sizes[i]; byte++)
            assert_int_equal(memory[byte], 0);
        free(memory);
    }
    assert_null(memory_allocate(SIZE_MAX));
}

static void a_growing_array_keeps_what_it_holds(void **state)
{
    (void)state;
    void *memory = NULL;
    int64_t capacity = 0, grown = 0;
    for (int64_t i = 0; i < 1000; i++) {
        int64_t before = capacity;
        assert_true(memory_reserve(&memory, &capacity, i + 1, i, sizeof(int64_t)));
        assert_true(capacity > i);
        grown += capacity != before;
        ((int64_t *)memory)[i] = i * i;
    }
    for (int64_t i = 0; i < 1000; i++)
        assert_int_equal(((int64_t *)memory)[i], i * i);
    assert_true(grown < 25);
    void *same = memory;
    assert_true(memory_reserve(&memory, &capacity, 10, 10, sizeof(int64_t)));
    assert_ptr_equal(memory, same);
    free(memory);
}

static void texts_are_formatted_and_copied(void **state)
{
    (void)state;
    char *text = text_format("%s-%03d", "probe", 7);
    assert_string_equal(text, "probe-007");
    char *copy = text_copy(text), *part = text_copy_part(text, 5);
    assert_string_equal(copy, text);
    assert_string_equal(part, "probe");
    assert_null(text_copy(NULL));
    char *wide = text_format("%500s|", "");
    assert_int_equal(strlen(wide), 501);
    free(text);
    free(copy);
    free(part);
    free(wide);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_error_carries_its_kind_and_message),
        cmocka_unit_test(context_goes_before_every_message),
        cmocka_unit_test(joined_errors_keep_their_order_and_the_graver_kind),
        cmocka_unit_test(beyond_fifty_messages_they_are_only_counted),
        cmocka_unit_test(a_message_is_one_visible_line),
        cmocka_unit_test(try_returns_the_first_error_at_once),
        cmocka_unit_test(memory_is_aligned_and_zeroed),
        cmocka_unit_test(a_growing_array_keeps_what_it_holds),
        cmocka_unit_test(texts_are_formatted_and_copied),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
