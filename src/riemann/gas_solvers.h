/* The Riemann solvers of gas grids, one header each, and the one list of them. To add one: its
 * header, and its line in the list. */
#ifndef BOLIDE_RIEMANN_GAS_SOLVERS_H
#define BOLIDE_RIEMANN_GAS_SOLVERS_H

#include "riemann/gas_hll.h"
#include "riemann/gas_hllc.h"

/* X(identifier): in gas_<identifier>.h gas_riemann_<identifier>(), what flows between a low and a
 * high side, without branches since loops over faces call it, and its help
 * GAS_RIEMANN_<identifier>_HELP. The first is the default. */
#define GAS_RIEMANN_LIST(X) \
    X(hllc)                 \
    X(hll)

#define GAS_RIEMANN_ENUM(name) GAS_RIEMANN_##name,
enum gas_riemann { GAS_RIEMANN_LIST(GAS_RIEMANN_ENUM) GAS_RIEMANN_KINDS };
#undef GAS_RIEMANN_ENUM

/* What flows through one face, by the solver KIND, an enum gas_riemann. */
static inline struct gas_flow gas_riemann_solve(int kind, struct gas_side low, struct gas_side high)
{
    switch (kind) {
#define GAS_RIEMANN_CASE(name) \
    case GAS_RIEMANN_##name:   \
        return gas_riemann_##name(low, high);
        GAS_RIEMANN_LIST(GAS_RIEMANN_CASE)
#undef GAS_RIEMANN_CASE
    default:
        return gas_riemann_hllc(low, high);
    }
}

#endif
