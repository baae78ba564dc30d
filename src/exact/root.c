/* The root of an increasing curve; see root.h. */
#include "exact/root.h"

#include <float.h>

#include "base/base.h"

/* Newton alone needs about ten steps; the rest is room for halving a bracket of any two doubles. */
enum { ROOT_STEPS = 4096 };

double root_find(struct root_value (*curve)(const void *context, double x), const void *context,
                 double low, double high, double start)
{
    double x = start;
    double last = INFINITY;
    for (int step = 0; step < ROOT_STEPS; step++) {
        struct root_value at = curve(context, x);
        if (at.value == 0.0)
            return x;
        if (at.value < 0.0)
            low = x;
        else
            high = x;
        double next = x - at.value / at.slope;
        if (fabs(next - x) <= DBL_EPSILON * fabs(next))
            return next;
        /* A step outside the bracket, or one that gains less than half (a kink in the curve, or its
         * noise), gives way to halving. */
        bool slow = fabs(at.value) > 0.5 * last && isfinite(high);
        if (!(next > low && next < high) || slow)
            next = 0.5 * (low + high);
        if (next <= low || next >= high)
            return x;
        last = fabs(at.value);
        x = next;
    }
    return x;
}
