/* The pressure of a blast wave over time; see blast_wave.h. */
#include "exact/blast_wave.h"

#include "base/exponential.h"
#include "exact/root.h"

/* -(1/b - (1 - exp(-b))/b^2) and its slope; b from a tenth on down by the series. */
static struct root_value missing(const void *context, double b)
{
    const double fraction = *(const double *)context;
    if (b < 0.1) {
        const double value = 1.0 / 2.0 - b / 6.0 + b * b / 24.0 - b * b * b / 120.0 +
                             b * b * b * b / 720.0 - b * b * b * b * b / 5040.0;
        const double slope = -1.0 / 6.0 + b / 12.0 - b * b / 40.0 + b * b * b / 180.0;
        return (struct root_value){fraction - value, -slope};
    }
    const double rest = exponential(-b), value = 1.0 / b - (1.0 - rest) / (b * b);
    const double slope = -1.0 / (b * b) + 2.0 * (1.0 - rest) / (b * b * b) - rest / (b * b);
    return (struct root_value){fraction - value, -slope};
}

double blast_wave_decay(double fraction)
{
    if (!(fraction > 0.0 && fraction < 0.5))
        return fraction >= 0.5 ? 0.0 : NAN;
    return root_find(missing, &fraction, 0.0, 1.0 / fraction, 0.5 / fraction);
}

double blast_wave_at(const struct blast_wave *wave, double time)
{
    const double since = time - wave->arrival;
    if (since < 0.0)
        return 0.0;
    if (isnan(wave->duration))
        return wave->overpressure * exponential(-since * wave->overpressure / wave->impulse);
    const double part = since / wave->duration;
    if (part >= 1.0)
        return 0.0;
    const double decay = blast_wave_decay(wave->impulse / (wave->overpressure * wave->duration));
    return wave->overpressure * (1.0 - part) * exponential(-decay * part);
}
