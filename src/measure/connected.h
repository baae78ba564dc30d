/* Which particles are connected: two of one body are where they are nearer than link (D_i + D_j),
 * and, unless `failed` is set, where neither has failed. A connected set may lie on many ranks. */
#ifndef BOLIDE_CONNECTED_H
#define BOLIDE_CONNECTED_H

#include "model/columns.h"
#include "model/simulation.h"

struct connection {
    double link;
    int body;    /* -1: all */
    bool failed; /* failed particles connect too */
};

/* The label of a particle that is left out. */
#define CONNECTED_NONE UINT64_MAX

/* The parameter `link` at OFFSET of a table. */
#define CONNECTED_LINK(at)                                                                      \
    {                                                                                           \
        .key = "link", .kind = PARAMETER_NUMBER, .offset = (at), .standard = "0.8",             \
        .below = INFINITY,                                                                      \
        .help =                                                                                 \
            "distance up to which two particles are connected, over the sum of their diameters" \
    }

/* Whether the members of POPULATION are particles with diameters. */
bool connected_has_diameters(const struct population *population);

/* The diameters of the owned particles, and which of them have failed: their `damage` or
 * `tensile_damage` is 1. In fresh memory; free it. */
struct error *connected_diameters(const struct population *population, double **diameter);
struct error *connected_failures(const struct population *population, bool **failed);

/* Collective: fills LABEL, a number for each owned particle: the lowest id of those that it is
 * connected with, itself included; CONNECTED_NONE for those that CONNECTION leaves out. FAILED may
 * be NULL. The labels do not depend on the order of storage, threads or ranks. */
struct error *connected_find(const struct ranks *ranks, const struct population *population,
                             const double *diameter, const bool *failed,
                             const struct connection *connection, uint64_t *label);

#endif
