/* Why a check has no finite value, in words. */
#include <stdio.h>

#include "base/memory.h"
#include "run/checks_internal.h"

/* "no member of "target" is between 5 m and 6 m": where the check looks. */
static char *where_nothing_is(const struct check_input *check)
{
    const struct vector_value *between = &check->between;
    char window[128] = "";
    if (between->count == 2)
        snprintf(window, sizeof window, " between %.6g m and %.6g m%s%s", between->at[0],
                 between->at[1], check->about.count ? " from the point `about`" : " along ",
                 check->about.count ? "" : (const char *const[]){"x", "y", "z"}[check->axis]);
    return text_format("no member%s%s%s is there%s", check->of ? " of \"" : "",
                       check->of ? check->of : "", check->of ? "\"" : "", window);
}

/* Why what another check measured, VALUE, spoils the result; NULL: it does not. KEY names that
 * check. */
static char *why_other(const char *key, const char *name, double value, bool divides)
{
    if (!isfinite(value))
        return text_format("the check \"%s\" of `%s` has no finite value", name, key);
    return divides && value == 0.0
               ? text_format("the check \"%s\" of `%s` measured 0, which cannot divide", name, key)
               : NULL;
}

static char *why_start(double start)
{
    if (start == 0.0)
        return text_copy("the value at the start is 0, which `relative: start` cannot divide by");
    return isfinite(start)
               ? NULL
               : text_copy("there is no finite value at the start for `relative: start`");
}

char *check_reason(const struct prepared_check *prepared, const struct check_memory *memory,
                   int index)
{
    const struct check_input *check = prepared->measurement.check;
    const struct check_memory *own = &memory[index];
    char *text = NULL;
    if (isnan(own->time))
        return text_format("the run ended before t = %.6g s", check->at);
    if (!isfinite(own->measured))
        return own->why == NOTHING_NO_MEMBER ? where_nothing_is(check)
                                             : text_copy(nothing_text((enum nothing)own->why));
    if (check->minus)
        text = why_other("minus", check->minus, memory[check->minus_check].measured, false);
    for (int k = 0; k < check->mean_with.count && !text; k++)
        text = why_other("mean_with", check->mean_with.names[k],
                         memory[check_mean_with(prepared, k)].measured, false);
    if (!text && check->relative)
        text = check->relative_check < 0 ? why_start(own->start)
                                         : why_other("relative", check->relative,
                                                     memory[check->relative_check].measured, true);
    return text ? text : text_copy(nothing_text(NOTHING_SAID));
}
