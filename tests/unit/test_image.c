/* Shapes from PNG files: the area of their pixels, and files that are none. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <cairo.h>
#include <cmocka.h>

#include "run/catalogue.h"
#include "sample.h"
#include "scratch_folder.h"
#include "shape/pixels.h"
#include "source_folder.h"

enum { WIDTH = 40, HEIGHT = 25, MOST = 1 << 16 };

static const double pixel = 2e-6;

static char *path_of(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

/* Grey rises by 6 with each column; the lowest row is red, and the left pixel of the top row is
 * clear. */
static void draw(const char *name, cairo_format_t format)
{
    cairo_surface_t *surface = cairo_image_surface_create(format, WIDTH, HEIGHT);
    unsigned char *data = cairo_image_surface_get_data(surface);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            uint32_t color = 0xff000000u | 0x010101u * (uint32_t)(6 * x);
            if (y == HEIGHT - 1)
                color = 0xffff0000u;
            if (y == 0 && x == 0)
                color = 0;
            memcpy(data + y * cairo_image_surface_get_stride(surface) + 4 * x, &color, 4);
        }
    cairo_surface_mark_dirty(surface);
    assert_int_equal(cairo_surface_write_to_png(surface, path_of(name)), CAIRO_STATUS_SUCCESS);
    cairo_surface_destroy(surface);
}

static struct shape_image image_of(const char *name, double low, double high)
{
    return (struct shape_image){.file = path_of(name),
                                .pixel = pixel,
                                .from = VECTOR(1e-3, -1e-3),
                                .grey = VECTOR(low, high)};
}

static double area_of(double low, double high, int points)
{
    struct shape_image image = image_of("grey.png", low, high);
    const struct one_of shape = shape_of("image", &image);
    const char *text = shape_wrong(&shape, 2);
    if (text)
        fail_msg("%s", text);
    const double area = sampled_volume(&shape, 2, points) / square(pixel);
    free(image.pixels);
    return area;
}

/* Ten columns of 24 rows without the clear pixel; red is as bright as 76. */
static void a_range_of_grey_has_the_area_of_its_pixels(void **state)
{
    (void)state;
    draw("grey.png", CAIRO_FORMAT_ARGB32);
    assert_near(area_of(0.0, 59.0, 1000), 239.0, 1e-12);
    assert_near(area_of(76.0, 76.0, 1000), 40.0, 1e-12);
    assert_near(area_of(0.0, 255.0, 1000), 999.0, 1e-12);
    assert_near(area_of(0.0, 59.0, 1009) + area_of(60.0, 255.0, 1009), 999.0, 5e-3);
    draw("grey.png", CAIRO_FORMAT_RGB24);
    assert_near(area_of(0.0, 255.0, 1000), 1000.0, 1e-12);
}

static void the_top_row_of_a_picture_is_up(void **state)
{
    (void)state;
    draw("grey.png", CAIRO_FORMAT_RGB24);
    struct shape_image image = image_of("grey.png", 76.0, 76.0);
    const struct one_of shape = shape_of("image", &image);
    assert_null(shape_wrong(&shape, 2));
    assert_true(shape_inside(&shape, vec3_make(1e-3, -1e-3, 0.0)));
    assert_false(shape_inside(&shape, vec3_make(1e-3, -1e-3 + 1.5 * pixel, 0.0)));
    const struct bounds bounds = shape_bounds(&shape);
    assert_near(bounds.high.x - 1e-3, WIDTH * pixel, 1e-9);
    assert_near(bounds.high.y + 1e-3, HEIGHT * pixel, 1e-9);
    free(image.pixels);
}

static size_t contents(const char *name, unsigned char *bytes)
{
    FILE *file = fopen(path_of(name), "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, MOST, file);
    fclose(file);
    return size;
}

static void assert_refused(const char *name, const void *bytes, size_t size, const char *words)
{
    FILE *file = fopen(path_of(name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
    struct shape_image image = image_of(name, 0.0, 255.0);
    assert_wrong("image", &image, 2, words);
    assert_null(image.pixels);
}

static void files_that_are_no_picture_are_refused(void **state)
{
    (void)state;
    static unsigned char good[MOST], bad[MOST];
    static const unsigned char jpeg[] = {0xff, 0xd8, 0xff, 0xe0, 0, 16, 'J', 'F', 'I', 'F',
                                         0,    1,    1,    0,    0, 0,  0,   0,   0,   0};
    draw("grey.png", CAIRO_FORMAT_RGB24);
    const size_t size = contents("grey.png", good);
    assert_refused("empty.png", good, 0, "is empty");
    assert_refused("text.png", "a picture", 9, "not a PNG");
    assert_refused("photo.png", jpeg, sizeof jpeg, "not a PNG");
    assert_refused("signature.png", good, 8, "not a PNG");
    assert_refused("header.png", good, 20, "cut off");
    assert_refused("half.png", good, size / 2, "cut off");
    memcpy(bad, good, size);
    bad[size / 2] ^= 0xff; /* its checksum does not fit */
    assert_refused("damaged.png", bad, size, "damaged");
    memcpy(bad, good, size);
    bad[16] = 0x7f;
    assert_refused("wide.png", bad, size, "too large");
    memcpy(bad, good, size);
    memset(bad + 16, 0, 8);
    assert_refused("nothing.png", bad, size, "damaged");
    memcpy(bad, good, size);
    bad[24] = 7; /* bits a channel */
    assert_refused("bits.png", bad, size, "damaged");

    struct shape_image image = image_of("none.png", 0.0, 255.0);
    assert_wrong("image", &image, 2, "no such `file`");
    image = image_of(".", 0.0, 255.0);
    assert_wrong("image", &image, 2, "a folder");
    assert_int_equal(mkfifo(path_of("fifo.png"), 0600), 0);
    image = image_of("fifo.png", 0.0, 255.0);
    assert_wrong("image", &image, 2, "not a regular file");
}

static void ranges_that_make_no_shape_are_refused(void **state)
{
    (void)state;
    draw("grey.png", CAIRO_FORMAT_RGB24);
    struct shape_image image = image_of("grey.png", 250.0, 255.0);
    assert_wrong("image", &image, 2, "no pixel");
    image = image_of("grey.png", 20.0, 10.0);
    assert_wrong("image", &image, 2, "from 0 (black) to 255");
    image = image_of("grey.png", 0.0, 256.0);
    assert_wrong("image", &image, 2, "from 0 (black) to 255");
    image = image_of("grey.png", 0.0, 255.0);
    assert_wrong("image", &image, 3, "two dimensions");
}

static void write_text(const char *name, const char *text)
{
    FILE *file = fopen(path_of(name), "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static struct simulation_case *read_file(const char *name, const char *setting)
{
    static const char *const folders[] = {materials_folder};
    const char *const settings[] = {setting};
    const struct case_options options = {.library_paths = folders,
                                         .library_count = 1,
                                         .settings = settings,
                                         .setting_count = setting != NULL};
    struct simulation_case *input = NULL;
    struct error *error = case_read(path_of(name), &options, &bolide_catalogue, &input);
    if (error)
        fail_msg("%s", error_message(error, 0));
    return input;
}

/* The name of an image is seen from the folder of the file that names it, in a setting from the
 * working folder; what the program writes is right from everywhere. */
static void an_image_is_seen_from_the_file_that_names_it(void **state)
{
    (void)state;
    char setting[160];
    assert_int_equal(mkdir(path_of("parts"), 0700), 0);
    draw("parts/grey.png", CAIRO_FORMAT_RGB24);
    write_text("case.yaml", "include: parts/bodies.yaml\nformat: 1\ntitle: t\ndimension: 2\n"
                            "resolution: 2 um\nsolver: sph\nrun: {until: 1 ns}\n"
                            "materials: {metal: {library: aluminium}}\n");
    write_text(
        "parts/bodies.yaml",
        "bodies: {a: {material: metal, image: {file: grey.png, pixel: 2 um, grey: [0, 255]}}}"
        "\n");
    struct simulation_case *input = read_file("case.yaml", NULL);
    const struct shape_image *image = case_body(input, 0)->shape.value;
    assert_string_equal(image->file, path_of("parts/grey.png"));
    assert_int_equal(image->pixels->width, WIDTH);

    FILE *file = fopen(path_of("written.yaml"), "w");
    assert_non_null(file);
    assert_null(case_write(input, file));
    assert_int_equal(fclose(file), 0);
    case_free(input);
    case_free(read_file("written.yaml", NULL));

    snprintf(setting, sizeof setting, "bodies.a.image.file=%s", path_of("parts/grey.png"));
    case_free(read_file("case.yaml", setting));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_range_of_grey_has_the_area_of_its_pixels),
        cmocka_unit_test(the_top_row_of_a_picture_is_up),
        cmocka_unit_test(files_that_are_no_picture_are_refused),
        cmocka_unit_test(ranges_that_make_no_shape_are_refused),
        cmocka_unit_test(an_image_is_seen_from_the_file_that_names_it),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
