/* Writing checkpoint.h5, see checkpoint.h and checkpoint_format.h: all arrays are shown twice, to
 * lay them out and to write this rank's rows. */
#include "output/checkpoint.h"

#include <stdlib.h>
#include <string.h>

#include "base/checksum.h"
#include "base/memory.h"
#include "output/checkpoint_format.h"
#include "output/shared_file.h"

hid_t checkpoint_number(enum number number)
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

struct error *checkpoint_visit(const struct checkpoint *checkpoint, struct visitor *visitor)
{
    TRY(simulation_visit(checkpoint->simulation, visitor));
    if (checkpoint->method->state)
        TRY(checkpoint->method->state(checkpoint->solver, visitor));
    return checkpoint->extra ? checkpoint->extra(checkpoint->context, visitor) : NULL;
}

/* A visitor must come first in what it stands for: visit() gets the pointer to it. */
struct saver {
    struct visitor visitor;
    struct shared_file file;
    bool laying; /* out; later writing */
    int threads;
    int64_t next;  /* dataset to write */
    uint64_t *sum; /* of each dataset, the checksum of what this rank has written */
};

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

/* An array to save: ROWS of COMPONENTS numbers of BYTES each, in a dataset of SIZE numbers of
 * TYPE. */
struct array {
    const char *name;
    hid_t type;
    hsize_t size[2];
    const void *data;
    struct part rows;
    int64_t components;
    size_t bytes;
};

static bool put_number(hid_t dataset, int64_t number)
{
    hid_t space = H5Screate(H5S_SCALAR);
    hid_t attribute =
        H5Acreate2(dataset, CHECKPOINT_CHECKSUM, H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool done = attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_INT64, &number) >= 0;
    H5Aclose(attribute);
    H5Sclose(space);
    return done;
}

static void lay_out(struct saver *saver, const struct array *array)
{
    struct shared_file *file = &saver->file;
    const int64_t index = file->count;
    const bool grouped = file->file < 0 || make_groups(file->file, array->name);
    hid_t dataset = shared_file_dataset(file, file->file, array->name, array->type, 2, array->size);
    if (dataset < 0)
        return;
    if (!grouped || !put_number(dataset, index))
        shared_file_fail(file, hdf5_error(ERROR_SYSTEM, "\"%s\" cannot be written", array->name));
    H5Dclose(dataset);
}

static void write_rows(struct saver *saver, const struct array *array)
{
    const int64_t index = saver->next++, row = array->components * (int64_t)array->bytes;
    const struct part *rows = &array->rows;
    saver->sum[index] = checksum_of(array->data, array->bytes, rows->first * array->components,
                                    rows->own * array->components, saver->threads);
    shared_file_write(&saver->file, index, rows->first * row, array->data, rows->own * row);
}

static void save_array(struct saver *saver, const struct array *array)
{
    if (saver->laying)
        lay_out(saver, array);
    else
        write_rows(saver, array);
}

/* What is the same on all ranks is written by rank 0. */
static struct part part_of(const struct visitor *visitor, const struct ranks *ranks, int64_t count)
{
    if (visitor->total)
        return (struct part){visitor->first, count, visitor->total};
    return (struct part){0, ranks->rank == 0 ? count : 0, count};
}

static struct error *save(struct visitor *visitor, const char *name, enum number number, void *data,
                          int64_t count, int components)
{
    struct saver *saver = (struct saver *)visitor;
    const struct part rows = part_of(visitor, saver->file.ranks, count);
    save_array(saver, &(struct array){name,
                                      checkpoint_number(number),
                                      {(hsize_t)rows.total, (hsize_t)components},
                                      data,
                                      rows,
                                      components,
                                      number_size(number)});
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

static void save_head(struct saver *saver, const char *text)
{
    int64_t format = CHECKPOINT_FORMAT;
    save(&saver->visitor, CHECKPOINT_FORMAT_NAME, NUMBER_INT64, &format, 1, 1);
    hid_t type = text_type(strlen(text));
    const struct part rows = part_of(&saver->visitor, saver->file.ranks, 1);
    save_array(
        saver,
        &(struct array){CHECKPOINT_CASE, type, {1, 1}, text, rows, (int64_t)H5Tget_size(type), 1});
    H5Tclose(type);
}

/* Collective: goes through all datasets but that of the checksums. */
static void go_through(struct saver *saver, const struct checkpoint *checkpoint)
{
    save_head(saver, checkpoint->case_text);
    shared_file_fail(&saver->file, checkpoint_visit(checkpoint, &saver->visitor));
}

static void lay_out_checksums(struct shared_file *file)
{
    const hsize_t size[2] = {(hsize_t)file->count, 1};
    hid_t dataset =
        shared_file_dataset(file, file->file, CHECKPOINT_CHECKSUMS, H5T_NATIVE_UINT64, 2, size);
    if (dataset >= 0)
        H5Dclose(dataset);
}

/* Collective: the checksum of a whole dataset is the sum of its parts'. */
static void write_checksums(struct saver *saver)
{
    struct shared_file *file = &saver->file;
    file->error = ranks_agree(file->ranks, file->error);
    if (file->error)
        return;
    ranks_sum_of(file->ranks, (int64_t *)saver->sum, (int)saver->next);
    if (file->ranks->rank == 0)
        shared_file_write(file, saver->next, 0, saver->sum,
                          saver->next * (int64_t)sizeof *saver->sum);
}

struct error *checkpoint_write(const char *path, const struct checkpoint *checkpoint)
{
    struct hdf5_printing printing = hdf5_quiet();
    const struct simulation *simulation = checkpoint->simulation;
    struct saver saver = {
        .visitor = {.visit = save}, .laying = true, .threads = simulation->threads};
    shared_file_create(path, true, simulation->ranks, &saver.file);
    go_through(&saver, checkpoint);
    lay_out_checksums(&saver.file);
    saver.laying = false;
    saver.sum = memory_allocate((size_t)saver.file.count * sizeof *saver.sum);
    if (!saver.sum)
        shared_file_fail(&saver.file, out_of_memory_for("a checkpoint"));
    shared_file_open(&saver.file);
    if (!saver.file.error) {
        go_through(&saver, checkpoint);
        write_checksums(&saver);
    }
    struct error *error = shared_file_finish(&saver.file, NULL);
    free(saver.sum);
    hdf5_restore(printing);
    return error;
}
