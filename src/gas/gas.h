/* Gas dynamics on a fixed grid, by sweeps along the axes, one after another. The default is
 * MUSCL-Hancock with HLLC; `method: lax-wendroff` is that of Cui, dissertation (2014), section 2.6,
 * restored. */
#ifndef BOLIDE_GAS_H
#define BOLIDE_GAS_H

#include "model/solver.h"

struct gas_parameters {
    struct one_of method;  /* "gas-method" */
    double courant;        /* NAN: by the method */
    double ambient;        /* Pa, of the air before a blast, for maps; NAN: none */
    int64_t regrid;        /* steps between changes of levels; 0: they stay */
    double cells_to_front; /* that follow waves, from `center` on; NAN: as fine as `resolution` */
    struct vector_value center; /* count 0: the origin */
    bool burnt;                 /* by a coupling: explosives that come into cells have burnt */
};

/* `solver: {gas: {...}}`. */
extern const struct parameter gas_table[];
extern const struct solver_class gas_class;

enum gas_method { GAS_MUSCL_HANCOCK, GAS_LAX_WENDROFF, GAS_METHODS };
extern const struct choice gas_method_choices[GAS_METHODS];

#endif
