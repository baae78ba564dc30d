/* The axes of the fits of a sweep, so that a run can refuse a fit of the wrong dimension before its
 * first step. The fits themselves are computed from all runs (study/fits.h). */
#ifndef BOLIDE_FIT_AXES_H
#define BOLIDE_FIT_AXES_H

#include "run/checks.h"

/* Compares the dimensions of the fits of INPUT, a run of a sweep with CHECKS. All mistakes come
 * joined in one ERROR_INPUT, located in the case. */
struct error *fits_prepare(const struct simulation_case *input, const struct checks *checks);

/* The swept value called KEY of COUNT; NULL: none. */
const struct sweep_value *fit_swept(const struct sweep_value *values, int count, const char *key);

/* The dimension of what FIT takes, from those of its axes, and the name of that: "slope". */
struct dimension fit_dimension(const struct fit_input *fit, struct dimension x, struct dimension y);
const char *fit_take_name(const struct fit_input *fit);

#endif
