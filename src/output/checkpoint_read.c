/* Reading checkpoint.h5, see checkpoint.h and checkpoint_format.h. What all ranks need each reads
 * and checks itself; an array in parts is checked at the end, when all have read theirs. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/checksum.h"
#include "base/file.h"
#include "base/memory.h"
#include "output/checkpoint_format.h"
#include "output/hdf5_file.h"

/* The visitor must come first: visit() gets the pointer to it. */
struct loader {
    struct visitor visitor;
    hid_t file;
    int threads;
    int64_t sums;          /* checksums in the file, once they are read */
    uint64_t *sum, *found; /* themselves; those of the parts that this rank has read */
    char **name;           /* of the datasets that these parts are of */
    struct error *error;   /* the first with a part */
};

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

/* Row *INDEX of the checksums is that of DATASET, called NAME. */
static struct error *find_checksum(const struct loader *loader, hid_t dataset, const char *name,
                                   int64_t *index)
{
    hid_t attribute = H5Aopen(dataset, CHECKPOINT_CHECKSUM, H5P_DEFAULT);
    const bool got = attribute >= 0 && H5Aread(attribute, H5T_NATIVE_INT64, index) >= 0;
    if (attribute >= 0)
        H5Aclose(attribute);
    return got && *index >= 0 && *index < loader->sums
               ? NULL
               : error_new(ERROR_SYSTEM, "%s has no checksum, or a damaged one", name);
}

/* Checks the checksum of a whole DATASET: COUNT numbers of BYTES each at DATA. */
static struct error *check_whole(const struct loader *loader, hid_t dataset, const char *name,
                                 const void *data, size_t bytes, int64_t count)
{
    int64_t index;
    TRY(find_checksum(loader, dataset, name, &index));
    return checksum_of(data, bytes, 0, count, 1) == loader->sum[index]
               ? NULL
               : error_new(ERROR_SYSTEM, "%s is damaged", name);
}

/* Notes the checksum of this rank's part of DATASET, for check_parts. */
static struct error *note_part(const struct loader *loader, hid_t dataset, const char *name,
                               const void *data, size_t bytes, const struct slice *numbers)
{
    int64_t index;
    TRY(find_checksum(loader, dataset, name, &index));
    if (!loader->name[index])
        loader->name[index] = text_copy(name);
    loader->found[index] =
        checksum_of(data, bytes, numbers->begin, numbers->end - numbers->begin, loader->threads);
    return loader->name[index] ? NULL : out_of_memory();
}

/* Collective: the checksums of what the ranks have read together. */
static struct error *check_parts(const struct loader *loader, const struct ranks *ranks)
{
    ranks_sum_of(ranks, (int64_t *)loader->found, (int)loader->sums);
    for (int64_t k = 0; k < loader->sums; k++)
        if (loader->name[k] && loader->found[k] != loader->sum[k])
            return error_new(ERROR_SYSTEM, "%s is damaged", loader->name[k]);
    return NULL;
}

static struct error *load_array(const struct loader *loader, const char *name, enum number number,
                                void *data, int64_t count, int components)
{
    const struct visitor *visitor = &loader->visitor;
    const hsize_t size[2] = {(hsize_t)(visitor->total ? visitor->total : count),
                             (hsize_t)components};
    const struct slice numbers = {visitor->first * components,
                                  (visitor->first + count) * components};
    hid_t wanted = checkpoint_number(number), dataset;
    TRY(open_array(loader->file, name, size, &dataset));
    hid_t type = H5Dget_type(dataset);
    struct error *error = NULL;
    if (H5Tequal(type, wanted) <= 0)
        error = error_new(ERROR_SYSTEM, "%s holds another type of number than is wanted", name);
    else if (!read_rows(dataset, wanted, visitor->first, count, components, data))
        error = hdf5_error(ERROR_SYSTEM, "%s is damaged", name);
    else if (visitor->total)
        error = note_part(loader, dataset, name, data, number_size(number), &numbers);
    else if (loader->sum)
        error = check_whole(loader, dataset, name, data, number_size(number), numbers.end);
    H5Tclose(type);
    H5Dclose(dataset);
    return error;
}

/* Of an array in parts a rank may have an error that others have not, which wait for it in
 * collective calls: it goes on. */
static struct error *load(struct visitor *visitor, const char *name, enum number number, void *data,
                          int64_t count, int components)
{
    struct loader *loader = (struct loader *)visitor;
    struct error *error = load_array(loader, name, number, data, count, components);
    if (!visitor->total)
        return error;
    if (loader->error)
        error_free(error);
    else
        loader->error = error;
    return NULL;
}

/* The case text that is stored, in fresh memory. */
static struct error *read_case(const struct loader *loader, char **text)
{
    static const hsize_t one[2] = {1, 1};
    hid_t dataset;
    TRY(open_array(loader->file, CHECKPOINT_CASE, one, &dataset));
    hid_t type = H5Dget_type(dataset);
    size_t size = type >= 0 && H5Tget_class(type) == H5T_STRING ? H5Tget_size(type) : 0;
    *text = memory_allocate(size + 1);
    struct error *error = NULL;
    if (!*text)
        error = out_of_memory();
    else if (!size || H5Tis_variable_str(type) ||
             H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, *text) < 0)
        error = hdf5_error(ERROR_SYSTEM, "its case is damaged");
    else
        error = check_whole(loader, dataset, "its case", *text, 1, (int64_t)size);
    if (error) {
        free(*text);
        *text = NULL;
    }
    H5Tclose(type);
    H5Dclose(dataset);
    return error;
}

/* Older formats have other checksums, which HDF5 has compared. */
static struct error *check_format(struct loader *loader)
{
    int64_t format = 0;
    if (H5Lexists(loader->file, CHECKPOINT_FORMAT_NAME, H5P_DEFAULT) == 0)
        return error_new(ERROR_INPUT, "is no checkpoint of bolide");
    TRY(load(&loader->visitor, CHECKPOINT_FORMAT_NAME, NUMBER_INT64, &format, 1, 1));
    return format == CHECKPOINT_FORMAT
               ? NULL
               : error_new(ERROR_INPUT,
                           "is a checkpoint of format %lld; this program reads format %d",
                           (long long)format, CHECKPOINT_FORMAT);
}

/* How many rows the dataset of checksums has; 0: that cannot be said. */
static int64_t count_checksums(hid_t file)
{
    hid_t dataset;
    hsize_t size[2] = {0, 0};
    struct error *error = hdf5_open_dataset(file, CHECKPOINT_CHECKSUMS, &dataset);
    if (!error) {
        hid_t space = H5Dget_space(dataset);
        if (H5Sget_simple_extent_ndims(space) == 2)
            H5Sget_simple_extent_dims(space, size, NULL);
        H5Sclose(space);
        H5Dclose(dataset);
    }
    error_free(error);
    return size[0] < INT32_MAX ? (int64_t)size[0] : 0;
}

static struct error *load_checksums(struct loader *loader)
{
    const int64_t sums = count_checksums(loader->file);
    if (sums == 0 || sums > loader->visitor.most)
        return error_new(ERROR_SYSTEM, "has no %s, or damaged ones", CHECKPOINT_CHECKSUMS);
    uint64_t *sum = memory_allocate((size_t)sums * sizeof *sum);
    loader->found = memory_allocate((size_t)sums * sizeof *loader->found);
    loader->name = memory_allocate((size_t)sums * sizeof *loader->name);
    struct error *error = sum && loader->found && loader->name ? NULL : out_of_memory();
    if (!error)
        error = load(&loader->visitor, CHECKPOINT_CHECKSUMS, NUMBER_UINT64, sum, sums, 1);
    loader->sum = sum;
    loader->sums = loader->name ? sums : 0;
    return error;
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

/* Collective. */
static struct error *begin(const char *path, const struct ranks *ranks, int threads,
                           struct loader *loader)
{
    *loader = (struct loader){
        .visitor = {.visit = load, .most = file_size(path) / (int64_t)sizeof(double)},
        .file = H5I_INVALID_HID,
        .threads = threads};
    struct error *error = open_to_read(path, &loader->file);
    if (!error)
        error = check_format(loader);
    if (!error)
        error = load_checksums(loader);
    return ranks_agree(ranks, error_context(error, "%s", path));
}

static void end(struct loader *loader)
{
    for (int64_t k = 0; k < loader->sums; k++)
        free(loader->name[k]);
    free(loader->name);
    free(loader->found);
    free(loader->sum);
    if (loader->file >= 0)
        H5Fclose(loader->file);
}

struct error *checkpoint_case(const char *path, const struct ranks *ranks, char **text)
{
    struct hdf5_printing printing = hdf5_quiet();
    struct loader loader;
    *text = NULL;
    struct error *error = begin(path, ranks, 1, &loader);
    if (!error)
        error = ranks_agree(ranks, error_context(read_case(&loader, text), "%s", path));
    end(&loader);
    hdf5_restore(printing);
    return error;
}

struct error *checkpoint_read(const char *path, const struct checkpoint *checkpoint)
{
    struct hdf5_printing printing = hdf5_quiet();
    const struct ranks *ranks = checkpoint->simulation->ranks;
    struct loader loader;
    struct error *error = begin(path, ranks, checkpoint->simulation->threads, &loader);
    if (!error) {
        error = checkpoint_visit(checkpoint, &loader.visitor);
        error = error_join(loader.error, error);
        error = ranks_agree(ranks, error_context(error, "%s", path));
    }
    if (!error)
        error = ranks_agree(ranks, error_context(check_parts(&loader, ranks), "%s", path));
    end(&loader);
    hdf5_restore(printing);
    return error;
}
