/* What the measures of broken bodies share: they look at fragments, of which failed particles are
 * no part. */
#ifndef BOLIDE_BROKEN_H
#define BOLIDE_BROKEN_H

#include "measure/connected.h"
#include "measure/fragments.h"
#include "measure/measure.h"

/* Whether the solver has particles that can be connected. */
struct error *broken_check(const struct measurement *measurement);
/* Whether the case has axis ALONG. */
struct error *broken_check_axis(const struct measurement *measurement, int along);
/* Collective: the fragments of the body that the check is `of`, or of all bodies. Free FRAGMENTS
 * also after an error. */
struct error *broken_find(const struct measurement *measurement, double link,
                          struct fragments *fragments);

#endif
