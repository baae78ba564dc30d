/* What the pair loop of the contact schemes does with one particle and eight of its neighbours: for
 * the files that are compiled once an instruction set, and for a device. Contact terms are
 * (1.20)-(1.37) of Parshikov (2013), with velocity and traction split into the part along the pair
 * and the part across it; how lists become lanes is lanes.h. */
#ifndef BOLIDE_SPH_CONTACT_BODY_H
#define BOLIDE_SPH_CONTACT_BODY_H

#include "riemann/contact_pair.h"
#include "sph/contact/kernel.h"
#include "sph/kernel.h"
#include "sph/record.h"

enum {
    FIELDS = 24,
    GROUPS = 4 /* of eight neighbours: most lists in 3-D fit */
};

/* Eight neighbours, field by field, and for each whether a contact law cuts shear or tension. */
struct lanes {
    double field[FIELDS][LANES] ALIGNED;
    double slip[LANES] ALIGNED, open[LANES] ALIGNED;
};

/* Eight pairs between the two parts of the kernel. Each part runs over all groups before the next
 * begins: what one group waits for, another fills. */
struct pairs {
    double x[LANES] ALIGNED, r[LANES] ALIGNED, e[3][LANES] ALIGNED;
    double weight[LANES] ALIGNED; /* V W' */
};

/* Sums of V W' t*, V W' (U* - U)^a e^b and V W' t*.(U* - U), by lane. */
struct sums {
    double traction[3][LANES] ALIGNED, gradient[9][LANES] ALIGNED, power[LANES] ALIGNED;
    double weight[LANES] ALIGNED, drift[3][LANES] ALIGNED; /* V W', V W' (U* - U) */
    double hoop[3][LANES] ALIGNED; /* A (w - d) W' e_x, A x W' e_x, A x W' |e_x| */
    double broken[LANES] ALIGNED;  /* V W' of broken contacts */
    double unused[3][LANES] ALIGNED;
};

/* In the same order; what the kind has not stays zero. */
struct totals_of_row {
    double traction[3], gradient[9], power, weight, drift[3], hoop[3], broken, unused[3];
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

/* What lies between the two of a pair: velocity and tractions, and their parts along it. */
struct between {
    struct vec3 du, ti, tj;
    double u, i, j;
};

BOLIDE_INLINE struct between between_of(struct pair_kind kind, const double *own,
                                        const struct lanes *lanes, int k, struct vec3 e)
{
    const int dimension = kind.dimension;
    const int u = record_velocity(dimension), s = record_stress(dimension);
    struct between b = {.i = own[s], .j = lanes->field[s][k]};
    b.du = vec3_sub(vector_from(dimension, &lanes->field[u][k], LANES),
                    vector_from(dimension, own + u, 1));
    b.u = vec3_dot(b.du, e);
    if (kind.shear && dimension > 1) {
        b.ti = traction_of(dimension, stress_from(dimension, own + s, 1), e);
        b.tj = traction_of(dimension, stress_from(dimension, &lanes->field[s][k], LANES), e);
        b.i = vec3_dot(b.ti, e);
        b.j = vec3_dot(b.tj, e);
    }
    return b;
}

/* Riemann problems that are not the usual ones, along the pairs of eight lanes, and how parts
 * across them meet. */
struct contacts {
    double u[LANES] ALIGNED, i[LANES] ALIGNED, j[LANES] ALIGNED;
    double stress[LANES] ALIGNED, jump[LANES] ALIGNED;
    double left[LANES] ALIGNED, right[LANES] ALIGNED;
    double compliance[LANES] ALIGNED, impedance[LANES] ALIGNED;
};

/* Impedances stand at Z and, across, at ACROSS_Z, density and shock_slope from Q on. STAR is a
 * constant where this is inlined. */
BOLIDE_INLINE void solve_by(enum pair_star star, const double *own, const struct lanes *lanes,
                            int z, int across_z, int q, struct contacts *c)
{
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        const struct two_inverses inverse =
            inverses_of_sums(own[z], lanes->field[z][k], own[across_z], lanes->field[across_z][k]);
        struct contact_weights along = riemann_mean_weights(), across = along;
        if (star != STAR_MEAN) {
            along = contact_weights_of(own[z], lanes->field[z][k], inverse.first);
            across = contact_weights_of(own[across_z], lanes->field[across_z][k], inverse.second);
        }
        c->left[k] = across.left;
        c->right[k] = across.right;
        c->compliance[k] = across.compliance;
        c->impedance[k] = across.impedance;
        if (star == STAR_DUKOWICZ || star == STAR_EXACT_GAS) {
            struct side left = {own[z], 0.0, c->i[k], own[q], own[q + 1]};
            struct side right = {lanes->field[z][k], c->u[k], c->j[k], lanes->field[q][k],
                                 lanes->field[q + 1][k]};
            struct contact contact = star == STAR_DUKOWICZ ? riemann_dukowicz(left, right)
                                                           : riemann_exact_gas(left, right);
            c->stress[k] = contact.stress;
            c->jump[k] = contact.velocity;
        } else {
            c->stress[k] = contact_stress(along, c->i[k], c->j[k], c->u[k]);
            c->jump[k] = contact_velocity_jump(along, c->u[k], c->j[k] - c->i[k]);
        }
    }
}

/* One for all kinds. */
APART void solve_contacts(struct pair_kind kind, const double *own, const struct lanes *lanes,
                          struct contacts *contacts)
{
    const bool shear = kind.shear && kind.dimension > 1;
    const int z = record_impedance(kind.dimension, shear), across_z = shear ? z + 1 : z;
    const int q = record_shock_slope(kind.dimension, shear);
    switch (kind.star) {
    case STAR_ACOUSTIC:
        solve_by(STAR_ACOUSTIC, own, lanes, z, across_z, q, contacts);
        break;
    case STAR_MEAN:
        solve_by(STAR_MEAN, own, lanes, z, across_z, q, contacts);
        break;
    case STAR_DUKOWICZ:
        solve_by(STAR_DUKOWICZ, own, lanes, z, across_z, q, contacts);
        break;
    case STAR_EXACT_GAS:
        solve_by(STAR_EXACT_GAS, own, lanes, z, across_z, q, contacts);
        break;
    default: /* of second order alone */
        break;
    }
}

BOLIDE_INLINE void find_contacts(struct pair_kind kind, const double *own,
                                 const struct lanes *lanes, const struct pairs *pairs,
                                 struct contacts *contacts)
{
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        const struct vec3 e = vector_from(kind.dimension, &pairs->e[0][k], LANES);
        const struct between b = between_of(kind, own, lanes, k, e);
        contacts->u[k] = b.u;
        contacts->i[k] = b.i;
        contacts->j[k] = b.j;
    }
    solve_contacts(kind, own, lanes, contacts);
}

/* The contact of a pair: stress and velocity along e, traction and velocity across it, and how
 * particle i turns there. */
struct solved {
    double stress, jump;
    struct vec3 across_u, turn, shear, sliding, own_shear;
};

/* The solution along e of lane K, and the weights of that across; CONTACTS as in add_contact. */
BOLIDE_INLINE struct contact_weights solve_along(int z, int across_z, const double *own,
                                                 const struct lanes *lanes,
                                                 const struct contacts *contacts,
                                                 const struct between *b, struct solved *met, int k)
{
    if (contacts) {
        met->stress = contacts->stress[k];
        met->jump = contacts->jump[k];
        return (struct contact_weights){contacts->left[k], contacts->right[k],
                                        contacts->compliance[k], contacts->impedance[k]};
    }
    const struct two_inverses inverse =
        inverses_of_sums(own[z], lanes->field[z][k], own[across_z], lanes->field[across_z][k]);
    const struct contact_weights along =
        contact_weights_of(own[z], lanes->field[z][k], inverse.first);
    met->stress = contact_stress(along, b->i, b->j, b->u);
    met->jump = contact_velocity_jump(along, b->u, b->j - b->i);
    return contact_weights_of(own[across_z], lanes->field[across_z][k], inverse.second);
}

/* The same across e. */
BOLIDE_INLINE void solve_across(struct pair_kind kind, const double *own, const struct lanes *lanes,
                                const struct pairs *pairs, const struct between *b,
                                struct contact_weights across, struct solved *met, int k)
{
    const int dimension = kind.dimension, d = record_diameter(dimension), spin = record_spin(kind);
    const struct vec3 e = vector_from(dimension, &pairs->e[0][k], LANES);
    const double r = pairs->r[k];
    met->across_u = vec3_sub(b->du, vec3_scale(b->u, e));
    if (kind.turn) {
        double share = own[d] / (own[d] + lanes->field[d][k]);
        struct vec3 spin_i = spin_from(dimension, own + spin, 1);
        struct vec3 spin_j = spin_from(dimension, &lanes->field[spin][k], LANES);
        met->turn = vec3_scale(share * r, vec3_cross(spin_i, e));
        met->across_u =
            vec3_sub(met->across_u,
                     vec3_add(met->turn, vec3_scale((1.0 - share) * r, vec3_cross(spin_j, e))));
    }
    if (kind.shear) {
        met->own_shear = vec3_sub(b->ti, vec3_scale(b->i, e));
        struct vec3 aj = vec3_sub(b->tj, vec3_scale(b->j, e));
        met->shear = pair_shear(across, met->own_shear, aj, met->across_u);
        met->sliding = pair_sliding(across, met->across_u, vec3_sub(aj, met->own_shear));
    }
}

/* What a contact law and breaking leave of the contact of lane K. */
BOLIDE_INLINE void limit_contact(struct pair_kind kind, const double *own,
                                 const struct lanes *lanes, const struct pairs *pairs,
                                 const struct between *b, struct solved *met, struct sums *sums,
                                 int k)
{
    const bool shear = kind.shear && kind.dimension > 1;
    const int z = record_impedance(kind.dimension, shear);
    const int breaking = kind.breaks ? record_breaking(kind) : 0;
    double opened = met->stress > 0.0 ? lanes->open[k] : 0.0, slips = lanes->slip[k];
    if (kind.breaks) {
        const double tension = minimum(own[breaking], lanes->field[breaking][k]);
        double torn = met->stress > tension ? 1.0 : 0.0, broken = torn;
        if (shear) {
            const double most = minimum(own[breaking + 1], lanes->field[breaking + 1][k]);
            const double sheared = vec3_dot(met->shear, met->shear) > most * most ? 1.0 : 0.0;
            torn = maximum(torn, met->stress > 0.0 ? sheared : 0.0);
            broken = maximum(torn, sheared);
            slips = maximum(slips, sheared);
        }
        sums->broken[k] += pairs->weight[k] * broken;
        opened = maximum(opened, torn);
    }
    met->jump = pair_free_velocity(opened > 0.0, own[z], b->i, met->jump);
    met->stress = opened > 0.0 ? 0.0 : met->stress;
    if (shear) {
        bool free = opened > 0.0 || slips > 0.0;
        met->shear = vec3_scale(free ? 0.0 : 1.0, met->shear);
        met->sliding = pair_free_sliding(free, own[z + 1], met->own_shear, met->sliding);
    }
}

/* Adds traction T and velocity W, each times its weight, of a pair along E. */
BOLIDE_INLINE void add_tensors(int dimension, struct vec3 t, struct vec3 w, struct vec3 e,
                               struct sums *sums, int k)
{
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

/* Adds the contact of lane K: that of CONTACTS, or where that is NULL the usual one, acoustic and
 * under no law, which is solved on the way. */
BOLIDE_INLINE void add_contact(struct pair_kind kind, const double *own, const struct lanes *lanes,
                               const struct pairs *pairs, const struct contacts *contacts,
                               struct sums *sums, int k)
{
    const int dimension = kind.dimension;
    const bool shear = kind.shear && dimension > 1;
    const int z = record_impedance(dimension, shear), depth = record_depth(kind);
    const double weight = pairs->weight[k];
    const struct vec3 e = vector_from(dimension, &pairs->e[0][k], LANES);
    const struct between b = between_of(kind, own, lanes, k, e);
    struct solved met = {.stress = 0.0};
    const struct contact_weights across =
        solve_along(z, shear ? z + 1 : z, own, lanes, contacts, &b, &met, k);
    if (dimension > 1)
        solve_across(kind, own, lanes, pairs, &b, across, &met, k);
    if (contacts)
        limit_contact(kind, own, lanes, pairs, &b, &met, sums, k);
    struct vec3 t = vec3_scale(met.stress, e), w = vec3_scale(met.jump, e);
    if (dimension > 1) {
        if (shear) {
            t = vec3_add(t, met.shear);
            w = vec3_add(w, met.sliding);
            if (kind.turn)
                w = vec3_add(w, met.turn);
        } else {
            w = vec3_add(w, vec3_scale(0.5, met.across_u));
        }
    }
    double force_weight = weight;
    if (kind.depth) {
        double pair_depth = 0.5 * fabs(own[depth] + lanes->field[depth][k]);
        force_weight = weight * pair_depth;
        sums->hoop[0][k] += weight * (pair_depth - own[depth]) * e.x;
        sums->hoop[1][k] += weight * pairs->x[k] * e.x;
        sums->hoop[2][k] += weight * pairs->x[k] * fabs(e.x);
    }
    sums->power[k] += force_weight * vec3_dot(t, w);
    w = vec3_scale(weight, w);
    if (contacts) {
        sums->weight[k] += weight;
        sums->drift[0][k] += w.x;
        sums->drift[1][k] += w.y;
        sums->drift[2][k] += w.z;
    }
    add_tensors(dimension, vec3_scale(force_weight, t), w, e, sums, k);
}

/* The same of all lanes. contact_pair has the same parts, but gcc makes no vectors of it here: its
 * structs go through memory, at half the speed. */
BOLIDE_INLINE void add_contacts(struct pair_kind kind, const double *own, const struct lanes *lanes,
                                const struct pairs *pairs, const struct contacts *contacts,
                                struct sums *sums)
{
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++)
        add_contact(kind, own, lanes, pairs, contacts, sums, k);
}

#endif
