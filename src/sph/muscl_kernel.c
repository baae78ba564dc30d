/* The pair loop of the second-order contact method for one instruction set, named by BOLIDE_ISA; see
 * muscl_kernel.h. The area vector is that of the renormalised meshless methods (Lanson and Vila, SIAM J. Numer. Anal. 46
 * (2008) 1912), the slopes' limiter van Leer's (J. Comput. Phys. 14 (1974) 361). */
#include "sph/muscl_kernel.h"
#include "riemann/shock.h"
#include "sph/kernel.h"
#include "sph/record.h"

enum { FIELDS = 64, SUMS = 56 };

struct lanes {
    double field[FIELDS][LANES] ALIGNED;
    double slip[LANES] ALIGNED, open[LANES] ALIGNED;
};

/* Where the sums over a row stand, with w = V W' and f = 2 D_i/(D_i + D_j) twice the share of the pair that i has. */
struct layout {
    int traction, power; /* w |a| t*, w |a| t*.(U* - U) */
    int gradient;        /* w (U* - U)^a e^b */
    int weight, drift;   /* w, w (U* - U) */
    int offset, moment;  /* -f w x, -f w x^a e^b */
    int velocity_gradient,
        stress_gradient; /* -f w du^a e^b, -f w dstress e^b by b, of the values after the step */
    int hoop;            /* of axisymmetry: w |a| (depth - d) n_x, w |a| x n_x */
    int count;           /* a multiple of eight */
};

INLINE struct layout layout_of(struct muscl_kind kind)
{
    const int dimension = kind.dimension, tensor = tensor_components(dimension);
    struct layout at;
    at.traction = 0;
    at.power = dimension;
    at.gradient = at.power + 1;
    at.weight = at.gradient + dimension * dimension;
    at.drift = at.weight + 1;
    at.offset = at.drift + dimension;
    at.moment = at.offset + dimension;
    at.velocity_gradient = at.moment + tensor;
    at.stress_gradient = at.velocity_gradient + dimension * dimension;
    at.hoop = at.stress_gradient + dimension * muscl_stresses(kind);
    at.count = (at.hoop + (kind.depth ? 2 : 0) + 7) / 8 * 8;
    return at;
}

/* The shares of the change D between two particles that limited slopes carry from each to the middle: b/(D + b) with b
 * = 2 C - D, the change that lies on the other side when the slope changes by C over the pair; nothing where b turns
 * against D, or where SAME is zero. SQUARE_CHANGE is D^2; OWN and OTHER are D C. */
struct shares {
    double own, other;
};

INLINE struct shares limited_shares(double same, double square_change, double own, double other)
{
    const double tiny = 1e-140;
    double a = same * maximum(2.0 * own - square_change, 0.0);
    double b = same * maximum(2.0 * other - square_change, 0.0);
    double whole_a = square_change + a + tiny, whole_b = square_change + b + tiny;
    double inverse = 1.0 / (whole_a * whole_b);
    struct shares shares = {a * whole_b * inverse, b * whole_a * inverse};
    return shares;
}

/* (x.grad) v from the rows of grad v that stand STEP doubles apart. */
INLINE struct vec3 change_of_vector(int dimension, const double *g, int step, struct vec3 x)
{
    if (dimension == 1)
        return vec3_make(g[0] * x.x, 0.0, 0.0);
    if (dimension == 2)
        return vec3_make(g[0] * x.x + g[step] * x.y, g[2 * step] * x.x + g[3 * step] * x.y, 0.0);
    return vec3_make(g[0] * x.x + g[step] * x.y + g[2 * step] * x.z,
                     g[3 * step] * x.x + g[4 * step] * x.y + g[5 * step] * x.z,
                     g[6 * step] * x.x + g[7 * step] * x.y + g[8 * step] * x.z);
}

/* |div v|/(|div v| + |curl v|) of the gradient G. */
INLINE double share_of_compression(int dimension, const double *g, int step)
{
    double divergence, curl;
    if (dimension == 2) {
        divergence = fabs(g[0] + g[3 * step]);
        curl = fabs(g[2 * step] - g[step]);
    } else {
        divergence = fabs(g[0] + g[4 * step] + g[8 * step]);
        curl = sqrt(square(g[7 * step] - g[5 * step]) + square(g[2 * step] - g[6 * step]) +
                    square(g[3 * step] - g[step]));
    }
    return (divergence + 1e-100) / (divergence + curl + 1e-100);
}

/* (x.grad) stress, likewise. */
INLINE struct sym3 change_of_stress(struct muscl_kind kind, const double *g, int step,
                                    struct vec3 x)
{
    const int dimension = kind.shear ? kind.dimension : 1, next = muscl_stresses(kind) * step;
    struct sym3 change = sym3_scale(x.x, stress_from(dimension, g, step));
    if (kind.dimension > 1)
        change = sym3_add(change, sym3_scale(x.y, stress_from(dimension, g + next, step)));
    if (kind.dimension > 2)
        change = sym3_add(change, sym3_scale(x.z, stress_from(dimension, g + 2 * next, step)));
    return change;
}

/* Adds V to the sums of a vector that begin at AT, and V^a E^b to those of a tensor. */
INLINE void add_vector(int dimension, double (*sums)[LANES], int at, int k, struct vec3 v)
{
    sums[at][k] += v.x;
    if (dimension > 1)
        sums[at + 1][k] += v.y;
    if (dimension > 2)
        sums[at + 2][k] += v.z;
}

INLINE void add_product(int dimension, double (*sums)[LANES], int at, int k, struct vec3 v,
                        struct vec3 e)
{
    add_vector(dimension, sums, at, k, vec3_scale(v.x, e));
    if (dimension > 1)
        add_vector(dimension, sums, at + dimension, k, vec3_scale(v.y, e));
    if (dimension > 2)
        add_vector(dimension, sums, at + 2 * dimension, k, vec3_scale(v.z, e));
}

/* The vector that stands STEP doubles apart from V on. */
INLINE struct vec3 vector_from(int dimension, const double *v, int step)
{
    return vec3_make(v[0], dimension > 1 ? v[step] : 0.0, dimension > 2 ? v[2 * step] : 0.0);
}

/* One own particle against eight neighbours. */
INLINE void add_lanes(struct muscl_kind kind, bool with_law, double smoothing, const double *own,
                      const struct lanes *lanes, double (*sums)[LANES])
{
    const int dimension = kind.dimension;
    const bool shear = kind.shear && dimension > 1;
    const int d = record_diameter(dimension), v = record_volume(dimension);
    const int u = record_velocity(dimension), s = record_stress(dimension);
    const int z = muscl_impedance(kind), q = muscl_bend(kind), matter = muscl_material(kind);
    const int l = muscl_correction(kind), g = muscl_velocity_gradient(kind);
    const int h = muscl_stress_gradient(kind), stresses = muscl_stresses(kind);
    const int next_u = muscl_next(kind), next_s = next_u + dimension;
    const struct layout at = layout_of(kind);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        const struct vec3 x = vec3_sub(vector_from(dimension, &lanes->field[0][k], LANES),
                                       vector_from(dimension, own, 1));
        const struct vec3 du = vec3_sub(vector_from(dimension, &lanes->field[u][k], LANES),
                                        vector_from(dimension, own + u, 1));
        double r = sqrt(maximum(vec3_dot(x, x), 1e-200));
        struct vec3 e = vec3_scale(1.0 / r, x);
        double inverse_h = 2.0 / (smoothing * (own[d] + lanes->field[d][k]));
        double weight = lanes->field[v][k] * kernel_slope(r, inverse_h, dimension);
        double near_i = smoothing * own[d] * inverse_h, near_j = 2.0 - near_i;

        struct sym3 both = sym3_add(stress_from(dimension, own + l, 1),
                                    stress_from(dimension, &lanes->field[l][k], LANES));
        struct vec3 a = vec3_scale(0.5, traction_of(dimension, both, e));
        double area = dimension == 1 ? a.x * e.x : sqrt(maximum(vec3_dot(a, a), 1e-200));
        struct vec3 n = dimension == 1 ? e : vec3_scale(1.0 / area, a);

        /* normal components, and by how much slopes change them over the pair */
        double same = with_law || own[matter] != lanes->field[matter][k] ? 0.0 : 1.0;
        struct vec3 ui = change_of_vector(dimension, own + g, 1, x);
        struct vec3 uj = change_of_vector(dimension, &lanes->field[g][k], LANES, x);
        struct sym3 hi = change_of_stress(kind, own + h, 1, x);
        struct sym3 hj = change_of_stress(kind, &lanes->field[h][k], LANES, x);
        struct vec3 ti = {0.0, 0.0, 0.0}, tj = ti, dti = ti, dtj = ti;
        double along_i = own[s], along_j = lanes->field[s][k], si_n = hi.xx, sj_n = hj.xx;
        if (shear) {
            ti = traction_of(dimension, stress_from(dimension, own + s, 1), n);
            tj = traction_of(dimension, stress_from(dimension, &lanes->field[s][k], LANES), n);
            dti = traction_of(dimension, hi, n);
            dtj = traction_of(dimension, hj, n);
            along_i = vec3_dot(ti, n);
            along_j = vec3_dot(tj, n);
            si_n = vec3_dot(dti, n);
            sj_n = vec3_dot(dtj, n);
        }
        double along_u = vec3_dot(du, n), along_s = along_j - along_i;
        struct shares of_u = limited_shares(same, square(along_u), along_u * vec3_dot(ui, n),
                                            along_u * vec3_dot(uj, n));
        struct shares of_s = limited_shares(same, square(along_s), along_s * si_n, along_s * sj_n);
        double rise_u = near_i * of_u.own * along_u;
        double jump_u = along_u - rise_u - near_j * of_u.other * along_u;
        double left_s = along_i + near_i * of_s.own * along_s;
        double right_s = along_j - near_j * of_s.other * along_s, jump_s = right_s - left_s;
        struct contact_weights along = riemann_shock_weights(own[z], lanes->field[z][k], own[q],
                                                             lanes->field[q][k], jump_u, jump_s);
        /* fluids that shear past each other are not braked as if they met */
        double brake = 1.0;
        if (dimension > 1) {
            bool fluids = !shear || own[z + 1] + lanes->field[z + 1][k] == 0.0;
            double most = maximum(share_of_compression(dimension, own + g, 1),
                                  share_of_compression(dimension, &lanes->field[g][k], LANES));
            brake = fluids ? most : 1.0;
        }
        double stress = contact_stress(along, left_s, right_s, brake * jump_u);
        double jump = rise_u + contact_velocity_jump(along, jump_u, jump_s);
        double opened = 0.0;
        if (with_law) {
            opened = stress > 0.0 ? lanes->open[k] : 0.0;
            jump = opened > 0.0 ? -along_i / own[z] : jump;
            stress = opened > 0.0 ? 0.0 : stress;
        }
        struct vec3 t = vec3_scale(stress, n), w = vec3_scale(jump, n);
        if (dimension > 1) {
            struct vec3 across_u = vec3_sub(du, vec3_scale(along_u, n));
            struct shares of_v = limited_shares(same, vec3_dot(across_u, across_u),
                                                vec3_dot(across_u, ui), vec3_dot(across_u, uj));
            of_v.own *= near_i;
            of_v.other *= near_j;
            double open_u = 1.0 - of_v.own - of_v.other;
            if (shear) {
                struct contact_weights across =
                    riemann_acoustic_weights(own[z + 1], lanes->field[z + 1][k]);
                struct vec3 ai = vec3_sub(ti, vec3_scale(along_i, n));
                struct vec3 da = vec3_sub(vec3_sub(tj, vec3_scale(along_j, n)), ai);
                struct shares of_a =
                    limited_shares(same, vec3_dot(da, da), vec3_dot(da, dti), vec3_dot(da, dtj));
                of_a.own *= near_i;
                of_a.other *= near_j;
                /* of the jump DA, what reaches the contact: that from the right by the left's share, and back */
                double share = across.left * (1.0 - of_a.other) + across.right * of_a.own;
                struct vec3 ta = vec3_add(vec3_add(ai, vec3_scale(share, da)),
                                          vec3_scale(across.impedance * open_u, across_u));
                struct vec3 wa =
                    vec3_add(vec3_scale(of_v.own + across.right * open_u, across_u),
                             vec3_scale(across.compliance * (1.0 - of_a.own - of_a.other), da));
                if (with_law) {
                    bool free = opened > 0.0 || lanes->slip[k] > 0.0;
                    double still = own[z + 1] > 0.0 ? -1.0 / own[z + 1] : 0.0;
                    ta = vec3_scale(free ? 0.0 : 1.0, ta);
                    wa.x = free ? still * ai.x : wa.x;
                    wa.y = free ? still * ai.y : wa.y;
                    wa.z = free ? still * ai.z : wa.z;
                }
                t = vec3_add(t, ta);
                w = vec3_add(w, wa);
            } else {
                w = vec3_add(w, vec3_scale(of_v.own + 0.5 * open_u, across_u));
            }
        }
        double force_weight = weight * area;
        if (kind.depth) {
            const int depth = muscl_depth(kind);
            double pair_depth = 0.5 * fabs(own[depth] + lanes->field[depth][k]);
            sums[at.hoop][k] += force_weight * (pair_depth - own[depth]) * n.x;
            sums[at.hoop + 1][k] += force_weight * x.x * n.x;
            force_weight *= pair_depth;
        }
        sums[at.power][k] += force_weight * vec3_dot(t, w);
        sums[at.weight][k] += weight;
        add_vector(dimension, sums, at.traction, k, vec3_scale(force_weight, t));
        w = vec3_scale(weight, w);
        add_vector(dimension, sums, at.drift, k, w);
        add_product(dimension, sums, at.gradient, k, w, e);

        struct vec3 c = vec3_scale(-weight * near_i, e), m = vec3_scale(r, c);
        add_vector(dimension, sums, at.offset, k, m);
        sums[at.moment][k] += m.x * e.x;
        if (dimension == 2) {
            sums[at.moment + 1][k] += m.y * e.y;
            sums[at.moment + 2][k] += m.x * e.y;
        }
        if (dimension == 3) {
            sums[at.moment + 1][k] += m.y * e.y;
            sums[at.moment + 2][k] += m.z * e.z;
            sums[at.moment + 3][k] += m.x * e.y;
            sums[at.moment + 4][k] += m.y * e.z;
            sums[at.moment + 5][k] += m.z * e.x;
        }
        add_product(dimension, sums, at.velocity_gradient, k,
                    vec3_sub(vector_from(dimension, &lanes->field[next_u][k], LANES),
                             vector_from(dimension, own + next_u, 1)),
                    c);
        for (int b = 0; b < stresses; b++) {
            double ds = lanes->field[next_s + b][k] - own[next_s + b];
            sums[at.stress_gradient + b][k] += ds * c.x;
            if (dimension > 1)
                sums[at.stress_gradient + stresses + b][k] += ds * c.y;
            if (dimension > 2)
                sums[at.stress_gradient + 2 * stresses + b][k] += ds * c.z;
        }
    }
}

/* Adds the entries of one part of a row. */
INLINE void add_part(const struct muscl_loop *loop, struct muscl_kind kind, bool with_law,
                     int32_t i, const uint32_t *entry, int count, double (*sums)[LANES])
{
    const struct lane_records records = {loop->record, muscl_stride(kind), kind.dimension,
                                         loop->empty, loop->smoothing};
    const double *own = loop->record + (size_t)i * (size_t)records.stride;
    struct lane_walk walk;
    struct lanes lanes;
    walk.looked_at = walk.ready = walk.waiting = 0;
    while (lanes_walk(&walk, records, own, entry, count))
        for (int k = 0; k < walk.ready; k += LANES) {
            lanes_stage(records, walk.list + k, lanes.field);
            if (with_law)
                stage_laws(loop->neighbours, loop->groups, loop->body, i, walk.list + k, lanes.slip,
                           lanes.open);
            add_lanes(kind, with_law, loop->smoothing, own, &lanes, sums);
        }
}

/* The inverse of the second moment M, 1 on a complete lattice. Where neighbours lie to one side or in a plane M is
 * nearly singular, and its inverse gives way to the unit tensor as its norm grows from 8 to 16; a corner of a cubic
 * lattice has 5. */
INLINE struct sym3 correction_of(int dimension, struct sym3 m)
{
    const struct sym3 one = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
    if (dimension < 3)
        m.zz = 1.0;
    if (dimension < 2)
        m.yy = 1.0;
    struct sym3 l = {m.yy * m.zz - square(m.yz), m.xx * m.zz - square(m.zx),
                     m.xx * m.yy - square(m.xy), m.yz * m.zx - m.xy * m.zz,
                     m.xy * m.zx - m.yz * m.xx,  m.xy * m.yz - m.zx * m.yy};
    double det = m.xx * l.xx + m.xy * l.xy + m.zx * l.zx;
    double norm = sqrt(sym3_square(l)) / maximum(det, 1e-100);
    double share = minimum(1.0, maximum(0.0, 2.0 - 0.125 * norm));
    double scale = share > 0.0 ? share / det : 0.0;
    return sym3_add(sym3_scale(scale, l), sym3_scale(1.0 - share, one));
}

/* Rows V of a tensor, times L. */
INLINE struct vec3 corrected(int dimension, struct sym3 l, const double *v)
{
    return sym3_dot(l, vector_from(dimension, v, 1));
}

/* The moment M, in the order of a record. */
INLINE void write_tensor(int dimension, struct sym3 m, double *to)
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

/* L for forces. Where neighbours lie to one side the moment is completed by what is missing on the other side, a free
 * surface that no stress acts on: with the first moment o, M + o o |o|^2/(o.M.o), which doubles it at the end of a line. */
INLINE struct sym3 correction_of_forces(int dimension, struct sym3 m, struct vec3 o)
{
    double across = vec3_dot(o, sym3_dot(m, o));
    double scale = across > 0.0 ? vec3_dot(o, o) / across : 0.0;
    struct sym3 missing = {o.x * o.x, o.y * o.y, o.z * o.z, o.x * o.y, o.y * o.z, o.z * o.x};
    return correction_of(dimension, sym3_add(m, sym3_scale(scale, missing)));
}

INLINE void write_gradients(const struct muscl_loop *loop, struct muscl_kind kind, int32_t i,
                            const double *all)
{
    const int dimension = kind.dimension, stresses = muscl_stresses(kind);
    const struct layout at = layout_of(kind);
    const struct pair_rates *rates = &loop->rates.sums;
    const struct sym3 m = stress_from(dimension, all + at.moment, 1);
    const struct vec3 offset = vector_from(dimension, all + at.offset, 1), none = {0.0, 0.0, 0.0};
    const struct sym3 l = correction_of(dimension, m);
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
    /* The mean of contact velocities, less what a linear field gives where neighbours lie to one side. */
    const double weight = all[at.weight], inverse = weight < 0.0 ? 1.0 / weight : 0.0;
    const struct vec3 linear =
        vec3_make(vec3_dot(x, offset), vec3_dot(y, offset), vec3_dot(z, offset));
    const struct vec3 drift = vec3_scale(
        inverse, vec3_add(vector_from(dimension, all + at.drift, 1), vec3_scale(0.5, linear)));
    const double drifts[3] = {drift.x, drift.y, drift.z};
    memcpy(rates->drift[i], drifts, sizeof drifts);
    write_tensor(dimension, correction_of_forces(dimension, m, offset),
                 loop->rates.correction + (size_t)i * (size_t)tensor_components(dimension));
    double *g = loop->rates.velocity_gradient + (size_t)i * (size_t)(dimension * dimension);
    for (int b = 0; b < dimension; b++) {
        struct vec3 slope = corrected(dimension, l, all + at.velocity_gradient + b * dimension);
        g[b * dimension] = slope.x;
        if (dimension > 1)
            g[b * dimension + 1] = slope.y;
        if (dimension > 2)
            g[b * dimension + 2] = slope.z;
    }
    double *h = loop->rates.stress_gradient + (size_t)i * (size_t)(dimension * stresses);
    for (int b = 0; b < stresses; b++) {
        const double *from = all + at.stress_gradient + b;
        struct vec3 slope = sym3_dot(l, vector_from(dimension, from, stresses));
        h[b] = slope.x;
        if (dimension > 1)
            h[stresses + b] = slope.y;
        if (dimension > 2)
            h[2 * stresses + b] = slope.z;
    }
}

/* FACTOR turns sums of forces into those of a unit of mass; IMAGES are the tractions of images. */
INLINE void write_rates(const struct muscl_loop *loop, struct muscl_kind kind, int32_t i,
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
    write_gradients(loop, kind, i, all);
}

/* Adds the entries from BEGIN on of the row's parts FIRST and FIRST + 1 (the same under a contact law); returns where
 * the next part begins. */
INLINE int add_parts(const struct muscl_loop *loop, struct muscl_kind kind, int32_t i,
                     const uint32_t *entry, int begin, unsigned first, double (*sums)[LANES])
{
    int count = (int)loop->neighbours->row[i].count, middle = begin;
    while (middle < count && entry[middle] >> ENTRY_PART_SHIFT == first)
        middle++;
    int end = middle;
    while (end < count && entry[end] >> ENTRY_PART_SHIFT == (first | PART_LAW))
        end++;
    if (middle > begin)
        add_part(loop, kind, false, i, entry + begin, middle - begin, sums);
    if (end > middle)
        add_part(loop, kind, true, i, entry + middle, end - middle, sums);
    return end;
}

INLINE void row_rates(const struct muscl_loop *loop, struct muscl_kind kind, int32_t i)
{
    const struct layout at = layout_of(kind);
    const uint32_t *entry = neighbours_row(loop->neighbours, i);
    const double *own = loop->record + (size_t)i * (size_t)muscl_stride(kind);
    double factor =
        -2.0 / (kind.depth ? loop->density[i] * own[muscl_depth(kind)] : loop->density[i]);
    double sums[SUMS][LANES] ALIGNED, all[SUMS], images[SUMS] = {0.0};
    memset(sums, 0, (size_t)at.count * sizeof *sums);
    int done = add_parts(loop, kind, i, entry, 0, 0, sums);
    lanes_totals(sums, at.count, all);
    if (done < (int)loop->neighbours->row[i].count) {
        memset(sums, 0, (size_t)at.count * sizeof *sums);
        add_parts(loop, kind, i, entry, done, PART_IMAGE, sums);
        lanes_totals(sums, at.count, images);
        for (int a = 0; a < at.count; a++)
            all[a] += images[a];
    }
    write_rates(loop, kind, i, factor, all, images);
}

/* Each body of the rows' loop is an instance; its name says of which kind. */
#define INSTANCE(name, ...)                                                     \
    static void name(const struct muscl_loop *loop, int32_t begin, int32_t end) \
    {                                                                           \
        const struct muscl_kind kind = {__VA_ARGS__};                           \
        for (int32_t i = begin; i < end; i++)                                   \
            row_rates(loop, kind, i);                                           \
    }

INSTANCE(line, 1, false, false)
INSTANCE(plane_fluid, 2, false, false)
INSTANCE(plane_solid, 2, true, false)
INSTANCE(deep_fluid, 2, false, true)
INSTANCE(deep_solid, 2, true, true)
INSTANCE(space_fluid, 3, false, false)
INSTANCE(space_solid, 3, true, false)

#define JOIN(a, b) a##b
#define NAME_OF(isa) JOIN(muscl_loop_run_, isa)

void NAME_OF(BOLIDE_ISA)(const struct muscl_loop *loop, int32_t begin, int32_t end);

void NAME_OF(BOLIDE_ISA)(const struct muscl_loop *loop, int32_t begin, int32_t end)
{
    typedef void instance(const struct muscl_loop *, int32_t, int32_t);
    enum { DEEP = 3 }; /* behind the dimensions */
    static instance *const table[4][2] = {{line, line},
                                          {plane_fluid, plane_solid},
                                          {space_fluid, space_solid},
                                          {deep_fluid, deep_solid}};
    table[loop->kind.depth ? DEEP : loop->kind.dimension - 1][loop->kind.shear](loop, begin, end);
}
