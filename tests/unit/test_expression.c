/* Expressions: values and dimensions, where a unit ends, and every refusal word by word. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/expression.h"

static const struct named_quantity names[] = {
    {"U0", {500.0, {1, 0, -1, 0}}}, {"plate", {0.003, {1, 0, 0, 0}}},
    {"E", {200e9, {-1, 1, -2, 0}}}, {"rho", {7850.0, {-3, 1, 0, 0}}},
    {"g", {9.81, {1, 0, -2, 0}}},   {"n", {2.0, {0}}},
    {"none", {0.0, {0}}},           {"debt", {-4.0, {1, 0, 0, 0}}},
    {"start", {0.0, {0, 0, 1, 0}}},
};
static const struct named_quantities all = {COUNT_OF(names), names, {0}};

static void assert_value(const char *text, double value, const char *unit_text)
{
    struct quantity quantity;
    struct unit unit;
    struct error *error = expression_evaluate(text, &all, &quantity);
    if (error)
        fail_msg("%s: %s", text, error_message(error, 0));
    assert_null(unit_parse(unit_text, &unit));
    char found[DIMENSION_TEXT];
    if (!dimension_equal(quantity.dimension, unit.dimension))
        fail_msg("%s: the dimension is \"%s\", not \"%s\"", text,
                 dimension_text(quantity.dimension, found), unit_text);
    if (!(fabs(quantity.value - value) <= 1e-15 * fabs(value)))
        fail_msg("%s: %.17g, not %.17g", text, quantity.value, value);
}

static void assert_refused(const char *text, const char *message)
{
    struct quantity quantity;
    struct error *error = expression_evaluate(text, &all, &quantity);
    if (!error)
        fail_msg("\"%s\" was accepted as %g", text, quantity.value);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    if (strcmp(error_message(error, 0), message))
        fail_msg("%s:\n%s\nnot\n%s", text, error_message(error, 0), message);
    error_free(error);
}

static const char mixed[] =
    "different dimensions are added or compared, or a function such as exp is "
    "taken of a value that has a dimension";

static void numbers_with_units_are_read_in_si(void **state)
{
    (void)state;
    assert_value("3", 3.0, "");
    assert_value(" .5 ", 0.5, "");
    assert_value("5.", 5.0, "");
    assert_value("3 m/s", 3.0, "m/s");
    assert_value("3m/s", 3.0, "m/s");
    assert_value("2.5e3 kg/m^3", 2500.0, "kg/m^3");
    assert_value("1E-3 t", 1.0, "kg");
    assert_value("2e+3kPa", 2e6, "Pa");
    assert_value("-50 mm", -0.05, "m");
    assert_value("+50 mm", 0.05, "m");
    assert_value("0.5 %", 0.005, "");
    assert_value("50%*2", 1.0, "");
    assert_value("896 J/(kg*K)", 896.0, "J/(kg*K)");
    assert_value("237 W / (m * K)", 237.0, "W/(m*K)");
    assert_value("5 1/s", 5.0, "1/s");
    assert_value("5e-5 1/K", 5e-5, "1/K");
    assert_value("7 s^-1", 7.0, "1/s");
    assert_value("12 \xC2\xB5s", 12e-6, "s");
}

static void a_prefixed_whole_number_has_the_bits_of_the_plain_one(void **state)
{
    (void)state;
    for (int i = 1; i < 20000; i += 1 + i / 50) {
        struct quantity prefixed, plain;
        char text[32];
        snprintf(text, sizeof text, "%d um", i);
        assert_null(expression_evaluate(text, NULL, &prefixed));
        snprintf(text, sizeof text, "%de-6 m", i);
        assert_null(expression_evaluate(text, NULL, &plain));
        if (prefixed.value != plain.value)
            fail_msg("%s: %.17g", text, prefixed.value);
    }
}

static void a_zero_keeps_its_dimension(void **state)
{
    (void)state;
    assert_value("0 mm", 0.0, "m");
    assert_value("-0 m/s", 0.0, "m/s");
    assert_value("U0 - U0", 0.0, "m/s");
    assert_value("0*plate", 0.0, "m");
    assert_value("none*plate", 0.0, "m");
    assert_value("start", 0.0, "s");
    assert_value("start*U0", 0.0, "m");
    assert_value("max(0 Pa, -3 GPa)", 0.0, "Pa");
    assert_value("sqrt(0 m^2)", 0.0, "m");
    assert_value("sqrt(U0^2 - U0*U0)", 0.0, "m/s");
    assert_value("plate^0", 1.0, "");
    assert_value("0", 0.0, "");
    assert_value("0*0", 0.0, "");
}

static void a_bare_zero_joins_any_sum(void **state)
{
    (void)state;
    assert_value("3 m + 0", 3.0, "m");
    assert_value("max(0, plate)", 0.003, "m");
    assert_value("max(0, debt)", 0.0, "");
}

static void names_and_literals_are_combined(void **state)
{
    (void)state;
    assert_value("U0/2 + 30 m/s", 280.0, "m/s");
    assert_value("2*U0", 1000.0, "m/s");
    assert_value("10*plate", 0.03, "m");
    assert_value("sqrt(2*E/rho)", sqrt(2.0 * 200e9 / 7850.0), "m/s");
    assert_value("plate/U0", 6e-6, "s");
    assert_value("rho*U0^2/2", 7850.0 * 250000.0 / 2.0, "Pa");
    assert_value("plate^n", 0.003 * 0.003, "m^2");
    assert_value("plate^3*rho", 0.003 * 0.003 * 0.003 * 7850.0, "kg");
    assert_value("(8 mm^3)^(1/3)", 0.002, "m");
    assert_value("sqrt(-debt*4 m)", 4.0, "m");
    assert_value("sqrt(25 m^2 - (4 m)^2)", 3.0, "m");
    assert_value("1 nm + 200 nm", 201e-9, "m");
    assert_value("-2^2", -4.0, "");
    assert_value("2^3^2", 512.0, "");
    assert_value("2*-3 m", -6.0, "m");
}

static void functions_are_known(void **state)
{
    (void)state;
    assert_value("sin(30 deg)", sin(acos(-1.0) / 6.0), "");
    assert_value("cos(pi)", -1.0, "");
    assert_value("exp(plate/(3 mm))", exp(1.0), "");
    assert_value("ln(E/(2 Pa))", log(1e11), "");
    assert_value("log10(1000)", 3.0, "");
    assert_value("acos(1 - plate/(6 mm))", acos(0.5), "");
    assert_value("asin(plate/plate)", asin(1.0), "");
    assert_value("atan2(plate, 3 mm)", atan(1.0), "");
    assert_value("min(plate, 1 mm, 1 m)", 0.001, "m");
    assert_value("abs(debt)", 4.0, "m");
    assert_value("sinh(1)+cosh(1)", sinh(1.0) + cosh(1.0), "");
    assert_value("tanh(1)+tan(1)+atan(1)", tanh(1.0) + tan(1.0) + atan(1.0), "");
}

static void a_unit_ends_where_something_else_follows(void **state)
{
    (void)state;
    assert_value("3 m/s*2", 6.0, "m/s");
    assert_value("3 m/2", 1.5, "m");
    assert_value("3 m*plate", 3.0 * 0.003, "m^2");
    assert_value("3 m/U0", 0.006, "s");
    assert_value("3 m/(2*U0)", 0.003, "s");
    assert_value("6 m/(2 s)", 3.0, "m/s");
    assert_value("6 N/(m*s)*n", 12.0, "N/(m*s)");
    assert_refused("6 m/(s*2)", "unknown name \"s\" (a unit needs a number: \"1 s\")");
}

static void a_bare_degree_celsius_is_a_place_on_the_scale(void **state)
{
    (void)state;
    assert_value("20 degC", 293.15, "K");
    assert_value("-40 degC", 233.15, "K");
    assert_value("- 40 degC", 233.15, "K");
    assert_value("0 degC", 273.15, "K");
    assert_value("20 degC + 5 K", 298.15, "K");
    assert_value("max(-10 degC, -20 degC)", 263.15, "K");
    assert_value("30 degC - 20 degC", 10.0, "K");
    assert_value("5 J/degC", 5.0, "J/K");
}

static void a_unit_behind_a_number_wins_over_a_name(void **state)
{
    (void)state;
    assert_value("3 g", 0.003, "kg");
    assert_value("2*g", 19.62, "m/s^2");
    assert_value("(2 kg)*g", 19.62, "N");
    assert_refused("2 kg*g",
                   "in \"kg*g\" the word \"g\" is both a unit and a name: rename it in let, or "
                   "put the quantity before it in parentheses");
    assert_refused("2 J/(g*K)",
                   "in \"J/(g*K)\" the word \"g\" is both a unit and a name: rename it in "
                   "let, or put the quantity before it in parentheses");
    assert_value("2 kg/(g + 1 m/s^2)", 2.0 / 10.81, "kg*s^2/m");
}

static void unknown_units_and_names_are_told_with_the_nearest(void **state)
{
    (void)state;
    assert_refused("300 Mpa", "unknown unit \"Mpa\" (did you mean \"MPa\"?)");
    assert_refused("7850 kg/m3", "unknown unit \"m3\" (did you mean \"m^3\"?)");
    assert_refused("3 furlong", "unknown unit \"furlong\" (bolide help units lists them)");
    assert_refused("3 m/furlong", "unknown unit \"furlong\" (bolide help units lists them)");
    assert_refused("2e", "unknown unit \"e\" (bolide help units lists them)");
    assert_refused("2*plat", "unknown name \"plat\" (did you mean \"plate\"?)");
    assert_refused("3 m*Plate", "unknown name \"Plate\" (did you mean \"plate\"?)");
    assert_refused("squrt(2)", "unknown name \"squrt\" (did you mean \"sqrt\"?)");
    assert_refused("banana", "unknown name \"banana\"");
    assert_refused("2*kg", "unknown name \"kg\" (a unit needs a number: \"1 kg\")");
    assert_refused("2 U0", "\"U0\" after a number is not a unit: put \"*\" between them");
    assert_refused("2 sqrt(2)", "\"sqrt\" after a number is not a unit: put \"*\" between them");
    assert_refused("2pi", "\"pi\" after a number is not a unit: put \"*\" between them");
    assert_refused("sqrt + 1", "the function \"sqrt\" needs a \"(\" after its name");
}

static void different_dimensions_do_not_mix(void **state)
{
    (void)state;
    const char *const texts[] = {
        "3 m + 2 s",
        "0 mm + 3 s",
        "3 m + 0 s",
        "3 m + 1",
        "1 nm + 200 GPa",
        "U0 - plate",
        "max(3 m, 2 s)",
        "min(3 m, 2 s)",
        "min(2 s, 3 m)",
        "max(1, plate)",
        "sin(3 m)",
        "exp(plate)",
        "exp(-plate)",
        "tanh(30*plate)",
        "ln(E)",
        "2^plate",
        "plate^plate",
        "cos(0 m)",
        "atan(1e-9 m)",
        "plate + plate^2",
        "1e-9*plate + rho",
        "plate*(1 + U0)",
        "(3 m + 2 s)/(3 m + 2 s)",
    };
    for (size_t i = 0; i < COUNT_OF(texts); i++)
        assert_refused(texts[i], mixed);
    assert_refused("sqrt(plate)", "the dimension of the value has a fractional power");
    assert_refused("E^0.3", "the dimension of the value has a fractional power");
    assert_value("sqrt(plate)*sqrt(plate)", 0.003, "m");
}

static void a_power_of_a_unit_is_whole(void **state)
{
    (void)state;
    assert_value("3 m^2", 3.0, "m^2");
    assert_value("(3 m)^n", 9.0, "m^2");
    const char message[] =
        "the power of the unit \"m\" is not a whole number: put parentheses around the "
        "quantity to raise it as a whole";
    assert_refused("3 m^n", message);
    assert_refused("3 m^2.5", message);
    assert_refused("3 m^(2)", message);
    assert_refused("3 m^100", "unit \"m^100\" has too high a power");
}

static void values_must_be_finite(void **state)
{
    (void)state;
    assert_refused("1/0", "the value is not finite");
    assert_refused("plate/start", "the value is not finite");
    assert_refused("sqrt(-1)", "the value is not finite");
    assert_refused("ln(0)", "the value is not finite");
    assert_refused("10^400", "the value is not finite");
    assert_refused("1e400", "the number 1e400 is too large");
}

static void slips_of_syntax_are_told_where_they_stand(void **state)
{
    (void)state;
    assert_refused("", "the expression is empty");
    assert_refused("  ", "the expression is empty");
    assert_refused("3 m +", "the expression is incomplete");
    assert_refused("(3 m", "a \")\" is missing");
    assert_refused("max(1, 2", "a \")\" is missing");
    assert_refused("3 m)", "cannot be read at \")\"");
    assert_refused("()", "cannot be read at \")\"");
    assert_refused("3 m 4", "cannot be read at \"4\"");
    assert_refused("1.2.3", "cannot be read at \".3\"");
    assert_refused("U0 U0", "cannot be read at \"U0\"");
    assert_refused("U0(2)", "cannot be read at \"(2)\"");
    assert_refused("2**3", "cannot be read at \"*3\"");
    assert_refused("5 1/2", "cannot be read at \"1/2\"");
    assert_refused("1, 2", "there is a comma outside a function (a decimal point is \".\")");
    assert_refused("(1, 2)", "there is a comma outside a function (a decimal point is \".\")");
    assert_refused("sqrt(1, 2)", "a function has the wrong number of arguments");
    assert_refused("atan2(1)", "a function has the wrong number of arguments");
    assert_refused("max()", "a function has the wrong number of arguments");
    assert_refused("1 < 2", "unexpected \"<\"");
    assert_refused("U0 = 3", "unexpected \"=\"");
    assert_refused("$x", "unexpected \"$\"");
    assert_refused("%", "unexpected \"%\"");
    assert_refused(".", "unexpected \".\"");
    char text[1002];
    memset(text, '(', 1001);
    text[1001] = '\0';
    assert_refused(text, "an expression is longer than 1000 bytes");
    text[1000] = '\0';
    assert_refused(text, "the expression is incomplete");
}

/* No text of the grammar's pieces crashes the reader, and whatever is accepted is finite. */
static void random_texts_are_read_or_refused(void **state)
{
    (void)state;
    const char *const pieces[] = {"3",  " ", "m",  "/", "*",    "^", "-", "(",    ")",   ",",
                                  "U0", "s", "0.", "e", "sqrt", "+", "%", "degC", "max", "1/"};
    uint32_t seed = 1;
    for (int round = 0; round < 3000; round++) {
        char text[200] = "";
        for (int i = 0; i < 3 + round % 12; i++) {
            seed = seed * 1664525u + 1013904223u;
            strcat(text, pieces[(seed >> 16) % COUNT_OF(pieces)]);
        }
        struct quantity quantity = {0};
        struct error *error = expression_evaluate(text, &all, &quantity);
        assert_true(error || isfinite(quantity.value));
        error_free(error);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_with_units_are_read_in_si),
        cmocka_unit_test(a_prefixed_whole_number_has_the_bits_of_the_plain_one),
        cmocka_unit_test(a_zero_keeps_its_dimension),
        cmocka_unit_test(a_bare_zero_joins_any_sum),
        cmocka_unit_test(names_and_literals_are_combined),
        cmocka_unit_test(functions_are_known),
        cmocka_unit_test(a_unit_ends_where_something_else_follows),
        cmocka_unit_test(a_bare_degree_celsius_is_a_place_on_the_scale),
        cmocka_unit_test(a_unit_behind_a_number_wins_over_a_name),
        cmocka_unit_test(unknown_units_and_names_are_told_with_the_nearest),
        cmocka_unit_test(different_dimensions_do_not_mix),
        cmocka_unit_test(a_power_of_a_unit_is_whole),
        cmocka_unit_test(values_must_be_finite),
        cmocka_unit_test(slips_of_syntax_are_told_where_they_stand),
        cmocka_unit_test(random_texts_are_read_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
