/* The pair loop of the second-order contact method for one instruction set, named by BOLIDE_ISA;
 * see kernel.h. The area vector is that of the renormalised meshless methods (Lanson and Vila, SIAM
 * J. Numer. Anal. 46 (2008) 1912). */
#include "sph/muscl/kernel.h"

#include "base/isa.h"
#include "sph/muscl/body.h"
#include "sph/muscl/closure.h"
#include "sph/muscl/rates.h"

/* Neighbours of one part of a row, and whether contact laws act. */
struct row_part {
    const uint32_t *entry;
    int count;
    bool with_law;
};

/* Adds the contacts of one part of a row. */
BOLIDE_INLINE void add_part(const struct muscl_loop *loop, struct muscl_kind kind,
                            struct row_part part, int32_t i, struct sums *sums)
{
    const struct lane_records records = {loop->record, muscl_stride(kind), kind.dimension,
                                         loop->empty,  loop->smoothing,    loop->place};
    const double *own = loop->record + (size_t)i * (size_t)records.stride;
    const struct laws laws = {loop->neighbours, loop->groups, loop->body};
    const double material = muscl_index(own[muscl_material(kind)]);
    struct lane_walk walk;
    struct lanes lanes[GROUPS];
    struct pairs pairs[GROUPS];
    walk.looked_at = walk.ready = walk.waiting = 0;
    while (lanes_walk(&walk, records, own, part.entry, part.count))
        for (int first = 0; first < walk.ready; first += GROUPS * LANES) {
            int left = (walk.ready - first) / LANES, groups = left < GROUPS ? left : GROUPS;
            for (int m = 0; m < groups; m++) {
                const uint32_t *list = walk.list + first + m * LANES;
                lanes_rows(records, list, lanes[m].record);
                for (int f = 0; f < muscl_fields(kind); f += 4)
                    transpose(lanes[m].record, f, lanes[m].field + f);
                if (part.with_law)
                    stage_laws(&laws, i, list, lanes[m].slip, lanes[m].open);
            }
            for (int m = 0; m < groups; m++)
                if (part.with_law)
                    find_places(kind, true, loop->smoothing, own, &lanes[m], &pairs[m], sums->lane);
                else
                    find_places(kind, false, loop->smoothing, own, &lanes[m], &pairs[m],
                                sums->lane);
            if (muscl_wide(kind) > 0)
                for (int m = 0; m < groups; m++)
                    walk_rows(kind, own, &lanes[m], &pairs[m], sums->row);
            for (int m = 0; m < groups; m++)
                if (part.with_law)
                    find_changes(kind, true, material, own, &lanes[m], &pairs[m]);
                else
                    find_changes(kind, false, material, own, &lanes[m], &pairs[m]);
            if (part.with_law)
                for (int m = 0; m < groups; m++)
                    add_contacts(kind, true, own, &lanes[m], &pairs[m], sums->lane);
            else
                for (int m = 0; m < groups; m++)
                    add_contacts(kind, false, own, &lanes[m], &pairs[m], sums->lane);
            if (kind.dimension > 1 && !part.with_law) /* laws let bodies part */
                add_pulls(kind, own, groups, lanes, pairs, sums->lane);
            if (muscl_narrow(kind) > 0)
                for (int m = 0; m < groups; m++)
                    add_slopes(kind, own, &lanes[m], &pairs[m], sums->lane);
        }
}

/* An instance of add_part out of line. */
typedef void add_apart(const struct muscl_loop *loop, struct row_part part, int32_t i,
                       struct sums *sums);

/* What of a row has not been added yet. */
struct rest {
    const uint32_t *entry;
    int begin, count;
};

/* Adds the entries of part PART, if they come next. */
static void add_next(const struct muscl_loop *loop, add_apart *add, int32_t i, struct rest *rest,
                     unsigned part, struct sums *sums)
{
    const int end = lanes_part(rest->entry, rest->begin, rest->count, part);
    if (end > rest->begin)
        add(loop, (struct row_part){rest->entry + rest->begin, end - rest->begin, part & PART_LAW},
            i, sums);
    rest->begin = end;
}

/* Sums up one neighbour list into the next lane of BATCH. Most have but the first part. */
BOLIDE_INLINE void sum_up(const struct muscl_loop *loop, struct muscl_kind kind, add_apart *add,
                          int32_t i, struct batch *batch)
{
    const struct layout at = layout_of(kind);
    struct rest rest = {0};
    rest.entry = neighbours_walk(loop->neighbours, i, &rest.count);
    static const double none[TOTALS];
    static const struct sums nothing;
    struct sums sums = nothing;
    double images[TOTALS], *all = batch->total[batch->count];
    const double *of_images = none;
    rest.begin = lanes_part(rest.entry, 0, rest.count, 0);
    if (rest.begin > 0)
        add_part(loop, kind, (struct row_part){rest.entry, rest.begin, false}, i, &sums);
    if (rest.begin < rest.count)
        add_next(loop, add, i, &rest, PART_LAW, &sums);
    sums_totals(kind, &sums, all);
    if (rest.begin < rest.count) {
        sums = nothing;
        add_next(loop, add, i, &rest, PART_IMAGE, &sums);
        add_next(loop, add, i, &rest, PART_IMAGE | PART_LAW, &sums);
        sums_totals(kind, &sums, images);
        for (int a = 0; a < at.count; a++)
            all[a] += images[a];
        of_images = images;
    }
    batch_add(loop, kind, i, of_images, batch);
}

/* Particles BEGIN .. END - 1. */
BOLIDE_INLINE void all_rates(const struct muscl_loop *loop, struct muscl_kind kind, add_apart *add,
                             int32_t begin, int32_t end)
{
    struct batch batch;
    batch.first = begin;
    batch.count = 0;
    for (int32_t i = begin; i < end; i++) {
        sum_up(loop, kind, add, i, &batch);
        if (batch.count == LANES || i == end - 1) {
            batch_pad(loop, kind, &batch);
            batch_finish(loop, kind, &batch);
        }
    }
}

/* Each body of the rows' loop is an instance; its name says of which kind. */
#define INSTANCE(name, ...)                                                                \
    APART void name##_part(const struct muscl_loop *loop, struct row_part part, int32_t i, \
                           struct sums *sums)                                              \
    {                                                                                      \
        struct sums copy = *sums; /* that nothing else points at */                        \
        add_part(loop, (struct muscl_kind){__VA_ARGS__}, part, i, &copy);                  \
        *sums = copy;                                                                      \
    }                                                                                      \
    static void name(const struct muscl_loop *loop, int32_t begin, int32_t end)            \
    {                                                                                      \
        all_rates(loop, (struct muscl_kind){__VA_ARGS__}, name##_part, begin, end);        \
    }

INSTANCE(line, 1, false, false)
INSTANCE(plane_fluid, 2, false, false)
INSTANCE(plane_solid, 2, true, false)
INSTANCE(deep_fluid, 2, false, true)
INSTANCE(deep_solid, 2, true, true)
INSTANCE(space_fluid, 3, false, false)
INSTANCE(space_solid, 3, true, false)

ISA_KERNEL(void, muscl_loop_run, const struct muscl_loop *loop, int32_t begin, int32_t end)
{
    typedef void instance(const struct muscl_loop *, int32_t, int32_t);
    enum { DEEP = 3 }; /* behind the dimensions */
    static instance *const table[4][2] = {{line, line},
                                          {plane_fluid, plane_solid},
                                          {space_fluid, space_solid},
                                          {deep_fluid, deep_solid}};
    const int form = loop->kind.depth ? DEEP : loop->kind.dimension - 1;
    table[form][loop->kind.shear](loop, begin, end);
}
