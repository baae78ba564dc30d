/* Expressions of the position, for fields at the start, and of the time, for what acts from
 * outside: compiled once, evaluated at every particle or step. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/expression_internal.h"
#include "base/memory.h"

/* A variable of the formula that is an argument. */
struct occurrence {
    int variable, argument;
};

struct varying_expression {
    muParserHandle_t parser;
    double *values; /* of the formula's variables */
    int occurrences;
    struct occurrence *occurrence;
    char *text;
};

/* A number with its unit, in parentheses where it could run into its neighbours and is not
 * ENCLOSED. */
static int write_quantity(struct quantity quantity, bool enclosed, char *text, size_t size)
{
    char number[32], unit[DIMENSION_TEXT];
    double value = fabs(quantity.value);
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(number, sizeof number, "%.*g", digits, value);
        if (strtod(number, NULL) == value)
            break;
    }
    dimension_text(quantity.dimension, unit);
    bool negative = signbit(quantity.value), bare = !unit[0];
    const char *open = enclosed || (bare && !negative) ? "" : "(", *close = open[0] ? ")" : "";
    if (bare || !negative)
        return snprintf(text, size, "%s%s%s%s%s%s", open, negative ? "-" : "", number,
                        bare ? "" : " ", unit, close);
    return snprintf(text, size, "%s-(%s %s)%s", open, number, unit, close);
}

/* The formula with its variables written out, the same text from itself. Only variables have a `v`
 * in their names, a blank before it. */
static struct error *write_out(const struct expression_reading *reading, char **text)
{
    enum { QUANTITY_TEXT = 40 + DIMENSION_TEXT };
    size_t size = (size_t)reading->length + (size_t)reading->variables * QUANTITY_TEXT + 1;
    char *out = *text = malloc(size);
    if (!out)
        return out_of_memory();
    int variable = 0;
    for (const char *in = reading->formula; *in; in++) {
        if (in[0] != ' ' || in[1] != 'v') {
            *out++ = *in;
            continue;
        }
        in += VARIABLE_NAME - 1;
        size_t used = (size_t)(out - *text);
        bool enclosed = used > 0 && out[-1] == '(' && in[1] == ')';
        if (reading->argument[variable])
            *out++ = "xyzt"[reading->argument[variable] - 1];
        else
            out += write_quantity(reading->quantities[variable], enclosed, out, size - used);
        variable++;
    }
    *out = '\0';
    return out - *text > LONGEST_EXPRESSION
               ? error_new(ERROR_INPUT,
                           "an expression is longer than %d bytes, its names written out",
                           LONGEST_EXPRESSION)
               : NULL;
}

/* The formula of READING, which has COUNT arguments, for many evaluations. */
static struct error *keep(const struct expression_reading *reading, int count,
                          struct varying_expression *expression)
{
    expression->values = calloc((size_t)reading->variables + 1, sizeof *expression->values);
    expression->occurrence = calloc((size_t)count + 1, sizeof *expression->occurrence);
    if (!expression->values || !expression->occurrence)
        return out_of_memory();
    for (int i = 0; i < reading->variables; i++)
        if (reading->argument[i])
            expression->occurrence[expression->occurrences++] =
                (struct occurrence){i, reading->argument[i] - 1};
    expression_give(reading, expression->parser, expression->values);
    return write_out(reading, &expression->text);
}

/* Of a text that names arguments: its dimension, with a parser of its own, and what is kept. */
static struct error *compile(struct expression_reading *reading, int count,
                             struct dimension *dimension, struct varying_expression *expression)
{
    double value;
    muParserHandle_t parser = mupCreate(muBASETYPE_FLOAT);
    expression_give(reading, parser, reading->values);
    struct error *error = expression_try(reading, parser, &value);
    if (!error)
        error = expression_dimension(reading, parser, dimension);
    mupRelease(parser);
    return error ? error : keep(reading, count, expression);
}

struct error *varying_expression_compile(const char *text, unsigned arguments,
                                         const struct named_quantities *names,
                                         struct quantity *result,
                                         struct varying_expression **expression)
{
    *expression = NULL;
    struct expression_reading *reading;
    TRY(expression_read(text, names, arguments, &reading));
    int named = 0;
    for (int i = 0; i < reading->variables; i++)
        named += reading->argument[i] != 0;
    if (named == 0) {
        free(reading);
        return expression_evaluate(text, names, result);
    }
    struct varying_expression *made = memory_allocate(sizeof *made);
    struct error *error = made ? NULL : out_of_memory();
    if (made) {
        made->parser = mupCreate(muBASETYPE_FLOAT);
        error = compile(reading, named, &result->dimension, made);
    }
    free(reading);
    if (error) {
        varying_expression_free(made);
        return error;
    }
    result->value = NAN;
    *expression = made;
    return NULL;
}

double varying_expression_at(const struct varying_expression *expression, struct vec3 place,
                             double time)
{
    const double at[] = {place.x, place.y, place.z, time};
    for (int i = 0; i < expression->occurrences; i++)
        expression->values[expression->occurrence[i].variable] =
            at[expression->occurrence[i].argument];
    return mupEval(expression->parser);
}

bool varying_expression_uses(const struct varying_expression *expression, int index)
{
    for (int i = 0; i < expression->occurrences; i++)
        if (expression->occurrence[i].argument == index)
            return true;
    return false;
}

const char *varying_expression_text(const struct varying_expression *expression)
{
    return expression->text;
}

void varying_expression_free(struct varying_expression *expression)
{
    if (!expression)
        return;
    mupRelease(expression->parser);
    free(expression->values);
    free(expression->occurrence);
    free(expression->text);
    free(expression);
}
