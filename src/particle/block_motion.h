/* How blocks of particles have moved since neighbour rows were built: what is noted then, and what
 * other ranks note of blocks that touch. By this neighbours_hold.c judges whether rows hold.
 * Private to this module. */
#ifndef BOLIDE_BLOCK_MOTION_H
#define BOLIDE_BLOCK_MOTION_H

#include "parallel/block.h"
#include "particle/halo.h"

/* A group or a block since the rows were built. */
struct moved {
    bool any;              /* it has particles */
    double smallest_reach; /* at building, */
    double smallest_near;  /* and when the near rows were found */
    double low[3];         /* nearest to each low wall, at building; NAN without wall */
    double high[3];
    unsigned walls; /* bit 2 axis + side: had images behind this wall */
    double mean[3], spread, growth, largest_reach; /* now */
};

/* A group or block of ours and one that touches an image of it across periodic faces. */
struct seam_pair {
    int32_t own, other;
};
struct seam {
    struct seam_pair *pair;
    int64_t capacity;
    int64_t count;
};

enum { GROUPS_MAX = 32, TOUCHING_MAX = 27 };

struct block_motion {
    int groups; /* of a block: 32, 4 x 4, 2 x 2 x 2 */
    int64_t block_capacity, group_capacity, touching_capacity, group_of_capacity;
    struct moved *block,
        *group; /* one a block; `groups` a block; behind ours the others' that touch them */
    struct exchange exchange; /* of blocks that touch those of other ranks */
    uint64_t *far_key;        /* of the blocks that come, sorted */
    int32_t (
        *touching)[TOUCHING_MAX]; /* blocks that touch, by offset, itself included; -1 for none */
    struct seam block_seam, group_seam;
    struct mirrors mirrors; /* of the build */
    bool periodic;          /* along an axis of them */
    uint8_t *group_of;      /* group of each particle within its block */
    /* What the motion up to the finding of near rows has taken of the room that those have who are
     * no neighbours: the approach of blocks that touch, of others, and the negative of the distance
     * left from a wall. */
    double taken_approach, taken_apart, taken_wall;
    /* and the distance left between particles that do not see each other across periodic faces */
    double taken_seam;
    double distance;                              /* of the plan of images */
    enum { BY_GROUPS, BY_BLOCKS, BY_ALL } judged; /* by the smallest that supports fit into */
};

/* Groups along each axis of a block; the edges of both. */
BOLIDE_INLINE int groups_along(int dimension) { return block_cells(dimension) / 2; }
BOLIDE_INLINE double group_edge(const struct particles *p) { return 2.0 * p->cell; }
BOLIDE_INLINE double block_edge(const struct particles *p)
{
    return p->cell * block_cells(p->dimension);
}

struct error *motion_out_of_memory(void);

/* The key of the block at offset K, 0 .. TOUCHING_MAX - 1, of the one at OWN; false for an offset
 * that the dimension does not have. And the order of a key and a thing that begins with one. */
bool motion_key_beside(int dimension, const int64_t own[3], int k, uint64_t *key);
int motion_compare_key(const void *key, const void *far);

/* The index of the block of KEY, those of other ranks behind ours; -1: there is none. */
int32_t motion_block_of(const struct block_motion *motion, const struct particles *p, uint64_t key);

/* The blocks from LOW to HIGH may touch image IMAGE, SHIFT away, of the block at OWN. False where
 * the block lies far from the periodic faces that the image is of, and where it is of walls. */
bool motion_blocks_across(const struct particles *p, struct near_walls walls, const int64_t own[3],
                          image_code image, int64_t low[3], int64_t high[3], double shift[3]);

/* Lists in `block_seam` and `group_seam` what touches across periodic faces. */
struct error *motion_list_seams(struct block_motion *motion, const struct particles *p,
                                struct near_walls walls);

/* Collective: plans the exchange of blocks that touch those of other ranks, and learns the keys of
 * those that come; and brings how these have moved behind ours. */
struct error *motion_meet(struct block_motion *motion, const struct particles *p,
                          struct near_walls walls, const struct halo *halo);
void motion_meet_again(struct block_motion *motion, const struct particles *p);

/* Collective: takes down places and reaches at the time of building; images were planned near
 * WALLS, the blocks of all ranks are those of HALO. */
struct error *motion_start(struct neighbours *neighbours, const struct particles *particles,
                           struct reach reach, struct near_walls walls, const struct halo *halo,
                           int threads);
void motion_free(struct neighbours *neighbours);

/* Asks for near rows and takes down places and reaches, if they are wanted now. */
void motion_start_near(struct neighbours *neighbours, const struct particles *particles,
                       struct reach reach, int threads);
BOLIDE_INLINE bool near_wanted(const struct neighbours *n)
{
    return n->near_skin > 0.0 && n->rest == 0;
}

#endif
