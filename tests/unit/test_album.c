/* Pictures of particles: windows and colours that strays do not set, equal frames on any number of
 * threads and in any order of storage, cracks that stay visible, any input. */
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
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"
#include "material/material.h"
#include "picture/album_internal.h"

static const char path[] = "album.png";
static char *body_names[] = {"flyer", "target"};

/* A case with the pictures of NAMES, COUNT of them. */
static struct simulation_case case_of(int dimension, char **names, int count,
                                      struct picture_input *pictures)
{
    struct simulation_case input = {.title = "Plate \xff impact", .dimension = dimension};
    for (int i = 0; i < count; i++)
        pictures[i] = (struct picture_input){.view = -1,
                                             .up = -1,
                                             .palette = -1,
                                             .direction = {2, {30.0, 25.0, 0.0}},
                                             .mirror = true,
                                             .outlines = true,
                                             .plane = {{NAN, NAN, NAN}},
                                             .slab = NAN,
                                             .dot = 1.6,
                                             .range = {.low = {.value = NAN},
                                                       .high = {.value = NAN},
                                                       .percentiles = {2, {0.5, 99.5, 0.0}}}};
    input.output.pictures = (struct named_map){.count = count, .names = names, .items = pictures};
    return input;
}

/* A lattice of NX x NY x NZ particles a millimetre apart, of two bodies, with a pressure that grows
 * along x. */
static struct frame lattice(int nx, int ny, int nz)
{
    struct frame frame = {.groups = 1};
    struct frame_group *group = &frame.group[0];
    const size_t count = (size_t)(nx * ny * nz);
    frame.time = 3.1e-6;
    frame.bodies = (struct frame_names){2, calloc(2, sizeof(char *))};
    for (int i = 0; i < 2; i++)
        frame.bodies.name[i] = text_copy(body_names[i]);
    group->count = (int64_t)count;
    group->id = memory_allocate(count * sizeof *group->id);
    group->body = memory_allocate(count * sizeof *group->body);
    group->material = memory_allocate(count * sizeof *group->material);
    group->position = memory_allocate(count * sizeof *group->position);
    group->diameter = memory_allocate(count * sizeof *group->diameter);
    group->mass = memory_allocate(count * sizeof *group->mass);
    group->fields = 1;
    group->field[0] = (struct frame_field){.name = "pressure", .unit = "Pa"};
    group->field[0].value = memory_allocate(count * sizeof(float));
    for (int i = 0; i < (int)count; i++) {
        const int site[3] = {i % nx, i / nx % ny, i / nx / ny};
        group->id[i] = (uint64_t)i;
        group->body[i] = (uint16_t)(2 * site[0] / nx);
        for (int axis = 0; axis < 3; axis++)
            group->position[i][axis] = 1e-3f * ((float)site[axis] + 0.5f);
        if (nz == 1)
            group->position[i][2] = 0.0f;
        group->diameter[i] = 1e-3f;
        group->mass[i] = 1.0f;
        group->field[0].value[i] = 1e9f * (float)(site[0] + 1);
    }
    return frame;
}

static struct album *album_of(const struct simulation_case *input, int threads,
                              const struct frame *first, const struct frame *last)
{
    const struct ranks alone = ranks_alone();
    struct album *album;
    assert_null(album_create(input, threads, &album));
    assert_null(album_begin(album, first, last));
    assert_null(album_add(album, first));
    assert_null(album_add(album, last));
    album_share(album, &alone);
    return album;
}

/* The bytes of picture INDEX of FRAME. */
static char *draw(const struct album *album, int index, const struct frame *frame, size_t *size)
{
    char *bytes;
    struct error *error = album_draw(album, index, frame, path);
    if (error)
        fail_msg("%s", error_message(error, 0));
    assert_null(file_read(path, &bytes, size));
    remove(path);
    return bytes;
}

static void expect_same(const char *a, size_t m, const char *b, size_t n)
{
    assert_int_equal(m, n);
    assert_memory_equal(a, b, m);
}

static void strays_set_neither_window_nor_colours(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; dimension++) {
        char *names[] = {"pressure"};
        struct picture_input pictures[1];
        struct simulation_case input = case_of(dimension, names, 1, pictures);
        struct frame first = lattice(40, 30, dimension == 3 ? 20 : 1);
        struct frame last = lattice(40, 30, dimension == 3 ? 20 : 1);
        struct album *plain = album_of(&input, 1, &first, &last);
        last.group[0].position[0][0] = 0.4f;
        last.group[0].position[0][1] = -0.4f;
        last.group[0].field[0].value[0] = 1e13f;
        struct album *with = album_of(&input, 1, &first, &last);
        for (int axis = 0; axis < 3; axis++) {
            const struct range *a = &plain->picture[0].view.window[axis];
            const struct range *b = &with->picture[0].view.window[axis];
            assert_true(fabs(a->low - b->low) <= 1e-3 && fabs(a->high - b->high) <= 1e-3);
        }
        const struct range *a = &plain->picture[0].panel[0].scale.range;
        const struct range *b = &with->picture[0].panel[0].scale.range;
        assert_true(a->low == b->low && a->high == b->high);
        struct scene scene;
        int64_t outside;
        assert_null(scene_take(with, &with->picture[0], &with->picture[0].panel[0], &last, &scene,
                               &outside));
        assert_int_equal(outside, 1);
        free(scene.item);
        album_free(plain);
        album_free(with);
        frame_free(&first);
        frame_free(&last);
    }
}

static void pictures_are_the_same_on_any_number_of_threads(void **state)
{
    (void)state;
    char *names[] = {"pressure", "body"};
    for (int dimension = 1; dimension <= 3; dimension++) {
        struct picture_input pictures[2];
        struct simulation_case input = case_of(dimension, names, 2, pictures);
        struct frame frame = lattice(30, dimension > 1 ? 20 : 1, dimension > 2 ? 10 : 1);
        if (dimension == 3) /* of which one takes a second */
            input.output.pictures.count = 1;
        for (int picture = 0; picture < input.output.pictures.count; picture++) {
            char *first = NULL;
            size_t size = 0;
            for (int threads = 1; threads <= 4; threads += 3) {
                struct album *album = album_of(&input, threads, &frame, &frame);
                size_t other;
                char *bytes = draw(album, picture, &frame, &other);
                if (first)
                    expect_same(first, size, bytes, other);
                else
                    size = other;
                if (first)
                    free(bytes);
                else
                    first = bytes;
                album_free(album);
            }
            free(first);
        }
        frame_free(&frame);
    }
}

/* Stores the members the other way round. */
static void reverse(struct frame_group *group)
{
    for (int64_t i = 0, k = group->count - 1; i < k; i++, k--) {
        const uint64_t id = group->id[i];
        const uint16_t body = group->body[i];
        const float value = group->field[0].value[i];
        float place[3];
        memcpy(place, group->position[i], sizeof place);
        group->id[i] = group->id[k];
        group->body[i] = group->body[k];
        group->field[0].value[i] = group->field[0].value[k];
        memcpy(group->position[i], group->position[k], sizeof place);
        group->id[k] = id;
        group->body[k] = body;
        group->field[0].value[k] = value;
        memcpy(group->position[k], place, sizeof place);
    }
}

static void pictures_are_the_same_in_any_order_of_storage(void **state)
{
    (void)state;
    char *names[] = {"pressure"};
    for (int dimension = 2; dimension <= 3; dimension++) {
        struct picture_input pictures[1];
        struct simulation_case input = case_of(dimension, names, 1, pictures);
        struct frame a = lattice(20, 10, dimension > 2 ? 5 : 1);
        struct frame b = lattice(20, 10, dimension > 2 ? 5 : 1);
        for (int64_t i = 0; i < a.group[0].count; i++) /* they lie on each other */
            a.group[0].diameter[i] = b.group[0].diameter[i] = 2e-3f;
        reverse(&b.group[0]);
        assert_null(frame_order(&a.group[0]));
        assert_null(frame_order(&b.group[0]));
        struct album *album = album_of(&input, 2, &a, &a);
        size_t m, n;
        char *first = draw(album, 0, &a, &m), *second = draw(album, 0, &b, &n);
        expect_same(first, m, second, n);
        free(first);
        free(second);
        album_free(album);
        frame_free(&a);
        frame_free(&b);
    }
}

static cairo_surface_t *draw_surface(const struct album *album, int index,
                                     const struct frame *frame)
{
    assert_null(album_draw(album, index, frame, path));
    cairo_surface_t *surface = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    remove(path);
    return surface;
}

static uint32_t pixel(cairo_surface_t *surface, int column, int row)
{
    const unsigned char *data = cairo_image_surface_get_data(surface);
    uint32_t value;
    memcpy(&value, data + row * cairo_image_surface_get_stride(surface) + 4 * column, sizeof value);
    return value & 0xffffff;
}

static int count_pixels(cairo_surface_t *surface, struct colour colour)
{
    const uint32_t wanted = (uint32_t)(colour.red * 255.0 + 0.5) << 16 |
                            (uint32_t)(colour.green * 255.0 + 0.5) << 8 |
                            (uint32_t)(colour.blue * 255.0 + 0.5);
    int found = 0;
    for (int row = 0; row < cairo_image_surface_get_height(surface); row++)
        for (int column = 0; column < cairo_image_surface_get_width(surface); column++)
            found += pixel(surface, column, row) == wanted;
    return found;
}

static void frames_have_one_size_and_a_uniform_field_one_colour(void **state)
{
    (void)state;
    char *names[] = {"pressure"};
    struct picture_input pictures[1];
    struct simulation_case input = case_of(2, names, 1, pictures);
    struct frame first = lattice(40, 20, 1), last = lattice(40, 20, 1);
    for (int64_t i = 0; i < last.group[0].count; i++) {
        first.group[0].field[0].value[i] = last.group[0].field[0].value[i] = 1e9f;
        last.group[0].position[i][0] *= 3.0f;
    }
    struct album *album = album_of(&input, 1, &first, &last);
    assert_true(album->picture[0].panel[0].uniform);
    cairo_surface_t *a = draw_surface(album, 0, &first), *b = draw_surface(album, 0, &last);
    assert_int_equal(cairo_image_surface_get_width(a), cairo_image_surface_get_width(b));
    assert_int_equal(cairo_image_surface_get_height(a), cairo_image_surface_get_height(b));
    const struct colour colour = colour_of(&album->picture[0].panel[0].scale, 1e9);
    assert_true(count_pixels(a, colour) > 10000);
    cairo_surface_destroy(a);
    cairo_surface_destroy(b);
    album_free(album);
    frame_free(&first);
    frame_free(&last);
}

/* White pixels in the middle row between the outermost ones of the material. */
static int white_in_the_middle(cairo_surface_t *surface, int top, int bottom)
{
    const int row = (top + bottom) / 2, width = cairo_image_surface_get_width(surface);
    int first = width / 4, last = 3 * width / 4, white = 0;
    for (int column = first; column <= last; column++)
        white += pixel(surface, column, row) == 0xffffff;
    return white;
}

static void cracks_stay_visible_and_stretched_material_has_none(void **state)
{
    (void)state;
    char *names[] = {"body"};
    struct picture_input pictures[1];
    struct simulation_case input = case_of(2, names, 1, pictures);
    for (int crack = 0; crack < 2; crack++) {
        struct frame frame = lattice(40, 20, 1);
        for (int64_t i = 0; i < frame.group[0].count; i++) {
            float *x = &frame.group[0].position[i][0];
            *x = crack ? *x + (*x > 0.018f ? 1e-3f : 0.0f) : 1.4f * *x;
            frame.group[0].body[i] = 0;
            frame.group[0].diameter[i] = crack ? 1e-3f : 1e-3f * sqrtf(1.4f);
        }
        struct album *album = album_of(&input, 1, &frame, &frame);
        cairo_surface_t *surface = draw_surface(album, 0, &frame);
        const int height = cairo_image_surface_get_height(surface);
        const int white = white_in_the_middle(surface, 140, height - 100);
        if (crack)
            assert_in_range(white, 5, 60);
        else
            assert_int_equal(white, 0);
        cairo_surface_destroy(surface);
        album_free(album);
        frame_free(&frame);
    }
}

static void bodies_have_a_colour_each(void **state)
{
    (void)state;
    char *names[] = {"body"};
    struct picture_input pictures[1];
    struct simulation_case input = case_of(2, names, 1, pictures);
    struct frame frame = lattice(40, 20, 1);
    struct album *album = album_of(&input, 1, &frame, &frame);
    cairo_surface_t *surface = draw_surface(album, 0, &frame);
    assert_true(count_pixels(surface, colour_of_category(0)) > 10000);
    assert_true(count_pixels(surface, colour_of_category(1)) > 10000);
    cairo_surface_destroy(surface);
    album_free(album);
    frame_free(&frame);
}

static void any_input_is_drawn_on_a_page_of_sane_size(void **state)
{
    (void)state;
    static const int sizes[][3] = {{1000, 1, 1}, {1, 1000, 1}, {1, 1, 1}, {3, 3, 3}};
    char *names[] = {"pressure"};
    for (size_t k = 0; k < COUNT_OF(sizes); k++)
        for (int odd = 0; odd < 3; odd++) {
            struct picture_input pictures[1];
            struct simulation_case input = case_of(sizes[k][2] > 1 ? 3 : 2, names, 1, pictures);
            struct frame frame = lattice(sizes[k][0], sizes[k][1], sizes[k][2]);
            struct frame_group *group = &frame.group[0];
            const int64_t last = group->count - 1;
            if (odd == 1) {
                group->field[0].value[0] = NAN;
                group->field[0].value[last] = INFINITY;
                group->field[0].value[last / 2] = -FLT_MAX;
                group->diameter[last / 3] = 0.0f;
                group->position[last / 4][0] = 1e30f;
            }
            if (odd == 2)
                group->count = 0;
            assert_null(frame_order(group));
            struct album *album = album_of(&input, 1, &frame, &frame);
            cairo_surface_t *surface = draw_surface(album, 0, &frame);
            assert_in_range(cairo_image_surface_get_width(surface), 600, 1800);
            assert_in_range(cairo_image_surface_get_height(surface), 150, 1650);
            cairo_surface_destroy(surface);
            album_free(album);
            frame_free(&frame);
        }
}

static void in_one_dimension_all_members_are_dots(void **state)
{
    (void)state;
    char *names[] = {"pressure"};
    struct picture_input pictures[1];
    struct simulation_case input = case_of(1, names, 1, pictures);
    struct frame frame = lattice(30, 1, 1);
    struct album *album = album_of(&input, 1, &frame, &frame);
    struct scene scene;
    int64_t outside;
    assert_null(scene_take(album, &album->picture[0], &album->picture[0].panel[0], &frame, &scene,
                           &outside));
    assert_int_equal(scene.count, 30);
    free(scene.item);
    album_free(album);
    frame_free(&frame);
}

/* What scene_take draws of the member 0 of LAST: its diameter over that at the start. */
static double drawn_times(const struct album *album, const struct frame *last, bool *apart)
{
    struct scene scene;
    int64_t outside;
    assert_null(
        scene_take(album, &album->picture[0], &album->picture[0].panel[0], last, &scene, &outside));
    const double times = scene.item[0].diameter / 1e-3;
    *apart = scene.item[0].apart;
    free(scene.item);
    return times;
}

/* A case whose bodies, as those of lattice(), are of MATERIAL. */
static void give_material(struct simulation_case *input, struct material *material,
                          struct material_input *materials, struct body_input *bodies)
{
    static char *names[] = {"metal"};
    *materials = (struct material_input){.material = material};
    input->materials = (struct named_map){.count = 1, .names = names, .items = materials};
    input->bodies = (struct named_map){.count = 2, .names = body_names, .items = bodies};
}

/* Metal is debris at 4 times its volume, gas at 25 times. */
static void debris_is_drawn_as_dots_and_gas_as_a_whole(void **state)
{
    (void)state;
    char *names[] = {"body"};
    struct material metal = {.eos = {.kind = EOS_tillotson}};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int condensed = 0; condensed < 2; condensed++) {
            struct picture_input pictures[1];
            struct material_input materials;
            struct body_input bodies[2] = {{0}};
            struct simulation_case input = case_of(dimension, names, 1, pictures);
            if (condensed)
                give_material(&input, &metal, &materials, bodies);
            struct frame first = lattice(10, 10, dimension == 3 ? 10 : 1);
            struct frame last = lattice(10, 10, dimension == 3 ? 10 : 1);
            struct album *album = album_of(&input, 1, &first, &last);
            const double most = condensed ? 4.0 : 25.0;
            bool apart;
            for (double volume = 1.1; volume < 1e6; volume *= 1.3) {
                last.group[0].diameter[0] = (float)(1e-3 * pow(volume, 1.0 / dimension));
                const double drawn = drawn_times(album, &last, &apart);
                const double shown = volume > most ? maximum(most * most / volume, 1.0) : volume;
                assert_int_equal(apart, volume > most);
                assert_float_equal(drawn, pow(shown, 1.0 / dimension), 1e-3);
            }
            album_free(album);
            frame_free(&first);
            frame_free(&last);
        }
}

/* Pixels that are darker than the colours of bodies. */
static int count_dark(cairo_surface_t *surface)
{
    const int height = cairo_image_surface_get_height(surface);
    int dark = 0;
    for (int row = 140; row < height - 100; row++)
        for (int column = 150; column < cairo_image_surface_get_width(surface) - 60; column++) {
            const uint32_t colour = pixel(surface, column, row);
            dark += (colour >> 16) + (colour >> 8 & 255) + (colour & 255) < 150;
        }
    return dark;
}

/* The border between two halves is an outline from top to bottom, also of particles that are
 * smaller than a dot; dots that lie alone have none. */
static void outlines_do_not_end_where_particles_are_small(void **state)
{
    (void)state;
    char *names[] = {"body"};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int n = 100; n <= 800; n *= 2) {
            struct picture_input pictures[1];
            struct simulation_case input = case_of(dimension, names, 1, pictures);
            struct frame frame = lattice(n, n, dimension == 3 ? 2 : 1);
            if (dimension == 3)
                pictures[0].direction = (struct vector_value){2, {0.0, 89.0, 0.0}};
            struct album *album = album_of(&input, 2, &frame, &frame);
            cairo_surface_t *surface = draw_surface(album, 0, &frame);
            album->picture[0].view.outlines = false;
            cairo_surface_t *without = draw_surface(album, 0, &frame);
            const int dark = count_dark(surface) - count_dark(without);
            if (dark < cairo_image_surface_get_height(surface) / 2)
                fail_msg("%d-D, %d particles across: %d dark pixels", dimension, n, dark);
            cairo_surface_destroy(surface);
            cairo_surface_destroy(without);
            album_free(album);
            frame_free(&frame);
        }
}

static void lone_dots_have_no_outlines(void **state)
{
    (void)state;
    char *names[] = {"body"};
    for (int dimension = 2; dimension <= 3; dimension++) {
        struct picture_input pictures[1];
        struct simulation_case input = case_of(dimension, names, 1, pictures);
        struct frame frame = lattice(40, 40, dimension == 3 ? 10 : 1);
        for (int64_t i = 0; i < frame.group[0].count; i++)
            frame.group[0].diameter[i] *= 0.1f;
        struct album *album = album_of(&input, 1, &frame, &frame);
        cairo_surface_t *surface = draw_surface(album, 0, &frame);
        album->picture[0].view.outlines = false;
        cairo_surface_t *without = draw_surface(album, 0, &frame);
        assert_int_equal(count_dark(surface), count_dark(without));
        cairo_surface_destroy(surface);
        cairo_surface_destroy(without);
        album_free(album);
        frame_free(&frame);
    }
}

/* The first column that is not white in the rows FIRST to LAST. */
static int first_column(cairo_surface_t *surface, int first, int last)
{
    int column = 0;
    for (; column < cairo_image_surface_get_width(surface); column++)
        for (int row = first; row < last; row++)
            if (pixel(surface, column, row) != 0xffffff)
                return column;
    return column;
}

/* On a wide page of a given size the title is above the picture, not left of it; one that is too
 * long for that begins further left and is whole. */
static void the_title_is_above_a_narrow_picture(void **state)
{
    (void)state;
    char *names[] = {"pressure"};
    struct picture_input pictures[1];
    struct simulation_case input = case_of(2, names, 1, pictures);
    struct frame frame = lattice(20, 20, 1);
    const int size[2] = {1200, 600};
    for (int wide = 0; wide < 2; wide++) {
        if (wide)
            input.title = "A title that is so long that it does not fit between the left edge of a "
                          "narrow picture and the right edge";
        struct album *album = album_of(&input, 1, &frame, &frame);
        album_set_size(album, size);
        cairo_surface_t *surface = draw_surface(album, 0, &frame);
        const int title = first_column(surface, 8, 28), ticks = first_column(surface, 100, 400);
        assert_int_equal(cairo_image_surface_get_width(surface), size[0]);
        assert_true(wide ? title < ticks && title >= 60 : title > ticks && title < ticks + 90);
        cairo_surface_destroy(surface);
        album_free(album);
    }
    frame_free(&frame);
}

/* However long the legend of a frame's fragments is. */
static void frames_of_fragments_have_one_size(void **state)
{
    (void)state;
    char *names[] = {"fragment"};
    struct picture_input pictures[1];
    for (int dimension = 2; dimension <= 3; dimension++) {
        struct simulation_case input = case_of(dimension, names, 1, pictures);
        int height[3] = {0};
        for (int pieces = 0; pieces < 3; pieces++) {
            struct frame frame = lattice(10, 5, dimension == 3 ? 5 : 1);
            struct frame_group *group = &frame.group[0];
            snprintf(group->field[0].name, sizeof group->field[0].name, "fragment");
            for (int64_t i = 0; i < group->count; i++) {
                group->field[0].value[i] = (float)(i % (3 * pieces + 1));
                group->mass[i] = pieces == 2 ? 1.2345e-7f : 1e-3f;
            }
            struct album *album = album_of(&input, 1, &frame, &frame);
            cairo_surface_t *surface = draw_surface(album, 0, &frame);
            height[pieces] = cairo_image_surface_get_height(surface);
            cairo_surface_destroy(surface);
            album_free(album);
            frame_free(&frame);
        }
        assert_true(height[0] == height[1] && height[1] == height[2]);
    }
}

/* But for rounding. */
static bool is_close(uint32_t a, uint32_t b)
{
    bool close = true;
    for (int shift = 0; shift < 24; shift += 8)
        close &= abs((int)(a >> shift & 255) - (int)(b >> shift & 255)) <= 2;
    return close;
}

/* Cells in 3-D are cubes: each face of a box of them is flat, in one colour where its field is. */
static void cells_fill_flat_faces(void **state)
{
    (void)state;
    char *names[] = {"pressure"};
    struct picture_input pictures[1];
    struct simulation_case input = case_of(3, names, 1, pictures);
    struct frame frame = lattice(9, 7, 8);
    uint32_t colour[256] = {0};
    int times[256] = {0}, colours = 0, all = 0, most[3] = {0};
    frame.group[0].cell_dimension = 3;
    for (int64_t i = 0; i < frame.group[0].count; i++)
        frame.group[0].field[0].value[i] = 1e9f;
    struct album *album = album_of(&input, 2, &frame, &frame);
    cairo_surface_t *surface = draw_surface(album, 0, &frame);
    const int height = cairo_image_surface_get_height(surface);
    for (int row = 100; row < height - 150; row++)
        for (int column = 0; column < cairo_image_surface_get_width(surface); column++) {
            const uint32_t seen = pixel(surface, column, row);
            int k = 0;
            if (abs((int)(seen >> 16) - (int)(seen & 255)) < 10)
                continue; /* text and axes are grey */
            while (k < colours && !is_close(colour[k], seen))
                k++;
            if (k == 256)
                continue;
            if (k == colours)
                colour[colours++] = seen;
            times[k]++;
            all++;
        }
    for (int k = 0; k < colours; k++)
        for (int m = 0; m < 3; m++)
            if (times[k] > most[m]) {
                const int last = most[m];
                most[m] = times[k];
                times[k] = last;
            }
    assert_true(all > 100000);
    if (most[0] + most[1] + most[2] < 0.95 * all)
        fail_msg("%d, %d and %d of %d pixels", most[0], most[1], most[2], all);
    cairo_surface_destroy(surface);
    album_free(album);
    frame_free(&frame);
}

/* A gas with one wall across an axis is cut open at the wall, half a cell off it. */
static void gas_is_cut_open_at_its_walls(void **state)
{
    (void)state;
    char *names[] = {"pressure"};
    struct picture_input pictures[1];
    struct simulation_case input = case_of(3, names, 1, pictures);
    struct frame frame = lattice(9, 7, 8);
    struct album *album;
    frame.group[0].cell_dimension = 3;
    for (int walls = 0; walls < 2; walls++) {
        assert_null(album_create(&input, 1, &album));
        album->gas_alone = true;
        for (int axis = 0; axis < 3 && walls; axis++)
            album->place.face[axis][0] = (struct face){.kind = BOUNDARY_REFLECTING, .boundary = -1};
        assert_null(album_begin(album, &frame, &frame));
        const struct view *view = &album->picture[0].view;
        assert_int_equal(view->cuts, walls ? 3 : 2);
        for (int k = 0; k < view->cuts; k++)
            assert_float_equal(view->cut[k].offset,
                               walls    ? 0.5e-3
                               : k == 0 ? 4.5e-3
                                        : 3.5e-3,
                               1e-6);
        album_free(album);
    }
    frame_free(&frame);
}

/* The mean brightness of the coloured pixels of a slab of N x N x 2 particles,
 * seen obliquely. */
static double brightness_of_slab(int n)
{
    char *names[] = {"body"};
    struct picture_input pictures[1];
    struct simulation_case input = case_of(3, names, 1, pictures);
    struct frame frame = lattice(n, n, 2);
    double sum = 0.0, count = 0.0;
    for (int64_t i = 0; i < frame.group[0].count; i++) {
        for (int axis = 0; axis < 3; axis++)
            frame.group[0].position[i][axis] *= 100.0f / (float)n;
        frame.group[0].diameter[i] *= 100.0f / (float)n;
    }
    struct album *album = album_of(&input, 2, &frame, &frame);
    cairo_surface_t *surface = draw_surface(album, 0, &frame);
    for (int row = 0; row < cairo_image_surface_get_height(surface); row++)
        for (int column = 0; column < cairo_image_surface_get_width(surface); column++) {
            const uint32_t colour = pixel(surface, column, row);
            const int red = colour >> 16 & 255, green = colour >> 8 & 255, blue = colour & 255;
            const bool coloured = abs(red - blue) > 20;
            sum += coloured ? red + green + blue : 0;
            count += coloured;
        }
    cairo_surface_destroy(surface);
    album_free(album);
    frame_free(&frame);
    assert_true(count > 50000.0);
    return sum / count;
}

static void a_face_is_as_bright_of_small_particles(void **state)
{
    (void)state;
    const double large = brightness_of_slab(50), small = brightness_of_slab(400);
    if (!(small > 0.9 * large && small < 1.25 * large)) /* whose sides take more of the picture */
        fail_msg("%g of large particles, %g of small ones", large, small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strays_set_neither_window_nor_colours),
        cmocka_unit_test(pictures_are_the_same_on_any_number_of_threads),
        cmocka_unit_test(pictures_are_the_same_in_any_order_of_storage),
        cmocka_unit_test(frames_have_one_size_and_a_uniform_field_one_colour),
        cmocka_unit_test(cracks_stay_visible_and_stretched_material_has_none),
        cmocka_unit_test(bodies_have_a_colour_each),
        cmocka_unit_test(debris_is_drawn_as_dots_and_gas_as_a_whole),
        cmocka_unit_test(outlines_do_not_end_where_particles_are_small),
        cmocka_unit_test(lone_dots_have_no_outlines),
        cmocka_unit_test(the_title_is_above_a_narrow_picture),
        cmocka_unit_test(frames_of_fragments_have_one_size),
        cmocka_unit_test(cells_fill_flat_faces),
        cmocka_unit_test(gas_is_cut_open_at_its_walls),
        cmocka_unit_test(a_face_is_as_bright_of_small_particles),
        cmocka_unit_test(in_one_dimension_all_members_are_dots),
        cmocka_unit_test(any_input_is_drawn_on_a_page_of_sane_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
