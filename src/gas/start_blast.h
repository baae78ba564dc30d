/* A blast that another case has computed, as start_from.c takes it and start_fill.c hands it to
 * cells. A case of one dimension has shells around its centre, an axisymmetric one rings around its
 * axis. Private to gas/. */
#ifndef BOLIDE_GAS_START_BLAST_H
#define BOLIDE_GAS_START_BLAST_H

#include "gas/gas_internal.h"
#include "model/maps.h"

/* What a cell of the other case has in common with ours, per volume. */
enum { SHELL_FIRST, SHELL_SECOND, SHELL_ENERGY, SHELL_AFTERBURNT, SHELLS };

/* Of the other case: its solver and what its cells hold, radius by radius. */
struct blast {
    const struct simulation_case *input;
    struct ranks ranks; /* this one alone */
    struct simulation simulation;
    struct gas gas;
    bool rings;    /* its cells are rings; else they are shells */
    int count[2];  /* cells along the radius and along the axis, of shells 1 */
    int from[2];   /* the first that the blast has reached along either */
    int last[2];   /* one past the last that it has reached */
    int32_t cells; /* all of them */
    bool *reached; /* each of them */
    double low[2]; /* radius and height of the low faces of the first, m */
    double edge;   /* of a cell, m */
    double *number[SHELLS], *speed[2], *fraction;
    int32_t *cell; /* the index of each in the other case's store */
    int bins, cells_a_bin;
    double *factor[SHELLS]; /* of each bin */
};

/* A mistake in `start`, at KEY. */
struct error *gas_wrong_start(const struct simulation *simulation, const char *key,
                              const char *text);

#endif
