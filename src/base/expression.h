/* Expressions of literals with units and named quantities: `2*U0 + 3 m/s`. muparser evaluates; the
 * dimension is found by evaluating again with scaled base units, so that `2 m + 3 s` is an error. */
#ifndef BOLIDE_EXPRESSION_H
#define BOLIDE_EXPRESSION_H

#include "base/units.h"

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

/* Evaluates TEXT with the COUNT names. ERROR_INPUT tells what is wrong: an unknown unit or name (with
 * the nearest), a syntax error, a sum of different dimensions, a value that is not finite. */
struct error *expression_evaluate(const char *text, const struct named_quantity *names, int count,
                                  struct quantity *result);

#endif
