/* Curves of runs and of measurements; see curve.h. */
#include "page/curve.h"

#include <stdlib.h>

#include "base/memory.h"

struct error *curve_make(const struct csv *csv, int time, int value, double time_scale,
                         double scale, double shift, struct curve *curve)
{
    if (!curve_reserve(curve, csv->rows))
        return out_of_memory_for("a comparison");
    for (int64_t i = 0; i < csv->rows; i++) {
        const double t = csv_number(csv, i, time) * time_scale + shift;
        const double v = csv_number(csv, i, value) * scale;
        if (isfinite(t) && isfinite(v))
            curve_add(curve, t, v);
    }
    return NULL;
}

bool curve_overlaps(const struct curve *run, const struct curve *data, double shift)
{
    const int64_t last = run->count - 1, end = data->count - 1;
    if (last < 1 || end < 1)
        return false;
    const double shorter = minimum(run->time[last] - run->time[0], data->time[end] - data->time[0]);
    const double from = maximum(run->time[0], data->time[0] + shift);
    const double to = minimum(run->time[last], data->time[end] + shift);
    return to - from >= (1.0 - 1e-9) * 0.5 * shorter;
}

double curve_rms(const struct curve *run, const struct curve *data, double shift)
{
    double sum = 0.0;
    int64_t count = 0;
    for (int64_t i = 0; i < data->count; i++) {
        const double off = curve_at(run, data->time[i] + shift) - data->value[i];
        if (isfinite(off)) {
            sum += off * off;
            count++;
        }
    }
    return count > 1 && curve_overlaps(run, data, shift) ? sqrt(sum / (double)count) : (double)NAN;
}

double curve_largest(const struct curve *curve)
{
    double largest = -INFINITY;
    for (int64_t i = 0; i < curve->count; i++)
        largest = maximum(largest, curve->value[i]);
    return largest;
}

/* The sum of squares that RUN leaves unexplained of every STRIDE-th point of DATA; a point outside
 * RUN counts by its distance from MEAN: so no shift is best because it hides what differs. */
static double unexplained(const struct curve *run, const struct curve *data, double shift,
                          double mean, int64_t stride)
{
    double sum = 0.0;
    for (int64_t i = 0; i < data->count; i += stride) {
        const double there = curve_at(run, data->time[i] + shift);
        sum += square(data->value[i] - (isfinite(there) ? there : mean));
    }
    return sum;
}

/* The best of equally spaced shifts, over all with which the two overlap, and *STEP between them;
 * none, where that is as good. */
static double coarse_shift(const struct curve *run, const struct curve *data, double *step)
{
    enum { STEPS = 1000, POINTS = 2000 };
    const double begin = run->time[0], end = run->time[run->count - 1];
    const double first = data->time[0], last = data->time[data->count - 1];
    const double half = 0.5 * minimum(end - begin, last - first);
    const double lowest = begin + half - last, highest = end - half - first;
    const int64_t stride = 1 + data->count / POINTS;
    double mean = 0.0, best = 0.0, least = INFINITY;
    for (int64_t i = 0; i < data->count; i++)
        mean += data->value[i] / (double)data->count;
    if (curve_overlaps(run, data, 0.0))
        least = unexplained(run, data, 0.0, mean, stride);
    *step = (highest - lowest) / STEPS;
    for (int i = 0; i <= STEPS; i++) {
        const double shift = lowest + *step * i;
        const double rest = unexplained(run, data, shift, mean, stride);
        if (rest < least) {
            least = rest;
            best = shift;
        }
    }
    return best;
}

double curve_shift(const struct curve *run, const struct curve *data)
{
    enum { STEPS = 100, ROUNDS = 3 };
    double reach, least, best;
    if (run->count < 2 || data->count < 2)
        return 0.0;
    best = coarse_shift(run, data, &reach);
    least = curve_rms(run, data, best);
    for (int round = 0; round < ROUNDS; round++, reach *= 0.05) {
        const double middle = best;
        for (int i = -STEPS; i <= STEPS; i++) {
            const double shift = middle + reach * i / STEPS, rms = curve_rms(run, data, shift);
            if (rms < least || (isnan(least) && isfinite(rms))) {
                least = rms;
                best = shift;
            }
        }
    }
    return best;
}

bool curve_equal(const struct curve *a, const struct curve *b)
{
    const double scale = 1e-6 * curve_largest(b);
    for (int64_t i = 0; i < a->count; i++)
        if (fabs(curve_at(b, a->time[i]) - a->value[i]) > scale)
            return false;
    return a->count > 0 && b->count > 0;
}

bool curve_varies(const struct curve *curve)
{
    for (int64_t i = 1; i < curve->count; i++)
        if (fabs(curve->value[i] - curve->value[0]) > 1e-9 * fabs(curve->value[0]))
            return true;
    return false;
}
