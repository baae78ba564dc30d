/* The sums over a row of the second-order pair loop, and what a particle makes of them:
 * corrections, gradients, rates. For the files that are compiled once an instruction set. */
#ifndef BOLIDE_SPH_MUSCL_SUMS_H
#define BOLIDE_SPH_MUSCL_SUMS_H

#include "sph/kernel.h"
#include "sph/muscl/kernel.h"
#include "sph/record.h"

enum { SUMS = 48, ROW = 8, TOTALS = SUMS + 3 * (ROW + 1) };

/* Where the sums over a row stand, with w = V W' and f = 2 D_i/(D_i + D_j) twice the share of the
 * pair that i has. */
struct layout {
    int traction, power; /* w |a| t*, w |a| t*.(U* - U) */
    int gradient;        /* w (U* - U)^a e^b */
    int weight;          /* w */
    int drift;           /* on a line: w (U* - U) */
    int impedance;       /* w Z_j */
    int offset, moment;  /* -f w x, -f w x^a e^b */
    int narrow;          /* slopes of what stands in no row */
    int hoop;            /* of axisymmetry: w |a| (depth - d) n_x, w |a| x n_x */
    /* in 2-D and 3-D, v = V W/h^2: v x^a x^b, v (U_j - U)^a x^b; w |a| of the exchange of volume; v
     * of like matter, v times its packing */
    int spread, parting, exchange, like, packing;
    int slopes; /* totals only: -f w dq e^b by b, of the values after the step; all above, a multiple of eight */
    int count;
};

BOLIDE_INLINE struct layout layout_of(struct muscl_kind kind)
{
    const int dimension = kind.dimension, tensor = tensor_components(dimension);
    struct layout at;
    at.traction = 0;
    at.power = dimension;
    at.gradient = at.power + 1;
    at.weight = at.gradient + dimension * dimension;
    at.drift = at.weight + 1;
    at.impedance = at.drift + (dimension == 1 ? 1 : 0);
    at.offset = at.impedance + 1;
    at.moment = at.offset + dimension;
    at.narrow = at.moment + tensor;
    at.hoop = at.narrow + dimension * muscl_narrow(kind);
    at.spread = at.hoop + (kind.depth ? 2 : 0);
    at.parting = at.spread + (dimension > 1 ? tensor : 0);
    at.exchange = at.parting + (dimension > 1 ? dimension * dimension : 0);
    at.like = at.exchange + (dimension > 1 ? 1 : 0);
    at.packing = at.like + (dimension > 1 ? 1 : 0);
    at.slopes = (at.packing + (dimension > 1 ? 1 : 0) + 7) / 8 * 8;
    at.count = at.slopes + dimension * muscl_values(kind);
    return at;
}

/* Sums over the neighbours seen so far: in lanes, and of slopes in rows. */
struct sums {
    double lane[SUMS][LANES] ALIGNED;
    double row[3][ROW] ALIGNED;
};

/* The totals in the order of the layout. */
BOLIDE_INLINE void sums_totals(struct muscl_kind kind, struct sums *sums, double *all)
{
    const struct layout at = layout_of(kind);
    const int values = muscl_values(kind), wide = muscl_wide(kind), narrow = muscl_narrow(kind);
    lanes_totals(sums->lane, at.slopes, all);
    for (int b = 0; b < kind.dimension; b++)
        for (int f = 0; f < values; f++)
            all[at.slopes + b * values + f] =
                f < wide ? sums->row[b][f] : all[at.narrow + b * narrow + f - wide];
}

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
    double norm = sqrt(sym3_square(l)) / maximum(det, 1e-100);
    double share = det > 0.0 ? minimum(1.0, maximum(0.0, 2.0 - 0.0625 * norm)) : 0.0;
    double scale = share > 0.0 ? share / det : 0.0;
    return sym3_add(sym3_scale(scale, l), sym3_scale(1.0 - share, one));
}

/* Rows V of a tensor, times L. */
BOLIDE_INLINE struct vec3 corrected(int dimension, struct sym3 l, const double *v)
{
    return sym3_dot(l, vector_from(dimension, v, 1));
}

/* The moment M, in the order of a record. */
BOLIDE_INLINE void write_tensor(int dimension, struct sym3 m, double *to)
{
    to[0] = m.xx;
    if (dimension == 2) {
        to[1] = m.yy;
        to[2] = m.xy;
    }
    if (dimension == 3) {
        to[1] = m.yy;
        to[2] = m.zz;
        to[3] = m.xy;
        to[4] = m.yz;
        to[5] = m.zx;
    }
}

/* The moment for forces. Where neighbours lie to one side it is completed by what is missing on the
 * other side, a free surface that no stress acts on: with the first moment o, M + o o
 * |o|^2/(o.M.o), which doubles it at the end of a line. */
BOLIDE_INLINE struct sym3 moment_of_forces(struct sym3 m, struct vec3 o)
{
    double across = vec3_dot(o, sym3_dot(m, o));
    double scale = across > 0.0 ? vec3_dot(o, o) / across : 0.0;
    struct sym3 missing = {o.x * o.x, o.y * o.y, o.z * o.z, o.x * o.y, o.y * o.z, o.z * o.x};
    return sym3_add(m, sym3_scale(scale, missing));
}

/* The first moment of a row, its second, that for forces, and the inverse of the second. */
struct moments {
    struct vec3 first;
    struct sym3 second, of_forces, inverse;
};

/* What the volumes about a particle fill beyond the space there is: the excess of tr M/dimension
 * over the start's, less a slack. Where matter has met across a gap the velocity gradient counts too
 * little of the closing, and bodies would run into each other. The trace is 1 on the average of
 * points that stand at random; among particles that have been stirred it scatters by 0.02, so the
 * mean over the neighbours counts: those of the same material, the less the more their compression
 * differs. And how thinly neighbours stand on some axis: the norm of the inverse of the moment of
 * forces, 100 at most. At the start it counts as that of a moment with 1/sqrt(3) on one axis and 1
 * on the others, at least. */
BOLIDE_INLINE void write_packing(const struct muscl_loop *loop, struct muscl_kind kind, int32_t i,
                                 const double *all, const struct moments *moments)
{
    const double slack = 0.003;
    const int dimension = kind.dimension;
    const struct layout at = layout_of(kind);
    const double *own = loop->record + (size_t)i * (size_t)muscl_stride(kind);
    const struct sym3 m = moments->second;
    const double filled = dimension == 2 ? 0.5 * (m.xx + m.yy) : (m.xx + m.yy + m.zz) / 3.0;
    double *packing = loop->rates.packing[i];
    if (packing[PACKING_START] == 0.0)
        packing[PACKING_START] = maximum(1.0, filled);
    packing[PACKING_EXCESS] = filled - packing[PACKING_START] - slack;
    const double inverse_h = 1.0 / (loop->smoothing * own[record_diameter(dimension)]);
    const double self =
        own[record_volume(dimension)] * kernel_value(0.0, inverse_h, dimension) * square(inverse_h);
    const double sum = all[at.packing] + self * muscl_told(packing[PACKING_EXCESS]);
    packing[PACKING_MEAN] = self > 0.0 ? sum / (all[at.like] + self) : 0.0;
    double det;
    const double norm = sqrt(sym3_square(adjoint_of(dimension, moments->of_forces, &det)));
    packing[PACKING_THIN] = 100.0 * det > norm ? norm / det : 100.0;
    if (packing[PACKING_THIN_START] == 0.0)
        packing[PACKING_THIN_START] =
            maximum(dimension == 2 ? 2.0 : 2.2360679774997896, packing[PACKING_THIN]);
}

/* How the volume of a particle grows as it and its neighbours move: by the gradient T/N of the
 * velocities that they move with, that of least squares weighed by V W/h^2, in which both sides of
 * a shock count. Volumes so arrive where the places do. What contact velocities are ahead of these
 * is exchanged between neighbours: it damps what the lattice could do by itself, and adds up to
 * nothing over a shock. Where N has next to nothing on some axis, as in a sheet of one layer, the
 * contact velocities alone must do: the norm of the inverse of N times its trace is
 * dimension^(3/2) where neighbours stand evenly, and the share falls from one to none as it grows
 * from 1.4 to 2.8 of that. */
BOLIDE_INLINE void write_volume(const struct muscl_loop *loop, struct muscl_kind kind, int32_t i,
                                const double *all)
{
    const int dimension = kind.dimension;
    const struct layout at = layout_of(kind);
    const struct sym3 n = stress_from(dimension, all + at.spread, 1);
    const double trace = n.xx + n.yy + n.zz,
                 even = dimension == 2 ? 2.8284271247461903 : 5.196152422706632;
    double det, *volume = loop->rates.volume[i];
    struct sym3 adjoint = adjoint_of(dimension, n, &det);
    if (dimension == 2)
        adjoint.zz = 0.0;
    const double uneven = sqrt(sym3_square(adjoint)) * trace / even; /* times det N */
    const double share = minimum(1.0, 2.0 - uneven / (1.4 * det));
    memset(volume, 0, sizeof *loop->rates.volume);
    if (!(det > 0.0 && share > 0.0))
        return;
    const struct sym3 l = sym3_scale(1.0 / det, adjoint);
    const struct vec3 x = corrected(dimension, l, all + at.parting);
    const struct vec3 y = corrected(dimension, l, all + at.parting + dimension);
    volume[VOLUME_SHARE] = share;
    volume[VOLUME_FIRST] = x.x + y.y;
    volume[VOLUME_SECOND] = x.x * y.y - x.y * y.x;
    if (dimension > 2) {
        const struct vec3 z = corrected(dimension, l, all + at.parting + 6);
        volume[VOLUME_FIRST] += z.z;
        volume[VOLUME_SECOND] += x.x * z.z - x.z * z.x + (y.y * z.z - y.z * z.y);
        volume[VOLUME_THIRD] = vec3_dot(x, vec3_cross(y, z));
    }
    volume[VOLUME_EXCHANGE] = -2.0 * all[at.exchange];
}

/* Strain rate, spin and, on a line, drift. O is the first moment. */
BOLIDE_INLINE void write_strain(const struct muscl_loop *loop, struct muscl_kind kind, int32_t i,
                                const double *all, struct sym3 l, struct vec3 o)
{
    const int dimension = kind.dimension;
    const struct layout at = layout_of(kind);
    const struct pair_rates *rates = &loop->rates.sums;
    const struct vec3 none = {0.0, 0.0, 0.0};
    struct vec3 x = vec3_scale(-2.0, corrected(dimension, l, all + at.gradient)), y = none,
                z = none;
    if (dimension > 1)
        y = vec3_scale(-2.0, corrected(dimension, l, all + at.gradient + dimension));
    if (dimension > 2)
        z = vec3_scale(-2.0, corrected(dimension, l, all + at.gradient + 2 * dimension));
    const double strain[6] = {
        x.x, y.y, z.z, 0.5 * (x.y + y.x), 0.5 * (y.z + z.y), 0.5 * (z.x + x.z)};
    memcpy(rates->strain_rate[i], strain, sizeof strain);
    rates->spin[i][0] = 0.5 * (z.y - y.z);
    rates->spin[i][1] = 0.5 * (x.z - z.x);
    rates->spin[i][2] = 0.5 * (y.x - x.y);
    if (dimension > 1 || !rates->drift)
        return;
    /* The mean of contact velocities, less what a linear field gives where neighbours lie to one
     * side. */
    const double weight = all[at.weight];
    const double drift[3] = {weight < 0.0 ? (all[at.drift] + 0.5 * x.x * o.x) / weight : 0.0, 0.0,
                             0.0};
    memcpy(rates->drift[i], drift, sizeof drift);
}

/* The slopes of all values, by direction: L times their sums. */
BOLIDE_INLINE void find_slopes(struct muscl_kind kind, const double *sums, struct sym3 l,
                               double *slope)
{
    const int values = muscl_values(kind);
    const double rows[3][3] = {{l.xx, l.xy, l.zx}, {l.xy, l.yy, l.yz}, {l.zx, l.yz, l.zz}};
    for (int a = 0; a < kind.dimension; a++)
        for (int f = 0; f < values; f++) {
            double sum = rows[a][0] * sums[f];
            for (int b = 1; b < kind.dimension; b++)
                sum += rows[a][b] * sums[b * values + f];
            slope[a * values + f] = sum;
        }
}

/* The force on a unit of volume that the values after the step will make: from their slopes, and
 * from the stress that ends at a free surface. There, with the first moment O and the mean distance
 * r of neighbours, sigma.O 2/r is what neighbours on one side only add up to. Inside O is small and
 * says nothing of a surface: it counts by |O|^3/(O.M.O), one at a flat surface and beyond. Without
 * this a free surface would feel what pulls it half a step late, and thin plates would ring louder
 * and louder. */
BOLIDE_INLINE struct vec3 expected_force(struct muscl_kind kind, const double *own,
                                         const double *all, const struct moments *moments,
                                         struct sym3 l, double share)
{
    const int dimension = kind.dimension, stresses = muscl_stresses(kind);
    const int values = muscl_values(kind);
    const struct layout at = layout_of(kind);
    const struct sym3 m = moments->second;
    const struct vec3 o = moments->first;
    double slopes[3 * (ROW + 1)], stress[6];
    find_slopes(kind, all + at.slopes, l, slopes);
    for (int b = 0; b < stresses; b++)
        stress[b] = own[muscl_next(kind, dimension + b)];
    const double *x = slopes + dimension, *y = x + values, *z = y + values;
    const double across = vec3_dot(o, sym3_dot(m, o)), square = vec3_dot(o, o);
    const double trace = m.xx + (dimension > 1 ? m.yy : 0.0) + (dimension > 2 ? m.zz : 0.0);
    const bool any = across > 0.0 && trace > 0.0;
    const double surface = any ? minimum(1.0, square * sqrt(square) / across) : 0.0;
    const double ends = any ? -2.0 * all[at.weight] / trace * surface : 0.0;
    struct vec3 inside, end;
    if (stresses == 1) {
        inside = vec3_make(x[0], dimension > 1 ? y[0] : 0.0, dimension > 2 ? z[0] : 0.0);
        end = vec3_scale(stress[0], o);
    } else {
        inside = dimension == 2
                     ? vec3_make(x[0] + y[2], x[2] + y[1], 0.0)
                     : vec3_make(x[0] + y[3] + z[5], x[3] + y[1] + z[4], x[5] + y[4] + z[2]);
        end = traction_of(dimension, stress_from(dimension, stress, 1), o);
    }
    return vec3_add(vec3_scale(share, inside), vec3_scale(ends, end));
}

/* What the next step starts from. */
BOLIDE_INLINE void write_gradients(const struct muscl_loop *loop, struct muscl_kind kind, int32_t i,
                                   const double *all, const struct moments *moments)
{
    const int dimension = kind.dimension, stresses = muscl_stresses(kind);
    const int values = muscl_values(kind);
    const struct layout at = layout_of(kind);
    const double *own = loop->record + (size_t)i * (size_t)muscl_stride(kind);
    const struct sym3 of_forces = correction_of(dimension, moments->of_forces);
    write_tensor(dimension, of_forces,
                 loop->rates.correction + (size_t)i * (size_t)tensor_components(dimension));
    double slope[3 * (ROW + 1)];
    find_slopes(kind, all + at.slopes, moments->inverse, slope);
    double *g = loop->rates.velocity_gradient + (size_t)i * (size_t)(dimension * dimension);
    double *h = loop->rates.stress_gradient + (size_t)i * (size_t)(dimension * stresses);
    /* Beside matter of far higher impedance the stress is that matter's, and so is the slope. */
    const double ours = 2.0 * own[muscl_impedance(kind)] * all[at.weight], mean = all[at.impedance];
    const double share = ours > mean ? ours / mean : 1.0;
    for (int a = 0; a < dimension; a++) {
        for (int b = 0; b < dimension; b++)
            g[b * dimension + a] = slope[a * values + b];
        for (int b = 0; b < stresses; b++)
            h[a * stresses + b] = share * slope[a * values + dimension + b];
    }
    const struct vec3 force = expected_force(kind, own, all, moments, of_forces, share);
    const double forces[3] = {force.x, force.y, force.z};
    memcpy(loop->rates.force[i], forces, sizeof forces);
}

/* FACTOR turns sums of forces into those of a unit of mass; IMAGES are the tractions of images. */
BOLIDE_INLINE void write_rates(const struct muscl_loop *loop, struct muscl_kind kind, int32_t i,
                               double factor, const double *all, const double *images)
{
    const struct pair_rates *rates = &loop->rates.sums;
    const struct layout at = layout_of(kind);
    const double *half =
        loop->record + (size_t)i * (size_t)muscl_stride(kind) + record_velocity(kind.dimension);
    double power = factor * all[at.power];
    for (int a = 0; a < 3; a++) {
        rates->acceleration[i][a] = a < kind.dimension ? factor * all[at.traction + a] : 0.0;
        if (rates->wall)
            rates->wall[i][a] = a < kind.dimension ? factor * images[a] : 0.0;
        if (a < kind.dimension) /* the sums saw the velocity half a step ahead */
            power += rates->acceleration[i][a] * (half[a] - loop->velocity[i][a]);
    }
    rates->power[i] = power;
    if (rates->hoop_pull) {
        rates->hoop_pull[i] = 1.0 + all[at.hoop + 1] - 2.0 * all[at.hoop];
        rates->hoop_strain[i] = 1.0;
    }
    struct moments moments;
    moments.first = vector_from(kind.dimension, all + at.offset, 1);
    moments.second = stress_from(kind.dimension, all + at.moment, 1);
    moments.inverse = correction_of(kind.dimension, moments.second);
    moments.of_forces = moment_of_forces(moments.second, moments.first);
    if (kind.dimension > 1) {
        write_packing(loop, kind, i, all, &moments);
        write_volume(loop, kind, i, all);
    }
    write_strain(loop, kind, i, all, moments.inverse, moments.first);
    write_gradients(loop, kind, i, all, &moments);
}

#endif
