/* The difference of two cases as run, key by key, and the classes of the keys. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "case/changes.h"
#include "case/internal.h"
#include "run/catalogue.h"

static const char before[] = "format: 1\n"
                             "title: A plate\n"
                             "resolution: 0.001 m\n"
                             "solver:\n  sph:\n    skin: 0.3\n"
                             "materials:\n  one: {eos: {ideal-gas: {gamma: 1.4}}}\n  two: {}\n"
                             "bodies:\n  plate:\n    material: one\n    box: {from: [0 m]}\n"
                             "run: {until: 1 s}\n"
                             "output: {every: 1 s, maps: {most: {peak: pressure}}}\n"
                             "probes:\n  a: {gauge: {at: [1 m]}, every: 1 s}\n"
                             "checks:\n  c: {mean: {field: pressure}, at_most: 1 Pa}\n";

static struct case_changes compare(const char *from, const char *to)
{
    struct case_changes changes;
    char after[sizeof before + 256];
    const char *place = strstr(before, from);
    assert_non_null(place);
    snprintf(after, sizeof after, "%.*s%s%s", (int)(place - before), before, to,
             place + strlen(from));
    assert_null(case_compare(before, after, case_table, &bolide_catalogue, &changes));
    return changes;
}

static void expect(const char *from, const char *to, const char *key, enum parameter_change class,
                   const char *was, const char *is)
{
    struct case_changes changes = compare(from, to);
    assert_int_equal(changes.count, 1);
    assert_string_equal(changes.item[0].key, key);
    assert_int_equal(changes.item[0].class, class);
    assert_string_equal(changes.item[0].before, was);
    assert_string_equal(changes.item[0].after, is);
    case_changes_free(&changes);
}

static void a_change_has_its_key_and_both_values(void **state)
{
    (void)state;
    expect("until: 1 s", "until: 2 s", "run.until", CHANGE_FREELY, "1 s", "2 s");
    expect("title: A plate\n", "", "title", CHANGE_FREELY, "A plate", "");
    expect("0.001 m", "0.002 m", "resolution", CHANGE_NEVER, "0.001 m", "0.002 m");
    expect("skin: 0.3", "skin: 0.2", "solver.sph.skin", CHANGE_FREELY, "0.3", "0.2");
    expect("[0 m]", "[1 m]", "bodies.plate.box.from", CHANGE_NEVER, "[0 m]", "[1 m]");
    expect("gamma: 1.4", "gamma: 1.3", "materials.one.eos.ideal-gas.gamma", CHANGE_NEVER, "1.4",
           "1.3");
    expect("{ideal-gas: {gamma: 1.4}}", "{other: {}}", "materials.one.eos", CHANGE_NEVER,
           "{ideal-gas: {gamma: 1.4}}", "{other: {}}");
}

static void classes_are_those_of_the_tables(void **state)
{
    (void)state;
    expect("peak: pressure", "peak: density", "output.maps.most.peak", CHANGE_NEVER, "pressure",
           "density");
    expect("every: 1 s, maps", "every: 2 s, maps", "output.every", CHANGE_FREELY, "1 s", "2 s");
    expect("[1 m]}, every: 1 s", "[1 m]}, every: 2 s", "probes.a.every", CHANGE_FREELY, "1 s",
           "2 s");
    expect("at: [1 m]", "at: [2 m]", "probes.a.gauge.at", CHANGE_NEVER, "[1 m]", "[2 m]");
    expect("checks:", "  b: {gauge: {at: [1 m]}}\nchecks:", "probes.b", CHANGE_FREELY, "",
           "{gauge: {at: [1 m]}}");
    expect("at_most: 1 Pa", "at_most: 2 Pa", "checks.c.at_most", CHANGE_FREELY, "1 Pa", "2 Pa");
}

static void an_order_of_bodies_or_materials_is_fixed(void **state)
{
    (void)state;
    struct case_changes changes = compare("  one: {eos: {ideal-gas: {gamma: 1.4}}}\n  two: {}\n",
                                          "  two: {}\n  one: {eos: {ideal-gas: {gamma: 1.4}}}\n");
    assert_int_equal(changes.count, 1);
    assert_string_equal(changes.item[0].key, "materials");
    assert_int_equal(changes.item[0].class, CHANGE_NEVER);
    case_changes_free(&changes);
}

static void what_an_entry_measures_is_known_to_stay(void **state)
{
    (void)state;
    static const char *const limits[] = {"at_most", NULL}, *const none[] = {NULL};
    struct case_changes changes = compare("at_most: 1 Pa", "at_most: 2 Pa");
    assert_int_equal(case_changes_place(&changes, "checks", "c"), 0);
    assert_int_equal(case_changes_place(&changes, "checks", "d"), -1);
    assert_int_equal(case_changes_entries(&changes, "materials"), 2);
    assert_false(case_changes_in(&changes, "checks", "c", limits));
    assert_true(case_changes_in(&changes, "checks", "c", none));
    case_changes_free(&changes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_change_has_its_key_and_both_values),
        cmocka_unit_test(classes_are_those_of_the_tables),
        cmocka_unit_test(an_order_of_bodies_or_materials_is_fixed),
        cmocka_unit_test(what_an_entry_measures_is_known_to_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
