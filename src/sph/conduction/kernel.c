/* The heat loop for one instruction set, named by BOLIDE_ISA; see kernel.h. */
#include "sph/conduction/kernel.h"

#include "base/isa.h"
#include "sph/kernel.h"
#include "sph/lanes.h"

/* One own particle against eight neighbours: adds V W' k (T_j - T_i)/r. */
INLINE void add_lanes(int dimension, bool depth, enum heat_form form, double smoothing,
                      const double *own, double (*field)[LANES], double sum[LANES])
{
    const int d = dimension, v = heat_record_volume(dimension);
    const int t = heat_record_temperature(dimension), w = heat_record_depth(dimension);
    const int c = heat_record_conductivity(dimension), q = heat_record_diffusivity(dimension);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        double r2 = square(field[0][k] - own[0]);
        if (dimension > 1)
            r2 += square(field[1][k] - own[1]);
        if (dimension > 2)
            r2 += square(field[2][k] - own[2]);
        double r = sqrt(maximum(r2, 1e-200));
        double inverse_h = 2.0 / (smoothing * (own[d] + field[d][k]));
        double weight = field[v][k] * kernel_slope(r, inverse_h, dimension);
        if (depth)
            weight *= 0.5 * fabs(own[w] + field[w][k]);
        double conductivity =
            heat_pair_conductivity(form, own[c], own[q], field[c][k], field[q][k]);
        sum[k] += weight * conductivity * (field[t][k] - own[t]) / r;
    }
}

INLINE void row_rate(const struct heat_loop *loop, int dimension, bool depth, enum heat_form form,
                     int32_t i)
{
    const struct lane_records records = {loop->record, HEAT_STRIDE,     dimension,
                                         loop->empty,  loop->smoothing, NULL};
    const double *own = loop->record + (size_t)i * HEAT_STRIDE;
    const uint32_t *entry = neighbours_row(loop->neighbours, i);
    const int count = (int)loop->neighbours->row[i].count;
    double field[HEAT_STRIDE][LANES] ALIGNED, sum[LANES] ALIGNED = {0.0};
    struct lane_walk walk;
    walk.looked_at = walk.ready = walk.waiting = 0;
    while (lanes_walk(&walk, records, own, entry, count))
        for (int k = 0; k < walk.ready; k += LANES) {
            lanes_stage(records, walk.list + k, field);
            add_lanes(dimension, depth, form, loop->smoothing, own, field, sum);
        }
    double per = depth ? loop->density[i] * own[heat_record_depth(dimension)] : loop->density[i];
    loop->rate[i] = -across_lanes(sum) / per;
}

#define INSTANCE(name, dimension, depth, form)                                 \
    static void name(const struct heat_loop *loop, int32_t begin, int32_t end) \
    {                                                                          \
        for (int32_t i = begin; i < end; i++)                                  \
            row_rate(loop, dimension, depth, form, i);                         \
    }

INSTANCE(line_contact, 1, false, HEAT_CONTACT)
INSTANCE(line_harmonic, 1, false, HEAT_HARMONIC)
INSTANCE(plane_contact, 2, false, HEAT_CONTACT)
INSTANCE(plane_harmonic, 2, false, HEAT_HARMONIC)
INSTANCE(space_contact, 3, false, HEAT_CONTACT)
INSTANCE(space_harmonic, 3, false, HEAT_HARMONIC)
INSTANCE(deep_contact, 2, true, HEAT_CONTACT)
INSTANCE(deep_harmonic, 2, true, HEAT_HARMONIC)

ISA_KERNEL(void, heat_loop_run, const struct heat_loop *loop, int32_t begin, int32_t end)
{
    typedef void instance(const struct heat_loop *, int32_t, int32_t);
    static instance *const table[4][2] = {{line_contact, line_harmonic},
                                          {plane_contact, plane_harmonic},
                                          {space_contact, space_harmonic},
                                          {deep_contact, deep_harmonic}};
    table[loop->depth ? 3 : loop->dimension - 1][loop->form](loop, begin, end);
}
