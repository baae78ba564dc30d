/* Fits through the runs of a sweep: a line or a power law, whose slope, intercept and misfit are
 * checked; and the mean of a value, its deviation and its confidence. */
#ifndef BOLIDE_FITS_H
#define BOLIDE_FITS_H

#include "study/verify.h"

/* Fits what the COUNT runs of the sweep of INPUT measured: RESULTS, owned by the caller, gets an
 * item a fit. A fit through fewer runs than it has constants measures nothing (NAN) and fails. */
struct error *fits_evaluate(const struct simulation_case *input, const struct verify_case *runs,
                            int count, struct check_results *results);

#endif
