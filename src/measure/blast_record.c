/* The blast wave at a gauge; see blast_record.h. Between rows the pressure is linear. */
#include "measure/blast_record.h"

/* The time between two rows at which the overpressure, A and then B, has the value LEVEL. */
static double crossing(const double *time, double a, double b, double level)
{
    return time[0] + (time[1] - time[0]) * (level - a) / (b - a);
}

static int64_t highest(const double *pressure, int64_t count)
{
    int64_t found = 0;
    for (int64_t i = 1; i < count; i++)
        if (pressure[i] > pressure[found])
            found = i;
    return found;
}

struct blast_wave blast_record(const double *time, const double *pressure, int64_t count,
                               double ambient)
{
    struct blast_wave wave = {NAN, NAN, NAN, NAN};
    if (count < 2)
        return wave;
    const double base = isnan(ambient) ? pressure[0] : ambient;
    const int64_t peak = highest(pressure, count);
    const double over = pressure[peak] - base;
    wave.overpressure = over;
    if (!(over > 0.0))
        return wave;
    int64_t first = 0; /* the first row above half the peak */
    while (pressure[first] - base < 0.5 * over)
        first++;
    wave.arrival = first == 0 ? time[0]
                              : crossing(&time[first - 1], pressure[first - 1] - base,
                                         pressure[first] - base, 0.5 * over);
    double impulse = 0.0;
    for (int64_t i = 1; i < count; i++) {
        const double a = pressure[i - 1] - base, b = pressure[i] - base;
        if (i > peak && b <= 0.0) {
            const double end = crossing(&time[i - 1], a, b, 0.0);
            wave.duration = end - wave.arrival;
            wave.impulse = impulse + 0.5 * a * (end - time[i - 1]);
            break;
        }
        impulse += 0.5 * (a + b) * (time[i] - time[i - 1]);
    }
    return wave;
}
