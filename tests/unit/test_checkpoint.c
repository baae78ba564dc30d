/* Checkpoints: what is read is what was written, and nothing else is taken for one. */
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

#include <hdf5.h>

#include "build_simulation.h"
#include "output/checkpoint.h"
#include "populations.h"

static const char case_text[] = "format: 1\ntitle: test\nrun:\n  until: 5e-06 s\n";

static char folder[64];
static char path[96];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/bolide-test-XXXXXX");
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/checkpoint.h5", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[96];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command);
}

/* A solver with a number of its own, and a run loop with another. */
static struct error *solver_state(void *solver, struct visitor *visitor)
{
    return visitor->visit(visitor, "solver/number", NUMBER_DOUBLE, solver, 1, 1);
}

static const struct solver_class solver_class = {.size = sizeof(double), .state = solver_state};

static struct error *loop_state(void *context, struct visitor *visitor)
{
    return visitor->visit(visitor, "run/outputs", NUMBER_INT64, context, 3, 1);
}

struct run {
    struct simulation *simulation;
    double solver;
    int64_t loop[3];
};

static struct checkpoint checkpoint_of(struct run *run, const char *text)
{
    return (struct checkpoint){run->simulation, &solver_class, &run->solver,
                               loop_state,      run->loop,     text};
}

static struct error *write_run(struct run *run)
{
    const struct checkpoint checkpoint = checkpoint_of(run, case_text);
    return checkpoint_write(path, &checkpoint);
}

static struct error *read_run(struct run *run, const char *text)
{
    const struct checkpoint checkpoint = checkpoint_of(run, text);
    return checkpoint_read(path, &checkpoint);
}

static struct run a_run(int32_t count)
{
    struct run run = {build_simulation(count), 2.5, {7, -8, 9}};
    ledger_book(&run.simulation->ledger, LEDGER_WALLS, 0.0, vec3_make(1.0, 2.0, 3.0),
                vec3_make(1.0, 0.0, 0.0), 1e-30);
    return run;
}

static struct run an_empty_run(void)
{
    struct run run = {build_simulation(0), 0.0, {0}};
    run.simulation->time = run.simulation->step = 0;
    return run;
}

static void assert_same(const struct run *a, const struct run *b)
{
    assert_int_equal(particles_of(a->simulation)->count, particles_of(b->simulation)->count);
    assert_true(particles_hash(particles_of(a->simulation)) ==
                particles_hash(particles_of(b->simulation)));
    assert_memory_equal(&a->simulation->ledger, &b->simulation->ledger, sizeof(struct ledger));
    assert_true(a->simulation->time == b->simulation->time);
    assert_true(a->simulation->step == b->simulation->step);
    assert_true(a->solver == b->solver);
    assert_memory_equal(a->loop, b->loop, sizeof a->loop);
}

static void assert_fails(struct error *error, enum error_kind kind, const char *part)
{
    assert_non_null(error);
    assert_int_equal(error_kind(error), kind);
    if (!strstr(error_message(error, 0), part) || !strstr(error_message(error, 0), path))
        fail_msg("\"%s\" has no \"%s\"", error_message(error, 0), part);
    error_free(error);
}

static void what_is_read_is_what_was_written(void **state)
{
    (void)state;
    static const int32_t counts[] = {0, 1, 1000, 300000};
    for (size_t i = 0; i < COUNT_OF(counts); i++) {
        struct run run = a_run(counts[i]), resumed = an_empty_run();
        assert_null(write_run(&run));
        assert_null(read_run(&resumed, case_text));
        assert_same(&run, &resumed);
        drop_simulation(run.simulation);
        drop_simulation(resumed.simulation);
    }
}

static void nothing_of_hdf5_stays_open(void **state)
{
    (void)state;
    struct run run = a_run(10);
    assert_null(write_run(&run));
    assert_null(read_run(&run, case_text));
    assert_int_equal(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL), 0);
    drop_simulation(run.simulation);
}

static void the_case_is_what_was_stored(void **state)
{
    (void)state;
    struct run run = a_run(10);
    char *text;
    assert_null(write_run(&run));
    assert_null(checkpoint_case(path, run.simulation->ranks, &text));
    assert_string_equal(text, case_text);
    free(text);
    drop_simulation(run.simulation);
}

static void another_program_s_array_sizes_are_refused(void **state)
{
    (void)state;
    struct run run = a_run(10);
    assert_null(write_run(&run));
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(file, "run/outputs", H5P_DEFAULT);
    H5Fclose(file);
    assert_fails(read_run(&run, case_text), ERROR_SYSTEM, "has no run/outputs");
    file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    H5Lmove(file, "particles/velocity", file, "run/outputs", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcopy(file, "run/outputs", file, "particles/velocity", H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(file);
    assert_fails(read_run(&run, case_text), ERROR_SYSTEM,
                 "run/outputs has 10 rows of 3 numbers where 3 rows of 1 are wanted");
    drop_simulation(run.simulation);
}

static void put(const char *content)
{
    FILE *file = fopen(path, "w");
    fputs(content, file);
    fclose(file);
}

static void what_is_no_checkpoint_is_refused(void **state)
{
    (void)state;
    struct run run = a_run(10);
    assert_fails(read_run(&run, case_text), ERROR_INPUT, "No such file");
    put("");
    assert_fails(read_run(&run, case_text), ERROR_INPUT, "is no HDF5 file");
    put("format: 1\n");
    assert_fails(read_run(&run, case_text), ERROR_INPUT, "is no HDF5 file");
    H5Fclose(H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    assert_fails(read_run(&run, case_text), ERROR_INPUT, "is no checkpoint of bolide");
    drop_simulation(run.simulation);
}

/* One bit is turned in every part of the file; padding alone may hide it. */
static void a_damaged_file_is_refused(void **state)
{
    (void)state;
    struct run run = a_run(200), resumed = an_empty_run();
    assert_null(write_run(&run));
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    int refused = 0, tried = 0;
    for (long at = 0; at < status.st_size; at += 37, tried++) {
        FILE *file = fopen(path, "r+");
        fseek(file, at, SEEK_SET);
        int byte = getc(file);
        fseek(file, at, SEEK_SET);
        putc(byte ^ 0x10, file);
        fclose(file);
        struct error *error = read_run(&resumed, case_text);
        if (error)
            refused++;
        else
            assert_same(&run, &resumed);
        error_free(error);
        file = fopen(path, "r+");
        fseek(file, at, SEEK_SET);
        putc(byte, file);
        fclose(file);
    }
    assert_true(refused > tried / 2);
    assert_null(read_run(&resumed, case_text));
    assert_int_equal(truncate(path, status.st_size / 2), 0);
    assert_fails(read_run(&resumed, case_text), ERROR_INPUT, "is no HDF5 file, or a damaged one");
    drop_simulation(run.simulation);
    drop_simulation(resumed.simulation);
}

/* Reads the case too, and joins what either says. */
static struct error *read_all(struct run *run)
{
    char *text;
    struct error *error = checkpoint_case(path, run->simulation->ranks, &text);
    free(text);
    return error_join(error, read_run(run, case_text));
}

static void a_changed_byte_of_any_array_is_named(void **state)
{
    (void)state;
    struct run run = a_run(7), resumed = an_empty_run();
    static const char *const names[][2] = {
        {"particles/velocity", "particles/velocity is damaged"},
        {"particles/body", "particles/body is damaged"},
        {"run/outputs", "run/outputs is damaged"},
        {"case", "its case is damaged"},
        {"checksums", "is damaged"},
    };
    assert_null(write_run(&run));
    for (size_t k = 0; k < COUNT_OF(names); k++) {
        hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
        hid_t dataset = H5Dopen2(file, names[k][0], H5P_DEFAULT);
        const long begin = (long)H5Dget_offset(dataset), size = (long)H5Dget_storage_size(dataset);
        H5Dclose(dataset);
        H5Fclose(file);
        assert_true(begin > 0 && size > 0);
        for (long at = begin + (k == 4 ? 8 : 0); at < begin + size; at++) {
            FILE *bytes = fopen(path, "r+");
            fseek(bytes, at, SEEK_SET);
            const int byte = getc(bytes);
            fseek(bytes, at, SEEK_SET);
            putc(byte ^ 1 << at % 8, bytes);
            fclose(bytes);
            assert_fails(read_all(&resumed), ERROR_SYSTEM, names[k][1]);
            bytes = fopen(path, "r+");
            fseek(bytes, at, SEEK_SET);
            putc(byte, bytes);
            fclose(bytes);
        }
    }
    assert_null(read_all(&resumed));
    assert_same(&run, &resumed);
    drop_simulation(run.simulation);
    drop_simulation(resumed.simulation);
}

static void another_format_is_refused(void **state)
{
    (void)state;
    struct run run = a_run(10);
    assert_null(write_run(&run));
    const int64_t older = 3;
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    hid_t format = H5Dopen2(file, "bolide checkpoint format", H5P_DEFAULT);
    H5Dwrite(format, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &older);
    H5Dclose(format);
    H5Ldelete(file, "checksums", H5P_DEFAULT);
    H5Fclose(file);
    assert_fails(read_run(&run, case_text), ERROR_INPUT,
                 "is a checkpoint of format 3; this program reads format 4");
    drop_simulation(run.simulation);
}

/* The limit of a file's size stands for the disk's: the write fails alike. */
static void a_full_disk_keeps_the_last_checkpoint(void **state)
{
    (void)state;
    struct run run = a_run(20000), resumed = an_empty_run();
    assert_null(write_run(&run));
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit before, few;
    getrlimit(RLIMIT_FSIZE, &before);
    few = before;
    static const rlim_t limits[] = {10, 1000, 100000, 2000000};
    for (size_t i = 0; i < COUNT_OF(limits); i++) {
        run.simulation->step++;
        few.rlim_cur = limits[i];
        setrlimit(RLIMIT_FSIZE, &few);
        struct error *error = write_run(&run);
        setrlimit(RLIMIT_FSIZE, &before);
        assert_fails(error, ERROR_SYSTEM, "File too large");
    }
    run.simulation->step -= COUNT_OF(limits);
    assert_null(read_run(&resumed, case_text));
    assert_same(&run, &resumed);
    assert_null(write_run(&run));
    drop_simulation(run.simulation);
    drop_simulation(resumed.simulation);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(what_is_read_is_what_was_written),
        IN_FOLDER(nothing_of_hdf5_stays_open),
        IN_FOLDER(the_case_is_what_was_stored),
        IN_FOLDER(another_program_s_array_sizes_are_refused),
        IN_FOLDER(what_is_no_checkpoint_is_refused),
        IN_FOLDER(a_damaged_file_is_refused),
        IN_FOLDER(a_changed_byte_of_any_array_is_named),
        IN_FOLDER(another_format_is_refused),
        IN_FOLDER(a_full_disk_keeps_the_last_checkpoint),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
