/* What touches across periodic faces. Blocks lie on a grid that does not repeat with the period:
 * the image of one touches up to four others along the axis, and so do groups; see
 * block_motion.h. */
#include <stdlib.h>

#include "base/memory.h"
#include "parallel/periodic.h"
#include "particle/block_motion.h"

/* Cubes whose gap is an edge, but for rounding, do touch. */
static const double margin = 1.0 + 1e-9;

bool motion_blocks_across(const struct particles *p, struct near_walls walls, const int64_t own[3],
                          image_code image, int64_t low[3], int64_t high[3], double shift[3])
{
    const double edge = block_edge(p);
    for (int axis = 0; axis < 3; axis++) {
        const int along = image_along(image, axis);
        const double begin = (double)own[axis] * edge, end = begin + edge;
        shift[axis] = 0.0;
        low[axis] = own[axis] - (axis < p->dimension);
        high[axis] = own[axis] + (axis < p->dimension);
        if (!along)
            continue;
        if (axis >= p->dimension || !images_repeat(walls.mirrors, axis))
            return false;
        const double from_low = begin - walls.mirrors->low[axis],
                     from_high = walls.mirrors->high[axis] - end;
        if (!((along == 1 ? from_low : from_high) < margin * walls.distance))
            return false;
        shift[axis] = image_place(walls.mirrors, along, axis, 0.0);
        const int64_t first = (int64_t)floor((begin + shift[axis]) / edge);
        low[axis] = first - 2;
        high[axis] = first + 2;
    }
    return true;
}

static bool add_pair(struct seam *seam, int64_t own, int64_t other)
{
    if (!memory_reserve((void **)&seam->pair, &seam->capacity, seam->count + 1, seam->count,
                        sizeof *seam->pair))
        return false;
    seam->pair[seam->count++] = (struct seam_pair){(int32_t)own, (int32_t)other};
    return true;
}

/* Where group G of the block at AT begins, in groups. */
static void group_corner(int dimension, const int64_t at[3], int g, int64_t corner[3])
{
    const int along = groups_along(dimension);
    for (int axis = 2; axis >= 0; axis--) {
        corner[axis] = 0;
        if (axis >= dimension)
            continue;
        corner[axis] = at[axis] * along + g % along;
        g /= along;
    }
}

static bool groups_touch(const struct particles *p, const int64_t own[3], const int64_t other[3],
                         const double shift[3])
{
    const double edge = group_edge(p);
    bool touch = true;
    for (int axis = 0; axis < p->dimension; axis++)
        touch = touch && fabs((double)(own[axis] - other[axis]) * edge + shift[axis]) <
                             (shift[axis] != 0.0 ? 2.0 * margin : 1.5) * edge;
    return touch;
}

/* A block and its place. */
struct placed {
    int32_t block;
    int64_t at[3];
};

/* The groups of an image of OWN, SHIFT away, that touch those of OTHER. */
static bool list_groups(struct block_motion *motion, const struct particles *p, struct placed own,
                        struct placed other, const double shift[3])
{
    int64_t corner[3], beside[3];
    bool room = true;
    for (int g = 0; g < motion->groups && room; g++) {
        const int64_t of_own = (int64_t)own.block * motion->groups + g;
        if (!motion->group[of_own].any)
            continue;
        group_corner(p->dimension, own.at, g, corner);
        for (int h = 0; h < motion->groups && room; h++) {
            group_corner(p->dimension, other.at, h, beside);
            if (groups_touch(p, corner, beside, shift))
                room = add_pair(&motion->group_seam, of_own,
                                (int64_t)other.block * motion->groups + h);
        }
    }
    return room;
}

/* What image IMAGE of OWN touches. */
static bool list_image(struct block_motion *motion, const struct particles *p,
                       struct near_walls walls, struct placed own, image_code image)
{
    struct placed other;
    int64_t low[3], high[3];
    double shift[3];
    bool room = true;
    if (!motion_blocks_across(p, walls, own.at, image, low, high, shift))
        return true;
    for (other.at[0] = low[0]; other.at[0] <= high[0]; other.at[0]++)
        for (other.at[1] = low[1]; other.at[1] <= high[1]; other.at[1]++)
            for (other.at[2] = low[2]; other.at[2] <= high[2]; other.at[2]++) {
                other.block = motion_block_of(motion, p, block_key(other.at));
                if (other.block < 0)
                    continue;
                room = room && add_pair(&motion->block_seam, own.block, other.block);
                if (motion->judged == BY_GROUPS)
                    room = room && list_groups(motion, p, own, other, shift);
            }
    return room;
}

struct error *motion_list_seams(struct block_motion *motion, const struct particles *p,
                                struct near_walls walls)
{
    bool room = true;
    motion->block_seam.count = motion->group_seam.count = 0;
    for (int32_t b = 0; b < p->blocks && motion->periodic && room && motion->judged != BY_ALL;
         b++) {
        struct placed own = {.block = b};
        block_coordinates(p->block[b].key, own.at);
        for (int image = 1; image < IMAGE_CODES && room; image++)
            room = list_image(motion, p, walls, own, (image_code)image);
    }
    return room ? NULL : motion_out_of_memory();
}
