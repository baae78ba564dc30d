/* The folder of a run's results: what is removed, what stays, and its lock. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "scratch_folder.h"

#include "base/file.h"
#include "base/results.h"

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

/* What the run of put_a_run says that it may write. */
static const char *const run_names[] = {"snapshots/" RESULTS_NUMBER ".vtkhdf",
                                        "pictures/p-" RESULTS_NUMBER ".png",
                                        "pictures/check-p.png",
                                        "probes/a.csv",
                                        "../../" RESULTS_NUMBER ".txt",
                                        "snapshots/../thesis.tex",
                                        NULL};
static const char *const no_names[] = {NULL};

static void put_a_run(void)
{
    static const char *const names[] = {
        "case.yaml",
        "history.csv",
        "checkpoint.h5",
        "checkpoint.h5.part",
        "checks.csv",
        "report.html",
        "snapshots/000000.vtkhdf",
        "pictures/p-000012.png",
        "pictures/p-1234567.png.part",
        "pictures/check-p.png",
        "probes/a.csv",
        "snapshots/000001.vtkhdf.part",
    };
    assert_null(results_begin(folder, false, run_names));
    assert_null(folder_make(in_folder("snapshots")));
    assert_null(folder_make(in_folder("pictures")));
    assert_null(folder_make(in_folder("probes")));
    for (size_t i = 0; i < COUNT_OF(names); i++)
        put(names[i], "result");
}

static void a_fresh_folder_is_made_and_marked(void **state)
{
    (void)state;
    assert_null(results_begin(in_folder("results/one"), false, no_names));
    assert_content("results/one/run.log", "");
}

static void a_locked_folder_names_the_process_that_has_it(void **state)
{
    (void)state;
    struct results_lock first = {0}, second = {0};
    char process[48];
    snprintf(process, sizeof process, "in use by another run (process %ld)", (long)getpid());
    assert_null(results_lock(folder, &first));
    assert_fails(results_lock(folder, &second), ERROR_INPUT, process);
    results_unlock(&first);
    assert_false(there(".bolide-lock"));
    assert_null(results_lock(folder, &second));
    results_unlock(&second);
    results_unlock(&second);
}

static void the_lock_of_a_process_that_is_gone_is_free(void **state)
{
    (void)state;
    pid_t child = fork();
    if (child == 0) {
        struct results_lock lock = {0};
        error_free(results_lock(folder, &lock));
        kill(getpid(), SIGKILL);
    }
    waitpid(child, NULL, 0);
    struct results_lock lock = {0};
    assert_true(there(".bolide-lock"));
    assert_null(results_lock(folder, &lock));
    results_unlock(&lock);
}

/* A folder that was moved away takes its lock along. */
static void a_lock_is_not_taken_from_its_new_owner(void **state)
{
    (void)state;
    struct results_lock first = {0}, second = {0}, third = {0};
    assert_null(results_lock(folder, &first));
    assert_int_equal(unlink(in_folder(".bolide-lock")), 0);
    assert_null(results_lock(folder, &second));
    results_unlock(&first);
    assert_fails(results_lock(folder, &third), ERROR_INPUT, "in use");
    results_unlock(&second);
}

static void results_are_kept_unless_overwriting(void **state)
{
    (void)state;
    put_a_run();
    assert_fails(results_begin(folder, false, no_names), ERROR_INPUT,
                 "already contains the results of a run");
    assert_content("history.csv", "result");
    assert_content("snapshots/000000.vtkhdf", "result");
}

static void overwriting_removes_results_and_nothing_else(void **state)
{
    (void)state;
    put_a_run();
    put("thesis.tex", "mine");
    put("my.vtkhdf", "mine");
    put("pictures/cat.jpg", "mine");
    put("pictures/cat.png", "mine");
    put("pictures/p-best.png", "mine");
    put("pictures/p-000012 (copy).png", "mine");
    put("probes/a-first.csv", "mine");
    assert_null(folder_make(in_folder("probes/old")));
    assert_null(results_begin(folder, true, no_names));
    assert_content("run.log", "");
    assert_content("thesis.tex", "mine");
    assert_content("my.vtkhdf", "mine");
    assert_content("pictures/cat.jpg", "mine");
    assert_content("pictures/cat.png", "mine");
    assert_content("pictures/p-best.png", "mine");
    assert_content("pictures/p-000012 (copy).png", "mine");
    assert_content("probes/a-first.csv", "mine");
    assert_true(there("probes/old"));
    static const char *const gone[] = {"case.yaml",
                                       "history.csv",
                                       "checkpoint.h5",
                                       "checks.csv",
                                       "report.html",
                                       "checkpoint.h5.part",
                                       "pictures/p-000012.png",
                                       "pictures/p-1234567.png.part",
                                       "pictures/check-p.png",
                                       "snapshots",
                                       "probes/a.csv"};
    for (size_t i = 0; i < COUNT_OF(gone); i++)
        if (there(gone[i]))
            fail_msg("%s is there yet", gone[i]);
}

static void foreign_files_of_the_same_name_are_never_touched(void **state)
{
    (void)state;
    put("case.yaml", "input of a user");
    assert_fails(results_begin(folder, false, no_names), ERROR_INPUT, "case.yaml");
    assert_fails(results_begin(folder, true, no_names), ERROR_INPUT, "case.yaml");
    assert_content("case.yaml", "input of a user");
    unlink(in_folder("case.yaml"));
    assert_null(folder_make(in_folder("pictures")));
    put("pictures/holiday.png", "of a user");
    assert_fails(results_begin(folder, true, no_names), ERROR_INPUT, "pictures");
    assert_content("pictures/holiday.png", "of a user");
}

static void foreign_files_of_other_names_do_not_matter(void **state)
{
    (void)state;
    put("notes.txt", "mine");
    assert_null(results_begin(folder, false, no_names));
    assert_content("notes.txt", "mine");
}

static void a_file_in_place_of_the_folder_is_a_mistake(void **state)
{
    (void)state;
    put("file", "");
    assert_fails(results_begin(in_folder("file"), true, no_names), ERROR_INPUT, "is a file");
}

static void overwriting_removes_links_and_not_their_targets(void **state)
{
    (void)state;
    static const char *const names[] = {"run.log",          ".bolide-files", "history.csv",
                                        "history.csv.part", "checkpoint.h5", "report.html.part"};
    put_a_run();
    put("victim", "precious");
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        unlink(in_folder(names[i]));
        assert_int_equal(symlink("victim", in_folder(names[i])), 0);
    }
    assert_null(results_begin(folder, true, run_names));
    assert_content("victim", "precious");
    assert_content("run.log", "");
    for (size_t i = 2; i < COUNT_OF(names); i++)
        assert_false(there(names[i]));
}

static void a_log_that_points_nowhere_marks_a_run_s_folder(void **state)
{
    (void)state;
    assert_int_equal(symlink("elsewhere", in_folder("run.log")), 0);
    assert_fails(results_begin(folder, false, no_names), ERROR_INPUT,
                 "already contains the results of a run");
    assert_false(there("elsewhere"));
    assert_null(results_begin(folder, true, no_names));
    assert_content("run.log", "");
    assert_false(there("elsewhere"));
}

static void a_folder_of_results_that_is_a_link_is_refused(void **state)
{
    (void)state;
    put_a_run();
    assert_null(folder_make(in_folder("mine")));
    put("mine/p-000012.png", "mine");
    unlink(in_folder("pictures/p-000012.png"));
    assert_int_equal(rename(in_folder("pictures"), in_folder("before")), 0);
    assert_int_equal(symlink("mine", in_folder("pictures")), 0);
    assert_fails(results_begin(folder, true, run_names), ERROR_INPUT, "pictures: is a symbolic");
    assert_fails(results_check_links(folder), ERROR_INPUT, "pictures: is a symbolic");
    assert_content("mine/p-000012.png", "mine");
    assert_content("history.csv", "result");
}

static void a_lock_that_is_a_link_or_a_pipe_is_refused(void **state)
{
    (void)state;
    struct results_lock lock = {0};
    put("victim", "precious");
    assert_int_equal(symlink("victim", in_folder(".bolide-lock")), 0);
    assert_fails(results_lock(folder, &lock), ERROR_INPUT, ".bolide-lock: is a symbolic link");
    assert_content("victim", "precious");
    unlink(in_folder(".bolide-lock"));
    assert_int_equal(mkfifo(in_folder(".bolide-lock"), 0666), 0);
    assert_fails(results_lock(folder, &lock), ERROR_INPUT, ".bolide-lock: is a folder, a pipe");
    results_unlock(&lock);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(a_fresh_folder_is_made_and_marked),
        IN_FOLDER(results_are_kept_unless_overwriting),
        IN_FOLDER(overwriting_removes_results_and_nothing_else),
        IN_FOLDER(foreign_files_of_the_same_name_are_never_touched),
        IN_FOLDER(foreign_files_of_other_names_do_not_matter),
        IN_FOLDER(a_file_in_place_of_the_folder_is_a_mistake),
        IN_FOLDER(a_locked_folder_names_the_process_that_has_it),
        IN_FOLDER(the_lock_of_a_process_that_is_gone_is_free),
        IN_FOLDER(a_lock_is_not_taken_from_its_new_owner),
        IN_FOLDER(overwriting_removes_links_and_not_their_targets),
        IN_FOLDER(a_log_that_points_nowhere_marks_a_run_s_folder),
        IN_FOLDER(a_folder_of_results_that_is_a_link_is_refused),
        IN_FOLDER(a_lock_that_is_a_link_or_a_pipe_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
