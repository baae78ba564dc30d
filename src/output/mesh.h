/* The points of a snapshot and the members between them: a particle is a point, a cell has corners,
 * which it shares with the cells of its block. A block is the same on any number of ranks, so the
 * mesh is too. */
#ifndef BOLIDE_MESH_H
#define BOLIDE_MESH_H

#include "model/population.h"
#include "parallel/ranks.h"

struct mesh {
    const struct population *population;
    int corners;                /* of a member */
    int64_t own, before, total; /* points of this rank, of those before it, and of all */
    int64_t *first;             /* of each block of cells, its first point among this rank's */
};

/* Collective. */
struct error *mesh_make(const struct ranks *ranks, const struct population *population,
                        struct mesh *mesh);
void mesh_free(struct mesh *mesh);

/* Of MESH: three coordinates of each of this rank's points BEGIN .. END - 1; the points of the
 * corners of each of its members, as VTK orders those of lines, pixels and voxels. */
void mesh_fill_points(const void *mesh, int64_t begin, int64_t end, void *out);
void mesh_fill_corners(const void *mesh, int64_t begin, int64_t end, void *out);

#endif
