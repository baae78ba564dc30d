/* What the pair loops with corrected gradients do with one particle and eight of its neighbours:
 * for the files that are compiled once an instruction set, and for a device. The Riemann problem
 * along a pair is riemann/hllc.h. */
#ifndef BOLIDE_SPH_HLLC_BODY_H
#define BOLIDE_SPH_HLLC_BODY_H

#include "riemann/hllc.h"
#include "sph/hllc/kernel.h"
#include "sph/kernel.h"
#include "sph/record.h"

enum { FIELDS = 24 };

/* A particle against eight neighbours: x_ij, u_j - u_i, the unit vector from i to j, and -V_j W' of
 * each. */
struct pair {
    struct vec3 x, u, e;
    double distance, weight, width; /* width: h */
};

/* Sums over pairs of the first pass, by lane: V x (x) grad W, V u (x) grad W, V f grad W of three
 * scalars f. */
struct gradient_sums {
    double moment[3][LANES] ALIGNED, velocity[4][LANES] ALIGNED, scalar[3][LANES] ALIGNED;
};

/* And of the second: V sigma*.g, V (u* - u_i).sigma*.g, V rho_j (u_j - u_i).g. */
struct force_sums {
    double force[2][LANES] ALIGNED, power[LANES] ALIGNED, mass[LANES] ALIGNED;
};
struct forces {
    double force[2], power, mass;
};

BOLIDE_INLINE struct vec3 velocity_of(int dimension, const double *own,
                                      const double (*field)[LANES], int k)
{
    const int u = dimension + 2;
    return vec3_sub(vector_from(dimension, &field[u][k], LANES),
                    vector_from(dimension, own + u, 1));
}

/* Neighbour K of the lanes FIELD for the particle of record OWN. */
BOLIDE_INLINE struct pair pair_of(int dimension, double smoothing, const double *own,
                                  const double (*field)[LANES], int k)
{
    const int d = dimension, v = dimension + 1;
    struct pair pair;
    pair.x = vec3_sub(vector_from(dimension, &field[0][k], LANES), vector_from(dimension, own, 1));
    pair.u = velocity_of(dimension, own, field, k);
    pair.distance = sqrt(maximum(vec3_dot(pair.x, pair.x), 1e-200));
    pair.e = vec3_scale(1.0 / pair.distance, pair.x);
    pair.width = 0.5 * smoothing * (own[d] + field[d][k]);
    pair.weight = -field[v][k] * kernel_slope(pair.distance, 1.0 / pair.width, dimension);
    return pair;
}

BOLIDE_INLINE void add_gradients(int dimension, double smoothing, const double *own,
                                 const double (*field)[LANES], struct gradient_sums *sums)
{
    const int density = hllc_density(dimension);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        struct pair pair = pair_of(dimension, smoothing, own, field, k);
        struct vec3 e = pair.e, u = vec3_scale(pair.weight, pair.u);
        double length = pair.weight * pair.distance;
        sums->moment[0][k] += length * e.x * e.x;
        sums->velocity[0][k] += u.x * e.x;
        if (dimension == 1) {
            sums->scalar[0][k] += pair.weight * (field[density][k] - own[density]) * e.x;
            sums->scalar[1][k] += pair.weight * (field[density + 1][k] - own[density + 1]) * e.x;
            sums->scalar[2][k] += pair.weight * (field[density + 2][k] - own[density + 2]) * e.x;
        }
        if (dimension > 1) {
            sums->moment[1][k] += length * e.y * e.y;
            sums->moment[2][k] += length * e.x * e.y;
            sums->velocity[1][k] += u.x * e.y;
            sums->velocity[2][k] += u.y * e.x;
            sums->velocity[3][k] += u.y * e.y;
        }
    }
}

/* The inverse of M; one where M is singular: alone, or in line with all neighbours. */
BOLIDE_INLINE struct sym3 inverse_of(int dimension, struct sym3 m)
{
    const double singular = 1e-3; /* determinant, where the mean of the diagonal is one */
    struct sym3 inverse = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
    if (dimension == 1) {
        if (m.xx > 1e-200)
            inverse.xx = 1.0 / m.xx;
        return inverse;
    }
    m.zz = 0.5 * (m.xx + m.yy);
    double a = m.yy * m.zz - square(m.yz), b = m.yz * m.zx - m.xy * m.zz,
           c = m.xy * m.yz - m.yy * m.zx;
    double determinant = m.xx * a + m.xy * b + m.zx * c, mean = sym3_trace(m) / 3.0;
    if (!(determinant > singular * mean * square(mean)) || !(mean > 1e-100))
        return inverse;
    double scale = 1.0 / determinant;
    inverse.xx = scale * a;
    inverse.yy = scale * (m.xx * m.zz - square(m.zx));
    inverse.zz = scale * (m.xx * m.yy - square(m.xy));
    inverse.xy = scale * b;
    inverse.yz = scale * (m.zx * m.xy - m.xx * m.yz);
    inverse.zx = scale * c;
    return inverse;
}

/* Row A of the velocity gradient: (sum V u^a grad W).L. */
BOLIDE_INLINE struct vec3 gradient_row(struct sym3 correction, const struct gradient_sums *sums,
                                       int a)
{
    struct vec3 row = vec3_make(across_lanes(sums->velocity[2 * a]),
                                across_lanes(sums->velocity[2 * a + 1]), 0.0);
    return sym3_dot(correction, row);
}

/* What to add to f_i at the middle of the pair: RISE = f_j - f_i, CHANGE = G_i.x_ij; nothing where
 * they disagree. */
BOLIDE_INLINE double half_of_slope(double rise, double change)
{
    double other = 2.0 * change - rise, product = rise * other;
    return product > 0.0 ? product / (rise + other) : 0.0;
}

/* The record of a particle and those of eight neighbours, in lanes, and how their pairs meet. */
struct eight {
    struct hllc_kind kind;
    struct hllc_selection selection;
    double smoothing;
    const double *own;
    const double (*field)[LANES];
};

/* Reconstructs both sides along pair K inside one material. */
BOLIDE_INLINE void reconstruct(const struct eight *eight, int k, struct pair pair,
                               struct elastic_side *left, struct elastic_side *right)
{
    const struct hllc_kind kind = eight->kind;
    const double *own = eight->own;
    const double(*field)[LANES] = eight->field;
    const int dimension = kind.dimension, material = hllc_material(kind),
              strain = hllc_strain(kind), slopes = hllc_slopes(kind);
    double share = own[material] == field[material][k] ? 1.0 : 0.0;
    struct vec3 e = pair.e;
    double at_i =
        vec3_dot(traction_of(dimension, stress_from(dimension, own + strain, 1), e), pair.x);
    double at_j = vec3_dot(
        traction_of(dimension, stress_from(dimension, &field[strain][k], LANES), e), pair.x);
    double rise = right->velocity - left->velocity;
    left->velocity += share * half_of_slope(rise, at_i);
    right->velocity -= share * half_of_slope(rise, at_j);
    if (dimension > 1)
        return;
    share *= eight->selection.scalars_share;
    double moved[2][3];
    double pressure_i = left->deviator - left->stress, pressure_j = right->deviator - right->stress;
    double rises[3] = {right->density - left->density, pressure_j - pressure_i,
                       right->deviator - left->deviator};
    for (int s = 0; s < 3; s++) {
        moved[0][s] = share * half_of_slope(rises[s], own[slopes + s] * pair.x.x);
        moved[1][s] = share * half_of_slope(rises[s], field[slopes + s][k] * pair.x.x);
    }
    left->density += moved[0][0];
    left->deviator += moved[0][2];
    left->stress += moved[0][2] - moved[0][1];
    right->density -= moved[1][0];
    right->deviator -= moved[1][2];
    right->stress -= moved[1][2] - moved[1][1];
}

/* How the pair's stress and velocity differ from means: sigma* = left sigma_i + right sigma_j +
 * along e (x) e + all I, u* - u_i = (u_j - u_i)/2 + jump e. */
struct star {
    double left, right, along, all, jump;
};

/* The Riemann problem of the components along a pair (20), by elastic waves alone unless
 * WITH_YIELD. */
BOLIDE_INLINE struct elastic_contact contact_of(const struct eight *eight, int k, struct pair pair,
                                                bool with_yield)
{
    const struct hllc_kind kind = eight->kind;
    const double *own = eight->own;
    const double(*field)[LANES] = eight->field;
    const int dimension = kind.dimension, density = hllc_density(dimension),
              s = hllc_stress(dimension), response = hllc_response(dimension);
    struct vec3 e = pair.e;
    double stress_i = vec3_dot(traction_of(dimension, stress_from(dimension, own + s, 1), e), e);
    double stress_j =
        vec3_dot(traction_of(dimension, stress_from(dimension, &field[s][k], LANES), e), e);
    struct elastic_side left = {own[density],      0.0,
                                stress_i,          stress_i + own[response],
                                own[response + 1], own[response + 2],
                                own[response + 3], own[response + 4]};
    struct elastic_side right = {field[density][k],
                                 vec3_dot(pair.u, e),
                                 stress_j,
                                 stress_j + field[response][k],
                                 field[response + 1][k],
                                 field[response + 2][k],
                                 field[response + 3][k],
                                 field[response + 4][k]};
    if (kind.reconstructed)
        reconstruct(eight, k, pair, &left, &right);
    struct elastic_contact contact = {{0.0, 0.0}, 0.0};
    if (with_yield)
        contact.contact = riemann_hllc(left, right);
    else
        contact = riemann_hllc_elastic(left, right);
    return contact;
}

/* Eight Riemann problems: the pairs, and u* - u_i and s* along them. */
struct contacts {
    double e[2][LANES] ALIGNED, weight[LANES] ALIGNED;
    double velocity[LANES] ALIGNED, stress[LANES] ALIGNED;
};

/* Returns the largest doubt of those that approach each other. */
BOLIDE_INLINE double solve_contacts(const struct eight *eight, bool with_yield,
                                    struct contacts *contacts)
{
    double doubt = 0.0;
#pragma omp simd simdlen(8) reduction(max : doubt)
    for (int k = 0; k < LANES; k++) {
        struct pair pair =
            pair_of(eight->kind.dimension, eight->smoothing, eight->own, eight->field, k);
        struct elastic_contact contact = contact_of(eight, k, pair, with_yield);
        contacts->e[0][k] = pair.e.x;
        contacts->e[1][k] = pair.e.y;
        contacts->weight[k] = pair.weight;
        contacts->velocity[k] = contact.contact.velocity;
        contacts->stress[k] = contact.contact.stress;
        doubt = maximum(doubt,
                        vec3_dot(pair.u, pair.e) < eight->selection.parting ? contact.doubt : 0.0);
    }
    return doubt;
}

/* Plastic waves cost as much as all the rest: they are looked for where there may be one. */
BOLIDE_INLINE void find_contacts(const struct eight *eight, struct contacts *contacts)
{
    if (solve_contacts(eight, false, contacts) > 0.0)
        solve_contacts(eight, true, contacts);
}

/* (21), where the pair shrinks. */
BOLIDE_INLINE struct star contact_star(struct hllc_selection selection,
                                       const struct contacts *contacts, int k, double apart,
                                       double mean_stress)
{
    struct star star = {0.5, 0.5,
                        apart < selection.parting ? contacts->stress[k] - mean_stress : 0.0, 0.0,
                        apart < selection.parting ? contacts->velocity[k] - 0.5 * apart : 0.0};
    return star;
}

/* (16), (17), as the sums of the contact form have them. */
BOLIDE_INLINE struct star viscous_star(const struct eight *eight, int k, struct pair pair)
{
    const struct hllc_selection selection = eight->selection;
    const double *own = eight->own;
    const double(*field)[LANES] = eight->field;
    const int density = hllc_density(eight->kind.dimension),
              sound = hllc_response(eight->kind.dimension);
    double rho_i = own[density], rho_j = field[density][k];
    double approach = vec3_dot(pair.u, pair.x);
    double phi = pair.width * approach / (square(pair.distance) + 0.01 * square(pair.width));
    double mean_sound = 0.5 * (own[sound] + field[sound][k]), mean_density = 0.5 * (rho_i + rho_j);
    double viscosity = phi * (selection.beta * phi - selection.alpha * mean_sound) / mean_density;
    double ratio = selection.squares > 0.0 ? rho_j / rho_i : 1.0;
    struct star star = {0.5 * ratio, 0.5 / ratio, 0.0,
                        approach < 0.0 ? -0.5 * rho_i * rho_j * viscosity : 0.0, 0.0};
    return star;
}

BOLIDE_INLINE void add_forces(const struct eight *eight, struct force_sums *sums)
{
    const struct hllc_kind kind = eight->kind;
    const double *own = eight->own;
    const double(*field)[LANES] = eight->field;
    const struct hllc_selection selection = eight->selection;
    const int dimension = kind.dimension;
    const int s = hllc_stress(dimension), l = hllc_correction(dimension);
    struct contacts contacts;
    if (!kind.viscous)
        find_contacts(eight, &contacts);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        struct pair pair;
        if (kind.viscous) {
            pair = pair_of(dimension, eight->smoothing, own, field, k);
        } else {
            pair.u = velocity_of(dimension, own, field, k);
            pair.e = vector_from(dimension, &contacts.e[0][k], LANES);
            pair.weight = contacts.weight[k];
        }
        struct vec3 e = pair.e;
        struct vec3 own_g = traction_of(dimension, stress_from(dimension, own + l, 1), e);
        struct vec3 other_g =
            traction_of(dimension, stress_from(dimension, &field[l][k], LANES), e);
        struct vec3 g =
            vec3_add(own_g, vec3_scale(selection.others_share, vec3_sub(other_g, own_g)));
        struct sym3 sigma_i = stress_from(dimension, own + s, 1);
        struct sym3 sigma_j = stress_from(dimension, &field[s][k], LANES);
        struct vec3 both =
            vec3_add(traction_of(dimension, sigma_i, e), traction_of(dimension, sigma_j, e));
        struct star star = kind.viscous ? viscous_star(eight, k, pair)
                                        : contact_star(selection, &contacts, k, vec3_dot(pair.u, e),
                                                       0.5 * vec3_dot(both, e));
        struct vec3 t = vec3_add(vec3_scale(star.left, traction_of(dimension, sigma_i, g)),
                                 vec3_scale(star.right, traction_of(dimension, sigma_j, g)));
        t = kind.viscous ? vec3_add(t, vec3_scale(star.all, g))
                         : vec3_add(t, vec3_scale(star.along * vec3_dot(e, g), e));
        struct vec3 w = vec3_scale(0.5, pair.u);
        if (!kind.viscous)
            w = vec3_add(w, vec3_scale(star.jump, e));
        t = vec3_scale(pair.weight, t);
        sums->power[k] += vec3_dot(t, w);
        sums->mass[k] += pair.weight * field[hllc_density(dimension)][k] * vec3_dot(pair.u, own_g);
        sums->force[0][k] += t.x;
        if (dimension > 1)
            sums->force[1][k] += t.y;
    }
}

#endif
