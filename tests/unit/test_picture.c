/* Pictures: units, ticks and colours as numbers; whole pictures from usual and extreme input. */
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
#include "populations.h"

static const char path[] = "picture.png";

/* A lattice of NX x NY (x NZ) particles of spacing SPACING, with a pressure that grows along x. */
static struct simulation *lattice(int dimension, int nx, int ny, int nz, double spacing)
{
    static const struct ranks alone = {0, 1, false};
    struct simulation *simulation = calloc(1, sizeof *simulation);
    int32_t count = nx * ny * nz, first;
    simulation->ranks = &alone;
    problem_of(simulation)->dimension = dimension;
    simulation->time = 3.1e-6;
    assert_null(give_particles(simulation, 4.0 * spacing, NULL, 0));
    struct particles *p = particles_of(simulation);
    assert_null(particles_append(p, count, &first));
    p->count = count;
    for (int32_t i = 0; i < count; ++i) {
        const int site[3] = {i % nx, i / nx % ny, i / nx / ny};
        for (int axis = 0; axis < dimension; ++axis)
            p->position[i][axis] = spacing * (site[axis] + 0.5);
        p->density[i] = 1000.0;
        p->mass[i] = 1000.0 * pow(spacing, dimension);
        p->pressure[i] = 1e9 * (site[0] + 1);
        p->body[i] = (uint16_t)(2 * site[0] / nx);
        p->id[i] = (uint64_t)i;
    }
    return simulation;
}

static void drop(struct simulation *simulation)
{
    end_simulation(simulation);
    free(simulation);
}

static struct error *draw_in(const struct simulation *simulation, const char *field, double low,
                             double high)
{
    const struct population population = simulation_population(simulation);
    return picture_particles(path, simulation, &population, field, low, high);
}

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

/* Draws FIELD and expects a picture of sane size. */
static void assert_draws(const struct simulation *simulation, const char *field, double low,
                         double high)
{
    assert_null(draw_in(simulation, field, low, high));
    cairo_surface_t *surface = read_picture();
    int width = cairo_image_surface_get_width(surface);
    int height = cairo_image_surface_get_height(surface);
    assert_true(width >= 800 && width <= 2400);
    assert_true(height >= 200 && height <= 2200);
    cairo_surface_destroy(surface);
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

static void particles_are_painted_in_the_colours_of_their_values(void **state)
{
    (void)state;
    struct simulation *simulation = lattice(2, 4, 4, 1, 1e-3);
    assert_null(draw_in(simulation, "pressure", NAN, NAN));
    cairo_surface_t *surface = read_picture();
    struct colour_scale scale = colour_scale_make((struct range){1e9, 4e9});
    int width = cairo_image_surface_get_width(surface);
    assert_int_equal(width, 1600);
    /* Four discs of a quarter of the picture each have each colour. */
    for (int i = 1; i <= 4; ++i)
        assert_true(count_pixels(surface, colour_of(&scale, i * 1e9)) > width * width / 10);
    cairo_surface_destroy(surface);
    drop(simulation);
}

static void bodies_have_a_colour_each(void **state)
{
    (void)state;
    struct simulation *simulation = lattice(2, 40, 4, 1, 1e-3);
    static char *names[] = {"flyer", "target"};
    struct simulation_case input = {.title = "Plate \xff impact",
                                    .bodies = {.count = 2, .names = names}};
    problem_of(simulation)->input = &input;
    assert_null(draw_in(simulation, "body", NAN, NAN));
    cairo_surface_t *surface = read_picture();
    assert_true(count_pixels(surface, colour_of_category(0)) > 10000);
    assert_true(count_pixels(surface, colour_of_category(1)) > 10000);
    cairo_surface_destroy(surface);
    assert_draws(simulation, "material", NAN, NAN);
    drop(simulation);
}

static uint32_t pixel(cairo_surface_t *surface, int column, int row)
{
    const unsigned char *data = cairo_image_surface_get_data(surface);
    uint32_t value;
    memcpy(&value, data + row * cairo_image_surface_get_stride(surface) + 4 * column, sizeof value);
    return value & 0xffffff;
}

/* White pixels between the material in the middle of the picture and the frame below it. */
static int gap_below(cairo_surface_t *surface)
{
    int column = cairo_image_surface_get_width(surface) / 2, white = 0;
    int row = cairo_image_surface_get_height(surface) / 2;
    while (pixel(surface, column, row) != 0xffffff &&
           row < cairo_image_surface_get_height(surface) - 1)
        row++;
    while (pixel(surface, column, row) == 0xffffff && white < 20)
        white++, row++;
    return white;
}

static void the_frame_stands_where_a_wall_bounds_the_particles(void **state)
{
    (void)state;
    struct simulation *simulation = lattice(2, 40, 20, 1, 1e-3);
    struct face(*face)[2] = problem_of(simulation)->place.face;
    for (int axis = 0; axis < 3; axis++)
        face[axis][0].kind = face[axis][1].kind = -1;
    assert_null(draw_in(simulation, "pressure", NAN, NAN));
    cairo_surface_t *surface = read_picture();
    assert_in_range(gap_below(surface), 4, 12);
    cairo_surface_destroy(surface);
    face[1][0] = (struct face){.kind = BOUNDARY_REFLECTING, .at = 0.0};
    assert_null(draw_in(simulation, "pressure", NAN, NAN));
    surface = read_picture();
    assert_true(gap_below(surface) >= 20); /* the page's own, below the frame */
    cairo_surface_destroy(surface);
    drop(simulation);
}

static void section_of_a_solid_shows_its_two_longest_axes(void **state)
{
    (void)state;
    struct simulation *simulation = lattice(3, 4, 40, 20, 1e-3);
    assert_null(draw_in(simulation, "pressure", NAN, NAN));
    cairo_surface_t *surface = read_picture();
    /* The middle plane lies between the second and the third layer along x; the third is in
     * front. */
    struct colour_scale scale = colour_scale_make((struct range){2e9, 3e9});
    assert_true(count_pixels(surface, colour_of(&scale, 3e9)) > 500000);
    assert_int_equal(cairo_image_surface_get_width(surface), 1600);
    cairo_surface_destroy(surface);
    drop(simulation);
}

/* Stores the particles the other way round. */
static void turn_round(struct particles *p)
{
    for (int k = 0; k < p->fields; ++k) {
        const struct field_declaration *field = &p->field[k].declaration;
        const size_t bytes = number_size(field->number) * (size_t)field->components;
        for (int32_t i = 0; i < p->count / 2; ++i) {
            char buffer[64], *a = (char *)p->field[k].data + (size_t)i * bytes;
            char *b = (char *)p->field[k].data + (size_t)(p->count - 1 - i) * bytes;
            memcpy(buffer, a, bytes);
            memcpy(a, b, bytes);
            memcpy(b, buffer, bytes);
        }
    }
}

static void a_picture_is_the_same_in_any_order_of_storage(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; ++dimension) {
        struct simulation *simulation =
            lattice(dimension, 30, dimension > 1 ? 20 : 1, dimension > 2 ? 10 : 1, 1e-3);
        /* Dense enough that discs lie on each other. */
        for (int32_t i = 0; i < particles_of(simulation)->count; ++i)
            particles_of(simulation)->mass[i] *= 8.0;
        assert_null(draw_in(simulation, "pressure", NAN, NAN));
        cairo_surface_t *first = read_picture();
        turn_round(particles_of(simulation));
        assert_null(draw_in(simulation, "pressure", NAN, NAN));
        cairo_surface_t *second = read_picture();
        const size_t bytes = (size_t)cairo_image_surface_get_stride(first) *
                             (size_t)cairo_image_surface_get_height(first);
        assert_int_equal(cairo_image_surface_get_height(first),
                         cairo_image_surface_get_height(second));
        assert_memory_equal(cairo_image_surface_get_data(first),
                            cairo_image_surface_get_data(second), bytes);
        cairo_surface_destroy(first);
        cairo_surface_destroy(second);
        drop(simulation);
    }
}

static void extreme_shapes_keep_the_page_within_limits(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1000, 1}, {1, 1000}, {1, 1}, {204, 8}, {3, 300}};
    static const double spacings[] = {1e-12, 1e-9, 1e-3, 1e9};
    for (size_t i = 0; i < COUNT_OF(sizes); ++i) {
        struct simulation *simulation =
            lattice(2, sizes[i][0], sizes[i][1], 1, spacings[i % COUNT_OF(spacings)]);
        assert_draws(simulation, "pressure", NAN, NAN);
        drop(simulation);
    }
}

static void extreme_values_are_drawn(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; ++dimension) {
        struct simulation *simulation =
            lattice(dimension, 5, dimension > 1 ? 5 : 1, dimension > 2 ? 5 : 1, 1e-3);
        struct particles *p = particles_of(simulation);
        assert_draws(simulation, "density", NAN, NAN);    /* constant */
        assert_draws(simulation, "velocity.x", NAN, NAN); /* zero */
        assert_draws(simulation, "pressure", 2e9, 3e9);
        assert_draws(simulation, "pressure", 1e12, NAN);
        assert_draws(simulation, "pressure", 5.0, 5.0);
        p->pressure[0] = NAN;
        p->pressure[1] = INFINITY;
        p->pressure[2] = -DBL_MAX;
        p->position[3][0] = NAN;
        p->density[4] = 0.0;
        assert_draws(simulation, "pressure", NAN, NAN);
        p->position[2][0] = 1e300;
        assert_draws(simulation, "pressure", NAN, NAN);
        for (int32_t i = 0; i < p->count; ++i)
            p->pressure[i] = p->position[i][0] = p->density[i] = NAN;
        assert_draws(simulation, "pressure", NAN, NAN);
        p->count = 0;
        assert_draws(simulation, "pressure", NAN, NAN);
        drop(simulation);
    }
}

static void wrong_fields_are_input_errors(void **state)
{
    (void)state;
    struct simulation *simulation = lattice(2, 2, 2, 1, 1e-3);
    static const char *const fields[] = {"presure", "velocity", "velocity.q", ""};
    for (size_t i = 0; i < COUNT_OF(fields); ++i) {
        struct error *error = draw_in(simulation, fields[i], NAN, NAN);
        assert_non_null(error);
        assert_int_equal(error_kind(error), ERROR_INPUT);
        if (i == 0)
            assert_non_null(strstr(error_message(error, 0), "did you mean \"pressure\"?"));
        error_free(error);
    }
    drop(simulation);
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
        cmocka_unit_test(particles_are_painted_in_the_colours_of_their_values),
        cmocka_unit_test(bodies_have_a_colour_each),
        cmocka_unit_test(the_frame_stands_where_a_wall_bounds_the_particles),
        cmocka_unit_test(section_of_a_solid_shows_its_two_longest_axes),
        cmocka_unit_test(a_picture_is_the_same_in_any_order_of_storage),
        cmocka_unit_test(extreme_shapes_keep_the_page_within_limits),
        cmocka_unit_test(extreme_values_are_drawn),
        cmocka_unit_test(wrong_fields_are_input_errors),
        cmocka_unit_test(plots_have_their_series_in_colour),
        cmocka_unit_test(plots_take_any_numbers),
        cmocka_unit_test(a_folder_that_is_missing_is_a_system_error),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
