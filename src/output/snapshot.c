/* Snapshots as VTKHDF 1.0, an UnstructuredGrid in one piece; see snapshot.h. Its cells are
 * vertices where members are particles, with the fields on the points, and lines, pixels or voxels
 * where members are cells, with the fields on the cells (mesh.h). Points are 64-bit floats; the
 * fields, which are there to be looked at, 32-bit. */
#include "output/snapshot.h"

#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "output/mesh.h"
#include "output/shared_file.h"

enum { VTK_VERTEX = 1, VTK_LINE = 3, VTK_PIXEL = 8, VTK_VOXEL = 11 };

/* A snapshot in the making: all datasets are gone through twice, to lay them out and to write the
 * rows of this rank. */
struct writing {
    const struct simulation *simulation;
    const struct population *population;
    struct shared_file file;
    bool laying;               /* out; later writing */
    hid_t group;               /* of the layout, that datasets go to; rank 0 has it */
    int64_t next;              /* dataset to write */
    struct part once, members; /* rows of what all ranks know, which rank 0 writes; of members */
    char *piece;               /* some rows */
    int64_t room;              /* for bytes of them */
};

enum { ROWS_AT_ONCE = 1 << 18 };

/* A dataset to write: rows of numbers of TYPE, found by FILL, which puts the rows begin .. end - 1
 * of this rank into OUT; while it works a number may need 8 bytes. */
struct dataset {
    const char *name;
    hid_t type;
    struct part rows;
    int components; /* 1: a plain list of numbers */
    int each;       /* rows of the dataset that a row found by FILL makes */
    void (*fill)(const void *context, int64_t begin, int64_t end, void *out);
    const void *context;
    const char *unit; /* NULL or empty: none */
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

static void lay_out(struct writing *w, const struct dataset *set)
{
    const hsize_t size[2] = {(hsize_t)(set->rows.total * set->each), (hsize_t)set->components};
    hid_t dataset = shared_file_dataset(&w->file, w->group, set->name, set->type,
                                        set->components > 1 ? 2 : 1, size);
    if (dataset < 0)
        return;
    if (set->unit && *set->unit && !put_text(dataset, "unit", set->unit))
        shared_file_fail(&w->file, hdf5_error(ERROR_SYSTEM, "\"%s\" cannot be written", set->name));
    H5Dclose(dataset);
}

/* How many rows from BEGIN on, of COUNT, are written at once. */
static int64_t some_from(int64_t begin, int64_t count)
{
    return count - begin < ROWS_AT_ONCE ? count - begin : ROWS_AT_ONCE;
}

/* Some rows at a time, so that memory does not grow with the members. */
static void write_rows(struct writing *w, const struct dataset *set)
{
    const int64_t numbers = set->components * set->each, index = w->next++,
                  bytes = numbers * (int64_t)H5Tget_size(set->type),
                  most = some_from(0, set->rows.own) * numbers * (int64_t)sizeof(double);
    if (!memory_reserve((void **)&w->piece, &w->room, most, 0, 1))
        shared_file_fail(&w->file, out_of_memory_for("an output"));
    for (int64_t begin = 0; begin < set->rows.own && !w->file.error; begin += ROWS_AT_ONCE) {
        const int64_t some = some_from(begin, set->rows.own);
        set->fill(set->context, begin, begin + some, w->piece);
        shared_file_write(&w->file, index, (set->rows.first + begin) * bytes, w->piece,
                          some * bytes);
    }
}

static void write_dataset(struct writing *w, const struct dataset *set)
{
    if (w->laying)
        lay_out(w, set);
    else
        write_rows(w, set);
}

static void fill_types(const void *context, int64_t begin, int64_t end, void *out)
{
    static const char types[] = {VTK_VERTEX, VTK_LINE, VTK_PIXEL, VTK_VOXEL};
    const struct population *population = context;
    const bool cells = population->kind == POPULATION_OF_CELLS;
    memset(out, types[cells ? population->dimension : 0], (size_t)(end - begin));
}

/* Where the corners of each VTK cell begin in the list of them, for cells from FIRST on. */
struct offsets {
    int64_t first;
    int corners;
};

static void fill_offsets(const void *context, int64_t begin, int64_t end, void *out)
{
    const struct offsets *offsets = context;
    for (int64_t i = begin; i < end; i++)
        ((int64_t *)out)[i - begin] = (offsets->first + i) * offsets->corners;
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

static void write_column(struct writing *w, const struct column *column)
{
    const struct source source = {w->population, column};
    write_dataset(w, &(struct dataset){column->name, H5T_NATIVE_FLOAT, w->members,
                                       column->components, 1, fill_source, &source, column->unit});
}

/* Writes the NAMES that the numbers of a field stand for, as ASCII texts of any length: VTK 9.1
 * reads no others. */
static void write_names(struct writing *w, const char *dataset, const struct named_map *names)
{
    if (!w->laying || w->group < 0 || names->count == 0)
        return;
    hid_t type = H5Tcopy(H5T_C_S1), creation = hdf5_creation_list(H5P_DATASET_CREATE);
    hid_t transfer = H5Pcreate(H5P_DATASET_XFER);
    H5Tset_size(type, H5T_VARIABLE);
    H5Pset_buffer(transfer, 4096, NULL, NULL); /* HDF5's own are two of 1 MiB, zeroed each time */
    hid_t space = H5Screate_simple(1, (const hsize_t[]){(hsize_t)names->count}, NULL);
    hid_t set = H5Dcreate2(w->group, dataset, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    if (set < 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, transfer, names->names) < 0)
        shared_file_fail(&w->file, hdf5_error(ERROR_SYSTEM, "\"%s\" cannot be written", dataset));
    if (set >= 0)
        H5Dclose(set);
    H5Sclose(space);
    H5Pclose(transfer);
    H5Pclose(creation);
    H5Tclose(type);
}

static void write_geometry(struct writing *w, const struct mesh *mesh)
{
    const struct population *p = w->population;
    const struct ranks *ranks = w->simulation->ranks;
    const int64_t ids = w->members.total * mesh->corners;
    const struct part points = {mesh->before, mesh->own, mesh->total};
    const struct offsets offsets = {w->members.first, mesh->corners};
    struct part ends = w->members; /* one more than cells */
    ends.own += ranks->rank == ranks->size - 1;
    ends.total++;
    const struct dataset sets[] = {
        {"NumberOfPoints", H5T_NATIVE_INT64, w->once, 1, 1, fill_one, &mesh->total, NULL},
        {"NumberOfCells", H5T_NATIVE_INT64, w->once, 1, 1, fill_one, &w->members.total, NULL},
        {"NumberOfConnectivityIds", H5T_NATIVE_INT64, w->once, 1, 1, fill_one, &ids, NULL},
        {"Points", H5T_NATIVE_DOUBLE, points, 3, 1, mesh_fill_points, mesh, NULL},
        {"Connectivity", H5T_NATIVE_INT64, w->members, 1, mesh->corners, mesh_fill_corners, mesh,
         NULL},
        {"Offsets", H5T_NATIVE_INT64, ends, 1, 1, fill_offsets, &offsets, NULL},
        {"Types", H5T_NATIVE_UINT8, w->members, 1, 1, fill_types, p, NULL},
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

static void write_fields(struct writing *w)
{
    const struct population *p = w->population;
    const struct dataset sets[] = {
        {"id", H5T_NATIVE_INT64, w->members, 1, 1, fill_ids, p, NULL},
        {"material", H5T_NATIVE_UINT16, w->members, 1, 1, fill_numbers, p->material, NULL},
        {"body", H5T_NATIVE_UINT16, w->members, 1, 1, fill_numbers, p->body, NULL},
    };
    for (size_t i = 0; i < COUNT_OF(sets); i++)
        write_dataset(w, &sets[i]);
    if (p->kind == POPULATION_OF_CELLS)
        write_dataset(w, &(struct dataset){ghost_name, H5T_NATIVE_UINT8, w->members, 1, 1,
                                           fill_ghosts, p, NULL});
    for (int i = 0; i < p->columns; i++)
        if (strcmp(p->column[i].name, "position") != 0 && snapshot_has(p, p->column[i].name))
            write_column(w, &p->column[i]);
}

static void write_moment(struct writing *w)
{
    const struct dataset sets[] = {
        {"time", H5T_NATIVE_DOUBLE, w->once, 1, 1, fill_one, &w->simulation->time, "s"},
        {"step", H5T_NATIVE_INT64, w->once, 1, 1, fill_one, &w->simulation->step, NULL},
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

enum { ROOT, POINTS, CELLS, FIELDS, GROUPS };

/* The groups of the file, where this rank lays it out. */
static void make_groups(struct writing *w, hid_t group[GROUPS])
{
    static const char *const names[GROUPS] = {"/VTKHDF", "/VTKHDF/PointData", "/VTKHDF/CellData",
                                              "/VTKHDF/FieldData"};
    bool made = true;
    for (int i = 0; i < GROUPS; i++)
        group[i] = H5I_INVALID_HID;
    if (w->file.file < 0)
        return;
    hid_t creation = hdf5_creation_list(H5P_GROUP_CREATE);
    for (int i = 0; i < GROUPS && made; i++) {
        group[i] = H5Gcreate2(w->file.file, names[i], H5P_DEFAULT, creation, H5P_DEFAULT);
        made = group[i] >= 0;
    }
    if (!made || !mark_as_vtk(group[ROOT]))
        shared_file_fail(&w->file, hdf5_error(ERROR_SYSTEM, "the group VTKHDF cannot be made"));
    H5Pclose(creation);
}

static void go_through(struct writing *w, const struct mesh *mesh)
{
    hid_t group[GROUPS];
    make_groups(w, group);
    w->group = group[ROOT];
    write_geometry(w, mesh);
    w->group = group[w->population->kind == POPULATION_OF_CELLS ? CELLS : POINTS];
    write_fields(w);
    w->group = group[FIELDS];
    write_moment(w);
    for (int i = 0; i < GROUPS; i++)
        if (group[i] >= 0)
            H5Gclose(group[i]);
}

struct error *snapshot_write(const char *path, const struct simulation *simulation,
                             const struct population *population, uint64_t *hash)
{
    struct mesh mesh;
    const struct ranks *ranks = simulation->ranks;
    TRY(mesh_make(ranks, population, &mesh));
    struct hdf5_printing printing = hdf5_quiet();
    struct writing writing = {.simulation = simulation,
                              .population = population,
                              .laying = true,
                              .once = {0, ranks->rank == 0, 1},
                              .members = {ranks_before(ranks, population->count), population->count,
                                          ranks_sum(ranks, population->count)}};
    shared_file_create(path, false, ranks, &writing.file);
    writing.file.hashed = hash != NULL;
    go_through(&writing, &mesh);
    shared_file_open(&writing.file);
    writing.laying = false;
    go_through(&writing, &mesh);
    struct error *error = shared_file_finish(&writing.file, hash);
    hdf5_restore(printing);
    free(writing.piece);
    mesh_free(&mesh);
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
