/* Expressions of literals with units and named quantities: `2*U0 + 3 m/s`. muparser evaluates; the
 * dimension is found by evaluating again with scaled base units, so that `2 m + 3 s` is an
 * error. */
#ifndef BOLIDE_EXPRESSION_H
#define BOLIDE_EXPRESSION_H

#include "base/name_index.h"
#include "base/units.h"
#include "base/vector.h"

/* A value in SI units and its dimension. */
struct quantity {
    double value;
    struct dimension dimension;
};

/* A named quantity that expressions may use (an entry of a case's `let`). */
struct named_quantity {
    const char *name;
    struct quantity quantity;
};

/* Those that an expression may use. INDEX has the place of each; where it is empty, they are looked
 * through. */
struct named_quantities {
    int count;
    const struct named_quantity *at;
    struct name_index index;
};

/* Evaluates TEXT with NAMES (NULL: none). ERROR_INPUT tells what is wrong: an unknown unit or name
 * (with the nearest), a syntax error, a sum of different dimensions, a value that is not finite. */
struct error *expression_evaluate(const char *text, const struct named_quantities *names,
                                  struct quantity *result);

/* An expression of the position x, y, z of a place or of the time t: `Omega*y`, `300 K + 700 K*(x >
 * 1 mm)`, `10 MPa*exp(-t/1 ms)`. */
struct varying_expression;

/* What an expression may name, as a sum: the position, three lengths x, y, z; the time t. */
enum expression_arguments { ARGUMENT_POSITION = 1, ARGUMENT_TIME = 2 };

/* Like expression_evaluate for a TEXT that may name ARGUMENTS, and compare with < > <= >=, which
 * gives 1 or 0. Where it names one *EXPRESSION holds it and RESULT its dimension with the value
 * NAN; else *EXPRESSION is NULL. One of NAMES that is called like an argument is an error where it
 * is used. */
struct error *varying_expression_compile(const char *text, unsigned arguments,
                                         const struct named_quantities *names,
                                         struct quantity *result,
                                         struct varying_expression **expression);

/* The value in SI units at PLACE (m) and TIME (s), perhaps not finite. Not for two threads at
 * once. */
double varying_expression_at(const struct varying_expression *expression, struct vec3 place,
                             double time);

/* True when it names the argument INDEX: 0 to 2 the coordinates, 3 the time. */
enum { ARGUMENT_T = 3 };
bool varying_expression_uses(const struct varying_expression *expression, int index);

/* Names and units written out in SI: compiled without names this gives the same bits. */
const char *varying_expression_text(const struct varying_expression *expression);

void varying_expression_free(struct varying_expression *expression);

#endif
