/* The pair loops with corrected gradients for one instruction set, named by BOLIDE_ISA; see
 * kernel.h. The Riemann problem along a pair is riemann/hllc.h; how rows become lanes is lanes.h.
 */
#include "sph/hllc/kernel.h"

#include "base/isa.h"
#include "sph/hllc/body.h"

BOLIDE_INLINE void row_gradients(const struct hllc_loop *loop, int dimension, int32_t i)
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
    struct sym3 moment = {across_lanes(sums.moment[0]),
                          across_lanes(sums.moment[1]),
                          0.0,
                          across_lanes(sums.moment[2]),
                          0.0,
                          0.0};
    struct sym3 l = inverse_of(dimension, moment);
    memcpy(rates->correction[i], &l, sizeof l);
    struct vec3 x = gradient_row(l, &sums, 0), y = gradient_row(l, &sums, 1);
    struct sym3 strain = {x.x, y.y, 0.0, 0.5 * (x.y + y.x), 0.0, 0.0};
    struct vec3 spin = {0.0, 0.0, 0.5 * (y.x - x.y)};
    memcpy(rates->strain_rate[i], &strain, sizeof strain);
    memcpy(rates->spin[i], &spin, sizeof spin);
    for (int s = 0; rates->slopes && s < 3; s++)
        rates->slopes[i][s] = l.xx * across_lanes(sums.scalar[s]);
}

/* Adds the entries of one part of a row. */
BOLIDE_INLINE struct forces part_forces(const struct hllc_loop *loop, struct hllc_kind kind,
                                        int32_t i, const uint32_t *entry, int count)
{
    const struct lane_records records = {.record = loop->record,
                                         .stride = hllc_stride(kind),
                                         .dimension = kind.dimension,
                                         .empty = loop->empty,
                                         .smoothing = loop->smoothing,
                                         NULL};
    const double *own = loop->record + (size_t)i * (size_t)records.stride;
    double field[FIELDS][LANES] ALIGNED;
    const struct eight eight = {kind, loop->selection, loop->smoothing, own,
                                (const double(*)[LANES])field};
    struct force_sums sums = {0};
    struct lane_walk walk;
    walk.looked_at = walk.ready = walk.waiting = 0;
    while (lanes_walk(&walk, records, own, entry, count))
        for (int k = 0; k < walk.ready; k += LANES) {
            lanes_stage(records, walk.list + k, field);
            add_forces(&eight, &sums);
        }
    struct forces forces;
    for (int a = 0; a < 2; a++)
        forces.force[a] = across_lanes(sums.force[a]);
    forces.power = across_lanes(sums.power);
    forces.mass = across_lanes(sums.mass);
    return forces;
}

BOLIDE_INLINE void row_forces(const struct hllc_loop *loop, struct hllc_kind kind, int32_t i)
{
    const double *own = loop->record + (size_t)i * (size_t)hllc_stride(kind);
    const struct hllc_rates *rates = &loop->rates;
    const uint32_t *entry = neighbours_row(loop->neighbours, i);
    int count = (int)loop->neighbours->row[i].count, without_images = count;
    while (without_images > 0 && entry[without_images - 1] >> ENTRY_PART_SHIFT == PART_IMAGE)
        without_images--;
    struct forces part[2] = {{{0.0, 0.0}, 0.0, 0.0}};
    for (int k = 0, begin = 0; k < 2 && begin < count; k++) {
        const int end = k ? count : without_images;
        part[k] = part_forces(loop, kind, i, entry + begin, end - begin);
        begin = end;
    }
    const struct forces all = part[0], images = part[1];
    double density = own[hllc_density(kind.dimension)];
    double factor = 2.0 / density;
    for (int a = 0; a < 2; a++) {
        rates->acceleration[i][a] = factor * (all.force[a] + images.force[a]);
        if (rates->wall)
            rates->wall[i][a] = factor * images.force[a];
    }
    rates->power[i] = factor * (all.power + images.power);
    const double *strain = rates->strain_rate[i];
    rates->density_rate[i] =
        loop->by_mass ? -(all.mass + images.mass) : -density * (strain[0] + strain[1]);
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
#define INSTANCES(medium, dimension)                  \
    FORCES(medium##_viscous, dimension, true, false)  \
    FORCES(medium##_contact, dimension, false, false) \
    FORCES(medium##_reconstructed, dimension, false, true)

GRADIENTS(line, 1)
GRADIENTS(plane, 2)
INSTANCES(line, 1)
INSTANCES(plane, 2)

ISA_KERNEL(void, hllc_find_gradients, const struct hllc_loop *loop, int32_t begin, int32_t end)
{
    typedef void instance(const struct hllc_loop *, int32_t, int32_t);
    static instance *const table[2] = {line_gradients, plane_gradients};
    table[loop->kind.dimension - 1](loop, begin, end);
}

ISA_KERNEL(void, hllc_find_forces, const struct hllc_loop *loop, int32_t begin, int32_t end)
{
    typedef void instance(const struct hllc_loop *, int32_t, int32_t);
    static instance *const table[2][3] = {{line_viscous, line_contact, line_reconstructed},
                                          {plane_viscous, plane_contact, plane_reconstructed}};
    const struct hllc_kind kind = loop->kind;
    const int pairs = kind.viscous ? 0 : 1 + kind.reconstructed;
    table[kind.dimension - 1][pairs](loop, begin, end);
}
