/* Documents: YAML read against a table that has every kind of parameter, and written again. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/memory.h"
#include "document/document.h"

struct point {
    double x, y;
};
static const struct parameter point_table[] = {
    {.key = "x", .kind = PARAMETER_NUMBER, .offset = offsetof(struct point, x), .unit = "m"},
    {.key = "y",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct point, y),
     .unit = "m",
     .standard = "2 mm"},
    PARAMETER_END,
};
static const struct choice marks[] = {
    {"dot", "nothing but a place", NULL, 0, NULL},
    {"cross", "lines", point_table, sizeof(struct point), NULL},
};
static const struct choice_list lists[] = {{"mark", "marks", marks, COUNT_OF(marks)}, {0}};
static const struct catalogue catalogue = {lists};

static const char *const colours[] = {"red", "green", "blue", NULL};
struct all {
    double speed, ratio;
    struct quantity any;
    int64_t count;
    bool flag;
    char *text;
    int colour;
    struct vector_value place;
    struct vector_list corners;
    struct name_list names;
    struct point point;
    struct one_of mark, inline_mark;
    struct one_of_list marks;
    struct named_map points;
};
#define ENTRY(name, type) \
    .key = #name, .kind = PARAMETER_##type, .offset = offsetof(struct all, name)
static const struct parameter all_table[] = {
    {ENTRY(speed, NUMBER), .unit = "m/s", .standard = "1 km/s", .above = -INFINITY, .below = 1e4},
    {ENTRY(ratio, NUMBER), .standard = OPTIONAL, .above = 0, .below = 1, .closed = true},
    {ENTRY(any, QUANTITY), .standard = OPTIONAL},
    {ENTRY(count, INTEGER), .standard = "7"},
    {ENTRY(flag, FLAG), .standard = "yes"},
    {ENTRY(text, TEXT), .standard = OPTIONAL},
    {ENTRY(colour, CHOICE), .standard = "green", .names = colours},
    {ENTRY(place, VECTOR), .unit = "m", .standard = "[1 mm, 0]"},
    {ENTRY(corners, VECTORS), .unit = "m", .standard = OPTIONAL},
    {ENTRY(names, NAMES), .standard = OPTIONAL},
    {ENTRY(point, TABLE), .standard = OPTIONAL, .table = point_table},
    {ENTRY(mark, ONE_OF), .standard = "dot", .kind_of_thing = "mark"},
    {ENTRY(marks, LIST), .standard = "[dot, {cross: {x: 1 m}}]", .kind_of_thing = "mark"},
    {ENTRY(points, MAP), .standard = OPTIONAL, .table = point_table, .size = sizeof(struct point)},
    {.kind = PARAMETER_ONE_OF,
     .offset = offsetof(struct all, inline_mark),
     .standard = OPTIONAL,
     .kind_of_thing = "mark"},
    PARAMETER_END,
};

/* Reads TEXT with its OVERLAY, NULL: without; all messages, a line each, come in *told. */
static struct document *read_text(const char *text, const char *overlay, struct all *all,
                                  char **told)
{
    struct document *document = NULL;
    memset(all, 0, sizeof *all);
    struct error *error = document_open_text(text, "a.yaml", NULL, 0, overlay, &document);
    if (!error)
        error = document_read(document, all_table, &catalogue, all);
    *told = text_copy("");
    for (int i = 0; error && i < error_count(error); i++) {
        char *longer = text_format("%s%s\n", *told, error_message(error, i));
        free(*told);
        *told = longer;
    }
    error_free(error);
    return document;
}

static void good(const char *text, struct all *all)
{
    char *told;
    document_free(read_text(text, NULL, all, &told));
    assert_string_equal(told, "");
    free(told);
}

static void bad(const char *text, const char *messages)
{
    struct all all;
    char *told;
    document_free(read_text(text, NULL, &all, &told));
    assert_string_equal(told, messages);
    free(told);
}

static void what_is_not_given_stands_on_its_default(void **state)
{
    (void)state;
    struct all all;
    good("point: {x: 3 m}", &all);
    assert_true(all.speed == 1000.0 && isnan(all.ratio) && isnan(all.any.value));
    assert_true(all.count == 7 && all.flag && !all.text && all.colour == 1);
    assert_true(all.place.count == 2 && all.place.at[0] == 1e-3 && all.place.at[1] == 0.0);
    assert_true(all.names.count == 0 && all.points.count == 0 && all.point.y == 2e-3);
    assert_int_equal(all.corners.count, 0);
    assert_int_equal(all.mark.index, 0);
    assert_int_equal(all.inline_mark.index, -1);
    assert_null(all.inline_mark.choice);
    assert_int_equal(all.marks.count, 2);
    assert_true(((struct point *)all.marks.items[1].value)->x == 1.0);
    parameters_release(all_table, &all);
}

static void every_kind_of_value_is_read(void **state)
{
    (void)state;
    struct all all;
    good("let: {v: 2 km/s, half: v/2}\n"
         "speed: \"half + 1 m/s\"\nratio: 50 %\nany: 3 GPa\ncount: 2*4\nflag: no\n"
         "text: 'it''s: \xc3\xbc'\ncolour: blue\nplace: [1 m, 2 cm, -3 mm]\nnames: [a, \"b c\"]\n"
         "corners: [[1 mm, v*(3 us)], [0], [1 m, 2 m, -half*1 s]]\n"
         "point:\n  x: 0\n  y: 1 m\nmark: {cross: 4 m}\nmarks: [{cross: {x: 1 m, y: 5 m}}]\n"
         "points: {near: {x: 1 m}, \"far away\": {x: 1 km}}\ndot:\n",
         &all);
    assert_true(all.speed == 1001.0 && all.ratio == 0.5 && all.any.value == 3e9);
    assert_int_equal(all.any.dimension.length, -1);
    assert_true(all.count == 8 && !all.flag && all.colour == 2);
    assert_string_equal(all.text, "it's: \xc3\xbc");
    assert_true(all.place.count == 3 && all.place.at[2] == -3e-3);
    assert_true(all.names.count == 2 && !strcmp(all.names.names[1], "b c"));
    assert_int_equal(all.corners.count, 3);
    assert_true(all.corners.items[0].count == 2 && all.corners.items[0].at[1] == 2000.0 * 3e-6);
    assert_true(all.corners.items[1].count == 1 && all.corners.items[2].at[2] == -1000.0);
    assert_true(all.point.x == 0.0 && all.point.y == 1.0);
    assert_true(((struct point *)all.mark.value)->x == 4.0 && all.inline_mark.index == 0);
    assert_true(all.points.count == 2 && !strcmp(all.points.names[1], "far away"));
    assert_true(((struct point *)all.points.items)[1].x == 1000.0);
    parameters_release(all_table, &all);
}

static void mistakes_are_told_where_they_stand(void **state)
{
    (void)state;
    bad("speed: [\xc3\xbc]\npoint: {x: 1 m}\n",
        "a.yaml:1:8: speed: expected a velocity (m/s), found a list\n");
    bad("text: \xc3\xbc\npoint: {x: 1 m, \xc3\xbc: 1, y: \"3 s\"}\n",
        "a.yaml:2:17: point: unknown key \"\xc3\xbc\" (known: x, y)\n"
        "a.yaml:2:26: point.y: \"3 s\" is a time (s), expected a length (m)\n");
    bad("point: {x: 1 m}\nmarks:\n  - cross:\n      x: 1 kg\n  - crss\n  - {dot: 3}\n",
        "a.yaml:4:10: marks.1.cross.x: \"1 kg\" is a mass (kg), expected a length (m)\n"
        "a.yaml:5:5: marks.2: unknown mark \"crss\" (did you mean \"cross\"?)\n"
        "a.yaml:6:11: marks.3.dot: expected a map, found \"3\"\n");
    bad("point:\nspeed: 20 km/s\nratio: 101 %\n",
        "a.yaml:1:1: point: \"x\" is missing\n"
        "a.yaml:2:8: speed: \"20 km/s\" is out of range: it must be less than 10000 m/s\n"
        "a.yaml:3:8: ratio: \"101 %\" is out of range: it must be 0 to 1\n");
    bad("point: {x: 1 m}\npoints: {a: 3, \"\": {x: 1 m}}\n",
        "a.yaml:2:13: points.a: expected a map, found \"3\"\n"
        "a.yaml:2:16: points: a name cannot be empty\n");
    bad("point: {x: 1 m}\ncorners: [[1 m], 2 m, [1 m, 2 kg], []]\n",
        "a.yaml:2:18: corners.2: expected a list of 1 to 3 values, found \"2 m\"\n"
        "a.yaml:2:29: corners.3.2: \"2 kg\" is a mass (kg), expected a length (m)\n"
        "a.yaml:2:36: corners.4: expected a list of 1 to 3 values, found a list\n");
    bad("point: {x: 1 m}\ncorners: 3 m\n",
        "a.yaml:2:10: corners: expected a list of lists, found \"3 m\"\n");
}

static void an_overlay_lies_over_the_document_when_wanted(void **state)
{
    (void)state;
    static const char text[] = "point: {x: 1 m, y: 2 m}\nnames: [a, b]\n"
                               "short: {point: {y: 3 m}, names: c, count: 5}\n"
                               "long: {point: {y: 4 m}}\n";
    static const char *const overlays[] = {NULL, "short", "long"};
    for (int i = 0; i < 3; i++) {
        struct all all;
        char *told;
        document_free(read_text(text, overlays[i], &all, &told));
        assert_string_equal(told, "");
        free(told);
        assert_true(all.point.x == 1.0 && all.point.y == 2.0 + i);
        assert_int_equal(all.names.count, i == 1 ? 1 : 2);
        assert_int_equal(all.count, i == 1 ? 5 : 7);
        parameters_release(all_table, &all);
    }
}

static void a_setting_without_a_value_removes_its_key(void **state)
{
    (void)state;
    static const struct {
        const char *setting, *message;
    } settings[] = {
        {"count=", NULL},
        {"points.a.b= ", NULL},
        {"point.y=", NULL},
        {"point.x=", "a.yaml:2:1: point: \"x\" is missing"},
        {"colour=", "--set colour=: colour: there is no \"colour\" to remove; a setting is "
                    "path.to.key=value, and one without a value removes the key"},
        {"cuont=", "--set cuont=: cuont: there is no \"cuont\" (did you mean \"count\"?)"},
        {"marks.1=",
         "--set marks.1=: marks.1: an item of a list cannot be removed; set the whole list"},
    };
    for (size_t i = 0; i < COUNT_OF(settings); i++) {
        struct all all = {0};
        struct document *document = NULL;
        struct error *error =
            document_open_text("count: 3\npoint: {x: 1 m, y: 3 m}\nmarks: [dot]\n"
                               "points: {a.b: {x: 1 m}, c: {x: 2 m}}\n",
                               "a.yaml", &settings[i].setting, 1, NULL, &document);
        if (!error)
            error = document_read(document, all_table, &catalogue, &all);
        if (settings[i].message) {
            assert_non_null(error);
            assert_string_equal(error_message(error, 0), settings[i].message);
        } else {
            assert_null(error);
            assert_int_equal(all.count, i == 0 ? 7 : 3);
            assert_int_equal(all.points.count, i == 1 ? 1 : 2);
            assert_true(all.point.y == (i == 2 ? 2e-3 : 3.0));
            parameters_release(all_table, &all);
        }
        error_free(error);
        document_free(document);
    }
}

static void an_error_points_to_the_nearest_that_stands_in_the_file(void **state)
{
    (void)state;
    static const struct {
        const char *path, *message;
        bool has;
    } cases[] = {
        {"point.x", "a.yaml:2:6: point.x: no", true},
        {"point.z", "a.yaml:1:1: point.z: no", false},
        {"points.a.b.x", "a.yaml:5:12: points.a.b.x: no", true},
        {"marks.2.cross", "a.yaml:3:22: marks.2.cross: no", true},
        {"marks.3", "a.yaml:3:8: marks.3: no", false},
        {"elsewhere", "a.yaml:1:1: elsewhere: no", false},
    };
    struct all all;
    char *told;
    struct document *document = read_text("point:\n  x: 1 m\nmarks: [dot, {cross: 2 m}]\n"
                                          "points:\n  a.b: {x: 1 m}\n",
                                          NULL, &all, &told);
    assert_string_equal(told, "");
    free(told);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        struct error *error = document_error(document, cases[i].path, "%s", "no");
        assert_int_equal(document_has(document, cases[i].path), cases[i].has);
        assert_string_equal(error_message(error, 0), cases[i].message);
        error_free(error);
    }
    parameters_release(all_table, &all);
    document_free(document);
}

/* Writes ALL and reads it back. */
static void write_and_read(const struct all *all, struct all *again)
{
    char *text;
    size_t length;
    FILE *file = open_memstream(&text, &length);
    assert_non_null(file);
    assert_null(document_write(file, all_table, all));
    fclose(file);
    good(text, again);
    free(text);
}

static void numbers_read_back_to_the_same_bits(void **state)
{
    (void)state;
    uint64_t random = 88172645463325252u;
    for (int i = 0; i < 2000; i++) {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        struct all all, again;
        good("point: {x: 1 m}\ncorners: [[1 m], [2 m, 3 m]]", &all);
        all.point.x = (double)(int64_t)random * 0x1p-63;
        all.point.y = ldexp((double)(int64_t)(random * 2654435761u), (int)(random % 200) - 100);
        all.place.at[1] = 1.0 / all.point.x;
        all.corners.items[1].at[1] = all.place.at[1] / 3.0;
        all.any = (struct quantity){exp(all.point.x), {2, 1, -3, -1}};
        write_and_read(&all, &again);
        assert_memory_equal(&all.point, &again.point, sizeof all.point);
        assert_memory_equal(&all.place, &again.place, sizeof all.place);
        assert_int_equal(again.corners.count, 2);
        assert_memory_equal(all.corners.items, again.corners.items, 2 * sizeof *all.corners.items);
        assert_true(all.any.value == again.any.value);
        assert_true(dimension_equal(all.any.dimension, again.any.dimension));
        parameters_release(all_table, &all);
        parameters_release(all_table, &again);
    }
}

static void any_text_reads_back_as_it_was(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "plain",    "two words", "- dash",   "a: b",  "a #b", "null", "~",   "'",   "\"",
        "\\",       "a\nb\t",    " blanks ", "[a, b", "{",    "%x",   "@x",  "`",   "*a",
        "&a",       "!tag",      "? x",      "|",     ">",    "...",  "---", "1e5", "yes",
        "\xc3\xa4", "a,b",       "",         "x-",    "-",    "a/b",  "=",   "<<",
    };
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        struct all all, again;
        good("point: {x: 1 m}\nnames: [a]\npoints: {b: {x: 1 m}}", &all);
        free(all.names.names[0]);
        all.names.names[0] = text_copy(texts[i]);
        all.text = text_copy(texts[i]);
        free(all.points.names[0]);
        all.points.names[0] = text_copy(texts[i][0] && !strchr(texts[i], '\n') ? texts[i] : "name");
        write_and_read(&all, &again);
        assert_string_equal(all.text, again.text);
        assert_string_equal(all.names.names[0], again.names.names[0]);
        assert_string_equal(all.points.names[0], again.points.names[0]);
        parameters_release(all_table, &all);
        parameters_release(all_table, &again);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_not_given_stands_on_its_default),
        cmocka_unit_test(every_kind_of_value_is_read),
        cmocka_unit_test(mistakes_are_told_where_they_stand),
        cmocka_unit_test(an_overlay_lies_over_the_document_when_wanted),
        cmocka_unit_test(a_setting_without_a_value_removes_its_key),
        cmocka_unit_test(an_error_points_to_the_nearest_that_stands_in_the_file),
        cmocka_unit_test(numbers_read_back_to_the_same_bits),
        cmocka_unit_test(any_text_reads_back_as_it_was),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
