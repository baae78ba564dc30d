/* The state of the SPH solver, what a scheme is, and the parts of a step that schemes share.
 * Private to this module.
 *
 * A scheme is a folder: NAME.h (its options, its state, its fields), options.c (their table),
 * kernel.h and kernel.c (the record of a neighbour and the pair sums), record.c (records from
 * states) and scheme.c (the order of its step). The parts below call no scheme; schemes call them,
 * and sph.c calls the scheme that a case names. */
#ifndef BOLIDE_SPH_SCHEME_H
#define BOLIDE_SPH_SCHEME_H

#include "model/particles/held.h"
#include "particle/field_rows.h"
#include "particle/neighbours.h"
#include "sph/conduction/conduction.h"
#include "sph/layout.h"
#include "sph/ring.h"
#include "sph/sph.h"
#include "sph/spread/spread.h"

/* What decides which fields exist, and how a step goes on. */
enum sph_trait {
    SPH_WALLS = 1 << 0,          /* the case has mirror walls */
    SPH_AXISYMMETRIC = 1 << 1,   /* particles are rings */
    SPH_THIN = 1 << 2,           /* plane stress: particles are parts of a plate */
    SPH_PLANE = 1 << 3,          /* more than one dimension */
    SPH_SHEAR = 1 << 4,          /* and a material with strength */
    SPH_HISTORY = 1 << 5,        /* a material keeps more than its plastic strain */
    SPH_CONDUCTION = 1 << 6,     /* heat is conducted */
    SPH_STILL = 1 << 7,          /* and nothing moves */
    SPH_DRIFT = 1 << 8,          /* particles move with their contacts */
    SPH_SPIN_KEPT = 1 << 9,      /* the spins of a step enter the next */
    SPH_SUPPORT_KEPT = 1 << 10,  /* supports are those of the start */
    SPH_TOTAL_ENERGY = 1 << 11,  /* the power of the pair sums is that of E + U^2/2 */
    SPH_FINITE_STRAIN = 1 << 12, /* the velocity gradient is that of positions at level n */
    SPH_VISCOUS = 1 << 13,       /* an artificial viscous pressure adds to the pressure */
    SPH_DENSITY_RATE = 1 << 14,  /* pair sums give the rate of density */
    SPH_PACKING = 1 << 15,       /* volumes follow places, fill space, and correct supports */
    SPH_ALL_RECONSTRUCTED = 1 << 16,
    SPH_PERIODIC = 1 << 17, /* an axis is periodic */
    SPH_BREAKS = 1 << 18,   /* contacts break */
    SPH_BODIES = 1 << 19,   /* there are several bodies */
    SPH_SPREADS = 1 << 20,  /* damage of a material spreads */
};

/* Components that depend on the run: of a symmetric tensor and of a gradient of velocity in its
 * dimensions, and of the gradient of the stresses that a record has. */
enum sph_size { SPH_SIZE_TENSOR = 1, SPH_SIZE_GRADIENT, SPH_SIZE_STRESS_GRADIENT, SPH_SIZES };

/* The store's fields that this solver adds, looked up once a step. */
struct sph_fields {
    struct particles *particles; /* the store that they are of */
    double *diameter;            /* D = V^(1/dimension) (1.70) */
    double *sound_long, *sound_shear;
    double *thickness; /* relative to the start; plane stress only */
    struct pair_rates rates;
    double *heat_rate;       /* dE/dt by conduction, W/kg; NULL without */
    double *damage_gradient; /* |grad D|, 1/m; NULL where no damage spreads */
    /* NULL where the scheme has none: */
    double *viscosity;    /* artificial viscous pressure (2.5), Pa */
    double *density_rate; /* kg/(m^3 s) */
    double *support;      /* the diameter that sets the support of the kernel, m */
    double (*packing)[PACKING_NUMBERS];
    double *density_start; /* of a fresh particle, kg/m^3 */
    double (*volume)[VOLUME_NUMBERS];
};

/* Options that several schemes have, as rows of their tables. */
enum sph_motion { SPH_MOTION_PARTICLE, SPH_MOTION_CONTACT, SPH_MOTION_NONE };
enum sph_energy { SPH_ENERGY_TOTAL, SPH_ENERGY_INTERNAL };
extern const char *const sph_motion_names[], *const sph_energy_names[];

#define SPH_MOTION_ROW(type)                                                                      \
    {                                                                                             \
        .key = "motion", .kind = PARAMETER_CHOICE, .offset = offsetof(type, motion),              \
        .standard = "particle", .names = sph_motion_names,                                        \
        .help = "velocity that moves a particle; particle: its own; contact: the kernel mean of " \
                "its contact velocities; none: particles do not move, only heat is conducted"     \
    }

#define SPH_ENERGY_ROW(type)                                                                     \
    {                                                                                            \
        .key = "energy", .kind = PARAMETER_CHOICE, .offset = offsetof(type, energy),             \
        .standard = "total", .names = sph_energy_names,                                          \
        .help = "total: conserved to round-off; internal: the rate of the internal energy alone" \
    }

/* The traits that these options bring. */
BOLIDE_INLINE unsigned sph_traits_of(int motion, int energy)
{
    return (motion == SPH_MOTION_CONTACT ? SPH_DRIFT : 0u) |
           (motion == SPH_MOTION_NONE ? SPH_STILL : 0u) |
           (energy == SPH_ENERGY_TOTAL ? SPH_TOTAL_ENERGY : 0u);
}

/* As in solver_class. */
BOLIDE_INLINE const char *sph_energy_lost_by(int energy)
{
    return energy == SPH_ENERGY_INTERNAL
               ? "`energy: internal` adds up the internal energy alone, and its error is that of "
                 "the step: `energy: total` conserves the sum"
               : NULL;
}

struct sph;

/* The mistake at option KEY of the scheme that SPH has. */
struct error *sph_option_error(const struct sph *sph, const struct simulation_case *input,
                               const char *key, const char *format, ...) BOLIDE_PRINTF(4, 5);

struct sph_scheme {
    const char *name;
    double smoothing[3];           /* defaults by dimension */
    double courant, courant_limit; /* the default, and the largest K that is stable */
    bool conducts;                 /* heat may be conducted beside it */
    bool stands;                   /* spall with `onset: standing` */
    bool breaks;                   /* contacts break where the material fails */
    bool touches;                  /* bodies that start apart act when they touch */
    size_t state_size;             /* bytes of its own state, zeroed before create */
    const struct field_row *rows;  /* its own fields; sph_rows has those of all schemes */

    /* Reads the options and the case into the state of the scheme, and chooses the stride of its
     * records. ERROR_INPUT, located, for what the scheme cannot do. */
    struct error *(*create)(struct sph *sph, const struct simulation *simulation);
    /* Completes particles that are fresh or were loaded. */
    void (*start)(const struct sph *sph, struct simulation *simulation);
    /* After neighbour lists were rebuilt; may be NULL. An error may be this rank's alone. */
    struct error *(*rebuilt)(struct sph *sph, const struct simulation *simulation);
    /* Collective: records, pair sums and the step that they allow. */
    void (*prepare)(struct sph *sph, struct simulation *simulation, struct limit *limit);
    /* Collective: from level n to level n + 1. */
    struct error *(*advance)(struct sph *sph, struct simulation *simulation, double dt);
    void (*destroy)(struct sph *sph); /* may be NULL */

    /* The traits that OPTIONS bring; the doubles of a record of a solid, for `bolide check`. */
    unsigned (*traits)(const void *options, int dimension);
    size_t (*stride)(const void *options, int dimension);
    /* As in solver_class; may be NULL. */
    double (*largest_jump)(const void *options);
    const char *(*energy_lost)(const void *options);
    /* As in judgement; NULL: all materials do. */
    bool (*loses_tension)(const struct material *material);
    bool wide_step; /* dt = K h/C in place of K D/C */
};

struct sph {
    struct sph_parameters parameters; /* with the defaults of the scheme filled in */
    const struct sph_scheme *scheme;
    void *state;            /* the scheme's own */
    unsigned traits;        /* enum sph_trait */
    double ahead;           /* of level n, by which the velocities of records lead, s */
    double largest_support; /* over the diameter, where supports follow packing */
    struct particles *particles;
    struct neighbours neighbours;
    struct contact_groups groups;
    int bodies;
    uint16_t *cluster; /* of each body, from 0 on; NULL: the scheme does not ask */
    int64_t steps_since_build;
    /* Records of owned particles, of ghosts, and one that fills up lanes, `stride` doubles each;
     * where `places`, position and diameter once more, closer together (lanes.h). */
    double *record, *place;
    size_t stride;
    bool places;
    int64_t place_capacity; /* in records */
    struct conduction conduction;
    struct spread spread;
    struct loads *loads; /* NULL: the case has none */
};

BOLIDE_INLINE bool sph_has(const struct sph *sph, enum sph_trait trait)
{
    return sph->traits & (unsigned)trait;
}

BOLIDE_INLINE bool sph_axisymmetric(const struct simulation *simulation)
{
    return simulation->problem->geometry == GEOMETRY_AXISYMMETRIC;
}

/* Whether particles have a depth of their own. */
BOLIDE_INLINE bool sph_deep(const struct simulation *simulation)
{
    return sph_axisymmetric(simulation) || simulation->problem->geometry == GEOMETRY_PLANE_STRESS;
}

/* Whether contact laws act between bodies. */
bool sph_has_laws(const struct simulation *simulation);

/* fields.c. The fields that all schemes have. */
extern const struct field_row sph_rows[];
extern const struct field_row *const sph_field_tables[];
struct sph_fields sph_fields_of(const struct sph *sph, const struct simulation *simulation);

/* Points the members of FIELDS, which has no others, at the fields of ROWS. */
void sph_bind_fields(const struct sph *sph, const struct simulation *simulation,
                     const struct field_row *rows, void *fields);

/* The declarations of all fields of a run with TRAITS, FIELDS_MAX at most, in the order of the
 * store. */
enum { SPH_FIELDS_MAX = 32 };
int sph_declare_fields(const struct sph_scheme *scheme, unsigned traits, int dimension,
                       struct field_declaration *fields);

/* The ring that particle I is. */
BOLIDE_INLINE struct ring sph_ring(const struct particles *p, int32_t i)
{
    return ring_of(p->position[i][0], p->mass[i], p->density[i]);
}

/* The depth of a particle: that of its ring, its thickness, or one. */
BOLIDE_INLINE double sph_depth(const struct simulation *simulation, const struct sph_fields *f,
                               int32_t i)
{
    if (f->thickness)
        return f->thickness[i];
    return sph_axisymmetric(simulation) ? sph_ring(f->particles, i).depth : 1.0;
}

/* The diameter that sets the support of particle I. */
BOLIDE_INLINE double sph_support(const struct sph_fields *f, int32_t i)
{
    return f->support ? f->support[i] : f->diameter[i];
}

/* V = m/rho; with a depth the area A = m/(rho d) of a section. */
BOLIDE_INLINE double sph_volume(const struct simulation *simulation, const struct sph_fields *f,
                                int32_t i)
{
    const struct particles *p = f->particles;
    return p->mass[i] / (p->density[i] * sph_depth(simulation, f, i));
}

/* The slope of the shock adiabat of each material; ERROR_INPUT at a material that has none. */
struct error *sph_find_slopes(const struct simulation *simulation, double *slope);

/* lists.c. Collective: neighbour lists and room for records of the particles as they stand;
 * distributes and sorts the particles when the lists have expired. *REBUILT tells whether they had.
 */
struct error *sph_refresh_lists(struct sph *sph, struct simulation *simulation, bool *rebuilt);
/* The same without a question, and without moving particles. */
struct error *sph_rebuild_lists(struct sph *sph, struct simulation *simulation);
struct reach sph_reach(const struct sph *sph, const struct simulation *simulation);

/* Whether there are pairs that PART_LAW marks. */
BOLIDE_INLINE bool sph_parts_bodies(const struct sph *sph)
{
    return sph->groups.groups > 1 || sph->groups.cluster;
}

/* clusters.c. Collective, before the first step, with lists: which bodies are in contact; makes the
 * lists again where some are apart. */
struct error *sph_find_clusters(struct sph *sph, struct simulation *simulation);

/* How near particles of bodies in contact are at the start: in their mean diameter. */
#define SPH_START_CONTACT 1.5

/* The skin of compressed lists. There are none in 1-D, where lists are short, nor where HEUN's step
 * moves particles between two walks or nothing moves. */
double sph_near_skin(const struct sph_parameters *parameters, unsigned traits);

/* records.c. One kind of record: REFLECT turns that of a particle into that of its image. But for
 * the position it multiplies fields by 1 or -1. */
enum { SPH_STRIDE_MAX = 88 };
struct sph_records {
    double *first;
    size_t stride; /* in doubles, SPH_STRIDE_MAX at most */
    void (*reflect)(const struct sph *sph, const struct simulation *simulation, image_code image,
                    double *record);
    double *place; /* copies of position and diameter, as lanes.h has them; may be NULL */
};

/* Collective. The records of owned particles are packed: sends what other ranks need, makes those
 * of images of owned particles, and zeroes the record that fills up lanes, which it returns. The
 * second waits for records of other ranks' particles and makes those of their images. */
double *sph_records_start(struct sph *sph, const struct simulation *simulation,
                          const struct sph_records *records);
void sph_records_finish(struct sph *sph, struct simulation *simulation,
                        const struct sph_records *records);

/* Reflects the position of a record, which begins with it; and its velocity as well, which is in
 * the same place in those of all schemes. */
void sph_reflect_place(const struct simulation *simulation, image_code image, double *record);
void sph_reflect_motion(const struct simulation *simulation, image_code image, double *record);

/* Reflects a symmetric tensor in the order of a record: components with one normal index change
 * sign. */
BOLIDE_INLINE void sph_reflect_tensor(int dimension, struct vec3 sign, double *tensor)
{
    if (dimension == 2)
        tensor[2] *= sign.x * sign.y;
    if (dimension == 3) {
        tensor[3] *= sign.x * sign.y;
        tensor[4] *= sign.y * sign.z;
        tensor[5] *= sign.z * sign.x;
    }
}

/* sweep.c. Calls BODY for every block: first for those whose particles have no neighbours on other
 * ranks, then, after sph_records_finish, for the rest. Blocks go to threads CHUNK at a time.
 * The time counts as PHASE. */
struct sph_sweep {
    void (*body)(const void *loop, const struct block *blocks, int32_t b);
    const void *loop;
    int chunk;
    const char *phase;
};
void sph_sweep(struct sph *sph, struct simulation *simulation, const struct sph_records *records,
               const struct sph_sweep *sweep);

/* Collective: the smallest of the steps that LIMIT_OF allows the particles; of equal ones that of
 * the smallest id. */
enum sph_limit { SPH_LIMIT_SOUND, SPH_LIMIT_VOLUME_RATE, SPH_LIMIT_CONDUCTION, SPH_LIMIT_SPREAD };
typedef struct ranked sph_limit_of(const struct sph *sph, const struct simulation *simulation,
                                   const void *context, int32_t i);
struct limit sph_smallest_limit(const struct sph *sph, const struct simulation *simulation,
                                sph_limit_of *limit_of, const void *context);

/* K D/sqrt(C^2 + (4 D div U)^2) (1.87) of particle I, or what a failure wave allows. */
BOLIDE_INLINE struct ranked sph_courant_limit(const struct sph *sph, const struct sph_fields *f,
                                              double divergence, int32_t i)
{
    const double diameter = f->diameter[i], stretch = 4.0 * diameter * divergence;
    const double sound =
        sph->parameters.courant * diameter / sqrt(square(f->sound_long[i]) + square(stretch));
    const double front = diameter / sph->spread.pace;
    return (struct ranked){minimum(sound, front), 0,
                           front < sound                      ? SPH_LIMIT_SPREAD
                           : fabs(stretch) > f->sound_long[i] ? SPH_LIMIT_VOLUME_RATE
                                                              : SPH_LIMIT_SOUND};
}

/* update.c. Thickness, diameter, support, pressure and sound speeds of all particles as they stand.
 */
void sph_evaluate(const struct sph *sph, struct simulation *simulation);

/* Takes every particle from level n to n + 1 by the rates in FIELDS, and books what acts from
 * outside. ERROR_STATE names the particle (that of the smallest id) whose new state is impossible.
 */
struct error *sph_update(const struct sph *sph, struct simulation *simulation,
                         const struct sph_fields *fields, double dt);

/* depth.c. Axisymmetry: adds to the pair sums what the hoop stress does, and leaves its
 * acceleration in hoop_pull. STRESS is the hoop stress that acts; NULL: that of level n. */
void sph_add_hoop(const struct sph *sph, const struct simulation *simulation,
                  const struct sph_fields *f, const double *stress);

/* A particle that a step has taken through a mirror wall or the axis goes on as its own image,
 * which has come in there. */
void sph_return_strays(struct simulation *simulation, const struct particles *particles);

/* material_step in plane stress: solves for the rate of thickness at which no stress is left across
 * the plate. DIVERGENCE is that in the plane, MOTION->density follows from it alone; *THICKNESS is
 * advanced. The status has POINT_NO_SOUND when there is no such rate. */
struct response sph_thin_step(const struct material *material, double divergence,
                              struct point *point, struct motion *motion, double *thickness);

/* faces.c. ERROR_INPUT where a period is too short for the SUPPORT of particles. */
struct error *sph_check_periods(const struct simulation *simulation, double support);

/* Takes particles that left through a periodic face in at the other. */
void sph_wrap(const struct simulation *simulation, const struct particles *particles);

/* unequal.c. Finds gases that touch and whose particles differ too much in mass. */
void sph_judge_masses(const struct sph_parameters *all, struct findings *findings);

/* outside.c. Finds what no scheme can do of what acts from outside. */
void sph_refuse(const struct simulation *simulation, struct findings *findings);

/* Books what images and hoop stress push in a step of DT. */
void sph_book_walls(struct simulation *simulation, const struct sph_fields *f, double dt);

/* Removes the rates of bodies with prescribed motion in a step of DT, and books them. */
void sph_hold_bodies(struct simulation *simulation, const struct sph_fields *f, double dt);

/* Adds gravity to the acceleration of free bodies, and books its work in a step of DT at the
 * position and velocity that a particle has AHEAD of time n. */
void sph_add_gravity(struct simulation *simulation, const struct sph_fields *f, double dt,
                     double ahead);

/* loads.c. The surfaces of bodies with loads. */
struct error *sph_create_loads(struct sph *sph, const struct simulation *simulation);
void sph_free_loads(struct sph *sph);
/* Collective: adds what loads push from time FROM on in DT to the acceleration of free bodies, and
 * keeps it apart (sph_load_of); before gravity. ERROR_STATE: a load is not finite. */
struct error *sph_add_loads(const struct sph *sph, struct simulation *simulation,
                            const struct sph_fields *f, double from, double dt);
/* The acceleration of each particle by loads; NULL: the case has none. */
const double (*sph_load_of(const struct sph *sph))[3];
/* Books it in a step of DT, once the acceleration is complete, as sph_add_gravity does. */
void sph_book_loads(const struct sph *sph, struct simulation *simulation,
                    const struct sph_fields *f, double dt, double ahead);

#endif
