/* What the step of velocities does to the energies of particles, in lanes: the work of their
 * stresses, what their nodes take from the motion, and mixing in shocks. For the file that is
 * compiled once an instruction set (transfer_kernel.h). */
#ifndef BOLIDE_MPM_TRANSFER_WORK_H
#define BOLIDE_MPM_TRANSFER_WORK_H

#include "mpm/transfer_faces.h"

/* What the lanes of a chunk are given by mixing in a shock (mixing.c), and by the work of stresses:
 * changes of velocity, and of energy. */
struct given {
    ALIGNED double velocity[3][LANES], energy[LANES];
};

/* Whether any node of a window mixes. */
BOLIDE_INLINE bool window_mixes(struct kind kind, struct window nodes)
{
    bool mixes = false;
    FOR_NODES (kind, a, b, c)
        mixes |= numbers_at(kind, nodes, a, b, c)[NODE_MIXING] > 0.0;
    return mixes;
}

/* Velocities go a fraction of the way to those that the nodes had before the step. Forces work with
 * those of the nodes, which do not know of it: the last term. */
BOLIDE_INLINE void gather_mixed(const struct transfer *t, struct kind kind,
                                const struct chunk *chunk, const double (*weight)[LANES],
                                struct window nodes, double dt, const double (*push)[LANES],
                                struct given *given)
{
    ALIGNED double velocity[3][LANES];
    for (int k = 0; k < kind.dimension; k++)
        FOR_LANES (kind, lane)
            velocity[k][lane] = t->velocity[chunk->index[lane]][k];
    FOR_NODES (kind, a, b, c) {
        const double *node = numbers_at(kind, nodes, a, b, c);
        for (int k = 0; k < kind.dimension && node[NODE_MIXING] > 0.0; k++) {
            const double before = node[NODE_VELOCITY + k] - dt * node[NODE_ACCELERATION + k];
            FOR_LANES (kind, lane) {
                const double part = (*weight)[lane] * node[NODE_MIXING],
                             off = before - velocity[k][lane];
                given->velocity[k][lane] += part * off;
                given->energy[lane] += part * square(off);
            }
        }
        weight++;
    }
    for (int k = 0; k < kind.dimension; k++)
        FOR_LANES (kind, lane)
            given->energy[lane] -=
                given->velocity[k][lane] * (0.5 * given->velocity[k][lane] + dt * push[k][lane]);
}

/* The radial component of the numbers of nodes, as the hoop strain of the lanes of a chunk sees
 * it. */
BOLIDE_INLINE void gather_around(struct kind kind, const struct chunk *chunk,
                                 struct window velocity, double *sum)
{
    FOR_LANES (kind, lane)
        sum[lane] = 0.0;
    for (int a = 0; a < kind.window; a++)
        for (int b = 0; b < kind.window; b++) {
            const double *node = numbers_at(kind, velocity, a, b, 0);
            FOR_LANES (kind, lane)
                sum[lane] += chunk->around[a][lane] * chunk->value[1][b][lane] * node[0];
        }
}

/* What the pressure that fluids do not push with gives in a step of DT to particle LANE, per mass:
 * as much as its pressure does beyond what pushes. */
BOLIDE_INLINE double work_of_gauge(const struct transfer *t, struct kind kind,
                                   const struct chunk *chunk, int lane, struct window nodes,
                                   double dt)
{
    const int32_t i = chunk->index[lane];
    double grown = 0.0;
    FOR_NODES (kind, a, b, c) {
        const double *node = numbers_at(kind, nodes, a, b, c);
        const struct weight w = weight_of(kind, chunk, lane, a, b, c);
        for (int k = 0; k < kind.dimension; k++) {
            const double change = dt * node[NODE_ACCELERATION + k],
                         mean = dt * (node[NODE_VELOCITY + k] - 0.5 * change);
            grown += w.slope[k] * mean;
            if (k == 0 && kind.dimension == 2 && t->axisymmetric)
                grown +=
                    chunk->around[a][lane] * chunk->value[1][b][lane] * mean / t->position[i][0];
        }
    }
    return -t->gauge[t->material[i]] / t->density[i] * grown;
}

/* The stresses of the lanes of a chunk over density, and what acts around the axis. */
struct lane_stress {
    ALIGNED double of[3][3][LANES], hoop[LANES];
};

BOLIDE_INLINE void load_stress(const struct transfer *t, struct kind kind,
                               const struct chunk *chunk, struct lane_stress *stress)
{
    FOR_LANES (kind, lane) {
        const int32_t i = chunk->index[lane];
        const double *s = t->deviator[i], p = t->pressure[i] + t->viscosity[i],
                     v = 1.0 / t->density[i];
        stress->of[0][0][lane] = v * (s[0] - p);
        stress->of[1][1][lane] = v * (s[1] - p);
        stress->of[2][2][lane] = v * (s[2] - p);
        stress->of[0][1][lane] = stress->of[1][0][lane] = v * s[3];
        stress->of[1][2][lane] = stress->of[2][1][lane] = v * s[4];
        stress->of[2][0][lane] = stress->of[0][2][lane] = v * s[5];
        stress->hoop[lane] = t->axisymmetric ? v * (s[2] - p) / t->position[i][0] : 0.0;
    }
}

/* sigma : sum W grad N dt / rho of the lanes of a chunk, W = V + dt A/2. */
BOLIDE_INLINE void work_at_nodes(const struct transfer *t, struct kind kind,
                                 const struct chunk *chunk, struct window nodes, double dt,
                                 double *work)
{
    struct lane_stress stress;
    load_stress(t, kind, chunk, &stress);
    FOR_NODES (kind, a, b, c) {
        const double *node = numbers_at(kind, nodes, a, b, c);
        double mean[3] = {0.0};
        for (int k = 0; k < kind.dimension; k++)
            mean[k] = dt * (node[NODE_VELOCITY + k] - 0.5 * dt * node[NODE_ACCELERATION + k]);
        FOR_LANES (kind, lane) {
            const struct weight w = weight_of(kind, chunk, lane, a, b, c);
            double sum = 0.0;
            for (int j = 0; j < kind.dimension; j++) {
                double along = 0.0;
                for (int k = 0; k < kind.dimension; k++)
                    along += stress.of[k][j][lane] * mean[k];
                sum += along * w.slope[j];
            }
            if (kind.dimension == 2 && t->axisymmetric)
                sum +=
                    stress.hoop[lane] * chunk->around[a][lane] * chunk->value[1][b][lane] * mean[0];
            work[lane] += sum;
        }
    }
    for (int lane = 0; lane < chunk->count && t->ambient; lane++)
        t->ambient[chunk->index[lane]] = work_of_gauge(t, kind, chunk, lane, nodes, dt);
}

/* The same by faces; STRETCH has what their stresses work with (bin_stretch). */
BOLIDE_INLINE void work_at_faces(const struct transfer *t, struct kind kind,
                                 const struct chunk *chunk, const double *stretch, size_t base,
                                 double *work)
{
    struct lane_stress stress;
    ALIGNED double sum[3][LANES], grown[LANES] = {0.0};
    load_stress(t, kind, chunk, &stress);
    for (int d = 0; d < kind.dimension; d++) {
        gather_faces(kind, chunk, stretch, base, d, sum);
        FOR_LANES (kind, lane) {
            for (int k = 0; k < kind.dimension; k++)
                work[lane] += stress.of[k][d][lane] * sum[k][lane];
            grown[lane] += sum[d][lane];
        }
    }
    if (kind.dimension == 2 && t->axisymmetric) {
        FOR_LANES (kind, lane)
            sum[0][lane] = 0.0;
        for (int a = 0; a < kind.window; a++)
            for (int b = 0; b < kind.window; b++) {
                const double out =
                    stretch[node_of(kind, base, a, b, 0) * 2 * FACE_STRIDE + FACE_HOOP];
                FOR_LANES (kind, lane)
                    sum[0][lane] += chunk->value[0][a][lane] * chunk->value[1][b][lane] * out;
            }
        FOR_LANES (kind, lane) {
            work[lane] += stress.hoop[lane] * sum[0][lane];
            grown[lane] += sum[0][lane] / t->position[chunk->index[lane]][0];
        }
    }
    for (int lane = 0; lane < chunk->count && t->ambient; lane++) {
        const int32_t i = chunk->index[lane];
        t->ambient[i] = -t->gauge[t->material[i]] / t->density[i] * grown[lane];
    }
}

/* What the lanes of a chunk get in a step of DT per mass: the work of their stresses with the mean
 * velocity of the nodes, W = V + dt A/2, and what the nodes take from the motion: with dv = sum N
 * dt A of the particle,
 *
 *   (1/rho) sigma : sum W grad N dt + (sum N (dt A)^2 - dv^2)/2
 *
 * The second part is never negative. Summed over the particles it is, with the change of their
 * kinetic energy, what other forces than those of stresses do with W. */
BOLIDE_INLINE void gather_work(const struct transfer *t, struct kind kind,
                               const struct chunk *chunk, const double (*weight)[LANES],
                               struct window nodes, const double *stretch, double dt,
                               const double (*push)[LANES], struct given *given)
{
    ALIGNED double work[LANES] = {0.0};
    if (t->by_faces)
        work_at_faces(t, kind, chunk, stretch, nodes.base, work);
    else
        work_at_nodes(t, kind, chunk, nodes, dt, work);
    FOR_NODES (kind, a, b, c) {
        const double *node = numbers_at(kind, nodes, a, b, c);
        double kick = 0.0;
        for (int k = 0; k < kind.dimension; k++)
            kick += 0.5 * square(dt * node[NODE_ACCELERATION + k]);
        FOR_LANES (kind, lane)
            work[lane] += (*weight)[lane] * kick;
        weight++;
    }
    FOR_LANES (kind, lane) {
        double dv2 = 0.0;
        for (int k = 0; k < kind.dimension; k++)
            dv2 += square(dt * push[k][lane]);
        given->energy[lane] += work[lane] - 0.5 * dv2;
    }
}

BOLIDE_INLINE void take_given(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                              const struct given *given)
{
    for (int lane = 0; lane < chunk->count; lane++) {
        t->energy[chunk->index[lane]] += given->energy[lane];
        for (int k = 0; k < kind.dimension; k++)
            t->velocity[chunk->index[lane]][k] += given->velocity[k][lane];
    }
}

#endif
