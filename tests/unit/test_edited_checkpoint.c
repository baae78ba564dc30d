/* Checkpoints that somebody has edited, with valid checksums: resuming one ends with an error or
 * runs on, and never crashes, waits or reads another file. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scratch_folder.h"

#include "base/checksum.h"
#include "base/file.h"
#include "output/checkpoint_format.h"
#include "run/catalogue.h"
#include "run/run.h"

static const char text[] =
    "format: 1\n"
    "dimension: 2\n"
    "resolution: 1 mm\n"
    "solver: %s\n"
    "materials: {gas: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}}\n"
    "bodies:\n"
    "  left:  {material: gas, pressure: 100 kPa, box: {from: [0 mm, 0 mm], to: [9 mm, 5 mm]}}\n"
    "  right: {material: gas, pressure: 10 kPa, box: {from: [9 mm, 0 mm], to: [18 mm, 5 mm]}}\n"
    "walls: {low: {mirror: x, at: 0 mm, side: low}}\n"
    "run: {until: 50 us, max_steps: 9}\n"
    "output: {history: 1 us, snapshots: no, pictures: []}\n"
    "probes: {first: {tracer: [0 mm, 0 mm]}}\n"
    "checks: {energy: {conserved: energy, within: 1}}\n";

static char path[96];

static struct simulation_case *read_case(const char *solver)
{
    struct simulation_case *input;
    const struct case_options options = {0};
    snprintf(path, sizeof path, "%s/case.yaml", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fprintf(file, text, solver) > 0 && fclose(file) == 0);
    assert_null(case_read(path, &options, &bolide_catalogue, &input));
    return input;
}

static void copy(const char *from, const char *to)
{
    char command[256];
    snprintf(command, sizeof command, "rm -rf '%s/%s' && cp -r '%s/%s' '%s/%s'", folder, to, folder,
             from, folder, to);
    assert_int_equal(system(command), 0);
}

/* The results of half a run are in "half". */
static void run_half(const struct simulation_case *input)
{
    char output[96];
    snprintf(output, sizeof output, "%s/half", folder);
    struct run_result result;
    const struct run_options options = {.threads = 1, .output = output, .max_steps = 5};
    assert_null(run_case(input, &options, &result));
    run_result_free(&result);
}

static struct error *resume(const struct simulation_case *input)
{
    char output[96];
    snprintf(output, sizeof output, "%s/edited", folder);
    struct run_result result;
    const struct run_options options = {.threads = 1, .output = output, .resume = true};
    struct error *error = run_case(input, &options, &result);
    run_result_free(&result);
    return error;
}

/* A fresh copy of the half run, and its checkpoint open to be edited. */
static hid_t open_copy(void)
{
    copy("half", "edited");
    snprintf(path, sizeof path, "%s/edited/checkpoint.h5", folder);
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(file >= 0);
    return file;
}

struct names {
    int count;
    char name[100][64];
};

static herr_t note_dataset(hid_t group, const char *name, const H5L_info_t *link, void *context)
{
    struct names *names = context;
    (void)link;
    hid_t object = H5Oopen(group, name, H5P_DEFAULT);
    if (H5Iget_type(object) == H5I_DATASET && strcmp(name, CHECKPOINT_CASE) != 0 &&
        strcmp(name, CHECKPOINT_CHECKSUMS) != 0) {
        assert_true(names->count < 100);
        snprintf(names->name[names->count++], 64, "%s", name);
    }
    return H5Oclose(object);
}

/* Makes the checksum of DATASET that of NUMBERS, COUNT of BYTES each. */
static void mend_checksum(hid_t file, hid_t dataset, const char *numbers, size_t bytes,
                          size_t count)
{
    int64_t row = -1;
    hid_t attribute = H5Aopen(dataset, CHECKPOINT_CHECKSUM, H5P_DEFAULT);
    assert_true(H5Aread(attribute, H5T_NATIVE_INT64, &row) >= 0);
    H5Aclose(attribute);
    hid_t sums = H5Dopen2(file, CHECKPOINT_CHECKSUMS, H5P_DEFAULT), space = H5Dget_space(sums);
    hid_t one = H5Screate_simple(2, (const hsize_t[]){1, 1}, NULL);
    const uint64_t sum = checksum_of(numbers, bytes, 0, (int64_t)count, 1);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, (const hsize_t[]){(hsize_t)row, 0}, NULL,
                        (const hsize_t[]){1, 1}, NULL);
    assert_true(H5Dwrite(sums, H5T_NATIVE_UINT64, one, space, H5P_DEFAULT, &sum) >= 0);
    H5Sclose(one);
    H5Sclose(space);
    H5Dclose(sums);
}

#define EVERYWHERE SIZE_MAX

/* Overwrites number WHERE of the dataset NAME, of 8 or 2 bytes, by BITS; EVERYWHERE: all of
 * them. */
static void edit(hid_t file, const char *name, size_t where, uint64_t bits)
{
    hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), type = H5Dget_type(dataset),
          space = H5Dget_space(dataset);
    const size_t bytes = H5Tget_size(type), count = (size_t)H5Sget_simple_extent_npoints(space);
    char *numbers = malloc(count * bytes);
    assert_non_null(numbers);
    assert_true(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers) >= 0);
    for (size_t i = 0; i < count; i++)
        if (where == EVERYWHERE || i == where % count)
            memcpy(numbers + i * bytes, &bits, bytes);
    assert_true(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers) >= 0);
    mend_checksum(file, dataset, numbers, bytes, count);
    free(numbers);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(dataset);
}

static uint64_t bits_of(double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits;
}

static bool has_prefix(const char *name, const char *prefix)
{
    return !strncmp(name, prefix, strlen(prefix));
}

/* What is not finite stands nowhere in a state; only a check that has not measured yet has no
 * number. */
static bool must_be_finite(const char *name, hid_t file)
{
    hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), type = H5Dget_type(dataset);
    const bool number = H5Tget_class(type) == H5T_FLOAT;
    H5Tclose(type);
    H5Dclose(dataset);
    return number && (has_prefix(name, "particles/") || !strcmp(name, "time"));
}

static void edit_everything(const char *solver)
{
    struct simulation_case *input = read_case(solver);
    struct names names = {0};
    const uint64_t evil[] = {bits_of((double)NAN), bits_of((double)INFINITY), UINT64_MAX,
                             bits_of(1e300), (uint64_t)1 << 63};
    alarm(300);
    run_half(input);
    hid_t file = open_copy();
    assert_true(H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, note_dataset, &names) >= 0);
    H5Fclose(file);
    assert_true(names.count > 20);
    for (int i = 0; i < names.count; i++)
        for (size_t k = 0; k < COUNT_OF(evil); k++) {
            file = open_copy();
            const bool wrong = k < 2 && must_be_finite(names.name[i], file);
            edit(file, names.name[i], has_prefix(names.name[i], "run/") ? EVERYWHERE : 1, evil[k]);
            H5Fclose(file);
            struct error *error = resume(input);
            if (wrong && !error)
                fail_msg("%s may be %s", names.name[i], k ? "infinite" : "no number");
            error_free(error);
        }
    alarm(0);
    case_free(input);
}

static void an_edited_number_of_sph_never_crashes(void **state)
{
    (void)state;
    edit_everything("sph");
}

static void an_edited_number_of_mpm_never_crashes(void **state)
{
    (void)state;
    edit_everything("mpm");
}

static void what_the_case_has_not_is_named(void **state)
{
    (void)state;
    struct simulation_case *input = read_case("sph");
    const struct {
        const char *name;
        uint64_t bits;
        const char *words;
    } edits[] = {
        {"particles/body", 2, "row 7 of body is 2, where the case has 2 of them"},
        {"particles/material", 65535, "row 7 of material is 65535, where the case has 1 of them"},
        {"particles/id", UINT64_MAX, "row 7 of id is 18446744073709551615, a site that no body"},
        {"particles/id", 45, "row 7 of id is 45, a site that no body has"},
        {"particles/mass", 0, "row 7 of mass is 0, where a positive number is wanted"},
        {"particles/energy", bits_of((double)NAN), "of energy is"},
        {"particles/velocity", bits_of(-3e8), "of velocity is -3e+08, where a speed below that"},
        {"particles/position", bits_of(1e300), "of position is 1e+300, where a place that light"},
        {"particles/density", bits_of(-1.0), "row 7 of density is -1, where a positive number"},
        {"particles/plastic_strain", bits_of(-1.0),
         "row 7 of plastic_strain is -1, where a number that is not negative is wanted"},
        {"particles/id", 1, "id 1 is there twice"},
        {"particles/count", (uint64_t)1 << 40, "particles/count is 1099511627776: a file of this"},
        {"time", bits_of(1.0), "time is 1 s, where the run goes from 0 to 5e-05 s"},
        {"step", (uint64_t)1 << 63, "step is -9223372036854775808, which no run reaches"},
        {"run/history_rows", 7, "a number of the group run does not fit step 5"},
        {"run/snapshots", (uint64_t)1 << 60, "run/snapshots is 1152921504606846976: a file"},
        {"probes/0/rows", 7, "a number of probe \"first\" does not fit step 5"},
        {"ledger", (uint64_t)1 << 63, "is not the digits of a sum"},
    };
    run_half(input);
    for (size_t i = 0; i < COUNT_OF(edits); i++) {
        hid_t file = open_copy();
        edit(file, edits[i].name, has_prefix(edits[i].name, "particles/") ? 7 : 0, edits[i].bits);
        H5Fclose(file);
        struct error *error = resume(input);
        assert_non_null(error);
        if (!strstr(error_message(error, 0), edits[i].words) ||
            !strstr(error_message(error, 0), "edited/checkpoint.h5"))
            fail_msg("\"%s\" has no \"%s\"", error_message(error, 0), edits[i].words);
        error_free(error);
    }
    case_free(input);
}

static void refused(const struct simulation_case *input, const char *words)
{
    alarm(30);
    struct error *error = resume(input);
    alarm(0);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    if (!strstr(error_message(error, 0), words))
        fail_msg("\"%s\" has no \"%s\"", error_message(error, 0), words);
    error_free(error);
}

/* The other file is the checkpoint of the same run, or a pipe, for which a reader waits. */
static void numbers_outside_the_file_are_not_read(void **state)
{
    (void)state;
    struct simulation_case *input = read_case("sph");
    static const char name[] = "particles/mass";
    char pipe[96], other[96];
    run_half(input);
    snprintf(pipe, sizeof pipe, "%s/pipe", folder);
    snprintf(other, sizeof other, "%s/half/checkpoint.h5", folder);
    assert_int_equal(mkfifo(pipe, 0666), 0);

    hid_t file = open_copy();
    H5Ldelete(file, name, H5P_DEFAULT);
    assert_true(H5Lcreate_external(other, name, file, name, H5P_DEFAULT, H5P_DEFAULT) >= 0);
    H5Fclose(file);
    refused(input, "particles/mass is a link to elsewhere");

    file = open_copy();
    H5Ldelete(file, name, H5P_DEFAULT);
    assert_true(H5Lcreate_soft("/particles/density", file, name, H5P_DEFAULT, H5P_DEFAULT) >= 0);
    H5Fclose(file);
    refused(input, "particles/mass is a link to elsewhere");

    file = open_copy();
    const hsize_t size[2] = {90, 1};
    hid_t space = H5Screate_simple(2, size, NULL), list = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(list, pipe, 0, 720);
    H5Ldelete(file, name, H5P_DEFAULT);
    H5Dclose(H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, list, H5P_DEFAULT));
    H5Pclose(list);
    H5Fclose(file);
    refused(input, "the numbers of particles/mass are in other files");

    file = open_copy();
    list = H5Pcreate(H5P_DATASET_CREATE);
    assert_true(H5Pset_virtual(list, space, other, name, space) >= 0);
    H5Ldelete(file, name, H5P_DEFAULT);
    H5Dclose(H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, list, H5P_DEFAULT));
    H5Pclose(list);
    H5Sclose(space);
    H5Fclose(file);
    refused(input, "the numbers of particles/mass are in other files");
    case_free(input);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(an_edited_number_of_sph_never_crashes),
        IN_FOLDER(an_edited_number_of_mpm_never_crashes),
        IN_FOLDER(what_the_case_has_not_is_named),
        IN_FOLDER(numbers_outside_the_file_are_not_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
