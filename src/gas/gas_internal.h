/* The state of the gas solver. Private to gas/. */
#ifndef BOLIDE_GAS_INTERNAL_H
#define BOLIDE_GAS_INTERNAL_H

#include "gas/gas_phases.h"
#include "gas/sweep.h"
#include "grid/cell_copies.h"
#include "model/cell_population.h"

struct muscl_hancock_options {
    int riemann; /* enum gas_riemann */
};

struct lax_wendroff_options {
    int form, viscosity_of; /* enum lax_wendroff_form, _viscosity */
    double viscosity;       /* NAN: by the speed of waves */
    int mixing;             /* enum gas_mixing */
};

/* Strips of an axis, those that need no planes of other ranks or faces first. */
struct gas_strips {
    int32_t count, early;
    int32_t *block; /* of all strips, one behind the other */
    struct gas_strip *strip;
};

/* An end of a block where levels meet: the blocks beside it, all finer or one that is coarser, and
 * what flowed through its faces in the sweep under way, if its strip was swept. */
struct gas_seam_end {
    int32_t block, beside[4];
    int side, besides;
    bool swept;
    double flux[STRIP_ROWS][THROUGH_NUMBERS];
};

/* Of an axis. Ends of copies of fine blocks beside coarse ones of this rank are behind its own, in
 * the order in which other ranks send what flowed through them. */
struct gas_seams {
    int32_t count, own; /* with those of copies, without */
    int64_t capacity;
    struct gas_seam_end *end, *came;
    int32_t (*of)[2]; /* of each block and copy: the numbers of its low and high end, -1 where there
                       * is none; NULL: there is one level */
    struct exchange exchange;
};

/* What is known of a block, so that gas at rest costs nothing. */
struct gas_block {
    struct gas_fastest fastest;
    bool burns; /* what has burnt of its explosive has just changed */
    bool awake; /* a sweep of this step took it, or it was not still at its start */
    bool shocked,
        stale;    /* strong shocks are in it, in what sweeps wrote before it became its state */
    bool same;    /* what sweeps wrote last is its state */
    int64_t work; /* in any unit, since ranks last compared theirs */
};

/* The event that sweeps are repeated in two halves, see strips.c. */
extern const char gas_repetition[];

struct gas {
    struct gas_parameters parameters;
    struct cell_blocks *cells;
    bool second_order;
    int riemann; /* enum gas_riemann */
    struct lax_wendroff scheme;
    int mixing; /* enum gas_mixing */
    struct eos eos[2];
    int material[2]; /* the same twice: there is one */
    struct gas_layout layout;
    struct afterburn afterburn;
    double most_afterburnt; /* the fraction of the products for which there is air */
    double mixing_heat;     /* J/kg of products that become air */
    double detonation;      /* its speed, m/s, of an explosive that is lit */
    bool unburnt;           /* some of it is, on some rank */
    bool liquid;            /* a material is a liquid whose pressure has a floor */
    double floor[2];        /* of the pressure, Pa; -INFINITY: none */
    bool thaws;             /* the second material is never colder than 0 K */
    int round;              /* the power of x in a volume: 0 unless x is a radius */
    struct vector_value
        start_center;   /* of a blast that has yet to be put into cells, and how far */
    double start_reach; /* it reaches, m: they are to be fine; 0: there is none */
    struct cell_halo halo;
    struct cell_copies copies;
    int32_t room; /* cells, with copies, for which `other` has room */
    int lasting;  /* regions of fine cells that stay when all explosives have burnt */
    struct gas_block *block;
    int64_t block_capacity;
    bool *shocked;             /* of each block, found by a sweep */
    const struct gas_cut *cut; /* what a coupling watches; NULL: nothing */
    bool sleepless; /* all blocks are swept always: gravity pulls them, or a test wants it */
    struct gas_through *through; /* one a thread */
    int throughs;
    struct ledger kept_ledger; /* what a sweep has changed that is repeated */
    double *kept_passed;
    struct gas_strips strips[3];
    struct gas_seams seams[3];
    double *u[GAS_FIELDS];     /* conserved numbers, as the store has them */
    double *other[GAS_FIELDS]; /* where sweeps write */
    double *open;              /* NULL: all cells are */
    double *sound;
    double heat[2]; /* of the materials, where energies count from cold gas: see markers.h; J/kg */
    struct gas_markers *markers; /* of the interface of two materials; NULL: there are none */
    double fastest;              /* |u_i| + c of all of this rank's cells, m/s */
    uint64_t fastest_id;
};

/* The closure of cells as they are now. */
struct gas_closure gas_closure_of(const struct gas *gas);

/* Collective: derived fields of BLOCKS, a flag each, or with NULL of those that are awake; which of
 * them are still, and the fastest cell. */
struct error *gas_derive(struct gas *gas, const struct simulation *simulation, const bool *blocks);

/* The materials of the bodies, the one of lower reference density first; the same twice where there
 * is one. */
void gas_find_materials(const struct simulation *simulation, int material[2]);

/* The pressure, Pa, that MATERIAL does not fall below, beside ANOTHER or alone; -INFINITY: it may
 * fall to any. */
double gas_floor_of(const struct material *material, bool another);

/* What the gas solver cannot do of a case, located. */
void gas_refuse(const struct simulation *simulation, const struct gas_parameters *parameters,
                struct findings *findings);

/* The domain of a case in CELLS of an edge: as it says, else where its walls are, else the bounds
 * of its bodies. ERROR_INPUT: a face does not lie on a plane of the grid. */
struct error *gas_find_domain(const struct simulation *simulation, struct cell_blocks *cells);

/* The levels of PLACE, and the regions of the finest that it asks for, into CELLS. The first
 * *LASTING of them stay when all explosives have burnt. */
struct error *gas_take_levels(const struct place *place, struct cell_blocks *cells, int *lasting);

/* Obstacles that leave no cell of the domain of CELLS open, and boundaries whose part holds no
 * place of their face. */
struct error *gas_check_shapes(const struct simulation *simulation,
                               const struct cell_blocks *cells);

/* Inflows of constant density, pressure and energy that have no state. */
struct error *gas_check_inflows(const struct simulation *simulation,
                                const struct cell_blocks *cells, int material);

/* What is outside the faces of the domain. */
void gas_find_faces(const struct simulation *simulation, const struct cell_blocks *cells,
                    struct cell_halo *halo);

/* Fills the planes of AXIS outside faces with parts or inflow, as they are at TIME. ERROR_STATE:
 * what flows in has no state. */
struct error *gas_fill_planes(const struct gas *gas, const struct simulation *simulation, int axis,
                              double time);

/* Lays out what cells have; `written` and `fields` count it. */
void gas_lay_out(struct gas_layout *layout);

/* Explosives that are lit, and products that burn in the air (burn.c). The first, collective: how
 * much has burnt at TIME, and whether some has not. The second, collective: for which fraction of
 * the products the cells as they are have air, and with which heat they mix. The third adds the
 * heat of afterburning over DT. */
struct error *gas_burn(struct gas *gas, const struct simulation *simulation, double time);
void gas_count_air(struct gas *gas, const struct simulation *simulation);
void gas_afterburn(struct gas *gas, struct simulation *simulation, double dt);

/* The state at the start of the first body of the first material; false: there is none. */
bool gas_state_of_air(const struct gas *gas, const struct simulation *simulation,
                      struct point *point);

/* Whether no body of the second material is colder than 0 K at the start. */
bool gas_starts_warm(const struct simulation *simulation, const struct gas *gas);

/* Collective: what the bodies of the case put into the cells. */
struct error *gas_fill(void *solver, struct simulation *simulation);

/* What the case that `start` names must be. */
struct error *gas_check_start(const struct simulation *simulation);

/* What is wrong with the blast of `start`, if any, before it is computed: where its centre lies,
 * its materials. */
struct error *gas_check_source(const struct gas *gas, const struct simulation *simulation);

/* Collective: computes the blast of `start`, *BLAST, which is NULL where there is none, and says
 * how far it reaches; puts it into the cells in the place of what the bodies say; frees it. */
struct blast;
struct error *gas_compute_start(struct gas *gas, struct simulation *simulation,
                                struct blast **blast);
struct error *gas_fill_blast(struct gas *gas, const struct simulation *simulation,
                             struct blast *blast);
void gas_free_blast(struct blast *blast);

/* The sweeps' pointers to the fields of the store. */
void gas_bind(struct gas *gas, const struct cell_blocks *cells);

/* Arrays, pointers, halo and strips for the blocks as they are. Collective. */
struct error *gas_plan(struct gas *gas, struct simulation *simulation);
struct error *gas_plan_strips(struct gas *gas, int threads); /* part of it, this rank's own */
void gas_free_strips(struct gas *gas);

/* Collective: blocks go to other ranks where the case has space divided anew, or one has worked
 * longer, by more than that takes. */
struct error *gas_balance(struct gas *gas, struct simulation *simulation);

/* Collective: a sweep along AXIS over DT. */
struct error *gas_sweep(struct gas *gas, struct simulation *simulation, int axis, double dt);

/* Where levels meet (seams.c): ends of blocks are found, which is collective; planes of AXIS there
 * are filled; fluxes are forgotten before a sweep, kept of each strip that is swept, passed to
 * other ranks, which is collective, and then coarse cells take those of fine faces, which is true
 * where that leaves one with hardly anything. */
struct error *gas_plan_seams(struct gas *gas);
void gas_free_seams(struct gas *gas);
struct gas_seam_end *gas_seam_end(const struct gas *gas, int axis, int32_t block, int side);
void gas_fill_seams(const struct gas *gas, int axis, int threads);
void gas_forget_fluxes(const struct gas *gas, int axis);
void gas_keep_fluxes(const struct gas *gas, int axis, const struct gas_strip *strip,
                     const struct gas_through *through);
void gas_pass_fluxes(struct gas *gas, int axis);
bool gas_match_seams(const struct gas *gas, int axis, double dt, int threads);

/* Levels follow waves (regrid.c), collective: the blocks that the state asks for, *COUNT of them in
 * *LIST, which is NULL where they are those that there are; and the state moves into them when it
 * is time. */
struct error *gas_ask_levels(struct gas *gas, int threads, struct cell_block **list, int64_t *count,
                             bool *changed);
struct error *gas_regrid(struct gas *gas, struct simulation *simulation);

/* The volume of cell I, per radian or steradian where x is a radius. */
BOLIDE_INLINE double gas_volume_of(const struct gas *gas, int32_t i)
{
    const struct cell_blocks *cells = gas->cells;
    const double edge = cells->size ? cells->size[i] : cells->edge,
                 volume = cells->dimension == 1   ? edge
                          : cells->dimension == 2 ? edge * edge
                                                  : edge * edge * edge;
    return gas_cell_volume(volume, edge, cells->position[i][0], gas->round);
}

/* Of two cells beside each other along AXIS, the first of which is cell AT of its level, the part
 * of the volume that the second has: half of it but along a radius. */
BOLIDE_INLINE double gas_upper_part(const struct gas *gas, int axis, int64_t at)
{
    const double low = gas_cell_volume(1.0, 1.0, (double)at + 0.5, gas->round),
                 high = gas_cell_volume(1.0, 1.0, (double)at + 1.5, gas->round);
    return axis == 0 && gas->round ? high / (low + high) : 0.5;
}

/* The mean of PARTS numbers, a power of two, which it overwrites; of equal ones to the bit. Those
 * with odd numbers have the part UPPER of the volume. */
BOLIDE_INLINE double gas_mean_of_parts(double *part, int parts, double upper)
{
    for (int half = parts / 2; half > 1; half /= 2)
        for (int k = 0; k < half; k++)
            part[k] += part[k + half];
    return parts == 1     ? part[0]
           : upper == 0.5 ? (part[0] + part[1]) / parts
                          : (part[0] + upper * (part[1] - part[0])) / (parts / 2);
}

/* The limited difference over a cell divided into parts, between differences to its neighbours: the
 * lesser of them. */
BOLIDE_INLINE double gas_lesser(double past, double next)
{
    return past * next <= 0.0 ? 0.0 : fabs(past) < fabs(next) ? past : next;
}

/* Books what left STRIP of a sweep along AXIS in DT. */
void gas_book(const struct gas *gas, const struct simulation *simulation,
              const struct gas_strip *strip, const struct gas_through *through, int axis, double dt,
              struct ledger *ledger);

#endif
