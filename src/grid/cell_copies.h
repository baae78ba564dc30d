/* Copies of blocks of other ranks, where levels meet. A rank whose block has cells of another level
 * beside it has copies of all blocks of other ranks that touch this block, behind its own ones: so
 * it finds what is on the other side of a face of levels as one rank does that has all blocks. */
#ifndef BOLIDE_CELL_COPIES_H
#define BOLIDE_CELL_COPIES_H

#include "grid/cell_blocks.h"
#include "parallel/exchange.h"

struct cell_copies {
    int numbers;   /* of a cell */
    int32_t *sent; /* blocks that other ranks want, in the order of their items */
    double *came;  /* of each copy */
    struct exchange exchange;
};

/* Adds copies behind the blocks of CELLS, which have places: they get such, too, but no cells. */
struct error *cell_copies_add(struct cell_blocks *cells);

/* Collective: plans to send NUMBERS of each cell. */
struct error *cell_copies_plan(struct cell_copies *copies, const struct cell_blocks *cells,
                               int numbers);
void cell_copies_free(struct cell_copies *copies);

/* Sends to other ranks what they have copies of, of FIELD, as many arrays as there are numbers;
 * finish puts what comes into the places of copies. */
void cell_copies_start(struct cell_copies *copies, const struct cell_blocks *cells,
                       const double *const *field);
void cell_copies_finish(struct cell_copies *copies, const struct cell_blocks *cells,
                        double *const *field);

#endif
