/* The state of the SPH solver and the parts of its step. Private to this room. */
#ifndef BOLIDE_SPH_INTERNAL_H
#define BOLIDE_SPH_INTERNAL_H

#include "model/held.h"
#include "sph/conduction.h"
#include "sph/hllc_kernel.h"
#include "sph/muscl_kernel.h"
#include "sph/pair_kernel.h"
#include "sph/sph.h"

/* The store's fields that this solver adds, found once a step. */
struct sph_fields {
    double *diameter; /* D = V^(1/dimension) (1.70) */
    double *sound_long, *sound_shear;
    double *viscosity; /* artificial viscous pressure (2.5), standard method only */
    double *thickness; /* relative to the start, plane stress only */
    struct pair_rates rates;
    double *heat_rate;    /* dE/dt by conduction, W/kg; NULL without */
    double *density_rate; /* of hllc and monaghan, NULL otherwise */
    /* second order only, as muscl_rates has them */
    double *correction, *velocity_gradient, *stress_gradient;
    double (*packing)[4];
    double *support; /* the diameter that a kernel goes with; not on a line */
    double (*force)[3];
};

/* A particle beside frozen ones, and what these add to it: force and power, N and W. */
struct end {
    int32_t index;
    double force[3], power;
};

struct sph {
    struct sph_parameters parameters;
    struct pair_kind kind;
    struct hllc_kind hllc;      /* of hllc and monaghan */
    double bend[MATERIALS_MAX]; /* of riemann/bend.h, by material */
    double half_step;           /* by how much the records are ahead of level n, s */
    struct neighbours neighbours;
    struct contact_groups groups;
    struct reach reach;
    int64_t steps_since_build;
    double work; /* seconds that the particles had taken when they were last distributed */
    double *record, *place;
    int64_t place_capacity; /* in records */
    struct conduction conduction;
    int32_t ends;
    int64_t end_capacity;
    struct end *end;
};

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

/* The diameter that the kernel of particle I goes with. */
BOLIDE_INLINE double sph_support(const struct sph_fields *f, int32_t i)
{
    return f->support ? f->support[i] : f->diameter[i];
}

/* V = m/rho; with a depth the area A = m/(rho d) of a section. */
BOLIDE_INLINE double sph_volume(const struct simulation *simulation, const struct sph_fields *f,
                                int32_t i)
{
    const struct particles *p = &simulation->particles;
    return p->mass[i] / (p->density[i] * sph_depth(simulation, f, i));
}

BOLIDE_INLINE bool sph_second_order(const struct sph *sph)
{
    return sph->parameters.method == SPH_MUSCL;
}

/* Sets the bend of material M, which depends on the contact solver; an error where the material has
 * none. See bend.c. */
struct error *sph_choose_bend(struct sph *sph, const struct simulation *simulation, int m);

/* Of muscl.c: what the case must not ask for; what the pair loop is instantiated by; what a fresh particle starts from;
 * records half a step ahead by the slopes found a step before, as sph_pack and sph_pack_rest. */
struct error *muscl_check(const struct sph *sph, const struct simulation *simulation);
struct muscl_kind muscl_kind_of(const struct sph *sph);
void muscl_start(const struct sph *sph, const struct simulation *simulation);
void muscl_pack(struct sph *sph, const struct simulation *simulation);
void muscl_pack_rest(struct sph *sph, const struct simulation *simulation);

/* div U at level n by the slopes found a step before, 1/s. */
BOLIDE_INLINE double muscl_divergence(const struct simulation *simulation,
                                      const struct sph_fields *f, int32_t i)
{
    const struct particles *p = &simulation->particles;
    const int dimension = p->dimension;
    if (body_is_frozen(simulation, p->body[i]))
        return 0.0;
    const double *g = f->velocity_gradient + (size_t)i * (size_t)(dimension * dimension);
    double sum = g[0];
    for (int a = 1; a < dimension; a++)
        sum += g[a * (dimension + 1)];
    return sph_axisymmetric(simulation) ? sum + p->velocity[i][0] / p->position[i][0] : sum;
}

/* The sums measure the gradient A of velocity in places at level n, so that these deform by F = 1 + dt A in a step.
 * Returns det F, and turns the parts of A into those of ln F / dt, to second order. */
BOLIDE_INLINE double muscl_deform(double dt, struct sym3 *strain_rate, struct vec3 *spin)
{
    struct sym3 e = sym3_scale(dt, *strain_rate);
    struct vec3 w = vec3_scale(dt, *spin);
    double xy = e.xy - w.z, yx = e.xy + w.z, yz = e.yz - w.x, zy = e.yz + w.x, zx = e.zx - w.y,
           xz = e.zx + w.y;
    /* the rows of A squared */
    double aa[3][3] = {{e.xx * e.xx + xy * yx + xz * zx, e.xx * xy + xy * e.yy + xz * zy,
                        e.xx * xz + xy * yz + xz * e.zz},
                       {yx * e.xx + e.yy * yx + yz * zx, yx * xy + e.yy * e.yy + yz * zy,
                        yx * xz + e.yy * yz + yz * e.zz},
                       {zx * e.xx + zy * yx + e.zz * zx, zx * xy + zy * e.yy + e.zz * zy,
                        zx * xz + zy * yz + e.zz * e.zz}};
    double half = 0.5 / dt, quarter = 0.25 / dt;
    strain_rate->xx -= half * aa[0][0];
    strain_rate->yy -= half * aa[1][1];
    strain_rate->zz -= half * aa[2][2];
    strain_rate->xy -= quarter * (aa[0][1] + aa[1][0]);
    strain_rate->yz -= quarter * (aa[1][2] + aa[2][1]);
    strain_rate->zx -= quarter * (aa[2][0] + aa[0][2]);
    spin->x -= quarter * (aa[2][1] - aa[1][2]);
    spin->y -= quarter * (aa[0][2] - aa[2][0]);
    spin->z -= quarter * (aa[1][0] - aa[0][1]);
    double x = 1.0 + e.xx, y = 1.0 + e.yy, z = 1.0 + e.zz;
    return x * (y * z - yz * zy) - xy * (yx * z - yz * zx) + xz * (yx * zy - y * zx);
}

/* SPH with corrected kernel gradients and Heun's step. */
BOLIDE_INLINE bool sph_corrected(const struct sph *sph)
{
    return sph->parameters.method == SPH_HLLC || sph->parameters.method == SPH_MONAGHAN;
}

/* Of hllc.c and heun.c: what the case must not ask for (LAWS: contact laws) and which kernels it needs; its fields,
 * HLLC_FIELDS at most; what follows from the state at the start; rates and the longest step; both stages. */
enum { HLLC_FIELDS = 6 };
struct error *hllc_choose(struct sph *sph, const struct simulation *simulation, bool laws);
struct hllc_kind hllc_kind_of(const struct sph_parameters *parameters, int dimension, bool depth);
int hllc_declare(const struct sph_parameters *parameters, struct field_declaration *fields);
void hllc_start(const struct sph *sph, struct simulation *simulation);
void hllc_prepare(struct sph *sph, struct simulation *simulation, struct limit *limit);
struct error *hllc_advance(struct sph *sph, struct simulation *simulation, double dt);

/* Collective: neighbour rows and records for the particles as they stand; distributes and sorts them when the rows no
 * longer hold. */
struct error *sph_refresh_rows(struct sph *sph, struct simulation *simulation);

/* What the case leaves to the method. */
struct sph_parameters sph_settled(const struct sph_parameters *parameters);
/* Of near rows. None are kept on a line, where rows are short, nor where Heun's step moves particles between two walks or
 * nothing moves. */
double sph_near_skin(const struct sph_parameters *settled, int dimension);

/* Of frozen.c, second order: finds particles beside frozen ones when rows are built again; adds to their sums what these
 * push, and leaves frozen ones none; books that for a step of DT. */
struct error *frozen_find(struct sph *sph, const struct simulation *simulation);
void frozen_push(struct sph *sph, const struct simulation *simulation,
                 const struct sph_fields *fields);
void frozen_book(const struct sph *sph, struct simulation *simulation, double dt);

/* Pressure and sound speeds of particle I as it stands; what its material says of them. */
BOLIDE_INLINE struct response sph_evaluate_point(struct simulation *simulation,
                                                 const struct sph_fields *f, int32_t i)
{
    struct particles *p = &simulation->particles;
    struct point point = {.density = p->density[i], .energy = p->energy[i]};
    particle_load_history(p, i, point.history);
    struct response r = material_evaluate(&simulation->material[p->material[i]], &point);
    p->pressure[i] = point.pressure;
    f->sound_long[i] = r.sound_long;
    f->sound_shear[i] = r.sound_shear;
    return r;
}

/* Diameter, pressure and sound speeds of all particles as they stand. */
void sph_evaluate(const struct sph *sph, struct simulation *simulation);

/* Packs the records of owned particles and their images, while those of other ranks are on their way; then these, with
 * their images. */
void sph_pack(struct sph *sph, const struct simulation *simulation);
void sph_pack_rest(struct sph *sph, const struct simulation *simulation);

/* q = a D^2 rho k|k| + b D rho C k in compression, k = -div U (2.5). */
void sph_find_viscosity(const struct sph *sph, const struct simulation *simulation,
                        const struct sph_fields *f);

/* Collective: the least of the ranks' OWN limits. */
struct limit sph_least_limit(const struct simulation *simulation, struct limit own);

/* Collective: dt = K D / sqrt(C^2 + (4 D div U)^2) (1.87), the smallest, of equal ones that of the smallest id. */
void sph_limit_step(const struct sph *sph, const struct simulation *simulation,
                    const struct sph_fields *f, struct limit *limit);

/* Axisymmetry: adds to the pair sums what the hoop stress does, and leaves its acceleration in hoop_pull. */
void sph_add_hoop(const struct sph *sph, const struct simulation *simulation,
                  const struct sph_fields *f);

/* A particle that a step has taken through the axis comes out on the other side as its own image. */
void sph_cross_axis(struct simulation *simulation);

/* material_step of plane stress: finds the rate of thickness at which no stress is left across the plate. DIVERGENCE
 * is that in the plane, MOTION->density follows from it alone; *THICKNESS is brought to the next level. The status
 * says POINT_NO_SOUND when there is no such rate. */
struct response sph_thin_step(const struct material *material, double divergence,
                              struct point *point, struct motion *motion, double *thickness);

/* Turns place and velocity of a record, which stand alike in those of all kernels, into those of its image. */
void sph_reflect_motion(const struct simulation *simulation, image_code image, double *record);

/* The same of a symmetric tensor in the order of a record: components with one normal index change sign. */
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

/* What the method cannot do of what acts from outside, located in the case. */
struct error *sph_refuse(const struct simulation *simulation);

/* Books what images and hoop stress push in a step of DT. */
void sph_book_walls(struct simulation *simulation, const struct sph_fields *f, double dt);

/* Takes from held bodies (`driven`, `stop`) their acceleration in a step of DT, and books it. */
void sph_hold_bodies(struct simulation *simulation, const struct sph_fields *f, double dt);

/* Adds gravity to the acceleration of bodies that nothing holds, and books what it does in a step of DT with the place and
 * velocity that a particle has AHEAD of time n. */
void sph_add_gravity(struct simulation *simulation, const struct sph_fields *f, double dt,
                     double ahead);

/* Particles stand still: nothing but heat. */
BOLIDE_INLINE bool sph_still(const struct sph *sph)
{
    return sph->parameters.motion == SPH_MOTION_NONE;
}

/* Updates every particle from level n to n + 1. ERROR_STATE names the particle (the one with the smallest id)
 * whose new state is impossible. */
struct error *sph_update(const struct sph *sph, struct simulation *simulation, double dt);

#endif
