/* The particle store: every field of the particles that a rank owns, one array each, sorted by
 * block.
 *
 * Fields are declared in tables: the core's here, a solver's by the solver. Allocation, sorting,
 * checkpoints and snapshots are loops over them. Positions and vectors have three components in
 * every dimension, symmetric tensors six (xx, yy, zz, xy, yz, zx). Only owned particles are here;
 * images behind mirror walls exist as the solver's records alone (neighbours.h). */
#ifndef BOLIDE_PARTICLES_H
#define BOLIDE_PARTICLES_H

#include "base/field.h"
#include "base/memory.h"
#include "base/vector.h"
#include "material/history.h"
#include "parallel/block.h"
#include "parallel/exchange.h"
#include "parallel/partition.h"
#include "parallel/ranks.h"

enum { PARTICLES_FIELDS = 64 };

struct particles {
    const char *name; /* of its arrays in a checkpoint: "particles" unless told */
    int dimension;
    int32_t count, pending; /* owned; appended since the last commit, behind them */
    int32_t deleted;        /* marked since then */
    int64_t capacity;
    int32_t blocks;
    int64_t block_capacity;
    struct block *block;
    const struct ranks *ranks; /* that have particles of the run; this process alone unless told */
    struct partition *partition; /* of the run; NULL: this process has all blocks */
    double cell;                 /* edge of a cell of the global grid, m; fixed for a run */
    double shift; /* of the grid: cell 0 begins at minus this along each axis, m; fixed likewise */
    const int *threads; /* how many sort: the run's; 1 unless told */
    /* for sorting, and for who has no need of what it holds when particles are sorted */
    struct scratch scratch;
    uint64_t order; /* grows with every sort: an index means the same particle while it stays */
    int fields;
    struct field field[PARTICLES_FIELDS];

    /* The core's fields, as field[].data. */
    uint64_t *id;
    uint16_t *material, *body;
    double *mass, *density, *energy, *pressure;
    double (*position)[3], (*velocity)[3], (*deviator)[6];
    double *plastic_strain;
    double *history[POINT_HISTORY]; /* by slot, NULL where no material of the case needs it */
};

/* HISTORY of particle I, zero where the store has none; and back. Hot: as loops, which compilers
 * leave them where there are many slots, they take twice the instructions. */
BOLIDE_INLINE void particle_load_history(const struct particles *particles, int32_t i,
                                         double history[POINT_HISTORY])
{
    BOLIDE_UNROLL
    for (int slot = 0; slot < POINT_HISTORY; slot++)
        history[slot] = particles->history[slot] ? particles->history[slot][i] : 0.0;
}

BOLIDE_INLINE void particle_keep_history(const struct particles *particles, int32_t i,
                                         const double history[POINT_HISTORY])
{
    BOLIDE_UNROLL
    for (int slot = 0; slot < POINT_HISTORY; slot++)
        if (particles->history[slot])
            particles->history[slot][i] = history[slot];
}

/* An empty store of a run in DIMENSION dimensions, with the core's fields and COUNT more. CELL is
 * the edge of a grid cell in metres. */
struct error *particles_create(int dimension, double cell, const struct field_declaration *more,
                               int count, struct particles *particles);
void particles_destroy(struct particles *particles);

/* Adds COUNT fields to a store that never had a particle. */
void particles_declare(struct particles *particles, const struct field_declaration *more,
                       int count);

/* The data of field NAME; the field must exist. The pointer holds until the next append or
 * commit. */
void *particles_field(const struct particles *particles, const char *name);

/* Makes room for COUNT new particles behind the old; *first is the index of the first. They are
 * zeroed, and count as particles from the next commit on. */
struct error *particles_append(struct particles *particles, int32_t count, int32_t *first);

/* Marks a particle for deletion at the next commit. */
void particles_delete(struct particles *particles, int32_t index);
/* Whether it is marked so. */
bool particles_is_deleted(const struct particles *particles, int32_t index);

/* Takes appended particles in and deleted ones out, then sorts. */
struct error *particles_commit(struct particles *particles);

/* Sorts all fields by (block, material, cell, id) and finds the blocks anew. A block is a cube of
 * 64 cells (64, 8 x 8, 4 x 4 x 4) of the global grid, whose origin is the origin of space. */
struct error *particles_sort(struct particles *particles);

/* What that needs for a while, bytes a particle of the scratch. */
size_t particles_sort_bytes(void);

/* Stores the particles in the order of LIST instead, which has found all of their BLOCKS. */
struct error *particles_arrange(struct particles *particles, const int32_t *list,
                                const struct block *block, int32_t blocks);

/* Collective: moves every particle to the rank that owns its block, then sorts. Where the ranks'
 * work since the cut differs by too much, and with RECUT in any case, the blocks are divided
 * anew. */
struct error *particles_distribute(struct particles *particles, bool recut);

/* Collective: the COUNT particles LEAVING, which the list may not repeat, go to the ranks that it
 * names. Storage stays as it is, but those that come are in their places or behind the last, and
 * the last are where others have left: quick where few go. */
struct error *particles_hand_over(struct particles *particles, struct send_item *leaving,
                                  int32_t count);

/* The key of the block that X lies in. */
uint64_t particles_block_key(const struct particles *particles, const double x[3]);

/* Loads or saves: count first, then every STATE field, as "particles/FIELD". */
struct error *particles_visit(struct particles *particles, struct visitor *visitor);

/* Collective: one number for the bits of all STATE fields, whatever the order of storage. */
uint64_t particles_hash(const struct particles *particles);

/* Bytes that the store holds for each particle. */
size_t particles_bytes(const struct particles *particles);

#endif
