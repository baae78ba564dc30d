/* Dimensions and units. The symbols are our own list, so that a slip of the pen is not taken for an
 * exotic unit (UDUNITS-2 by itself takes "kph" for kilo-phot); the tests hold it against
 * UDUNITS-2. */
#ifndef BOLIDE_UNITS_H
#define BOLIDE_UNITS_H

#include "base/error.h"

/* Exponents of metre, kilogram, second and kelvin. Angles and fractions have none. */
struct dimension {
    int8_t length, mass, time, temperature;
};

/* SI value = scale * number + offset; offset is zero but for a bare degC. */
struct unit {
    double scale, offset;
    struct dimension dimension;
};

bool dimension_equal(struct dimension a, struct dimension b);
/* That of a value of A over one of B. */
struct dimension dimension_quotient(struct dimension a, struct dimension b);

/* The unit that TEXT spells: symbols of the list joined by '*', '/', '^' and integers: "kg/m^3",
 * "J/(kg*K)", "%". The empty text is the number one. An unknown symbol gives ERROR_INPUT with the
 * nearest one: unknown unit "Mpa" (did you mean "MPa"?). */
struct error *unit_parse(const char *text, struct unit *unit);

/* The SI spelling of a dimension, "kg/m^3", "Pa" and "J/kg" where they fit, "" for none.
 * BUFFER holds at least DIMENSION_TEXT bytes; returns BUFFER. */
enum { DIMENSION_TEXT = 48 };
const char *dimension_text(struct dimension dimension, char *buffer);

/* The symbol that stands at INDEX of the list, NULL behind the last. */
const char *unit_symbol(int index);

/* Of COUNT names the one nearest to WORD by edit distance, NULL when none is near enough to be a
 * slip (at most a third of the letters, at least one). */
const char *nearest_name(const char *word, const char *const *names, int count);

#endif
