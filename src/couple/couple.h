/* Solvers that are made of others. cfdmp: gas on a grid and material points side by side, each in
 * its part of space. Source: Cui, dissertation (2014), chapter 4; Cui, Zhang, Zhou, Liu and Zhang,
 * CMES 98 (2014) 565. */
#ifndef BOLIDE_COUPLE_H
#define BOLIDE_COUPLE_H

#include "gas/gas.h"
#include "mpm/mpm.h"

enum cfdmp_transport { CFDMP_CONSERVATIVE, CFDMP_PRINTED };

struct cfdmp_region {
    struct vector_value low, high;
};

struct cfdmp_parameters {
    struct cfdmp_region region; /* of material points; not given: around the solids */
    int64_t overlap;            /* cells */
    int transport;              /* enum cfdmp_transport */
    double wake;                /* ratio of pressures */
    struct mpm_parameters mpm;
    struct gas_parameters gas;
};

/* `solver: {cfdmp: {...}}`. */
extern const struct parameter cfdmp_table[];
extern const struct solver_class cfdmp_class;

#endif
