/* Measured series: columns of a CSV file, beside which runs are compared. */
#ifndef BOLIDE_PAGE_MEASURED_H
#define BOLIDE_PAGE_MEASURED_H

#include "page/curve.h"

/* Names of columns are followed by their unit, "t_us:us"; without, the head of the column has it.
 * "t [us]", as the head is, is right too. */
struct compare_data {
    char *path, *time;   /* NULL: the first column */
    char *value;         /* NULL: the column called as the field, else the second */
    char *probe, *field; /* of the runs */
    double shift;        /* s, added to its times */
    bool in_case;        /* its keys are given as in a case, "time: t_us:us" */
};

/* Reads "file.csv,time=t:us,value=p:GPa,probe=gauge,field=pressure,shift=20ns"; compare_data_free
 * also after an error. */
struct error *compare_data_read(const char *text, struct compare_data *data);
void compare_data_free(struct compare_data *data);

/* The times and values of DATA, in SI units, its times shifted. ERROR_INPUT where the columns are
 * not a time and a quantity like UNIT, that of the field. Free CURVE->time. */
struct error *compare_data_curve(const struct compare_data *data, const char *unit,
                                 struct curve *curve);

/* "m/s" of the head "velocity.x [m/s]", "" without; in fresh memory. */
char *compare_unit(const char *head);

#endif
