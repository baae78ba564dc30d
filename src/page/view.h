/* The viewer: a page that shows the particles of a run from any side, without a network. */
#ifndef BOLIDE_PAGE_VIEW_H
#define BOLIDE_PAGE_VIEW_H

#include "case/case.h"

struct view_request {
    const char *folder; /* of results */
    const char *path;   /* of the page */
    /* Of the run; its pictures are what can be shown: the first is body, others single fields. */
    const struct simulation_case *input;
    int frames;    /* at most */
    int64_t limit; /* bytes of the page */
};

/* What became of it, for the user. */
struct view_result {
    int64_t bytes, particles;
    int frames, of_frames, stride; /* every STRIDE-th particle */
};

/* ERROR_INPUT where there is no snapshot. */
struct error *view_write(const struct view_request *request, struct view_result *result);

#endif
