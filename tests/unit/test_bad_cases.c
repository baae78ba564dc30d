/* Bad cases against all that a user is told of them: tests/data/bad/NAME.yaml and NAME.expected.
 * Each is read with everything that the program knows; a case that reads well is looked at as a run
 * would before its first step. */
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "messages.h"
#include "run/catalogue.h"
#include "run/run.h"
#include "source_folder.h"

static const char *const library_paths[] = {"library", materials_folder};

static char *expected_messages(const char *case_name, size_t length)
{
    enum { LONGEST = 1 << 16 };
    char *path = text_format("%.*s.expected", (int)length, case_name);
    FILE *file = fopen(path, "rb");
    free(path);
    char *text = calloc(1, LONGEST + 1);
    assert_non_null(text);
    if (file) {
        text[fread(text, 1, LONGEST, file)] = '\0';
        fclose(file);
    }
    return text;
}

/* True when the case of this file is refused with the messages that stand beside it. */
static bool is_told_right(const char *name)
{
    const struct case_options options = {.library_paths = library_paths,
                                         .library_count = COUNT_OF(library_paths)};
    struct simulation_case *input = NULL;
    struct error *error = case_read(name, &options, &bolide_catalogue, &input);
    if (!error)
        error = run_validate(input);
    char *found = messages(error), *expected = expected_messages(name, strlen(name) - 5);
    bool right = error && error_kind(error) == ERROR_INPUT && strcmp(found, expected) == 0;
    if (!right)
        print_error("%s must say\n%sbut says\n%s", name, expected, found);
    free(expected);
    free(found);
    error_free(error);
    case_free(input);
    return right;
}

static void bad_cases_give_their_messages(void **state)
{
    (void)state;
    char home[4096];
    assert_non_null(getcwd(home, sizeof home));
    assert_int_equal(chdir(bad_cases_folder), 0);
    struct dirent **entries;
    int count = scandir(".", &entries, NULL, alphasort), cases = 0, wrong = 0;
    for (int i = 0; i < count; i++) {
        size_t length = strlen(entries[i]->d_name);
        if (length > 5 && !strcmp(entries[i]->d_name + length - 5, ".yaml")) {
            cases++;
            wrong += !is_told_right(entries[i]->d_name);
        }
        free(entries[i]);
    }
    free(entries);
    assert_int_equal(chdir(home), 0);
    assert_true(cases >= 40);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bad_cases_give_their_messages)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
