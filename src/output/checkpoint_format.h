/* checkpoint.h5: one dataset for each array that a visitor is shown, '/' in its name makes groups.
 * The numbers of each but the format have a checksum (base/checksum.h): the attribute `checksum`
 * of the dataset is its row of the dataset `checksums`. HDF5 checks the file's own structures, so
 * that a damaged file is refused instead of believed. */
#ifndef BOLIDE_CHECKPOINT_FORMAT_H
#define BOLIDE_CHECKPOINT_FORMAT_H

#include <hdf5.h>

#include "output/checkpoint.h"

enum { CHECKPOINT_FORMAT = 4 };

#define CHECKPOINT_FORMAT_NAME "bolide checkpoint format"
#define CHECKPOINT_CASE "case"
#define CHECKPOINT_CHECKSUMS "checksums"
#define CHECKPOINT_CHECKSUM "checksum"

/* HDF5's type for the numbers of an array. */
hid_t checkpoint_number(enum number number);

/* Collective: shows VISITOR all arrays of CHECKPOINT. */
struct error *checkpoint_visit(const struct checkpoint *checkpoint, struct visitor *visitor);

#endif
