/* Several runs, and measurements, in one page of plots. */
#ifndef BOLIDE_PAGE_COMPARE_H
#define BOLIDE_PAGE_COMPARE_H

#include "page/measured.h"

struct compare_request {
    int runs;
    const char *const *folder;
    int data;
    const struct compare_data *measured;
    const char *output; /* a folder: compare.html, compare.csv */
    void (*line)(void *context, const char *text);
    void *context;
};

/* ERROR_INPUT where runs have no probe in common with each other or the data. */
struct error *compare_write(const struct compare_request *request);

#endif
