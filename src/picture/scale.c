/* The numbers behind a picture: readable multiples of units, ranges, round ticks, colour maps.
 * Colours: viridis (S. van der Walt and N. Smith) and the diverging map of K. Moreland, "Diverging
 * color maps for scientific visualization" (2009), both sampled; the categories are those of M.
 * Okabe and K. Ito. */
#include "picture/scale.h"

#include <stdio.h>
#include <string.h>

/* The multiples in use, ascending for each unit. */
static const struct {
    const char *unit;
    double scale;
    const char *name;
} multiples[] = {
    {"m", 1e-9, "nm"},        {"m", 1e-6, "µm"},        {"m", 1e-3, "mm"},
    {"m", 1.0, "m"},          {"m", 1e3, "km"},         {"s", 1e-9, "ns"},
    {"s", 1e-6, "µs"},        {"s", 1e-3, "ms"},        {"s", 1.0, "s"},
    {"Pa", 1.0, "Pa"},        {"Pa", 1e3, "kPa"},       {"Pa", 1e6, "MPa"},
    {"Pa", 1e9, "GPa"},       {"m/s", 1.0, "m/s"},      {"m/s", 1e3, "km/s"},
    {"kg/m^3", 1.0, "kg/m³"}, {"kg/m^3", 1e3, "g/cm³"}, {"J/kg", 1.0, "J/kg"},
    {"J/kg", 1e3, "kJ/kg"},   {"J/kg", 1e6, "MJ/kg"},   {"J", 1.0, "J"},
    {"J", 1e3, "kJ"},         {"J", 1e6, "MJ"},
};

/* Adds TEXT to BUFFER, which stays a whole string of at most SIZE bytes. */
static void append(char *buffer, size_t size, const char *text)
{
    size_t used = strlen(buffer), length = strlen(text);
    if (used + length < size)
        memcpy(buffer + used, text, length + 1);
}

static void append_raised(char *buffer, size_t size, const char *number, int length)
{
    static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    for (int i = 0; i < length; ++i)
        append(buffer, size, number[i] == '-' ? "⁻" : raised[number[i] - '0']);
}

static void append_power_of_ten(char *buffer, size_t size, int exponent)
{
    char number[16];
    int length = snprintf(number, sizeof number, "%d", exponent);
    append(buffer, size, "10");
    append_raised(buffer, size, number, length);
}

/* UNIT as print has it: "kg/m^3" becomes kg/m³, "J/(kg*K)" J/(kg·K). */
static void append_unit(char *buffer, size_t size, const char *unit)
{
    while (*unit) {
        if (*unit == '^') {
            int length = (int)strspn(unit + 1, "-0123456789");
            append_raised(buffer, size, unit + 1, length);
            unit += 1 + length;
        } else {
            char letter[2] = {*unit++, 0};
            append(buffer, size, letter[0] == '*' ? "·" : letter);
        }
    }
}

struct multiple multiple_find(double magnitude, const char *unit)
{
    struct multiple result = {.scale = 1.0};
    const char *customary = NULL;
    for (size_t i = 0; i < COUNT_OF(multiples); ++i) {
        if (!unit || strcmp(multiples[i].unit, unit) != 0)
            continue;
        /* A hair of slack keeps what is 1 mm but for rounding from turning into 1000 µm. */
        bool reached = magnitude * (1.0 + 1e-9) >= multiples[i].scale;
        if (!customary || reached || (magnitude == 0.0 && multiples[i].scale <= 1.0)) {
            customary = multiples[i].name;
            result.scale = multiples[i].scale;
        }
    }
    double reduced = magnitude / result.scale;
    if (isfinite(reduced) && reduced > 0.0 && (reduced < 1e-3 || reduced >= 1e5)) {
        int exponent = 3 * (int)floor((log10(reduced) + 1e-9) / 3.0);
        double scale = result.scale * pow(10.0, exponent);
        if (scale > 0.0 && isfinite(scale)) {
            result.scale = scale;
            append_power_of_ten(result.name, UNIT_TEXT, exponent);
            if (unit && *unit)
                append(result.name, UNIT_TEXT, " ");
        }
    }
    if (customary)
        append(result.name, UNIT_TEXT, customary);
    else if (unit)
        append_unit(result.name, UNIT_TEXT, unit);
    return result;
}

void multiple_text(double value, const char *unit, char *buffer, size_t size)
{
    struct multiple multiple = multiple_find(fabs(value), unit);
    snprintf(buffer, size, "%s%.4g%s%s", value < 0.0 ? "−" : "", fabs(value) / multiple.scale,
             *multiple.name ? " " : "", multiple.name);
}

struct range range_drawable(struct range range, bool logarithmic)
{
    if (!(range.low <= range.high)) {
        range.low = logarithmic ? 0.1 : 0.0;
        range.high = 1.0;
    }
    double reach = range_reach(range);
    if (range.high - range.low > 1e-9 * reach)
        return range;
    if (logarithmic) {
        range.low /= 2.0;
        range.high *= 2.0;
    } else {
        /* A tenth of the value, as a readable width; the smallest normal numbers have no room
         * below. */
        double half = reach > 1e-300 ? 0.05 * reach : 1.0;
        range.low -= half;
        range.high += half;
    }
    return range;
}

struct range range_padded(struct range range, double fraction, bool logarithmic)
{
    if (logarithmic) {
        double factor = pow(range.high / range.low, fraction);
        range.low /= factor;
        range.high *= factor;
    } else {
        double more = fraction * (range.high - range.low);
        range.low -= more;
        range.high += more;
    }
    return range;
}

/* Writes NUMBER with a proper minus sign. */
static void number_text(char *buffer, double number, int decimals)
{
    snprintf(buffer, TICK_TEXT, "%s%.*f", number < 0.0 ? "−" : "", decimals, fabs(number));
}

struct ticks ticks_linear(struct range range, double scale, int most)
{
    struct ticks ticks = {0};
    double low = range.low / scale, high = range.high / scale;
    double least = (high - low) / maximum(most, 1);
    if (!(least > 0.0) || !isfinite(least))
        return ticks;
    int exponent = (int)floor(log10(least) + 1e-9);
    static const double rounds[] = {1.0, 2.0, 5.0, 10.0};
    double step = pow(10.0, exponent), unit = step;
    int decimals = exponent < 0 ? -exponent : 0;
    for (size_t i = 0; i < COUNT_OF(rounds) && step < least * (1.0 - 1e-9); ++i)
        step = rounds[i] * unit;
    if (step > 9.5 * unit && decimals > 0)
        --decimals;
    double slack = 1e-6 * step, first = ceil((low - slack) / step);
    for (int i = 0; i < TICKS_MAX; ++i) {
        double at = (first + i) * step;
        /* Where the numbers run out of digits all ticks would stand in one place. */
        if (at > high + slack || (i > 0 && at == (first + i - 1) * step))
            break;
        if (fabs(at) < slack)
            at = 0.0;
        ticks.at[ticks.count] = at * scale;
        number_text(ticks.text[ticks.count++], at, decimals > 12 ? 12 : decimals);
    }
    return ticks;
}

static void add_power(struct ticks *ticks, struct range range, int factor, int exponent)
{
    double at = factor * pow(10.0, exponent);
    if (at < range.low * (1.0 - 1e-9) || at > range.high * (1.0 + 1e-9) ||
        ticks->count == TICKS_MAX)
        return;
    char *text = ticks->text[ticks->count];
    ticks->at[ticks->count++] = at;
    if (exponent >= -2 && exponent <= 3) {
        number_text(text, at, exponent < 0 ? -exponent : 0);
        return;
    }
    text[0] = '\0';
    if (factor != 1)
        snprintf(text, TICK_TEXT, "%d·", factor);
    append_power_of_ten(text, TICK_TEXT, exponent);
}

struct ticks ticks_logarithmic(struct range range, int most)
{
    struct ticks ticks = {0};
    double decades = log10(range.high / range.low);
    int first = (int)floor(log10(range.low)), last = (int)ceil(log10(range.high));
    bool between = decades < 2.0 && 3.0 * decades < most;
    int stride = maximum(1.0, ceil(decades / maximum(most, 1)));
    for (int exponent = first; exponent <= last; ++exponent) {
        if (exponent % stride != 0)
            continue;
        add_power(&ticks, range, 1, exponent);
        if (between) {
            add_power(&ticks, range, 2, exponent);
            add_power(&ticks, range, 5, exponent);
        }
    }
    return ticks.count >= 2 ? ticks : ticks_linear(range, 1.0, most);
}

static const uint32_t viridis[] = {0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e,
                                   0x2a788e, 0x23888e, 0x1f988b, 0x22a884, 0x35b779, 0x54c568,
                                   0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725};
static const uint32_t cool_warm[] = {0x3b4cc0, 0x6282ea, 0x8db0fe, 0xb8d0f9, 0xd6d6d6,
                                     0xf5c4ad, 0xf49a7b, 0xde604d, 0xb40426};
static const uint32_t categories[] = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                      0xe69f00, 0x56b4e9, 0x777777, 0xf0e442};

static struct colour colour_unpack(uint32_t packed)
{
    struct colour colour = {(packed >> 16) / 255.0, (packed >> 8 & 255) / 255.0,
                            (packed & 255) / 255.0};
    return colour;
}

static struct colour colour_between(struct colour a, struct colour b, double part)
{
    struct colour colour = {a.red + part * (b.red - a.red), a.green + part * (b.green - a.green),
                            a.blue + part * (b.blue - a.blue)};
    return colour;
}

struct colour_scale colour_scale_make(struct range range)
{
    struct colour_scale scale = {range_drawable(range, false), false, false, false};
    double negative = -scale.range.low, positive = scale.range.high;
    scale.diverging = minimum(negative, positive) > 0.15 * maximum(negative, positive);
    return scale;
}

struct colour_scale colour_scale_logarithmic(struct range range)
{
    if (!(range.high > 0.0))
        return colour_scale_make(range);
    const struct range decades = {maximum(range.low, 1e-4 * range.high), range.high};
    return (struct colour_scale){range_drawable(decades, true), false, true, false};
}

void colour_scale_choose(struct colour_scale *scale, bool diverging, bool grey)
{
    scale->diverging = diverging && !scale->logarithmic;
    scale->grey = grey;
}

double colour_place(const struct colour_scale *scale, double value)
{
    double low = scale->range.low, high = scale->range.high;
    if (scale->diverging) {
        high = range_reach(scale->range); /* zero is the middle colour */
        low = -high;
    }
    const double part = scale->logarithmic ? log(maximum(value, low) / low) / log(high / low)
                                           : (value - low) / (high - low);
    return isnan(value) ? (double)NAN : part > 0.0 ? minimum(part, 1.0) : 0.0;
}

struct colour colour_at_place(const struct colour_scale *scale, double place)
{
    const uint32_t *anchors = scale->diverging ? cool_warm : viridis;
    const int last = (int)(scale->diverging ? COUNT_OF(cool_warm) : COUNT_OF(viridis)) - 1;
    if (scale->grey)
        return (struct colour){place, place, place};
    const int below = (int)minimum(place * last, last - 1);
    return colour_between(colour_unpack(anchors[below]), colour_unpack(anchors[below + 1]),
                          place * last - below);
}

struct colour colour_of(const struct colour_scale *scale, double value)
{
    const double place = colour_place(scale, value);
    return isnan(place) ? colour_unpack(0xd9d9d9) : colour_at_place(scale, place);
}

struct colour colour_of_category(int index)
{
    int palette = (int)COUNT_OF(categories), round = index / palette % 3;
    struct colour white = {1.0, 1.0, 1.0};
    return colour_between(colour_unpack(categories[index % palette]), white, 0.3 * round);
}
