/* checkpoint.h5: one dataset for each array that a visitor is shown, '/' in its name makes groups;
 * see checkpoint.h. Every dataset carries HDF5's Fletcher32 checksum, and so do the file's own
 * structures, so that a damaged file is refused instead of believed. */
#include "output/checkpoint.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"
#include "output/hdf5_file.h"
#include "output/rows.h"

enum { FORMAT = 3, CHUNK_BYTES = 1 << 20 };

static const char case_name[] = "case", format_name[] = "bolide checkpoint format";

/* A visitor must come first in what it stands for: visit() gets the pointer to it. */
struct file_visitor {
    struct visitor visitor;
    hid_t file; /* of a saver open on rank 0 alone, of a loader on all */
    const struct ranks *ranks;
    struct error *error; /* the first of a saver, which lets nobody wait */
};

static hid_t number_type(enum number number)
{
    switch (number) {
    case NUMBER_DOUBLE:
        return H5T_NATIVE_DOUBLE;
    case NUMBER_INT64:
        return H5T_NATIVE_INT64;
    case NUMBER_UINT64:
        return H5T_NATIVE_UINT64;
    case NUMBER_UINT16:
        return H5T_NATIVE_UINT16;
    }
    return H5I_INVALID_HID;
}

/* Chunks of about a megabyte, since checksums belong to chunks; an empty dataset has none. */
static hid_t creation_list(hid_t type, const hsize_t size[2])
{
    hid_t list = hdf5_creation_list(H5P_DATASET_CREATE);
    if (size[0] == 0)
        return list;
    hsize_t rows = CHUNK_BYTES / (size[1] * H5Tget_size(type));
    hsize_t chunk[2] = {rows < 1 ? 1 : rows > size[0] ? size[0] : rows, size[1]};
    H5Pset_chunk(list, 2, chunk);
    H5Pset_fletcher32(list);
    return list;
}

static bool make_group(hid_t file, const char *group)
{
    if (H5Lexists(file, group, H5P_DEFAULT) > 0)
        return true;
    hid_t creation = hdf5_creation_list(H5P_GROUP_CREATE);
    hid_t made = H5Gcreate2(file, group, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Pclose(creation);
    return made >= 0 && H5Gclose(made) >= 0;
}

/* The groups of NAME that are not there yet; left to H5Dcreate2 they would carry times. */
static bool make_groups(hid_t file, const char *name)
{
    bool made = true;
    for (const char *slash = strchr(name, '/'); slash && made; slash = strchr(slash + 1, '/')) {
        char *group = text_copy_part(name, (size_t)(slash - name));
        made = group && make_group(file, group);
        free(group);
    }
    return made;
}

static struct error *write_array(hid_t file, const char *name, hid_t type, const void *data,
                                 const hsize_t size[2])
{
    hid_t space = H5Screate_simple(2, size, NULL);
    hid_t creation = creation_list(type, size);
    bool grouped = make_groups(file, name);
    hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    struct error *error = NULL;
    if (!grouped || dataset < 0 || H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
        error = hdf5_error(ERROR_SYSTEM, "%s cannot be written", name);
    if (dataset >= 0)
        H5Dclose(dataset);
    H5Pclose(creation);
    H5Sclose(space);
    return error;
}

/* Rows of one rank after another. */
struct sink {
    hid_t dataset, space, type;
    const char *name;
    int components;
};

static struct error *put_rows(void *context, int64_t at, int64_t count, const void *rows)
{
    const struct sink *sink = context;
    const hsize_t start[2] = {(hsize_t)at, 0};
    const hsize_t part[2] = {(hsize_t)count, (hsize_t)sink->components};
    hid_t memory = H5Screate_simple(2, part, NULL);
    struct error *error = NULL;
    if (sink->dataset < 0 ||
        H5Sselect_hyperslab(sink->space, H5S_SELECT_SET, start, NULL, part, NULL) < 0 ||
        H5Dwrite(sink->dataset, sink->type, memory, sink->space, H5P_DEFAULT, rows) < 0)
        error = hdf5_error(ERROR_SYSTEM, "%s cannot be written", sink->name);
    H5Sclose(memory);
    return error;
}

struct array {
    const char *data;
    size_t bytes;
};

static void fill_from_array(const void *context, int64_t begin, int64_t end, void *out)
{
    const struct array *array = context;
    memcpy(out, array->data + (size_t)begin * array->bytes, (size_t)(end - begin) * array->bytes);
}

/* Collective: an array whose rows are spread over the ranks. */
static struct error *write_spread(const struct file_visitor *saver, const char *name,
                                  enum number number, const void *data, int64_t count,
                                  int components)
{
    const hsize_t size[2] = {(hsize_t)saver->visitor.total, (hsize_t)components};
    const struct array array = {data, number_size(number) * (size_t)components};
    const struct rows rows = {count, array.bytes, array.bytes, fill_from_array, &array};
    struct sink sink = {H5I_INVALID_HID, H5I_INVALID_HID, number_type(number), name, components};
    if (saver->file >= 0 && !saver->error) {
        sink.space = H5Screate_simple(2, size, NULL);
        hid_t creation = creation_list(sink.type, size);
        if (make_groups(saver->file, name))
            sink.dataset = H5Dcreate2(saver->file, name, sink.type, sink.space, H5P_DEFAULT,
                                      creation, H5P_DEFAULT);
        H5Pclose(creation);
    }
    struct error *error = rows_pass(saver->ranks, &rows, put_rows, &sink, saver->error);
    if (sink.dataset >= 0)
        H5Dclose(sink.dataset);
    if (sink.space >= 0)
        H5Sclose(sink.space);
    return error;
}

static struct error *save(struct visitor *visitor, const char *name, enum number number, void *data,
                          int64_t count, int components)
{
    struct file_visitor *saver = (struct file_visitor *)visitor;
    const hsize_t size[2] = {(hsize_t)count, (hsize_t)components};
    if (saver->ranks->joined && visitor->total)
        saver->error = write_spread(saver, name, number, data, count, components);
    else if (saver->file >= 0 && !saver->error)
        saver->error = write_array(saver->file, name, number_type(number), data, size);
    return NULL;
}

/* The type of a text of LENGTH bytes. */
static hid_t text_type(size_t length)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, length ? length : 1);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    return type;
}

static struct error *write_head(hid_t file, const char *case_text)
{
    static const hsize_t one[2] = {1, 1};
    const int64_t format = FORMAT;
    TRY(write_array(file, format_name, H5T_NATIVE_INT64, &format, one));
    hid_t type = text_type(strlen(case_text));
    struct error *error = write_array(file, case_name, type, case_text, one);
    H5Tclose(type);
    return error;
}

static struct error *visit_all(const struct checkpoint *checkpoint, struct visitor *visitor)
{
    TRY(simulation_visit(checkpoint->simulation, visitor));
    if (checkpoint->method->state)
        TRY(checkpoint->method->state(checkpoint->solver, visitor));
    return checkpoint->extra ? checkpoint->extra(checkpoint->context, visitor) : NULL;
}

struct error *checkpoint_write(const char *path, const struct checkpoint *checkpoint)
{
    struct hdf5_printing printing = hdf5_quiet();
    const struct ranks *ranks = checkpoint->simulation->ranks;
    struct file_visitor saver = {{.visit = save}, H5I_INVALID_HID, ranks, NULL};
    if (ranks->rank == 0)
        saver.error = hdf5_create(path, true, &saver.file);
    if (saver.file >= 0)
        saver.error = write_head(saver.file, checkpoint->case_text);
    struct error *error = visit_all(checkpoint, &saver.visitor);
    error = error_join(saver.error, error);
    if (saver.file >= 0)
        error = hdf5_finish(path, saver.file, error_context(error, "%s", path));
    hdf5_restore(printing);
    return ranks_agree(ranks, error);
}

/* Opens the dataset NAME, whose size must be SIZE. */
static struct error *open_array(hid_t file, const char *name, const hsize_t size[2], hid_t *dataset)
{
    hsize_t found[2] = {0, 0};
    TRY(hdf5_open_dataset(file, name, dataset));
    hid_t space = H5Dget_space(*dataset);
    int rank = space < 0 ? -1 : H5Sget_simple_extent_ndims(space);
    if (rank == 2)
        H5Sget_simple_extent_dims(space, found, NULL);
    H5Sclose(space);
    if (rank == 2 && found[0] == size[0] && found[1] == size[1])
        return NULL;
    H5Dclose(*dataset);
    return error_new(ERROR_SYSTEM,
                     "%s has %llu rows of %llu numbers where %llu rows of %llu are wanted", name,
                     (unsigned long long)found[0], (unsigned long long)found[1],
                     (unsigned long long)size[0], (unsigned long long)size[1]);
}

/* The COUNT rows from FIRST on. */
static bool read_rows(hid_t dataset, hid_t type, int64_t first, int64_t count, int components,
                      void *data)
{
    const hsize_t start[2] = {(hsize_t)first, 0};
    const hsize_t part[2] = {(hsize_t)count, (hsize_t)components};
    hid_t space = H5Dget_space(dataset), memory = H5Screate_simple(2, part, NULL);
    bool done =
        count == 0 || (H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, part, NULL) >= 0 &&
                       H5Dread(dataset, type, memory, space, H5P_DEFAULT, data) >= 0);
    H5Sclose(memory);
    H5Sclose(space);
    return done;
}

static struct error *load(struct visitor *visitor, const char *name, enum number number, void *data,
                          int64_t count, int components)
{
    const struct file_visitor *loader = (const struct file_visitor *)visitor;
    const int64_t rows = visitor->total ? visitor->total : count;
    const hsize_t size[2] = {(hsize_t)rows, (hsize_t)components};
    hid_t wanted = number_type(number), dataset;
    TRY(open_array(loader->file, name, size, &dataset));
    hid_t type = H5Dget_type(dataset);
    struct error *error = NULL;
    if (H5Tequal(type, wanted) <= 0)
        error = error_new(ERROR_SYSTEM, "%s holds another type of number than is wanted", name);
    else if (!read_rows(dataset, wanted, visitor->first, count, components, data))
        error = hdf5_error(ERROR_SYSTEM, "%s is damaged", name);
    H5Tclose(type);
    H5Dclose(dataset);
    return error;
}

/* The case text that is stored, in fresh memory. */
static struct error *read_case(hid_t file, char **text)
{
    static const hsize_t one[2] = {1, 1};
    hid_t dataset;
    TRY(open_array(file, case_name, one, &dataset));
    hid_t type = H5Dget_type(dataset);
    size_t size = type >= 0 && H5Tget_class(type) == H5T_STRING ? H5Tget_size(type) : 0;
    *text = memory_allocate(size + 1);
    struct error *error = NULL;
    if (!*text)
        error = out_of_memory();
    else if (!size || H5Tis_variable_str(type) ||
             H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, *text) < 0)
        error = hdf5_error(ERROR_SYSTEM, "its case is damaged");
    if (error)
        free(*text);
    H5Tclose(type);
    H5Dclose(dataset);
    return error;
}

static struct error *check_format(hid_t file)
{
    int64_t format = 0;
    struct file_visitor loader = {{.visit = load}, file, NULL, NULL};
    if (H5Lexists(file, format_name, H5P_DEFAULT) == 0)
        return error_new(ERROR_INPUT, "is no checkpoint of bolide");
    TRY(load(&loader.visitor, format_name, NUMBER_INT64, &format, 1, 1));
    return format == FORMAT
               ? NULL
               : error_new(ERROR_INPUT,
                           "is a checkpoint of format %lld; this program reads format %d",
                           (long long)format, FORMAT);
}

static struct error *open_to_read(const char *path, hid_t *file)
{
    if (access(path, R_OK))
        return error_new(ERROR_INPUT, "cannot be read: %s", strerror(errno));
    if (!file_is_plain(path))
        return error_new(ERROR_INPUT, "is a folder, a pipe or a device: no checkpoint");
    *file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (*file < 0)
        return hdf5_error(ERROR_INPUT, "is no HDF5 file, or a damaged one");
    return NULL;
}

struct error *checkpoint_case(const char *path, const struct ranks *ranks, char **text)
{
    struct hdf5_printing printing = hdf5_quiet();
    hid_t file = H5I_INVALID_HID;
    *text = NULL;
    struct error *error = open_to_read(path, &file);
    if (!error)
        error = check_format(file);
    if (!error)
        error = read_case(file, text);
    error = ranks_agree(ranks, error_context(error, "%s", path));
    if (file >= 0)
        H5Fclose(file);
    hdf5_restore(printing);
    return error;
}

struct error *checkpoint_read(const char *path, const struct checkpoint *checkpoint)
{
    struct hdf5_printing printing = hdf5_quiet();
    hid_t file = H5I_INVALID_HID;
    const struct ranks *ranks = checkpoint->simulation->ranks;
    struct error *error = open_to_read(path, &file);
    if (!error)
        error = check_format(file);
    error = ranks_agree(ranks, error_context(error, "%s", path));
    if (!error) {
        const int64_t most = file_size(path) / (int64_t)sizeof(double);
        struct file_visitor loader = {{.visit = load, .most = most}, file, NULL, NULL};
        error = visit_all(checkpoint, &loader.visitor);
        error = ranks_agree(ranks, error_context(error, "%s", path));
    }
    if (file >= 0)
        H5Fclose(file);
    hdf5_restore(printing);
    return error;
}
