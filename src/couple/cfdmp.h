/* The state of the solver cfdmp and the parts of its step. Private to couple/.
 *
 * Cells of the gas solver cover the whole domain. Material points cover a box of cells, the region,
 * whose faces within the domain are open. Inside the region the cells nearest to open faces, the
 * overlap, belong to both; those of the band behind get what the particles there have; cells
 * further in are blocked. What counts is the gas outside the region and the particles in it. */
#ifndef BOLIDE_CFDMP_H
#define BOLIDE_CFDMP_H

#include "couple/couple.h"
#include "couple/part.h"
#include "couple/smear.h"

/* Conserved numbers that pass from one part to the other: mass, momentum, energy, and the mass of
 * the gas solver's second material. */
enum { PASS_MASS, PASS_MOMENTUM, PASS_ENERGY = 4, PASS_SECOND, PASSES };

/* What a face of a cell in an open face of the region has. */
struct gate {
    double pressure;        /* mean of the step, Pa */
    double flow;            /* mass into the region in the step, kg */
    double push[4];         /* what gas has given as pressure: impulse and work */
    double pushed[4];       /* what particles have got of it */
    double uncovered[3];    /* area into the region that no particles cover, times the step */
    double pending[PASSES]; /* what has left one part and not come to the other */
    double rest;            /* pressure of the cell outside at the start, Pa */
    double booked[PASSES];  /* that of the end of the last step */
    double emitted;         /* layers of particles so far */
};

/* A cell of gas beside a gate. */
struct flank {
    double density, energy, pressure, sound, velocity[3], second, fraction;
};

/* On all ranks alike. */
struct side {
    struct gate *gate; /* in the order of struct gas_cut */
    int64_t gates;
    struct flank (*flank)[2]; /* of each gate, outside and inside: as cfdmp_look has left them */
    double (*rest)[PASSES];   /* of each: what a cell is to get, then what it cannot bear */
};

struct cfdmp {
    struct cfdmp_parameters parameters;
    struct coupled_part gas_part, mpm_part;
    struct gas *gas;
    struct mpm *mpm;
    double awake; /* 1 when the particles are computed; 0 while all around them is at rest */
    int dimension;
    bool round; /* x is a radius */
    double edge;
    struct gas_cut cut; /* the region */
    struct mpm_outside outside;
    struct side side[3][2];
    int64_t count[3];   /* cells of the region */
    int64_t band_cells; /* so many cells get what particles have */
    int64_t (*band)[3]; /* their places */
    int32_t *band_of;   /* of each cell of the region, its number among these; -1: none */
    int64_t own_from[3], own_to[3]; /* cells of the region between which this rank's of them lie, */
    uint64_t own_order;             /* for the order of blocks of gas with this number */
    struct crowd crowd;             /* what gives to them, and */
    struct smear_sums *sums;        /* how much */
    struct picked leaving;          /* particles */
    bool *changed;                  /* of each block of cells */
    struct mpm_push *push;          /* what this rank's nodes have got in this step */
    int64_t changed_capacity, sums_capacity, pushes, push_capacity;
    bool pushes_lost; /* for want of memory */
    double gauged[4]; /* what the ambient pressure pushed in this step, which forces leave out */
    int64_t *bits;    /* room for those of a side's numbers */
    const struct ranks *ranks;
    struct owned owned;
    struct part_maker maker;
};

/* Makes the cases of both parts, and their solvers; finds the region. */
struct error *cfdmp_make_parts(struct cfdmp *cfdmp, struct simulation *simulation);
void cfdmp_free_parts(struct cfdmp *cfdmp);

/* The depth of the band behind the overlap, in cells: sweeps along each axis look two ahead. */
int64_t cfdmp_band_depth(int dimension);

/* The places along AXIS between which the gas computes no cells, behind the band; the second may be
 * below the first. */
void cfdmp_blocked(const struct cfdmp *cfdmp, int axis, int64_t at[2]);

/* The region, from the case, in cells of the domain of CELLS; then whether all bodies and obstacles
 * of the case may be where they are. */
struct error *cfdmp_find_region(struct cfdmp *cfdmp, const struct simulation_case *input,
                                const struct cell_blocks *cells);
/* As solver_class says. */
void cfdmp_count(const void *parameters, const struct simulation_case *input,
                 struct counted *counted);
/* Where solids must stay, infinite where nothing bounds them. */
struct bounds cfdmp_room(const struct cfdmp_parameters *parameters,
                         const struct simulation_case *input);
struct error *cfdmp_check_region(const struct cfdmp *cfdmp, const struct simulation_case *input);

/* Collective: cells beside gates as they are now; COUNT numbers of which each is zero on all ranks
 * but one become that one's; what nodes of all ranks have got in this step of the particles. */
void cfdmp_look(struct cfdmp *cfdmp);
void cfdmp_unite(const struct cfdmp *cfdmp, double *values, int64_t count);
struct error *cfdmp_gather_pushes(struct cfdmp *cfdmp);

/* Collective: the cells of the band take what the particles there have. */
struct error *cfdmp_fill_band(struct cfdmp *cfdmp);

/* Collective, before and after the particles' step of DT: what has passed as pressure, and what
 * material has. */
void cfdmp_find_pressures(struct cfdmp *cfdmp, double dt);
struct error *cfdmp_transport(struct cfdmp *cfdmp, struct simulation *simulation, double dt);

/* Collective: notes the pressures outside the region at the start; whether they have changed so far
 * that the particles must be computed. */
void cfdmp_note_rest(struct cfdmp *cfdmp);
bool cfdmp_stirs(const struct cfdmp *cfdmp);
/* What the gas has pushed in a step while the particles rest. */
void cfdmp_lean(struct cfdmp *cfdmp, struct simulation *simulation);

/* Collective: the gates note what particles have got in their step, and on what area. */
struct error *cfdmp_take_pushes(struct cfdmp *cfdmp);
/* Takes from the pushes of the gates what acts on area without particles, and passes it on to where
 * it belongs, see uncovered.c. */
void cfdmp_share_uncovered(struct cfdmp *cfdmp, struct simulation *simulation);

/* Has the gas push on the particles through the open faces of the region. */
void cfdmp_surround(struct cfdmp *cfdmp);

/* The gate of the face across AXIS on SIDE next to the cell AT, clamped to the region. */
struct gate *cfdmp_gate(struct cfdmp *cfdmp, int axis, int side, const int64_t at[3]);

#endif
