/* Curves of runs and of measurements, and how far they are apart. */
#ifndef BOLIDE_PAGE_CURVE_H
#define BOLIDE_PAGE_CURVE_H

#include "base/csv.h"
#include "base/curve.h"
#include "base/error.h"

/* The finite rows of two columns of CSV, in units of the scales; times are SHIFT later. */
struct error *curve_make(const struct csv *csv, int time, int value, double time_scale,
                         double scale, double shift, struct curve *curve);

double curve_largest(const struct curve *curve);

/* Whether a curve is worth a plot. */
bool curve_varies(const struct curve *curve);

/* Whether the points of A lie on B, as far as B goes. */
bool curve_equal(const struct curve *a, const struct curve *b);

/* Whether RUN and DATA, whose times are SHIFT later, overlap by half of the shorter or more. */
bool curve_overlaps(const struct curve *run, const struct curve *data, double shift);

/* Root mean square of RUN less DATA, whose times are SHIFT later; NAN where they do not overlap. */
double curve_rms(const struct curve *run, const struct curve *data, double shift);

/* The shift of the smallest difference, of all with which they overlap. */
double curve_shift(const struct curve *run, const struct curve *data);

#endif
