/* The points of a snapshot, see mesh.h. */
#include "output/mesh.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "grid/cell_blocks.h"

/* Points of a block along AXIS. */
static int64_t points_along(const struct mesh *mesh, const struct cell_block *block, int axis)
{
    return axis < mesh->population->dimension ? block->count[axis] + 1 : 1;
}

static struct error *find_points(struct mesh *mesh)
{
    const struct population *p = mesh->population;
    if (p->kind != POPULATION_OF_CELLS) {
        mesh->own = p->count;
        return NULL;
    }
    mesh->first = memory_allocate(((size_t)p->blocks + 1) * sizeof *mesh->first);
    if (!mesh->first)
        return out_of_memory_for("a snapshot");
    for (int32_t b = 0; b < p->blocks; b++) {
        mesh->first[b] = mesh->own;
        mesh->own += points_along(mesh, &p->block[b], 0) * points_along(mesh, &p->block[b], 1) *
                     points_along(mesh, &p->block[b], 2);
    }
    return NULL;
}

struct error *mesh_make(const struct ranks *ranks, const struct population *population,
                        struct mesh *mesh)
{
    *mesh = (struct mesh){
        .population = population,
        .corners = population->kind == POPULATION_OF_CELLS ? 1 << population->dimension : 1};
    TRY(ranks_agree(ranks, find_points(mesh)));
    mesh->before = ranks_before(ranks, mesh->own);
    mesh->total = ranks_sum(ranks, mesh->own);
    return NULL;
}

void mesh_free(struct mesh *mesh) { free(mesh->first); }

void mesh_fill_points(const void *of, int64_t begin, int64_t end, void *out)
{
    const struct mesh *mesh = of;
    const struct population *p = mesh->population;
    double(*point)[3] = out;
    if (!mesh->first) {
        memcpy(point, p->position + begin, (size_t)(end - begin) * sizeof *point);
        return;
    }
    int32_t b = 0;
    while (b + 1 < p->blocks && mesh->first[b + 1] <= begin)
        b++;
    for (int64_t i = begin; i < end; i++, point++) {
        while (b + 1 < p->blocks && mesh->first[b + 1] <= i)
            b++;
        const double edge = p->edge * (double)(1 << p->block[b].level);
        int64_t rest = i - mesh->first[b];
        for (int axis = 0; axis < 3; axis++) {
            const int64_t along = points_along(mesh, &p->block[b], axis),
                          plane = p->block[b].corner[axis] + rest % along;
            (*point)[axis] = axis < p->dimension ? (double)plane * edge : 0.0;
            rest /= along;
        }
    }
}

void mesh_fill_corners(const void *of, int64_t begin, int64_t end, void *out)
{
    const struct mesh *mesh = of;
    const struct population *p = mesh->population;
    int64_t *corner = out;
    int32_t b = 0;
    for (int64_t i = begin; i < end; i++) {
        if (!mesh->first) {
            *corner++ = mesh->before + i;
            continue;
        }
        while (i >= p->block[b].first + cell_block_cells(&p->block[b]))
            b++;
        const struct cell_block *block = &p->block[b];
        const int64_t cell = i - block->first, row = points_along(mesh, block, 0),
                      sheet = row * points_along(mesh, block, 1);
        const int64_t low = mesh->before + mesh->first[b] + cell % block->count[0] +
                            row * (cell / block->count[0] % block->count[1]) +
                            sheet * (cell / block->count[0] / block->count[1]);
        for (int k = 0; k < mesh->corners; k++)
            *corner++ = low + (k & 1) + row * (k >> 1 & 1) + sheet * (k >> 2 & 1);
    }
}
