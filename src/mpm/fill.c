/* How much of the space about each face particles fill, and the factor that follows for what pushes
 * through it; see transfer_faces.h.
 *
 * Where particles fill next to all of it, the factor is 1 over that: through the face goes a mean
 * of their stresses. Next to a free surface they fill a part, and push with that part of the
 * stress: the factor is 1. Between the two limits it goes from one to the other. */
#include <string.h>

#include "mpm/mpm_internal.h"

static const double filled_least = 0.8, filled_most = 0.9;

static double factor_of(double filled)
{
    const double part = (filled - filled_least) / (filled_most - filled_least);
    return 1.0 / (1.0 + (filled - 1.0) * minimum(1.0, maximum(0.0, part)));
}

/* The integral of |x| N over x, in cells, of the shape function of a node so many half cells TWICE
 * from the axis, or of the function of a face there: its distance but where it reaches over the
 * axis. */
static double ring_of(enum grid_shape shape, int64_t twice)
{
    const bool cubic = shape == SHAPE_CUBIC;
    switch (twice) {
    case 0:
        return cubic ? 7.0 / 15.0 : 13.0 / 32.0;
    case 1:
        return cubic ? 7.0 / 12.0 : 13.0 / 24.0;
    case 2:
        return cubic ? 61.0 / 60.0 : 193.0 / 192.0;
    default:
        return 0.5 * (double)twice;
    }
}

/* The integral of N sign(x) of a node: forces around the axis point away from it on both sides. */
static double ring_hoop(enum grid_shape shape, int64_t at)
{
    return at != 1 && at != -1 ? 1.0 : shape == SHAPE_CUBIC ? 11.0 / 12.0 : 23.0 / 24.0;
}

/* About the axis: the same for volumes, which grow with the radius, so that a uniform pressure
 * pushes through all faces by what their areas are, and around the axis by as much as these
 * differ. */
static void find_ring_factors(const struct mpm *mpm, int64_t at, double *fill)
{
    const enum grid_shape shape = (enum grid_shape)mpm->parameters.shape;
    for (int ahead = 0; ahead < 2; ahead++) {
        int64_t twice = 2 * at + ahead;
        for (int side = 0; side < 2; side++) {
            const int64_t plane = 2 * mpm->plane[0][side],
                          behind = side ? twice - plane : plane - twice;
            if (mpm->has_plane[0][side] && behind > 0)
                twice = 2 * plane - twice;
        }
        const double ring = ring_of(shape, twice);
        if (ahead)
            fill[0] = factor_of(fill[0] / (ring * mpm->edge)) * 0.5 * (double)twice / ring;
        else
            fill[1] = factor_of(fill[1] / (ring * mpm->edge));
    }
    const double hoop = ring_hoop(shape, at);
    fill[FILL_RING] = factor_of(fill[FILL_RING] / hoop) / hoop;
}

/* Adds what a face behind the wall SIDE across AXIS has to the one whose image it is. A face on the
 * wall has images of the same particles behind it. */
static void fold_face(const struct mpm *mpm, struct layer *layer, int axis, int side,
                      const int64_t at[3], int across, double *fill)
{
    const int dimension = layer->grid.dimension;
    const int64_t ahead = across == axis, plane = mpm->plane[axis][side],
                  behind = (2 * at[axis] + ahead - 2 * plane) * (side ? 1 : -1);
    /* what pushes away from an axis pushes the other way in an image */
    const double sign = across == FILL_RING && axis == 0 && dimension == 2 ? -1.0 : 1.0;
    if (behind == 0 && sign > 0.0)
        fill[across] *= 2.0;
    if (behind <= 0)
        return;
    int64_t image[3] = {at[0], at[1], at[2]};
    image[axis] = 2 * plane - at[axis] - ahead;
    double *onto = grid_node_at(&layer->grid, &layer->fill, image);
    if (onto)
        fill[across] = onto[across] += sign * fill[across];
}

/* Walls make what particles fill what they and their images do. */
static void fold(const struct mpm *mpm, struct layer *layer, int numbers)
{
    const int dimension = layer->grid.dimension;
    for (int axis = 0; axis < dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int32_t n = 0; n < layer->grid.blocks && mpm->has_plane[axis][side]; n++) {
                int64_t corner[3];
                grid_corner(&layer->grid, n, corner);
                if (!mpm_block_near_wall(mpm, layer, corner))
                    continue;
                for (int k = 0; k < BLOCK_CELLS; k++) {
                    int64_t at[3];
                    mpm_node_index(dimension, corner, k, at);
                    for (int across = 0; across < numbers; across++)
                        fold_face(mpm, layer, axis, side, at, across,
                                  grid_node(&layer->fill, n, k));
                }
            }
}

/* What particles of all layers fill of the faces of a node: one that bodies share is full when they
 * fill it together. The numbers stand at the nodes of the stresses, which need none. */
static void join_layers(struct mpm *mpm, const struct simulation *simulation, struct layer *layer,
                        int numbers)
{
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++) {
        int64_t corner[3], at[3];
        grid_corner(&layer->grid, n, corner);
        for (int k = 0; k < BLOCK_CELLS; k++) {
            double *all = grid_node(&layer->stress, n, k);
            memcpy(all, grid_node(&layer->fill, n, k), FILL_STRIDE * sizeof *all);
            mpm_node_index(layer->grid.dimension, corner, k, at);
            for (int g = 0; g < mpm->layers && layer->meets[n]; g++) {
                const struct layer *other = &mpm->layer[g];
                const double *more =
                    other == layer ? NULL : grid_node_at(&other->grid, &other->fill, at);
                for (int across = 0; across < numbers && more; across++)
                    all[across] += more[across];
            }
        }
    }
}

static void find_factors(const struct mpm *mpm, const struct simulation *simulation,
                         struct layer *layer)
{
    const bool round = simulation->problem->geometry == GEOMETRY_AXISYMMETRIC;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++) {
        int64_t corner[3], at[3];
        grid_corner(&layer->grid, n, corner);
        for (int k = 0; k < BLOCK_CELLS; k++) {
            double *fill = grid_node(&layer->fill, n, k);
            if (mpm->layers > 1)
                memcpy(fill, grid_node(&layer->stress, n, k), FILL_STRIDE * sizeof *fill);
            mpm_node_index(layer->grid.dimension, corner, k, at);
            if (round)
                find_ring_factors(mpm, at[0], fill);
            for (int across = 0; across < layer->grid.dimension && !round; across++)
                fill[across] = factor_of(fill[across]);
        }
    }
}

void mpm_push_faces(struct mpm *mpm, struct simulation *simulation)
{
    if (!mpm_is_by_faces(&mpm->parameters))
        return;
    mpm_exchange(mpm, simulation, offsetof(struct layer, fill));
    const int numbers = simulation->problem->dimension +
                        (simulation->problem->geometry == GEOMETRY_AXISYMMETRIC ? 1 : 0);
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
        for (int32_t n = 0; n < layer->grid.blocks; n++)
            grid_reduce(&layer->grid, &layer->fill, n);
        fold(mpm, layer, numbers);
    }
    for (int g = 0; g < mpm->layers && mpm->layers > 1; g++)
        join_layers(mpm, simulation, &mpm->layer[g], numbers);
    for (int g = 0; g < mpm->layers; g++)
        find_factors(mpm, simulation, &mpm->layer[g]);
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++)
            if (!mpm_is_far(mpm, layer, b)) {
                grid_spread(&layer->grid, &layer->fill, b);
                transfer_push(&transfer, b);
            }
    }
}
