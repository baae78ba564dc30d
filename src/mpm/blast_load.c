/* The load of a blast on the surface of a body, by the curves for TNT. */
#include <string.h>

#include "exact/kingery_curves.h"
#include "mpm/surface.h"

/* The pressure of a blast at a node with AREA, of which the images are a part: inside the body the
 * area is zero but for the disorder of particles, which counts for nothing. */
static double blast_pressure(const struct mpm *mpm, const struct surface *surface,
                             const int64_t at[3], const double *area, double mass)
{
    enum { NOISE = 50 }; /* area of a cell's face over that */
    const struct blast_input *blast = &surface->load->blast;
    const bool flat = surface->load->between.count > 0;
    const double sign = surface->load->side == WALL_HIGH ? 1.0 : -1.0;
    const double size = sqrt(square(area[0]) + square(area[1]) + square(area[2]));
    if (size == 0.0 || (!flat && size * mpm->edge * surface->density * NOISE < mass))
        return 0.0;
    double way = 0.0, along = 0.0;
    for (int axis = 0; axis < blast->at.count; axis++) {
        int64_t place = at[axis];
        for (int side = 0; side < 2; side++)
            if (mpm->has_plane[axis][side] &&
                (side == 0 ? place < mpm->plane[axis][side] : place > mpm->plane[axis][side]))
                place = 2 * mpm->plane[axis][side] - place;
        const double to = blast->at.at[axis] - mpm->edge * (double)place;
        const double normal = flat ? (axis == surface->axis ? sign : 0.0) : area[axis] / size;
        way += square(to);
        along += to * (place == at[axis] ? normal : -normal);
    }
    way = sqrt(way);
    return kingery_load((enum kingery_charge)blast->charge, blast->mass, way, along / way,
                        surface->time - blast->time);
}

/* Converts areas to forces. The normals of nodes near walls include the images; what is pushed
 * there are the particles alone. */
void mpm_push_blast(const struct mpm *mpm, struct layer *layer, const struct surface *surface,
                    int threads)
{
    for (int32_t w = 0; w < layer->walls; w++)
        memcpy(layer->wall[w].pushed, layer->wall[w].back, sizeof layer->wall[w].pushed);
    mpm_fold_vectors(mpm, layer, &layer->back);
    for (int32_t w = 0; w < layer->walls; w++) {
        struct wall_node *wall = &layer->wall[w];
        const double pressure =
            blast_pressure(mpm, surface, wall->at, wall->back, wall->node[NODE_MASS]);
        for (int c = 0; c < 3; c++)
            wall->pushed[c] *= -pressure;
    }
#pragma omp parallel for schedule(dynamic, 4) num_threads(threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++) {
        int64_t corner[3], at[3];
        grid_corner(&layer->grid, n, corner);
        for (int k = 0; k < BLOCK_CELLS; k++) {
            double *area = grid_node(&layer->back, n, k);
            mpm_node_index(layer->grid.dimension, corner, k, at);
            const double pressure =
                blast_pressure(mpm, surface, at, area, grid_node(&layer->main, n, k)[NODE_MASS]);
            for (int c = 0; c < 3; c++)
                area[c] *= -pressure;
        }
    }
    for (int32_t w = 0; w < layer->walls; w++)
        memcpy(layer->wall[w].back, layer->wall[w].pushed, sizeof layer->wall[w].pushed);
}
