/* Pressure over place and time; see load_trace.h. */
#include "model/load_trace.h"

#include <stdlib.h>

#include "base/memory.h"

bool load_trace_create(struct load_trace *trace, int points, int64_t rows)
{
    *trace = (struct load_trace){.points = points, .rows = rows};
    trace->time = memory_allocate(((size_t)rows + 1) * sizeof *trace->time);
    trace->impulse = memory_allocate(((size_t)rows * (size_t)points + 1) * sizeof *trace->impulse);
    return trace->time && trace->impulse;
}

void load_trace_free(struct load_trace *trace)
{
    free(trace->time);
    free(trace->impulse);
    *trace = (struct load_trace){0};
}

void load_trace_integrate(struct load_trace *trace, const double *pressure, double ambient)
{
    for (int k = 0; k < trace->points; k++) {
        const double rest = isnan(ambient) ? pressure[k] : ambient;
        double impulse = 0.0;
        trace->largest = maximum(trace->largest, fabs(pressure[k] - rest));
        trace->impulse[k] = 0.0;
        for (int64_t row = 1; row < trace->rows; row++) {
            const double *here = pressure + row * trace->points + k;
            const double mean = 0.5 * (here[0] + here[-trace->points]) - rest;
            trace->largest = maximum(trace->largest, fabs(here[0] - rest));
            impulse += mean * (trace->time[row] - trace->time[row - 1]);
            trace->impulse[row * trace->points + k] = impulse;
        }
    }
}

/* The impulse at the place, PART of the way from point K to the next one, up to TIME: linear
 * between two rows. */
static double impulse_until(const struct load_trace *trace, int k, double part, double time)
{
    int64_t low = 0, high = trace->rows - 1;
    if (time <= trace->time[low])
        return 0.0;
    while (high - low > 1) {
        const int64_t middle = low + (high - low) / 2;
        if (trace->time[middle] <= time)
            low = middle;
        else
            high = middle;
    }
    const double interval = trace->time[high] - trace->time[low];
    const double after = interval > 0.0 ? minimum((time - trace->time[low]) / interval, 1.0) : 1.0;
    const double *before = trace->impulse + low * trace->points,
                 *behind = trace->impulse + high * trace->points;
    const int next = k + 1 < trace->points ? k + 1 : k;
    const double here = before[k] + after * (behind[k] - before[k]),
                 there = before[next] + after * (behind[next] - before[next]);
    return here + part * (there - here);
}

double load_trace_mean(const struct load_trace *trace, double distance, double from, double to)
{
    const double at = minimum(distance / trace->spacing, trace->points - 1.0);
    const int k = (int)at;
    if (trace->rows < 2 || !(to > from))
        return 0.0;
    return (impulse_until(trace, k, at - k, to) - impulse_until(trace, k, at - k, from)) /
           (to - from);
}
