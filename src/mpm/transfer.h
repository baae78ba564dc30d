/* Sums from particles to nodes and back: the loops of the material point method. A block of cells
 * at a time; particles in the order of bins. Compiled once an instruction set (transfer_kernel.h).
 *
 *   particles: mass, velocity, stress
 *     | transfer_scatter, transfer_push: weights N, grad N       transfer_slopes --> normals
 *     v                                                                                 |
 *   patches of nodes: mass, momentum, force                                             v
 *     | summed over blocks and ranks --> walls, loads, contact of bodies (nodes.c, contact.c)
 *     v
 *   nodes: velocity, acceleration
 *     | transfer_velocity: new velocities and places --> momentum on `back` --> nodes again
 *     | transfer_gradient: strain rate and spin                                   |
 *     v                                                                           |
 *   particles: rates <------------------------------------------------------------+
 *     | points.c: material/batch
 *     v
 *   particles: density, stress, energy of the next level
 *
 * Heat, mixing in shocks and the balance of pressures go over `back` too (transfer_warm;
 * transfer_heat, transfer_mix; transfer_compliance, transfer_balance). */
#ifndef BOLIDE_MPM_TRANSFER_H
#define BOLIDE_MPM_TRANSFER_H

#include "grid/grid.h"
#include "grid/grid_shape.h"

/* What a node has. The sums over particles are its mass, momentum and force; from the step on
 * velocity (momentum at the end of the step over mass) and acceleration stand in the place of the
 * last two. */
enum { NODE_MASS = 0, NODE_MOMENTUM = 1, NODE_VELOCITY = 1, NODE_FORCE = 4, NODE_ACCELERATION = 4 };
enum {
    NODE_MIXING = 7
}; /* mass times the rate of mixing in shocks, 1/s; from the step on its
                             fraction for velocities */
enum { NODE_STRIDE = 8 };
/* What a node has of particles whose velocities are new: their momentum, then their velocity; and
 * their mass times, then their mean of the divergence of the step before. Until then it holds
 * forces, and the heat, J/kg, that they leave. */
enum { BACK_DIVERGENCE = 3, BACK_HEAT = 3, BACK_STRIDE = 4 };
/* What a node has there during mixing in shocks: sums of m e, m k and m k^2, k the number of the
 * material. */
enum { HEAT_ENERGY = 0, HEAT_NUMBER = 1, HEAT_SQUARE = 2, HEAT_NUMBERS = 3 };

/* And while pressures balance, sums of s p, s, s k and s k^2, s the compliance of a particle; then
 * the mean of the pressure and, in BALANCE_SUM, 1 where the node balances, else 0. */
enum {
    BALANCE_PRESSURE = 0,
    BALANCE_SUM = 1,
    BALANCE_NUMBER = 2,
    BALANCE_SQUARE = 3,
    BALANCE_NUMBERS = 4
};

/* And while the step limit is found, sums of m c^2, m K and m; the first is then c/K. */
enum { SPEED_STIFFNESS = 0, SPEED_SOUND = 0, SPEED_COURANT = 1, SPEED_MASS = 2 };

/* And while damage spreads (spread.c), sums of m D and m of what spreads it; then D. */
enum { SPREAD_DAMAGE = 0, SPREAD_MASS = 1 };

/* A patch of stresses has for each axis of a node the face between it and the next node along the
 * axis: what stresses push through it, and the part of it that particles fill. The second stands
 * in a field of its own too, by axis, and becomes there what the first is multiplied by. */
enum { FACE_FILL = 3, FACE_STRIDE = 4 };
enum { FILL_STRIDE = 4 };
/* About an axis there are two axes of faces. Behind what pushes through them stand numbers of the
 * node: what particles fill of it, and what pushes it away from the axis; the first is in the field
 * too. */
enum { FACE_RING = 2, FACE_HOOP = FACE_STRIDE + 2, FILL_RING = 2 };

/* The fraction a for velocities where that for energies is b = PART: two thirds of the rate. */
BOLIDE_INLINE double mixing_of_velocity(double part) { return minimum(1.0, part / 1.5); }

/* Of a particle over the step: its velocity gradient's parts xx, yy, zz, xy, yz, zx, and half the
 * curl; and how much of its divergence the nodes do not resolve. */
enum { RATE_STRAIN = 0, RATE_SPIN = 6, RATE_UNRESOLVED = 9, RATES = 10 };

struct transfer {
    int dimension;
    enum grid_shape shape;
    int window;        /* nodes along an axis that a particle of a cell may reach */
    bool axisymmetric; /* x is the radius, zz of tensors goes around */
    bool affine;       /* particles carry a gradient of velocity */
    bool by_moments; /* which is found from first moments of velocity, else from shape functions */
    double edge;
    const struct bins *bins;
    const struct grid *grid;
    struct grid_field *main, *back, *normal;
    bool by_faces; /* stresses push through the faces between nodes, see transfer_faces.h */
    struct grid_field *stress, *fill; /* then; of the first patches only */
    /* of a particle's new velocity, how much is its old one and the nodes' acceleration */
    double flip;
    bool conserves; /* what changes velocities changes energies by as much */
    double mixing;  /* in shocks, the rate over c/h; 0: none */

    /* of the particles */
    double (*position)[3], (*velocity)[3], *energy;
    const double *mass, *density, *pressure, *viscosity, *sound;
    const double (*deviator)[6];
    const uint16_t *material, *body;
    double (*gradient)[9]; /* affine: d velocity_i / d x_j at 3 i + j */
    double *divergence;    /* of the step before, where nodes filter it; else NULL */
    const double *shock;   /* how much of one a particle is in; NULL where none is mixed */

    const double *half_size; /* of the particles of each body, in cells */
    const double *gauge;     /* pressure that does not count, of each material */
    const double *burnt;     /* of each particle; NULL where nothing reacts */
    const double *reaction;  /* the heat that burning frees, of each material, J/kg */
    const double *courant;   /* of each material */
    const bool *balances;    /* of each: its pressure does */
    /* while pressures balance: the step; the largest of all particles; what each is given */
    double balance_dt, largest_pressure, (*given)[2];
    /* of each particle, the work of that pressure per mass; NULL where there is none */
    double *ambient;
    /* where damage spreads: of each particle, and its gradient, 1/m; of each material, whether */
    const double *damage;
    double *damage_gradient;
    const bool *spreads;
};

/* Fills the patch of BIN with the mass, momentum and force of its particles (2-9)-(2-12); by faces
 * not with the force, but the patches of STRESS and FILL. */
void transfer_scatter(const struct transfer *transfer, int32_t bin);

/* By faces: what the stresses in the patch of BIN push, with the factors of its faces in FILL, goes
 * to its nodes. */
void transfer_push(const struct transfer *transfer, int32_t bin);

/* Fills the patch of BIN in NORMAL with the gradient of mass, sum m grad N (2-23), which points out
 * of the bodies. */
void transfer_slopes(const struct transfer *transfer, int32_t bin);

/* A step of DT in which the particles MOVE, or do not. */
struct transfer_step {
    double dt;
    bool move;
};

/* New velocities of the particles of BIN from its patch, where nodes have velocity and acceleration
 * (2-15), and with SCATTER their momentum in its patch of BACK (2-17); with STEP.move they move
 * (2-16). Where the transfer conserves energy, theirs is that of the end of the step, which the
 * velocities are of: it has the work of their stress at the start and of mixing in shocks. */
void transfer_velocity(const struct transfer *transfer, int32_t bin, struct transfer_step step,
                       bool scatter);

/* Particles of BIN get the velocities, and with ACCELERATIONS those too, that the nodes of the
 * patch FROM have, and give them back to the patch TO with their masses; both are laid out as that
 * of the main field. */
void transfer_again(const struct transfer *transfer, int32_t bin, const double *from,
                    bool accelerations, double *to);

/* Mixing of energies in shocks (mixing.c). The first fills the patch of BIN in BACK with the sums
 * HEAT_... of its particles; the second changes the particles in a step of DT from the sums of the
 * nodes in both patches of BIN, and overwrites these. */
void transfer_heat(const struct transfer *transfer, int32_t bin);
void transfer_mix(const struct transfer *transfer, int32_t bin, double dt);

/* Balance of pressures (balance.c). The first fills the patch of BIN in BACK with the sums
 * BALANCE_... of its particles; the second finds from those of the nodes, which it overwrites, what
 * each particle is given: volume, m^3, and energy, J. */
void transfer_compliance(const struct transfer *transfer, int32_t bin);
void transfer_balance(const struct transfer *transfer, int32_t bin);

/* Speeds of sound of nodes over their Courant numbers (limit.c). The first fills the patch of BIN
 * in BACK with the sums SPEED_... of its particles. The second turns the sums of the nodes there
 * into speeds, and gives the k-th particle of the bin in SOUND[k] the largest of the nodes that it
 * reaches; seven numbers behind the last are written too. */
void transfer_stiffness(const struct transfer *transfer, int32_t bin);
void transfer_speed(const struct transfer *transfer, int32_t bin, double *sound);

/* Damage that spreads (spread.c). The first fills the patch of BIN in BACK with the sums SPREAD_...
 * of its particles; the second gives particles their gradients from the sums of the nodes. */
void transfer_damage(const struct transfer *transfer, int32_t bin);
void transfer_spread(const struct transfer *transfer, int32_t bin);

/* Particles of BIN take the heat that nodes have in the patch of BACK. */
void transfer_warm(const struct transfer *transfer, int32_t bin);

/* Where the rates of a bin's particles go: number c of the k-th at to[c * stride + k]; each row has
 * room for seven more, which are written too. */
struct rates {
    double *to;
    size_t stride;
};

/* Numbers of the nodes of a patch, in its order: STRIDE a node. */
struct nodal {
    const double *data;
    int stride;
};

/* Rates of strain and spin of the particles of BIN (2-18), (2-19) from nodal velocities; with
 * STEP.move the particles move as the patch of the main field has it. */
void transfer_gradient(const struct transfer *transfer, int32_t bin, struct transfer_step step,
                       struct nodal velocity, struct rates rates);

#endif
