/* The viewer: a page that shows the particles of a run from any side, without a network. */
#ifndef BOLIDE_PAGE_VIEW_H
#define BOLIDE_PAGE_VIEW_H

#include "case/case.h"

struct view_request {
    const char *folder; /* of results */
    const char *path;   /* of the page */
    const struct simulation_case *input;
    /* What can be shown beside the bodies; of 0 the fields of the pictures, speed and pressure. */
    const char *const *fields;
    int field_count;
    int frames;    /* at most; 0: VIEW_FRAMES */
    int64_t limit; /* bytes of the page; 0: VIEW_BYTES */
};
enum { VIEW_FRAMES = 40, VIEW_BYTES = 20000000 };

/* What became of it, for the user. */
struct view_result {
    int64_t bytes, particles;
    int frames, of_frames, stride; /* every STRIDE-th particle */
};

/* ERROR_INPUT where there is no snapshot, or none has one of the fields asked for. */
struct error *view_write(const struct view_request *request, struct view_result *result);

#endif
