/* Solvers that are made of others. cfdmp: gas on a grid and material points side by side, each in
 * its part of space. afdmp: material points, gas on a grid and material points again, one after
 * another. Source: Cui, dissertation (2014), chapters 4 and 3; Cui, Zhang, Zhou, Liu and Zhang,
 * CMES 98 (2014) 565; Cui, Zhang, Sze and Zhou, CMES 92 (2013) 507. */
#ifndef BOLIDE_COUPLE_H
#define BOLIDE_COUPLE_H

#include "gas/gas.h"
#include "mpm/mpm.h"

enum cfdmp_transport { CFDMP_CONSERVATIVE, CFDMP_PRINTED };

/* A box, with the key `region`. */
struct couple_region {
    struct vector_value low, high;
};

struct cfdmp_parameters {
    struct mpm_parameters mpm;   /* first: the class takes functions of mpm */
    struct couple_region region; /* of material points; not given: around the solids */
    int64_t overlap;             /* cells */
    int transport;               /* enum cfdmp_transport */
    double wake;                 /* ratio of pressures */
    struct gas_parameters gas;
};
static_assert(offsetof(struct cfdmp_parameters, mpm) == 0, "mpm reads its own there");

/* `solver: {cfdmp: {...}}`. */
extern const struct parameter cfdmp_table[];
extern const struct solver_class cfdmp_class;

enum afdmp_map { AFDMP_CONSERVATIVE, AFDMP_CONSISTENT, AFDMP_TEXT };

struct afdmp_parameters {
    struct mpm_parameters mpm;   /* first, as above */
    struct couple_region region; /* of the solids; not given: around them */
    int map;                     /* enum afdmp_map */
    double wake;                 /* ratio of pressures */
    struct gas_parameters gas;
};
static_assert(offsetof(struct afdmp_parameters, mpm) == 0, "mpm reads its own there");

/* `solver: {afdmp: {...}}`. */
extern const struct parameter afdmp_table[];
extern const struct solver_class afdmp_class;

#endif
