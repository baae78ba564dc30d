/* What a closed surface of triangles encloses, from an STL file; 3-D. */
#include <stdlib.h>

#include "base/file.h"
#include "shape/kinds.h"
#include "shape/triangles.h"

const struct parameter shape_mesh_table[] = {
    PARAMETER(TEXT, struct shape_mesh, file, REQUIRED,
              "an STL file, binary or text, from this file's folder; surfaces within others are "
              "cavities, and those that overlap are joined",
              .is_path = true),
    PARAMETER(NUMBER, struct shape_mesh, unit, REQUIRED,
              "the length that the number 1 of the file means, such as 1 mm", .unit = "m",
              .above = 0.0, .below = INFINITY),
    PARAMETER(VECTOR, struct shape_mesh, from, OPTIONAL,
              "where the origin of the file lies; default: at the origin", .unit = "m",
              .owned = offsetof(struct shape_mesh, triangles)),
    PARAMETER_END,
};

static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_mesh *mesh = shape;
    const struct vec3 at = vec3_sub(point, vec3_of(&mesh->from));
    return triangles_hold(mesh->triangles, vec3_scale(1.0 / mesh->unit, at));
}

/* A point where there is no mesh. */
static struct bounds bounds(const void *shape)
{
    const struct shape_mesh *mesh = shape;
    const struct vec3 from = vec3_of(&mesh->from);
    if (!mesh->triangles)
        return (struct bounds){from, from};
    const struct bounds *own = &mesh->triangles->bounds;
    return (struct bounds){vec3_add(from, vec3_scale(mesh->unit, own->low)),
                           vec3_add(from, vec3_scale(mesh->unit, own->high))};
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_mesh *mesh = shape;
    if (dimension != 3 || (mesh->from.count != 0 && mesh->from.count != 3))
        return "a mesh needs three dimensions, and three numbers in `from`";
    return NULL;
}

static const char *prepare(void *shape, int dimension)
{
    (void)dimension;
    struct shape_mesh *mesh = shape;
    if (mesh->triangles)
        return NULL;
    enum { MOST_BYTES = 1 << 30 };
    char *content;
    size_t size;
    const char *text = file_read_input(mesh->file, MOST_BYTES, &content, &size);
    if (!text)
        text = stl_read(content, size, mesh->said, &mesh->triangles);
    free(content);
    return text;
}

static double work(const void *shape)
{
    const struct triangles *triangles = ((const struct shape_mesh *)shape)->triangles;
    return triangles ? (double)triangles->most : 1.0;
}

const struct shape_class shape_mesh_class = {inside, bounds, wrong, NULL, work, prepare, NULL};
