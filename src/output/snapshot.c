/* Snapshots as VTKHDF 1.0, an UnstructuredGrid in one piece whose cells are vertices; see
 * snapshot.h. Points are 64-bit floats; the fields, which are there to be looked at, 32-bit. */
#include "output/snapshot.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "output/file.h"
#include "output/hdf5_file.h"

enum { SLICE = 1 << 18, COMPONENTS_MAX = 6, VTK_VERTEX = 1 };

/* A dataset to write: rows of numbers of TYPE in GROUP, either the array DATA, or found slice by
 * slice by FILL, which puts the rows begin .. end - 1 into OUT. */
struct column {
    hid_t group;
    const char *name;
    hid_t type;
    int64_t rows;
    int components; /* 1: a plain list of numbers */
    const void *data;
    void (*fill)(const struct view *view, int64_t begin, int64_t end, void *out);
    const struct view *view;
};

/* HDF5 forgets why a call failed at the next one: an error is made before anything is closed. */
static struct error *write_slice(hid_t dataset, hid_t space, const struct column *column,
                                 int64_t begin, int64_t end, const void *numbers)
{
    hsize_t start[2] = {(hsize_t)begin, 0};
    hsize_t part[2] = {(hsize_t)(end - begin), (hsize_t)column->components};
    hid_t memory = H5Screate_simple(column->components > 1 ? 2 : 1, part, NULL);
    struct error *error = NULL;
    if (memory < 0 || H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, part, NULL) < 0 ||
        H5Dwrite(dataset, column->type, memory, space, H5P_DEFAULT, numbers) < 0)
        error = hdf5_error(ERROR_SYSTEM, "\"%s\" cannot be written", column->name);
    H5Sclose(memory);
    return error;
}

static struct error *write_slices(hid_t dataset, hid_t space, const struct column *column)
{
    int64_t most = column->rows < SLICE ? column->rows : SLICE;
    void *numbers = memory_allocate((size_t)most * COMPONENTS_MAX * sizeof(double));
    struct error *error = numbers ? NULL : error_new(ERROR_SYSTEM, "out of memory");
    for (int64_t begin = 0; begin < column->rows && !error; begin += SLICE) {
        int64_t end = begin + SLICE < column->rows ? begin + SLICE : column->rows;
        column->fill(column->view, begin, end, numbers);
        error = write_slice(dataset, space, column, begin, end, numbers);
    }
    free(numbers);
    return error;
}

static struct error *write_column(const struct column *column)
{
    hsize_t size[2] = {(hsize_t)column->rows, (hsize_t)column->components};
    hid_t space = H5Screate_simple(column->components > 1 ? 2 : 1, size, NULL);
    hid_t creation = hdf5_creation_list(H5P_DATASET_CREATE);
    hid_t dataset = H5Dcreate2(column->group, column->name, column->type, space, H5P_DEFAULT,
                               creation, H5P_DEFAULT);
    H5Pclose(creation);
    struct error *error = NULL;
    if (dataset < 0 || (column->data && H5Dwrite(dataset, column->type, H5S_ALL, H5S_ALL,
                                                 H5P_DEFAULT, column->data) < 0))
        error = hdf5_error(ERROR_SYSTEM, "\"%s\" cannot be written", column->name);
    else if (column->fill)
        error = write_slices(dataset, space, column);
    if (dataset >= 0)
        H5Dclose(dataset);
    H5Sclose(space);
    return error;
}

static void fill_counting(const struct view *view, int64_t begin, int64_t end, void *out)
{
    (void)view;
    for (int64_t i = begin; i < end; i++)
        ((int64_t *)out)[i - begin] = i;
}

static void fill_types(const struct view *view, int64_t begin, int64_t end, void *out)
{
    (void)view;
    memset(out, VTK_VERTEX, (size_t)(end - begin));
}

/* Narrows in place: a float is never written behind the double that it comes from. */
static void fill_view(const struct view *view, int64_t begin, int64_t end, void *out)
{
    view_read(view, begin, end, out);
    for (int64_t i = 0; i < (end - begin) * view->components; i++) {
        double wide;
        memcpy(&wide, (const char *)out + i * (int64_t)sizeof wide, sizeof wide);
        float narrow = (float)wide;
        memcpy((char *)out + i * (int64_t)sizeof narrow, &narrow, sizeof narrow);
    }
}

/* "velocity [m s-1]" in fresh memory. HDF5 takes '/' in a name for a path, so that what stands
 * behind one gets a negative exponent, as in the CF conventions: "J/(kg*K)" is "J kg-1 K-1". */
static char *field_name(const struct view *view)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fputs(view->name, out);
    const char *opening = " [";
    bool below = false, group = false;
    for (const char *at = view->unit ? view->unit : ""; *at;) {
        if (*at == '/' || *at == '(' || *at == ')' || *at == '*') {
            below = *at == '/' || (group && *at != ')') || (below && *at == '(');
            group = *at == '(' || (group && *at != ')');
            at++;
            continue;
        }
        int length = (int)strcspn(at, "/*()^");
        const char *symbol = at;
        char *end = (char *)at + length;
        long power = *end == '^' ? strtol(end + 1, &end, 10) : 1;
        at = end;
        if (length == 1 && *symbol == '1')
            continue;
        fprintf(out, "%s%.*s", opening, length, symbol);
        if (below || power != 1)
            fprintf(out, "%ld", below ? -power : power);
        opening = " ";
    }
    if (opening[1] == '\0')
        fputc(']', out);
    return fclose(out) ? NULL : text;
}

static struct error *write_view(hid_t group, const struct view *view, int64_t count)
{
    char *name = field_name(view);
    if (!name)
        return error_new(ERROR_SYSTEM, "out of memory");
    struct error *error = write_column(&(struct column){group, name, H5T_NATIVE_FLOAT, count,
                                                        view->components, NULL, fill_view, view});
    free(name);
    return error;
}

static struct error *write_geometry(hid_t root, const struct particles *particles)
{
    int64_t count = particles->count;
    const struct column columns[] = {
        {root, "NumberOfPoints", H5T_NATIVE_INT64, 1, 1, &count, NULL, NULL},
        {root, "NumberOfCells", H5T_NATIVE_INT64, 1, 1, &count, NULL, NULL},
        {root, "NumberOfConnectivityIds", H5T_NATIVE_INT64, 1, 1, &count, NULL, NULL},
        {root, "Points", H5T_NATIVE_DOUBLE, count, 3, particles->position, NULL, NULL},
        {root, "Connectivity", H5T_NATIVE_INT64, count, 1, NULL, fill_counting, NULL},
        {root, "Offsets", H5T_NATIVE_INT64, count + 1, 1, NULL, fill_counting, NULL},
        {root, "Types", H5T_NATIVE_UINT8, count, 1, NULL, fill_types, NULL},
    };
    for (size_t i = 0; i < COUNT_OF(columns); i++)
        TRY(write_column(&columns[i]));
    return NULL;
}

static struct error *write_points(hid_t group, const struct particles *particles,
                                  const struct views *views)
{
    int64_t count = particles->count;
    const struct column columns[] = {
        {group, "id", H5T_NATIVE_INT64, count, 1, particles->id, NULL, NULL},
        {group, "material", H5T_NATIVE_UINT16, count, 1, particles->material, NULL, NULL},
        {group, "body", H5T_NATIVE_UINT16, count, 1, particles->body, NULL, NULL},
    };
    for (size_t i = 0; i < COUNT_OF(columns); i++)
        TRY(write_column(&columns[i]));
    for (int i = 0; i < views->count; i++)
        if (strcmp(views->view[i].name, "position") != 0) /* that is "Points" */
            TRY(write_view(group, &views->view[i], count));
    return NULL;
}

static struct error *write_moment(hid_t group, const struct simulation *simulation)
{
    TRY(write_column(&(struct column){group, "time [s]", H5T_NATIVE_DOUBLE, 1, 1, &simulation->time,
                                      NULL, NULL}));
    return write_column(
        &(struct column){group, "step", H5T_NATIVE_INT64, 1, 1, &simulation->step, NULL, NULL});
}

/* What makes the group /VTKHDF one: its version and the kind of data, a text of fixed length. */
static bool mark_as_vtk(hid_t root)
{
    static const char kind[] = "UnstructuredGrid";
    const int64_t version[2] = {1, 0};
    hid_t space = H5Screate_simple(1, (const hsize_t[]){2}, NULL);
    hid_t attribute =
        H5Acreate2(root, "Version", H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT);
    bool done = attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_INT64, version) >= 0;
    H5Aclose(attribute);
    H5Sclose(space);

    hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, strlen(kind));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    space = H5Screate(H5S_SCALAR);
    attribute = H5Acreate2(root, "Type", type, space, H5P_DEFAULT, H5P_DEFAULT);
    done = done && attribute >= 0 && H5Awrite(attribute, type, kind) >= 0;
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    return done;
}

static struct error *write_all(hid_t file, const struct simulation *simulation,
                               const struct views *views)
{
    enum { ROOT, POINTS, CELLS, FIELDS, GROUPS };
    static const char *const names[GROUPS] = {"/VTKHDF", "/VTKHDF/PointData", "/VTKHDF/CellData",
                                              "/VTKHDF/FieldData"};
    hid_t group[GROUPS];
    bool made = true;
    hid_t creation = hdf5_creation_list(H5P_GROUP_CREATE);
    for (int i = 0; i < GROUPS; i++) {
        group[i] = H5Gcreate2(file, names[i], H5P_DEFAULT, creation, H5P_DEFAULT);
        made = made && group[i] >= 0;
    }
    H5Pclose(creation);
    struct error *error = NULL;
    if (!made || !mark_as_vtk(group[ROOT]))
        error = hdf5_error(ERROR_SYSTEM, "the group VTKHDF cannot be made");
    if (!error)
        error = write_geometry(group[ROOT], &simulation->particles);
    if (!error)
        error = write_points(group[POINTS], &simulation->particles, views);
    if (!error)
        error = write_moment(group[FIELDS], simulation);
    for (int i = 0; i < GROUPS; i++)
        H5Gclose(group[i]);
    return error;
}

struct error *snapshot_write(const char *path, const struct simulation *simulation,
                             const struct views *views)
{
    struct hdf5_printing printing = hdf5_quiet();
    hid_t file;
    struct error *error = hdf5_create(path, false, &file);
    if (!error) {
        error = error_context(write_all(file, simulation, views), "%s", path);
        error = hdf5_finish(path, file, error);
    }
    hdf5_restore(printing);
    return error;
}

static void write_json_text(FILE *file, const char *text)
{
    fputc('"', file);
    for (const char *at = text; *at; at++) {
        if (*at == '"' || *at == '\\')
            fputc('\\', file);
        fputc(*at, file);
    }
    fputc('"', file);
}

struct error *snapshot_series_write(const char *path, int count, const char *const *files,
                                    const double *times)
{
    FILE *file;
    TRY(file_begin(path, &file));
    fputs("{\n  \"file-series-version\": \"1.0\",\n  \"files\": [", file);
    for (int i = 0; i < count; i++) {
        fputs(i ? ",\n    {\"name\": " : "\n    {\"name\": ", file);
        write_json_text(file, files[i]);
        fprintf(file, ", \"time\": %.17g}", times[i]);
    }
    fputs("\n  ]\n}\n", file);
    return file_end(path, file);
}
