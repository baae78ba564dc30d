/* A strong blast in an ideal gas: energy is set free at once on a plane, a line or at a point, and
 * drives a shock into a uniform gas whose own pressure is neglected. Self-similar; Sedov (1946),
 * Landau and Lifshitz, Fluid mechanics, section 106. */
#ifndef BOLIDE_EXACT_SEDOV_H
#define BOLIDE_EXACT_SEDOV_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_sedov {
    int geometry;           /* enum radial_geometry: plane, line, point */
    struct quantity energy; /* J/m^2 on both sides of a plane, J/m of a line, J at a point */
    double density, gamma;
    double age; /* s, since the energy was set free */
};

extern const struct parameter exact_sedov_table[];
extern const struct exact_class exact_sedov_class;

#endif
