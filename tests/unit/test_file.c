/* Files written beside and renamed, and folders. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scratch_folder.h"

#include "base/file.h"

/* FOLDER/NAME; four texts at a time. */
static const char *in_folder(const char *name)
{
    static char text[4][256];
    static int next;
    next = (next + 1) % 4;
    snprintf(text[next], sizeof text[next], "%s/%s", folder, name);
    return text[next];
}

static void put(const char *name, const char *content)
{
    FILE *file = fopen(in_folder(name), "w");
    assert_non_null(file);
    fputs(content, file);
    assert_int_equal(fclose(file), 0);
}

static bool there(const char *name) { return access(in_folder(name), F_OK) == 0; }

static void assert_content(const char *name, const char *wanted)
{
    char text[256];
    FILE *file = fopen(in_folder(name), "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    assert_string_equal(text, wanted);
}

static void assert_fails(struct error *error, enum error_kind kind, const char *part)
{
    assert_non_null(error);
    assert_int_equal(error_kind(error), kind);
    if (!strstr(error_message(error, 0), part))
        fail_msg("\"%s\" has no \"%s\"", error_message(error, 0), part);
    error_free(error);
}

static void a_file_appears_only_when_it_is_whole(void **state)
{
    (void)state;
    FILE *file;
    put("a.txt", "old");
    assert_null(file_begin(in_folder("a.txt"), &file));
    fputs("new", file);
    fflush(file);
    assert_content("a.txt", "old");
    assert_content("a.txt.part", "new");
    assert_null(file_end(in_folder("a.txt"), file));
    assert_content("a.txt", "new");
    assert_false(there("a.txt.part"));
}

static void a_full_disk_leaves_the_old_file_and_tells_why(void **state)
{
    (void)state;
    put("a.txt", "old");
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit before, few;
    getrlimit(RLIMIT_FSIZE, &before);
    few = before;
    few.rlim_cur = 1000;
    FILE *file;
    assert_null(file_begin(in_folder("a.txt"), &file));
    setrlimit(RLIMIT_FSIZE, &few);
    for (int i = 0; i < 1000; i++)
        fputs("0123456789", file);
    struct error *error = file_end(in_folder("a.txt"), file);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_fails(error, ERROR_SYSTEM, "a.txt: ");
    assert_content("a.txt", "old");
    assert_false(there("a.txt.part"));
}

static void an_unwritable_place_is_an_error(void **state)
{
    (void)state;
    FILE *file;
    assert_fails(file_begin(in_folder("none/a.txt"), &file), ERROR_SYSTEM, "No such file");
    assert_fails(file_publish(in_folder("none.txt")), ERROR_SYSTEM, "No such file");
}

static void folders_are_made_with_their_parents(void **state)
{
    (void)state;
    assert_null(folder_make(in_folder("a//b/c/")));
    assert_true(there("a/b/c"));
    assert_null(folder_make(in_folder("a/b")));
    put("a/file", "");
    assert_fails(folder_make(in_folder("a/file")), ERROR_INPUT, "is a file");
    assert_fails(folder_make(in_folder("a/file/b")), ERROR_INPUT, "is a file");
}

static void a_link_is_never_written_through(void **state)
{
    (void)state;
    FILE *file;
    put("victim", "precious");
    assert_int_equal(symlink("victim", in_folder("link")), 0);
    assert_int_equal(symlink("nowhere", in_folder("dangling")), 0);
    assert_int_equal(symlink("victim", in_folder("a.txt.part")), 0);
    assert_int_equal(symlink("victim", in_folder("a.txt")), 0);
    static const char *const modes[] = {"w", "a", "w+", "r+"};
    for (size_t i = 0; i < COUNT_OF(modes); i++) {
        assert_fails(file_open(in_folder("link"), modes[i], &file), ERROR_INPUT, "symbolic link");
        assert_fails(file_open(in_folder("dangling"), modes[i], &file), ERROR_INPUT,
                     "symbolic link");
    }
    assert_false(there("nowhere"));
    assert_null(file_begin(in_folder("a.txt"), &file));
    fputs("new", file);
    assert_null(file_end(in_folder("a.txt"), file));
    assert_content("victim", "precious");
    assert_content("a.txt", "new");
}

/* An alarm would end a test that waits. */
static void a_pipe_or_a_device_is_refused_at_once(void **state)
{
    (void)state;
    static const char *const modes[] = {"w", "a", "w+", "r+"};
    assert_int_equal(mkfifo(in_folder("pipe"), 0666), 0);
    assert_null(folder_make(in_folder("folder")));
    alarm(20);
    for (size_t i = 0; i < COUNT_OF(modes); i++) {
        FILE *file;
        assert_fails(file_open(in_folder("pipe"), modes[i], &file), ERROR_INPUT, "a pipe");
        assert_fails(file_open(in_folder("folder"), modes[i], &file), ERROR_INPUT, "a folder");
        assert_fails(file_open("/dev/null", modes[i], &file), ERROR_INPUT, "a device");
    }
    alarm(0);
    assert_false(file_is_plain(in_folder("pipe")));
    assert_false(file_is_plain("/dev/zero"));
}

static void a_plain_file_is_opened_as_fopen_does(void **state)
{
    (void)state;
    FILE *file;
    assert_null(file_open(in_folder("a.txt"), "w", &file));
    fputs("one ", file);
    fclose(file);
    assert_null(file_open(in_folder("a.txt"), "a", &file));
    fputs("two", file);
    fclose(file);
    assert_content("a.txt", "one two");
    assert_null(file_open(in_folder("a.txt"), "r+", &file));
    fputs("six", file);
    fclose(file);
    assert_content("a.txt", "six two");
    assert_null(file_open(in_folder("a.txt"), "w+", &file));
    fclose(file);
    assert_content("a.txt", "");
    assert_fails(file_open(in_folder("b.txt"), "r+", &file), ERROR_SYSTEM, "No such file");
}

static void paths_are_joined_with_one_slash(void **state)
{
    (void)state;
    static const char *const cases[][3] = {
        {"a", "b", "a/b"}, {"a/", "b", "a/b"}, {"", "b", "b"}, {"/", "b", "/b"}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char *path = path_join(cases[i][0], cases[i][1]);
        assert_string_equal(path, cases[i][2]);
        free(path);
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(a_file_appears_only_when_it_is_whole),
        IN_FOLDER(a_full_disk_leaves_the_old_file_and_tells_why),
        IN_FOLDER(an_unwritable_place_is_an_error),
        IN_FOLDER(folders_are_made_with_their_parents),
        IN_FOLDER(a_link_is_never_written_through),
        IN_FOLDER(a_pipe_or_a_device_is_refused_at_once),
        IN_FOLDER(a_plain_file_is_opened_as_fopen_does),
        cmocka_unit_test(paths_are_joined_with_one_slash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
