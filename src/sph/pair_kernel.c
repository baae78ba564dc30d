/* The pair loop for one instruction set, named by BOLIDE_ISA; see pair_kernel.h.
 *
 * Contact terms are (1.20)-(1.37) of Parshikov (2013), with velocity and traction split into the part along the
 * pair and the part across it; how rows become lanes is lanes.h. */
#include "sph/pair_kernel.h"

#include "base/isa.h"
#include "riemann/dukowicz.h"
#include "riemann/exact_gas.h"
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

/* Solves their contact problems and adds up what they give. */
INLINE void add_contacts(struct pair_kind kind, bool with_law, const double *own,
                         const struct lanes *lanes, const struct pairs *pairs, struct sums *sums)
{
    const int dimension = kind.dimension;
    const bool shear = kind.shear && dimension > 1;
    const int d = record_diameter(dimension);
    const int u = record_velocity(dimension), s = record_stress(dimension);
    const int z = record_impedance(dimension, shear);
    const int depth = record_depth(kind), spin = record_spin(kind);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        const double r = pairs->r[k], weight = pairs->weight[k];
        const struct vec3 e = vector_from(dimension, &pairs->e[0][k], LANES);
        const struct vec3 du = vec3_sub(vector_from(dimension, &lanes->field[u][k], LANES),
                                        vector_from(dimension, own + u, 1));
        struct vec3 ti = {0.0, 0.0, 0.0}, tj = {0.0, 0.0, 0.0};
        if (shear) {
            ti = traction_of(dimension, stress_from(dimension, own + s, 1), e);
            tj = traction_of(dimension, stress_from(dimension, &lanes->field[s][k], LANES), e);
        }
        double along_i = shear ? vec3_dot(ti, e) : own[s];
        double along_j = shear ? vec3_dot(tj, e) : lanes->field[s][k];
        double along_u = vec3_dot(du, e);

        double stress, jump;
        const int across_z = shear ? z + 1 : z;
        const struct two_inverses inverse =
            inverses_of_sums(own[z], lanes->field[z][k], own[across_z], lanes->field[across_z][k]);
        if (record_has_bend(kind)) {
            const int q = record_bend(dimension, shear);
            struct side left = {own[z], 0.0, along_i, own[q], own[q + 1]};
            struct side right = {lanes->field[z][k], along_u, along_j, lanes->field[q][k],
                                 lanes->field[q + 1][k]};
            struct contact contact = kind.star == STAR_DUKOWICZ ? riemann_dukowicz(left, right)
                                                                : riemann_exact_gas(left, right);
            stress = contact.stress;
            jump = contact.velocity;
        } else {
            struct contact_weights along =
                kind.star == STAR_MEAN
                    ? riemann_mean_weights()
                    : contact_weights_of(own[z], lanes->field[z][k], inverse.first);
            stress = contact_stress(along, along_i, along_j, along_u);
            jump = contact_velocity_jump(along, along_u, along_j - along_i);
        }
        double opened = 0.0;
        if (with_law) {
            opened = stress > 0.0 ? lanes->open[k] : 0.0;
            jump = opened > 0.0 ? -along_i / own[z] : jump;
            stress = opened > 0.0 ? 0.0 : stress;
        }
        struct vec3 t = vec3_scale(stress, e), w = vec3_scale(jump, e);
        if (dimension > 1) {
            struct vec3 across_u = vec3_sub(du, vec3_scale(along_u, e));
            struct vec3 own_turn = {0.0, 0.0, 0.0}; /* what the spin of i adds at the contact */
            if (kind.turn) {
                double share = own[d] / (own[d] + lanes->field[d][k]);
                struct vec3 spin_i = spin_from(dimension, own + spin, 1);
                struct vec3 spin_j = spin_from(dimension, &lanes->field[spin][k], LANES);
                own_turn = vec3_scale(share * r, vec3_cross(spin_i, e));
                across_u = vec3_sub(
                    across_u,
                    vec3_add(own_turn, vec3_scale((1.0 - share) * r, vec3_cross(spin_j, e))));
            }
            if (shear) {
                struct vec3 ai = vec3_sub(ti, vec3_scale(along_i, e));
                struct vec3 aj = vec3_sub(tj, vec3_scale(along_j, e));
                struct vec3 da = vec3_sub(aj, ai);
                struct contact_weights across =
                    kind.star == STAR_MEAN
                        ? riemann_mean_weights()
                        : contact_weights_of(own[z + 1], lanes->field[z + 1][k], inverse.second);
                struct vec3 ta =
                    vec3_add(vec3_add(vec3_scale(across.left, aj), vec3_scale(across.right, ai)),
                             vec3_scale(across.impedance, across_u));
                struct vec3 wa =
                    vec3_add(vec3_scale(across.right, across_u), vec3_scale(across.compliance, da));
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
                if (kind.turn)
                    w = vec3_add(w, own_turn);
            } else {
                w = vec3_add(w, vec3_scale(0.5, across_u));
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
        double power = force_weight * vec3_dot(t, w);
        t = vec3_scale(force_weight, t);
        w = vec3_scale(weight, w);
        sums->power[k] += power;
        if (kind.drift) {
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

INLINE struct totals_of_row totals_of_sums(struct pair_kind kind, const struct sums *sums)
{
    double lane[TOTALS][LANES] ALIGNED, total[TOTALS];
    struct totals_of_row totals = {0};
    if (kind.dimension == 1) { /* few */
        totals.traction[0] = across_lanes(sums->traction[0]);
        totals.gradient[0] = across_lanes(sums->gradient[0]);
        totals.power = across_lanes(sums->power);
        totals.weight = kind.drift ? across_lanes(sums->weight) : 0.0;
        totals.drift[0] = kind.drift ? across_lanes(sums->drift[0]) : 0.0;
        return totals;
    }
    memcpy(lane, sums, sizeof lane);
    lanes_totals(lane, TOTALS, total);
    memcpy(&totals, total, sizeof totals);
    return totals;
}

/* Adds the entries of one part of a row. */
INLINE void add_part(const struct pair_loop *loop, struct pair_kind kind, bool with_law, int32_t i,
                     const uint32_t *entry, int count, struct sums *sums)
{
    const struct lane_records records = {loop->record, record_stride(kind), kind.dimension,
                                         loop->empty,  loop->smoothing,     NULL};
    const double *own = loop->record + (size_t)i * (size_t)records.stride;
    struct lane_walk walk;
    struct lanes lanes[GROUPS];
    struct pairs pairs[GROUPS];
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
                find_places(kind, loop->smoothing, own, &lanes[m], &pairs[m]);
            }
            for (int m = 0; m < groups; m++)
                add_contacts(kind, with_law, own, &lanes[m], &pairs[m], sums);
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

INLINE void row_rates(const struct pair_loop *loop, struct pair_kind kind, int32_t i)
{
    int count, done = 0;
    const uint32_t *entry = neighbours_walk(loop->neighbours, i, &count);
    const double *own = loop->record + (size_t)i * (size_t)record_stride(kind);
    double factor =
        -2.0 / (kind.depth ? loop->density[i] * own[record_depth(kind)] : loop->density[i]);
    struct sums sums = {0};
    static const struct totals_of_row none;
    struct totals_of_row all, images;
    const bool seen = count > 0 && entry[count - 1] >> ENTRY_PART_SHIFT >= PART_IMAGE;
    for (unsigned part = 0; part < (seen ? 4 : PART_IMAGE); part++) {
        int begin = done;
        done = lanes_part(entry, begin, count, part);
        if (part == PART_IMAGE) {
            all = totals_of_sums(kind, &sums);
            memset(&sums, 0, sizeof sums);
        }
        if (done > begin && part & PART_LAW)
            add_part(loop, kind, true, i, entry + begin, done - begin, &sums);
        else if (done > begin)
            add_part(loop, kind, false, i, entry + begin, done - begin, &sums);
    }
    if (!seen) {
        all = totals_of_sums(kind, &sums);
        write_rates(&loop->rates, i, factor, &all, &none);
        return;
    }
    images = totals_of_sums(kind, &sums);
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
    write_rates(&loop->rates, i, factor, &all, &images);
}

/* Each body of the rows' loop is an instance; its name says of which kind. */
#define INSTANCE(name, ...)                                                    \
    static void name(const struct pair_loop *loop, int32_t begin, int32_t end) \
    {                                                                          \
        const struct pair_kind kind = {__VA_ARGS__};                           \
        for (int32_t i = begin; i < end; i++)                                  \
            row_rates(loop, kind, i);                                          \
    }

#define INSTANCES(medium, dimension, shear, depth)                                         \
    INSTANCE(medium##_acoustic, dimension, shear, STAR_ACOUSTIC, false, depth, false)      \
    INSTANCE(medium##_mean, dimension, shear, STAR_MEAN, false, depth, false)              \
    INSTANCE(medium##_dukowicz, dimension, shear, STAR_DUKOWICZ, false, depth, false)      \
    INSTANCE(medium##_acoustic_drift, dimension, shear, STAR_ACOUSTIC, true, depth, false) \
    INSTANCE(medium##_mean_drift, dimension, shear, STAR_MEAN, true, depth, false)         \
    INSTANCE(medium##_dukowicz_drift, dimension, shear, STAR_DUKOWICZ, true, depth, false)

#define GAS_INSTANCES(medium, dimension, depth)                                         \
    INSTANCE(medium##_exact_gas, dimension, false, STAR_EXACT_GAS, false, depth, false) \
    INSTANCE(medium##_exact_gas_drift, dimension, false, STAR_EXACT_GAS, true, depth, false)

#define TURN_INSTANCES(medium, dimension, depth)                                \
    INSTANCE(medium##_turn, dimension, true, STAR_ACOUSTIC, false, depth, true) \
    INSTANCE(medium##_turn_drift, dimension, true, STAR_ACOUSTIC, true, depth, true)

INSTANCES(line, 1, false, false)
INSTANCES(plane_fluid, 2, false, false)
INSTANCES(plane_solid, 2, true, false)
INSTANCES(deep_fluid, 2, false, true)
INSTANCES(deep_solid, 2, true, true)
INSTANCES(space_fluid, 3, false, false)
INSTANCES(space_solid, 3, true, false)
GAS_INSTANCES(line, 1, false)
GAS_INSTANCES(plane_fluid, 2, false)
GAS_INSTANCES(deep_fluid, 2, true)
GAS_INSTANCES(space_fluid, 3, false)
TURN_INSTANCES(plane_solid, 2, false)
TURN_INSTANCES(deep_solid, 2, true)
TURN_INSTANCES(space_solid, 3, false)

ISA_KERNEL(void, pair_loop_run, const struct pair_loop *loop, int32_t begin, int32_t end)
{
    typedef void instance(const struct pair_loop *, int32_t, int32_t);
#define STARS(medium, gas)                                                                  \
    {                                                                                       \
        {medium##_acoustic, medium##_acoustic_drift}, {medium##_mean, medium##_mean_drift}, \
            {medium##_dukowicz, medium##_dukowicz_drift}, gas                               \
    }
#define GAS(medium)                                  \
    {                                                \
        medium##_exact_gas, medium##_exact_gas_drift \
    }
#define NO_GAS     \
    {              \
        NULL, NULL \
    }
    enum { DEEP = 3 }; /* behind the dimensions */
    static instance *const table[4][2][4][2] = {
        {STARS(line, GAS(line)), STARS(line, GAS(line))},
        {STARS(plane_fluid, GAS(plane_fluid)), STARS(plane_solid, NO_GAS)},
        {STARS(space_fluid, GAS(space_fluid)), STARS(space_solid, NO_GAS)},
        {STARS(deep_fluid, GAS(deep_fluid)), STARS(deep_solid, NO_GAS)}};
    static instance *const turning[4][2] = {{NULL, NULL},
                                            {plane_solid_turn, plane_solid_turn_drift},
                                            {space_solid_turn, space_solid_turn_drift},
                                            {deep_solid_turn, deep_solid_turn_drift}};
    const struct pair_kind kind = loop->kind;
    const int space = kind.depth ? DEEP : kind.dimension - 1;
    (kind.turn ? turning[space][kind.drift]
               : table[space][kind.shear][kind.star][kind.drift])(loop, begin, end);
}
