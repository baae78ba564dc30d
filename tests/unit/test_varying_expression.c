/* Expressions of the position and of the time: values, dimensions over all their pieces, and the
 * text that is written. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "base/expression.h"

static const struct named_quantity names[] = {
    {"Omega", {-3000.0, {0, 0, -1, 0}}},
    {"plate", {0.003, {1, 0, 0, 0}}},
    {"p0", {2e9, {-1, 1, -2, 0}}},
    {"n", {-2.0, {0}}},
    {"z", {1.0, {0}}},
};
static const struct named_quantities all = {COUNT_OF(names), names, {0}};

static struct varying_expression *compiled(const char *text, const char *unit_text)
{
    struct varying_expression *expression;
    struct quantity result;
    struct unit unit;
    struct error *error =
        varying_expression_compile(text, ARGUMENT_POSITION, &all, &result, &expression);
    if (error)
        fail_msg("%s: %s", text, error_message(error, 0));
    assert_non_null(expression);
    assert_true(isnan(result.value));
    assert_null(unit_parse(unit_text, &unit));
    assert_true(dimension_equal(result.dimension, unit.dimension));
    return expression;
}

static void assert_at(const char *text, struct vec3 place, double value, const char *unit)
{
    struct varying_expression *expression = compiled(text, unit);
    double found = varying_expression_at(expression, place, 0.0);
    if (found != value)
        fail_msg("%s: %.17g, not %.17g", text, found, value);
    varying_expression_free(expression);
}

static void assert_refused(const char *text, const char *message)
{
    struct varying_expression *expression;
    struct quantity result;
    struct error *error =
        varying_expression_compile(text, ARGUMENT_POSITION, &all, &result, &expression);
    if (!error)
        fail_msg("\"%s\" was accepted", text);
    assert_null(expression);
    if (strcmp(error_message(error, 0), message))
        fail_msg("%s:\n%s\nnot\n%s", text, error_message(error, 0), message);
    error_free(error);
}

static void an_expression_follows_the_position(void **state)
{
    (void)state;
    const struct vec3 place = {2.0, -3.0, 4.0};
    assert_at("x", place, 2.0, "m");
    assert_at("Omega*y", place, 9000.0, "m/s");
    assert_at("-Omega*x", place, 6000.0, "m/s");
    assert_at("sqrt(x^2 + y^2)", place, sqrt(13.0), "m");
    assert_at("p0*x*y/plate^2", place, 2e9 * 2.0 * -3.0 / (0.003 * 0.003), "Pa");
    assert_at("1 km/s*exp(-(x - 2 m)/plate)", place, 1000.0, "m/s");
    struct varying_expression *expression = compiled("x + 1 m", "m");
    assert_true(varying_expression_at(expression, place, 0.0) == 3.0);
    assert_true(varying_expression_at(expression, vec3_make(-1.0, 0.0, 0.0), 0.0) == 0.0);
    assert_true(varying_expression_uses(expression, 0) && !varying_expression_uses(expression, 1));
    varying_expression_free(expression);
}

static void comparisons_make_pieces(void **state)
{
    (void)state;
    static const char steps[] = "300 K + 700 K*(x > 1 m)*(y <= 2 m)";
    assert_at(steps, vec3_make(2.0, 2.0, 0.0), 1000.0, "K");
    assert_at(steps, vec3_make(1.0, 2.0, 0.0), 300.0, "K");
    assert_at(steps, vec3_make(2.0, 2.5, 0.0), 300.0, "K");
    assert_at("(x < plate)*x + (x >= plate)*plate", vec3_make(9.0, 0.0, 0.0), 0.003, "m");
    assert_at("(-plate <= x)*1 m/s", vec3_make(-0.003, 0.0, 0.0), 1.0, "m/s");
}

static void every_piece_has_the_same_dimension(void **state)
{
    (void)state;
    static const char mixed[] =
        "different dimensions are added or compared, or a function such as exp is "
        "taken of a value that has a dimension";
    assert_refused("300 K*(x > 1 m) + 5 Pa*(x <= 1 m)", mixed);
    assert_refused("300 K + 5 Pa*(x > 1 m)*(y > 1 m)", mixed);
    assert_refused("300 K*(x > 1 s)", mixed);
    assert_refused("exp(x)", mixed);
    assert_refused("x + 1 s", mixed);
    assert_refused("sqrt(x)", "the dimension of the value has a fractional power");
}

static void mistakes_are_told_as_in_any_expression(void **state)
{
    (void)state;
    assert_refused("Omega*x + plat", "unknown name \"plat\" (did you mean \"plate\"?)");
    assert_refused("z*1 m", "\"z\" is the position here: call the name of let something else");
    assert_refused("(x > 1 m", "a \")\" is missing");
    assert_refused("x = 1 m", "unexpected \"=\"");
    assert_refused("x, y", "there is a comma outside a function (a decimal point is \".\")");
    assert_refused("2 x", "\"x\" after a number is not a unit: put \"*\" between them");
    struct quantity result;
    struct error *error = expression_evaluate("2*y", NULL, &result);
    assert_string_equal(error_message(error, 0),
                        "unknown name \"y\" (it is a position only in the initial state of a "
                        "body)");
    error_free(error);
}

static void a_text_without_position_is_a_constant(void **state)
{
    (void)state;
    struct varying_expression *expression;
    struct quantity result;
    assert_null(varying_expression_compile("2*plate + 1 mm", ARGUMENT_POSITION, &all, &result,
                                           &expression));
    assert_null(expression);
    struct quantity plain;
    assert_null(expression_evaluate("2*plate + 1 mm", &all, &plain));
    assert_true(result.value == plain.value);
}

/* At 0.25 s, of an expression of the time alone. */
static void assert_then(const char *text, const char *unit_text, double value)
{
    struct varying_expression *expression, *again;
    struct quantity result;
    struct unit unit;
    struct error *error =
        varying_expression_compile(text, ARGUMENT_TIME, &all, &result, &expression);
    if (error)
        fail_msg("%s: %s", text, error_message(error, 0));
    assert_null(unit_parse(unit_text, &unit));
    assert_true(dimension_equal(result.dimension, unit.dimension));
    const char *written = varying_expression_text(expression);
    assert_null(varying_expression_compile(written, ARGUMENT_TIME, NULL, &result, &again));
    const struct vec3 nowhere = {NAN, NAN, NAN};
    assert_true(varying_expression_at(expression, nowhere, 0.25) == value);
    assert_true(varying_expression_at(again, nowhere, 0.25) == value);
    assert_true(varying_expression_uses(again, ARGUMENT_T) && !varying_expression_uses(again, 0));
    varying_expression_free(expression);
    varying_expression_free(again);
}

static void an_expression_follows_the_time(void **state)
{
    (void)state;
    assert_then("10 MPa*exp(-t/1 ms)", "Pa", 1e7 * exp(-0.25 / 0.001));
    assert_then("10 m/s*sin(2*t/1 s)*(t < 1 s)", "m/s", 10.0 * sin(2.0 * 0.25 / 1.0) * 1.0);
    assert_then("p0*(t >= 0.25 s)", "Pa", 2e9);
}

/* Behind a unit it is no tonne. */
static void t_is_the_time(void **state)
{
    (void)state;
    assert_then("8 m/s^2*t", "m/s", 2.0);
    assert_then("8 MPa/t*t^2/(1 s)", "Pa", 2e6);
    static const struct named_quantity own[] = {{"t", {1.0, {0}}}};
    const struct named_quantities time = {1, own, {0}};
    static const char *const texts[] = {"3 t", "2*x", "sin(t)", "t*1 Pa", "4*x + t"};
    static const char *const messages[] = {
        "\"t\" after a number is not a unit: put \"*\" between them",
        "unknown name \"x\" (it is a position only in the initial state of a body)",
        "different dimensions are added or compared, or a function such as exp is taken of a value "
        "that has a dimension",
        "\"t\" is the time here: call the name of let something else",
        "unknown name \"t\" (it is the time only in loads and in the velocity of a driven "
        "body)"};
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        struct varying_expression *expression;
        struct quantity result;
        struct error *error =
            varying_expression_compile(texts[i], i < 4 ? ARGUMENT_TIME : ARGUMENT_POSITION,
                                       i == 3 ? &time : NULL, &result, &expression);
        if (!error)
            fail_msg("\"%s\" was accepted", texts[i]);
        assert_string_equal(error_message(error, 0), messages[i]);
        error_free(error);
    }
}

/* Compiled again without names it is the same text and gives the same bits. */
static void the_written_text_gives_the_same_bits(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "Omega*y",
        "-Omega*x^n*plate^3/(1 m)",
        "300 K + 700 K*(x > 1.1 mm)",
        "-40 degC + 0.1 K*x/plate",
        "(n)*x + (Omega)*1 s*x",
        "sqrt(x^2+ y^2)*pi/3*atan2(y, -x)",
        "p0*(1 - x/(7*plate))",
    };
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        struct varying_expression *expression, *again;
        struct quantity result;
        assert_null(
            varying_expression_compile(texts[i], ARGUMENT_POSITION, &all, &result, &expression));
        const char *written = varying_expression_text(expression);
        struct error *error =
            varying_expression_compile(written, ARGUMENT_POSITION, NULL, &result, &again);
        if (error)
            fail_msg("%s: %s", written, error_message(error, 0));
        assert_string_equal(written, varying_expression_text(again));
        for (int k = 1; k < 20; k++) {
            const struct vec3 place = vec3_make(0.1 * k, -0.37 / k, 0.0);
            assert_true(varying_expression_at(expression, place, 0.0) ==
                        varying_expression_at(again, place, 0.0));
        }
        varying_expression_free(expression);
        varying_expression_free(again);
    }
}

/* No text of the grammar's pieces crashes the compiler, and what it takes it writes so that it
 * takes it again. */
static void random_texts_are_taken_and_written_or_refused(void **state)
{
    (void)state;
    static const char *const operands[] = {"3 mm", "x",      "y",        "-z", "(x", "y)", "plate",
                                           "(n)",  "sqrt(x", "-40 degC", "2",  "n",  "pi", "Omega"};
    static const char *const operators[] = {"*", "+", " - ", "/", "^", " < ", ">=", ")*", ","};
    const struct named_quantities few = {all.count - 1, names, {0}};
    uint32_t seed = 1;
    int taken = 0;
    for (int round = 0; round < 4000; round++) {
        char text[200] = "";
        for (int i = 0; i < 1 + round % 9; i++) {
            seed = seed * 1664525u + 1013904223u;
            strcat(text, i % 2 ? operators[(seed >> 16) % COUNT_OF(operators)]
                               : operands[(seed >> 16) % COUNT_OF(operands)]);
        }
        struct varying_expression *expression, *again;
        struct quantity result;
        struct error *error =
            varying_expression_compile(text, ARGUMENT_POSITION, &few, &result, &expression);
        if (!error && expression) {
            const char *written = varying_expression_text(expression);
            error = varying_expression_compile(written, ARGUMENT_POSITION, NULL, &result, &again);
            if (error)
                fail_msg("%s, written as %s: %s", text, written, error_message(error, 0));
            const struct vec3 place = vec3_make(0.3, -1.7, 2.2);
            double value = varying_expression_at(expression, place, 0.0);
            double same = varying_expression_at(again, place, 0.0);
            assert_true(value == same || (isnan(value) && isnan(same)));
            varying_expression_free(expression);
            varying_expression_free(again);
            taken++;
        }
        error_free(error);
    }
    assert_true(taken > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_expression_follows_the_position),
        cmocka_unit_test(comparisons_make_pieces),
        cmocka_unit_test(every_piece_has_the_same_dimension),
        cmocka_unit_test(mistakes_are_told_as_in_any_expression),
        cmocka_unit_test(a_text_without_position_is_a_constant),
        cmocka_unit_test(an_expression_follows_the_time),
        cmocka_unit_test(t_is_the_time),
        cmocka_unit_test(the_written_text_gives_the_same_bits),
        cmocka_unit_test(random_texts_are_taken_and_written_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
