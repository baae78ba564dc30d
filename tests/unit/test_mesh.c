/* Shapes from STL files: the volume that a surface encloses, and files that enclose nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "sample.h"
#include "scratch_folder.h"
#include "shape/triangles.h"

enum { MOST = 20000 };

/* Triangles to write to a file. */
struct surface {
    int count;
    float corner[MOST][3][3];
};

static struct surface surface;

static void add_triangle(const float a[3], const float b[3], const float c[3])
{
    const float *const corner[3] = {a, b, c};
    assert_true(surface.count < MOST);
    for (int i = 0; i < 3; i++)
        memcpy(surface.corner[surface.count][i], corner[i], sizeof(float[3]));
    surface.count++;
}

static void add_quad(const float a[3], const float b[3], const float c[3], const float d[3])
{
    add_triangle(a, b, c);
    add_triangle(a, c, d);
}

static void add_cuboid(const float low[3], const float high[3])
{
    float c[8][3];
    for (int k = 0; k < 8; k++) {
        const bool far[3] = {k % 4 == 1 || k % 4 == 2, k % 4 >= 2, k >= 4};
        for (int axis = 0; axis < 3; axis++)
            c[k][axis] = far[axis] ? high[axis] : low[axis];
    }
    add_quad(c[0], c[3], c[2], c[1]);
    add_quad(c[4], c[5], c[6], c[7]);
    add_quad(c[0], c[1], c[5], c[4]);
    add_quad(c[1], c[2], c[6], c[5]);
    add_quad(c[2], c[3], c[7], c[6]);
    add_quad(c[3], c[0], c[4], c[7]);
}

static void add_box(float low, float high)
{
    const float from[3] = {low, low, low}, to[3] = {high, high, high};
    add_cuboid(from, to);
}

/* A torus about z, of AROUND by AROUND quads, turned a little so that nothing lies on a lattice. */
static void torus_point(int i, int j, int around, float at[3])
{
    const double u = 2.0 * M_PI * (i % around) / around, v = 2.0 * M_PI * (j % around) / around;
    const double r = 2.0 + 0.7 * cos(v), x = r * cos(u), y = r * sin(u), z = 0.7 * sin(v);
    at[0] = (float)x;
    at[1] = (float)(0.8 * y - 0.6 * z);
    at[2] = (float)(0.6 * y + 0.8 * z);
}

static void add_torus(int around)
{
    for (int i = 0; i < around; i++)
        for (int j = 0; j < around; j++) {
            float a[3], b[3], c[3], d[3];
            torus_point(i, j, around, a);
            torus_point(i + 1, j, around, b);
            torus_point(i + 1, j + 1, around, c);
            torus_point(i, j + 1, around, d);
            add_quad(a, b, c, d);
        }
}

static char *path_of(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static FILE *open_file(const char *name)
{
    FILE *file = fopen(path_of(name), "wb");
    assert_non_null(file);
    return file;
}

static void write_binary(const char *name)
{
    static const char header[80] = "solid in name only";
    const uint32_t count = (uint32_t)surface.count;
    const float normal[3] = {0.0f, 0.0f, 0.0f};
    const uint16_t nothing = 0;
    FILE *file = open_file(name);
    fwrite(header, 1, sizeof header, file);
    fwrite(&count, sizeof count, 1, file);
    for (int i = 0; i < surface.count; i++) {
        fwrite(normal, sizeof normal, 1, file);
        fwrite(surface.corner[i], sizeof surface.corner[i], 1, file);
        fwrite(&nothing, sizeof nothing, 1, file);
    }
    fclose(file);
}

static void write_text(const char *name)
{
    FILE *file = open_file(name);
    fputs("solid with a name\r\n", file);
    for (int i = 0; i < surface.count; i++) {
        fputs("  facet normal 0 0 1e0\n    outer loop\n", file);
        for (int j = 0; j < 3; j++)
            fprintf(file, "      vertex %.9g %.9g %.9g\n", (double)surface.corner[i][j][0],
                    (double)surface.corner[i][j][1], (double)surface.corner[i][j][2]);
        fputs("    endloop\n  endfacet\n", file);
    }
    fputs("endsolid with a name\n", file);
    fclose(file);
}

static struct shape_mesh mesh_of(const char *name)
{
    return (struct shape_mesh){.file = path_of(name), .unit = 1e-3, .from = VECTOR(0.1, 0.0, 0.0)};
}

/* In the unit of the file. */
static double volume_of(const char *name, int points)
{
    struct shape_mesh mesh = mesh_of(name);
    const struct one_of shape = shape_of("mesh", &mesh);
    const char *text = shape_wrong(&shape, 3);
    if (text)
        fail_msg("%s", text);
    const double volume = sampled_volume(&shape, 3, points);
    free(mesh.triangles);
    return volume / (1e-3 * 1e-3 * 1e-3);
}

/* The torus of polygons: Pappus with the area and the mean radius of polygons of 80 corners. */
static void a_torus_has_its_volume_at_fifty_points_across(void **state)
{
    (void)state;
    surface.count = 0;
    add_torus(80);
    write_binary("torus.stl");
    write_text("torus-text.stl");
    const double polygon = 40.0 * sin(2.0 * M_PI / 80.0) / M_PI;
    const double volume = 2.0 * M_PI * 2.0 * polygon * M_PI * 0.49 * polygon;
    assert_near(volume_of("torus.stl", 50), volume, 5e-3);
    assert_near(volume_of("torus.stl", 150), volume, 1e-3);
    assert_true(volume_of("torus.stl", 50) == volume_of("torus-text.stl", 50));
}

/* What programs write that spell the format in their own way. */
static void harmless_spellings_are_read(void **state)
{
    (void)state;
    FILE *file = open_file("spelt.stl");
    fputs("\xef\xbb\xbf  SOLID cube\r\n", file);
    surface.count = 0;
    add_box(-1.0f, 1.0f);
    for (int i = 0; i < surface.count; i++) {
        fputs("Facet Normal 0 0 0 outer\tloop\r", file);
        for (int j = 0; j < 3; j++)
            fprintf(file, "vertex %g %g %g\n", (double)surface.corner[i][j][0],
                    (double)surface.corner[i][j][1], (double)surface.corner[i][j][2]);
        fputs("end loop\nEnd Facet\n", file);
    }
    fputs("end solid", file);
    fclose(file);
    assert_near(volume_of("spelt.stl", 10), 8.0, 1e-12);
}

static void a_surface_within_another_is_a_cavity(void **state)
{
    (void)state;
    surface.count = 0;
    add_box(-1.0f, 1.0f);
    add_box(-0.5f, 0.5f);
    write_text("cavity.stl");
    assert_near(volume_of("cavity.stl", 40), 8.0 - 1.0, 1e-12);
    assert_near(volume_of("cavity.stl", 41), 7.0, 0.03);
}

/* Uniform in LOW .. HIGH, by a linear congruence of Knuth's MMIX. */
static double draw(uint64_t *state, double low, double high)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * (double)(*state >> 11) * 0x1p-53;
}

static bool is_in(const float box[2][3], struct vec3 at)
{
    const double x[3] = {at.x, at.y, at.z};
    bool inside = true;
    for (int axis = 0; axis < 3; axis++)
        inside &= x[axis] >= (double)box[0][axis] && x[axis] < (double)box[1][axis];
    return inside;
}

/* Boxes that overlap anyhow, as bars that cross, with a cavity in one of them that holds a core. */
static void bodies_that_overlap_are_joined(void **state)
{
    (void)state;
    uint64_t dice = 3;
    for (int trial = 0; trial < 40; trial++) {
        float box[4][2][3]; /* two that overlap, a cavity in the first, its core */
        struct triangles *made;
        char said[MESH_TEXT];
        for (int axis = 0; axis < 3; axis++) {
            box[0][0][axis] = (float)draw(&dice, -1.0, -0.9);
            box[0][1][axis] = (float)draw(&dice, 0.9, 1.0);
            box[1][0][axis] = (float)draw(&dice, 0.35, 0.6);
            box[1][1][axis] = (float)draw(&dice, trial % 2 ? 0.7 : 1.1, 2.0);
            box[2][0][axis] = (float)draw(&dice, -0.7, -0.6);
            box[2][1][axis] = (float)draw(&dice, -0.1, 0.0);
            box[3][0][axis] = (float)draw(&dice, -0.5, -0.4);
            box[3][1][axis] = (float)draw(&dice, -0.3, -0.2);
        }
        box[1][0][trial % 3] = -2.0f;
        box[1][1][trial % 3] = 2.0f; /* it pierces the first */
        surface.count = 0;
        for (int k = 0; k < 4; k++)
            add_cuboid(box[(k + trial) % 4][0], box[(k + trial) % 4][1]);
        assert_null(
            triangles_make((const float(*)[3][3])surface.corner, surface.count, said, &made));
        for (int i = 0; i < 400; i++) {
            const struct vec3 at = {draw(&dice, -2.1, 2.1), draw(&dice, -2.1, 2.1),
                                    draw(&dice, -2.1, 2.1)};
            const bool first = is_in(box[0], at) && (!is_in(box[2], at) || is_in(box[3], at));
            assert_int_equal(triangles_hold(made, at), first || is_in(box[1], at));
        }
        free(made);
    }
}

static void points_of_two_boxes_side_by_side_are_in_one(void **state)
{
    (void)state;
    surface.count = 0;
    add_box(0.0f, 1.0f);
    write_binary("unit.stl");
    struct shape_mesh first = mesh_of("unit.stl"), second = mesh_of("unit.stl");
    second.from.at[1] += 1e-3;
    const struct one_of shapes[2] = {shape_of("mesh", &first), shape_of("mesh", &second)};
    assert_null(shape_wrong(&shapes[0], 3));
    assert_null(shape_wrong(&shapes[1], 3));
    for (int i = 0; i < 16; i++) {
        const struct vec3 at = vec3_make(0.1 + 0.5e-3, i / 8.0 * 1e-3, 0.25e-3);
        assert_int_equal(shape_inside(&shapes[0], at) + shape_inside(&shapes[1], at), 1);
    }
    free(first.triangles);
    free(second.triangles);
}

static void assert_refused(const char *name, const char *words)
{
    struct shape_mesh mesh = mesh_of(name);
    assert_wrong("mesh", &mesh, 3, words);
    assert_null(mesh.triangles);
}

static void refuse_text(const char *text, const char *words)
{
    FILE *file = open_file("bad.stl");
    fputs(text, file);
    fclose(file);
    assert_refused("bad.stl", words);
}

/* The first SIZE bytes of the file NAME, with zeros after its end. */
static void refuse_part(const char *name, size_t size, const char *words)
{
    static char bytes[1 << 16];
    FILE *file = fopen(path_of(name), "rb");
    assert_non_null(file);
    const size_t whole = fread(bytes, 1, sizeof bytes, file);
    memset(bytes + whole, 0, sizeof bytes - whole);
    fclose(file);
    file = open_file("bad.stl");
    fwrite(bytes, 1, size, file);
    fclose(file);
    assert_refused("bad.stl", words);
}

static void files_that_are_no_mesh_are_refused(void **state)
{
    (void)state;
    assert_refused("none.stl", "no such `file`");
    assert_refused(".", "a folder");
    refuse_text("", "is empty");
    refuse_text("ISO-10303-21;\nHEADER;", "not an STL mesh");
    refuse_text("solid name\nendsolid name\n", "less than four triangles");
    refuse_text("solid name\nfacet normal 0 0 1\nouter loop\nvertex 1 2\n",
                "cut off: it ends at line 5, in facet 1, where a number is wanted");
    refuse_text("solid name\nfacet normal 0 0 x\n",
                "line 2 of this STL file (facet 1): expected a number, found \"x\"");
    refuse_text("solid name\nfacet normal 0,5 0 0\n", "\"0,5\" has a decimal comma, write 0.5");
    refuse_text("solid name\nvertex 0 0 0\n",
                "line 2 of this STL file (facet 1): expected `facet`");
    refuse_text("solid name\nendsolid\nsold b\n",
                "line 3 of this STL file (facet 1): expected `solid`");
    refuse_text("solid name\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0 0\n"
                "vertex 0 0 0\nend lop\n",
                "line 7 of this STL file (facet 1): expected `endloop`, found \"end\"");
    refuse_text("solid name\n", "cut off: it ends at line 2");
    surface.count = 0;
    add_box(0.0f, 1.0f);
    write_text("text.stl");
    refuse_part("text.stl", 700, "cut off: it ends at line ");
    write_binary("binary.stl");
    refuse_part("binary.stl", 84 + 50 * 11 + 20, "damaged");
    refuse_part("binary.stl", 60, "not an STL mesh");
    refuse_part("binary.stl", 84 + 50 * 12 + 3, "remove the 3 bytes after the last facet");
    surface.corner[3][1][2] = NAN;
    write_binary("binary.stl");
    assert_refused("binary.stl", "a corner of facet 4 of this mesh is not a number");
    surface.corner[3][1][2] = INFINITY;
    write_text("text.stl");
    assert_refused("text.stl", "infinite");
    surface.count = 0;
    add_box(0.0f, 1.0f);
    surface.count--;
    write_binary("binary.stl");
    assert_refused("binary.stl", "is open");
    assert_refused("binary.stl", "belongs to 1 facet, not to two");
    surface.count++;
    for (int copy = 0; copy < surface.count; copy += 5) {
        memcpy(surface.corner[12], surface.corner[copy], sizeof surface.corner[12]);
        surface.count = 13;
        write_text("text.stl");
        char words[64];
        snprintf(words, sizeof words, "facet 13 of this mesh repeats facet %d:", copy + 1);
        assert_refused("text.stl", words);
        surface.count = 12;
    }
    surface.corner[0][0][0] += 1e-6f;
    write_binary("binary.stl");
    assert_refused("binary.stl", "is open");
    for (int i = 0; i < 9 * surface.count; i++)
        surface.corner[i / 9][i % 9 / 3][2] = 0.0f;
    surface.corner[0][0][0] = 0.0f;
    write_binary("binary.stl");
    assert_refused("binary.stl", "flat");
    surface.corner[3][1][0] = INFINITY;
    write_text("text.stl");
    assert_refused("text.stl", "facet 4 of this mesh is not a number, or infinite");
    struct shape_mesh mesh = mesh_of("text.stl");
    assert_wrong("mesh", &mesh, 2, "three dimensions");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_torus_has_its_volume_at_fifty_points_across),
        cmocka_unit_test(harmless_spellings_are_read),
        cmocka_unit_test(a_surface_within_another_is_a_cavity),
        cmocka_unit_test(bodies_that_overlap_are_joined),
        cmocka_unit_test(points_of_two_boxes_side_by_side_are_in_one),
        cmocka_unit_test(files_that_are_no_mesh_are_refused),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
