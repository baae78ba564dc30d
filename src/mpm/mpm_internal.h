/* The state of the material point method and the parts of its step. Private to this module. */
#ifndef BOLIDE_MPM_INTERNAL_H
#define BOLIDE_MPM_INTERNAL_H

#include "model/generate.h"
#include "model/loads.h"
#include "mpm/mpm.h"
#include "mpm/mpm_phases.h"
#include "mpm/transfer.h"
#include "parallel/exchange.h"
#include "particle/particles.h"

/* What pushes on surfaces: loads, outflows, what is outside a box (mpm_phases.h). */
enum surface_cause { SURFACE_LOADS, SURFACE_OUTFLOWS, SURFACE_OUTSIDE, SURFACE_CAUSES };

/* A node on a wall or, where shape functions reach beyond walls, next to one. */
struct wall_node {
    double *node, *back, *normal; /* in the fields; normal: NULL where there is one layer */
    double *mapped;               /* NULL where velocities are of the first order */
    int64_t at[3];
    bool booked;             /* by this rank: the first patch that covers it is its own */
    double sum[NODE_STRIDE]; /* of the particles alone, before what is behind the wall is added */
    double raised[NODE_STRIDE]; /* the same of the field `mapped` */
    /* the force of a surface on the particles alone; of all in this step, by cause */
    double pushed[3], pushed_by[SURFACE_CAUSES][3];
};

/* Distances of a surface from a node that are distinguished, and the largest in cells. */
enum { SURFACES = 256, SURFACE_REACH = 2 };

/* The nodes of bodies that have common velocities: all bodies if the case has no contacts and no
 * prescribed motion; else those of one contact group with the same kind of motion. */
struct layer {
    int group;                      /* contact group */
    bool prescribed, frozen;        /* its bodies keep their velocities, or all of their state */
    double sound_long, sound_shear; /* of a frozen body at the start */
    /* a part of all bins, or own ones and, without particles, those of other ranks; not owned */
    struct bins bins;
    struct grid grid;
    struct grid_field main, back;
    struct grid_field
        normal; /* gradient of mass, and how it touches other layers; of several layers only */
    struct grid_field stress, fill; /* by faces only, see transfer.h and fill.c */
    double surface[SURFACES + 1];   /* mass per gradient of it, of a surface so far beyond a node */
    /* of nodes away from walls: what surfaces push in this step, by cause, where any does */
    double (*pushed[SURFACE_CAUSES])[3];
    bool is_pushed[SURFACE_CAUSES];
    int64_t pushed_capacity[SURFACE_CAUSES];
    struct grid_field left, mapped; /* of velocities of higher order only, see order.c */
    struct wall_node *wall;
    int32_t walls;
    int64_t wall_capacity;
    bool *meets;   /* of each block of nodes: another layer has it too */
    bool balances; /* whether several of its materials balance their pressures */
    bool *shocked; /* and whether it contains a shock, see mixing.c */
    int64_t meets_capacity, shocked_capacity;
};

/* Bins of other ranks whose patches this rank needs, and own ones that others need. */
struct halo {
    struct bin *bin;  /* own and others', by layer and key */
    bool *far, *near; /* of each: another rank's, one whose patch goes */
    int64_t bin_capacity, far_capacity, near_capacity;
    int32_t begin[BIN_GROUPS + 1]; /* of the layers */
    int32_t *goes, *comes; /* bins whose patches go, in the order of the items to send, and come */
    int64_t goes_capacity, comes_capacity;
    struct exchange exchange;
    double *received;
    int64_t received_capacity;
    bool under_way; /* patches, between ranks */
};

struct mpm {
    struct mpm_parameters parameters;
    struct particles *particles;
    double edge;       /* of a cell, m */
    double *half_size; /* of the particles of each body, in cells */
    double *gauge;     /* of each material, Pa */
    double *reaction;  /* heat of each, J/kg */
    double *courant;   /* of each, where the step is limited by nodes */
    bool *balances_of; /* each, its pressure with that of others, see balance.c */
    double least_mass; /* of a node whose velocity counts in strain, kg */
    int64_t plane[3][2];
    bool has_plane[3][2]; /* node index of the low and the high wall across each axis */
    struct bins bins;
    struct block *block; /* of storage, as bins have it */
    int32_t leaves;      /* particles that are where another rank owns cells */
    struct send_item *leaving;
    int64_t block_capacity, leaving_capacity;
    int layers;
    uint8_t *layer_of_body, *layer_at_rest;
    struct layer layer[BIN_GROUPS];
    double **rate; /* of the particles of a bin, one a thread */
    int threads;
    int64_t rate_capacity;
    double limit, limit_before; /* of this step, and of the one before; 0 for none yet */
    bool shocks;                /* anywhere, on any rank */
    bool balances;              /* pressures, in this step */
    double (*given)[2];         /* then, to particles: volume, m^3, and energy, J */
    int64_t given_capacity;
    bool spreads;                      /* damage of a material, see spread.c */
    bool limits_by_nodes;              /* the step, see limit.c */
    struct halo halo;                  /* of several ranks only */
    const struct mpm_outside *outside; /* NULL: nothing */
    struct loads loads;
};

/* Whether particles carry a gradient of velocity. */
BOLIDE_INLINE bool mpm_is_affine(const struct mpm *mpm)
{
    return mpm->parameters.transfer != MPM_FLIP;
}

/* Whether the energy of particles follows from what forces do at nodes, to rounding: where nodes
 * have lumped masses and particles keep their velocities. Not with linear shape functions: the
 * kinetic energy that they give to a node of next to no mass has no bound, nor has what one of its
 * particles gains and another loses. */
BOLIDE_INLINE bool mpm_conserves(const struct mpm_parameters *parameters)
{
    return parameters->transfer == MPM_FLIP && parameters->order == 1 &&
           !(parameters->flip < 1.0) && parameters->energy == MPM_ENERGY_CONSERVED &&
           parameters->shape != SHAPE_LINEAR;
}

/* Whether stresses push through the faces between nodes. */
BOLIDE_INLINE bool mpm_is_by_faces(const struct mpm_parameters *parameters)
{
    return parameters->quadrature == MPM_FACES;
}

/* The step, as struct solver_class has it. */
struct error *mpm_prepare(void *solver, struct simulation *simulation, struct limit *limit);
struct error *mpm_advance(void *solver, struct simulation *simulation, double dt);

/* Collective: the largest step, see limit.c. Nodes have their masses; the second field is lost. */
struct limit mpm_limit(struct mpm *mpm, struct simulation *simulation);

/* The nodes that the particles of a cell may reach. */
BOLIDE_INLINE struct shape_window mpm_window(const struct mpm *mpm,
                                             const struct simulation *simulation)
{
    return shape_window_of((enum grid_shape)mpm->parameters.shape,
                           simulation->problem->geometry == GEOMETRY_AXISYMMETRIC &&
                               !mpm_is_by_faces(&mpm->parameters));
}

/* The fields that MPM adds to the store, as its rows (mpm.c) point to them. */
struct mpm_fields {
    double *sound_long, *viscosity;
    double (*velocity_gradient)[9]; /* NULL: particles carry none */
    double *at_state, *divergence, *shock, *ambient,
        *damage_gradient; /* NULL likewise; see point_kernel.h, transfer.h */
};
struct mpm_fields mpm_fields_of(const struct mpm *mpm);

/* Whether a bin belongs to another rank, which has its particles. */
BOLIDE_INLINE bool mpm_is_far(const struct mpm *mpm, const struct layer *layer, int32_t bin)
{
    return mpm->halo.far && mpm->halo.far[layer->bins.bin - mpm->halo.bin + bin];
}

/* Whether a bin's patch goes to other ranks. */
BOLIDE_INLINE bool mpm_is_near(const struct mpm *mpm, const struct layer *layer, int32_t bin)
{
    return mpm->halo.far && mpm->halo.near[layer->bins.bin - mpm->halo.bin + bin];
}

/* Collective: finds the bins of other ranks that own ones meet, and gives the layers all of them;
 * quick while the keys of all ranks' bins stay. ERROR is the rank's own so far. */
struct error *mpm_find_halo(struct mpm *mpm, const struct simulation *simulation,
                            struct error *error);
/* Room to exchange patches. Collective: brings the patches of a field; between start and finish a
 * rank works on bins that are not near, and each of its threads calls advance after each. */
struct error *mpm_reserve_halo(struct mpm *mpm);
void mpm_exchange_start(struct mpm *mpm, struct simulation *simulation, size_t field);
void mpm_exchange_advance(struct mpm *mpm);
void mpm_exchange_finish(struct mpm *mpm, struct simulation *simulation, size_t field);
void mpm_exchange(struct mpm *mpm, struct simulation *simulation, size_t field);
void mpm_free_halo(struct mpm *mpm);

/* `courant`, or its default, with a FLUID in the case or without. */
double mpm_courant(const struct mpm_parameters *parameters, bool fluid);
/* That of a material in a coupling with a gas: a FLUID, or not. */
double mpm_courant_beside_gas(const struct mpm_parameters *parameters, bool fluid);

/* What the case leaves to the method. */
struct mpm_parameters mpm_settled(const struct mpm_parameters *parameters,
                                  const struct simulation *simulation);

/* The judge of the solver. */
void mpm_judge(const void *parameters, const struct simulation *simulation,
               struct judgement *judgement);

/* Which bodies share a layer; those that stop change it then. */
struct error *mpm_share_layers(struct mpm *mpm, const struct simulation *simulation);
void mpm_stop_bodies(struct mpm *mpm, struct simulation *simulation);
/* Fresh particles that carry a gradient of velocity get that of their body's velocity over their
 * size. */
void mpm_start_gradients(const struct mpm *mpm, const struct simulation *simulation);
/* Neither rounding nor what holds a body takes a particle at X through a wall. */
void mpm_keep_before_walls(const struct simulation *simulation, double x[3]);
/* Held bodies move by their velocities in a step of DT. */
void mpm_move_prescribed(const struct mpm *mpm, const struct simulation *simulation, double dt);

/* Books what the ambient pressure of fluids has done in the step of velocities. */
void mpm_book_ambient(const struct mpm *mpm, struct simulation *simulation);

/* What the particles of each body and material are to the grid, by the parameters as GIVEN. */
struct error *mpm_note_bodies(struct mpm *mpm, const struct mpm_parameters *given,
                              const struct simulation *simulation);

/* Books what gravity does in a step of DT: its impulse and half of its work at the BEGIN of the
 * step, the rest of its work once velocities are those of the end. */
void mpm_book_gravity(const struct mpm *mpm, struct simulation *simulation, double dt, bool begin);

/* Books what the hoop stress pushes in a step of DT by the forces that nodes have from particles
 * alone. */
void mpm_book_hoop(const struct mpm *mpm, struct simulation *simulation, double dt);

struct transfer mpm_transfer_of(const struct mpm *mpm, const struct simulation *simulation,
                                struct layer *layer);

/* Whether any of the blocks that the patch of a bin covers is one OF which is set. */
bool mpm_covers(const struct layer *layer, int32_t bin, const bool *of);

/* Finds the planes of nodes that the walls lie on; a located error when they lie between, and where
 * a load is between planes that are too near each other. */
struct error *mpm_find_planes(struct mpm *mpm, const struct simulation *simulation);

/* Collective, by faces: patches of stresses become forces in those of nodes, see fill.c. */
void mpm_push_faces(struct mpm *mpm, struct simulation *simulation);

/* Sums of patches at all nodes of a layer; mass, momentum and force then know of walls. */
struct error *mpm_sum_nodes(const struct mpm *mpm, const struct simulation *simulation,
                            struct layer *layer);
/* Whether walls change the node at AT, and whether it lies behind one. */
bool mpm_near_wall(const struct mpm *mpm, const struct layer *layer, const int64_t at[3]);
bool mpm_behind_wall(const struct mpm *mpm, const struct layer *layer, const int64_t at[3]);
/* Whether any node of the block of nodes with its first at CORNER may be at a wall. */
bool mpm_block_near_wall(const struct mpm *mpm, const struct layer *layer, const int64_t corner[3]);
/* The index of node K of a block whose first node has index CORNER. */
void mpm_node_index(int dimension, const int64_t corner[3], int k, int64_t at[3]);
/* What walls do to the vectors of the second or third field. */
void mpm_fold_vectors(const struct mpm *mpm, struct layer *layer, const struct grid_field *field);
/* The same for what nodes have while shocks are mixed. */
void mpm_fold_heat(const struct mpm *mpm, struct layer *layer);
/* The same for what nodes have while pressures balance. */
void mpm_fold_balance(const struct mpm *mpm, struct layer *layer);
/* Books that a wall pushes particles by PUSH through a node; on the axis it is not the wall that
 * pushes along x. */
void mpm_book_wall(const struct mpm *mpm, struct simulation *simulation,
                   const struct wall_node *wall, double push[3]);
/* Notes which blocks of nodes of a layer contain shocks; true when any does. */
bool mpm_find_shocks(const struct mpm *mpm, const struct simulation *simulation,
                     struct layer *layer);
/* Collective: mixing in shocks in a step of DT, see mixing.c. Nodes have their sums; those of
 * the second field are lost. */
void mpm_mix_shocks(struct mpm *mpm, struct simulation *simulation, double dt);
/* Whether the pressure of MATERIAL balances with that of others, and in which layers any does. */
bool mpm_balances(const struct material *material);
void mpm_note_mixtures(struct mpm *mpm, const struct simulation *simulation);
/* Collective: what the balance of pressures gives particles in a step of DT, see balance.c; the
 * sums of the second field are lost. Then they take it. */
struct error *mpm_balance_pressures(struct mpm *mpm, struct simulation *simulation, double dt);
void mpm_take_given(const struct mpm *mpm, const struct simulation *simulation);

/* Whether damage of a material spreads. Collective: gradients of that, see spread.c; the second
 * field is lost. */
bool mpm_any_spreads(const struct simulation *simulation);
void mpm_find_spread(struct mpm *mpm, struct simulation *simulation);
/* The step that its fastest front allows; INFINITY where none spreads. */
double mpm_spread_step(const struct mpm *mpm, const struct simulation *simulation);
/* The step of the nodes (2-13), and what walls push in it. */
void mpm_advance_nodes(const struct mpm *mpm, struct simulation *simulation, struct layer *layer,
                       double dt);
/* Velocities of the second field: of momenta summed from its patches, or with PLAIN of those in the
 * main field. */
void mpm_find_velocities(const struct mpm *mpm, const struct simulation *simulation,
                         struct layer *layer, bool plain);

/* Velocities of higher order, see order.c: their fields; and collective, in a step of DT:
 * velocities of the second field of all layers, or with ACCELERATIONS those and accelerations of
 * the main one, to the order of the case. */
struct error *mpm_reserve_order(struct mpm *mpm);
void mpm_free_order(struct layer *layer);
void mpm_raise_order(struct mpm *mpm, struct simulation *simulation, double dt, bool accelerations);

/* Adds to the forces at nodes those that stand in the second field, summed over patches; walls know
 * of them. */
void mpm_add_forces(const struct mpm *mpm, const struct simulation *simulation,
                    struct layer *layer);

/* Nodes behind walls get the forces, mirrored, and the heat of contact of those that they are
 * images of: the layer that pushes there may not reach as far. */
void mpm_mirror_contact(const struct mpm *mpm, const struct layer *layer);

/* Particles get the heat that the nodes of LAYER have in the second field: those of bins that cover
 * a block for which OF is set, or of all for NULL. */
void mpm_warm(const struct mpm *mpm, const struct simulation *simulation, struct layer *layer,
              const bool *of);

/* Collective: loads, as they are in its middle, and faces of outflow push in a step of DT.
 * ERROR_STATE: a load is not finite. */
struct error *mpm_push_surfaces(struct mpm *mpm, struct simulation *simulation, double dt);
/* Books the impulse and work of these forces, once nodes have all forces of the step of DT. */
void mpm_book_surfaces(const struct mpm *mpm, struct simulation *simulation, double dt);
struct error *mpm_reserve_surfaces(struct mpm *mpm, const struct simulation *simulation);
/* Marks particles that have left through a face, and books what they had. */
void mpm_lose_particles(const struct mpm *mpm, struct simulation *simulation);

/* Mean modes of shear in cells of fluid lose force (2-46)-(2-48), and what that takes in DT heats
 * the particles. */
void mpm_damp_shear(struct mpm *mpm, struct simulation *simulation, double dt);

/* Contact between layers, see contact.c: which blocks of nodes they share; forces at nodes that
 * both have, in a step of DT. */
void mpm_note_surfaces(struct mpm *mpm);
struct error *mpm_find_meetings(struct mpm *mpm);
void mpm_meet(struct mpm *mpm, struct simulation *simulation, double dt);
/* The same for the velocities of the second field where layers touched, in the step or always. */
void mpm_join_velocities(struct mpm *mpm, const struct simulation *simulation);

/* Rates RATE of the particles of bin BIN of LAYER bring their states to the next level in a step of
 * DT. Returns the index of the one with the smallest id whose new state is impossible, -1 for
 * none. */
int32_t mpm_update_points(const struct mpm *mpm, struct simulation *simulation,
                          const struct layer *layer, int32_t bin, double dt, const double *rate);

/* Pressure and sound speeds of all particles as they stand. */
void mpm_evaluate(const struct mpm *mpm, struct simulation *simulation);

#endif
