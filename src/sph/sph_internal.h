/* The state of the SPH solver and the parts of its step. Private to this room. */
#ifndef BOLIDE_SPH_INTERNAL_H
#define BOLIDE_SPH_INTERNAL_H

#include "sph/conduction.h"
#include "sph/pair_kernel.h"
#include "sph/sph.h"

/* The store's fields that this solver adds, found once a step. */
struct sph_fields {
    double *diameter; /* D = V^(1/dimension) (1.70) */
    double *sound_long, *sound_shear;
    double *viscosity; /* artificial viscous pressure (2.5), standard method only */
    double *thickness; /* relative to the start, plane stress only */
    struct pair_rates rates;
    double *heat_rate; /* dE/dt by conduction, W/kg; NULL without */
};

struct sph {
    struct sph_parameters parameters;
    struct pair_kind kind;
    double bend[MATERIALS_MAX]; /* of riemann/bend.h, by material */
    struct neighbours neighbours;
    struct contact_groups groups;
    struct reach reach;
    int64_t steps_since_build;
    double *record;
    int64_t record_capacity; /* in records */
    struct conduction conduction;
};

/* `solver: {sph: {...}}`. */
extern const struct parameter sph_table[];

struct sph_fields sph_fields_of(const struct sph *sph, const struct simulation *simulation);

BOLIDE_INLINE bool sph_axisymmetric(const struct simulation *simulation)
{
    return simulation->geometry == GEOMETRY_AXISYMMETRIC;
}

/* The depth of a particle: its radius, its thickness, or one. */
BOLIDE_INLINE double sph_depth(const struct simulation *simulation, const struct sph_fields *f,
                               int32_t i)
{
    if (f->thickness)
        return f->thickness[i];
    return sph_axisymmetric(simulation) ? simulation->particles.position[i][0] : 1.0;
}

/* V = m/rho; with a depth the area A = m/(rho d) of a section. */
BOLIDE_INLINE double sph_volume(const struct simulation *simulation, const struct sph_fields *f,
                                int32_t i)
{
    const struct particles *p = &simulation->particles;
    return p->mass[i] / (p->density[i] * sph_depth(simulation, f, i));
}

/* Diameter, pressure and sound speeds of all particles as they stand. */
void sph_evaluate(const struct sph *sph, struct simulation *simulation);

/* Packs the records of owned particles, then of ghosts. */
void sph_pack(struct sph *sph, const struct simulation *simulation);

/* q = a D^2 rho k|k| + b D rho C k in compression, k = -div U (2.5). */
void sph_find_viscosity(const struct sph *sph, const struct simulation *simulation,
                        const struct sph_fields *f);

/* dt = K D / sqrt(C^2 + (4 D div U)^2) (1.87), the smallest, of equal ones that of the smallest id. */
void sph_limit_step(const struct sph *sph, const struct simulation *simulation,
                    const struct sph_fields *f, struct limit *limit);

/* Axisymmetry: adds to the pair sums what the hoop stress does, and leaves its acceleration in hoop_pull. */
void sph_add_hoop(const struct simulation *simulation, const struct sph_fields *f);

/* A particle that a step has taken through the axis comes out on the other side as its own image. */
void sph_cross_axis(struct simulation *simulation);

/* material_step of plane stress: finds the rate of thickness at which no stress is left across the plate. DIVERGENCE
 * is that in the plane, MOTION->density follows from it alone; *THICKNESS is brought to the next level. The status
 * says POINT_NO_SOUND when there is no such rate. */
struct response sph_thin_step(const struct material *material, double divergence,
                              struct point *point, struct motion *motion, double *thickness);

/* Books what images and hoop stress push in a step of DT. */
void sph_book_walls(struct simulation *simulation, const struct sph_fields *f, double dt);

/* Brings bodies to rest whose time has come (`stop`). */
void sph_stop_bodies(struct simulation *simulation);

/* Takes from held bodies (`driven`, `stop`) their acceleration in a step of DT, and books it. */
void sph_hold_bodies(struct simulation *simulation, const struct sph_fields *f, double dt);

/* Particles stand still: nothing but heat. */
BOLIDE_INLINE bool sph_still(const struct sph *sph)
{
    return sph->parameters.motion == SPH_MOTION_NONE;
}

/* Updates every particle from level n to n + 1. ERROR_STATE names the particle (the one with the smallest id)
 * whose new state is impossible. */
struct error *sph_update(const struct sph *sph, struct simulation *simulation, double dt);

#endif
