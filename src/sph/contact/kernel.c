/* The pair loop for one instruction set, named by BOLIDE_ISA; see kernel.h.
 *
 * Contact terms are (1.20)-(1.37) of Parshikov (2013), with velocity and traction split into the part along the
 * pair and the part across it; how rows become lanes is lanes.h. */
#include "sph/contact/kernel.h"

#include "base/isa.h"
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
INLINE struct vec3 spin_from(int dimension, const double *s, int step)
{
    return dimension == 2 ? vec3_make(0.0, 0.0, s[0]) : vec3_make(s[0], s[step], s[2 * step]);
}

/* One own particle against eight neighbours: where they are, and how much they count. */
INLINE void find_places(struct pair_kind kind, double smoothing, const double *own,
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

INLINE struct sides sides_of(struct pair_kind kind, const double *own, const struct lanes *lanes,
                             int k, double r, struct vec3 e)
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
INLINE void solve_by(enum pair_star star, struct pair_kind kind, const double *own,
                     const struct lanes *lanes, const struct pairs *pairs, struct contacts *c)
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

INLINE void find_contacts(struct pair_kind kind, const double *own, const struct lanes *lanes,
                          const struct pairs *pairs, struct contacts *contacts)
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

/* Adds up what contacts give. The USUAL ones, acoustic and under no law, are solved on the way; others stand in CONTACTS. */
INLINE void add_contacts(struct pair_kind kind, bool usual, const double *own,
                         const struct lanes *lanes, const struct pairs *pairs,
                         const struct contacts *contacts, struct sums *sums)
{
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

INLINE struct totals_of_row totals_of_sums(struct pair_kind kind, bool drift,
                                           const struct sums *sums)
{
    double lane[TOTALS][LANES] ALIGNED, total[TOTALS];
    struct totals_of_row totals = {0};
    if (kind.dimension == 1) { /* few */
        totals.traction[0] = across_lanes(sums->traction[0]);
        totals.gradient[0] = across_lanes(sums->gradient[0]);
        totals.power = across_lanes(sums->power);
        totals.weight = drift ? across_lanes(sums->weight) : 0.0;
        totals.drift[0] = drift ? across_lanes(sums->drift[0]) : 0.0;
        return totals;
    }
    memcpy(lane, sums, sizeof lane);
    lanes_totals(lane, TOTALS, total);
    memcpy(&totals, total, sizeof totals);
    return totals;
}

/* Adds the entries of one part of a row. */
INLINE void add_part(const struct pair_loop *loop, struct pair_kind kind, bool usual, bool with_law,
                     int32_t i, const uint32_t *entry, int count, struct sums *sums)
{
    const struct lane_records records = {loop->record, record_stride(kind), kind.dimension,
                                         loop->empty,  loop->smoothing,     NULL};
    const double *own = loop->record + (size_t)i * (size_t)records.stride;
    struct lane_walk walk;
    struct lanes lanes[GROUPS];
    struct pairs pairs[GROUPS];
    struct contacts contacts;
    walk.looked_at = walk.ready = walk.waiting = 0;
    while (lanes_walk(&walk, records, own, entry, count))
        for (int first = 0; first < walk.ready; first += GROUPS * LANES) {
            int left = (walk.ready - first) / LANES, groups = left < GROUPS ? left : GROUPS;
            for (int m = 0; m < groups; m++) {
                const uint32_t *list = walk.list + first + m * LANES;
                lanes_stage(records, list, lanes[m].field);
                if (with_law)
                    stage_laws(loop->neighbours, loop->groups, loop->body, i, list, lanes[m].slip,
                               lanes[m].open);
                else if (!usual) {
                    memset(lanes[m].slip, 0, sizeof lanes[m].slip);
                    memset(lanes[m].open, 0, sizeof lanes[m].open);
                }
                find_places(kind, loop->smoothing, own, &lanes[m], &pairs[m]);
            }
            for (int m = 0; m < groups; m++) {
                if (!usual)
                    find_contacts(kind, own, &lanes[m], &pairs[m], &contacts);
                add_contacts(kind, usual, own, &lanes[m], &pairs[m], &contacts, sums);
            }
        }
}

/* FACTOR turns sums of forces into those of a unit of mass. */
INLINE void write_rates(const struct pair_rates *rates, int32_t i, double factor,
                        const struct totals_of_row *all, const struct totals_of_row *images)
{
    const double *g = all->gradient;
    for (int a = 0; a < 3; a++) {
        rates->acceleration[i][a] = factor * all->traction[a];
        if (rates->wall)
            rates->wall[i][a] = factor * images->traction[a];
        if (rates->drift) /* weights are never positive */
            rates->drift[i][a] = all->weight < 0.0 ? all->drift[a] / all->weight : 0.0;
    }
    rates->power[i] = factor * all->power;
    if (rates->hoop_pull) {
        double both = -all->hoop[1], missing = square(all->hoop[2]);
        missing = both > 0.0 ? missing / both : 0.0;
        rates->hoop_pull[i] = -2.0 * all->hoop[0] + missing;
        rates->hoop_strain[i] = both + missing;
    }
    /* dU^a/dx^b = -2 gradient[3 a + b], since the sums hold U* - U. */
    rates->strain_rate[i][0] = -2.0 * g[0];
    rates->strain_rate[i][1] = -2.0 * g[4];
    rates->strain_rate[i][2] = -2.0 * g[8];
    rates->strain_rate[i][3] = -(g[1] + g[3]);
    rates->strain_rate[i][4] = -(g[5] + g[7]);
    rates->strain_rate[i][5] = -(g[6] + g[2]);
    rates->spin[i][0] = g[5] - g[7];
    rates->spin[i][1] = g[6] - g[2];
    rates->spin[i][2] = g[1] - g[3];
}

/* An instance of add_part out of line, for contacts that are not the usual ones. */
typedef void add_apart(const struct pair_loop *loop, bool usual, bool with_law, int32_t i,
                       const uint32_t *entry, int count, struct sums *sums);

/* Adds the entries from BEGIN on that are of part PART; returns where the next part begins. */
static int add_other_part(const struct pair_loop *loop, add_apart *add, bool usual, int32_t i,
                          const uint32_t *entry, int begin, int count, unsigned part,
                          struct sums *sums)
{
    const int end = lanes_part(entry, begin, count, part);
    if (end > begin)
        add(loop, usual, part & PART_LAW, i, entry + begin, end - begin, sums);
    return end;
}

/* Most rows have but the first part, which nothing stands in the way of. */
INLINE void row_rates(const struct pair_loop *loop, struct pair_kind kind, add_apart *add,
                      int32_t i)
{
    int count, done = 0;
    const uint32_t *entry = neighbours_walk(loop->neighbours, i, &count);
    const bool drift = loop->kind.drift;
    const bool usual = !kind.turn && loop->kind.star == STAR_ACOUSTIC && !drift;
    const double *own = loop->record + (size_t)i * (size_t)record_stride(loop->kind);
    double factor =
        -2.0 / (kind.depth ? loop->density[i] * own[record_depth(loop->kind)] : loop->density[i]);
    struct sums sums = {0};
    static const struct totals_of_row none;
    const struct totals_of_row *of_images = &none;
    struct totals_of_row all, images;
    if (usual) {
        done = lanes_part(entry, 0, count, 0);
        if (done > 0)
            add_part(loop, kind, true, false, i, entry, done, &sums);
    } else {
        done = add_other_part(loop, add, usual, i, entry, 0, count, 0, &sums);
    }
    if (done < count)
        done = add_other_part(loop, add, usual, i, entry, done, count, PART_LAW, &sums);
    all = totals_of_sums(kind, drift, &sums);
    if (done < count) {
        memset(&sums, 0, sizeof sums);
        done = add_other_part(loop, add, usual, i, entry, done, count, PART_IMAGE, &sums);
        add_other_part(loop, add, usual, i, entry, done, count, PART_IMAGE | PART_LAW, &sums);
        images = totals_of_sums(kind, drift, &sums);
        for (int a = 0; a < 3; a++)
            all.traction[a] += images.traction[a];
        for (int a = 0; a < 9; a++)
            all.gradient[a] += images.gradient[a];
        all.power += images.power;
        all.weight += images.weight;
        for (int a = 0; a < 3; a++)
            all.drift[a] += images.drift[a];
        for (int a = 0; a < 3; a++)
            all.hoop[a] += images.hoop[a];
        of_images = &images;
    }
    write_rates(&loop->rates, i, factor, &all, of_images);
}

/* Each body of the rows' loop is an instance; its name says of which kind. How the two of a pair meet along it and whether
 * the drift is wanted is asked in the other instance of the part, out of line. */
#define INSTANCE(name, dimension, shear, depth, turn)                                          \
    APART void name##_part(const struct pair_loop *loop, bool usual, bool with_law, int32_t i, \
                           const uint32_t *entry, int count, struct sums *sums)                \
    {                                                                                          \
        const struct pair_kind kind = {dimension, shear, STAR_ACOUSTIC, false, depth, turn};   \
        const struct pair_kind any = {dimension,        shear, loop->kind.star,                \
                                      loop->kind.drift, depth, turn};                          \
        struct sums copy = *sums; /* that nothing else points at */                            \
        if (!turn && usual && !with_law)                                                       \
            add_part(loop, kind, true, false, i, entry, count, &copy);                         \
        else                                                                                   \
            add_part(loop, any, false, with_law, i, entry, count, &copy);                      \
        *sums = copy;                                                                          \
    }                                                                                          \
    static void name(const struct pair_loop *loop, int32_t begin, int32_t end)                 \
    {                                                                                          \
        const struct pair_kind kind = {dimension, shear, STAR_ACOUSTIC, false, depth, turn};   \
        for (int32_t i = begin; i < end; i++)                                                  \
            row_rates(loop, kind, name##_part, i);                                             \
    }

INSTANCE(line, 1, false, false, false)
INSTANCE(plane_fluid, 2, false, false, false)
INSTANCE(plane_solid, 2, true, false, false)
INSTANCE(plane_turn, 2, true, false, true)
INSTANCE(deep_fluid, 2, false, true, false)
INSTANCE(deep_solid, 2, true, true, false)
INSTANCE(deep_turn, 2, true, true, true)
INSTANCE(space_fluid, 3, false, false, false)
INSTANCE(space_solid, 3, true, false, false)
INSTANCE(space_turn, 3, true, false, true)

ISA_KERNEL(void, pair_loop_run, const struct pair_loop *loop, int32_t begin, int32_t end)
{
    typedef void instance(const struct pair_loop *, int32_t, int32_t);
    enum { DEEP = 3 }; /* behind the dimensions */
    static instance *const table[4][3] = {{line, line, line},
                                          {plane_fluid, plane_solid, plane_turn},
                                          {space_fluid, space_solid, space_turn},
                                          {deep_fluid, deep_solid, deep_turn}};
    const struct pair_kind kind = loop->kind;
    table[kind.depth ? DEEP : kind.dimension - 1][kind.shear + kind.turn](loop, begin, end);
}
