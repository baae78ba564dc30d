/* Text from outside, made harmless for terminals. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/visible.h"

static void assert_visible(const char *text, const char *wanted)
{
    char *visible = text_visible(text);
    assert_string_equal(visible, wanted);
    free(visible);
    char *buffer = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&buffer, &size);
    assert_non_null(file);
    text_put_visible(file, text);
    fclose(file);
    assert_string_equal(buffer, wanted);
    free(buffer);
}

static void letters_of_all_scripts_stay(void **state)
{
    (void)state;
    assert_visible("", "");
    assert_visible("U_s = 5 km/s, \"100 %\" \\ [a]", "U_s = 5 km/s, \"100 %\" \\ [a]");
    assert_visible("\xc2\xb5m \xd0\xb2\xd0\xbe\xd0\xb4\xd0\xb0 \xe6\xb0\xb4 \xf0\x9f\x92\xa5",
                   "\xc2\xb5m \xd0\xb2\xd0\xbe\xd0\xb4\xd0\xb0 \xe6\xb0\xb4 \xf0\x9f\x92\xa5");
}

static void controls_are_written_out(void **state)
{
    (void)state;
    assert_visible("a\x1b[2Jb\nc\td\x7f\r", "a\\x1b[2Jb\\x0ac\\x09d\\x7f\\x0d");
    assert_visible("\xc2\x9b"
                   "2J",
                   "\\u009b2J"); /* C1 */
    assert_visible("\xe2\x80\xae"
                   "gpj",
                   "\\u202egpj"); /* right to left */
    assert_visible("\xef\xbb\xbf\xf3\xa0\x80\xa1", "\\ufeff\\ue0021");
}

static void bytes_that_are_no_text_are_written_out(void **state)
{
    (void)state;
    assert_visible("\x9b"
                   "2J\xff",
                   "\\x9b2J\\xff");
    assert_visible("\xc3", "\\xc3"); /* cut off */
    assert_visible("\xe2\x80", "\\xe2\\x80");
    assert_visible("\xc0\x8a", "\\xc0\\x8a"); /* a line feed in two bytes */
}

static void what_shows_nothing_is_known(void **state)
{
    (void)state;
    static const uint32_t invisible[] = {' ', 0xa0, 0xad, 0x200b, 0x200d, 0x2003, 0x3000, 0xfe0f};
    static const uint32_t seen[] = {'a', '_', 0xb5, 0x434, 0x6c34, 0x1f4a5};
    for (size_t i = 0; i < COUNT_OF(invisible); i++)
        assert_true(is_invisible(invisible[i]));
    for (size_t i = 0; i < COUNT_OF(seen); i++)
        assert_false(is_invisible(seen[i]));
}

static void letters_in_parts_are_known_from_whole_ones(void **state)
{
    (void)state;
    static const uint32_t twice[] = {0x301, 0x308, 0x3099, 0x1161, 0x2126, 0x212a, 0x212b, 0xf900};
    static const uint32_t once[] = {'e', 0xe9, 0x3a9, 0xc5, 0x434, 0x439, 0x30ac, 0xac00, 0x6c34};
    for (size_t i = 0; i < COUNT_OF(twice); i++)
        assert_true(is_spelled_twice(twice[i]));
    for (size_t i = 0; i < COUNT_OF(once); i++)
        assert_false(is_spelled_twice(once[i]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_of_all_scripts_stay),
        cmocka_unit_test(controls_are_written_out),
        cmocka_unit_test(what_shows_nothing_is_known),
        cmocka_unit_test(letters_in_parts_are_known_from_whole_ones),
        cmocka_unit_test(bytes_that_are_no_text_are_written_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
