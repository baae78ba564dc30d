/* A column of a probe over time, linear between its points, and what can be said of it. Times rise;
 * the functions that take a trace want a point at least. */
#ifndef BOLIDE_TRACE_H
#define BOLIDE_TRACE_H

#include "base/vector.h"

struct trace {
    int64_t count;
    double *time, *value;
};

/* Room for POINTS in an empty trace; false where there is no memory. */
bool trace_reserve(struct trace *trace, int64_t points);
void trace_release(struct trace *trace);

void trace_add(struct trace *trace, double time, double value);

/* The index of the first extreme of SIGN times the trace. */
int64_t trace_extreme(const struct trace *trace, double sign);

/* Mean and root mean square over time. */
double trace_mean(const struct trace *trace);
double trace_rms(const struct trace *trace);

/* The slope of the line of least squares through the points. */
double trace_slope(const struct trace *trace);

struct trace_peaks {
    int64_t count;
    double first, last; /* times */
};

/* A peak is where the trace is highest between a rise and a fall of more than NOISE. */
struct trace_peaks trace_peaks(const struct trace *trace, double noise);

/* The value at TIME; NAN before the first and behind the last point. */
double trace_at(const struct trace *trace, double time);

/* Subtracts OTHER; points at which it has no value are left out. */
void trace_subtract(struct trace *trace, const struct trace *other);

/* The mean of the trace over SPAN around each of its points, over less towards its ends; MEAN has
 * room for as many points. */
void trace_moving_mean(const struct trace *trace, double span, struct trace *mean);

#endif
