/* The structs of all shapes, filled by the reader from their tables, for shape.c's list and for a
 * program that builds a shape itself. A point has as many numbers as the case has dimensions. */
#ifndef BOLIDE_SHAPE_KINDS_H
#define BOLIDE_SHAPE_KINDS_H

#include "shape/shape.h"
#include "shape/triangles.h"

/* Low faces belong to the box, high faces do not, so that adjacent boxes have no point in common.
 * */
struct shape_box {
    struct vector_value from, to;
};

/* A ball in 3-D, a disc in 2-D, an interval in 1-D. */
struct shape_ball {
    struct vector_value center;
    double radius;
};

/* A round bar, or a pipe when `inner` is not zero. */
struct shape_cylinder {
    struct vector_value from, to;
    double radius, inner;
};

/* What lies between two balls; a ring in 2-D. */
struct shape_shell {
    struct vector_value center;
    double inner, outer;
};

/* The side of a plane that the normal points away from. */
struct shape_half_space {
    struct vector_value point, normal;
};

/* The corners in their order; 2-D. */
struct shape_polygon {
    struct vector_list points;
};

/* A map of square sites, the highest row first, of which those with `letter` are the shape; 2-D. */
struct shape_template {
    struct name_list rows;
    char *letter;
    double site;
    struct vector_value from;
    int64_t seed;
    char *shuffled; /* the letters of all rows, computed from these; NULL: `rows` as they are */
};

/* The pixels of a picture whose grey value is in a range; 2-D. */
struct shape_image {
    char *file;
    double pixel;
    struct vector_value from, grey;
    struct pixels *pixels; /* of the file; one block of memory */
};

/* Discs or spheres at random places in a box. */
struct shape_packing {
    struct vector_value from, to;
    double fraction, radius, largest, gap; /* largest: NAN when not given */
    struct name_list periodic;
    int64_t seed;
    struct grains *grains; /* computed from these; one block of memory */
};

/* Grains that fill a box, but for gaps. */
struct shape_voronoi {
    struct vector_value from, to;
    double size, gap, fraction, picked; /* gap, fraction: NAN when not given */
    struct name_list periodic;
    int64_t seed;
    struct tessellation *grains; /* computed from these; one block of memory */
};

/* The walls of a honeycomb in a box; 2-D and 3-D. */
struct shape_honeycomb {
    struct vector_value from, to, center;
    double pitch, wall, angle; /* radians */
    int cells, along;
};

/* What a closed surface of triangles encloses; 3-D. */
struct shape_mesh {
    char *file;
    double unit; /* m */
    struct vector_value from;
    struct triangles *triangles; /* of the file; one block of memory */
    char said[MESH_TEXT];        /* what is wrong with the file */
};

struct shape_union {
    struct one_of_list shapes;
};

struct shape_intersection {
    struct one_of_list shapes;
};

/* The first shape without all others. */
struct shape_difference {
    struct one_of_list shapes;
};

/* Copies of a shape, moved by whole steps: count[axis] of them along each axis. Where `stagger` is
 * 1 + an axis, every second row of copies is shifted by half a step along it; 0: none is. */
struct shape_repeat {
    struct one_of shape;
    struct vector_value count, step;
    int stagger;
};

/* A shape turned by an angle (radians) about a line through `about` (count 0: the origin) along
 * `axis`. */
struct shape_rotate {
    struct one_of shape;
    double angle;
    struct vector_value about;
    int axis;
};

/* X(identifier, help): struct shape_<identifier>, shape_<identifier>_table,
 * shape_<identifier>_class. */
#define SHAPE_LIST(X)                                                        \
    X(box, "an interval, rectangle or block with faces normal to the axes")  \
    X(ball, "an interval, disc or ball about a center")                      \
    X(shell, "a ring or spherical shell about a center")                     \
    X(cylinder, "a round bar or pipe between two points; 3-D only")          \
    X(polygon, "the area within straight edges; 2-D only")                   \
    X(half_space, "one side of a plane, to cut other shapes with")           \
    X(template, "the sites of a map with a given letter; 2-D only")          \
    X(image, "the pixels of a PNG file in a range of grey; 2-D only")        \
    X(packing, "discs or spheres at random places in a box; 2-D and 3-D")    \
    X(voronoi, "convex grains that fill a box, with or without gaps")        \
    X(honeycomb, "the walls of a honeycomb of hexagons or squares in a box") \
    X(mesh, "what a closed surface of an STL file encloses; 3-D only")       \
    X(union, "all points that lie in at least one of a list of shapes")      \
    X(intersection, "all points that lie in every one of a list of shapes")  \
    X(difference, "the first of a list of shapes without the others")        \
    X(repeat, "copies of a shape at equal steps along the axes")             \
    X(rotate, "a rotated shape")

#define SHAPE_DECLARE(identifier, help)                         \
    extern const struct parameter shape_##identifier##_table[]; \
    extern const struct shape_class shape_##identifier##_class;
SHAPE_LIST(SHAPE_DECLARE)
#undef SHAPE_DECLARE

/* The coordinates of a case as a point; missing ones are zero. */
BOLIDE_INLINE struct vec3 vec3_of(const struct vector_value *value)
{
    return vec3_make(value->count > 0 ? value->at[0] : 0.0, value->count > 1 ? value->at[1] : 0.0,
                     value->count > 2 ? value->at[2] : 0.0);
}

/* Whether POINT is in the box, which has its low faces and not its high ones. */
BOLIDE_INLINE bool point_in_box(const struct vector_value *from, const struct vector_value *to,
                                struct vec3 point)
{
    const double at[3] = {point.x, point.y, point.z};
    assert(from->count <= 3);
    for (int axis = 0; axis < from->count; axis++)
        if (!(at[axis] >= from->at[axis] && at[axis] < to->at[axis]))
            return false;
    return true;
}

/* Marks the axes that NAMES lists; false when one is no axis of the DIMENSION. */
bool axes_of(const struct name_list *names, int dimension, bool marked[3]);

#endif
