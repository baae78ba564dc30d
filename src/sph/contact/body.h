/* What the pair loop of the contact schemes does with one particle and eight of its neighbours: for the files that are
 * compiled once an instruction set, and for a device. Contact terms are (1.20)-(1.37) of Parshikov (2013), with velocity
 * and traction split into the part along the pair and the part across it; how lists become lanes is lanes.h. */
#ifndef BOLIDE_SPH_CONTACT_BODY_H
#define BOLIDE_SPH_CONTACT_BODY_H

#include "sph/contact/kernel.h"
#include "sph/kernel.h"
#include "sph/record.h"

enum {
    FIELDS = 24,
    GROUPS = 4 /* of eight neighbours: most rows in space fit */
};

/* Eight neighbours, field by field, and for each whether a contact law cuts shear or tension. */
struct lanes {
    double field[FIELDS][LANES] ALIGNED;
    double slip[LANES] ALIGNED, open[LANES] ALIGNED;
};

/* Eight pairs between the two parts of the kernel. Each part runs over all groups before the next begins: what one group
 * waits for, another fills. */
struct pairs {
    double x[LANES] ALIGNED, r[LANES] ALIGNED, e[3][LANES] ALIGNED;
    double weight[LANES] ALIGNED; /* V W' */
};

/* Sums of V W' t*, V W' (U* - U)^a e^b and V W' t*.(U* - U), by lane. */
struct sums {
    double traction[3][LANES] ALIGNED, gradient[9][LANES] ALIGNED, power[LANES] ALIGNED;
    double weight[LANES] ALIGNED, drift[3][LANES] ALIGNED; /* V W', V W' (U* - U) */
    double hoop[3][LANES] ALIGNED; /* A (w - d) W' e_x, A x W' e_x, A x W' |e_x| */
    double unused[4][LANES] ALIGNED;
};

/* In the same order; what the kind has not stays zero. */
struct totals_of_row {
    double traction[3], gradient[9], power, weight, drift[3], hoop[3], unused[4];
};
enum { TOTALS = sizeof(struct totals_of_row) / sizeof(double) };

/* The spin that stands STEP doubles apart from S on. */
BOLIDE_INLINE struct vec3 spin_from(int dimension, const double *s, int step)
{
    return dimension == 2 ? vec3_make(0.0, 0.0, s[0]) : vec3_make(s[0], s[step], s[2 * step]);
}

/* One own particle against eight neighbours: where they are, and how much they count. */
BOLIDE_INLINE void find_places(struct pair_kind kind, double smoothing, const double *own,
                               const struct lanes *lanes, struct pairs *pairs)
{
    const int dimension = kind.dimension;
    const int d = record_diameter(dimension), v = record_volume(dimension);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        const struct vec3 x = vec3_sub(vector_from(dimension, &lanes->field[0][k], LANES),
                                       vector_from(dimension, own, 1));
        double r = sqrt(maximum(vec3_dot(x, x), 1e-200));
        double two_h = smoothing * (own[d] + lanes->field[d][k]);
        double inverse = 1.0 / (r * two_h); /* one division serves two */
        const struct vec3 e = vec3_scale(inverse * two_h, x);
        pairs->x[k] = x.x;
        pairs->r[k] = r;
        pairs->e[0][k] = e.x;
        pairs->e[1][k] = e.y;
        pairs->e[2][k] = e.z;
        pairs->weight[k] = lanes->field[v][k] * kernel_slope(r, 2.0 * (inverse * r), dimension);
    }
}

/* The two sides of a pair along e, and the difference between them. What the spins of a pair add at its contact (turn) is
 * taken from the difference, and the part of i given apart. */
struct sides {
    struct pair_side left, right;
    struct pair_difference difference;
    struct vec3 own_turn;
};

BOLIDE_INLINE struct sides sides_of(struct pair_kind kind, const double *own,
                                    const struct lanes *lanes, int k, double r, struct vec3 e)
{
    const int dimension = kind.dimension, u = record_velocity(dimension);
    const bool shear = kind.shear && dimension > 1;
    const int s = record_stress(dimension), z = record_impedance(dimension, shear);
    const int across_z = shear ? z + 1 : z, q = record_bend(dimension, shear);
    struct sides pair = {
        .left = {.impedance = own[z], .shear_impedance = own[across_z]},
        .right = {.impedance = lanes->field[z][k], .shear_impedance = lanes->field[across_z][k]}};
    pair.left.stress = own[s];
    pair.right.stress = lanes->field[s][k];
    if (record_has_bend(kind)) {
        pair.left.density = own[q];
        pair.left.bend = own[q + 1];
        pair.right.density = lanes->field[q][k];
        pair.right.bend = lanes->field[q + 1][k];
    }
    const struct vec3 du = vec3_sub(vector_from(dimension, &lanes->field[u][k], LANES),
                                    vector_from(dimension, own + u, 1));
    pair.difference.velocity = vec3_dot(du, e);
    if (dimension > 1)
        pair.difference.sliding = vec3_sub(du, vec3_scale(pair.difference.velocity, e));
    if (kind.turn) {
        const int d = record_diameter(dimension), spin = record_spin(kind);
        double share = own[d] / (own[d] + lanes->field[d][k]);
        struct vec3 spin_i = spin_from(dimension, own + spin, 1);
        struct vec3 spin_j = spin_from(dimension, &lanes->field[spin][k], LANES);
        pair.own_turn = vec3_scale(share * r, vec3_cross(spin_i, e));
        pair.difference.sliding =
            vec3_sub(pair.difference.sliding,
                     vec3_add(pair.own_turn, vec3_scale((1.0 - share) * r, vec3_cross(spin_j, e))));
    }
    if (shear) {
        const struct vec3 ti = traction_of(dimension, stress_from(dimension, own + s, 1), e);
        const struct vec3 tj =
            traction_of(dimension, stress_from(dimension, &lanes->field[s][k], LANES), e);
        pair.left.stress = vec3_dot(ti, e);
        pair.right.stress = vec3_dot(tj, e);
        pair.left.shear = vec3_sub(ti, vec3_scale(pair.left.stress, e));
        pair.right.shear = vec3_sub(tj, vec3_scale(pair.right.stress, e));
        pair.difference.shear = vec3_sub(pair.right.shear, pair.left.shear);
    }
    return pair;
}

/* Contact problems that are not the usual ones, along the pairs of eight lanes, and how parts across them meet. */
struct contacts {
    double stress[LANES] ALIGNED, jump[LANES] ALIGNED;
    double left[LANES] ALIGNED, right[LANES] ALIGNED;
    double compliance[LANES] ALIGNED, impedance[LANES] ALIGNED;
};

/* STAR is a constant where this is inlined. */
BOLIDE_INLINE void solve_by(enum pair_star star, struct pair_kind kind, const double *own,
                            const struct lanes *lanes, const struct pairs *pairs,
                            struct contacts *c)
{
    const struct pair_law law = {.star = star};
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        const struct vec3 e = vector_from(kind.dimension, &pairs->e[0][k], LANES);
        const struct sides pair = sides_of(kind, own, lanes, k, pairs->r[k], e);
        const struct pair_weights weights = pair_weights_of(&pair.left, &pair.right, star);
        const struct contact contact =
            pair_along(&pair.left, &pair.right, pair.difference.velocity, &law, &weights.along);
        c->left[k] = weights.across.left;
        c->right[k] = weights.across.right;
        c->compliance[k] = weights.across.compliance;
        c->impedance[k] = weights.across.impedance;
        c->stress[k] = contact.stress;
        c->jump[k] = contact.velocity;
    }
}

BOLIDE_INLINE void find_contacts(struct pair_kind kind, const double *own,
                                 const struct lanes *lanes, const struct pairs *pairs,
                                 struct contacts *contacts)
{
    switch (kind.star) {
    case STAR_MEAN:
        solve_by(STAR_MEAN, kind, own, lanes, pairs, contacts);
        break;
    case STAR_DUKOWICZ:
        solve_by(STAR_DUKOWICZ, kind, own, lanes, pairs, contacts);
        break;
    case STAR_EXACT_GAS:
        solve_by(STAR_EXACT_GAS, kind, own, lanes, pairs, contacts);
        break;
    default:
        solve_by(STAR_ACOUSTIC, kind, own, lanes, pairs, contacts);
    }
}

/* Adds up what contacts give: those of CONTACTS, or where that is NULL the usual ones, acoustic and under no law, which are
 * solved on the way. */
BOLIDE_INLINE void add_contacts(struct pair_kind kind, const double *own, const struct lanes *lanes,
                                const struct pairs *pairs, const struct contacts *contacts,
                                struct sums *sums)
{
    const bool usual = contacts == NULL;
    const int dimension = kind.dimension;
    const bool shear = kind.shear && dimension > 1;
    const int depth = record_depth(kind);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        const double r = pairs->r[k], weight = pairs->weight[k];
        const struct vec3 e = vector_from(dimension, &pairs->e[0][k], LANES);
        const struct sides pair = sides_of(kind, own, lanes, k, r, e);
        struct pair_law law = {.star = STAR_ACOUSTIC, .shear = shear, .cuts = !usual};
        struct pair_contact star;
        if (usual) {
            star = contact_pair(&pair.left, &pair.right, &pair.difference, &law);
        } else {
            const struct contact along = {contacts->jump[k], contacts->stress[k]};
            const struct contact_weights across = {contacts->left[k], contacts->right[k],
                                                   contacts->compliance[k], contacts->impedance[k]};
            law.slip = lanes->slip[k];
            law.open = lanes->open[k];
            star = pair_across(&pair.left, &pair.right, &pair.difference, &law, along, &across);
        }
        struct vec3 t = vec3_scale(star.stress, e), w = vec3_scale(star.velocity, e);
        if (shear)
            t = vec3_add(t, star.shear);
        if (dimension > 1)
            w = vec3_add(w, star.sliding);
        if (kind.turn)
            w = vec3_add(w, pair.own_turn);
        double force_weight = weight;
        if (kind.depth) {
            double pair_depth = 0.5 * fabs(own[depth] + lanes->field[depth][k]);
            force_weight = weight * pair_depth;
            sums->hoop[0][k] += weight * (pair_depth - own[depth]) * e.x;
            sums->hoop[1][k] += weight * pairs->x[k] * e.x;
            sums->hoop[2][k] += weight * pairs->x[k] * fabs(e.x);
        }
        double power = force_weight * vec3_dot(t, w);
        t = vec3_scale(force_weight, t);
        w = vec3_scale(weight, w);
        sums->power[k] += power;
        if (!usual) {
            sums->weight[k] += weight;
            sums->drift[0][k] += w.x;
            sums->drift[1][k] += w.y;
            sums->drift[2][k] += w.z;
        }
        sums->traction[0][k] += t.x;
        sums->gradient[0][k] += w.x * e.x;
        if (dimension > 1) {
            sums->traction[1][k] += t.y;
            sums->gradient[1][k] += w.x * e.y;
            sums->gradient[3][k] += w.y * e.x;
            sums->gradient[4][k] += w.y * e.y;
        }
        if (dimension > 2) {
            sums->traction[2][k] += t.z;
            sums->gradient[2][k] += w.x * e.z;
            sums->gradient[5][k] += w.y * e.z;
            sums->gradient[6][k] += w.z * e.x;
            sums->gradient[7][k] += w.z * e.y;
            sums->gradient[8][k] += w.z * e.z;
        }
    }
}

#endif
