/* Snapshots as VTKHDF 1.0, an UnstructuredGrid in one piece whose cells are vertices; see
 * snapshot.h. Points are 64-bit floats; the fields, which are there to be looked at, 32-bit. */
#include "output/snapshot.h"

#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "output/hdf5_file.h"
#include "output/rows.h"

enum { VTK_VERTEX = 1 };

/* A snapshot in the making: rank 0 writes, the others hand their rows over. The first error stays, and lets nobody
 * wait. */
struct writing {
    const struct simulation *simulation;
    bool here;
    hid_t group; /* that columns go to */
    struct error *error;
};

/* A dataset to write: rows of numbers of TYPE, found by FILL, which puts the rows begin .. end - 1 into OUT. */
struct column {
    const char *name;
    hid_t type;
    int64_t rows;     /* of all ranks */
    int components;   /* 1: a plain list of numbers */
    bool distributed; /* over the ranks, a row a particle; otherwise rank 0 knows all */
    void (*fill)(const void *context, int64_t begin, int64_t end, void *out);
    const void *context;
};

/* Where rows go. */
struct sink {
    hid_t dataset, space;
    const struct column *column;
};

/* HDF5 forgets why a call failed at the next one: an error is made before anything is closed. */
static struct error *put_rows(void *context, int64_t at, int64_t count, const void *rows)
{
    const struct sink *sink = context;
    const struct column *column = sink->column;
    if (sink->dataset < 0)
        return hdf5_error(ERROR_SYSTEM, "\"%s\" cannot be written", column->name);
    hsize_t start[2] = {(hsize_t)at, 0};
    hsize_t part[2] = {(hsize_t)count, (hsize_t)column->components};
    hid_t memory = H5Screate_simple(column->components > 1 ? 2 : 1, part, NULL);
    struct error *error = NULL;
    if (memory < 0 ||
        H5Sselect_hyperslab(sink->space, H5S_SELECT_SET, start, NULL, part, NULL) < 0 ||
        H5Dwrite(sink->dataset, column->type, memory, sink->space, H5P_DEFAULT, rows) < 0)
        error = hdf5_error(ERROR_SYSTEM, "\"%s\" cannot be written", column->name);
    H5Sclose(memory);
    return error;
}

static struct sink open_sink(const struct writing *w, const struct column *column)
{
    hsize_t size[2] = {(hsize_t)column->rows, (hsize_t)column->components};
    struct sink sink = {H5I_INVALID_HID, H5I_INVALID_HID, column};
    if (!w->here || w->error)
        return sink;
    sink.space = H5Screate_simple(column->components > 1 ? 2 : 1, size, NULL);
    hid_t creation = hdf5_creation_list(H5P_DATASET_CREATE);
    sink.dataset = H5Dcreate2(w->group, column->name, column->type, sink.space, H5P_DEFAULT,
                              creation, H5P_DEFAULT);
    H5Pclose(creation);
    return sink;
}

static void write_column(struct writing *w, const struct column *column)
{
    static const struct ranks alone = {0, 1, false};
    const size_t components = (size_t)column->components;
    const struct rows rows = {column->distributed ? w->simulation->particles.count : column->rows,
                              components * H5Tget_size(column->type), components * sizeof(double),
                              column->fill, column->context};
    if (!column->distributed && !w->here)
        return;
    struct sink sink = open_sink(w, column);
    w->error = rows_pass(column->distributed ? w->simulation->ranks : &alone, &rows, put_rows,
                         &sink, w->error);
    if (sink.dataset >= 0)
        H5Dclose(sink.dataset);
    if (sink.space >= 0)
        H5Sclose(sink.space);
}

static void fill_counting(const void *context, int64_t begin, int64_t end, void *out)
{
    (void)context;
    for (int64_t i = begin; i < end; i++)
        ((int64_t *)out)[i - begin] = i;
}

static void fill_types(const void *context, int64_t begin, int64_t end, void *out)
{
    (void)context;
    memset(out, VTK_VERTEX, (size_t)(end - begin));
}

static void fill_positions(const void *context, int64_t begin, int64_t end, void *out)
{
    const struct particles *particles = context;
    memcpy(out, particles->position[begin], (size_t)(end - begin) * sizeof *particles->position);
}

static void fill_ids(const void *context, int64_t begin, int64_t end, void *out)
{
    const struct particles *particles = context;
    memcpy(out, particles->id + begin, (size_t)(end - begin) * sizeof *particles->id);
}

static void fill_numbers(const void *context, int64_t begin, int64_t end, void *out)
{
    const uint16_t *number = context;
    memcpy(out, number + begin, (size_t)(end - begin) * sizeof *number);
}

/* One number of eight bytes. */
static void fill_one(const void *context, int64_t begin, int64_t end, void *out)
{
    (void)begin;
    (void)end;
    memcpy(out, context, sizeof(double));
}

/* Narrows in place: a float is never written behind the double that it comes from. */
static void fill_view(const void *context, int64_t begin, int64_t end, void *out)
{
    const struct view *view = context;
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

static void write_view(struct writing *w, const struct view *view, int64_t count)
{
    char *name = field_name(view);
    if (!name)
        w->error = error_join(w->error, error_new(ERROR_SYSTEM, "out of memory"));
    write_column(w, &(struct column){name ? name : view->name, H5T_NATIVE_FLOAT, count,
                                     view->components, true, fill_view, view});
    free(name);
}

static void write_geometry(struct writing *w, int64_t count)
{
    const struct particles *particles = &w->simulation->particles;
    const struct column columns[] = {
        {"NumberOfPoints", H5T_NATIVE_INT64, 1, 1, false, fill_one, &count},
        {"NumberOfCells", H5T_NATIVE_INT64, 1, 1, false, fill_one, &count},
        {"NumberOfConnectivityIds", H5T_NATIVE_INT64, 1, 1, false, fill_one, &count},
        {"Points", H5T_NATIVE_DOUBLE, count, 3, true, fill_positions, particles},
        {"Connectivity", H5T_NATIVE_INT64, count, 1, false, fill_counting, NULL},
        {"Offsets", H5T_NATIVE_INT64, count + 1, 1, false, fill_counting, NULL},
        {"Types", H5T_NATIVE_UINT8, count, 1, false, fill_types, NULL},
    };
    for (size_t i = 0; i < COUNT_OF(columns); i++)
        write_column(w, &columns[i]);
}

static void write_points(struct writing *w, const struct views *views, int64_t count)
{
    const struct particles *particles = &w->simulation->particles;
    const struct column columns[] = {
        {"id", H5T_NATIVE_INT64, count, 1, true, fill_ids, particles},
        {"material", H5T_NATIVE_UINT16, count, 1, true, fill_numbers, particles->material},
        {"body", H5T_NATIVE_UINT16, count, 1, true, fill_numbers, particles->body},
    };
    for (size_t i = 0; i < COUNT_OF(columns); i++)
        write_column(w, &columns[i]);
    for (int i = 0; i < views->count; i++)
        if (strcmp(views->view[i].name, "position") != 0) /* that is "Points" */
            write_view(w, &views->view[i], count);
}

static void write_moment(struct writing *w)
{
    const struct column columns[] = {
        {"time [s]", H5T_NATIVE_DOUBLE, 1, 1, false, fill_one, &w->simulation->time},
        {"step", H5T_NATIVE_INT64, 1, 1, false, fill_one, &w->simulation->step},
    };
    for (size_t i = 0; i < COUNT_OF(columns); i++)
        write_column(w, &columns[i]);
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

static void write_all(struct writing *w, hid_t file, const struct views *views)
{
    enum { ROOT, POINTS, CELLS, FIELDS, GROUPS };
    static const char *const names[GROUPS] = {"/VTKHDF", "/VTKHDF/PointData", "/VTKHDF/CellData",
                                              "/VTKHDF/FieldData"};
    int64_t count = ranks_sum(w->simulation->ranks, w->simulation->particles.count);
    hid_t group[GROUPS] = {H5I_INVALID_HID, H5I_INVALID_HID, H5I_INVALID_HID, H5I_INVALID_HID};
    bool made = true;
    hid_t creation = hdf5_creation_list(H5P_GROUP_CREATE);
    for (int i = 0; i < GROUPS && w->here && !w->error; i++) {
        group[i] = H5Gcreate2(file, names[i], H5P_DEFAULT, creation, H5P_DEFAULT);
        made = made && group[i] >= 0;
    }
    H5Pclose(creation);
    if (w->here && !w->error && (!made || !mark_as_vtk(group[ROOT])))
        w->error = hdf5_error(ERROR_SYSTEM, "the group VTKHDF cannot be made");
    w->group = group[ROOT];
    write_geometry(w, count);
    w->group = group[POINTS];
    write_points(w, views, count);
    w->group = group[FIELDS];
    write_moment(w);
    for (int i = 0; i < GROUPS; i++)
        if (group[i] >= 0)
            H5Gclose(group[i]);
}

struct error *snapshot_write(const char *path, const struct simulation *simulation,
                             const struct views *views)
{
    struct hdf5_printing printing = hdf5_quiet();
    hid_t file = H5I_INVALID_HID;
    struct writing writing = {.simulation = simulation, .here = simulation->ranks->rank == 0};
    if (writing.here)
        writing.error = hdf5_create(path, false, &file);
    const bool created = writing.here && !writing.error;
    write_all(&writing, file, views);
    if (created)
        writing.error = hdf5_finish(path, file, error_context(writing.error, "%s", path));
    hdf5_restore(printing);
    return ranks_agree(simulation->ranks, writing.error);
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
