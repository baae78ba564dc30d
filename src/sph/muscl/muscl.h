/* Second-order contact SPH: velocity and stress are carried to the contact of a pair by limited
 * slopes, which the pair sums of the step before gave, and half a step ahead in time; gradients are
 * corrected. Private to SPH. */
#ifndef BOLIDE_SPH_MUSCL_H
#define BOLIDE_SPH_MUSCL_H

#include "sph/muscl/kernel.h"
#include "sph/scheme.h"

struct muscl_options {
    int motion;     /* enum sph_motion; -1: contact in 1-D, else particle */
    int energy;     /* enum sph_energy */
    double support; /* the largest factor by which supports grow */
};

/* A particle next to a transmitting body, and what the body adds to it: force and power, N and W.
 */
struct end {
    int32_t index;
    double force[3], power;
};

struct muscl_state {
    struct muscl_kind kind;
    double shock_slope[MATERIALS_MAX]; /* slope of the shock adiabat, by material */
    double mark[MATERIALS_MAX];        /* as muscl_mark has it */
    int32_t ends;
    int64_t end_capacity;
    struct end *end;
};

/* The fields of the scheme, for the next step, as struct muscl_rates has them. */
struct muscl_own_fields {
    double *correction, *velocity_gradient, *stress_gradient;
    double (*force)[3];
    double (*closure)[3];  /* NULL in 1-D */
    double *heat, *credit; /* NULL without solids, and in 1-D */
    double *touch; /* 1: touches a body that it may be apart from, -1: touches none, 0: fresh, or
                      there are none; NULL for a single body */
    double *hoop_stress; /* NULL but in axisymmetry */
};
struct muscl_fields {
    struct sph_fields sph;
    struct muscl_own_fields own;
};

extern const struct parameter muscl_table[];
extern const struct sph_scheme muscl_scheme;
extern const struct field_row muscl_rows[];

BOLIDE_INLINE struct muscl_kind muscl_kind_of(const struct sph *sph)
{
    return ((const struct muscl_state *)sph->state)->kind;
}

struct muscl_fields muscl_fields_of(const struct sph *sph, const struct simulation *simulation);

/* div U at level n from the slopes of the step before, 1/s. */
BOLIDE_INLINE double muscl_divergence(const struct simulation *simulation,
                                      const struct muscl_fields *f, int32_t i)
{
    const struct particles *p = f->sph.particles;
    const int dimension = p->dimension;
    if (body_is_frozen(simulation, p->body[i]))
        return 0.0;
    const double *g = f->own.velocity_gradient + (size_t)i * (size_t)(dimension * dimension);
    double sum = g[0];
    for (int a = 1; a < dimension; a++)
        sum += g[a * (dimension + 1)];
    return sph_axisymmetric(simulation)
               ? sum + ring_hoop_rate(sph_ring(p, i), p->velocity[i][0], g[0])
               : sum;
}

/* record.c. Collective: records sph->ahead in time, by the slopes of the step before. */
struct sph_records muscl_records(const struct sph *sph);
void muscl_pack(struct sph *sph, const struct simulation *simulation);

/* touch.c. Whether particles will touch bodies that they may be apart from after a step of DT, by
 * the records. */
void muscl_find_touch(const struct sph *sph, const struct simulation *simulation, double dt,
                      double *touch);

/* frozen.c. Finds the particles next to transmitting bodies after lists were rebuilt; adds to their
 * sums what these bodies push, and removes the rates of the bodies; books that for a step of DT. */
struct error *frozen_find(struct sph *sph, const struct simulation *simulation);
void frozen_close(const struct sph *sph, struct muscl_kind kind);
void frozen_push(struct sph *sph, const struct simulation *simulation,
                 const struct muscl_fields *fields);
void frozen_book(const struct sph *sph, struct simulation *simulation, double dt);

#endif
