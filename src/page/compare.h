/* Several runs, and measurements, in one page of plots. */
#ifndef BOLIDE_PAGE_COMPARE_H
#define BOLIDE_PAGE_COMPARE_H

#include "base/error.h"

/* A measured series: columns of a CSV file, and what of the runs they are compared with. Names of
 * columns are followed by their unit, "t_us:us"; without, the head of the column has it. */
struct compare_data {
    char *path, *time, *value; /* NULL: the first and the second column */
    char *probe, *field;       /* of the runs */
    double shift;              /* s, added to its times */
};

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

/* Reads "file.csv,time=t:us,value=p:GPa,probe=gauge,field=pressure,shift=20ns"; compare_data_free
 * also after an error. */
struct error *compare_data_read(const char *text, struct compare_data *data);
void compare_data_free(struct compare_data *data);

/* The times and values of DATA, in SI units, its times shifted. Free CURVE->time. */
struct curve;
struct error *compare_data_curve(const struct compare_data *data, struct curve *curve);

#endif
