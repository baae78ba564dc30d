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

BOLIDE_INLINE struct vec3 velocity_between(int dimension, const double *own,
                                           const struct lanes *lanes, int k)
{
    const int u = record_velocity(dimension);
    return vec3_sub(vector_from(dimension, &lanes->field[u][k], LANES),
                    vector_from(dimension, own + u, 1));
}

/* Sets what KIND needs of the side of a pair along E whose RECORD has its numbers STEP doubles apart. */
BOLIDE_INLINE void set_side(struct pair_kind kind, const double *record, int step, struct vec3 e,
                            struct pair_side *side)
{
    const int dimension = kind.dimension, s = record_stress(dimension);
    const bool shear = kind.shear && dimension > 1;
    const int z = record_impedance(dimension, shear), q = record_bend(dimension, shear);
    side->impedance = record[z * step];
    side->shear_impedance = record[(shear ? z + 1 : z) * step];
    side->stress = record[s * step];
    if (record_has_bend(kind)) {
        side->density = record[q * step];
        side->bend = record[(q + 1) * step];
    }
    if (shear) {
        const struct vec3 t =
            traction_of(dimension, stress_from(dimension, record + s * step, step), e);
        side->stress = vec3_dot(t, e);
        side->shear = vec3_sub(t, vec3_scale(side->stress, e));
    }
}

/* What the spins of a pair R apart add to the velocities at its contact: that of i, and what they take from the difference. */
struct turns {
    struct vec3 own, both;
};

BOLIDE_INLINE struct turns turns_of(struct pair_kind kind, const double *own,
                                    const struct lanes *lanes, int k, double r, struct vec3 e)
{
    const int d = record_diameter(kind.dimension), spin = record_spin(kind);
    double share = own[d] / (own[d] + lanes->field[d][k]);
    struct vec3 spin_i = spin_from(kind.dimension, own + spin, 1);
    struct vec3 spin_j = spin_from(kind.dimension, &lanes->field[spin][k], LANES);
    struct turns turns;
    turns.own = vec3_scale(share * r, vec3_cross(spin_i, e));
    turns.both = vec3_add(turns.own, vec3_scale((1.0 - share) * r, vec3_cross(spin_j, e)));
    return turns;
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
        struct pair_side left, right;
        set_side(kind, own, 1, e, &left);
        set_side(kind, &lanes->field[0][k], LANES, e, &right);
        const struct vec3 du = velocity_between(kind.dimension, own, lanes, k);
        const struct pair_weights weights = pair_weights_of(&left, &right, star);
        const struct contact contact =
            pair_along(&left, &right, vec3_dot(du, e), 1.0, law, &weights.along);
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
    const struct pair_law law = {STAR_ACOUSTIC, shear, false, !usual};
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        const double r = pairs->r[k], weight = pairs->weight[k];
        const struct vec3 e = vector_from(dimension, &pairs->e[0][k], LANES);
        struct pair_side left, right;
        set_side(kind, own, 1, e, &left);
        set_side(kind, &lanes->field[0][k], LANES, e, &right);
        const struct vec3 du = velocity_between(dimension, own, lanes, k);
        struct pair_difference difference = {.velocity = vec3_dot(du, e)};
        struct turns turns = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
        if (dimension > 1)
            difference.sliding = vec3_sub(du, vec3_scale(difference.velocity, e));
        if (kind.turn) {
            turns = turns_of(kind, own, lanes, k, r, e);
            difference.sliding = vec3_sub(difference.sliding, turns.both);
        }
        if (shear)
            difference.shear = vec3_sub(right.shear, left.shear);
        struct pair_contact star;
        if (usual) {
            const struct pair_limits none = {0.0, 0.0, 1.0};
            star = contact_pair(&left, &right, &difference, none, law);
        } else {
            const struct pair_limits limits = {lanes->slip[k], lanes->open[k], 1.0};
            const struct pair_solved solved = {{contacts->jump[k], contacts->stress[k]},
                                               {contacts->left[k], contacts->right[k],
                                                contacts->compliance[k], contacts->impedance[k]}};
            star = pair_across(&left, &right, &difference, limits, law, &solved);
        }
        struct vec3 t = vec3_scale(star.stress, e), w = vec3_scale(star.velocity, e);
        if (shear)
            t = vec3_add(t, star.shear);
        if (dimension > 1)
            w = vec3_add(w, star.sliding);
        if (kind.turn)
            w = vec3_add(w, turns.own);
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
