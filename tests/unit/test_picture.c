/* Plots: units, ticks and colours as numbers; whole plots from usual and extreme input. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <cairo.h>
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "picture/picture.h"
#include "picture/scale.h"

static const char path[] = "picture.png";

/* Reads the picture back; it must be whole, with nothing left beside it. */
static cairo_surface_t *read_picture(void)
{
    struct stat status;
    cairo_surface_t *surface = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    assert_int_not_equal(stat("picture.png.part", &status), 0);
    remove(path);
    return surface;
}

static int count_pixels(cairo_surface_t *surface, struct colour colour)
{
    const uint32_t wanted = (uint32_t)(colour.red * 255.0 + 0.5) << 16 |
                            (uint32_t)(colour.green * 255.0 + 0.5) << 8 |
                            (uint32_t)(colour.blue * 255.0 + 0.5);
    const unsigned char *data = cairo_image_surface_get_data(surface);
    int found = 0;
    for (int row = 0; row < cairo_image_surface_get_height(surface); ++row) {
        const uint32_t *line =
            (const uint32_t *)(const void *)(data +
                                             (size_t)row *
                                                 (size_t)cairo_image_surface_get_stride(surface));
        for (int column = 0; column < cairo_image_surface_get_width(surface); ++column)
            found += (line[column] & 0xffffff) == wanted;
    }
    return found;
}

static void units_come_in_readable_multiples(void **state)
{
    (void)state;
    static const struct {
        double magnitude;
        const char *unit, *name;
        double scale;
    } cases[] = {
        {6.4e9, "Pa", "GPa", 1e9},   {9.0e8, "Pa", "MPa", 1e6},
        {3e-6, "m", "µm", 1e-6},     {1e-3, "m", "mm", 1e-3},
        {0.0, "m", "m", 1.0},        {2700.0, "kg/m^3", "g/cm³", 1e3},
        {850.0, "m/s", "m/s", 1.0},  {1e6, "1/s", "10⁶ 1/s", 1e6},
        {2e-13, "", "10⁻¹⁵", 1e-15}, {300.0, "J/(kg*K)", "J/(kg·K)", 1.0},
    };
    for (size_t i = 0; i < COUNT_OF(cases); ++i) {
        struct multiple multiple = multiple_find(cases[i].magnitude, cases[i].unit);
        assert_string_equal(multiple.name, cases[i].name);
        assert_true(fabs(multiple.scale / cases[i].scale - 1.0) < 1e-12);
    }
    char text[UNIT_TEXT];
    multiple_text(3.1e-6, "s", text, sizeof text);
    assert_string_equal(text, "3.1 µs");
}

static void ticks_stand_at_round_values(void **state)
{
    (void)state;
    struct ticks ticks = ticks_linear((struct range){-0.3e9, 1.01e9}, 1e9, 8);
    static const char *const texts[] = {"−0.2", "0.0", "0.2", "0.4", "0.6", "0.8", "1.0"};
    assert_int_equal(ticks.count, (int)COUNT_OF(texts));
    for (int i = 0; i < ticks.count; ++i)
        assert_string_equal(ticks.text[i], texts[i]);
    assert_true(ticks.at[1] == 0.0 && fabs(ticks.at[6] - 1e9) < 1.0);

    ticks = ticks_logarithmic((struct range){0.5e-6, 2.0}, 10);
    assert_int_equal(ticks.count, 7);
    assert_string_equal(ticks.text[0], "10⁻⁶");
    assert_string_equal(ticks.text[6], "1");
}

static void ticks_never_exceed_what_was_asked(void **state)
{
    (void)state;
    for (int exponent = -30; exponent <= 30; ++exponent) {
        for (int most = 1; most <= 12; ++most) {
            double low = -0.37 * pow(10.0, exponent), high = 1.93 * pow(10.0, exponent);
            struct ticks ticks = ticks_linear((struct range){low, high}, 1.0, most);
            assert_in_range(ticks.count, 1, most + 1);
            for (int i = 0; i < ticks.count; ++i)
                assert_true(ticks.at[i] >= low && ticks.at[i] <= high);
        }
    }
}

static void range_of_both_signs_is_grey_at_zero(void **state)
{
    (void)state;
    struct colour_scale scale = colour_scale_make((struct range){-1e9, 3e9});
    struct colour middle = colour_of(&scale, 0.0);
    assert_true(scale.diverging);
    assert_true(middle.red == middle.green && middle.green == middle.blue);
    scale = colour_scale_make((struct range){-1e8, 3e9});
    assert_false(scale.diverging);
    struct colour low = colour_of(&scale, -1e8), below = colour_of(&scale, -1e30);
    assert_memory_equal(&low, &below, sizeof low);
}

static void plot_of(const struct series *series, int count, bool logarithmic)
{
    struct plot plot = {.title = "Shock tube",
                        .x_name = "x",
                        .x_unit = "m",
                        .y_name = "pressure",
                        .y_unit = "Pa",
                        .count = count,
                        .series = series,
                        .log_x = logarithmic,
                        .log_y = logarithmic};
    assert_null(picture_plot(path, &plot));
}

static void plots_have_their_series_in_colour(void **state)
{
    (void)state;
    double x[50], y[50], exact_x[] = {0.0, 1.0}, exact_y[] = {0.0, 1e9};
    for (int i = 0; i < 50; ++i) {
        x[i] = i / 49.0;
        y[i] = 1e9 * square(x[i]);
    }
    const struct series series[] = {{"exact", 2, exact_x, exact_y, LINE_PLAIN},
                                    {"particles", 50, x, y, LINE_NONE}};
    plot_of(series, 2, false);
    cairo_surface_t *surface = read_picture();
    assert_int_equal(cairo_image_surface_get_width(surface), 1600);
    assert_int_equal(cairo_image_surface_get_height(surface), 1040);
    assert_true(count_pixels(surface, colour_of_category(0)) > 50 * 10);
    assert_true(count_pixels(surface, (struct colour){0.6, 0.6, 0.6}) > 4000);
    cairo_surface_destroy(surface);
}

static void plots_take_any_numbers(void **state)
{
    (void)state;
    const double x[] = {0.0, 1e-9, NAN, 1.0, 5.0, INFINITY}, one[] = {2.0};
    const double y[] = {-1.0, 0.0, 3.0, 1e-30, 1e30, NAN};
    for (enum line_style line = LINE_NONE; line <= LINE_FAINT; ++line) {
        for (int logarithmic = 0; logarithmic < 2; ++logarithmic) {
            const struct series series[] = {{NULL, 6, x, y, line},
                                            {"one", 1, one, one, line},
                                            {"none", 0, NULL, NULL, LINE_PLAIN}};
            plot_of(series, 3, logarithmic);
            cairo_surface_destroy(read_picture());
            plot_of(series + 1, 1, logarithmic);
            cairo_surface_destroy(read_picture());
            plot_of(series + 2, 1, logarithmic);
            cairo_surface_destroy(read_picture());
            plot_of(NULL, 0, logarithmic);
            cairo_surface_destroy(read_picture());
        }
    }
}

static void a_folder_that_is_missing_is_a_system_error(void **state)
{
    (void)state;
    const struct plot plot = {.title = "none"};
    struct error *error = picture_plot("no-such-folder/picture.png", &plot);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_SYSTEM);
    error_free(error);
}

static int enter_folder(void **state)
{
    static char folder[] = "/tmp/bolide-picture-XXXXXX";
    *state = mkdtemp(folder);
    return *state ? chdir(*state) : -1;
}

static int leave_folder(void **state)
{
    cairo_debug_reset_static_data();
    return chdir("/") || rmdir(*state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(units_come_in_readable_multiples),
        cmocka_unit_test(ticks_stand_at_round_values),
        cmocka_unit_test(ticks_never_exceed_what_was_asked),
        cmocka_unit_test(range_of_both_signs_is_grey_at_zero),
        cmocka_unit_test(plots_have_their_series_in_colour),
        cmocka_unit_test(plots_take_any_numbers),
        cmocka_unit_test(a_folder_that_is_missing_is_a_system_error),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
