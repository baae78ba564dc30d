/* A closed surface of triangles, and what it encloses. */
#ifndef BOLIDE_TRIANGLES_H
#define BOLIDE_TRIANGLES_H

#include "shape/shape.h"
#include "shape/shells.h"

/* One block of memory; free() it. Columns along x cover the surface, and each lists the triangles
 * that it may meet. */
struct triangles {
    int64_t count;
    struct bounds bounds;
    int64_t columns[2]; /* along y and z */
    int64_t most;       /* triangles of a column */
    double (*corners)[3][3];
    int64_t *start,
        *list; /* those of a column are list[start[column]] .. list[start[column + 1]] */
    int32_t shells, *shell;  /* how many, and that of each triangle, by which they are sorted */
    struct shell_nest *nest; /* of each shell */
};

/* Room for a message on a mesh. */
enum { MESH_TEXT = 320 };

/* Makes *made of COUNT triangles, or says why they enclose nothing: static text, or SAID, of
 * MESH_TEXT characters. Each edge of a closed surface belongs to two triangles, or an even number;
 * corners are the same when their coordinates are. Triangles without area are left out. */
const char *triangles_make(const float (*corners)[3][3], int64_t count, char *said,
                           struct triangles **made);

/* Whether POINT is enclosed: a ray from it crosses a surface an odd number of times; of several
 * surfaces, see shells.h. */
bool triangles_hold(const struct triangles *triangles, struct vec3 point);

/* Makes *made of the bytes of an STL file, binary or text, which end with a null character after
 * SIZE; or says what is wrong with them, and in which line or facet, as triangles_make does. */
const char *stl_read(const char *bytes, size_t size, char *said, struct triangles **made);

#endif
