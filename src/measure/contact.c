/* contact_max, contact_rms: Cmax and L2c, the largest and the root mean square of |f_i/f* - 1| over
 * the 20 particles nearest the contact, 10 a side; f* is the exact star value of the side. */
#include "measure/measure.h"

enum { NEAREST = 10 };

struct ratio {
    double largest, square_sum;
    int count;
};

static void add_ratio(const struct measurement *measurement, const struct sample *sample,
                      struct ratio *ratio)
{
    const enum exact_side side = measure_side(measurement, sample);
    const struct measure_field *parameters = measurement->check->measure.value;
    struct exact_state star = measurement->exact->star(measurement->solved, side);
    double off = fabs(sample->value / exact_field(&star, parameters->field) - 1.0);
    ratio->largest = off > ratio->largest || isnan(off) ? off : ratio->largest;
    ratio->square_sum += square(off);
    ratio->count++;
}

/* Puts the samples nearest the contact, the last ones of the left side and the first ones of the
 * right, to NEAR; their number. */
static int take_nearest(const struct measurement *measurement, struct samples *samples,
                        struct sample near[2 * NEAREST])
{
    int found = 0;
    samples_sort(samples);
    for (int64_t i = samples->count; i-- > 0 && found < NEAREST;)
        if (measure_side(measurement, &samples->at[i]) == SIDE_LEFT)
            near[found++] = samples->at[i];
    const int left = found;
    for (int64_t i = 0; i < samples->count && found < left + NEAREST; i++)
        if (measure_side(measurement, &samples->at[i]) == SIDE_RIGHT)
            near[found++] = samples->at[i];
    return found;
}

static struct error *measure_ratio(const struct measurement *measurement, struct ratio *ratio)
{
    struct samples samples, all;
    struct sample near[2 * NEAREST];
    TRY(samples_take(measurement, &samples));
    int found = take_nearest(measurement, &samples, near);
    samples_free(&samples);
    TRY(ranks_gather(measurement->simulation->ranks, -1, near, found, sizeof *near,
                     (void **)&all.at, &all.count));
    found = take_nearest(measurement, &all, near);
    samples_free(&all);
    *ratio = (struct ratio){0.0, 0.0, 0};
    for (int k = 0; k < found; k++)
        add_ratio(measurement, &near[k], ratio);
    return NULL;
}

static struct error *contact_max(const struct measurement *measurement, double *value)
{
    struct ratio ratio;
    TRY(measure_ratio(measurement, &ratio));
    *value = ratio.count == 2 * NEAREST ? ratio.largest : measure_nothing(measurement, NOTHING_FEW);
    return NULL;
}

static struct error *contact_rms(const struct measurement *measurement, double *value)
{
    struct ratio ratio;
    TRY(measure_ratio(measurement, &ratio));
    *value = ratio.count == 2 * NEAREST ? sqrt(ratio.square_sum / ratio.count)
                                        : measure_nothing(measurement, NOTHING_FEW);
    return NULL;
}

const struct measure_class measure_contact_max = {.needs_exact = true,
                                                  .needs_contact = true,
                                                  .of_field = true,
                                                  .unit = measure_no_unit,
                                                  .measure = contact_max};
const struct measure_class measure_contact_rms = {.needs_exact = true,
                                                  .needs_contact = true,
                                                  .of_field = true,
                                                  .unit = measure_no_unit,
                                                  .measure = contact_rms};
