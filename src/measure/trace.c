/* A column of a probe over time. */
#include "measure/trace.h"

#include <stdlib.h>

#include "base/memory.h"

bool trace_reserve(struct trace *trace, int64_t points)
{
    const size_t room = (size_t)points * sizeof(double) + sizeof(double);
    trace->count = 0;
    trace->time = memory_allocate(room);
    trace->value = memory_allocate(room);
    return trace->time && trace->value;
}

void trace_release(struct trace *trace)
{
    free(trace->time);
    free(trace->value);
    *trace = (struct trace){0, NULL, NULL};
}

void trace_add(struct trace *trace, double time, double value)
{
    trace->time[trace->count] = time;
    trace->value[trace->count++] = value;
}

int64_t trace_extreme(const struct trace *trace, double sign)
{
    int64_t found = 0;
    for (int64_t i = 1; i < trace->count; i++)
        if (sign * trace->value[i] > sign * trace->value[found])
            found = i;
    return found;
}

/* The integral of the linear piece from FROM to TO, which lie between points I - 1 and I. */
static double piece(const struct trace *trace, int64_t i, double from, double to)
{
    const double start = trace->time[i - 1], span = trace->time[i] - start;
    const double rise = span > 0.0 ? (trace->value[i] - trace->value[i - 1]) / span : 0.0;
    return (to - from) * (trace->value[i - 1] + rise * (0.5 * (from + to) - start));
}

/* The mean from FROM to TO, times within the trace. */
static double mean_between(const struct trace *trace, double from, double to)
{
    double area = 0.0;
    for (int64_t i = 1; i < trace->count; i++) {
        const double low = maximum(from, trace->time[i - 1]), high = minimum(to, trace->time[i]);
        if (low < high)
            area += piece(trace, i, low, high);
    }
    return area / (to - from);
}

double trace_mean(const struct trace *trace)
{
    const double from = trace->time[0], to = trace->time[trace->count - 1];
    return from < to ? mean_between(trace, from, to) : trace->value[0];
}

double trace_rms(const struct trace *trace)
{
    double area = 0.0;
    const double span = trace->time[trace->count - 1] - trace->time[0];
    if (!(span > 0.0))
        return fabs(trace->value[0]);
    for (int64_t i = 1; i < trace->count; i++) {
        const double a = trace->value[i - 1], b = trace->value[i]; /* of the square of a line */
        area += (trace->time[i] - trace->time[i - 1]) * (a * a + a * b + b * b) / 3.0;
    }
    return sqrt(area / span);
}

double trace_slope(const struct trace *trace)
{
    double time = 0.0, value = 0.0, both = 0.0, spread = 0.0;
    for (int64_t i = 0; i < trace->count; i++) {
        time += trace->time[i] / (double)trace->count;
        value += trace->value[i] / (double)trace->count;
    }
    for (int64_t i = 0; i < trace->count; i++) {
        both += (trace->time[i] - time) * (trace->value[i] - value);
        spread += square(trace->time[i] - time);
    }
    return both / spread;
}

struct trace_peaks trace_peaks(const struct trace *trace, double noise)
{
    struct trace_peaks peaks = {0, NAN, NAN};
    int64_t turn =
        0; /* the extreme since the last turn: the highest when rising, else the lowest */
    bool rising = false;
    for (int64_t i = 1; i < trace->count; i++) {
        double change = trace->value[i] - trace->value[turn];
        if (rising ? change > 0.0 : change < 0.0)
            turn = i;
        else if (!rising && change > noise) {
            rising = true;
            turn = i;
        } else if (rising && -change > noise) {
            peaks.last = trace->time[turn];
            peaks.first = peaks.count++ ? peaks.first : peaks.last;
            rising = false;
            turn = i;
        }
    }
    return peaks;
}

double trace_at(const struct trace *trace, double time)
{
    for (int64_t i = 1; i < trace->count; i++)
        if (time >= trace->time[i - 1] && time <= trace->time[i]) {
            const double span = trace->time[i] - trace->time[i - 1];
            const double part = span > 0.0 ? (time - trace->time[i - 1]) / span : 1.0;
            return trace->value[i - 1] + part * (trace->value[i] - trace->value[i - 1]);
        }
    return NAN;
}

void trace_subtract(struct trace *trace, const struct trace *other)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < trace->count; i++) {
        const double less = trace_at(other, trace->time[i]);
        if (isnan(less))
            continue;
        trace->time[kept] = trace->time[i];
        trace->value[kept++] = trace->value[i] - less;
    }
    trace->count = kept;
}

void trace_moving_mean(const struct trace *trace, double span, struct trace *mean)
{
    mean->count = 0;
    for (int64_t i = 0; i < trace->count; i++) {
        const double time = trace->time[i];
        const double reach = minimum(
            0.5 * span, minimum(time - trace->time[0], trace->time[trace->count - 1] - time));
        trace_add(mean, time,
                  reach > 0.0 ? mean_between(trace, time - reach, time + reach) : trace->value[i]);
    }
}
