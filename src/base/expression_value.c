/* The value of an expression, by muparser, and its dimension, found by evaluating the formula again
 * with scaled base units. */
#include <stdlib.h>
#include <string.h>

#include "base/expression_internal.h"

static struct error *different_dimensions(void)
{
    return error_new(ERROR_INPUT, "different dimensions are added or compared, or a function such "
                                  "as exp is taken of a value that has a dimension");
}

/* muparser's codes (enum EErrorCodes of muParserDef.h, which is C++), told in terms of the
 * user's text. Its own messages name our variables, and pass through a static buffer. */
static struct error *syntax_error(const struct expression_reading *reading, muParserHandle_t parser)
{
    enum { UNEXPECTED_COMMA = 4, MISSING_PARENTHESIS = 11, TOO_MANY = 14, TOO_FEW = 15 };
    switch (mupGetErrorCode(parser)) {
    case UNEXPECTED_COMMA:
        return error_new(ERROR_INPUT,
                         "there is a comma outside a function (a decimal point is \".\")");
    case MISSING_PARENTHESIS:
        return error_new(ERROR_INPUT, "a \")\" is missing");
    case TOO_MANY:
    case TOO_FEW:
        return error_new(ERROR_INPUT, "a function has the wrong number of arguments");
    }
    int position = mupGetErrorPos(parser);
    while (position >= 0 && position < reading->length && reading->formula[position] == ' ')
        position++;
    if (position >= 0 && position < reading->length)
        return error_new(ERROR_INPUT, "cannot be read at \"%s\"",
                         reading->text + reading->origin[position]);
    return error_new(ERROR_INPUT, "the expression is incomplete");
}

/* A number between 1/2 and 2 that depends on the INDEX of a variable and on the TRIAL
 * (splitmix64). */
static double any_number(int index, int trial)
{
    uint64_t z = ((uint64_t)index * 64 + (uint64_t)trial + 1) * UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return 0.5 + 1.5 * (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* The dimension must not hang on the values: 0 mm is a length, U0 - U0 a velocity, and in 1 nm +
 * 200 GPa the first term drowns. So each quantity takes any number of its sign instead of its
 * value, and each occurrence of a name another one, of an argument one of any sign. Pure numbers
 * keep theirs, for they may be exponents. Where that gives zero or leaves the domain of a function
 * another trial follows: first with zeros as they are, then with zeros replaced as well (0*plate),
 * at last with the true values. */
enum { TRIALS = 8, LAST_TRIAL = 2 * TRIALS, ARGUMENT_TRIALS = 64 };

static double trial_value(const struct expression_reading *reading, int index, int trial)
{
    struct quantity quantity = reading->quantities[index];
    if (reading->argument[index])
        return any_number(index + LONGEST_EXPRESSION, trial) < 1.25 ? any_number(index, trial)
                                                                    : -any_number(index, trial);
    bool pure = dimension_equal(quantity.dimension, (struct dimension){0});
    bool keep = pure && (quantity.value != 0.0 || trial < TRIALS);
    return keep || trial == LAST_TRIAL ? quantity.value
                                       : copysign(any_number(index, trial), quantity.value);
}

/* The value where the base units are smaller by two to the power of -SHIFTS, exactly. */
static double evaluate_scaled(struct expression_reading *reading, muParserHandle_t parser,
                              int trial, const int shifts[4])
{
    for (int i = 0; i < reading->variables; i++) {
        struct dimension d = reading->quantities[i].dimension;
        int shift = d.length * shifts[0] + d.mass * shifts[1] + d.time * shifts[2] +
                    d.temperature * shifts[3];
        reading->values[i] = ldexp(trial_value(reading, i, trial), shift);
    }
    return mupEval(parser);
}

/* The dimension that the numbers of TRIAL show, at which the value is PLAIN. With metre, kilogram,
 * second and kelvin scaled in turn the value grows by a power of the scale, the exponent of the
 * dimension. A last evaluation with all of them scaled the other way, each differently, must agree:
 * it finds what a sum of different dimensions or a sine of a length slipped through. */
static struct error *dimension_shown(struct expression_reading *reading, muParserHandle_t parser,
                                     int trial, double plain, struct dimension *dimension)
{
    enum { UP = 60 };
    static const int all[4] = {-47, -53, -59, -61};
    double exponents[4], expected = 0.0;
    bool whole = true;
    for (int i = 0; i < 4; i++) {
        int shifts[4] = {0};
        shifts[i] = UP;
        exponents[i] = log2(evaluate_scaled(reading, parser, trial, shifts) / plain) / UP;
        expected += exponents[i] * all[i];
        whole = whole && fabs(exponents[i] - rint(exponents[i])) < 1e-8;
    }
    double found = log2(evaluate_scaled(reading, parser, trial, all) / plain);
    if (!(fabs(found - expected) < 1e-6))
        return different_dimensions();
    if (!whole)
        return error_new(ERROR_INPUT, "the dimension of the value has a fractional power");
    *dimension = (struct dimension){(int8_t)rint(exponents[0]), (int8_t)rint(exponents[1]),
                                    (int8_t)rint(exponents[2]), (int8_t)rint(exponents[3])};
    return NULL;
}

struct error *expression_dimension(struct expression_reading *reading, muParserHandle_t parser,
                                   struct dimension *dimension)
{
    /* Zero whatever the values: like a bare 0 it has no dimension. */
    *dimension = (struct dimension){0};
    bool known = false;
    int trials = reading->arguments ? ARGUMENT_TRIALS : LAST_TRIAL + 1;
    for (int trial = 0; trial < trials; trial++) {
        struct dimension shown;
        double plain = evaluate_scaled(reading, parser, trial, (const int[4]){0});
        if (!isfinite(plain) || plain == 0.0)
            continue;
        TRY(dimension_shown(reading, parser, trial, plain, &shown));
        if (known && !dimension_equal(shown, *dimension))
            return different_dimensions();
        *dimension = shown;
        known = true;
        if (!reading->arguments)
            break;
    }
    return NULL;
}

void expression_give(const struct expression_reading *reading, muParserHandle_t parser,
                     double *values)
{
    for (int i = 0; i < reading->variables; i++) {
        char name[VARIABLE_NAME];
        expression_variable(i, name);
        values[i] = reading->quantities[i].value;
        mupDefineVar(parser, name, &values[i]);
    }
    mupSetExpr(parser, reading->formula);
}

struct error *expression_try(const struct expression_reading *reading, muParserHandle_t parser,
                             double *value)
{
    int count = 0;
    const double *values = mupEvalMulti(parser, &count);
    if (mupError(parser) || !values)
        return syntax_error(reading, parser);
    if (count != 1)
        return error_new(ERROR_INPUT,
                         "there is a comma outside a function (a decimal point is \".\")");
    *value = values[0];
    return NULL;
}

static struct error *evaluate(struct expression_reading *reading, muParserHandle_t parser,
                              struct quantity *result)
{
    double value = NAN;
    expression_give(reading, parser, reading->values);
    TRY(expression_try(reading, parser, &value));
    if (!isfinite(value))
        return error_new(ERROR_INPUT, "the value is not finite");
    TRY(expression_dimension(reading, parser, &result->dimension));
    result->value = value;
    return NULL;
}

/* One number or name and nothing else, as most values of a case are: there is nothing to
 * evaluate. */
static bool is_single(const struct expression_reading *reading)
{
    const char *formula = reading->formula;
    const size_t blanks = strspn(formula, " ");
    return reading->variables == 1 && formula[blanks] == 'v' &&
           strspn(formula + blanks + VARIABLE_NAME - 1, " ") ==
               strlen(formula + blanks + VARIABLE_NAME - 1);
}

struct error *expression_evaluate(const char *text, const struct named_quantities *names,
                                  struct quantity *result)
{
    struct expression_reading *reading;
    TRY(expression_read(text, names, 0, &reading));
    struct error *error = NULL;
    if (is_single(reading) && isfinite(reading->quantities[0].value)) {
        *result = reading->quantities[0];
    } else {
        muParserHandle_t parser = mupCreate(muBASETYPE_FLOAT);
        error = evaluate(reading, parser, result);
        mupRelease(parser);
    }
    free(reading);
    return error;
}
