/* What the pair loop of second order does with one particle and eight of its neighbours: for the
 * files that are compiled once an instruction set, and for a device. The area vector is that of the
 * renormalised meshless methods (Lanson and Vila, SIAM J. Numer. Anal. 46 (2008) 1912). */
#ifndef BOLIDE_SPH_MUSCL_BODY_H
#define BOLIDE_SPH_MUSCL_BODY_H

#include "riemann/contact_pair.h"
#include "sph/kernel.h"
#include "sph/muscl/slopes.h"
#include "sph/muscl/sums.h"

enum {
    FIELDS = 44,
    GROUPS = 4 /* of eight neighbours: most lists in 3-D fit */
};

/* Eight neighbours: their records, and what stands in front of the rows there. */
struct lanes {
    const double *record[LANES];
    double field[FIELDS][LANES] ALIGNED;
    double slip[LANES] ALIGNED, open[LANES] ALIGNED;
};

/* Eight pairs between the parts of the kernel. Each part runs over all groups before the next
 * begins: what one group waits for, another fills. */
struct pairs {
    double x[3][LANES] ALIGNED, e[3][LANES] ALIGNED, n[3][LANES] ALIGNED;
    double c[3][LANES] ALIGNED; /* -V W' 2 D_i/(D_i + D_j) e */
    /* what values in rows change by over x, by the neighbour's slopes */
    double wide[ROW][LANES] ALIGNED;
    double weight[LANES] ALIGNED, area[LANES] ALIGNED; /* V W', |a| */
    double value[LANES] ALIGNED;                       /* V W/h^2, in 2-D and 3-D */
    double near[LANES] ALIGNED;                        /* 2 D_i/(D_i + D_j) */
    /* along n and across: changes over the pair, own stress, and shares of the slopes, times near
     */
    double along_u[LANES] ALIGNED, along_i[LANES] ALIGNED, along_j[LANES] ALIGNED;
    double across_u[3][LANES] ALIGNED, across_s[3][LANES] ALIGNED, traction[3][LANES] ALIGNED;
    double share[8][LANES] ALIGNED;
    double moves[3][LANES] ALIGNED; /* velocity of the contact relative to the own particle */
};

/* Adds V to the sums of a vector that begin at AT, and V^a E^b to those of a tensor. */
BOLIDE_INLINE void add_vector(int dimension, double (*sums)[LANES], int at, int k, struct vec3 v)
{
    sums[at][k] += v.x;
    if (dimension > 1)
        sums[at + 1][k] += v.y;
    if (dimension > 2)
        sums[at + 2][k] += v.z;
}

BOLIDE_INLINE void add_product(int dimension, double (*sums)[LANES], int at, int k, struct vec3 v,
                               struct vec3 e)
{
    add_vector(dimension, sums, at, k, vec3_scale(v.x, e));
    if (dimension > 1)
        add_vector(dimension, sums, at + dimension, k, vec3_scale(v.y, e));
    if (dimension > 2)
        add_vector(dimension, sums, at + 2 * dimension, k, vec3_scale(v.z, e));
}

/* Adds V^a E^b, V along E, to the sums of a symmetric tensor, in the order of a record. */
BOLIDE_INLINE void add_symmetric(int dimension, double (*sums)[LANES], int at, int k, struct vec3 v,
                                 struct vec3 e)
{
    sums[at][k] += v.x * e.x;
    if (dimension == 2) {
        sums[at + 1][k] += v.y * e.y;
        sums[at + 2][k] += v.x * e.y;
    }
    if (dimension == 3) {
        sums[at + 1][k] += v.y * e.y;
        sums[at + 2][k] += v.z * e.z;
        sums[at + 3][k] += v.x * e.y;
        sums[at + 4][k] += v.y * e.z;
        sums[at + 5][k] += v.z * e.x;
    }
}

BOLIDE_INLINE void put_vector(int dimension, double (*to)[LANES], int k, struct vec3 v)
{
    to[0][k] = v.x;
    if (dimension > 1)
        to[1][k] = v.y;
    if (dimension > 2)
        to[2][k] = v.z;
}

/* One own particle against eight neighbours: where they are, how much they count, and the moments
 * of that. */
BOLIDE_INLINE void find_places(struct muscl_kind kind, bool with_law, double smoothing,
                               const double *own, const struct lanes *lanes, struct pairs *pairs,
                               double (*sums)[LANES])
{
    const int dimension = kind.dimension;
    const int d = record_diameter(dimension), v = record_volume(dimension);
    const int l = muscl_correction(kind), z = muscl_impedance(kind);
    const int compression = muscl_compression(kind);
    const struct layout at = layout_of(kind);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        const struct vec3 x = vec3_sub(vector_from(dimension, &lanes->field[0][k], LANES),
                                       vector_from(dimension, own, 1));
        struct sym3 both = sym3_add(stress_from(dimension, own + l, 1),
                                    stress_from(dimension, &lanes->field[l][k], LANES));
        struct vec3 lx = traction_of(dimension, both, x);
        double r = sqrt(maximum(vec3_dot(x, x), 1e-80));
        double ar = dimension == 1 ? fabs(lx.x) : sqrt(maximum(vec3_dot(lx, lx), 1e-80));
        double two_h = smoothing * (own[d] + lanes->field[d][k]);
        double inverse = 1.0 / (r * ar * two_h); /* one division serves three */
        double inverse_r = inverse * (ar * two_h), inverse_h = 2.0 * (inverse * (r * ar));
        struct vec3 e = vec3_scale(inverse_r, x);
        put_vector(dimension, pairs->x, k, x);
        put_vector(dimension, pairs->e, k, e);
        put_vector(dimension, pairs->n, k,
                   dimension == 1 ? e : vec3_scale(inverse * (r * two_h), lx));
        double volume = lanes->field[v][k];
        if (with_law)
            volume = muscl_meet(own[compression], lanes->field[compression][k]) ? volume : 0.0;
        double weight = volume * kernel_slope(r, inverse_h, dimension);
        pairs->weight[k] = weight;
        if (dimension > 1)
            pairs->value[k] = volume * kernel_value(r, inverse_h, dimension) * square(inverse_h);
        pairs->area[k] = 0.5 * (ar * inverse_r);
        double near = smoothing * own[d] * inverse_h;
        pairs->near[k] = near;
        const struct vec3 c = vec3_scale(-weight * near, e);
        const struct vec3 m = vec3_scale(vec3_dot(x, e), c);
        put_vector(dimension, pairs->c, k, c);
        add_vector(dimension, sums, at.offset, k, m);
        add_symmetric(dimension, sums, at.moment, k, m, e);
        sums[at.weight][k] += weight;
        sums[at.impedance][k] += weight * lanes->field[z][k];
    }
}

/* What stands in rows, one neighbour after the other: what these change by over x, and their sums
 * of slopes. */
BOLIDE_INLINE void walk_rows(struct muscl_kind kind, const double *own, const struct lanes *lanes,
                             struct pairs *pairs, double (*sums)[ROW])
{
    const int wide = muscl_wide(kind), first = muscl_wide_rows(kind);
    const int next = first + kind.dimension * wide;
    double change[LANES][ROW] ALIGNED;
    const double *row[LANES];
    for (int k = 0; k < LANES; k++) {
        const double *g = lanes->record[k] + first, *q = lanes->record[k] + next;
#pragma omp simd
        for (int f = 0; f < wide; f++) {
            double sum = pairs->x[0][k] * g[f] + pairs->x[1][k] * g[wide + f];
            if (kind.dimension > 2)
                sum += pairs->x[2][k] * g[2 * wide + f];
            change[k][f] = sum;
            double dq = q[f] - own[next + f];
            sums[0][f] += pairs->c[0][k] * dq;
            sums[1][f] += pairs->c[1][k] * dq;
            if (kind.dimension > 2)
                sums[2][f] += pairs->c[2][k] * dq;
        }
        row[k] = change[k];
    }
    for (int f = 0; f < wide; f += 4)
        transpose(row, f, pairs->wide + f);
}

/* Adds to the sums of slopes after the step what is not in rows. */
BOLIDE_INLINE void add_slope(struct muscl_kind kind, const double *own, const struct lanes *lanes,
                             const struct pairs *pairs, double (*sums)[LANES], int k)
{
    const int dimension = kind.dimension, values = muscl_values(kind), narrow = muscl_narrow(kind);
    const struct layout at = layout_of(kind);
    const struct vec3 c = vector_from(dimension, &pairs->c[0][k], LANES);
    for (int f = values - narrow; f < values; f++) {
        const int from = muscl_next(kind, f), to = at.narrow + f - (values - narrow);
        double dq = lanes->field[from][k] - own[from];
        sums[to][k] += dq * c.x;
        if (dimension > 1)
            sums[to + narrow][k] += dq * c.y;
        if (dimension > 2)
            sums[to + 2 * narrow][k] += dq * c.z;
    }
}

BOLIDE_INLINE void add_slopes(struct muscl_kind kind, const double *own, const struct lanes *lanes,
                              const struct pairs *pairs, double (*sums)[LANES])
{
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++)
        add_slope(kind, own, lanes, pairs, sums, k);
}

/* The next two loops are written as a function of one lane. A local whose address is taken inside a
 * simd loop becomes an array of lanes, and the compiler then leaves the loop scalar; the locals of
 * an inlined function stay in registers. Conditions are selects without && and ||, for the same
 * reason. */

/* The differences between the two particles of a pair, along n and across, and the fractions of
 * them that limited slopes carry: zero unless both are of one MATERIAL and no law parts them. */
BOLIDE_INLINE void find_change(struct muscl_kind kind, bool with_law, double material,
                               const double *own, const struct lanes *lanes, struct pairs *pairs,
                               int k)
{
    const int dimension = kind.dimension;
    const bool shear = kind.shear && dimension > 1;
    const int u = record_velocity(dimension), s = record_stress(dimension);
    const int z = muscl_impedance(kind), q = muscl_shock_slope(kind), other = muscl_material(kind);
    const double own_z = own[z], own_q = own[q];
    const struct vec3 x = vector_from(dimension, &pairs->x[0][k], LANES);
    const struct vec3 n = vector_from(dimension, &pairs->n[0][k], LANES);
    const struct vec3 du = vec3_sub(vector_from(dimension, &lanes->field[u][k], LANES),
                                    vector_from(dimension, own + u, 1));
    const double along_u = vec3_dot(du, n), speed = fabs(along_u);
    const double other_z = lanes->field[z][k], other_q = lanes->field[q][k];
    const double law = with_law ? lanes->slip[k] + lanes->open[k] : 0.0;
    const bool smooth = (material == muscl_index(lanes->field[other][k])) & (law == 0.0) &
                        (speed * own_q < own_z) & (speed * other_q < other_z);
    const double near = pairs->near[k], near_i = smooth ? near : 0.0,
                 near_j = smooth ? 2.0 - near : 0.0;
    const struct slopes here = {own, NULL, 1};
    const struct slopes there = {&lanes->field[0][k], &pairs->wide[0][k], LANES};
    /* First all that velocities give, then one side's stress after the other's: that many values
     * stay in registers. */
    const struct vec3 ui = change_of_velocity(kind, here, x);
    const struct vec3 uj = change_of_velocity(kind, there, x);
    const double twice_u = 2.0 * along_u;
    const struct change change_u = {square(along_u), twice_u * vec3_dot(ui, n),
                                    twice_u * vec3_dot(uj, n)};
    struct change change_v = {0.0, 0.0, 0.0}, change_a = change_v;
    pairs->along_u[k] = along_u;
    if (dimension > 1) {
        const struct vec3 across_u = vec3_sub(du, vec3_scale(along_u, n));
        const struct vec3 twice_v = vec3_scale(2.0, across_u);
        change_v.square = vec3_dot(across_u, across_u);
        change_v.own = vec3_dot(twice_v, ui);
        change_v.other = vec3_dot(twice_v, uj);
        put_vector(dimension, pairs->across_u, k, across_u);
    }
    double along_i = own[s], along_j = lanes->field[s][k], si_n, sj_n;
    if (shear) {
        const struct vec3 ti = traction_of(dimension, stress_from(dimension, own + s, 1), n);
        const struct vec3 tj =
            traction_of(dimension, stress_from(dimension, &lanes->field[s][k], LANES), n);
        along_i = vec3_dot(ti, n);
        along_j = vec3_dot(tj, n);
        const struct vec3 across_s = vec3_sub(vec3_sub(tj, ti), vec3_scale(along_j - along_i, n));
        const struct vec3 twice_a = vec3_scale(2.0, across_s);
        change_a.square = vec3_dot(across_s, across_s);
        put_vector(dimension, pairs->across_s, k, across_s);
        put_vector(dimension, pairs->traction, k, ti);
        const struct vec3 dti = traction_of(dimension, change_of_stress(kind, here, x), n);
        si_n = vec3_dot(dti, n);
        change_a.own = vec3_dot(twice_a, dti);
        const struct vec3 dtj = traction_of(dimension, change_of_stress(kind, there, x), n);
        sj_n = vec3_dot(dtj, n);
        change_a.other = vec3_dot(twice_a, dtj);
    } else {
        si_n = change_of_stress(kind, here, x).xx;
        sj_n = change_of_stress(kind, there, x).xx;
    }
    const double along_s = along_j - along_i, twice_s = 2.0 * along_s;
    const struct change change_s = {square(along_s), twice_s * si_n, twice_s * sj_n};
    struct shares of_u, of_s, of_v, of_a = {0.0, 0.0};
    limited_shares(change_u, change_s, &of_u, &of_s);
    pairs->along_i[k] = along_i;
    pairs->along_j[k] = along_j;
    pairs->share[0][k] = near_i * of_u.own;
    pairs->share[1][k] = near_j * of_u.other;
    pairs->share[2][k] = near_i * of_s.own;
    pairs->share[3][k] = near_j * of_s.other;
    if (dimension > 1) {
        limited_shares(change_v, change_a, &of_v, &of_a);
        pairs->share[4][k] = near_i * of_v.own;
        pairs->share[5][k] = near_j * of_v.other;
    }
    if (shear) {
        pairs->share[6][k] = near_i * of_a.own;
        pairs->share[7][k] = near_j * of_a.other;
    }
}

BOLIDE_INLINE void find_changes(struct muscl_kind kind, bool with_law, double material,
                                const double *own, const struct lanes *lanes, struct pairs *pairs)
{
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++)
        find_change(kind, with_law, material, own, lanes, pairs, k);
}

/* The data of a pair for the change of volumes: whether it counts, 0 or 1; whether its packing
 * counts, 1 in the same material and 0 in another; the velocity of the contact along n relative to
 * particle i and to its neighbour; the neighbour's compression relative to that of i, and its
 * packing. */
struct volume_pair {
    double counts, like, contact, compression, packing, credit;
    struct vec3 moved;
};

/* What the contact is ahead of its place between the two, one volume gains and the other loses:
 * weighed so that the sum of the logarithms stays, if they were of one size at the start. Rings
 * limit the weight: a thin one would gain the more the thinner it is. */
BOLIDE_INLINE void add_volume(struct muscl_kind kind, const struct pairs *pairs, int k,
                              const struct volume_pair *pair, double (*sums)[LANES])
{
    const int dimension = kind.dimension;
    const struct layout at = layout_of(kind);
    const struct vec3 x = vector_from(dimension, &pairs->x[0][k], LANES);
    const struct vec3 n = vector_from(dimension, &pairs->n[0][k], LANES);
    const struct vec3 m = vec3_scale(pair->counts * pairs->value[k], x);
    const double lead = pair->contact - 0.5 * pairs->near[k] * vec3_dot(pair->moved, n);
    const double weight = pair->counts * pairs->weight[k] * pairs->area[k];
    add_symmetric(dimension, sums, at.spread, k, m, x);
    add_product(dimension, sums, at.parting, k, pair->moved, m);
    sums[at.like][k] += pair->like * pairs->value[k];
    sums[at.packing][k] += pair->like * pairs->value[k] * pair->packing;
    if (kind.shear)
        sums[at.credit][k] += pair->like * pairs->value[k] * pair->credit;
    sums[at.exchange][k] += 0.5 * (1.0 + pair->compression) * weight * lead;
}

/* The contact of a pair, what limited it, and the velocity across the axis. */
struct solved_pair {
    struct pair_contact star;
    struct pair_limits limits;
    struct vec3 sliding;
};

/* Solves the Riemann problem of lane K. */
BOLIDE_INLINE struct solved_pair solve_pair(struct muscl_kind kind, bool with_law,
                                            const double *own, const struct lanes *lanes,
                                            const struct pairs *pairs, int k)
{
    const int dimension = kind.dimension;
    const bool shear = kind.shear && dimension > 1;
    const int z = muscl_impedance(kind), q = muscl_shock_slope(kind);
    const struct pair_law law = {STAR_SHOCK, shear, true, with_law, shear};
    const struct vec3 n = vector_from(dimension, &pairs->n[0][k], LANES);
    struct pair_side left = {.impedance = own[z],
                             .shock_slope = own[q],
                             .stress = pairs->along_i[k],
                             .carried = {pairs->share[0][k], pairs->share[2][k], 0.0, 0.0}};
    struct pair_side right = {.impedance = lanes->field[z][k],
                              .shock_slope = lanes->field[q][k],
                              .stress = pairs->along_j[k],
                              .carried = {pairs->share[1][k], pairs->share[3][k], 0.0, 0.0}};
    struct pair_difference difference = {.velocity = pairs->along_u[k]};
    struct pair_limits limits = {with_law ? lanes->slip[k] : 0.0, with_law ? lanes->open[k] : 0.0,
                                 1.0, 0.0};
    if (dimension > 1) {
        /* fluids that shear past each other are not braked as if they met */
        const double own_share = -own[z + 1], other_share = -lanes->field[z + 1][k];
        limits.brake =
            minimum(own_share, other_share) > 0.0 ? maximum(own_share, other_share) : 1.0;
        difference.sliding = vector_from(dimension, &pairs->across_u[0][k], LANES);
        left.carried.sliding = pairs->share[4][k];
        right.carried.sliding = pairs->share[5][k];
    }
    if (shear) {
        const struct vec3 ti = vector_from(dimension, &pairs->traction[0][k], LANES);
        left.shear_impedance = maximum(own[z + 1], 0.0);
        right.shear_impedance = maximum(lanes->field[z + 1][k], 0.0);
        left.shear = vec3_sub(ti, vec3_scale(left.stress, n));
        difference.shear = vector_from(dimension, &pairs->across_s[0][k], LANES);
        left.carried.shear = pairs->share[6][k];
        right.carried.shear = pairs->share[7][k];
        const int elastic = muscl_elasticity(kind);
        const double lawless = 1.0 - maximum(limits.slip, limits.open);
        limits.elastic = lawless * minimum(own[elastic], lanes->field[elastic][k]);
    }
    return (struct solved_pair){contact_pair(&left, &right, &difference, limits, law), limits,
                                difference.sliding};
}

/* Solves the Riemann problem of lane K and adds it to the sums. */
BOLIDE_INLINE void add_contact(struct muscl_kind kind, bool with_law, const double *own,
                               const struct lanes *lanes, struct pairs *pairs,
                               double (*sums)[LANES], int k)
{
    const int dimension = kind.dimension, m = muscl_material(kind);
    const int z = muscl_impedance(kind), q = muscl_shock_slope(kind);
    const int compression = muscl_compression(kind);
    const struct layout at = layout_of(kind);
    const double per_own = dimension > 1 ? 1.0 / fabs(own[compression]) : 1.0, own_m = own[m];
    const struct vec3 n = vector_from(dimension, &pairs->n[0][k], LANES);
    const struct solved_pair solved = solve_pair(kind, with_law, own, lanes, pairs, k);
    const struct pair_contact star = solved.star;
    struct vec3 t = vec3_scale(star.stress, n), w = vec3_scale(star.velocity, n);
    if (kind.shear && dimension > 1)
        t = vec3_add(t, star.shear);
    if (dimension > 1)
        w = vec3_add(w, star.sliding);
    /* Particles with prescribed motion do not deform each other: no wave runs between them. */
    const bool driven = muscl_driven(maximum(own_m, lanes->field[m][k]));
    const struct vec3 middle = vec3_scale(0.5 * pairs->along_u[k], n);
    const struct vec3 halfway =
        dimension > 1 ? vec3_add(middle, vec3_scale(0.5, solved.sliding)) : middle;
    w = vec3_make(driven ? halfway.x : w.x, driven ? halfway.y : w.y, driven ? halfway.z : w.z);
    /* A gas carries no tension. Two sides that separate faster than both expand into vacuum have
     * lost contact: the pair then counts neither in velocity gradients nor in volumes. For an ideal
     * gas that speed is 4 c/(gamma - 1); times A = (gamma + 1)/2 it is 8 c for gamma = 5/3. */
    const double parting = pairs->along_u[k];
    const double pull =
        maximum(fabs(own_m), fabs(lanes->field[m][k])) < MUSCL_GAS ? 0.0 : star.stress;
    const double faster = minimum(parting * own[q] - 8.0 * own[z],
                                  parting * lanes->field[q][k] - 8.0 * lanes->field[z][k]);
    const double holds = pull > 0.0 ? 0.0 : 1.0;
    const double meets = minimum(pull, faster) > 0.0 ? 0.0 : 1.0;
    const double weight = pairs->weight[k], moves = meets * weight;
    double force_weight = weight * pairs->area[k];
    if (kind.depth) {
        const int depth = muscl_depth(kind);
        double pair_depth = 0.5 * fabs(own[depth] + lanes->field[depth][k]);
        sums[at.hoop][k] += force_weight * (pair_depth - own[depth]) * n.x;
        sums[at.hoop + 1][k] += force_weight * pairs->x[0][k] * n.x;
        force_weight *= pair_depth;
    }
    t = vec3_scale(holds * force_weight, t);
    sums[at.power][k] += vec3_dot(t, w);
    add_vector(dimension, sums, at.traction, k, t);
    if (dimension == 1)
        sums[at.drift][k] += moves * w.x;
    add_product(dimension, sums, at.gradient, k, w,
                vec3_scale(moves, vector_from(dimension, &pairs->e[0][k], LANES)));
    if (dimension > 1) {
        put_vector(dimension, pairs->moves, k, w);
        add_vector(dimension, sums, at.open, k, vec3_scale(weight * pairs->area[k], n));
        /* Bodies keep their volumes where they part, and where they slide past each other. */
        const double counts = star.stress == 0.0 ? 1.0 - solved.limits.open : meets;
        const struct vec3 moved = vec3_add(vec3_scale(pairs->along_u[k], n),
                                           vec3_scale(1.0 - solved.limits.slip, solved.sliding));
        const double ratio = per_own * fabs(lanes->field[compression][k]), by = square(ratio);
        const double like = counts * minimum(by, 1.0) / maximum(by, 1.0);
        const struct volume_pair volume = {
            .counts = counts,
            .like = own_m == lanes->field[m][k] ? like : 0.0,
            .contact = vec3_dot(w, n),
            .compression = kind.depth ? minimum(ratio, 2.0) : ratio,
            .packing = lanes->field[muscl_packing(kind)][k],
            .credit = kind.shear ? lanes->field[muscl_credit(kind)][k] : 0.0,
            .moved = moved};
        add_volume(kind, pairs, k, &volume, sums);
    }
}

BOLIDE_INLINE void add_contacts(struct muscl_kind kind, bool with_law, const double *own,
                                const struct lanes *lanes, struct pairs *pairs,
                                double (*sums)[LANES])
{
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++)
        add_contact(kind, with_law, own, lanes, pairs, sums, k);
}

#endif
