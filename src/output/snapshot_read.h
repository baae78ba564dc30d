/* Snapshots read back, as frames for pictures. */
#ifndef BOLIDE_SNAPSHOT_READ_H
#define BOLIDE_SNAPSHOT_READ_H

#include "measure/frame.h"

/* Adds the members of the snapshot at PATH to FRAME, with those of the COUNT FIELDS ("velocity.x")
 * that the file has. Reads what any version has written. Free FRAME also after an error. */
struct error *snapshot_read(const char *path, const char *const *fields, int count,
                            struct frame *frame);

#endif
