/* A convergence study on paper: the errors of a case on several resolutions, as tables, a plot and
 * a page. */
#ifndef BOLIDE_STUDY_H
#define BOLIDE_STUDY_H

#include "base/error.h"
#include "exact/order.h"

/* One run of the case. */
struct study_run {
    char *name;                 /* of its folder in FOLDER/convergence */
    double resolution, seconds; /* of computing, without the outputs */
    int64_t particles;
    bool finished;
};

/* Where the error of a quantity comes from. */
enum study_error {
    STUDY_NORM,     /* it is one */
    STUDY_DISTANCE, /* from what it should be */
    STUDY_ESTIMATE, /* from what the three finest runs tend to */
};

/* What became of the order that is wanted. */
enum study_verdict { STUDY_NOT_JUDGED, STUDY_PASSED, STUDY_KNOWN_DEVIATION, STUDY_FAILED };

/* What is followed from run to run. Its arrays have an entry a run; NAN where there is nothing. */
struct study_quantity {
    char *name, unit[24];
    enum study_error kind;
    double exact; /* of a DISTANCE */
    double *measured, *error;
    double *order; /* from the run before to this one; of an ESTIMATE, of the last three runs */
    double fitted; /* to all runs; of an ESTIMATE, of the three finest */
    struct extrapolation extrapolation; /* of the three finest; no NORM has one */
    double low, high;                   /* allowed order; infinite: no limit */
    char *source;                       /* of the limits; may be NULL */
    enum study_verdict verdict;
    char *verdict_text; /* NULL: not judged */
};

struct study {
    char *title, *vary;
    int runs, quantities;
    struct study_run *run; /* the coarsest first */
    struct study_quantity *quantity;
};

/* Writes into FOLDER convergence.csv, a row a run; convergence-orders.csv, a row a quantity;
 * convergence.png, relative errors over the resolution; and convergence.html, a page that needs no
 * other file, whose links lead to the reports of the runs in FOLDER/convergence. SI units. */
struct error *study_write(const char *folder, const struct study *study);

/* The errors of QUANTITY are divided by this in the plot: what it should be, or where that is zero
 * or not known the error of the first run; 1 for a norm. */
double study_scale(const struct study *study, const struct study_quantity *quantity);

void study_free(struct study *study);

#endif
