/* Orders of accuracy and extrapolation to no spacing; see order.h. */
#include "exact/order.h"

#include "base/base.h"

double order_between(double coarse_spacing, double coarse_error, double fine_spacing,
                     double fine_error)
{
    const double spacing[2] = {coarse_spacing, fine_spacing};
    const double error[2] = {coarse_error, fine_error};
    return order_fitted(spacing, error, 2);
}

static bool has_logarithm(double value) { return value > 0.0 && isfinite(value); }

double order_fitted(const double *spacing, const double *error, int count)
{
    double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
    int used = 0;
    for (int i = 0; i < count; i++) {
        if (!has_logarithm(spacing[i]) || !has_logarithm(error[i]))
            continue;
        used++;
        mean_x += (log(spacing[i]) - mean_x) / used;
        mean_y += (log(error[i]) - mean_y) / used;
    }
    for (int i = 0; i < count; i++) {
        if (!has_logarithm(spacing[i]) || !has_logarithm(error[i]))
            continue;
        double x = log(spacing[i]) - mean_x;
        xx += x * x;
        xy += x * (log(error[i]) - mean_y);
    }
    return xx > 0.0 ? xy / xx : NAN;
}

/* The first change over the second of values that differ from their limit by spacing^ORDER. It
 * increases with the order. */
static double ratio_of_changes(const double spacing[3], double order)
{
    if (order == 0.0)
        return log(spacing[0] / spacing[1]) / log(spacing[1] / spacing[2]);
    double fine = expm1(order * log(spacing[1] / spacing[2]));
    double coarse = expm1(order * log(spacing[0] / spacing[1]));
    return (1.0 + fine) * coarse / fine;
}

/* The order at which changes have this RATIO, by bisection. */
static double order_of_ratio(const double spacing[3], double ratio)
{
    double low = 0.0, high = 64.0;
    for (int i = 0; i < 100; i++) {
        double middle = 0.5 * (low + high);
        if (ratio_of_changes(spacing, middle) < ratio)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

struct extrapolation extrapolate(const double spacing[3], const double value[3])
{
    struct extrapolation result = {APPROACH_UNKNOWN, NAN, NAN, NAN};
    double first = value[0] - value[1], second = value[1] - value[2];
    if (!isfinite(first) || !isfinite(second))
        return result;
    if (first == 0.0 && second == 0.0) {
        result = (struct extrapolation){APPROACH_SETTLED, NAN, value[2], 0.0};
    } else if (first * second < 0.0) {
        result.approach = APPROACH_OSCILLATING;
    } else if (!(fabs(first) > ratio_of_changes(spacing, 0.0) * fabs(second))) {
        result.approach = APPROACH_DIVERGING;
    } else if (second == 0.0) {
        result = (struct extrapolation){APPROACH_MONOTONE, NAN, value[2], 0.0};
    } else {
        double order = order_of_ratio(spacing, first / second);
        double left = second / expm1(order * log(spacing[1] / spacing[2]));
        result =
            (struct extrapolation){APPROACH_MONOTONE, order, value[2] - left, 1.25 * fabs(left)};
    }
    return result;
}

const char *approach_name(enum approach approach)
{
    static const char *const names[] = {"unknown", "settled", "monotone", "oscillating",
                                        "diverging"};
    return names[approach];
}
