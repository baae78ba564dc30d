/* Records of second-order contact SPH: states half a step ahead, and their images; see kernel.h for
 * the order. */
#include <string.h>

#include "material/material.h"
#include "sph/lanes.h"
#include "sph/muscl/muscl.h"

/* Rates of a particle at level n that follow from its slopes alone, which were found a step before.
 */
struct expected {
    double acceleration[3], gradient[3][3];
};

BOLIDE_INLINE struct expected expected_rates(const struct simulation *simulation,
                                             const struct muscl_fields *f, struct muscl_kind kind,
                                             int32_t i)
{
    const struct particles *p = f->sph.particles;
    const int dimension = kind.dimension;
    struct expected rates = {{0.0}, {{0.0}}};
    if (body_is_frozen(simulation, p->body[i]))
        return rates;
    const double *g = f->own.velocity_gradient + (size_t)i * (size_t)(dimension * dimension);
    double force[3];
    memcpy(force, f->own.force[i], sizeof force);
    for (int a = 0; a < dimension; a++)
        for (int b = 0; b < dimension; b++)
            rates.gradient[a][b] = g[a * dimension + b];
    if (kind.depth && sph_axisymmetric(simulation)) {
        const struct ring ring = sph_ring(p, i);
        const double opening = ring.slope / ring.depth; /* 1/r away from the axis */
        force[0] += (p->deviator[i][0] - p->deviator[i][2]) * opening;
        if (kind.shear)
            force[1] += p->deviator[i][3] * opening;
        rates.gradient[2][2] = ring_hoop_rate(ring, p->velocity[i][0], g[0]);
    }
    bool prescribed = body_is_prescribed(simulation, p->body[i]);
    for (int a = 0; a < 3; a++)
        rates.acceleration[a] =
            prescribed ? 0.0 : force[a] / p->density[i] + simulation->problem->gravity[a];
    return rates;
}

/* The rarer kinds of strength, apart, so that their physics is not in the way of the others'. */
static __attribute__((noinline)) void flow_rarely(const struct strength *strength,
                                                  const struct motion *motion, double bulk,
                                                  struct point *point)
{
    strength_step(strength, motion, bulk, point);
}

/* Whether particle I has failed. */
BOLIDE_INLINE bool has_failed(const struct simulation *simulation, const struct particles *p,
                              int32_t i)
{
    return p->history[HISTORY_damage] && /* a material of the case fails, or is crushed */
           material_breaks(&simulation->problem->material[p->material[i]]) &&
           p->history[HISTORY_damage][i] >= 1.0;
}

BOLIDE_INLINE double firmness_of(const struct muscl_fields *f, int32_t i)
{
    return muscl_firmness(f->sph.sound_long[i], f->sph.sound_shear[i]);
}

/* The elastic energy of particle I, J/kg. */
BOLIDE_INLINE double elastic_energy(const struct muscl_fields *f, int32_t i)
{
    const struct particles *p = f->sph.particles;
    const double tiny = 1e-100, shear = square(f->sph.sound_shear[i]);
    const double bulk = square(f->sph.sound_long[i]) - 4.0 / 3.0 * shear;
    const double deviatoric = 0.25 * sym3_square(sym3_make(p->deviator[i])) / (shear + tiny);
    return (deviatoric + 0.5 * square(p->pressure[i]) / (bulk + tiny)) / square(p->density[i]);
}

/* The share of its closure that particle I can pay for: 1, and 0 where it has given much more work
 * than its elastic energy and is colder than matter can be. A hundredth of the square of sound is
 * more than the heat of metals at rest. Such cold makes tension, in which a force of closure would
 * take more work from it. */
BOLIDE_INLINE double solvent(const struct muscl_fields *f, int32_t i)
{
    const double stored = elastic_energy(f, i), heat = f->sph.particles->energy[i] - stored;
    const double most = stored + 0.01 * square(f->sph.sound_long[i]);
    return minimum(1.0, maximum(0.0, 2.0 + 2.0 * heat / most));
}

/* Which part of its closure moves particle I: none of what has failed and of products, which part,
 * and little of a soft solid, whose lattice is held by its jumps of stress. */
BOLIDE_INLINE double closes(const struct simulation *simulation, const struct muscl_fields *f,
                            int32_t i)
{
    const struct particles *p = f->sph.particles;
    if (has_failed(simulation, p, i) || body_is_frozen(simulation, p->body[i]) ||
        material_burns(&simulation->problem->material[p->material[i]]))
        return 0.0;
    return solvent(f, i) * (f->sph.sound_shear[i] > 0.0 ? firmness_of(f, i) : 1.0);
}

/* Puts the components of TENSOR that a record has at TO. */
BOLIDE_INLINE void put_stresses(int dimension, struct sym3 tensor, double *to)
{
    to[0] = tensor.xx;
    to[1] = tensor.yy;
    to[2] = dimension == 2 ? tensor.xy : tensor.zz;
    if (dimension == 3) {
        to[3] = tensor.xy;
        to[4] = tensor.yz;
        to[5] = tensor.zx;
    }
}

/* From 0 to 1 between 4 and 12 diameters from an axis. Nearer to it the gradients of velocity and
 * the forces of stress are not quite adjoint, and without the whole jump rings would vibrate ever
 * more. */
BOLIDE_INLINE double far_from_axis(const struct simulation *simulation,
                                   const struct muscl_fields *f, int32_t i)
{
    if (!sph_axisymmetric(simulation))
        return 1.0;
    const double away = fabs(f->sph.particles->position[i][0]) / f->sph.diameter[i];
    return minimum(1.0, maximum(0.0, 0.125 * (away - 4.0)));
}

/* By how much velocity and stress of particle I change in half a step. The pressure follows the
 * adiabat's slope, the deviator its law, plasticity included. ELASTIC as in kernel.h. */
BOLIDE_INLINE struct sym3 half_step_of(const struct simulation *simulation,
                                       const struct muscl_fields *f, struct muscl_kind kind,
                                       double ahead, int32_t i, double velocity[3], double *elastic)
{
    const struct particles *p = f->sph.particles;
    const struct material *material = &simulation->problem->material[p->material[i]];
    const struct strength *strength = &material->strength;
    const bool failed = has_failed(simulation, p, i), rubble = failed && material_fails(material);
    const struct expected rates = expected_rates(simulation, f, kind, i);
    const double(*u)[3] = rates.gradient, *s = p->deviator[i];
    for (int axis = 0; axis < 3; axis++)
        velocity[axis] = ahead * rates.acceleration[axis];
    struct sym3 strain = {u[0][0],
                          u[1][1],
                          u[2][2],
                          0.5 * (u[0][1] + u[1][0]),
                          0.5 * (u[1][2] + u[2][1]),
                          0.5 * (u[2][0] + u[0][2])};
    const struct vec3 spin =
        vec3_make(0.5 * (u[2][1] - u[1][2]), 0.5 * (u[0][2] - u[2][0]), 0.5 * (u[1][0] - u[0][1]));
    struct sym3 start = {s[0], s[1], s[2], s[3], s[4], s[5]}, stress = start;
    double shear_square = square(f->sph.sound_shear[i]),
           sound_square = square(f->sph.sound_long[i]);
    if (f->sph.thickness) /* no stress rate across the plate */
        strain.zz = -(strain.xx + strain.yy) * (1.0 - 2.0 * shear_square / sound_square);
    const double bulk = p->density[i] * (sound_square - 4.0 / 3.0 * shear_square);
    *elastic = 0.0;
    if (strength_is_solid(strength) && !rubble) {
        struct motion motion = {.dt = ahead,
                                .density = p->density[i],
                                .strain_rate = strain,
                                .spin = spin,
                                .pressure = p->pressure[i]};
        struct point point = {p->density[i], p->energy[i], p->pressure[i], start, {0.0}};
        double flowed = 0.0;
        if (strength_is_plain(strength)) {
            strength_plain_step(strength, &motion, &point);
        } else {
            particle_load_history(p, i, point.history);
            flowed = point.history[HISTORY_plastic_strain];
            flow_rarely(strength, &motion, bulk, &point);
        }
        stress = point.deviator;
        if (point.history[HISTORY_plastic_strain] <= flowed)
            *elastic = firmness_of(f, i) * far_from_axis(simulation, f, i);
    }
    double pressure = ahead * bulk * sym3_trace(strain);
    if (failed && p->history[HISTORY_void_ratio] && p->history[HISTORY_void_ratio][i] > 0.0)
        pressure = 0.0; /* voids open or close */
    stress = sym3_add(stress, sym3_scale(-1.0, start));
    stress.xx += pressure;
    stress.yy += pressure;
    stress.zz += pressure;
    return stress;
}

/* Z_across. The share of compression is |div v|/(|div v| + |curl v|): near one in a shock, near
 * zero where streams slide (Balsara, J. Comput. Phys. 121 (1995) 357). */
BOLIDE_INLINE double across_impedance(const struct muscl_fields *f, struct muscl_kind kind,
                                      double density, int32_t i)
{
    if (kind.shear && f->sph.sound_shear[i] > 0.0)
        return density * f->sph.sound_shear[i];
    const double tiny = 1e-100;
    const double *g =
        f->own.velocity_gradient + (size_t)i * (size_t)(kind.dimension * kind.dimension);
    double divergence, curl;
    if (kind.dimension == 2) {
        divergence = fabs(g[0] + g[3]);
        curl = fabs(g[2] - g[1]);
    } else {
        divergence = fabs(g[0] + g[4] + g[8]);
        curl = sqrt(square(g[7] - g[5]) + square(g[2] - g[6]) + square(g[3] - g[1]));
    }
    return -(divergence + tiny) / (divergence + curl + tiny);
}

/* The second law for vibrations: what the gate leaves open for particle I, of ELASTIC, and its
 * credit. The sums of gradients and of forces are not quite adjoint. Without the jumps of stress,
 * which dissipate, a body could give more work than it took and cool. The heat of a particle is its
 * energy less the elastic one, from when it last flowed. Single particles may give what others near
 * them dissipate; where the mean around falls to a loan of some hundredths of the elastic energy,
 * the gate closes. The mean is taken again and again, over wider neighbourhoods than a kernel's. */
BOLIDE_INLINE double gate_of(const struct muscl_fields *f, int32_t i, double elastic,
                             double *credit)
{
    const double loan = 0.03, renewed = 0.05, tiny = 1e-100;
    const double stored = elastic_energy(f, i), heat = f->sph.particles->energy[i] - stored;
    double *from = &f->own.heat[i], mean = f->own.credit[i];
    if (!(elastic > 0.0) || *from == 0.0) { /* it flows, or is fresh */
        *from = heat != 0.0 ? heat : tiny;
        mean = loan * stored;
    }
    *credit = renewed * (heat - *from + loan * stored) + (1.0 - renewed) * mean;
    return elastic * minimum(1.0, maximum(0.0, mean / (0.1 * loan * stored + tiny)));
}

/* The record of particle I. */
BOLIDE_INLINE void pack_owned(const struct sph *sph, const struct simulation *simulation,
                              const struct muscl_fields *f, struct muscl_kind kind, int32_t i,
                              double *record)
{
    const struct particles *p = sph->particles;
    const struct muscl_state *state = sph->state;
    int dimension = kind.dimension, stresses = muscl_stresses(kind), k = 0;
    double velocity[3], elastic;
    const struct sym3 change = half_step_of(simulation, f, kind, sph->ahead, i, velocity, &elastic);
    const double *s = p->deviator[i], pressure = p->pressure[i];
    for (int axis = 0; axis < dimension; axis++)
        record[k++] = p->position[i][axis];
    record[k++] = sph_support(&f->sph, i);
    /* transmitting bodies take no part in the sums: see frozen.c */
    record[k++] = body_is_frozen(simulation, p->body[i]) ? 0.0 : sph_volume(simulation, &f->sph, i);
    for (int axis = 0; axis < dimension; axis++)
        record[k++] = p->velocity[i][axis] + velocity[axis];
    const double at[6] = {s[0] - pressure, s[1] - pressure, s[2] - pressure, s[3], s[4], s[5]};
    const double by[6] = {change.xx, change.yy, change.zz, change.xy, change.yz, change.zx};
    for (int a = 0; a < stresses; a++) {
        int from = dimension == 2 && a == 2 ? 3 : a;
        record[k++] = at[from] + by[from];
    }
    if (f->own.hoop_stress)
        f->own.hoop_stress[i] = at[2] + by[2];
    record[k++] = p->density[i] * f->sph.sound_long[i];
    if (dimension > 1)
        record[k++] = across_impedance(f, kind, p->density[i], i);
    record[k++] = p->density[i] * state->shock_slope[p->material[i]];
    const double mark = has_failed(simulation, p, i) ? muscl_failed_mark(p->material[i])
                                                     : state->mark[p->material[i]];
    record[k++] = body_is_prescribed(simulation, p->body[i]) ? -2.0 - mark : mark;
    const double compression = dimension > 1 ? p->density[i] / f->sph.density_start[i] : 1.0;
    record[k++] = f->own.touch && f->own.touch[i] < 0.0 ? -compression : compression;
    if (dimension > 1) {
        record[k++] = muscl_limit_excess(f->sph.packing[i][PACKING_EXCESS]);
    }
    if (dimension > 1) {
        const double share = closes(simulation, f, i);
        for (int axis = 0; axis < dimension; axis++)
            record[k++] = share * f->own.closure[i][axis];
    }
    if (dimension > 1 && kind.shear) {
        const struct sym3 stress = sym3_add(sym3_make(at), change);
        record[k] = gate_of(f, i, elastic, &record[k + 1]);
        k += 2;
        put_stresses(dimension,
                     dimension == 2 ? sym3_tensile_in_plane(stress) : sym3_tensile(stress),
                     record + k);
        k += stresses;
    }
    if (kind.depth)
        record[k++] = sph_depth(simulation, &f->sph, i);
    size_t tensors = (size_t)tensor_components(dimension);
    memcpy(record + k, f->own.correction + (size_t)i * tensors, tensors * sizeof *record);
    const double *g = f->own.velocity_gradient + (size_t)i * (size_t)(dimension * dimension);
    const double *h = f->own.stress_gradient + (size_t)i * (size_t)(dimension * stresses);
    for (int b = 0; b < dimension + stresses; b++) {
        double *slope = record + muscl_slope(kind, b);
        const int step = muscl_slope_step(kind, b), c = b - dimension;
        for (int a = 0; a < dimension; a++)
            slope[a * step] = c < 0 ? g[b * dimension + a] : h[a * stresses + c];
        const int from = dimension == 2 && c == 2 ? 3 : c;
        slope[dimension * step] =
            c < 0 ? p->velocity[i][b] + 2.0 * velocity[b] : at[from] + 2.0 * by[from];
    }
}

/* Turns the record of a particle into that of its image. */
static void reflect(const struct sph *sph, const struct simulation *simulation, image_code image,
                    double *record)
{
    const struct muscl_kind kind = muscl_kind_of(sph);
    int dimension = kind.dimension, stresses = muscl_stresses(kind);
    const struct vec3 sign = image_sign(&simulation->problem->images, image);
    const double signs[3] = {sign.x, sign.y, sign.z};
    const bool tensor = stresses > 1; /* a fluid's stress is one number */
    assert(dimension >= 1 && dimension <= 3);
    sph_reflect_motion(simulation, image, record);
    sph_reflect_tensor(dimension, sign, record + muscl_correction(kind));
    if (tensor) {
        sph_reflect_tensor(dimension, sign, record + record_stress(dimension));
        sph_reflect_tensor(dimension, sign, record + muscl_pull(kind));
    }
    for (int a = 0; a < dimension && dimension > 1; a++)
        record[muscl_closure(kind) + a] *= signs[a];
    /* the slopes along each axis; behind them what comes after the step */
    for (int a = 0; a <= dimension; a++) {
        const double turned = a < dimension ? signs[a] : 1.0;
        double value[3 + 6];
        for (int b = 0; b < dimension + stresses; b++)
            value[b] = turned * record[muscl_slope(kind, b) + a * muscl_slope_step(kind, b)];
        for (int b = 0; b < dimension; b++)
            value[b] *= signs[b];
        if (tensor)
            sph_reflect_tensor(dimension, sign, value + dimension);
        for (int b = 0; b < dimension + stresses; b++)
            record[muscl_slope(kind, b) + a * muscl_slope_step(kind, b)] = value[b];
    }
    if (sph_axisymmetric(simulation) && image % 3 == 1)
        record[muscl_depth(kind)] *= -1.0;
}

/* Position and diameter of record I, where rows look. */
BOLIDE_INLINE void place_record(const struct sph *sph, int dimension, int32_t i, size_t stride)
{
    memcpy(sph->place + (size_t)i * PLACE_STRIDE, sph->record + (size_t)i * stride,
           (size_t)(dimension + 1) * sizeof(double));
}

/* All owned particles. KIND is a constant where this is inlined. */
BOLIDE_INLINE void pack_all(const struct sph *sph, const struct simulation *simulation,
                            const struct muscl_fields *f, struct muscl_kind kind)
{
    size_t stride = (size_t)muscl_stride(kind);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < sph->particles->count; i++) {
        pack_owned(sph, simulation, f, kind, i, sph->record + (size_t)i * stride);
        place_record(sph, kind.dimension, i, stride);
    }
    if (kind.shear && kind.dimension > 1)
        frozen_close(sph, kind);
}

#define PACK_KIND(name, ...)                                                     \
    static void name(const struct sph *sph, const struct simulation *simulation, \
                     const struct muscl_fields *f)                               \
    {                                                                            \
        const struct muscl_kind kind = {__VA_ARGS__};                            \
        pack_all(sph, simulation, f, kind);                                      \
    }
PACK_KIND(pack_line, 1, false, false)
PACK_KIND(pack_plane_fluid, 2, false, false)
PACK_KIND(pack_plane_solid, 2, true, false)
PACK_KIND(pack_deep_fluid, 2, false, true)
PACK_KIND(pack_deep_solid, 2, true, true)
PACK_KIND(pack_space_fluid, 3, false, false)
PACK_KIND(pack_space_solid, 3, true, false)

struct sph_records muscl_records(const struct sph *sph)
{
    return (struct sph_records){sph->record, sph->stride, reflect, sph->place};
}

void muscl_pack(struct sph *sph, const struct simulation *simulation)
{
    typedef void pack(const struct sph *, const struct simulation *, const struct muscl_fields *);
    enum { DEEP = 3 }; /* after the dimensions */
    static pack *const table[4][2] = {{pack_line, pack_line},
                                      {pack_plane_fluid, pack_plane_solid},
                                      {pack_space_fluid, pack_space_solid},
                                      {pack_deep_fluid, pack_deep_solid}};
    const struct muscl_fields f = muscl_fields_of(sph, simulation);
    const struct muscl_kind kind = muscl_kind_of(sph);
    const struct sph_records records = muscl_records(sph);
    table[kind.depth ? DEEP : kind.dimension - 1][kind.shear](sph, simulation, &f);
    sph_records_start(sph, simulation, &records);
}
