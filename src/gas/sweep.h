/* Sweeps over strips: blocks that follow one another along an axis, whose cells make rows. For
 * files that are compiled once an instruction set, and for those that call them.
 *
 *   fields `from` of blocks, halo outside the strip
 *     | load_row
 *     v
 *   row: U, content --closure--> states W --limited slopes, half a step--> W on both sides of faces
 *     |                                                                      | closure: e, c
 *     |                                                                      v
 *     |                                        fluxes F <--Riemann solver-- sides
 *     |                                          |
 *     +-- U - dt/h (F above - F below) <---------+--> gas_through: ends of the strip, faces of
 *     | store_row                                     obstacles, the cut --> ledger, coupling
 *     v
 *   fields `to`, which become the state when all strips of all ranks are done (strips.c)
 *     | gas_look_at_block: closure
 *     v
 *   pressure, velocity, energy, sound --> time step, observers */
#ifndef BOLIDE_GAS_SWEEP_H
#define BOLIDE_GAS_SWEEP_H

#include "gas/lax_wendroff.h"
#include "grid/cell_halo.h"

/* Conserved numbers of a cell, and behind them the axes of strong shocks in it, as sweeps left
 * them; with two materials the mass per volume and the fraction of volume of the second, and the
 * mass per volume that has burnt in the air where it does. Sweeps write these. Behind them, where a
 * case has them: the fraction burnt of the explosive here, whether the cell is open, 1, or
 * blocked, 0, and p/(rho e) where markers divide two materials. */
enum {
    GAS_SHOCK = GAS_NUMBERS,
    GAS_SECOND,
    GAS_FRACTION,
    GAS_AFTERBURNT,
    GAS_FIELDS = GAS_AFTERBURNT + 4
};

/* What cells have, and where. */
struct gas_layout {
    bool two;               /* materials */
    bool afterburns;        /* the second burns in the first */
    bool lit;               /* one is an explosive that is lit */
    bool blocked;           /* some cells are */
    bool marked;            /* markers divide two materials */
    int explosive;          /* which of the materials is lit */
    int written;            /* fields that sweeps write */
    int burnt, open, gamma; /* where these fields are, -1: nowhere */
    int fields;             /* all of them */
};

/* A box of cells of the finest level, whose faces on SIDEs that are open a coupling watches: what
 * passes through each per area in a step, fluxes times the duration of sweeps, and of the second
 * material's mass. The faces across an axis lie in the order of cells, the lower of the two other
 * axes first. */
enum { GAS_PASSED = GAS_NUMBERS + 1 };
struct gas_cut {
    int64_t low[3], high[3]; /* its first cell along each axis, the one after its last */
    bool open[3][2];
    double *passed[3][2]; /* GAS_PASSED numbers a face; positive along the axis */
};

/* A sweep along an axis: what all strips share. */
struct gas_sweep {
    const struct cell_blocks *cells;
    const struct cell_halo *halo;
    struct gas_closure closure;
    const double *from[GAS_FIELDS];
    double *to[GAS_FIELDS];
    const struct gas_layout *layout;
    bool thaws; /* the second material is never colder than 0 K */
    int axis;
    double r;          /* dt/h of cells of level 0 */
    int round;         /* the power of the radius in a volume: 0 unless the axis is one */
    bool *shocked;     /* of each block, found: it has strong shocks */
    bool second_order; /* MUSCL-Hancock, else Lax-Wendroff */
    int riemann;       /* enum gas_riemann */
    struct lax_wendroff scheme;
    const struct gas_cut *cut; /* NULL: none */
    bool joins;                /* there are levels, which meet at ends of strips */
    double dt;
};

/* `count` blocks, one behind the other. */
struct gas_strip {
    const int32_t *block;
    int count;
    double part; /* the edge of a cell of level 0 over that of its cells */
    bool waits;  /* it needs planes */
    bool open;   /* of other ranks or faces, about which nothing is known before */
    bool bounds; /* what leaves it is booked: an end is a face of the domain, or it is a radius */
    bool calm;   /* no strong shocks are in it and beyond its ends, and none where it is written */
    bool sleeps; /* all of it and what is beyond its ends is one gas at rest: it stays as it is */
};

enum { STRIP_ROWS = 64, STRIP_BLOCKS = 8, STRIP_OBSTACLES = STRIP_ROWS * (ROW_CELLS + 2) };

/* Beside fluxes of conserved numbers, where levels meet in two materials: those of the second's
 * mass and volume, the speed of the face, and of what has burnt in the air. */
enum {
    THROUGH_SECOND = GAS_NUMBERS,
    THROUGH_VOLUME,
    THROUGH_SPEED,
    THROUGH_AFTERBURNT,
    THROUGH_NUMBERS
};

BOLIDE_INLINE int gas_numbers_through(const struct gas_layout *layout)
{
    return layout->afterburns ? THROUGH_NUMBERS : layout->two ? THROUGH_AFTERBURNT : GAS_NUMBERS;
}

/* What leaves a strip through its ends, per area and time: of each row, the lower of the two
 * other axes first; and through the faces of blocked cells, whose cell is the one on its low
 * side, counted from the strip's first, and whose flux counts for the gas on its SIDE, -1
 * below, 1 above. */
struct gas_through {
    double end[2][STRIP_ROWS][THROUGH_NUMBERS];
    double push[STRIP_ROWS][STRIP_BLOCKS]; /* along a radius: mean pressures, summed over a block */
    bool spent;                            /* some cell is left with hardly any density or energy */
    int obstacles;
    struct {
        int row, face, side;
        double flux[GAS_NUMBERS];
    } obstacle[STRIP_OBSTACLES];
};

/* Of a strip that sleeps, whose rows are alike, one row tells what leaves the others. */
void gas_sweep_strip(const struct gas_sweep *sweep, const struct gas_strip *strip,
                     struct gas_through *through);

/* Cells whose derived fields are to be found. */
struct gas_look {
    const struct cell_blocks *cells;
    struct gas_closure closure;
    uint16_t material[2];
    const double *u[GAS_FIELDS], *open; /* NULL: all cells are open */
    const struct gas_layout *layout;
    double *sound; /* m/s */
    int round;     /* the power of x in a volume */
};

/* The fastest |u_i| + c of a block, over the edge of its cells in those of level 0, and the cell
 * with it; a cell whose state is impossible comes
 * before all others, with a speed that is not a number. */
struct gas_fastest {
    double speed;
    int32_t cell;
    bool still; /* all its cells are open and hold one gas at rest */
};

/* Mass, velocity, energy, pressure and sound speed of the cells of block B. */
struct gas_fastest gas_look_at_block(const struct gas_look *look, int32_t b);

#endif
