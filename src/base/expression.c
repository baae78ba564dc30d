/* Reading expressions with units: every number and name becomes a variable of its own, so that
 * what is left is a formula of variables.
 *
 * Where the unit of a number ends: a unit stands right behind its number, with or without a
 * blank, and reaches over '*', '/' and whole powers as long as unit symbols follow, in
 * parentheses too. So `3 m/s*2` is (3 m/s)*2, `2.5 J/(kg*K)` is one literal, `5 1/s` is five a
 * second, and `3 m/(t0*2)` divides 3 m. Behind a number a unit wins over a name spelled alike
 * (`3 g`); further on in a unit such a word could be either and is refused. A sign before a bare
 * degC belongs to the number: `-40 degC` is 233.15 K. */
#include "base/expression_internal.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* What muparser knows under these names, without its operators of logic and assignment. */
static const char *const functions[] = {
    "abs",   "acos", "asin", "atan", "atan2", "cos",  "cosh", "exp",  "ln",
    "log10", "max",  "min",  "sin",  "sinh",  "sqrt", "tan",  "tanh",
};

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (unsigned char)c >= 128;
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

static const char *skip_blanks(const char *at)
{
    while (is_blank(*at))
        at++;
    return at;
}

/* The end of the word at AT; a percent sign is a word of its own. AT itself when none stands
 * there. */
static const char *word_end(const char *at)
{
    if (*at == '%')
        return at + 1;
    if (is_letter(*at))
        while (is_letter(*at) || is_digit(*at))
            at++;
    return at;
}

static bool is_word(const char *word, size_t length, const char *name)
{
    return strlen(name) == length && !memcmp(name, word, length);
}

static const struct named_quantity *find_name(const struct expression_reading *reading,
                                              const char *word, size_t length)
{
    const struct named_quantities *names = reading->names;
    if (names && names->index.slots) {
        assert(names->at);
        const int at = name_index_find_part(&names->index, word, length);
        return at < 0 ? NULL : &names->at[at];
    }
    for (int i = 0; names && i < names->count; i++)
        if (is_word(word, length, names->at[i].name))
            return &names->at[i];
    return NULL;
}

static bool is_function(const char *word, size_t length)
{
    for (size_t i = 0; i < COUNT_OF(functions); i++)
        if (is_word(word, length, functions[i]))
            return true;
    return false;
}

/* 1, 2, 3 for x, y, z, and 4 for t, among ARGUMENTS; 0 for any other word. */
static int argument(unsigned arguments, const char *word, size_t length)
{
    if (length == 1 && *word == 't' && arguments & ARGUMENT_TIME)
        return ARGUMENT_T + 1;
    return length == 1 && *word >= 'x' && *word <= 'z' && arguments & ARGUMENT_POSITION
               ? *word - 'x' + 1
               : 0;
}

static struct error *parse_unit(const char *start, const char *end, struct unit *unit)
{
    char *text = text_copy_part(start, (size_t)(end - start));
    if (!text)
        return out_of_memory();
    struct error *error = unit_parse(text, unit);
    free(text);
    return error;
}

static bool is_unit(const char *start, const char *end)
{
    struct unit unit;
    struct error *error = end > start ? parse_unit(start, end, &unit) : NULL;
    error_free(error);
    return end > start && !error;
}

static const char *scan_factors(const struct expression_reading *reading, const char *end,
                                const char **ambiguous);

/* The end of the unit symbol or parenthesis at AT with its power, NULL where something else stands.
 * *ambiguous is set to a symbol that is a name as well. */
static const char *scan_factor(const struct expression_reading *reading, const char *at,
                               const char **ambiguous)
{
    const char *end;
    if (*at == '(') {
        end = scan_factor(reading, skip_blanks(at + 1), ambiguous);
        end = end ? skip_blanks(scan_factors(reading, end, ambiguous)) : NULL;
        if (!end || *end != ')')
            return NULL;
        end++;
    } else {
        end = word_end(at); /* t is the time, not a tonne, where it may be */
        if (!is_unit(at, end) || argument(reading->arguments, at, (size_t)(end - at)))
            return NULL;
        if (find_name(reading, at, (size_t)(end - at)))
            *ambiguous = at;
    }
    const char *power = end;
    if (*power == '^')
        power += power[1] == '-' || power[1] == '+' ? 2 : 1;
    if (power == end || !is_digit(*power))
        return end;
    while (is_digit(*power))
        power++;
    return *power == '.' || is_letter(*power) ? end : power;
}

/* Goes on from END over the further factors of a unit. */
static const char *scan_factors(const struct expression_reading *reading, const char *end,
                                const char **ambiguous)
{
    for (;;) {
        const char *sign = skip_blanks(end), *before = *ambiguous;
        if (*sign != '*' && *sign != '/')
            return end;
        const char *next = scan_factor(reading, skip_blanks(sign + 1), ambiguous);
        if (!next) {
            *ambiguous = before;
            return end;
        }
        end = next;
    }
}

/* Finds the unit behind a number that ends at AT: text from *start to *end, empty if there is
 * none. */
static struct error *scan_unit(const struct expression_reading *reading, const char *at,
                               const char **start, const char **end)
{
    const char *ambiguous = NULL, *number_end = at;
    at = skip_blanks(at);
    *start = *end = at;
    const char *word = word_end(at);
    if (word > at) {
        int length = (int)(word - at);
        bool known = find_name(reading, at, (size_t)length) || is_function(at, (size_t)length) ||
                     is_word(at, (size_t)length, "pi");
        if ((known && !is_unit(at, word)) || argument(reading->arguments, at, (size_t)length))
            return error_new(ERROR_INPUT,
                             "\"%.*s\" after a number is not a unit: put \"*\" between them",
                             length, at);
        struct unit unit;
        TRY(parse_unit(at, word, &unit));
        *end = scan_factor(reading, at, &ambiguous);
    } else if (*at == '1' && at > number_end && *skip_blanks(at + 1) == '/') {
        *end = scan_factor(reading, skip_blanks(skip_blanks(at + 1) + 1), &ambiguous);
    }
    if (!*end || *end == at) {
        *end = at;
        return NULL;
    }
    ambiguous = NULL; /* right behind the number the unit wins */
    *end = scan_factors(reading, *end, &ambiguous);
    if (ambiguous)
        return error_new(
            ERROR_INPUT,
            "in \"%.*s\" the word \"%.*s\" is both a unit and a name: rename it in let, or "
            "put the quantity before it in parentheses",
            (int)(*end - *start), *start, (int)(word_end(ambiguous) - ambiguous), ambiguous);
    if (**end == '^')
        return error_new(ERROR_INPUT,
                         "the power of the unit \"%.*s\" is not a whole number: put parentheses "
                         "around the quantity to raise it as a whole",
                         (int)(*end - *start), *start);
    return NULL;
}

static void emit(struct expression_reading *reading, char c, const char *origin)
{
    reading->origin[reading->length] = (int)(origin - reading->text);
    reading->formula[reading->length++] = c;
}

void expression_variable(int index, char name[VARIABLE_NAME])
{
    const char digits[VARIABLE_NAME] = {'v', (char)('0' + index / 100),
                                        (char)('0' + index / 10 % 10), (char)('0' + index % 10)};
    memcpy(name, digits, VARIABLE_NAME);
}

/* A blank and v000, v001, ..., so that neighbours do not run together. */
static void emit_variable(struct expression_reading *reading, struct quantity quantity,
                          const char *origin)
{
    int index = reading->variables++;
    reading->quantities[index] = quantity;
    reading->argument[index] = 0;
    char name[VARIABLE_NAME];
    expression_variable(index, name);
    emit(reading, ' ', origin);
    for (size_t i = 0; name[i]; i++)
        emit(reading, name[i], origin);
}

/* Takes back a sign that stands before an operand, not between two; true if there was one. */
static bool take_sign(struct expression_reading *reading)
{
    const char *formula = reading->formula;
    int last = reading->length - 1;
    while (last >= 0 && formula[last] == ' ')
        last--;
    if (last < 0 || formula[last] != '-')
        return false;
    int before = last - 1;
    while (before >= 0 && formula[before] == ' ')
        before--;
    if (before >= 0 && !strchr("+-*/^(,<>=", formula[before]))
        return false;
    reading->formula[last] = ' ';
    return true;
}

/* NUMBER times the scale; where the scale is one part of a whole number the division rounds
 * better, so that 35 mm and 0.035 m are the same bits. */
static double to_si(double number, const struct unit *unit)
{
    double parts = rint(1.0 / unit->scale);
    double scaled =
        unit->scale < 1.0 && 1.0 / parts == unit->scale ? number / parts : number * unit->scale;
    return scaled + unit->offset;
}

static struct error *read_literal(struct expression_reading *reading)
{
    const char *start = reading->at, *end = start;
    while (is_digit(*end))
        end++;
    if (*end == '.')
        for (end++; is_digit(*end);)
            end++;
    if (*end == 'e' || *end == 'E') {
        const char *exponent = end + (end[1] == '+' || end[1] == '-' ? 2 : 1);
        for (; is_digit(*exponent); exponent++)
            end = exponent + 1;
    }
    char digits[LONGEST_EXPRESSION + 1];
    memcpy(digits, start, (size_t)(end - start));
    digits[end - start] = '\0';
    double number = strtod(digits, NULL);
    if (!isfinite(number))
        return error_new(ERROR_INPUT, "the number %s is too large", digits);
    const char *unit_start;
    struct unit unit = {.scale = 1.0};
    reading->at = end;
    TRY(scan_unit(reading, end, &unit_start, &end));
    if (end > unit_start) {
        TRY(parse_unit(unit_start, end, &unit));
        reading->at = reading->unit_end = end;
    }
    if (unit.offset != 0.0 && take_sign(reading))
        number = -number;
    emit_variable(reading, (struct quantity){to_si(number, &unit), unit.dimension}, start);
    return NULL;
}

static bool behind_unit(const struct expression_reading *reading, const char *word)
{
    if (!reading->unit_end)
        return false;
    const char *sign = skip_blanks(reading->unit_end);
    return (*sign == '*' || *sign == '/') && skip_blanks(sign + 1) == word;
}

static struct error *unknown_word(const struct expression_reading *reading, const char *word,
                                  const char *end)
{
    size_t length = (size_t)(end - word);
    if (is_function(word, length))
        return error_new(ERROR_INPUT, "the function \"%.*s\" needs a \"(\" after its name",
                         (int)length, word);
    if (is_word(word, length, "t"))
        return error_new(ERROR_INPUT, "unknown name \"t\" (it is the time only in loads and in the "
                                      "velocity of a driven body)");
    if (is_unit(word, end))
        return error_new(ERROR_INPUT, "unknown name \"%.*s\" (a unit needs a number: \"1 %.*s\")",
                         (int)length, word, (int)length, word);
    if (argument(ARGUMENT_POSITION, word, length))
        return error_new(
            ERROR_INPUT,
            "unknown name \"%c\" (it is a position only in the initial state of a body)", *word);
    const int own = reading->names ? reading->names->count : 0;
    const int count = own + (int)COUNT_OF(functions);
    const char **known = malloc((size_t)count * sizeof *known);
    char *name = text_copy_part(word, length);
    const char *nearest = NULL;
    if (known && name) {
        for (int i = 0; i < own; i++)
            known[i] = reading->names->at[i].name;
        memcpy(known + own, functions, sizeof functions);
        nearest = nearest_name(name, known, count);
    }
    free(known);
    free(name);
    if (nearest)
        return error_new(ERROR_INPUT, "unknown name \"%.*s\" (did you mean \"%s\"?)", (int)length,
                         word, nearest);
    struct unit unit;
    if (behind_unit(reading, word))
        return parse_unit(word, end, &unit);
    return error_new(ERROR_INPUT, "unknown name \"%.*s\"", (int)length, word);
}

static struct error *read_word(struct expression_reading *reading)
{
    const char *word = reading->at, *end = word_end(word);
    size_t length = (size_t)(end - word);
    const struct named_quantity *name = find_name(reading, word, length);
    const int index = argument(reading->arguments, word, length);
    reading->at = end;
    if (is_function(word, length) && *skip_blanks(end) == '(') {
        for (const char *c = word; c < end; c++)
            emit(reading, *c, c);
        reading->at = skip_blanks(end);
    } else if (index) {
        static const struct dimension metre = {.length = 1}, second = {.time = 1};
        const bool time = index > ARGUMENT_T;
        if (name)
            return error_new(ERROR_INPUT,
                             "\"%c\" is the %s here: call the name of let something else", *word,
                             time ? "time" : "position");
        emit_variable(reading, (struct quantity){0.0, time ? second : metre}, word);
        reading->argument[reading->variables - 1] = (int8_t)index;
    } else if (name) {
        emit_variable(reading, name->quantity, word);
    } else if (is_word(word, length, "pi")) {
        emit_variable(reading, (struct quantity){.value = 3.14159265358979323846}, word);
    } else {
        return unknown_word(reading, word, end);
    }
    return NULL;
}

/* Turns the text into a formula of variables. */
static struct error *read_text(struct expression_reading *reading)
{
    while (*reading->at) {
        char c = *reading->at;
        if (is_digit(c) || (c == '.' && is_digit(reading->at[1])))
            TRY(read_literal(reading));
        else if (is_letter(c))
            TRY(read_word(reading));
        else if (is_blank(c) || strchr(reading->arguments ? "+-*/^(),<>" : "+-*/^(),", c)) {
            emit(reading, is_blank(c) ? ' ' : c, reading->at);
            reading->at++;
            if ((c == '<' || c == '>') && *reading->at == '=') {
                emit(reading, '=', reading->at);
                reading->at++;
            }
        } else
            return error_new(ERROR_INPUT, "unexpected \"%c\"", c);
    }
    return NULL;
}

struct error *expression_read(const char *text, const struct named_quantities *names,
                              unsigned arguments, struct expression_reading **reading)
{
    *reading = NULL;
    if (!*skip_blanks(text))
        return error_new(ERROR_INPUT, "the expression is empty");
    if (strlen(text) > LONGEST_EXPRESSION)
        return error_new(ERROR_INPUT, "an expression is longer than %d bytes", LONGEST_EXPRESSION);
    struct expression_reading *made = memory_allocate(sizeof *made);
    if (!made)
        return out_of_memory();
    made->text = made->at = text;
    made->names = names;
    made->arguments = arguments;
    struct error *error = read_text(made);
    if (error)
        free(made);
    else
        *reading = made;
    return error;
}
