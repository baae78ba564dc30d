/* The pair loops with corrected gradients for one instruction set, named by BOLIDE_ISA; see kernel.h. The contact
 * problem along a pair is riemann/hllc.h; how rows become lanes is lanes.h. */
#include "sph/hllc/kernel.h"

#include "base/isa.h"
#include "riemann/hllc.h"
#include "sph/kernel.h"
#include "sph/record.h"

enum { FIELDS = 40 };

/* A particle against eight neighbours: x_ij, u_j - u_i, the unit vector from i to j, and -V_j W' of each. */
struct pair {
    struct vec3 x, u, e;
    double distance, weight, width; /* width: h */
};

/* Sums over pairs of the first pass, by lane: V x (x) grad W, V u (x) grad W, V f grad W of three scalars f. */
struct gradient_sums {
    double moment[6][LANES] ALIGNED, velocity[9][LANES] ALIGNED, scalar[3][LANES] ALIGNED;
};

/* And of the second: V sigma*.g, V (u* - u_i).sigma*.g, V rho_j (u_j - u_i).g, A (w - r_i) g_r. */
struct force_sums {
    double force[3][LANES] ALIGNED, power[LANES] ALIGNED, mass[LANES] ALIGNED, hoop[LANES] ALIGNED;
};
struct forces {
    double force[3], power, mass, hoop;
};

INLINE struct vec3 velocity_of(int dimension, const double *own, const double (*field)[LANES],
                               int k)
{
    const int u = dimension + 2;
    return vec3_sub(vector_from(dimension, &field[u][k], LANES),
                    vector_from(dimension, own + u, 1));
}

/* Neighbour K of the lanes FIELD for the particle of record OWN. */
INLINE struct pair pair_of(int dimension, double smoothing, const double *own,
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

INLINE void add_gradients(int dimension, double smoothing, const double *own,
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
            sums->moment[3][k] += length * e.x * e.y;
            sums->velocity[1][k] += u.x * e.y;
            sums->velocity[3][k] += u.y * e.x;
            sums->velocity[4][k] += u.y * e.y;
        }
        if (dimension > 2) {
            sums->moment[2][k] += length * e.z * e.z;
            sums->moment[4][k] += length * e.y * e.z;
            sums->moment[5][k] += length * e.z * e.x;
            sums->velocity[2][k] += u.x * e.z;
            sums->velocity[5][k] += u.y * e.z;
            sums->velocity[6][k] += u.z * e.x;
            sums->velocity[7][k] += u.z * e.y;
            sums->velocity[8][k] += u.z * e.z;
        }
    }
}

/* The inverse of M; one where M is singular: alone, or in line with all neighbours. */
INLINE struct sym3 inverse_of(int dimension, struct sym3 m)
{
    const double singular = 1e-3; /* determinant, where the mean of the diagonal is one */
    struct sym3 inverse = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
    if (dimension == 1) {
        if (m.xx > 1e-200)
            inverse.xx = 1.0 / m.xx;
        return inverse;
    }
    if (dimension == 2)
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
INLINE struct vec3 gradient_row(struct sym3 correction, const struct gradient_sums *sums, int a)
{
    struct vec3 row =
        vec3_make(across_lanes(sums->velocity[3 * a]), across_lanes(sums->velocity[3 * a + 1]),
                  across_lanes(sums->velocity[3 * a + 2]));
    return sym3_dot(correction, row);
}

INLINE void row_gradients(const struct hllc_loop *loop, int dimension, int32_t i)
{
    const struct lane_records records = {.record = loop->record,
                                         .stride = HLLC_GRADIENT_STRIDE,
                                         .dimension = dimension,
                                         .empty = loop->empty,
                                         .smoothing = loop->smoothing,
                                         NULL};
    const double *own = loop->record + (size_t)i * HLLC_GRADIENT_STRIDE;
    const struct hllc_rates *rates = &loop->rates;
    double field[HLLC_GRADIENT_STRIDE][LANES] ALIGNED;
    struct gradient_sums sums = {0};
    struct lane_walk walk;
    walk.looked_at = walk.ready = walk.waiting = 0;
    while (lanes_walk(&walk, records, own, neighbours_row(loop->neighbours, i),
                      (int)loop->neighbours->row[i].count))
        for (int k = 0; k < walk.ready; k += LANES) {
            lanes_stage(records, walk.list + k, field);
            add_gradients(dimension, loop->smoothing, own, (const double(*)[LANES])field, &sums);
        }
    struct sym3 moment = {across_lanes(sums.moment[0]), across_lanes(sums.moment[1]),
                          across_lanes(sums.moment[2]), across_lanes(sums.moment[3]),
                          across_lanes(sums.moment[4]), across_lanes(sums.moment[5])};
    struct sym3 l = inverse_of(dimension, moment);
    memcpy(rates->correction[i], &l, sizeof l);
    struct vec3 x = gradient_row(l, &sums, 0), y = gradient_row(l, &sums, 1),
                z = gradient_row(l, &sums, 2);
    struct sym3 strain = {x.x, y.y, z.z, 0.5 * (x.y + y.x), 0.5 * (y.z + z.y), 0.5 * (z.x + x.z)};
    struct vec3 spin = {0.5 * (z.y - y.z), 0.5 * (x.z - z.x), 0.5 * (y.x - x.y)};
    memcpy(rates->strain_rate[i], &strain, sizeof strain);
    memcpy(rates->spin[i], &spin, sizeof spin);
    for (int s = 0; rates->slopes && s < 3; s++)
        rates->slopes[i][s] = l.xx * across_lanes(sums.scalar[s]);
}

/* What to add to f_i at the middle of the pair: RISE = f_j - f_i, CHANGE = G_i.x_ij; nothing where they disagree. */
INLINE double half_of_slope(double rise, double change)
{
    double other = 2.0 * change - rise, product = rise * other;
    return product > 0.0 ? product / (rise + other) : 0.0;
}

/* Reconstructs both sides along the pair inside one material. */
INLINE void reconstruct(struct hllc_kind kind, double scalars_share, const double *own,
                        const double (*field)[LANES], int k, struct pair pair,
                        struct elastic_side *left, struct elastic_side *right)
{
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
    share *= scalars_share;
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

/* How the pair's stress and velocity differ from means: sigma* = left sigma_i + right sigma_j + along e (x) e + all I,
 * u* - u_i = (u_j - u_i)/2 + jump e. */
struct star {
    double left, right, along, all, jump;
};

/* The contact problem of the components along a pair (20), by elastic waves alone unless WITH_YIELD. */
INLINE struct elastic_contact contact_of(struct hllc_kind kind, struct hllc_selection selection,
                                         const double *own, const double (*field)[LANES], int k,
                                         struct pair pair, bool with_yield)
{
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
        reconstruct(kind, selection.scalars_share, own, field, k, pair, &left, &right);
    struct elastic_contact contact = {{0.0, 0.0}, 0.0};
    if (with_yield)
        contact.contact = riemann_hllc(left, right);
    else
        contact = riemann_hllc_elastic(left, right);
    return contact;
}

/* Eight contact problems: the pairs, and u* - u_i and s* along them. */
struct contacts {
    double e[3][LANES] ALIGNED, weight[LANES] ALIGNED;
    double velocity[LANES] ALIGNED, stress[LANES] ALIGNED;
};

/* Returns the largest doubt of those that approach each other. */
INLINE double solve_contacts(struct hllc_kind kind, struct hllc_selection selection,
                             double smoothing, const double *own, const double (*field)[LANES],
                             bool with_yield, struct contacts *contacts)
{
    double doubt = 0.0;
#pragma omp simd simdlen(8) reduction(max : doubt)
    for (int k = 0; k < LANES; k++) {
        struct pair pair = pair_of(kind.dimension, smoothing, own, field, k);
        struct elastic_contact contact =
            contact_of(kind, selection, own, field, k, pair, with_yield);
        contacts->e[0][k] = pair.e.x;
        contacts->e[1][k] = pair.e.y;
        contacts->e[2][k] = pair.e.z;
        contacts->weight[k] = pair.weight;
        contacts->velocity[k] = contact.contact.velocity;
        contacts->stress[k] = contact.contact.stress;
        doubt = maximum(doubt, vec3_dot(pair.u, pair.e) < selection.parting ? contact.doubt : 0.0);
    }
    return doubt;
}

/* Plastic waves cost as much as all the rest: they are looked for where there may be one. */
INLINE void find_contacts(struct hllc_kind kind, struct hllc_selection selection, double smoothing,
                          const double *own, const double (*field)[LANES],
                          struct contacts *contacts)
{
    if (solve_contacts(kind, selection, smoothing, own, field, false, contacts) > 0.0)
        solve_contacts(kind, selection, smoothing, own, field, true, contacts);
}

/* (21), where the pair shrinks. */
INLINE struct star contact_star(struct hllc_selection selection, const struct contacts *contacts,
                                int k, double apart, double mean_stress)
{
    struct star star = {0.5, 0.5,
                        apart < selection.parting ? contacts->stress[k] - mean_stress : 0.0, 0.0,
                        apart < selection.parting ? contacts->velocity[k] - 0.5 * apart : 0.0};
    return star;
}

/* (16), (17), as the sums of the contact form have them. */
INLINE struct star viscous_star(struct hllc_kind kind, struct hllc_selection selection,
                                const double *own, const double (*field)[LANES], int k,
                                struct pair pair)
{
    const int density = hllc_density(kind.dimension), sound = hllc_response(kind.dimension);
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

INLINE void add_forces(struct hllc_kind kind, struct hllc_selection selection, double smoothing,
                       const double *own, const double (*field)[LANES], struct force_sums *sums)
{
    const int dimension = kind.dimension;
    const int s = hllc_stress(dimension), l = hllc_correction(dimension), depth = hllc_depth(kind);
    struct contacts contacts;
    if (!kind.viscous)
        find_contacts(kind, selection, smoothing, own, field, &contacts);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        struct pair pair;
        if (kind.viscous) {
            pair = pair_of(dimension, smoothing, own, field, k);
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
        struct star star = kind.viscous ? viscous_star(kind, selection, own, field, k, pair)
                                        : contact_star(selection, &contacts, k, vec3_dot(pair.u, e),
                                                       0.5 * vec3_dot(both, e));
        struct vec3 t = vec3_add(vec3_scale(star.left, traction_of(dimension, sigma_i, g)),
                                 vec3_scale(star.right, traction_of(dimension, sigma_j, g)));
        t = kind.viscous ? vec3_add(t, vec3_scale(star.all, g))
                         : vec3_add(t, vec3_scale(star.along * vec3_dot(e, g), e));
        struct vec3 w = vec3_scale(0.5, pair.u);
        if (!kind.viscous)
            w = vec3_add(w, vec3_scale(star.jump, e));
        double force_weight = pair.weight;
        if (kind.depth) {
            double pair_depth = 0.5 * fabs(own[depth] + field[depth][k]);
            force_weight = pair.weight * pair_depth;
            sums->hoop[k] += pair.weight * (pair_depth - fabs(own[depth])) * g.x;
        }
        t = vec3_scale(force_weight, t);
        sums->power[k] += vec3_dot(t, w);
        sums->mass[k] += pair.weight * field[hllc_density(dimension)][k] * vec3_dot(pair.u, own_g);
        sums->force[0][k] += t.x;
        if (dimension > 1)
            sums->force[1][k] += t.y;
        if (dimension > 2)
            sums->force[2][k] += t.z;
    }
}

/* Adds the entries of one part of a row. */
INLINE struct forces part_forces(const struct hllc_loop *loop, struct hllc_kind kind, int32_t i,
                                 const uint32_t *entry, int count)
{
    const struct lane_records records = {.record = loop->record,
                                         .stride = hllc_stride(kind),
                                         .dimension = kind.dimension,
                                         .empty = loop->empty,
                                         .smoothing = loop->smoothing,
                                         NULL};
    const double *own = loop->record + (size_t)i * (size_t)records.stride;
    double field[FIELDS][LANES] ALIGNED;
    struct force_sums sums = {0};
    struct lane_walk walk;
    walk.looked_at = walk.ready = walk.waiting = 0;
    while (lanes_walk(&walk, records, own, entry, count))
        for (int k = 0; k < walk.ready; k += LANES) {
            lanes_stage(records, walk.list + k, field);
            add_forces(kind, loop->selection, loop->smoothing, own, (const double(*)[LANES])field,
                       &sums);
        }
    struct forces forces;
    for (int a = 0; a < 3; a++)
        forces.force[a] = across_lanes(sums.force[a]);
    forces.power = across_lanes(sums.power);
    forces.mass = across_lanes(sums.mass);
    forces.hoop = across_lanes(sums.hoop);
    return forces;
}

INLINE void row_forces(const struct hllc_loop *loop, struct hllc_kind kind, int32_t i)
{
    const double *own = loop->record + (size_t)i * (size_t)hllc_stride(kind);
    const struct hllc_rates *rates = &loop->rates;
    const uint32_t *entry = neighbours_row(loop->neighbours, i);
    int count = (int)loop->neighbours->row[i].count, matter = count;
    while (matter > 0 && entry[matter - 1] >> ENTRY_PART_SHIFT == PART_IMAGE)
        matter--;
    struct forces part[2] = {{{0.0, 0.0, 0.0}, 0.0, 0.0, 0.0}};
    for (int k = 0, begin = 0; k < 2 && begin < count; k++) {
        const int end = k ? count : matter;
        part[k] = part_forces(loop, kind, i, entry + begin, end - begin);
        begin = end;
    }
    const struct forces all = part[0], images = part[1];
    double density = own[hllc_density(kind.dimension)];
    double factor = 2.0 / (kind.depth ? density * fabs(own[hllc_depth(kind)]) : density);
    for (int a = 0; a < 3; a++) {
        rates->acceleration[i][a] = factor * (all.force[a] + images.force[a]);
        if (rates->wall)
            rates->wall[i][a] = factor * images.force[a];
    }
    rates->power[i] = factor * (all.power + images.power);
    const double *strain = rates->strain_rate[i];
    rates->density_rate[i] =
        loop->by_mass ? -(all.mass + images.mass) : -density * (strain[0] + strain[1] + strain[2]);
    if (kind.depth)
        rates->hoop_pull[i] = copysign(2.0, own[hllc_depth(kind)]) * (all.hoop + images.hoop);
}

/* Each body of the rows' loop is an instance; its name says of which kind. */
#define GRADIENTS(medium, dimension)                                                         \
    static void medium##_gradients(const struct hllc_loop *loop, int32_t begin, int32_t end) \
    {                                                                                        \
        for (int32_t i = begin; i < end; i++)                                                \
            row_gradients(loop, dimension, i);                                               \
    }
#define FORCES(name, ...)                                                      \
    static void name(const struct hllc_loop *loop, int32_t begin, int32_t end) \
    {                                                                          \
        const struct hllc_kind kind = {__VA_ARGS__};                           \
        for (int32_t i = begin; i < end; i++)                                  \
            row_forces(loop, kind, i);                                         \
    }
#define INSTANCES(medium, dimension, depth)                  \
    FORCES(medium##_viscous, dimension, depth, true, false)  \
    FORCES(medium##_contact, dimension, depth, false, false) \
    FORCES(medium##_reconstructed, dimension, depth, false, true)

GRADIENTS(line, 1)
GRADIENTS(plane, 2)
GRADIENTS(space, 3)
INSTANCES(line, 1, false)
INSTANCES(plane, 2, false)
INSTANCES(space, 3, false)
INSTANCES(ring, 2, true)

ISA_KERNEL(void, hllc_find_gradients, const struct hllc_loop *loop, int32_t begin, int32_t end)
{
    typedef void instance(const struct hllc_loop *, int32_t, int32_t);
    static instance *const table[3] = {line_gradients, plane_gradients, space_gradients};
    table[loop->kind.dimension - 1](loop, begin, end);
}

ISA_KERNEL(void, hllc_find_forces, const struct hllc_loop *loop, int32_t begin, int32_t end)
{
    typedef void instance(const struct hllc_loop *, int32_t, int32_t);
    enum { RING = 3 }; /* behind the dimensions */
    static instance *const table[4][3] = {{line_viscous, line_contact, line_reconstructed},
                                          {plane_viscous, plane_contact, plane_reconstructed},
                                          {space_viscous, space_contact, space_reconstructed},
                                          {ring_viscous, ring_contact, ring_reconstructed}};
    const struct hllc_kind kind = loop->kind;
    const int pairs = kind.viscous ? 0 : 1 + kind.reconstructed;
    table[kind.depth ? RING : kind.dimension - 1][pairs](loop, begin, end);
}
