/* The numbers behind pictures and plots, without any drawing: readable multiples of units, ranges,
 * ticks at round values, colour maps. */
#ifndef BOLIDE_PICTURE_SCALE_H
#define BOLIDE_PICTURE_SCALE_H

#include "parallel/ranks.h"

enum { TICKS_MAX = 32, TICK_TEXT = 40, UNIT_TEXT = 64 };

/* A readable multiple of an SI unit: 1e9 and "GPa". */
struct multiple {
    double scale;
    char name[UNIT_TEXT];
};

/* The multiple of UNIT in which MAGNITUDE is at least one; powers of 1000 where the unit has no
 * customary multiple near ("10⁶ 1/s"). */
struct multiple multiple_find(double magnitude, const char *unit);

/* Writes VALUE of UNIT in a readable multiple, "3.1 µs". */
void multiple_text(double value, const char *unit, char *buffer, size_t size);

struct range {
    double low, high;
};

BOLIDE_INLINE struct range range_empty(void)
{
    struct range range = {INFINITY, -INFINITY};
    return range;
}

/* Extends RANGE to VALUE, if that is finite. */
BOLIDE_INLINE void range_include(struct range *range, double value)
{
    if (isfinite(value)) {
        range->low = minimum(range->low, value);
        range->high = maximum(range->high, value);
    }
}

/* Collective: the union of the ranges of all ranks. */
BOLIDE_INLINE struct range range_of_all(const struct ranks *ranks, struct range range)
{
    struct range all = {ranks_minimum(ranks, range.low), ranks_maximum(ranks, range.high)};
    return all;
}

/* The largest magnitude in RANGE. */
BOLIDE_INLINE double range_reach(struct range range)
{
    return maximum(fabs(range.low), fabs(range.high));
}

/* A range that can be drawn: 0 .. 1 for an empty one, and a constant (but for rounding) gets room
 * on both sides. With LOGARITHMIC the range is positive already. */
struct range range_drawable(struct range range, bool logarithmic);

/* RANGE with FRACTION of its length more on both sides. */
struct range range_padded(struct range range, double fraction, bool logarithmic);

struct ticks {
    int count;
    double at[TICKS_MAX];
    char text[TICKS_MAX][TICK_TEXT];
};

/* Ticks at multiples of 1, 2 or 5 times a power of ten, in at most MOST intervals, written in units
 * of SCALE. */
struct ticks ticks_linear(struct range range, double scale, int most);

/* Ticks at powers of ten, and at 2 and 5 times them where the range is short. */
struct ticks ticks_logarithmic(struct range range, int most);

struct colour {
    double red, green, blue;
};

/* How a field's values become colours: viridis from low to high, by their logarithms where it is
 * LOGARITHMIC; where both signs matter, blue over grey (zero) to red. */
struct colour_scale {
    struct range range;
    bool diverging, logarithmic, grey;
};

struct colour_scale colour_scale_make(struct range range);
/* By logarithms over the last four decades of RANGE; as above where nothing is above zero. */
struct colour_scale colour_scale_logarithmic(struct range range);
/* Other colours than those that suit the range: diverging, or from black to white, or viridis. */
void colour_scale_choose(struct colour_scale *scale, bool diverging, bool grey);

/* The colour of VALUE; beyond the range the end's colour, light grey for NaN. */
struct colour colour_of(const struct colour_scale *scale, double value);

/* The same in two steps: where VALUE is among the colours, 0 to 1, NaN for NaN; the colour
 * there. */
double colour_place(const struct colour_scale *scale, double value);
struct colour colour_at_place(const struct colour_scale *scale, double place);

/* Colours that colour-blind readers can tell apart, for series, bodies and materials. */
struct colour colour_of_category(int index);

#endif
