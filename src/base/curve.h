/* Numbers over time, linear between points whose times rise. Functions that return a number want a
 * point at least. */
#ifndef BOLIDE_CURVE_H
#define BOLIDE_CURVE_H

#include "base/vector.h"

struct curve {
    int64_t count;
    double *time, *value; /* one block of memory: curve_release, or free(time) */
};

/* Room for POINTS in an empty curve; false where there is no memory. */
bool curve_reserve(struct curve *curve, int64_t points);
void curve_release(struct curve *curve);

void curve_add(struct curve *curve, double time, double value);

/* The index of the first extreme of SIGN times the curve. */
int64_t curve_extreme(const struct curve *curve, double sign);

/* Mean and root mean square over time. */
double curve_mean(const struct curve *curve);
double curve_root_mean_square(const struct curve *curve);

/* The slope of the line of least squares through the points. */
double curve_slope(const struct curve *curve);

struct curve_peaks {
    int64_t count;
    double first, last; /* times */
};

/* A peak is where the curve is highest between a rise and a fall of more than NOISE. */
struct curve_peaks curve_peaks(const struct curve *curve, double noise);

/* The value at TIME; NAN before the first and behind the last point, and of a single point. */
double curve_at(const struct curve *curve, double time);

/* Subtracts OTHER; points at which it has no value are left out. */
void curve_subtract(struct curve *curve, const struct curve *other);

/* The mean of the curve over SPAN around each of its points, over less towards its ends; MEAN has
 * room for as many points. */
void curve_moving_mean(const struct curve *curve, double span, struct curve *mean);

#endif
