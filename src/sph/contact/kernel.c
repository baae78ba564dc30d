/* The pair loop for one instruction set, named by BOLIDE_ISA; see kernel.h.
 *
 * Contact terms are (1.20)-(1.37) of Parshikov (2013), with velocity and traction split into the
 * part along the pair and the part across it; how rows become lanes is lanes.h. */
#include "sph/contact/kernel.h"

#include "base/isa.h"
#include "sph/contact/body.h"

BOLIDE_INLINE struct totals_of_row totals_of_sums(struct pair_kind kind, bool drift,
                                                  const struct sums *sums)
{
    double lane[TOTALS][LANES] ALIGNED, total[TOTALS];
    struct totals_of_row totals = {0};
    if (kind.dimension == 1) { /* few */
        totals.traction[0] = across_lanes(sums->traction[0]);
        totals.gradient[0] = across_lanes(sums->gradient[0]);
        totals.power = across_lanes(sums->power);
        totals.weight = drift || kind.breaks ? across_lanes(sums->weight) : 0.0;
        totals.drift[0] = drift ? across_lanes(sums->drift[0]) : 0.0;
        totals.broken = kind.breaks ? across_lanes(sums->broken) : 0.0;
        return totals;
    }
    memcpy(lane, sums, sizeof lane);
    lanes_totals(lane, TOTALS, total);
    memcpy(&totals, total, sizeof totals);
    return totals;
}

/* Neighbours of one part of a row: whether their contacts are the usual ones, and whether contact
 * laws act. */
struct row_part {
    const uint32_t *entry;
    int count;
    bool usual, with_law;
};

/* Adds the contacts of one part of a row. */
BOLIDE_INLINE void add_part(const struct pair_loop *loop, struct pair_kind kind,
                            struct row_part part, int32_t i, struct sums *sums)
{
    const struct lane_records records = {loop->record, record_stride(kind), kind.dimension,
                                         loop->empty,  loop->smoothing,     NULL};
    const double *own = loop->record + (size_t)i * (size_t)records.stride;
    const struct laws laws = {loop->neighbours, loop->groups, loop->body};
    struct lane_walk walk;
    struct lanes lanes[GROUPS];
    struct pairs pairs[GROUPS];
    struct contacts contacts;
    walk.looked_at = walk.ready = walk.waiting = 0;
    while (lanes_walk(&walk, records, own, part.entry, part.count))
        for (int first = 0; first < walk.ready; first += GROUPS * LANES) {
            int left = (walk.ready - first) / LANES, groups = left < GROUPS ? left : GROUPS;
            for (int m = 0; m < groups; m++) {
                const uint32_t *list = walk.list + first + m * LANES;
                lanes_stage(records, list, lanes[m].field);
                if (part.with_law)
                    stage_laws(&laws, i, list, lanes[m].slip, lanes[m].open);
                else if (!part.usual) {
                    memset(lanes[m].slip, 0, sizeof lanes[m].slip);
                    memset(lanes[m].open, 0, sizeof lanes[m].open);
                }
                find_places(kind, loop->smoothing, own, &lanes[m], &pairs[m]);
            }
            for (int m = 0; m < groups; m++) {
                if (!part.usual)
                    find_contacts(kind, own, &lanes[m], &pairs[m], &contacts);
                add_contacts(kind, own, &lanes[m], &pairs[m], part.usual ? NULL : &contacts, sums);
            }
        }
}

/* FACTOR turns sums of forces into those of a unit of mass. */
BOLIDE_INLINE void write_rates(const struct pair_rates *rates, int32_t i, double factor,
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
    if (rates->broken)
        rates->broken[i] = all->weight < 0.0 ? all->broken / all->weight : 0.0;
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
typedef void add_apart(const struct pair_loop *loop, struct row_part part, int32_t i,
                       struct sums *sums);

/* What of a row has not been added yet. */
struct rest {
    const uint32_t *entry;
    int begin, count;
    bool usual;
};

/* Adds the entries of part PART, if they come next. */
static void add_next(const struct pair_loop *loop, add_apart *add, int32_t i, struct rest *rest,
                     unsigned part, struct sums *sums)
{
    const int end = lanes_part(rest->entry, rest->begin, rest->count, part);
    if (end > rest->begin)
        add(loop,
            (struct row_part){rest->entry + rest->begin, end - rest->begin, rest->usual,
                              part & PART_LAW},
            i, sums);
    rest->begin = end;
}

/* Most rows have but the first part, which nothing stands in the way of. */
BOLIDE_INLINE void row_rates(const struct pair_loop *loop, struct pair_kind kind, add_apart *add,
                             int32_t i)
{
    struct rest rest = {.usual = !kind.turn && loop->kind.star == STAR_ACOUSTIC &&
                                 !loop->kind.drift && !loop->kind.breaks};
    rest.entry = neighbours_walk(loop->neighbours, i, &rest.count);
    const bool drift = loop->kind.drift;
    const double *own = loop->record + (size_t)i * (size_t)record_stride(loop->kind);
    double factor =
        -2.0 / (kind.depth ? loop->density[i] * own[record_depth(loop->kind)] : loop->density[i]);
    struct sums sums = {0};
    static const struct totals_of_row none;
    const struct totals_of_row *of_images = &none;
    struct totals_of_row all, images;
    if (rest.usual) {
        rest.begin = lanes_part(rest.entry, 0, rest.count, 0);
        if (rest.begin > 0)
            add_part(loop, kind, (struct row_part){rest.entry, rest.begin, true, false}, i, &sums);
    } else {
        add_next(loop, add, i, &rest, 0, &sums);
    }
    if (rest.begin < rest.count)
        add_next(loop, add, i, &rest, PART_LAW, &sums);
    const struct pair_kind summed = {.dimension = kind.dimension, .breaks = loop->kind.breaks};
    all = totals_of_sums(summed, drift, &sums);
    if (rest.begin < rest.count) {
        memset(&sums, 0, sizeof sums);
        add_next(loop, add, i, &rest, PART_IMAGE, &sums);
        add_next(loop, add, i, &rest, PART_IMAGE | PART_LAW, &sums);
        images = totals_of_sums(summed, drift, &sums);
        for (int a = 0; a < 3; a++)
            all.traction[a] += images.traction[a];
        for (int a = 0; a < 9; a++)
            all.gradient[a] += images.gradient[a];
        all.power += images.power;
        all.weight += images.weight;
        all.broken += images.broken;
        for (int a = 0; a < 3; a++)
            all.drift[a] += images.drift[a];
        for (int a = 0; a < 3; a++)
            all.hoop[a] += images.hoop[a];
        of_images = &images;
    }
    write_rates(&loop->rates, i, factor, &all, of_images);
}

/* Each body of the rows' loop is an instance; its name says of which kind. How the two of a pair
 * meet along it and whether the drift is wanted is asked in the other instance of the part, out of
 * line. */
#define INSTANCE(name, dimension, shear, depth, turn)                                       \
    APART void name##_part(const struct pair_loop *loop, struct row_part part, int32_t i,   \
                           struct sums *sums)                                               \
    {                                                                                       \
        const struct pair_kind kind = {                                                     \
            dimension, shear, STAR_ACOUSTIC, false, depth, turn, false};                    \
        const struct pair_kind any = {dimension, shear, loop->kind.star,  loop->kind.drift, \
                                      depth,     turn,  loop->kind.breaks};                 \
        struct sums copy = *sums; /* that nothing else points at */                         \
        const struct row_part usual = {part.entry, part.count, true, false};                \
        const struct row_part other = {part.entry, part.count, false, part.with_law};       \
        if (!turn && part.usual && !part.with_law)                                          \
            add_part(loop, kind, usual, i, &copy);                                          \
        else                                                                                \
            add_part(loop, any, other, i, &copy);                                           \
        *sums = copy;                                                                       \
    }                                                                                       \
    static void name(const struct pair_loop *loop, int32_t begin, int32_t end)              \
    {                                                                                       \
        const struct pair_kind kind = {                                                     \
            dimension, shear, STAR_ACOUSTIC, false, depth, turn, false};                    \
        for (int32_t i = begin; i < end; i++)                                               \
            row_rates(loop, kind, name##_part, i);                                          \
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
