/* The snapshots in a folder of results, frame by frame. */
#ifndef BOLIDE_SHELF_H
#define BOLIDE_SHELF_H

#include "measure/frame.h"

/* "000012.vtkhdf" is followed by those of other populations at that time, "000012-gas.vtkhdf". */
struct shelf {
    char *folder; /* with the files */
    char **names;
    int count;
    int frames;
    int *begin; /* of each frame, in the names; and the end of the last */
};

/* Free SHELF also after an error. */
struct error *shelf_open(const char *folder, struct shelf *shelf);
void shelf_free(struct shelf *shelf);

/* The number of FRAME in the names of its files. */
long long shelf_number(const struct shelf *shelf, int frame);

/* Reads frame NUMBER with COUNT of FIELDS; after an error there is nothing to free. */
struct error *shelf_read(const struct shelf *shelf, int number, const char *const *fields,
                         int count, struct frame *frame);

/* The frame whose TIME is nearest. */
struct error *shelf_find_time(const struct shelf *shelf, double time, int *number);

#endif
