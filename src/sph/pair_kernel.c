/* The pair loop for one instruction set, named by BOLIDE_ISA; see pair_kernel.h.
 *
 * A row is compressed to the neighbours within support, their records are turned into eight lanes a field, and
 * lane k sums the neighbours k, k + 8, ...; lanes are added in a fixed order. So a sum depends on the row's
 * neighbours in support and their order alone. Contact terms are (1.20)-(1.37) of Parshikov (2013), with velocity
 * and traction split into the part along the pair and the part across it. */
#include <string.h>

#include "riemann/dukowicz.h"
#include "riemann/exact_gas.h"
#include "sph/kernel.h"
#include "sph/pair_kernel.h"

enum { LANES = 8, FIELDS = 24, CHUNK = 512 };

#define ALIGNED __attribute__((aligned(64)))
/* A kernel is instantiated by inlining all of this with its kind as a constant. Sanitized builds call instead: they
 * check the same code once, and compile in seconds. */
#if defined(BOLIDE_SANITIZE)
#define INLINE static
#else
#define INLINE static inline __attribute__((always_inline))
#endif

/* Eight neighbours, field by field, and for each whether a contact law cuts shear or tension. */
struct lanes {
    double field[FIELDS][LANES] ALIGNED;
    double slip[LANES] ALIGNED, open[LANES] ALIGNED;
};

/* Sums of V W' t*, V W' (U* - U)^a e^b and V W' t*.(U* - U), by lane. */
struct sums {
    double traction[3][LANES] ALIGNED, gradient[9][LANES] ALIGNED, power[LANES] ALIGNED;
    double weight[LANES] ALIGNED, drift[3][LANES] ALIGNED; /* V W', V W' (U* - U) */
};

struct totals_of_row {
    double traction[3], gradient[9], power, weight, drift[3];
};

#if defined(__AVX512F__)
typedef double vector8 __attribute__((vector_size(64)));
typedef long long index8 __attribute__((vector_size(64)));

/* Turns eight rows of eight into eight columns. */
INLINE void transpose(const double *const row[LANES], int offset, double (*column)[LANES])
{
    vector8 a[8], b[8];
    for (int k = 0; k < 8; k++)
        memcpy(&a[k], row[k] + offset, sizeof a[k]);
    const index8 low = {0, 8, 2, 10, 4, 12, 6, 14}, high = {1, 9, 3, 11, 5, 13, 7, 15};
    for (int k = 0; k < 8; k += 2) {
        b[k] = __builtin_shuffle(a[k], a[k + 1], low);
        b[k + 1] = __builtin_shuffle(a[k], a[k + 1], high);
    }
    const index8 pair_low = {0, 1, 8, 9, 4, 5, 12, 13}, pair_high = {2, 3, 10, 11, 6, 7, 14, 15};
    for (int k = 0; k < 8; k += 4)
        for (int m = 0; m < 2; m++) {
            a[k + m] = __builtin_shuffle(b[k + m], b[k + m + 2], pair_low);
            a[k + m + 2] = __builtin_shuffle(b[k + m], b[k + m + 2], pair_high);
        }
    const index8 half_low = {0, 1, 2, 3, 8, 9, 10, 11}, half_high = {4, 5, 6, 7, 12, 13, 14, 15};
    for (int k = 0; k < 4; k++) {
        vector8 first = __builtin_shuffle(a[k], a[k + 4], half_low);
        vector8 second = __builtin_shuffle(a[k], a[k + 4], half_high);
        memcpy(column[k], &first, sizeof first);
        memcpy(column[k + 4], &second, sizeof second);
    }
}
#else
INLINE void transpose(const double *const row[LANES], int offset, double (*column)[LANES])
{
    for (int k = 0; k < LANES; k++)
        for (int f = 0; f < 8; f++)
            column[f][k] = row[k][offset + f];
}
#endif

INLINE void stage(const struct pair_loop *loop, int stride, const int32_t *list,
                  struct lanes *lanes)
{
    const double *row[LANES];
    for (int k = 0; k < LANES; k++)
        row[k] = loop->record + (size_t)list[k] * (size_t)stride;
    for (int offset = 0; offset < stride; offset += 8)
        transpose(row, offset, lanes->field + offset);
}

/* The laws between a body and the eight neighbours of LIST. */
INLINE void stage_laws(const struct pair_loop *loop, int32_t i, const int32_t *list,
                       struct lanes *lanes)
{
    const struct contact_groups *groups = loop->groups;
    const struct neighbours *n = loop->neighbours;
    const uint8_t *law =
        groups->law + (size_t)groups->of_body[loop->body[i]] * (size_t)groups->groups;
    for (int k = 0; k < LANES; k++) {
        int32_t j = list[k];
        if (j >= n->count && j < n->count + n->ghosts.count)
            j = n->ghosts.source[j - n->count];
        unsigned bits = j < n->count ? law[groups->of_body[loop->body[j]]] : 0;
        lanes->slip[k] = bits & 1 ? 1.0 : 0.0;
        lanes->open[k] = bits & 2 ? 1.0 : 0.0;
    }
}

/* The stress that stands STEP doubles apart from S on, in the order of the record. */
INLINE struct sym3 stress_from(int dimension, const double *s, int step)
{
    struct sym3 stress = {s[0], 0.0, 0.0, 0.0, 0.0, 0.0};
    if (dimension == 2) {
        stress.yy = s[step];
        stress.xy = s[2 * step];
    }
    if (dimension == 3) {
        stress.yy = s[step];
        stress.zz = s[2 * step];
        stress.xy = s[3 * step];
        stress.yz = s[4 * step];
        stress.zx = s[5 * step];
    }
    return stress;
}

INLINE struct vec3 traction_of(int dimension, struct sym3 s, struct vec3 e)
{
    if (dimension == 2)
        return vec3_make(s.xx * e.x + s.xy * e.y, s.xy * e.x + s.yy * e.y, 0.0);
    return sym3_dot(s, e);
}

/* One own particle against eight neighbours. */
INLINE void add_lanes(struct pair_kind kind, bool with_law, double smoothing, const double *own,
                      const struct lanes *lanes, struct sums *sums)
{
    const int dimension = kind.dimension;
    const bool shear = kind.shear && dimension > 1;
    const int d = record_diameter(dimension), v = record_volume(dimension);
    const int u = record_velocity(dimension), s = record_stress(dimension);
    const int z = record_impedance(dimension, shear);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        struct vec3 x = vec3_make(lanes->field[0][k] - own[0], 0.0, 0.0);
        struct vec3 du = vec3_make(lanes->field[u][k] - own[u], 0.0, 0.0);
        if (dimension > 1) {
            x.y = lanes->field[1][k] - own[1];
            du.y = lanes->field[u + 1][k] - own[u + 1];
        }
        if (dimension > 2) {
            x.z = lanes->field[2][k] - own[2];
            du.z = lanes->field[u + 2][k] - own[u + 2];
        }
        double r = sqrt(maximum(vec3_dot(x, x), 1e-200));
        struct vec3 e = vec3_scale(1.0 / r, x);
        double inverse_h = 2.0 / (smoothing * (own[d] + lanes->field[d][k]));
        double weight = lanes->field[v][k] * kernel_slope(r, inverse_h, dimension);

        struct vec3 ti = {0.0, 0.0, 0.0}, tj = {0.0, 0.0, 0.0};
        if (shear) {
            ti = traction_of(dimension, stress_from(dimension, own + s, 1), e);
            tj = traction_of(dimension, stress_from(dimension, &lanes->field[s][k], LANES), e);
        }
        double along_i = shear ? vec3_dot(ti, e) : own[s];
        double along_j = shear ? vec3_dot(tj, e) : lanes->field[s][k];
        double along_u = vec3_dot(du, e);

        double stress, jump;
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
                kind.star == STAR_MEAN ? riemann_mean_weights()
                                       : riemann_acoustic_weights(own[z], lanes->field[z][k]);
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
            if (shear) {
                struct contact_weights across =
                    kind.star == STAR_MEAN
                        ? riemann_mean_weights()
                        : riemann_acoustic_weights(own[z + 1], lanes->field[z + 1][k]);
                struct vec3 ai = vec3_sub(ti, vec3_scale(along_i, e));
                struct vec3 aj = vec3_sub(tj, vec3_scale(along_j, e));
                struct vec3 da = vec3_sub(aj, ai);
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
            } else {
                w = vec3_add(w, vec3_scale(0.5, across_u));
            }
        }
        double power = weight * vec3_dot(t, w);
        t = vec3_scale(weight, t);
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

INLINE double across_lanes(const double lane[LANES])
{
    return ((lane[0] + lane[4]) + (lane[2] + lane[6])) +
           ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

INLINE struct totals_of_row totals_of_sums(bool drift, const struct sums *sums)
{
    struct totals_of_row totals;
    for (int a = 0; a < 3; a++)
        totals.traction[a] = across_lanes(sums->traction[a]);
    for (int a = 0; a < 9; a++)
        totals.gradient[a] = across_lanes(sums->gradient[a]);
    totals.power = across_lanes(sums->power);
    totals.weight = drift ? across_lanes(sums->weight) : 0.0;
    for (int a = 0; a < 3; a++)
        totals.drift[a] = drift ? across_lanes(sums->drift[a]) : 0.0;
    return totals;
}

/* Appends to LIST the neighbours of ENTRY within support of the particle. */
INLINE int compress(const struct pair_loop *loop, int dimension, int stride, const double *own,
                    const uint32_t *entry, int count, int32_t *list)
{
    const int d = record_diameter(dimension);
    int kept = 0;
    for (int q = 0; q < count; q++) {
        int32_t j = (int32_t)(entry[q] & ENTRY_INDEX);
        const double *other = loop->record + (size_t)j * (size_t)stride;
        double sum = square(other[0] - own[0]);
        if (dimension > 1)
            sum += square(other[1] - own[1]);
        if (dimension > 2)
            sum += square(other[2] - own[2]);
        list[kept] = j;
        kept += sum < square(loop->smoothing * (own[d] + other[d]));
    }
    return kept;
}

/* Adds the entries of one part of a row. Entries are taken in chunks that begin in lane zero: the first
 * neighbour of a part in support always stands in lane zero. */
INLINE void add_part(const struct pair_loop *loop, struct pair_kind kind, bool with_law, int32_t i,
                     const uint32_t *entry, int count, struct sums *sums)
{
    const int stride = record_stride(kind);
    const double *own = loop->record + (size_t)i * (size_t)stride;
    int32_t list[CHUNK + 2 * LANES];
    struct lanes lanes;
    int waiting = 0;
    for (int q = 0; q < count; q += CHUNK) {
        int length = count - q < CHUNK ? count - q : CHUNK;
        waiting += compress(loop, kind.dimension, stride, own, entry + q, length, list + waiting);
        bool last = q + length == count;
        if (last)
            while (waiting % LANES)
                list[waiting++] = loop->empty;
        int full = waiting / LANES * LANES;
        for (int k = 0; k < full; k += LANES) {
            stage(loop, stride, list + k, &lanes);
            if (with_law)
                stage_laws(loop, i, list + k, &lanes);
            add_lanes(kind, with_law, loop->smoothing, own, &lanes, sums);
        }
        waiting -= full;
        memmove(list, list + full, (size_t)waiting * sizeof *list);
    }
}

INLINE void write_rates(const struct pair_rates *rates, int32_t i, double density,
                        const struct totals_of_row *all, const struct totals_of_row *images)
{
    double factor = -2.0 / density;
    const double *g = all->gradient;
    for (int a = 0; a < 3; a++) {
        rates->acceleration[i][a] = factor * all->traction[a];
        if (rates->wall)
            rates->wall[i][a] = factor * images->traction[a];
        if (rates->drift) /* weights are never positive */
            rates->drift[i][a] = all->weight < 0.0 ? all->drift[a] / all->weight : 0.0;
    }
    rates->power[i] = factor * all->power;
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
    const uint32_t *entry = neighbours_row(loop->neighbours, i);
    int count = (int)loop->neighbours->row[i].count, done = 0;
    struct sums sums = {0};
    struct totals_of_row all = {0}, images = {0};
    if (count == 0 || entry[count - 1] >> ENTRY_PART_SHIFT == 0) {
        add_part(loop, kind, false, i, entry, count, &sums);
        all = totals_of_sums(kind.drift, &sums);
        write_rates(&loop->rates, i, loop->density[i], &all, &images);
        return;
    }
    for (unsigned part = 0; part < 4; part++) {
        int begin = done;
        while (done < count && entry[done] >> ENTRY_PART_SHIFT == part)
            done++;
        if (part == PART_IMAGE) {
            all = totals_of_sums(kind.drift, &sums);
            memset(&sums, 0, sizeof sums);
        }
        if (done > begin && part & PART_LAW)
            add_part(loop, kind, true, i, entry + begin, done - begin, &sums);
        else if (done > begin)
            add_part(loop, kind, false, i, entry + begin, done - begin, &sums);
    }
    images = totals_of_sums(kind.drift, &sums);
    for (int a = 0; a < 3; a++)
        all.traction[a] += images.traction[a];
    for (int a = 0; a < 9; a++)
        all.gradient[a] += images.gradient[a];
    all.power += images.power;
    all.weight += images.weight;
    for (int a = 0; a < 3; a++)
        all.drift[a] += images.drift[a];
    write_rates(&loop->rates, i, loop->density[i], &all, &images);
}

#define INSTANCE(name, dimension, shear, star, drift)                          \
    static void name(const struct pair_loop *loop, int32_t begin, int32_t end) \
    {                                                                          \
        const struct pair_kind kind = {dimension, shear, star, drift};         \
        for (int32_t i = begin; i < end; i++)                                  \
            row_rates(loop, kind, i);                                          \
    }

#define INSTANCES(medium, dimension, shear)                                  \
    INSTANCE(medium##_acoustic, dimension, shear, STAR_ACOUSTIC, false)      \
    INSTANCE(medium##_mean, dimension, shear, STAR_MEAN, false)              \
    INSTANCE(medium##_dukowicz, dimension, shear, STAR_DUKOWICZ, false)      \
    INSTANCE(medium##_acoustic_drift, dimension, shear, STAR_ACOUSTIC, true) \
    INSTANCE(medium##_mean_drift, dimension, shear, STAR_MEAN, true)         \
    INSTANCE(medium##_dukowicz_drift, dimension, shear, STAR_DUKOWICZ, true)

#define GAS_INSTANCES(medium, dimension)                                  \
    INSTANCE(medium##_exact_gas, dimension, false, STAR_EXACT_GAS, false) \
    INSTANCE(medium##_exact_gas_drift, dimension, false, STAR_EXACT_GAS, true)

INSTANCES(line, 1, false)
INSTANCES(plane_fluid, 2, false)
INSTANCES(plane_solid, 2, true)
INSTANCES(space_fluid, 3, false)
INSTANCES(space_solid, 3, true)
GAS_INSTANCES(line, 1)
GAS_INSTANCES(plane_fluid, 2)
GAS_INSTANCES(space_fluid, 3)

#define JOIN(a, b) a##b
#define NAME_OF(isa) JOIN(pair_loop_run_, isa)

void NAME_OF(BOLIDE_ISA)(const struct pair_loop *loop, int32_t begin, int32_t end);

void NAME_OF(BOLIDE_ISA)(const struct pair_loop *loop, int32_t begin, int32_t end)
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
    static instance *const table[3][2][4][2] = {
        {STARS(line, GAS(line)), STARS(line, GAS(line))},
        {STARS(plane_fluid, GAS(plane_fluid)), STARS(plane_solid, NO_GAS)},
        {STARS(space_fluid, GAS(space_fluid)), STARS(space_solid, NO_GAS)}};
    const struct pair_kind kind = loop->kind;
    table[kind.dimension - 1][kind.shear][kind.star][kind.drift](loop, begin, end);
}
