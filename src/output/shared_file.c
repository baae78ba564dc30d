/* A file written by all ranks; see shared_file.h. Over a network, what several machines write into
 * one file is safe as long as each opens it when it has its full size, writes without reading, and
 * closes it before anybody reads: so the ranks begin when HDF5 has closed it, and agree at the
 * end when all have closed it. */
#include "output/shared_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/checksum.h"
#include "base/file.h"
#include "base/memory.h"

void shared_file_fail(struct shared_file *file, struct error *error)
{
    if (!file->error)
        file->error = error_context(error, "%s", file->path);
    else
        error_free(error);
}

static void fail_with_number(struct shared_file *file, int number)
{
    shared_file_fail(file, error_new(ERROR_SYSTEM, "%s", strerror(number)));
}

void shared_file_create(const char *path, bool checksums, const struct ranks *ranks,
                        struct shared_file *file)
{
    *file = (struct shared_file){
        .path = path, .ranks = ranks, .file = H5I_INVALID_HID, .descriptor = -1};
    if (ranks->rank == 0)
        file->error = hdf5_create(path, checksums, &file->file);
    file->made = file->file >= 0;
}

/* The dataset, with its place in the file reserved; nothing is written to it. */
static hid_t create(hid_t group, const char *name, hid_t type, int dimensions, const hsize_t *size)
{
    hid_t space = H5Screate_simple(dimensions, size, NULL);
    hid_t creation = hdf5_creation_list(H5P_DATASET_CREATE);
    H5Pset_layout(creation, H5D_CONTIGUOUS);
    H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
    H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
    hid_t dataset = H5Dcreate2(group, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Pclose(creation);
    H5Sclose(space);
    return dataset;
}

hid_t shared_file_dataset(struct shared_file *file, hid_t group, const char *name, hid_t type,
                          int dimensions, const hsize_t *size)
{
    const int64_t index = file->count++;
    if (!memory_reserve((void **)&file->place, &file->room, file->count, index,
                        sizeof *file->place)) {
        shared_file_fail(file, out_of_memory_for("an output"));
        return H5I_INVALID_HID;
    }
    file->place[index] = (struct file_range){0};
    if (file->file < 0 || file->error)
        return H5I_INVALID_HID;
    hid_t dataset = create(group, name, type, dimensions, size);
    if (dataset < 0) {
        shared_file_fail(file, hdf5_error(ERROR_SYSTEM, "\"%s\" cannot be written", name));
        return H5I_INVALID_HID;
    }
    const haddr_t begin = H5Dget_offset(dataset);
    if (begin != HADDR_UNDEF) /* it has rows */
        file->place[index] =
            (struct file_range){(int64_t)begin, (int64_t)H5Dget_storage_size(dataset)};
    return dataset;
}

/* What tells a file from others of its name: its number in the file system, and its size. */
static bool look_at(const char *path, int64_t seen[2])
{
    struct stat status;
    if (stat(path, &status))
        return false;
    seen[0] = (int64_t)status.st_ino;
    seen[1] = (int64_t)status.st_size;
    return true;
}

/* Whether this rank sees the file BESIDE that rank 0 has closed. A file system over a network may
 * show a new file, or its size, as much as a minute late, and until then the one before it, which
 * has become the last checkpoint. */
static bool wait_for(const char *beside, const int64_t wanted[2])
{
    enum { TIMES = 700 };
    const struct timespec pause = {.tv_nsec = 100000000};
    int64_t seen[2];
    for (int i = 0; i < TIMES; i++) {
        if (look_at(beside, seen) && seen[0] == wanted[0] && seen[1] == wanted[1])
            return true;
        nanosleep(&pause, NULL);
    }
    return false;
}

static void open_beside(struct shared_file *file, const char *beside, const int64_t made[2])
{
    if (file->ranks->rank != 0 && !wait_for(beside, made))
        shared_file_fail(file, error_new(ERROR_SYSTEM,
                                         "rank %d does not see what rank 0 has written: all ranks "
                                         "must share the file system of the results",
                                         file->ranks->rank));
    else
        shared_file_fail(file, file_open_descriptor(beside, O_WRONLY, &file->descriptor));
}

void shared_file_open(struct shared_file *file)
{
    int64_t made[2] = {0, 0};
    char *beside = file_beside(file->path);
    if (!beside)
        shared_file_fail(file, out_of_memory_for("an output"));
    if (file->file >= 0 && H5Fclose(file->file) < 0)
        shared_file_fail(file, hdf5_error(ERROR_SYSTEM, "cannot be written"));
    H5Eclear2(H5E_DEFAULT);
    if (file->made && beside && !look_at(beside, made))
        fail_with_number(file, errno);
    file->file = H5I_INVALID_HID;
    file->error = ranks_agree(file->ranks, file->error);
    if (!file->error) {
        ranks_broadcast(file->ranks, 0, made, sizeof made);
        ranks_broadcast(file->ranks, 0, file->place, file->count * (int64_t)sizeof *file->place);
        open_beside(file, beside, made);
        file->error = ranks_agree(file->ranks, file->error);
    }
    free(beside);
}

enum { WORD = sizeof(uint64_t) };

/* The words that end where BYTES have been passed. */
static int64_t words_of(int64_t bytes) { return (bytes + WORD - 1) / WORD; }

/* Hashes BYTES at DATA that are written at AT in the file: the words that begin there. One that
 * ends elsewhere is left for later. */
static void hash_part(struct shared_file *file, int64_t at, const char *data, int64_t bytes)
{
    const int64_t begin = words_of(at), end = words_of(at + bytes), whole = (at + bytes) / WORD;
    if (whole > begin)
        file->hash += checksum_of(data + (begin * WORD - at), WORD, begin, whole - begin, 1);
    if (end == whole || end == begin)
        return;
    if (memory_reserve((void **)&file->word, &file->room_for_words, file->words + 1, file->words,
                       sizeof *file->word))
        file->word[file->words++] = whole;
    else
        shared_file_fail(file, out_of_memory_for("an output"));
}

void shared_file_write(struct shared_file *file, int64_t index, int64_t from, const void *data,
                       int64_t bytes)
{
    if (file->error || bytes == 0)
        return;
    const char *next = data;
    int64_t at = file->place[index].begin + from;
    if (file->hashed)
        hash_part(file, at, data, bytes);
    while (bytes > 0 && !file->error) {
        const ssize_t done = pwrite(file->descriptor, next, (size_t)bytes, at);
        if (done < 0 && errno != EINTR)
            fail_with_number(file, errno);
        if (done > 0) {
            next += done;
            at += done;
            bytes -= done;
        }
    }
}

static void close_descriptor(struct shared_file *file)
{
    if (file->descriptor < 0)
        return;
    if (!file->error && fsync(file->descriptor))
        fail_with_number(file, errno);
    if (close(file->descriptor))
        fail_with_number(file, errno);
}

/* Adds the words from BEGIN to END - 1 of the file to its hash; what is past its end counts as
 * zero. */
static bool hash_words(struct shared_file *file, int64_t begin, int64_t end)
{
    enum { ROOM = 1 << 12 };
    uint64_t words[ROOM];
    bool read = true;
    while (begin < end && read) {
        const int64_t some = end - begin < ROOM ? end - begin : ROOM;
        memset(words, 0, sizeof words);
        read = pread(file->descriptor, words, (size_t)some * WORD, (off_t)begin * WORD) >= 0;
        file->hash += checksum_of(words, WORD, begin, some, 1);
        begin += some;
    }
    return read;
}

static int compare_ranges(const void *one, const void *other)
{
    const int64_t a = ((const struct file_range *)one)->begin,
                  b = ((const struct file_range *)other)->begin;
    return (a > b) - (a < b);
}

/* The words that begin outside of all datasets, which HDF5 has written, and the size of the file.
 * It ends the use of the places. */
static bool hash_layout(struct shared_file *file)
{
    struct stat status;
    if (fstat(file->descriptor, &status))
        return false;
    const int64_t size = (int64_t)status.st_size, all = size / WORD + 1;
    int64_t begin = 0;
    bool read = true;
    qsort(file->place, (size_t)file->count, sizeof *file->place, compare_ranges);
    for (int64_t k = 0; k < file->count && read; k++) {
        const struct file_range *place = &file->place[k];
        if (place->size == 0)
            continue;
        read = hash_words(file, begin, words_of(place->begin));
        begin = words_of(place->begin + place->size);
    }
    file->hash += checksum_of(&size, sizeof size, all, 1, 1);
    return read && hash_words(file, begin, all);
}

/* What this rank has to read for the hash, by the name that it has opened the file with: it may
 * see another late. */
static struct error *hash_rest(struct shared_file *file)
{
    char *beside = file_beside(file->path);
    struct error *error =
        beside ? file_open_descriptor(beside, O_RDONLY, &file->descriptor) : out_of_memory();
    free(beside);
    if (error)
        return error;
    bool read = true;
    for (int64_t k = 0; k < file->words && read; k++)
        read = hash_words(file, file->word[k], file->word[k] + 1);
    if (file->ranks->rank == 0)
        read = read && hash_layout(file);
    const int number = errno;
    close(file->descriptor);
    return read ? NULL : file_error(file->path, number);
}

struct error *shared_file_finish(struct shared_file *file, uint64_t *hash)
{
    close_descriptor(file);
    struct error *error = ranks_agree(file->ranks, file->error);
    if (!error && file->hashed) {
        error = ranks_agree(file->ranks, hash_rest(file));
        *hash = (uint64_t)ranks_sum(file->ranks, (int64_t)file->hash);
    }
    if (file->made && !error)
        error = file_publish(file->path);
    else if (file->made) {
        char *beside = NULL;
        error_free(file_clear_beside(file->path, &beside));
        free(beside);
    }
    free(file->word);
    free(file->place);
    return ranks_agree(file->ranks, error);
}
