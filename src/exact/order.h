/* What results on finer and finer resolutions tell about their error: the order of accuracy, the
 * value that they tend to (Richardson's extrapolation) and how far off the finest may be (Roache's
 * grid convergence index; P. J. Roache, J. Fluids Eng. 116 (1994) 405; I. B. Celik et al., J.
 * Fluids Eng. 130 (2008) 078001). */
#ifndef BOLIDE_EXACT_ORDER_H
#define BOLIDE_EXACT_ORDER_H

/* The order p for which errors grow as SPACING^p between a coarse run and a finer one; NAN where an
 * error is not positive. */
double order_between(double coarse_spacing, double coarse_error, double fine_spacing,
                     double fine_error);

/* The same as the line of least squares of log ERROR over log SPACING through all COUNT runs. Those
 * whose error is not positive are left out; NAN where fewer than two remain. */
double order_fitted(const double *spacing, const double *error, int count);

/* How three results follow one another. */
enum approach {
    APPROACH_UNKNOWN,     /* one of them is no number */
    APPROACH_SETTLED,     /* they are the same */
    APPROACH_MONOTONE,    /* they tend to a value */
    APPROACH_OSCILLATING, /* the second change goes back */
    APPROACH_DIVERGING,   /* the second change is as large as the first allows, or larger */
};

struct extrapolation {
    enum approach approach;
    double order; /* p of value(h) = limit + C h^p; NAN unless MONOTONE */
    double limit; /* the value at no spacing; NAN unless MONOTONE or SETTLED */
    /* the grid convergence index, in the unit of the value: 1.25 |limit - value of the finest| */
    double index;
};

/* Extrapolates the VALUES of three runs, the coarsest first; each SPACING is below the one
 * before. */
struct extrapolation extrapolate(const double spacing[3], const double value[3]);

/* "monotone" */
const char *approach_name(enum approach approach);

#endif
