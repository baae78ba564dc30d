/* Numbers over time; see curve.h. */
#include "page/curve.h"

#include <stdlib.h>

#include "base/memory.h"

struct error *curve_make(const struct csv *csv, int time, int value, double time_scale,
                         double scale, double shift, struct curve *curve)
{
    *curve = (struct curve){.time = memory_allocate((size_t)(2 * csv->rows + 1) * sizeof(double))};
    if (!curve->time)
        return out_of_memory_for("a comparison");
    curve->value = curve->time + csv->rows;
    for (int64_t i = 0; i < csv->rows; i++) {
        const double t = csv_number(csv, i, time) * time_scale + shift;
        const double v = csv_number(csv, i, value) * scale;
        if (!isfinite(t) || !isfinite(v))
            continue;
        curve->time[curve->count] = t;
        curve->value[curve->count++] = v;
    }
    return NULL;
}

double curve_at(const struct curve *curve, double time)
{
    int64_t low = 0, high = curve->count - 1;
    if (curve->count < 2 || !(time >= curve->time[0]) || !(time <= curve->time[high]))
        return NAN;
    while (high - low > 1) {
        const int64_t middle = (low + high) / 2;
        if (curve->time[middle] <= time)
            low = middle;
        else
            high = middle;
    }
    const double length = curve->time[high] - curve->time[low];
    const double part = length > 0.0 ? (time - curve->time[low]) / length : 0.0;
    return curve->value[low] + part * (curve->value[high] - curve->value[low]);
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
    return 2 * count >= data->count && count > 0 ? sqrt(sum / (double)count) : (double)NAN;
}

double curve_largest(const struct curve *curve)
{
    double largest = -INFINITY;
    for (int64_t i = 0; i < curve->count; i++)
        largest = maximum(largest, curve->value[i]);
    return largest;
}

double curve_shift(const struct curve *run, const struct curve *data)
{
    enum { STEPS = 100, ROUNDS = 4 };
    double reach = 0.25 * (data->time[data->count - 1] - data->time[0]), best = 0.0;
    double least = curve_rms(run, data, 0.0);
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
