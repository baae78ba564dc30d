/* Neighbour rows: for each particle the particles and images that may come within its support
 * before the rows are built again.
 *
 * The support of a pair is the sum of the two particles' reaches, reach = smoothing * diameter. A
 * row holds every neighbour nearer than that sum times (1 + skin), sorted by (part, id, image), so
 * that what a pair loop adds up, and in which order, does not depend on storage, on the age of the
 * rows or on the skin, once the loop has dropped those out of support.
 *
 * Most of a row is skin. So near rows are kept beside the rows, of the entries nearer than (1 +
 * near skin) times the support, in the same order: found from the rows, which is cheap, whenever
 * they no longer hold, and walked instead. */
#ifndef BOLIDE_NEIGHBOURS_H
#define BOLIDE_NEIGHBOURS_H

#include "parallel/ghosts.h"
#include "particle/contact_law.h"
#include "particle/particles.h"

/* The two top bits of a row's entry say which part of the row it belongs to, the others which
 * record: an owned particle below count, a ghost above. */
enum { ENTRY_PART_SHIFT = 30 };
#define ENTRY_INDEX 0x3fffffffu
enum entry_part {
    PART_LAW = 1,   /* the two bodies have a contact law of their own, or started apart */
    PART_IMAGE = 2, /* the neighbour is an image behind a wall */
};

/* Which bodies meet under a law of their own, or started apart. */
struct contact_groups {
    const uint8_t *of_body; /* group of each body */
    const uint8_t *law;     /* groups x groups, zero where there is none */
    int groups;
    const uint16_t *cluster; /* of each body: those in contact at the start; NULL: all in one */
};

/* Where a row stands: entries row[begin] .. row[begin + count - 1] of a segment. */
struct row {
    uint32_t begin_low;
    uint16_t begin_high; /* begin = begin_high << 32 | begin_low */
    uint16_t segment;
    uint32_t count;
};

struct segment {
    uint32_t *entry;
    int64_t capacity, count;
};

/* The same of near rows. */
struct near_row {
    int64_t begin;
    uint32_t count;
};

struct block_motion;

struct neighbours {
    double skin, near_skin; /* relative to the support; no near rows when the latter is zero */
    bool near;              /* near rows are walked; */
    bool prune;             /* but who walks them must find them first, block by block */
    int near_steps, rest;   /* steps that near rows have held; that none are wanted */
    int32_t count;
    int64_t row_capacity;
    struct row *row; /* one a particle */
    uint8_t *outer;  /* of each block: a row needs records of other ranks; NULL for a rank alone */
    int64_t outer_capacity;
    int segments; /* one a thread */
    struct segment *segment;
    struct ghosts ghosts;
    int64_t builds;
    uint64_t order; /* the store's order that the rows speak of */

    /* When the rows were built: places, reaches, and what the blocks need to judge them by. */
    int64_t reference_capacity;
    double (*origin)[3], *origin_reach;
    struct block_motion *motion;

    /* The same for the near rows; and these, those of a block one behind the other in the room of
     * its rows. */
    int64_t near_reference_capacity, near_row_capacity, near_capacity, near_block_capacity;
    double (*near_origin)[3], *near_reach;
    struct near_row *near_row;
    uint32_t *near_entry;
    int64_t *near_block; /* where that room begins */
};

/* Of the particles: what the rows follow from. */
struct reach {
    const double *diameter;
    double smoothing; /* reach = smoothing * diameter */
};

/* Collective: builds all rows and the plan of ghosts, with THREADS threads, in the scratch of the
 * store, which must be distributed. */
struct error *neighbours_build(struct neighbours *neighbours, struct particles *particles,
                               struct reach reach, const struct mirrors *mirrors,
                               const struct contact_groups *groups, int threads);

/* Collective: true while every pair within support is certain to be in the rows: judged block by
 * block from the motion of neighbouring blocks against each other, so that common motion costs
 * nothing. Where it is the near rows that no longer hold, asks for new ones (`prune`). */
bool neighbours_hold(struct neighbours *neighbours, const struct particles *particles,
                     struct reach reach, int threads);

void neighbours_free(struct neighbours *neighbours);

/* Bytes held, for reports. */
size_t neighbours_bytes(const struct neighbours *neighbours);

/* Whether the rows of block B need nothing that other ranks send. */
BOLIDE_INLINE bool neighbours_inner(const struct neighbours *n, int32_t b)
{
    return !n->outer || !n->outer[b];
}

BOLIDE_INLINE const uint32_t *neighbours_row(const struct neighbours *n, int32_t i)
{
    struct row row = n->row[i];
    return n->segment[row.segment].entry + ((int64_t)row.begin_high << 32 | row.begin_low);
}

/* The entries that a loop walks, which include all neighbours within support. */
BOLIDE_INLINE const uint32_t *neighbours_walk(const struct neighbours *n, int32_t i, int *count)
{
    *count = (int)(n->near ? n->near_row[i].count : n->row[i].count);
    return n->near ? n->near_entry + n->near_row[i].begin : neighbours_row(n, i);
}

#endif
