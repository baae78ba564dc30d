/* Snapshots: what lies in the file, and what happens when the disk is full. That VTK's own reader
 * opens them is tested in tests/robustness/test_vtk_reader.py. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <hdf5.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/file.h"
#include "build_simulation.h"
#include "output/snapshot.h"
#include "populations.h"

static char folder[64];
static char path[96];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/bolide-test-XXXXXX");
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/000042.vtkhdf", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[96];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command);
}

static void compute_lever(const struct population *population, int64_t begin, int64_t end,
                          double *out)
{
    (void)population;
    for (int64_t i = begin; i < end; i++)
        *out++ = 0.25 * (double)i;
}

/* The hash that the writer gives is that of the file. */
static struct error *write_snapshot(const struct simulation *simulation)
{
    uint64_t hash = 0, found = 0;
    struct population population = simulation_population(simulation);
    struct column columns[COLUMNS_MAX];
    memcpy(columns, population.column, (size_t)population.columns * sizeof *columns);
    columns[population.columns++] =
        (struct column){"lever", "J/(kg*K)", NULL, 1, -1, compute_lever};
    population.column = columns;
    struct error *error = snapshot_write(path, simulation, &population, &hash);
    if (!error) {
        assert_null(file_hash(path, 0, 1, &found));
        assert_true(hash == found);
    }
    return error;
}

/* Reads the dataset NAME as doubles, ROWS x COMPONENTS of them. */
static void read_numbers(const char *name, hsize_t rows, hsize_t components, double *numbers)
{
    hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
    hid_t space = H5Dget_space(dataset);
    hsize_t size[2] = {0, 1};
    assert_int_equal(H5Sget_simple_extent_ndims(space), components > 1 ? 2 : 1);
    H5Sget_simple_extent_dims(space, size, NULL);
    assert_int_equal(size[0], rows);
    assert_int_equal(size[1], components);
    assert_true(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers) >= 0);
    H5Sclose(space);
    H5Dclose(dataset);
    H5Fclose(file);
}

/* The dataset NAME has UNIT, or with NULL none. */
static void assert_unit(const char *name, const char *unit)
{
    char text[32] = "";
    hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (!unit)
        assert_int_equal(H5Aexists_by_name(file, name, "unit", H5P_DEFAULT), 0);
    else {
        hid_t attribute = H5Aopen_by_name(file, name, "unit", H5P_DEFAULT, H5P_DEFAULT);
        hid_t type = H5Aget_type(attribute);
        assert_true(H5Tget_size(type) < sizeof text && H5Aread(attribute, type, text) >= 0);
        assert_string_equal(text, unit);
        H5Tclose(type);
        H5Aclose(attribute);
    }
    H5Fclose(file);
}

static void a_snapshot_is_a_grid_of_vertices(void **state)
{
    (void)state;
    struct simulation *simulation = build_simulation(5);
    assert_null(write_snapshot(simulation));
    double numbers[15];
    read_numbers("/VTKHDF/NumberOfPoints", 1, 1, numbers);
    assert_true(numbers[0] == 5.0);
    read_numbers("/VTKHDF/NumberOfCells", 1, 1, numbers);
    assert_true(numbers[0] == 5.0);
    read_numbers("/VTKHDF/Points", 5, 3, numbers);
    assert_true(numbers[3] == particles_of(simulation)->position[1][0] && numbers[4] == 0.1);
    read_numbers("/VTKHDF/Offsets", 6, 1, numbers);
    assert_true(numbers[0] == 0.0 && numbers[5] == 5.0);
    read_numbers("/VTKHDF/Connectivity", 5, 1, numbers);
    assert_true(numbers[4] == 4.0);
    read_numbers("/VTKHDF/Types", 5, 1, numbers);
    assert_true(numbers[0] == 1.0 && numbers[4] == 1.0);
    read_numbers("/VTKHDF/FieldData/time", 1, 1, numbers);
    assert_true(numbers[0] == 1.5e-6);
    drop_simulation(simulation);
}

static void fields_have_plain_names_and_units(void **state)
{
    (void)state;
    struct simulation *simulation = build_simulation(5);
    assert_null(write_snapshot(simulation));
    double numbers[30];
    read_numbers("/VTKHDF/PointData/density", 5, 1, numbers);
    assert_true(numbers[4] == 1004.0);
    read_numbers("/VTKHDF/PointData/velocity", 5, 3, numbers);
    assert_true(numbers[3] == 3.0 && numbers[4] == 4.0);
    read_numbers("/VTKHDF/PointData/stress", 5, 6, numbers);
    assert_true(numbers[0] == 1e6 - 1e9 && numbers[5] == 6e6);
    read_numbers("/VTKHDF/PointData/energy", 5, 1, numbers);
    read_numbers("/VTKHDF/PointData/lever", 5, 1, numbers);
    assert_true(numbers[3] == 0.75);
    read_numbers("/VTKHDF/PointData/plastic_strain", 5, 1, numbers);
    assert_unit("/VTKHDF/PointData/density", "kg/m^3");
    assert_unit("/VTKHDF/PointData/lever", "J/(kg*K)");
    assert_unit("/VTKHDF/PointData/plastic_strain", NULL);
    assert_unit("/VTKHDF/FieldData/time", "s");
    read_numbers("/VTKHDF/PointData/material", 5, 1, numbers);
    assert_true(numbers[2] == 2.0);
    drop_simulation(simulation);
}

static void many_slices_make_one_field(void **state)
{
    (void)state;
    enum { COUNT = (1 << 19) + 3 };
    struct simulation *simulation = build_simulation(COUNT);
    assert_null(write_snapshot(simulation));
    double *numbers = malloc(COUNT * sizeof *numbers);
    read_numbers("/VTKHDF/PointData/lever", COUNT, 1, numbers);
    for (int i = 0; i < COUNT; i++)
        assert_true(numbers[i] == 0.25 * i);
    free(numbers);
    drop_simulation(simulation);
}

static void a_snapshot_of_nothing_is_written(void **state)
{
    (void)state;
    struct simulation *simulation = build_simulation(0);
    assert_null(write_snapshot(simulation));
    double numbers[1];
    read_numbers("/VTKHDF/Offsets", 1, 1, numbers);
    drop_simulation(simulation);
}

/* The limit of a file's size stands for the disk's: the write fails alike. */
static void a_full_disk_is_an_error_and_leaves_nothing(void **state)
{
    (void)state;
    struct simulation *simulation = build_simulation(20000);
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit before, few;
    getrlimit(RLIMIT_FSIZE, &before);
    few = before;
    static const rlim_t limits[] = {100, 10000, 1000000, 2000000};
    for (size_t i = 0; i < COUNT_OF(limits); i++) {
        few.rlim_cur = limits[i];
        setrlimit(RLIMIT_FSIZE, &few);
        struct error *error = write_snapshot(simulation);
        setrlimit(RLIMIT_FSIZE, &before);
        assert_non_null(error);
        assert_int_equal(error_kind(error), ERROR_SYSTEM);
        assert_int_equal(error_count(error), 1);
        assert_non_null(strstr(error_message(error, 0), "000042.vtkhdf: "));
        if (!strstr(error_message(error, 0), "File too large"))
            fail_msg("\"%s\" does not tell why", error_message(error, 0));
        error_free(error);
    }
    assert_int_equal(rmdir(folder), 0);
    assert_int_equal(make_folder(state), 0);
    assert_null(write_snapshot(simulation));
    drop_simulation(simulation);
}

static void a_missing_folder_is_an_error(void **state)
{
    (void)state;
    struct simulation *simulation = build_simulation(1);
    snprintf(path, sizeof path, "%s/none/a.vtkhdf", folder);
    struct error *error = write_snapshot(simulation);
    assert_non_null(error);
    assert_non_null(strstr(error_message(error, 0), "No such file"));
    error_free(error);
    drop_simulation(simulation);
}

static void a_series_lists_files_with_times(void **state)
{
    (void)state;
    static const char *const files[] = {"snapshots/000000.vtkhdf", "snapshots/a \"b\".vtkhdf"};
    static const double times[] = {0.0, 0.5};
    assert_null(snapshot_series_write(path, 2, files, times));
    char text[512];
    FILE *file = fopen(path, "r");
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    assert_string_equal(text, "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n"
                              "    {\"name\": \"snapshots/000000.vtkhdf\", \"time\": 0},\n"
                              "    {\"name\": \"snapshots/a \\\"b\\\".vtkhdf\", \"time\": 0.5}\n"
                              "  ]\n}\n");
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(a_snapshot_is_a_grid_of_vertices),
        IN_FOLDER(fields_have_plain_names_and_units),
        IN_FOLDER(many_slices_make_one_field),
        IN_FOLDER(a_snapshot_of_nothing_is_written),
        IN_FOLDER(a_full_disk_is_an_error_and_leaves_nothing),
        IN_FOLDER(a_missing_folder_is_an_error),
        IN_FOLDER(a_series_lists_files_with_times),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
