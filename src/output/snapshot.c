/* Snapshots as VTKHDF 1.0, an UnstructuredGrid in one piece; see snapshot.h. Its cells are
 * vertices where members are particles, with the fields on the points, and lines, pixels or voxels
 * where members are cells, with the fields on the cells (mesh.h). Points are 64-bit floats; the
 * fields, which are there to be looked at, 32-bit. */
#include "output/snapshot.h"

#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "output/hdf5_file.h"
#include "output/mesh.h"
#include "output/rows.h"

enum { VTK_VERTEX = 1, VTK_LINE = 3, VTK_PIXEL = 8, VTK_VOXEL = 11 };

/* A snapshot in the making: rank 0 writes, the others hand their rows over. The first error stays,
 * and lets nobody wait. */
struct writing {
    const struct simulation *simulation;
    const struct population *population;
    bool here;
    hid_t group; /* that datasets go to */
    struct error *error;
};

enum { ALONE = -1 };

/* A dataset to write: rows of numbers of TYPE, found by FILL, which puts the rows begin .. end - 1
 * into OUT. */
struct dataset {
    const char *name;
    hid_t type;
    int64_t rows;   /* of all ranks */
    int64_t own;    /* of them, of this rank; ALONE: rank 0 knows all */
    int components; /* 1: a plain list of numbers */
    int each;       /* rows of the dataset that a row found by FILL makes */
    void (*fill)(const void *context, int64_t begin, int64_t end, void *out);
    const void *context;
    const char *unit; /* NULL or empty: none */
};

/* Where rows go. */
struct sink {
    hid_t dataset, space;
    const struct dataset *set;
};

/* Whether OBJECT got the attribute NAME with TEXT. */
static bool put_text(hid_t object, const char *name, const char *text)
{
    hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, strlen(text));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool done = attribute >= 0 && H5Awrite(attribute, type, text) >= 0;
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    return done;
}

/* HDF5 forgets why a call failed at the next one: an error is made before anything is closed. */
static struct error *put_rows(void *context, int64_t at, int64_t count, const void *rows)
{
    const struct sink *sink = context;
    const struct dataset *set = sink->set;
    if (sink->dataset < 0)
        return hdf5_error(ERROR_SYSTEM, "\"%s\" cannot be written", set->name);
    const hsize_t each = (hsize_t)set->each;
    hsize_t start[2] = {(hsize_t)at * each, 0};
    hsize_t part[2] = {(hsize_t)count * each, (hsize_t)set->components};
    hid_t memory = H5Screate_simple(set->components > 1 ? 2 : 1, part, NULL);
    struct error *error = NULL;
    if (memory < 0 ||
        H5Sselect_hyperslab(sink->space, H5S_SELECT_SET, start, NULL, part, NULL) < 0 ||
        H5Dwrite(sink->dataset, set->type, memory, sink->space, H5P_DEFAULT, rows) < 0)
        error = hdf5_error(ERROR_SYSTEM, "\"%s\" cannot be written", set->name);
    H5Sclose(memory);
    return error;
}

static struct sink open_sink(const struct writing *w, const struct dataset *set)
{
    hsize_t size[2] = {(hsize_t)(set->rows * set->each), (hsize_t)set->components};
    struct sink sink = {H5I_INVALID_HID, H5I_INVALID_HID, set};
    if (!w->here || w->error)
        return sink;
    sink.space = H5Screate_simple(set->components > 1 ? 2 : 1, size, NULL);
    hid_t creation = hdf5_creation_list(H5P_DATASET_CREATE);
    sink.dataset =
        H5Dcreate2(w->group, set->name, set->type, sink.space, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Pclose(creation);
    if (sink.dataset >= 0 && set->unit && *set->unit &&
        !put_text(sink.dataset, "unit", set->unit)) {
        H5Dclose(sink.dataset);
        sink.dataset = H5I_INVALID_HID;
    }
    return sink;
}

static void write_dataset(struct writing *w, const struct dataset *set)
{
    static const struct ranks alone = {0, 1, false};
    const size_t components = (size_t)(set->components * set->each);
    const bool distributed = set->own != ALONE;
    const struct rows rows = {distributed ? set->own : set->rows,
                              components * H5Tget_size(set->type), components * sizeof(double),
                              set->fill, set->context};
    if (!distributed && !w->here)
        return;
    struct sink sink = open_sink(w, set);
    w->error =
        rows_pass(distributed ? w->simulation->ranks : &alone, &rows, put_rows, &sink, w->error);
    if (sink.dataset >= 0)
        H5Dclose(sink.dataset);
    if (sink.space >= 0)
        H5Sclose(sink.space);
}

static void fill_types(const void *context, int64_t begin, int64_t end, void *out)
{
    static const char types[] = {VTK_VERTEX, VTK_LINE, VTK_PIXEL, VTK_VOXEL};
    const struct population *population = context;
    const bool cells = population->kind == POPULATION_OF_CELLS;
    memset(out, types[cells ? population->dimension : 0], (size_t)(end - begin));
}

/* Where the corners of each VTK cell begin in the list of them. */
static void fill_offsets(const void *context, int64_t begin, int64_t end, void *out)
{
    const struct mesh *mesh = context;
    for (int64_t i = begin; i < end; i++)
        ((int64_t *)out)[i - begin] = i * mesh->corners;
}

static void fill_ids(const void *context, int64_t begin, int64_t end, void *out)
{
    const struct population *particles = context;
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

/* A column of the members. */
struct source {
    const struct population *population;
    const struct column *column;
};

/* Narrows in place: a float is never written behind the double that it comes from. Where a cell is
 * blocked there is nothing to have a number. */
static void fill_source(const void *context, int64_t begin, int64_t end, void *out)
{
    const struct source *source = context;
    const int components = source->column->components;
    column_read(source->population, source->column, begin, end, out);
    for (int64_t i = 0; i < (end - begin) * components; i++) {
        double wide;
        memcpy(&wide, (const char *)out + i * (int64_t)sizeof wide, sizeof wide);
        float narrow = (float)wide;
        if (!population_has(source->population, (int32_t)(begin + i / components)))
            narrow = (float)NAN;
        memcpy((char *)out + i * (int64_t)sizeof narrow, &narrow, sizeof narrow);
    }
}

static void write_column(struct writing *w, const struct column *column, int64_t count)
{
    const struct source source = {w->population, column};
    write_dataset(w, &(struct dataset){column->name, H5T_NATIVE_FLOAT, count, w->population->count,
                                       column->components, 1, fill_source, &source, column->unit});
}

/* Writes the NAMES that the numbers of a field stand for, as ASCII texts of any length: VTK 9.1
 * reads no others. */
static void write_names(struct writing *w, const char *dataset, const struct named_map *names)
{
    if (!w->here || w->error || names->count == 0)
        return;
    hid_t type = H5Tcopy(H5T_C_S1), creation = hdf5_creation_list(H5P_DATASET_CREATE);
    hid_t transfer = H5Pcreate(H5P_DATASET_XFER);
    H5Tset_size(type, H5T_VARIABLE);
    H5Pset_buffer(transfer, 4096, NULL, NULL); /* HDF5's own are two of 1 MiB, zeroed each time */
    hid_t space = H5Screate_simple(1, (const hsize_t[]){(hsize_t)names->count}, NULL);
    hid_t set = H5Dcreate2(w->group, dataset, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    if (set < 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, transfer, names->names) < 0)
        w->error = hdf5_error(ERROR_SYSTEM, "\"%s\" cannot be written", dataset);
    if (set >= 0)
        H5Dclose(set);
    H5Sclose(space);
    H5Pclose(transfer);
    H5Pclose(creation);
    H5Tclose(type);
}

static void write_geometry(struct writing *w, const struct mesh *mesh, int64_t count)
{
    const struct population *p = w->population;
    const int64_t ids = count * mesh->corners;
    const struct dataset sets[] = {
        {"NumberOfPoints", H5T_NATIVE_INT64, 1, ALONE, 1, 1, fill_one, &mesh->total, NULL},
        {"NumberOfCells", H5T_NATIVE_INT64, 1, ALONE, 1, 1, fill_one, &count, NULL},
        {"NumberOfConnectivityIds", H5T_NATIVE_INT64, 1, ALONE, 1, 1, fill_one, &ids, NULL},
        {"Points", H5T_NATIVE_DOUBLE, mesh->total, mesh->own, 3, 1, mesh_fill_points, mesh, NULL},
        {"Connectivity", H5T_NATIVE_INT64, count, p->count, 1, mesh->corners, mesh_fill_corners,
         mesh, NULL},
        {"Offsets", H5T_NATIVE_INT64, count + 1, ALONE, 1, 1, fill_offsets, mesh, NULL},
        {"Types", H5T_NATIVE_UINT8, count, ALONE, 1, 1, fill_types, p, NULL},
    };
    for (size_t i = 0; i < COUNT_OF(sets); i++)
        write_dataset(w, &sets[i]);
}

/* VTK's name for what a viewer hides, and its mark of a cell that is there only for the grid. */
static const char ghost_name[] = "vtkGhostType";
enum { VTK_HIDDEN_CELL = 32 };

static void fill_ghosts(const void *context, int64_t begin, int64_t end, void *out)
{
    const struct population *cells = context;
    for (int64_t i = begin; i < end; i++)
        ((unsigned char *)out)[i - begin] = population_has(cells, (int32_t)i) ? 0 : VTK_HIDDEN_CELL;
}

bool snapshot_has(const struct population *population, const char *column)
{
    return population->kind != POPULATION_OF_CELLS ||
           (strcmp(column, "stress") != 0 && strcmp(column, "equivalent_stress") != 0);
}

static void write_fields(struct writing *w, int64_t count)
{
    const struct population *p = w->population;
    const struct dataset sets[] = {
        {"id", H5T_NATIVE_INT64, count, p->count, 1, 1, fill_ids, p, NULL},
        {"material", H5T_NATIVE_UINT16, count, p->count, 1, 1, fill_numbers, p->material, NULL},
        {"body", H5T_NATIVE_UINT16, count, p->count, 1, 1, fill_numbers, p->body, NULL},
    };
    for (size_t i = 0; i < COUNT_OF(sets); i++)
        write_dataset(w, &sets[i]);
    if (p->kind == POPULATION_OF_CELLS)
        write_dataset(w, &(struct dataset){ghost_name, H5T_NATIVE_UINT8, count, p->count, 1, 1,
                                           fill_ghosts, p, NULL});
    for (int i = 0; i < p->columns; i++)
        if (strcmp(p->column[i].name, "position") != 0 && snapshot_has(p, p->column[i].name))
            write_column(w, &p->column[i], count);
}

static void write_moment(struct writing *w)
{
    const struct dataset sets[] = {
        {"time", H5T_NATIVE_DOUBLE, 1, ALONE, 1, 1, fill_one, &w->simulation->time, "s"},
        {"step", H5T_NATIVE_INT64, 1, ALONE, 1, 1, fill_one, &w->simulation->step, NULL},
    };
    const struct simulation_case *input = w->simulation->problem->input;
    for (size_t i = 0; i < COUNT_OF(sets); i++)
        write_dataset(w, &sets[i]);
    if (input) { /* else a program made the particles */
        write_names(w, "bodies", &input->bodies);
        write_names(w, "materials", &input->materials);
    }
}

/* What makes the group /VTKHDF one: its version and the kind of data, a text of fixed length. */
static bool mark_as_vtk(hid_t root)
{
    const int64_t version[2] = {1, 0};
    hid_t space = H5Screate_simple(1, (const hsize_t[]){2}, NULL);
    hid_t attribute =
        H5Acreate2(root, "Version", H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT);
    bool done = attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_INT64, version) >= 0;
    H5Aclose(attribute);
    H5Sclose(space);
    return done && put_text(root, "Type", "UnstructuredGrid");
}

static void write_all(struct writing *w, const struct mesh *mesh, hid_t file)
{
    enum { ROOT, POINTS, CELLS, FIELDS, GROUPS };
    static const char *const names[GROUPS] = {"/VTKHDF", "/VTKHDF/PointData", "/VTKHDF/CellData",
                                              "/VTKHDF/FieldData"};
    int64_t count = ranks_sum(w->simulation->ranks, w->population->count);
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
    write_geometry(w, mesh, count);
    w->group = group[w->population->kind == POPULATION_OF_CELLS ? CELLS : POINTS];
    write_fields(w, count);
    w->group = group[FIELDS];
    write_moment(w);
    for (int i = 0; i < GROUPS; i++)
        if (group[i] >= 0)
            H5Gclose(group[i]);
}

struct error *snapshot_write(const char *path, const struct simulation *simulation,
                             const struct population *population)
{
    struct mesh mesh;
    TRY(mesh_make(simulation->ranks, population, &mesh));
    struct hdf5_printing printing = hdf5_quiet();
    hid_t file = H5I_INVALID_HID;
    struct writing writing = {
        .simulation = simulation, .population = population, .here = simulation->ranks->rank == 0};
    if (writing.here)
        writing.error = hdf5_create(path, false, &file);
    const bool created = writing.here && !writing.error;
    write_all(&writing, &mesh, file);
    if (created)
        writing.error = hdf5_finish(path, file, error_context(writing.error, "%s", path));
    hdf5_restore(printing);
    mesh_free(&mesh);
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
