/* Units: every symbol against UDUNITS-2, the grammar, its refusals word by word, and nearest
 * names. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <udunits2.h>

#include "base/units.h"

static struct unit parsed(const char *text)
{
    struct unit unit;
    struct error *error = unit_parse(text, &unit);
    if (error)
        fail_msg("%s: %s", text, error_message(error, 0));
    return unit;
}

static void assert_unit(const char *text, double scale, double offset, struct dimension dimension)
{
    struct unit unit = parsed(text);
    if (unit.scale != scale || unit.offset != offset || !dimension_equal(unit.dimension, dimension))
        fail_msg("%s: %.17g %.17g m^%d kg^%d s^%d K^%d", text, unit.scale, unit.offset,
                 unit.dimension.length, unit.dimension.mass, unit.dimension.time,
                 unit.dimension.temperature);
}

static void assert_refused(const char *text, const char *message)
{
    struct unit unit;
    struct error *error = unit_parse(text, &unit);
    if (!error)
        fail_msg("\"%s\" was accepted", text);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_string_equal(error_message(error, 0), message);
    error_free(error);
}

/* Our reading of TEXT and UDUNITS-2's agree in dimension, scale and offset. */
static void assert_agrees(ut_system *system, const char *text)
{
    struct unit unit = parsed(text);
    char si[64];
    snprintf(si, sizeof si, "m^%d kg^%d s^%d K^%d", unit.dimension.length, unit.dimension.mass,
             unit.dimension.time, unit.dimension.temperature);
    ut_unit *theirs = ut_parse(system, text, UT_ASCII), *base = ut_parse(system, si, UT_ASCII);
    if (!theirs || !base)
        fail_msg("UDUNITS-2 does not know %s", theirs ? si : text);
    if (!ut_are_convertible(theirs, base))
        fail_msg("%s is not %s", text, si);
    cv_converter *converter = ut_get_converter(theirs, base);
    for (double number = -3.0; number < 1e6; number = 7.0 * fabs(number) + 0.1) {
        double expected = cv_convert_double(converter, number);
        double ours = number * unit.scale + unit.offset;
        if (fabs(ours - expected) > 4e-16 * fmax(fabs(expected), unit.offset))
            fail_msg("%g %s: %.17g, not %.17g", number, text, ours, expected);
    }
    cv_free(converter);
    ut_free(theirs);
    ut_free(base);
}

static void every_symbol_and_every_quotient_agrees_with_udunits(void **state)
{
    (void)state;
    ut_set_error_message_handler(ut_ignore);
    ut_system *system = ut_read_xml(NULL);
    assert_non_null(system);
    ut_unit *degree = ut_parse(system, "degree", UT_ASCII);
    ut_map_symbol_to_unit("deg", UT_ASCII, degree); /* the one symbol that it does not know */
    ut_free(degree);
    int count = 0;
    for (; unit_symbol(count); count++)
        assert_agrees(system, unit_symbol(count));
    assert_true(count > 35);
    assert_null(unit_symbol(-1));
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j += 3) {
            char text[64];
            snprintf(text, sizeof text, "%s^2/%s", unit_symbol(i), unit_symbol(j));
            if (!strchr(text, '%') && !strstr(text, "degC"))
                assert_agrees(system, text);
        }
    ut_free_system(system);
}

static void symbols_are_all_different(void **state)
{
    (void)state;
    for (int i = 0; unit_symbol(i); i++)
        for (int j = 0; j < i; j++)
            assert_string_not_equal(unit_symbol(i), unit_symbol(j));
}

static void compound_units_are_exact(void **state)
{
    (void)state;
    assert_unit("", 1.0, 0.0, (struct dimension){0});
    assert_unit("m/s", 1.0, 0.0, (struct dimension){1, 0, -1, 0});
    assert_unit("g/cm^3", 1000.0, 0.0, (struct dimension){-3, 1, 0, 0});
    assert_unit("mm^3", 1e-9, 0.0, (struct dimension){3, 0, 0, 0});
    assert_unit("GPa/(g/cm^3)", 1e6, 0.0, (struct dimension){2, 0, -2, 0});
}

static void blanks_powers_and_parentheses_are_read(void **state)
{
    (void)state;
    assert_unit(" kJ / (kg*K) ", 1000.0, 0.0, (struct dimension){2, 0, -2, -1});
    assert_unit("J/kg/K", 1.0, 0.0, (struct dimension){2, 0, -2, -1});
    assert_unit("1/s", 1.0, 0.0, (struct dimension){0, 0, -1, 0});
    assert_unit("ms^-2", 1e6, 0.0, (struct dimension){0, 0, -2, 0});
    assert_unit("(m/s)^2", 1.0, 0.0, (struct dimension){2, 0, -2, 0});
    assert_unit("km/(1/(s))", 1e3, 0.0, (struct dimension){1, 0, 1, 0});
    assert_unit("m^+2", 1.0, 0.0, (struct dimension){2, 0, 0, 0});
    assert_unit("m^0", 1.0, 0.0, (struct dimension){0});
}

static void both_micro_signs_are_a_micro(void **state)
{
    (void)state;
    assert_unit("\xC2\xB5s", 1e-6, 0.0, (struct dimension){0, 0, 1, 0});
    assert_unit("\xCE\xBCm", 1e-6, 0.0, (struct dimension){1, 0, 0, 0});
    assert_refused("\xC2\xB5", "unknown unit \"\xC2\xB5\" (bolide help units lists them)");
    assert_refused("\xC2\xB5Pa", "unknown unit \"\xC2\xB5Pa\" (bolide help units lists them)");
}

static void percent_and_angles_have_no_dimension(void **state)
{
    (void)state;
    assert_unit("%", 0.01, 0.0, (struct dimension){0});
    assert_unit("%/K", 0.01, 0.0, (struct dimension){0, 0, 0, -1});
    assert_unit("deg", acos(-1.0) / 180.0, 0.0, (struct dimension){0});
}

static void only_a_bare_degree_celsius_has_an_offset(void **state)
{
    (void)state;
    assert_unit("degC", 1.0, 273.15, (struct dimension){0, 0, 0, 1});
    assert_unit(" degC ", 1.0, 273.15, (struct dimension){0, 0, 0, 1});
    assert_unit("J/(kg*degC)", 1.0, 0.0, (struct dimension){2, 0, -2, -1});
    assert_unit("1/degC", 1.0, 0.0, (struct dimension){0, 0, 0, -1});
    assert_unit("degC^2", 1.0, 0.0, (struct dimension){0, 0, 0, 2});
}

static void slips_are_refused_with_the_nearest_symbol(void **state)
{
    (void)state;
    assert_refused("Mpa", "unknown unit \"Mpa\" (did you mean \"MPa\"?)");
    assert_refused("Kg/m^3", "unknown unit \"Kg\" (did you mean \"kg\"?)");
    assert_refused("kg/m3", "unknown unit \"m3\" (did you mean \"m^3\"?)");
    assert_refused("kph", "unknown unit \"kph\" (bolide help units lists them)");
    assert_refused("furlong", "unknown unit \"furlong\" (bolide help units lists them)");
    assert_refused("x", "unknown unit \"x\" (bolide help units lists them)");
}

static void what_is_no_unit_is_refused(void **state)
{
    (void)state;
    assert_refused("kg/", "unit \"kg/\" is incomplete");
    assert_refused("kg/(m*s", "unit \"kg/(m*s\" is incomplete");
    assert_refused("kg m", "unit \"kg m\" cannot be read at \"m\"");
    assert_refused("m^s", "unit \"m^s\" cannot be read at \"s\"");
    assert_refused("m^", "unit \"m^\" is incomplete");
    assert_refused("m)", "unit \"m)\" cannot be read at \")\"");
    assert_refused("2 m", "unit \"2 m\" cannot be read at \"2 m\"");
    assert_refused("10", "unit \"10\" cannot be read at \"10\"");
    assert_refused("m^2.5", "unit \"m^2.5\" cannot be read at \".5\"");
    assert_refused("m^100", "unit \"m^100\" has too high a power");
    assert_refused("m^99999999999", "unit \"m^99999999999\" has too high a power");
    assert_refused("(m^50)^-2", "unit \"(m^50)^-2\" has too high a power");
    assert_refused("GPa^40", "unit \"GPa^40\" has too high a power");
    char text[202];
    memset(text, '(', 201);
    text[201] = '\0';
    assert_refused(text, "a unit is longer than 200 bytes");
}

static void dimensions_have_friendly_spellings(void **state)
{
    (void)state;
    const char *const texts[] = {
        "",    "m",      "kg",  "s",    "K",      "m/s",   "kg/m^3",   "Pa",      "J/kg",
        "J",   "N",      "W",   "Pa*s", "1/s",    "m/s^2", "J/(kg*K)", "W/(m*K)", "kg/(m^2*s)",
        "m^2", "m^3/kg", "1/K", "1/Pa", "kg*m/s", "m^2/s", "N/m",      "kg*m^2",  "1/(m*s)",
    };
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        char buffer[DIMENSION_TEXT];
        assert_string_equal(dimension_text(parsed(texts[i]).dimension, buffer), texts[i]);
    }
}

static void the_spelling_of_a_dimension_reads_back_as_it(void **state)
{
    (void)state;
    for (int code = 0; code < 9 * 9 * 9 * 9; code++) {
        struct dimension dimension = {(int8_t)(code % 9 - 4), (int8_t)(code / 9 % 9 - 4),
                                      (int8_t)(code / 81 % 9 - 4), (int8_t)(code / 729 - 4)};
        char buffer[DIMENSION_TEXT];
        assert_unit(dimension_text(dimension, buffer), 1.0, 0.0, dimension);
    }
    char buffer[DIMENSION_TEXT];
    assert_string_equal(dimension_text((struct dimension){-128, -128, -128, -128}, buffer),
                        "1/(kg^128*m^128*s^128*K^128)");
}

static void a_near_name_is_found_and_a_far_one_is_not(void **state)
{
    (void)state;
    const char *const names[] = {"density", "velocity", "yield", "box", "plate_thickness"};
    int count = (int)COUNT_OF(names);
    assert_string_equal(nearest_name("densty", names, count), "density");
    assert_string_equal(nearest_name("velcoity", names, count), "velocity");
    assert_string_equal(nearest_name("Yield", names, count), "yield");
    assert_string_equal(nearest_name("bxo", names, count), "box");
    assert_string_equal(nearest_name("platethicknes", names, count), "plate_thickness");
    assert_string_equal(nearest_name("box", names, count), "box");
    assert_null(nearest_name("bx1", names, count));
    assert_null(nearest_name("pressure", names, count));
    assert_null(nearest_name("", names, count));
    assert_null(nearest_name("x", names, count));
    assert_null(nearest_name("density", NULL, 0));
    char lengthy[200];
    memset(lengthy, 'a', sizeof lengthy - 1);
    lengthy[sizeof lengthy - 1] = '\0';
    const char *const lengthy_names[] = {lengthy};
    assert_null(nearest_name(lengthy, names, count));
    assert_null(nearest_name("aaa", lengthy_names, 1));
}

static void the_right_letters_in_the_wrong_case_are_nearest(void **state)
{
    (void)state;
    const char *const names[] = {"kPa", "Pa", "MPa", "GPa"};
    assert_string_equal(nearest_name("mPa", names, 4), "MPa");
    assert_string_equal(nearest_name("gpa", names, 4), "GPa");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_symbol_and_every_quotient_agrees_with_udunits),
        cmocka_unit_test(symbols_are_all_different),
        cmocka_unit_test(compound_units_are_exact),
        cmocka_unit_test(blanks_powers_and_parentheses_are_read),
        cmocka_unit_test(both_micro_signs_are_a_micro),
        cmocka_unit_test(percent_and_angles_have_no_dimension),
        cmocka_unit_test(only_a_bare_degree_celsius_has_an_offset),
        cmocka_unit_test(slips_are_refused_with_the_nearest_symbol),
        cmocka_unit_test(what_is_no_unit_is_refused),
        cmocka_unit_test(dimensions_have_friendly_spellings),
        cmocka_unit_test(the_spelling_of_a_dimension_reads_back_as_it),
        cmocka_unit_test(a_near_name_is_found_and_a_far_one_is_not),
        cmocka_unit_test(the_right_letters_in_the_wrong_case_are_nearest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
