/* What eight particles make of their sums at once: corrections, gradients, rates, and how volumes
 * follow positions. A lane has the arithmetic of one particle, so that a result does not depend on
 * the seven beside it. For the files that are compiled once an instruction set. */
#ifndef BOLIDE_SPH_MUSCL_RATES_H
#define BOLIDE_SPH_MUSCL_RATES_H

#include "sph/muscl/sums.h"
#include "sph/ring.h"

/* The largest number of slopes: three of nine values. */
enum { SLOPES = 27, TENSOR = 6 };

/* Particles FIRST .. FIRST + COUNT - 1, a lane each. */
struct batch {
    int32_t first, count;
    /* Totals of a particle in the order of the layout, and the same in lanes. */
    double total[LANES][TOTALS] ALIGNED;
    double all[TOTALS][LANES] ALIGNED;
    double image[3][LANES] ALIGNED; /* tractions of images */
    double factor[LANES] ALIGNED;   /* turns sums of forces into those of a unit of mass */
    /* Of the own record: velocity half a step ahead less that at level n, impedance, diameter,
     * volume, stresses after the step. */
    double ahead[3][LANES] ALIGNED, impedance[LANES] ALIGNED;
    double diameter[LANES] ALIGNED, volume[LANES] ALIGNED, next[TENSOR][LANES] ALIGNED;
    double packing[PACKING_NUMBERS][LANES] ALIGNED; /* as stored, then as it becomes */

    /* Results: inverses of the moment and of that for forces, slopes of all values by direction. */
    double inverse[TENSOR][LANES] ALIGNED, correction[TENSOR][LANES] ALIGNED;
    double slope[SLOPES][LANES] ALIGNED;
    double acceleration[3][LANES] ALIGNED, wall[3][LANES] ALIGNED, power[LANES] ALIGNED;
    double hoop_pull[LANES] ALIGNED, hoop_lack[LANES] ALIGNED, drift[LANES] ALIGNED;
    double strain[TENSOR][LANES] ALIGNED, spin[3][LANES] ALIGNED;
    double follows[VOLUME_NUMBERS][LANES] ALIGNED, force[3][LANES] ALIGNED;
    double closure[3][LANES] ALIGNED, credit[LANES] ALIGNED; /* credit as stored, then the mean */
};

/* det M times the inverse of M; *DET is det M. */
BOLIDE_INLINE struct sym3 adjoint_of(int dimension, struct sym3 m, double *det)
{
    if (dimension < 3)
        m.zz = 1.0;
    if (dimension < 2)
        m.yy = 1.0;
    struct sym3 l = {m.yy * m.zz - square(m.yz), m.xx * m.zz - square(m.zx),
                     m.xx * m.yy - square(m.xy), m.yz * m.zx - m.xy * m.zz,
                     m.xy * m.zx - m.yz * m.xx,  m.xy * m.yz - m.zx * m.yy};
    *det = m.xx * l.xx + m.xy * l.xy + m.zx * l.zx;
    return l;
}

/* The inverse of the second moment M, 1 on a complete lattice. Where neighbours lie to one side or
 * in a plane M is nearly singular, and its inverse gives way to the unit tensor as its norm grows
 * from 16 to 32; the corner of a cubic lattice has 5, of a distorted one up to 16. */
BOLIDE_INLINE struct sym3 correction_of(int dimension, struct sym3 m)
{
    const struct sym3 one = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
    double det;
    const struct sym3 l = adjoint_of(dimension, m, &det);
    const double norm = sqrt(sym3_square(l)) / maximum(det, 1e-100);
    const double bounded = minimum(1.0, maximum(0.0, 2.0 - 0.0625 * norm));
    const double share = det > 0.0 ? bounded : 0.0, by = share / det;
    const double scale = share > 0.0 ? by : 0.0;
    return sym3_add(sym3_scale(scale, l), sym3_scale(1.0 - share, one));
}

/* A tensor in lane K of the components that a record has, in its order. */
BOLIDE_INLINE struct sym3 tensor_at(int dimension, const double (*from)[LANES], int k)
{
    return stress_from(dimension, &from[0][k], LANES);
}

/* Writes M in the order of a record, components STEP apart. */
BOLIDE_INLINE void put_tensor(int dimension, double *to, int step, struct sym3 m)
{
    to[0] = m.xx;
    if (dimension == 2) {
        to[step] = m.yy;
        to[2 * step] = m.xy;
    }
    if (dimension == 3) {
        to[step] = m.yy;
        to[2 * step] = m.zz;
        to[3 * step] = m.xy;
        to[4 * step] = m.yz;
        to[5 * step] = m.zx;
    }
}

/* Row AT of a tensor, times L. */
BOLIDE_INLINE struct vec3 corrected(int dimension, struct sym3 l, const struct batch *batch, int at,
                                    int k)
{
    return sym3_dot(l, vector_from(dimension, &batch->all[at][k], LANES));
}

/* The moment for forces. Where neighbours lie to one side it is completed by what is missing on the
 * other side, a free surface that no stress acts on: with the first moment o, M + o o
 * |o|^2/(o.M.o), which doubles it at the end of a line. */
BOLIDE_INLINE struct sym3 moment_of_forces(struct sym3 m, struct vec3 o)
{
    const double across = vec3_dot(o, sym3_dot(m, o)), ratio = vec3_dot(o, o) / across;
    const double scale = across > 0.0 ? ratio : 0.0;
    struct sym3 missing = {o.x * o.x, o.y * o.y, o.z * o.z, o.x * o.y, o.y * o.z, o.z * o.x};
    return sym3_add(m, sym3_scale(scale, missing));
}

/* Forces, their power, and the two corrections. */
BOLIDE_INLINE void find_forces(struct muscl_kind kind, struct batch *batch, int k)
{
    const int dimension = kind.dimension;
    const struct layout at = layout_of(kind);
    const double factor = batch->factor[k];
    double power = factor * batch->all[at.power][k];
    for (int a = 0; a < dimension; a++) {
        const double acceleration = factor * batch->all[at.traction + a][k];
        batch->acceleration[a][k] = acceleration;
        batch->wall[a][k] = factor * batch->image[a][k];
        power += acceleration * batch->ahead[a][k]; /* the sums saw the velocity ahead */
    }
    batch->power[k] = power;
    for (int a = dimension; a < 3; a++)
        batch->acceleration[a][k] = batch->wall[a][k] = 0.0;
    if (kind.depth) {
        /* What a free surface lacks. Where neighbours stand thinly, their L make areas larger than
         * the particle has: then it lacks nothing. */
        batch->hoop_lack[k] = maximum(0.0, 1.0 + batch->all[at.hoop + 1][k]);
        batch->hoop_pull[k] = -2.0 * batch->all[at.hoop][k];
    }
    const struct vec3 first = vector_from(dimension, &batch->all[at.offset][k], LANES);
    const struct sym3 second = tensor_at(dimension, batch->all + at.moment, k);
    put_tensor(dimension, &batch->inverse[0][k], LANES, correction_of(dimension, second));
    put_tensor(dimension, &batch->correction[0][k], LANES,
               correction_of(dimension, moment_of_forces(second, first)));
}

/* The packing excess: by how much the volumes of the particles around i exceed the space there, the
 * excess of tr M/dimension over its initial value less a tolerance. Where bodies have met across a
 * gap, the velocity gradient underestimates the compression, and particles would overlap. For a
 * random arrangement the trace is 1 on average, but in stirred particles it scatters by 0.02. The
 * mean over the neighbours of the same material is therefore used, with smaller weights for those
 * of other compression. Also computed here: how sparse neighbours are along some axis, by the norm
 * of the inverse of the moment for forces, at most 100. Its initial value is at least that of a
 * moment with 1/sqrt(3) on one axis and 1 on the others. */
BOLIDE_INLINE void find_packing(struct muscl_kind kind, double smoothing, struct batch *batch,
                                int k)
{
    const double slack = 0.003;
    const int dimension = kind.dimension;
    const struct layout at = layout_of(kind);
    const struct sym3 m = tensor_at(dimension, batch->all + at.moment, k);
    const struct vec3 first = vector_from(dimension, &batch->all[at.offset][k], LANES);
    const double filled = dimension == 2 ? 0.5 * (m.xx + m.yy) : (m.xx + m.yy + m.zz) / 3.0;
    const double stored = batch->packing[PACKING_START][k];
    const double start = stored == 0.0 ? maximum(1.0, filled) : stored;
    const double excess = filled - start - slack;
    const double inverse_h = 1.0 / (smoothing * batch->diameter[k]);
    const double self =
        batch->volume[k] * kernel_value(0.0, inverse_h, dimension) * square(inverse_h);
    const double sum = batch->all[at.packing][k] + self * muscl_limit_excess(excess);
    const double mean = sum / (batch->all[at.like][k] + self);
    double det;
    const double norm = sqrt(sym3_square(adjoint_of(dimension, moment_of_forces(m, first), &det)));
    const double ratio = norm / det, thin = 100.0 * det > norm ? ratio : 100.0;
    const double thin_stored = batch->packing[PACKING_THIN_START][k];
    const double thin_start = maximum(dimension == 2 ? 2.0 : 2.2360679774997896, thin);
    batch->packing[PACKING_START][k] = start;
    batch->packing[PACKING_EXCESS][k] = excess;
    batch->packing[PACKING_MEAN][k] = self > 0.0 ? mean : 0.0;
    batch->packing[PACKING_THIN][k] = thin;
    batch->packing[PACKING_THIN_START][k] = thin_stored == 0.0 ? thin_start : thin_stored;
}

/* How the volume of a particle grows as it and its neighbours move: by the gradient T/N of the
 * velocities that they move with, that of least squares weighed by V W/h^2, in which both sides of
 * a shock count. Volumes so arrive where the places do. What contact velocities are ahead of these
 * is exchanged between neighbours: it damps what the lattice could do by itself, and adds up to
 * nothing over a shock. Where N has next to nothing on some axis, as in a sheet of one layer, the
 * contact velocities alone must do: the norm of the inverse of N times its trace is
 * dimension^(3/2) where neighbours stand evenly, and the share falls from one to none as it grows
 * from 1.4 to 2.8 of that. */
BOLIDE_INLINE void find_volume(struct muscl_kind kind, struct batch *batch, int k)
{
    const int dimension = kind.dimension;
    const struct layout at = layout_of(kind);
    const struct sym3 n = tensor_at(dimension, batch->all + at.spread, k);
    const double trace = n.xx + n.yy + n.zz,
                 even = dimension == 2 ? 2.8284271247461903 : 5.196152422706632;
    double det;
    struct sym3 adjoint = adjoint_of(dimension, n, &det);
    if (dimension == 2)
        adjoint.zz = 0.0;
    const double uneven = sqrt(sym3_square(adjoint)) * trace / even; /* times det N */
    const double share = minimum(1.0, 2.0 - uneven / (1.4 * det));
    const bool follows = (det > 0.0) & (share > 0.0);
    const struct sym3 l = sym3_scale(1.0 / det, adjoint);
    const struct vec3 x = corrected(dimension, l, batch, at.parting, k);
    const struct vec3 y = corrected(dimension, l, batch, at.parting + dimension, k);
    double first = x.x + y.y, second = x.x * y.y - x.y * y.x, third = 0.0;
    if (dimension > 2) {
        const struct vec3 z = corrected(dimension, l, batch, at.parting + 6, k);
        first += z.z;
        second += x.x * z.z - x.z * z.x + (y.y * z.z - y.z * z.y);
        third = vec3_dot(x, vec3_cross(y, z));
    }
    batch->follows[VOLUME_SHARE][k] = follows ? share : 0.0;
    batch->follows[VOLUME_FIRST][k] = follows ? first : 0.0;
    batch->follows[VOLUME_SECOND][k] = follows ? second : 0.0;
    batch->follows[VOLUME_THIRD][k] = follows ? third : 0.0;
    batch->follows[VOLUME_EXCHANGE][k] = follows ? -2.0 * batch->all[at.exchange][k] : 0.0;
}

/* Strain rate, spin and, in 1-D, drift. */
BOLIDE_INLINE void find_strain(struct muscl_kind kind, struct batch *batch, int k)
{
    const int dimension = kind.dimension;
    const struct layout at = layout_of(kind);
    const struct vec3 none = {0.0, 0.0, 0.0};
    const struct sym3 l = tensor_at(dimension, batch->inverse, k);
    struct vec3 x = vec3_scale(-2.0, corrected(dimension, l, batch, at.gradient, k)), y = none,
                z = none;
    if (dimension > 1)
        y = vec3_scale(-2.0, corrected(dimension, l, batch, at.gradient + dimension, k));
    if (dimension > 2)
        z = vec3_scale(-2.0, corrected(dimension, l, batch, at.gradient + 2 * dimension, k));
    batch->strain[0][k] = x.x;
    batch->strain[1][k] = y.y;
    batch->strain[2][k] = z.z;
    batch->strain[3][k] = 0.5 * (x.y + y.x);
    batch->strain[4][k] = 0.5 * (y.z + z.y);
    batch->strain[5][k] = 0.5 * (z.x + x.z);
    batch->spin[0][k] = 0.5 * (z.y - y.z);
    batch->spin[1][k] = 0.5 * (x.z - z.x);
    batch->spin[2][k] = 0.5 * (y.x - x.y);
    if (dimension == 1) {
        /* The mean of contact velocities, less what a linear field gives where neighbours lie to
         * one side. */
        const double weight = batch->all[at.weight][k];
        const double mean =
            (batch->all[at.drift][k] + 0.5 * x.x * batch->all[at.offset][k]) / weight;
        batch->drift[k] = weight < 0.0 ? mean : 0.0;
    }
}

/* The slope along axis A of value F: a row of L times the sums. */
BOLIDE_INLINE double slope_of(struct muscl_kind kind, struct sym3 l, const struct batch *batch,
                              int a, int f, int k)
{
    const double(*sums)[LANES] = batch->all + layout_of(kind).slopes + f;
    const int values = muscl_values(kind);
    double sum = (a == 0 ? l.xx : a == 1 ? l.xy : l.zx) * sums[0][k];
    if (kind.dimension > 1)
        sum += (a == 0 ? l.xy : a == 1 ? l.yy : l.yz) * sums[values][k];
    if (kind.dimension > 2)
        sum += (a == 0 ? l.zx : a == 1 ? l.yz : l.zz) * sums[2 * values][k];
    return sum;
}

/* The divergence of the stresses after the step, whose sums follow those of velocity. */
BOLIDE_INLINE struct vec3 divergence_of(struct muscl_kind kind, struct sym3 l,
                                        const struct batch *batch, int k)
{
    const int d = kind.dimension;
    if (muscl_stresses(kind) == 1)
        return vec3_make(slope_of(kind, l, batch, 0, d, k),
                         d > 1 ? slope_of(kind, l, batch, 1, d, k) : 0.0,
                         d > 2 ? slope_of(kind, l, batch, 2, d, k) : 0.0);
    if (d == 2)
        return vec3_make(
            slope_of(kind, l, batch, 0, d, k) + slope_of(kind, l, batch, 1, d + 2, k),
            slope_of(kind, l, batch, 0, d + 2, k) + slope_of(kind, l, batch, 1, d + 1, k), 0.0);
    return vec3_make(slope_of(kind, l, batch, 0, d, k) + slope_of(kind, l, batch, 1, d + 3, k) +
                         slope_of(kind, l, batch, 2, d + 5, k),
                     slope_of(kind, l, batch, 0, d + 3, k) + slope_of(kind, l, batch, 1, d + 1, k) +
                         slope_of(kind, l, batch, 2, d + 4, k),
                     slope_of(kind, l, batch, 0, d + 5, k) + slope_of(kind, l, batch, 1, d + 4, k) +
                         slope_of(kind, l, batch, 2, d + 2, k));
}

/* What the next step starts from: slopes, and the force on a unit of volume that the values after
 * the step will make. That follows from their slopes, and from the stress that ends at a free
 * surface. There, with the first moment o and the mean distance r of neighbours, sigma.o 2/r is
 * what neighbours on one side only add up to. Inside o is small and says nothing of a surface: it
 * counts by |o|^3/(o.M.o), one at a flat surface and outside. Without this a free surface would
 * feel what pulls it half a step late, and thin plates would ring louder and louder. */
BOLIDE_INLINE void find_expected(struct muscl_kind kind, struct batch *batch, int k)
{
    const int dimension = kind.dimension, stresses = muscl_stresses(kind);
    const struct layout at = layout_of(kind);
    const double weight = batch->all[at.weight][k];
    /* Beside material of much higher impedance the stress, and its slope, is that of the other
     * material. */
    const double ours = 2.0 * batch->impedance[k] * weight, mean = batch->all[at.impedance][k];
    const double ratio = ours / mean, share = ours > mean ? ratio : 1.0;
    for (int a = 0; a < dimension; a++)
        for (int b = 0; b < stresses; b++)
            batch->slope[a * muscl_values(kind) + dimension + b][k] *= share;
    const struct sym3 l = tensor_at(dimension, batch->correction, k);
    const struct sym3 m = tensor_at(dimension, batch->all + at.moment, k);
    const struct vec3 o = vector_from(dimension, &batch->all[at.offset][k], LANES);
    const double across = vec3_dot(o, sym3_dot(m, o)), square = vec3_dot(o, o);
    const double trace = m.xx + (dimension > 1 ? m.yy : 0.0) + (dimension > 2 ? m.zz : 0.0);
    const bool any = (across > 0.0) & (trace > 0.0);
    const double of_surface = minimum(1.0, square * sqrt(square) / across);
    const double ends = any ? -2.0 * weight / trace * of_surface : 0.0;
    const struct sym3 stress = stresses == 1
                                   ? (struct sym3){batch->next[0][k], 0.0, 0.0, 0.0, 0.0, 0.0}
                                   : tensor_at(dimension, batch->next, k);
    const struct vec3 end =
        stresses == 1 ? vec3_scale(stress.xx, o) : traction_of(dimension, stress, o);
    const struct vec3 force =
        vec3_add(vec3_scale(share, divergence_of(kind, l, batch, k)), vec3_scale(ends, end));
    batch->force[0][k] = force.x;
    batch->force[1][k] = force.y;
    batch->force[2][k] = force.z;
}

/* The displacement that closes the areas of a particle: what they leave open over their stiffness,
 * which is the sum of weights over the mean distance of neighbours. A factor of 1.24 keeps square
 * and hexagonal lattices in place under tension. At a surface, where areas are open without tension
 * as well, only what lies along it counts. */
BOLIDE_INLINE void find_closure(struct muscl_kind kind, struct batch *batch, int k)
{
    const int dimension = kind.dimension;
    const struct layout at = layout_of(kind);
    const struct vec3 o = vector_from(dimension, &batch->all[at.offset][k], LANES);
    const struct sym3 m = tensor_at(dimension, batch->all + at.moment, k);
    const struct vec3 open = vector_from(dimension, &batch->all[at.open][k], LANES);
    const double across = vec3_dot(o, sym3_dot(m, o)), square = vec3_dot(o, o);
    const double of_surface = square * sqrt(square) / across;
    const double at_surface =
        across > 0.0 ? minimum(1.0, maximum(0.0, 5.0 * (of_surface - 0.3))) : 0.0;
    const double normal = at_surface * vec3_dot(open, o) / square;
    const double outwards = square > 0.0 ? normal : 0.0;
    const double weight = batch->all[at.weight][k];
    const double scale = -2.0 * 1.24 * (m.xx + m.yy + m.zz) / (weight * weight);
    for (int a = 0; a < 3; a++) {
        const double along = batch->all[at.open + a][k] - outwards * batch->all[at.offset + a][k];
        batch->closure[a][k] = a < dimension && weight < 0.0 ? scale * along : 0.0;
    }
}

/* The mean of credit over the neighbours of the same material, as that of the packing excess. */
BOLIDE_INLINE void find_credit(struct muscl_kind kind, double smoothing, struct batch *batch, int k)
{
    const struct layout at = layout_of(kind);
    const double inverse_h = 1.0 / (smoothing * batch->diameter[k]);
    const double self =
        batch->volume[k] * kernel_value(0.0, inverse_h, kind.dimension) * square(inverse_h);
    const double mean =
        (batch->all[at.credit][k] + self * batch->credit[k]) / (batch->all[at.like][k] + self);
    batch->credit[k] = self > 0.0 ? mean : 0.0;
}

/* Stages what lane K needs of particle I beside its totals. IMAGES are the tractions of images. */
BOLIDE_INLINE void batch_stage(const struct muscl_loop *loop, struct muscl_kind kind, int32_t i,
                               const double *images, struct batch *batch, int k)
{
    const int dimension = kind.dimension;
    const double *own = loop->record + (size_t)i * (size_t)muscl_stride(kind);
    batch->factor[k] =
        -2.0 / (kind.depth ? loop->density[i] * own[muscl_depth(kind)] : loop->density[i]);
    for (int a = 0; a < dimension; a++) {
        batch->image[a][k] = images[a];
        batch->ahead[a][k] = own[record_velocity(dimension) + a] - loop->velocity[i][a];
    }
    batch->impedance[k] = own[muscl_impedance(kind)];
    batch->diameter[k] = own[record_diameter(dimension)];
    batch->volume[k] = own[record_volume(dimension)];
    for (int b = 0; b < muscl_stresses(kind); b++)
        batch->next[b][k] = own[muscl_next(kind, dimension + b)];
    if (dimension > 1)
        for (int p = 0; p < PACKING_NUMBERS; p++)
            batch->packing[p][k] = loop->rates.packing[i][p];
    if (dimension > 1 && kind.shear)
        batch->credit[k] = own[muscl_credit(kind)];
}

/* Adds particle I, whose totals are in place, as the next lane. */
BOLIDE_INLINE void batch_add(const struct muscl_loop *loop, struct muscl_kind kind, int32_t i,
                             const double *images, struct batch *batch)
{
    batch_stage(loop, kind, i, images, batch, batch->count++);
}

/* Fills spare lanes with the first particle. */
BOLIDE_INLINE void batch_pad(const struct muscl_loop *loop, struct muscl_kind kind,
                             struct batch *batch)
{
    const double none[3] = {0.0, 0.0, 0.0};
    for (int k = batch->count; k < LANES; k++)
        batch_stage(loop, kind, batch->first, none, batch, k);
}

/* Writes COUNT components of each particle of BATCH, STRIDE apart, to TO. */
BOLIDE_INLINE void batch_write(const struct batch *batch, const double (*from)[LANES], int count,
                               double *to, int stride)
{
    to += (size_t)batch->first * (size_t)stride;
    for (int k = 0; k < batch->count; k++)
        for (int c = 0; c < count; c++)
            to[k * stride + c] = from[c][k];
}

/* Writes the rates of the particles of BATCH. */
BOLIDE_INLINE void batch_write_all(const struct muscl_loop *loop, struct muscl_kind kind,
                                   const struct batch *batch)
{
    const int dimension = kind.dimension, stresses = muscl_stresses(kind);
    const int values = muscl_values(kind);
    const struct muscl_rates *rates = &loop->rates;
    batch_write(batch, batch->acceleration, 3, rates->sums.acceleration[0], 3);
    if (rates->sums.wall)
        batch_write(batch, batch->wall, 3, rates->sums.wall[0], 3);
    batch_write(batch, &batch->power, 1, rates->sums.power, 1);
    if (rates->sums.hoop_pull)
        for (int k = 0; k < batch->count; k++) {
            const int32_t i = batch->first + k;
            const double *own = loop->record + (size_t)i * (size_t)muscl_stride(kind);
            const double slope = ring_slope(own[0], own[muscl_depth(kind)]);
            rates->sums.hoop_pull[i] = slope * batch->hoop_lack[k] + batch->hoop_pull[k];
            rates->sums.hoop_strain[i] = 1.0;
        }
    batch_write(batch, batch->strain, 6, rates->sums.strain_rate[0], 6);
    batch_write(batch, batch->spin, 3, rates->sums.spin[0], 3);
    if (dimension == 1 && rates->sums.drift) {
        for (int k = 0; k < batch->count; k++) {
            const double drift[3] = {batch->drift[k], 0.0, 0.0};
            memcpy(rates->sums.drift[batch->first + k], drift, sizeof drift);
        }
    }
    const int tensor = tensor_components(dimension);
    batch_write(batch, batch->correction, tensor, rates->correction, tensor);
    if (dimension > 1) {
        batch_write(batch, batch->packing, PACKING_NUMBERS, rates->packing[0], PACKING_NUMBERS);
        batch_write(batch, batch->follows, VOLUME_NUMBERS, rates->volume[0], VOLUME_NUMBERS);
        batch_write(batch, batch->closure, 3, rates->closure[0], 3);
        if (kind.shear)
            batch_write(batch, &batch->credit, 1, rates->credit, 1);
    }
    for (int k = 0; k < batch->count; k++) {
        const size_t i = (size_t)batch->first + (size_t)k;
        double *g = rates->velocity_gradient + i * (size_t)(dimension * dimension);
        double *h = rates->stress_gradient + i * (size_t)(dimension * stresses);
        for (int a = 0; a < dimension; a++) {
            for (int b = 0; b < dimension; b++)
                g[b * dimension + a] = batch->slope[a * values + b][k];
            for (int b = 0; b < stresses; b++)
                h[a * stresses + b] = batch->slope[a * values + dimension + b][k];
        }
    }
    batch_write(batch, batch->force, 3, rates->force[0], 3);
}

/* Turns the totals of BATCH, all lanes of which are staged, into rates, writes them, and empties
 * it. */
BOLIDE_INLINE void batch_finish(const struct muscl_loop *loop, struct muscl_kind kind,
                                struct batch *batch)
{
    const double *row[LANES];
    for (int k = 0; k < LANES; k++)
        row[k] = batch->total[k < batch->count ? k : 0];
    for (int f = 0; f < layout_of(kind).count; f += 4)
        transpose(row, f, batch->all + f);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++)
        find_forces(kind, batch, k);
    if (kind.dimension > 1) {
#pragma omp simd simdlen(8)
        for (int k = 0; k < LANES; k++)
            find_packing(kind, loop->smoothing, batch, k);
#pragma omp simd simdlen(8)
        for (int k = 0; k < LANES; k++)
            find_volume(kind, batch, k);
    }
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++)
        find_strain(kind, batch, k);
    for (int a = 0; a < kind.dimension; a++)
        for (int f = 0; f < muscl_values(kind); f++)
#pragma omp simd simdlen(8)
            for (int k = 0; k < LANES; k++)
                batch->slope[a * muscl_values(kind) + f][k] =
                    slope_of(kind, tensor_at(kind.dimension, batch->inverse, k), batch, a, f, k);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++)
        find_expected(kind, batch, k);
    if (kind.dimension > 1)
#pragma omp simd simdlen(8)
        for (int k = 0; k < LANES; k++)
            find_closure(kind, batch, k);
    if (kind.dimension > 1 && kind.shear)
#pragma omp simd simdlen(8)
        for (int k = 0; k < LANES; k++)
            find_credit(kind, loop->smoothing, batch, k);
    batch_write_all(loop, kind, batch);
    batch->first += batch->count;
    batch->count = 0;
}

#endif
