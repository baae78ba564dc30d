/* Reading snapshots; see snapshot_read.h and snapshot.c, which writes them. */
#include "output/snapshot_read.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "model/columns.h"
#include "output/hdf5_file.h"

enum { VTK_LINE = 3, VTK_PIXEL = 8, VTK_VOXEL = 11 };

/* A snapshot that is being read. */
struct reading {
    hid_t file;
    const char *data; /* the group of its fields */
    int64_t members;
    struct error *error; /* the first */
};

static bool has(const struct reading *r, const char *name)
{
    bool there = H5Lexists(r->file, name, H5P_DEFAULT) > 0;
    H5Eclear2(H5E_DEFAULT);
    return there;
}

/* Reads the dataset NAME, whole or its COMPONENT (-1: all), as numbers of TYPE in fresh memory;
 * *COUNT is how many. */
static void *read_numbers(struct reading *r, const char *name, hid_t type, int component,
                          int64_t *count)
{
    hid_t set;
    if (r->error)
        return NULL;
    r->error = hdf5_open_dataset(r->file, name, &set);
    if (r->error)
        return NULL;
    hid_t space = H5Dget_space(set), memory = H5S_ALL, selected = H5S_ALL;
    hsize_t size[2] = {0, 1};
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank == 1 || rank == 2)
        H5Sget_simple_extent_dims(space, size, NULL);
    if (component >= 0 && rank == 2 && component < (int)size[1]) {
        const hsize_t from[2] = {0, (hsize_t)component}, part[2] = {size[0], 1};
        H5Sselect_hyperslab(space, H5S_SELECT_SET, from, NULL, part, NULL);
        memory = H5Screate_simple(1, size, NULL);
        selected = space;
        size[1] = 1;
    }
    *count = (int64_t)(size[0] * size[1]);
    void *numbers = memory_allocate((size_t)*count * H5Tget_size(type) + 1);
    if (!numbers)
        r->error = out_of_memory_for("a picture");
    else if ((rank != 1 && rank != 2) ||
             H5Dread(set, type, memory, selected, H5P_DEFAULT, numbers) < 0)
        r->error = hdf5_error(ERROR_SYSTEM, "%s cannot be read", name);
    if (memory != H5S_ALL)
        H5Sclose(memory);
    H5Sclose(space);
    H5Dclose(set);
    if (r->error) {
        free(numbers);
        numbers = NULL;
    }
    return numbers;
}

/* The same of a number a member. */
static void *read_column(struct reading *r, const char *name, hid_t type, int component)
{
    int64_t count = 0;
    char path[160];
    snprintf(path, sizeof path, "%s/%s", r->data, name);
    void *numbers = read_numbers(r, path, type, component, &count);
    if (numbers && count != r->members) {
        r->error = error_new(ERROR_SYSTEM, "%s has another number of members", path);
        free(numbers);
        numbers = NULL;
    }
    return numbers;
}

static void read_names(struct reading *r, const char *name, struct frame_names *names)
{
    hid_t set;
    if (r->error || names->count || !has(r, name))
        return;
    r->error = hdf5_open_dataset(r->file, name, &set);
    if (r->error)
        return;
    hid_t space = H5Dget_space(set), type = H5Dget_type(set);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    char **text = count > 0 ? calloc((size_t)count, sizeof *text) : NULL;
    names->name = count > 0 ? calloc((size_t)count, sizeof *names->name) : NULL;
    if (text && names->name && H5Tis_variable_str(type) > 0 &&
        H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) >= 0) {
        names->count = (int)count;
        for (int i = 0; i < names->count; i++)
            names->name[i] = text_copy(text[i] ? text[i] : "?");
        H5Dvlen_reclaim(type, space, H5P_DEFAULT, text);
    }
    H5Eclear2(H5E_DEFAULT);
    free(text);
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(set);
}

static void read_unit(const struct reading *r, const char *column, char *unit, size_t size)
{
    char path[160];
    snprintf(path, sizeof path, "%s/%s", r->data, column);
    unit[0] = '\0';
    hid_t set = H5Dopen2(r->file, path, H5P_DEFAULT);
    if (set >= 0 && H5Aexists(set, "unit") > 0) {
        hid_t attribute = H5Aopen(set, "unit", H5P_DEFAULT), type = H5Aget_type(attribute);
        const size_t length = H5Tget_size(type);
        if (length < size && H5Aread(attribute, type, unit) >= 0)
            unit[length] = '\0';
        else
            unit[0] = '\0';
        H5Tclose(type);
        H5Aclose(attribute);
    }
    if (set >= 0)
        H5Dclose(set);
    H5Eclear2(H5E_DEFAULT);
}

/* How many components the column has; 0: it is not there. */
static int components_of(const struct reading *r, const char *column)
{
    char path[160];
    hsize_t size[2] = {0, 1};
    snprintf(path, sizeof path, "%s/%s", r->data, column);
    if (!has(r, path))
        return 0;
    hid_t set = H5Dopen2(r->file, path, H5P_DEFAULT);
    if (set < 0)
        return 0;
    hid_t space = H5Dget_space(set);
    if (H5Sget_simple_extent_ndims(space) <= 2)
        H5Sget_simple_extent_dims(space, size, NULL);
    H5Sclose(space);
    H5Dclose(set);
    return (int)size[1];
}

/* Adds the field NAME, "pressure" or "velocity.x", where the file has it. */
static void read_field(struct reading *r, const char *name, struct frame_group *group)
{
    char column[72];
    const size_t length = strcspn(name, ".");
    if (r->error || group->fields == FRAME_FIELDS || length >= sizeof column ||
        strlen(name) >= sizeof group->field->name || frame_field(group, name))
        return;
    memcpy(column, name, length);
    column[length] = '\0';
    const int components = components_of(r, column);
    int component = -1;
    for (int k = 0; name[length] && k < components; k++)
        if (!strcmp(column_component_name(components, k), name + length + 1))
            component = k;
    if (components < 1 || (component < 0 && (components > 1 || name[length])))
        return;
    struct frame_field *field = &group->field[group->fields];
    snprintf(field->name, sizeof field->name, "%s", name);
    read_unit(r, column, field->unit, sizeof field->unit);
    field->value = read_column(r, column, H5T_NATIVE_FLOAT, component);
    group->fields += field->value != NULL;
}

/* The centres and the edges of the cells of GROUP between POINTS. */
static void find_centres(struct reading *r, struct frame_group *group, double (*point)[3],
                         int64_t points)
{
    const int64_t corners = 1 << group->cell_dimension;
    int64_t ids = 0;
    int64_t *corner = read_numbers(r, "VTKHDF/Connectivity", H5T_NATIVE_INT64, -1, &ids);
    bool whole = corner && ids == corners * group->count;
    for (int64_t i = 0; i < ids && whole; i++)
        whole = corner[i] >= 0 && corner[i] < points;
    if (!whole && !r->error)
        r->error = error_new(ERROR_SYSTEM, "VTKHDF/Connectivity names other points");
    for (int64_t i = 0; i < group->count && !r->error; i++) {
        const double *low = point[corner[i * corners]],
                     *high = point[corner[(i + 1) * corners - 1]];
        for (int axis = 0; axis < 3; axis++)
            group->position[i][axis] = (float)(0.5 * (low[axis] + high[axis]));
        group->diameter[i] = (float)(high[0] - low[0]);
    }
    free(corner);
}

/* Members are vertices, or cells: the first of their corners is the low one, the last the high
 * one. */
static void read_places(struct reading *r, struct frame_group *group)
{
    int64_t types = 0, numbers = 0;
    unsigned char *type = read_numbers(r, "VTKHDF/Types", H5T_NATIVE_UINT8, -1, &types);
    double(*point)[3] = read_numbers(r, "VTKHDF/Points", H5T_NATIVE_DOUBLE, -1, &numbers);
    r->members = group->count = types;
    if (types && type)
        group->cell_dimension = *type == VTK_LINE    ? 1
                                : *type == VTK_PIXEL ? 2
                                : *type == VTK_VOXEL ? 3
                                                     : 0;
    const int64_t points = numbers / 3;
    if (!r->error && (numbers % 3 || (!group->cell_dimension && points != types)))
        r->error = error_new(ERROR_SYSTEM, "VTKHDF/Points has another number of points");
    group->position = memory_allocate((size_t)types * sizeof *group->position + 1);
    if (group->cell_dimension)
        group->diameter = memory_allocate((size_t)types * sizeof *group->diameter + 1);
    if ((!group->position || (group->cell_dimension && !group->diameter)) && !r->error)
        r->error = out_of_memory_for("a picture");
    if (group->cell_dimension && !r->error)
        find_centres(r, group, point, points);
    for (int64_t i = 0; i < types && !group->cell_dimension && !r->error; i++)
        for (int axis = 0; axis < 3; axis++)
            group->position[i][axis] = (float)point[i][axis];
    free(type);
    free(point);
}

/* (m/rho)^(1/dimension), of snapshots without diameters; the dimension is that of the places. */
static float *find_diameters(struct reading *r, const struct frame_group *group)
{
    float *diameter = read_column(r, "density", H5T_NATIVE_FLOAT, -1);
    int dimension = 1;
    for (int64_t i = 0; i < group->count && diameter; i++)
        for (int axis = dimension; axis < 3; axis++)
            if (group->position[i][axis] != group->position[0][axis])
                dimension = axis + 1;
    for (int64_t i = 0; i < group->count && diameter && group->mass; i++)
        diameter[i] =
            (float)pow((double)group->mass[i] / (double)diameter[i], 1.0 / (double)dimension);
    return diameter;
}

static void read_sizes(struct reading *r, struct frame_group *group)
{
    group->id = read_column(r, "id", H5T_NATIVE_UINT64, -1);
    group->body = read_column(r, "body", H5T_NATIVE_UINT16, -1);
    group->material = read_column(r, "material", H5T_NATIVE_UINT16, -1);
    group->mass = components_of(r, "mass") ? read_column(r, "mass", H5T_NATIVE_FLOAT, -1)
                                           : read_column(r, "density", H5T_NATIVE_FLOAT, -1);
    if (!group->cell_dimension)
        group->diameter = components_of(r, "diameter")
                              ? read_column(r, "diameter", H5T_NATIVE_FLOAT, -1)
                              : find_diameters(r, group);
}

/* Cells that an obstacle blocks are hidden; they have no mass here. */
static void hide_blocked(struct reading *r, struct frame_group *group)
{
    if (r->error || !components_of(r, "vtkGhostType"))
        return;
    unsigned char *hidden = read_column(r, "vtkGhostType", H5T_NATIVE_UINT8, -1);
    for (int64_t i = 0; i < group->count && hidden; i++)
        if (hidden[i])
            group->mass[i] = 0.0f;
    free(hidden);
}

static void read_all(struct reading *r, const char *const *fields, int count, struct frame *frame)
{
    struct frame_group *group = &frame->group[frame->groups++];
    int64_t one;
    *group = (struct frame_group){0};
    double *time = read_numbers(r, "VTKHDF/FieldData/time", H5T_NATIVE_DOUBLE, -1, &one);
    if (time)
        frame->time = *time;
    free(time);
    read_names(r, "VTKHDF/FieldData/bodies", &frame->bodies);
    read_names(r, "VTKHDF/FieldData/materials", &frame->materials);
    read_places(r, group);
    r->data = group->cell_dimension ? "VTKHDF/CellData" : "VTKHDF/PointData";
    read_sizes(r, group);
    hide_blocked(r, group);
    for (int i = 0; i < count; i++)
        read_field(r, fields[i], group);
    if (!r->error)
        r->error = frame_order(group);
}

static struct error *open_snapshot(const char *path, struct reading *r)
{
    *r = (struct reading){.file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT)};
    return r->file >= 0 ? NULL : hdf5_error(ERROR_SYSTEM, "%s: cannot be read", path);
}

struct error *snapshot_read(const char *path, const char *const *fields, int count,
                            struct frame *frame)
{
    struct hdf5_printing printing = hdf5_quiet();
    struct reading r;
    struct error *error = frame->groups < FRAME_GROUPS
                              ? open_snapshot(path, &r)
                              : error_new(ERROR_INPUT, "%s: too many populations", path);
    if (!error) {
        read_all(&r, fields, count, frame);
        error = error_context(r.error, "%s", path);
        H5Fclose(r.file);
    }
    hdf5_restore(printing);
    return error;
}
