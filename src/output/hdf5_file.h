/* What snapshots and checkpoints share of HDF5: its errors as struct error instead of printed
 * lines, and how files are begun and read. */
#ifndef BOLIDE_HDF5_FILE_H
#define BOLIDE_HDF5_FILE_H

#include <hdf5.h>

#include "base/error.h"

/* HDF5 prints its errors unless told otherwise. hdf5_quiet stops that and keeps the former setting,
 * which belongs to the whole process, for hdf5_restore. */
struct hdf5_printing {
    H5E_auto2_t function;
    void *context;
};
struct hdf5_printing hdf5_quiet(void);
void hdf5_restore(struct hdf5_printing printing);

/* An error that ends with the root cause in HDF5's own words, and clears HDF5's error stack. */
struct error *hdf5_error(enum error_kind kind, const char *format, ...) BOLIDE_PRINTF(2, 3);

/* Creates PATH.part in the format of HDF5 1.10 when CHECKSUMS is set (its metadata carry
 * checksums), in the format that every version reads otherwise. */
struct error *hdf5_create(const char *path, bool checksums, hid_t *file);

/* A creation list for groups (H5P_GROUP_CREATE), datasets (H5P_DATASET_CREATE) or a file
 * (H5P_FILE_CREATE) whose objects carry no time, so that the same run gives the same file. Close it
 * with H5Pclose. */
hid_t hdf5_creation_list(hid_t kind);

/* Opens the dataset NAME of FILE, a path of groups between slashes. ERROR_INPUT names a link to
 * elsewhere, or numbers that are in other files, be these pipes or another user's; ERROR_SYSTEM
 * what is not there or damaged. Close it with H5Dclose. */
struct error *hdf5_open_dataset(hid_t file, const char *name, hid_t *dataset);

#endif
