/* Numbers over time; see curve.h. */
#include "base/curve.h"

#include <stdlib.h>

#include "base/memory.h"

bool curve_reserve(struct curve *curve, int64_t points)
{
    curve->count = 0;
    curve->time = memory_allocate((size_t)(2 * points + 1) * sizeof(double));
    curve->value = curve->time ? curve->time + points : NULL;
    return curve->time != NULL;
}

void curve_release(struct curve *curve)
{
    free(curve->time);
    *curve = (struct curve){0, NULL, NULL};
}

void curve_add(struct curve *curve, double time, double value)
{
    curve->time[curve->count] = time;
    curve->value[curve->count++] = value;
}

int64_t curve_extreme(const struct curve *curve, double sign)
{
    int64_t found = 0;
    for (int64_t i = 1; i < curve->count; i++)
        if (sign * curve->value[i] > sign * curve->value[found])
            found = i;
    return found;
}

/* The integral of the linear piece from FROM to TO, which lie between points I - 1 and I. */
static double piece(const struct curve *curve, int64_t i, double from, double to)
{
    const double start = curve->time[i - 1], span = curve->time[i] - start;
    const double rise = span > 0.0 ? (curve->value[i] - curve->value[i - 1]) / span : 0.0;
    return (to - from) * (curve->value[i - 1] + rise * (0.5 * (from + to) - start));
}

/* The mean from FROM to TO, times within the curve. */
static double mean_between(const struct curve *curve, double from, double to)
{
    double area = 0.0;
    for (int64_t i = 1; i < curve->count; i++) {
        const double low = maximum(from, curve->time[i - 1]), high = minimum(to, curve->time[i]);
        if (low < high)
            area += piece(curve, i, low, high);
    }
    return area / (to - from);
}

double curve_mean(const struct curve *curve)
{
    const double from = curve->time[0], to = curve->time[curve->count - 1];
    return from < to ? mean_between(curve, from, to) : curve->value[0];
}

double curve_root_mean_square(const struct curve *curve)
{
    double area = 0.0;
    const double span = curve->time[curve->count - 1] - curve->time[0];
    if (!(span > 0.0))
        return fabs(curve->value[0]);
    for (int64_t i = 1; i < curve->count; i++) {
        const double a = curve->value[i - 1], b = curve->value[i]; /* of the square of a line */
        area += (curve->time[i] - curve->time[i - 1]) * (a * a + a * b + b * b) / 3.0;
    }
    return sqrt(area / span);
}

double curve_slope(const struct curve *curve)
{
    double time = 0.0, value = 0.0, both = 0.0, spread = 0.0;
    for (int64_t i = 0; i < curve->count; i++) {
        time += curve->time[i] / (double)curve->count;
        value += curve->value[i] / (double)curve->count;
    }
    for (int64_t i = 0; i < curve->count; i++) {
        both += (curve->time[i] - time) * (curve->value[i] - value);
        spread += square(curve->time[i] - time);
    }
    return both / spread;
}

struct curve_peaks curve_peaks(const struct curve *curve, double noise)
{
    struct curve_peaks peaks = {0, NAN, NAN};
    int64_t turn =
        0; /* the extreme since the last turn: the highest when rising, else the lowest */
    bool rising = false;
    for (int64_t i = 1; i < curve->count; i++) {
        double change = curve->value[i] - curve->value[turn];
        if (rising ? change > 0.0 : change < 0.0)
            turn = i;
        else if (!rising && change > noise) {
            rising = true;
            turn = i;
        } else if (rising && -change > noise) {
            peaks.last = curve->time[turn];
            peaks.first = peaks.count++ ? peaks.first : peaks.last;
            rising = false;
            turn = i;
        }
    }
    return peaks;
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

void curve_subtract(struct curve *curve, const struct curve *other)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < curve->count; i++) {
        const double less = curve_at(other, curve->time[i]);
        if (isnan(less))
            continue;
        curve->time[kept] = curve->time[i];
        curve->value[kept++] = curve->value[i] - less;
    }
    curve->count = kept;
}

void curve_moving_mean(const struct curve *curve, double span, struct curve *mean)
{
    mean->count = 0;
    for (int64_t i = 0; i < curve->count; i++) {
        const double time = curve->time[i];
        const double reach = minimum(
            0.5 * span, minimum(time - curve->time[0], curve->time[curve->count - 1] - time));
        curve_add(mean, time,
                  reach > 0.0 ? mean_between(curve, time - reach, time + reach) : curve->value[i]);
    }
}
