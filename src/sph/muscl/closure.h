/* The force that keeps particles in their places in tension. For the files that are compiled once
 * an instruction set, and for a device. */
#ifndef BOLIDE_SPH_MUSCL_CLOSURE_H
#define BOLIDE_SPH_MUSCL_CLOSURE_H

#include "sph/muscl/body.h"

/* How much a particle pulls: the trace of the tensile part of its stress, whose record stands STEP
 * doubles apart. */
BOLIDE_INLINE double pull_of(struct muscl_kind kind, const double *record, int step)
{
    if (!kind.shear)
        return maximum(0.0, record[record_stress(kind.dimension) * step]);
    return sym3_trace(stress_from(kind.dimension, record + muscl_pull(kind) * step, step));
}

/* The distance of a pair along E. A record that only fills up lanes may lie at the particle. */
BOLIDE_INLINE double distance_of(struct vec3 x, struct vec3 e)
{
    const double tiny = 1e-40;
    return maximum(vec3_dot(x, e), tiny);
}

/* The closure force of lane K. In tension the areas around a particle that is beside its place push
 * it further away, for they do not add up to zero. Two particles are pulled towards where their
 * areas would, in proportion to their mean tension, and with opposite forces: two of one material,
 * for what tears at a light neighbour of another would throw it away. */
BOLIDE_INLINE void add_pull(struct muscl_kind kind, const double *own, const struct lanes *lanes,
                            const struct pairs *pairs, double (*sums)[LANES], int k)
{
    const int dimension = kind.dimension, closure = muscl_closure(kind), pull = muscl_pull(kind);
    const struct layout at = layout_of(kind);
    const struct vec3 x = vector_from(dimension, &pairs->x[0][k], LANES);
    const struct vec3 e = vector_from(dimension, &pairs->e[0][k], LANES);
    const struct vec3 w = vector_from(dimension, &pairs->moves[0][k], LANES);
    const struct vec3 apart = vec3_sub(vector_from(dimension, own + closure, 1),
                                       vector_from(dimension, &lanes->field[closure][k], LANES));
    const int m = muscl_material(kind);
    const bool same = muscl_index(own[m]) == muscl_index(lanes->field[m][k]);
    double scale = same ? -0.25 * pairs->weight[k] / distance_of(x, e) : 0.0;
    if (kind.depth)
        scale *= 0.5 * (fabs(own[muscl_depth(kind)]) + fabs(lanes->field[muscl_depth(kind)][k]));
    struct vec3 t;
    if (kind.shear) {
        const struct sym3 both = sym3_add(stress_from(dimension, own + pull, 1),
                                          stress_from(dimension, &lanes->field[pull][k], LANES));
        t = vec3_scale(scale, traction_of(dimension, both, apart));
    } else {
        const int s = record_stress(dimension);
        t = vec3_scale(scale * (maximum(0.0, own[s]) + maximum(0.0, lanes->field[s][k])), apart);
    }
    sums[at.power][k] += vec3_dot(t, w);
    add_vector(dimension, sums, at.traction, k, t);
}

/* Adds the closure forces of GROUPS groups if any of their particles pulls. */
BOLIDE_INLINE void add_pulls(struct muscl_kind kind, const double *own, int groups,
                             const struct lanes *lanes, const struct pairs *pairs,
                             double (*sums)[LANES])
{
    double most[LANES] ALIGNED, any = pull_of(kind, own, 1);
    for (int k = 0; k < LANES; k++)
        most[k] = any;
    for (int m = 0; m < groups; m++)
#pragma omp simd simdlen(8)
        for (int k = 0; k < LANES; k++)
            most[k] = maximum(most[k], pull_of(kind, &lanes[m].field[0][k], LANES));
    for (int k = 0; k < LANES; k++)
        any = maximum(any, most[k]);
    if (any > 0.0)
        for (int m = 0; m < groups; m++)
#pragma omp simd simdlen(8)
            for (int k = 0; k < LANES; k++)
                add_pull(kind, own, &lanes[m], &pairs[m], sums, k);
}

#endif
