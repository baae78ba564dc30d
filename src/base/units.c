/* Units: a table of symbols, the grammar that joins them, and the spelling of dimensions; see
 * units.h.
 *   product = factor {('*' | '/') factor},  factor = (symbol | 1 | '(' product ')') ['^' integer]
 * The factors to SI are written here rather than asked of UDUNITS-2, which would read its
 * database anew for every unit or keep it in a static variable; a unit test holds each symbol
 * against UDUNITS-2. A scale is kept as a fraction of whole numbers while a unit is read: g/cm^3
 * is exactly 1000. */
#include "base/units.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct symbol {
    const char *name;
    double times, over; /* scale = times/over */
    struct dimension dimension;
    double offset;
};

static const struct symbol symbols[] = {
    {"m", 1, 1, {1, 0, 0, 0}, 0},         {"km", 1e3, 1, {1, 0, 0, 0}, 0},
    {"cm", 1, 1e2, {1, 0, 0, 0}, 0},      {"mm", 1, 1e3, {1, 0, 0, 0}, 0},
    {"um", 1, 1e6, {1, 0, 0, 0}, 0},      {"nm", 1, 1e9, {1, 0, 0, 0}, 0},
    {"kg", 1, 1, {0, 1, 0, 0}, 0},        {"g", 1, 1e3, {0, 1, 0, 0}, 0},
    {"mg", 1, 1e6, {0, 1, 0, 0}, 0},      {"t", 1e3, 1, {0, 1, 0, 0}, 0},
    {"s", 1, 1, {0, 0, 1, 0}, 0},         {"ms", 1, 1e3, {0, 0, 1, 0}, 0},
    {"us", 1, 1e6, {0, 0, 1, 0}, 0},      {"ns", 1, 1e9, {0, 0, 1, 0}, 0},
    {"ps", 1, 1e12, {0, 0, 1, 0}, 0},     {"min", 60, 1, {0, 0, 1, 0}, 0},
    {"h", 3600, 1, {0, 0, 1, 0}, 0},      {"N", 1, 1, {1, 1, -2, 0}, 0},
    {"kN", 1e3, 1, {1, 1, -2, 0}, 0},     {"MN", 1e6, 1, {1, 1, -2, 0}, 0},
    {"Pa", 1, 1, {-1, 1, -2, 0}, 0},      {"kPa", 1e3, 1, {-1, 1, -2, 0}, 0},
    {"MPa", 1e6, 1, {-1, 1, -2, 0}, 0},   {"GPa", 1e9, 1, {-1, 1, -2, 0}, 0},
    {"bar", 1e5, 1, {-1, 1, -2, 0}, 0},   {"kbar", 1e8, 1, {-1, 1, -2, 0}, 0},
    {"Mbar", 1e11, 1, {-1, 1, -2, 0}, 0}, {"atm", 101325, 1, {-1, 1, -2, 0}, 0},
    {"J", 1, 1, {2, 1, -2, 0}, 0},        {"mJ", 1, 1e3, {2, 1, -2, 0}, 0},
    {"kJ", 1e3, 1, {2, 1, -2, 0}, 0},     {"MJ", 1e6, 1, {2, 1, -2, 0}, 0},
    {"W", 1, 1, {2, 1, -3, 0}, 0},        {"mW", 1, 1e3, {2, 1, -3, 0}, 0},
    {"kW", 1e3, 1, {2, 1, -3, 0}, 0},     {"MW", 1e6, 1, {2, 1, -3, 0}, 0},
    {"K", 1, 1, {0, 0, 0, 1}, 0},         {"degC", 1, 1, {0, 0, 0, 1}, 273.15},
    {"Hz", 1, 1, {0, 0, -1, 0}, 0},       {"kHz", 1e3, 1, {0, 0, -1, 0}, 0},
    {"MHz", 1e6, 1, {0, 0, -1, 0}, 0},    {"rad", 1, 1, {0, 0, 0, 0}, 0},
    {"mrad", 1, 1e3, {0, 0, 0, 0}, 0},    {"deg", 3.14159265358979323846, 180, {0, 0, 0, 0}, 0},
    {"sr", 1, 1, {0, 0, 0, 0}, 0},        {"%", 1, 1e2, {0, 0, 0, 0}, 0},
};

/* Spellings that read better than products of base units. */
static const struct {
    struct dimension dimension;
    const char *text;
} spellings[] = {
    {{1, 1, -2, 0}, "N"},          {{-1, 1, -2, 0}, "Pa"},   {{2, 1, -2, 0}, "J"},
    {{2, 1, -3, 0}, "W"},          {{2, 0, -2, 0}, "J/kg"},  {{2, 0, -3, 0}, "W/kg"},
    {{-1, 1, -1, 0}, "Pa*s"},      {{-1, 1, -3, 0}, "Pa/s"}, {{1, -1, 2, 0}, "1/Pa"},
    {{0, 1, -2, 0}, "N/m"},        {{0, 1, -3, 0}, "W/m^2"}, {{-1, 1, -2, -1}, "Pa/K"},
    {{2, 0, -2, -1}, "J/(kg*K)"},  {{2, 1, -2, -1}, "J/K"},  {{1, 1, -3, -1}, "W/(m*K)"},
    {{0, 1, -3, -1}, "W/(m^2*K)"},
};

/* A unit while it is read, as a fraction and with room for intermediate powers. */
enum { LONGEST_UNIT = 200, HIGHEST_POWER = 99 };

struct product {
    double times, over, offset;
    int power[4]; /* in the order of struct dimension */
};

struct cursor {
    const char *text, *at;
};

static struct error *parse_product(struct cursor *cursor, struct product *product);

bool dimension_equal(struct dimension a, struct dimension b)
{
    return a.length == b.length && a.mass == b.mass && a.time == b.time &&
           a.temperature == b.temperature;
}

struct dimension dimension_quotient(struct dimension a, struct dimension b)
{
    return (struct dimension){(int8_t)(a.length - b.length), (int8_t)(a.mass - b.mass),
                              (int8_t)(a.time - b.time), (int8_t)(a.temperature - b.temperature)};
}

const char *unit_symbol(int index)
{
    return index >= 0 && index < (int)COUNT_OF(symbols) ? symbols[index].name : NULL;
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (unsigned char)c >= 128;
}

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

/* Both micro signs of Unicode, U+00B5 and U+03BC, stand for the "u" of the table. */
static const struct symbol *find_symbol(const char *word, size_t length)
{
    bool micro = length > 2 && (!memcmp(word, "\xC2\xB5", 2) || !memcmp(word, "\xCE\xBC", 2));
    size_t skipped = micro ? 2 : 0, first = micro ? 1 : 0;
    for (size_t i = 0; i < COUNT_OF(symbols); i++) {
        const char *name = symbols[i].name;
        if (micro && name[0] != 'u')
            continue;
        if (strlen(name + first) == length - skipped &&
            !memcmp(name + first, word + skipped, length - skipped))
            return &symbols[i];
    }
    return NULL;
}

/* A power written without its sign, as in "m3", is kept apart from other slips. */
static struct error *unknown_symbol(const char *word, size_t length)
{
    size_t letters = length;
    while (letters > 0 && is_digit(word[letters - 1]))
        letters--;
    if (letters < length && find_symbol(word, letters))
        return error_new(ERROR_INPUT, "unknown unit \"%.*s\" (did you mean \"%.*s^%.*s\"?)",
                         (int)length, word, (int)letters, word, (int)(length - letters),
                         word + letters);
    const char *names[COUNT_OF(symbols)];
    for (size_t i = 0; i < COUNT_OF(symbols); i++)
        names[i] = symbols[i].name;
    char copy[LONGEST_UNIT + 1];
    memcpy(copy, word, length);
    copy[length] = '\0';
    const char *nearest = nearest_name(copy, names, (int)COUNT_OF(names));
    if (nearest)
        return error_new(ERROR_INPUT, "unknown unit \"%s\" (did you mean \"%s\"?)", copy, nearest);
    return error_new(ERROR_INPUT, "unknown unit \"%s\" (bolide help units lists them)", copy);
}

static void skip_blanks(struct cursor *cursor)
{
    while (*cursor->at == ' ' || *cursor->at == '\t')
        cursor->at++;
}

static struct error *unexpected(const struct cursor *cursor)
{
    if (*cursor->at)
        return error_new(ERROR_INPUT, "unit \"%s\" cannot be read at \"%s\"", cursor->text,
                         cursor->at);
    return error_new(ERROR_INPUT, "unit \"%s\" is incomplete", cursor->text);
}

/* Multiplies PRODUCT by the EXPONENT-th power of FACTOR; false when a power gets too high. */
static bool multiply(struct product *product, const struct product *factor, int exponent)
{
    for (int i = 0; i < abs(exponent); i++) {
        product->times *= exponent > 0 ? factor->times : factor->over;
        product->over *= exponent > 0 ? factor->over : factor->times;
    }
    bool fits = isfinite(product->times) && isfinite(product->over);
    for (int i = 0; i < 4; i++) {
        product->power[i] += exponent * factor->power[i];
        fits = fits && abs(product->power[i]) <= HIGHEST_POWER;
    }
    return fits;
}

static struct error *parse_exponent(struct cursor *cursor, int *exponent)
{
    *exponent = 1;
    if (*cursor->at != '^')
        return NULL;
    cursor->at++;
    bool negative = *cursor->at == '-';
    if (negative || *cursor->at == '+')
        cursor->at++;
    if (!is_digit(*cursor->at))
        return unexpected(cursor);
    int value = 0;
    for (; is_digit(*cursor->at); cursor->at++)
        value = value > HIGHEST_POWER ? value : 10 * value + (*cursor->at - '0');
    *exponent = negative ? -value : value;
    return NULL;
}

static struct error *parse_primary(struct cursor *cursor, struct product *factor)
{
    *factor = (struct product){.times = 1.0, .over = 1.0};
    const char *start = cursor->at;
    if (*start == '(') {
        cursor->at++;
        TRY(parse_product(cursor, factor));
        if (*cursor->at != ')')
            return unexpected(cursor);
        cursor->at++;
        return NULL;
    }
    if (*start == '1' && !is_digit(start[1]) && start[1] != '.') {
        cursor->at++;
        return NULL;
    }
    if (*start == '%')
        cursor->at++;
    else if (is_letter(*start))
        while (is_letter(*cursor->at) || is_digit(*cursor->at))
            cursor->at++;
    else
        return unexpected(cursor);
    size_t length = (size_t)(cursor->at - start);
    const struct symbol *symbol = find_symbol(start, length);
    if (!symbol)
        return unknown_symbol(start, length);
    struct dimension d = symbol->dimension;
    *factor = (struct product){
        symbol->times, symbol->over, symbol->offset, {d.length, d.mass, d.time, d.temperature}};
    return NULL;
}

static struct error *parse_product(struct cursor *cursor, struct product *product)
{
    *product = (struct product){.times = 1.0, .over = 1.0};
    for (int sign = 1, count = 1;; count++) {
        skip_blanks(cursor);
        struct product factor;
        int exponent;
        TRY(parse_primary(cursor, &factor));
        TRY(parse_exponent(cursor, &exponent));
        if (abs(exponent) > HIGHEST_POWER || !multiply(product, &factor, sign * exponent))
            return error_new(ERROR_INPUT, "unit \"%s\" has too high a power", cursor->text);
        product->offset = count == 1 && exponent == 1 ? factor.offset : 0.0;
        skip_blanks(cursor);
        if (*cursor->at != '*' && *cursor->at != '/')
            return NULL;
        sign = *cursor->at++ == '*' ? 1 : -1;
    }
}

struct error *unit_parse(const char *text, struct unit *unit)
{
    *unit = (struct unit){.scale = 1.0};
    if (strlen(text) > LONGEST_UNIT)
        return error_new(ERROR_INPUT, "a unit is longer than %d bytes", LONGEST_UNIT);
    struct cursor cursor = {text, text};
    skip_blanks(&cursor);
    if (!*cursor.at)
        return NULL;
    struct product product;
    TRY(parse_product(&cursor, &product));
    if (*cursor.at)
        return unexpected(&cursor);
    unit->scale = product.times / product.over;
    unit->offset = product.offset;
    unit->dimension = (struct dimension){(int8_t)product.power[0], (int8_t)product.power[1],
                                         (int8_t)product.power[2], (int8_t)product.power[3]};
    return NULL;
}

/* Appends the base units whose power has the sign SIGN, joined by '*'; returns how many there
 * are. */
static int append_powers(char *buffer, struct dimension dimension, int sign)
{
    const char *const names[4] = {"kg", "m", "s", "K"};
    const int powers[4] = {dimension.mass, dimension.length, dimension.time, dimension.temperature};
    int count = 0;
    for (int i = 0; i < 4; i++) {
        int power = sign * powers[i];
        size_t used = strlen(buffer);
        if (power > 0)
            snprintf(buffer + used, DIMENSION_TEXT - used, power > 1 ? "%s%s^%d" : "%s%s",
                     count++ ? "*" : "", names[i], power);
    }
    return count;
}

const char *dimension_text(struct dimension dimension, char *buffer)
{
    buffer[0] = '\0';
    for (size_t i = 0; i < COUNT_OF(spellings); i++)
        if (dimension_equal(spellings[i].dimension, dimension))
            return strcpy(buffer, spellings[i].text);
    char below[DIMENSION_TEXT] = "";
    int factors = append_powers(below, dimension, -1);
    if (append_powers(buffer, dimension, 1) == 0 && factors > 0)
        strcpy(buffer, "1");
    if (factors > 0) {
        size_t used = strlen(buffer);
        snprintf(buffer + used, DIMENSION_TEXT - used, factors > 1 ? "/(%s)" : "/%s", below);
    }
    return buffer;
}

/* Half the cost of an edit: a letter in the wrong case is the likelier slip. */
static int substitution_cost(char a, char b)
{
    if (a == b)
        return 0;
    return is_letter(a) && is_letter(b) && (a ^ b) == ('a' ^ 'A') ? 1 : 2;
}

/* Twice the edit distance: insertion, deletion, substitution and exchange of neighbours cost 2. */
enum { LONGEST_NAME = 63 };

static int edit_cost(const char *a, int length_a, const char *b, int length_b)
{
    int cost[LONGEST_NAME + 1][LONGEST_NAME + 1];
    for (int i = 0; i <= length_a; i++)
        for (int j = 0; j <= length_b; j++) {
            if (i == 0 || j == 0) {
                cost[i][j] = 2 * (i + j);
                continue;
            }
            int best = cost[i - 1][j - 1] + substitution_cost(a[i - 1], b[j - 1]);
            best = cost[i - 1][j] + 2 < best ? cost[i - 1][j] + 2 : best;
            best = cost[i][j - 1] + 2 < best ? cost[i][j - 1] + 2 : best;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] &&
                cost[i - 2][j - 2] + 2 < best)
                best = cost[i - 2][j - 2] + 2;
            cost[i][j] = best;
        }
    return cost[length_a][length_b];
}

const char *nearest_name(const char *word, const char *const *names, int count)
{
    size_t length = strlen(word);
    if (length == 0 || length > LONGEST_NAME)
        return NULL;
    int limit = 2 * (length < 6 ? 1 : (int)length / 3);
    const char *nearest = NULL;
    for (int i = 0; i < count; i++) {
        size_t name_length = strlen(names[i]);
        if (name_length > LONGEST_NAME)
            continue;
        int cost = edit_cost(word, (int)length, names[i], (int)name_length);
        /* A word of one letter must not become any other letter. */
        if (cost < 2 * (int)length && (cost < limit || (cost == limit && !nearest))) {
            limit = cost;
            nearest = names[i];
        }
    }
    return nearest;
}
