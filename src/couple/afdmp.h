/* The state of the solver afdmp and the parts of its run. Private to couple/.
 *
 * A run has up to three stages, each computed by one part. Detonation: material points in a box
 * around the charges, the nest, until all of them have burnt. Propagation: gas on a grid in the
 * whole domain but the region, a box around the solids, which is at rest; until a wave comes to the
 * region. Interaction: material points everywhere. What counts is the part that computes, and what
 * is at rest: the region until the last stage, and in the first the gas outside the nest. */
#ifndef BOLIDE_AFDMP_H
#define BOLIDE_AFDMP_H

#include "couple/couple.h"
#include "couple/part.h"

enum afdmp_stage { AFDMP_DETONATION = 1, AFDMP_PROPAGATION, AFDMP_INTERACTION };

/* The cells beside the open faces of a box, outside it, and their pressures at the start, Pa, which
 * all ranks have. */
struct afdmp_rim {
    double *rest;
    int64_t cells, *bits; /* as many */
};

struct afdmp {
    struct afdmp_parameters parameters;
    double stage;                       /* enum afdmp_stage, as checkpoints have it */
    struct coupled_part nest, gas_part; /* of the first two stages; */
    struct coupled_part last;           /* of the last, and the region's before it */
    struct mpm *nest_mpm, *last_mpm;    /* NULL: there is no charge, no region */
    struct gas *gas;
    int dimension;
    bool round; /* x is a radius */
    double edge;
    struct gas_cut nest_cut, region; /* without what passes through faces */
    struct mpm_outside outside;      /* of the nest: gas at rest */
    struct afdmp_rim round_region, round_nest;
    struct owned owned;
    struct part_maker maker;
    const struct ranks *ranks;
};

/* The population of the nest. */
extern const char afdmp_nest_name[];

/* Makes the cases of the parts, and their solvers; finds the nest and the region. */
struct error *afdmp_make_parts(struct afdmp *afdmp, struct simulation *simulation);
void afdmp_free_parts(struct afdmp *afdmp);

/* Calls ACT for each cell beside an open face of BOX, outside it, in one order, with its number;
 * ends where ACT returns false. */
void afdmp_each_beside(const struct afdmp *afdmp, const struct gas_cut *box,
                       bool (*act)(void *context, int64_t number, const int64_t at[3]),
                       void *context);

/* Collective: notes the pressures of the gas in RIM of BOX, which is at rest. */
void afdmp_note_rest(const struct afdmp *afdmp, const struct gas_cut *box, struct afdmp_rim *rim);

/* Nothing burns in cells, blocked ones included. */
void afdmp_burn_all(struct afdmp *afdmp);

/* Cells of gas get what the particles of the nest have; these are deleted. */
struct error *afdmp_map_to_gas(struct afdmp *afdmp, struct simulation *simulation);

/* The last part gets particles for what the cells of gas have. */
struct error *afdmp_map_to_points(struct afdmp *afdmp, struct simulation *simulation);

/* Particles as in the last stage, or without solids in the first, and the cells of the domain. */
void afdmp_count(const void *parameters, const struct simulation_case *input,
                 struct counted *counted);

/* Cells that do not count have no mass: all in the last stage, in the first those of the nest. */
void afdmp_hide_cells(struct afdmp *afdmp);

/* The judge of the solver. */
void afdmp_judge(const void *parameters, const struct simulation *simulation,
                 struct judgement *judgement);

#endif
