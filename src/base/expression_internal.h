/* Between the reading of an expression and its evaluation: a formula of variables, one for every
 * number and name of the text. */
#ifndef BOLIDE_EXPRESSION_INTERNAL_H
#define BOLIDE_EXPRESSION_INTERNAL_H

#include <muParserDLL.h>

#include "base/expression.h"

enum { LONGEST_EXPRESSION = 1000, FORMULA_SIZE = 6 * LONGEST_EXPRESSION + 1, VARIABLE_NAME = 5 };

struct expression_reading {
    const char *text, *at;
    const struct named_quantities *names; /* NULL: none */
    unsigned arguments;   /* which may stand in the text, and comparisons with them */
    const char *unit_end; /* of the last literal that had a unit */
    int length, variables;
    char formula[FORMULA_SIZE];
    int origin[FORMULA_SIZE]; /* the byte of `text` that a byte of the formula comes from */
    struct quantity quantities[LONGEST_EXPRESSION];
    int8_t argument[LONGEST_EXPRESSION]; /* 1, 2, 3, 4 where a variable is x, y, z, t */
    double values[LONGEST_EXPRESSION];   /* what muparser sees of them */
};

/* Turns TEXT into a formula of variables; free() frees *READING, which holds nothing else. */
struct error *expression_read(const char *text, const struct named_quantities *names,
                              unsigned arguments, struct expression_reading **reading);

/* The name of variable INDEX in the formula: v000, v001, ... */
void expression_variable(int index, char name[VARIABLE_NAME]);

/* Gives the formula and its variables, which stand in VALUES, to PARSER. */
void expression_give(const struct expression_reading *reading, muParserHandle_t parser,
                     double *values);

/* Evaluates what expression_give gave once: a mistake of syntax is found here. */
struct error *expression_try(const struct expression_reading *reading, muParserHandle_t parser,
                             double *value);

/* The dimension of a formula without arguments, at the first numbers that serve; of one with them,
 * whose pieces may differ, the same at all of many numbers. */
struct error *expression_dimension(struct expression_reading *reading, muParserHandle_t parser,
                                   struct dimension *dimension);

#endif
