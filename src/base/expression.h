/* Expressions of literals with units and named quantities: `2*U0 + 3 m/s`. muparser evaluates; the
 * dimension is found by evaluating again with scaled base units, so that `2 m + 3 s` is an error. */
#ifndef BOLIDE_EXPRESSION_H
#define BOLIDE_EXPRESSION_H

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

/* Evaluates TEXT with the COUNT names. ERROR_INPUT tells what is wrong: an unknown unit or name (with
 * the nearest), a syntax error, a sum of different dimensions, a value that is not finite. */
struct error *expression_evaluate(const char *text, const struct named_quantity *names, int count,
                                  struct quantity *result);

/* An expression of the position x, y, z of a place: `Omega*y`, `300 K + 700 K*(x > 1 mm)`. */
struct position_expression;

/* Like expression_evaluate for a TEXT that may name the position, three lengths x, y, z, and compare with
 * < > <= >=, which gives 1 or 0. Where it names the position *EXPRESSION holds it and RESULT its dimension
 * with the value NAN; else *EXPRESSION is NULL. A coordinate that is one of NAMES too is an error. */
struct error *position_expression_compile(const char *text, const struct named_quantity *names,
                                          int count, struct quantity *result,
                                          struct position_expression **expression);

/* The value in SI units at PLACE (m), perhaps not finite. Not for two threads at once. */
double position_expression_at(const struct position_expression *expression, struct vec3 place);

/* True when it names the coordinate of AXIS, 0 to 2. */
bool position_expression_uses(const struct position_expression *expression, int axis);

/* Names and units written out in SI: compiled without names this gives the same bits. */
const char *position_expression_text(const struct position_expression *expression);

void position_expression_free(struct position_expression *expression);

#endif
