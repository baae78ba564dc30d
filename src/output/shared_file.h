/* An HDF5 file that all ranks write at the same time. Rank 0 lays it out; then HDF5 is closed, and
 * each rank writes its rows to their place in the file. No row goes to another rank, and no rank
 * needs more of HDF5 than its plain library. */
#ifndef BOLIDE_SHARED_FILE_H
#define BOLIDE_SHARED_FILE_H

#include "output/hdf5_file.h"
#include "parallel/ranks.h"

/* Rows of a dataset: TOTAL of all ranks, of which this one has OWN, from FIRST on. */
struct part {
    int64_t first, own, total;
};

/* Where the rows of a dataset are in the file, in bytes. */
struct file_range {
    int64_t begin, size;
};

/* After its first error a rank writes nothing more, but takes part in all collective calls. */
struct shared_file {
    const char *path;
    const struct ranks *ranks;
    hid_t file;     /* of rank 0, while it lays the file out */
    bool made;      /* by rank 0: PATH.part */
    int descriptor; /* of PATH.part, once it is laid out */
    int64_t count, room;
    struct file_range *place; /* of each dataset, on rank 0 and once it is laid out on all */
    bool hashed;              /* set it where the hash of the file is wanted */
    uint64_t hash;            /* of the words of the file that this rank has written whole */
    int64_t words, room_for_words;
    int64_t *word; /* that it has begun, and somebody else has ended */
    struct error *error;
};

/* Rank 0 begins PATH.part, as hdf5_create does. PATH must last until the end. */
void shared_file_create(const char *path, bool checksums, const struct ranks *ranks,
                        struct shared_file *file);

/* Notes ERROR, which it takes, with the name of the file, unless there is one already. */
void shared_file_fail(struct shared_file *file, struct error *error);

/* A dataset NAME of GROUP in the layout, of SIZE numbers of TYPE in DIMENSIONS (1 or 2); all ranks
 * call it, for the same datasets in the same order. Its index is how many there were before. Rank 0
 * gets the dataset, to add attributes to and to close, but none after an error. */
hid_t shared_file_dataset(struct shared_file *file, hid_t group, const char *name, hid_t type,
                          int dimensions, const hsize_t *size);

/* Collective: ends the layout. Everything of HDF5 in the file must be closed. Then all ranks have
 * an error, or none. */
void shared_file_open(struct shared_file *file);

/* Writes BYTES of dataset INDEX, from byte FROM of it on. */
void shared_file_write(struct shared_file *file, int64_t index, int64_t from, const void *data,
                       int64_t bytes);

/* Collective: flushes the file to disk and publishes it as PATH, or after an error of any rank
 * removes it. Every rank gets that error. HASH becomes the file's, see file_hash, where it is
 * `hashed`; else it may be NULL. */
struct error *shared_file_finish(struct shared_file *file, uint64_t *hash);

#endif
