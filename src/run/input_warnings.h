/* What of a case has no effect or contradicts itself: the same words for every solver. */
#ifndef BOLIDE_INPUT_WARNINGS_H
#define BOLIDE_INPUT_WARNINGS_H

#include "case/case.h"

/* Ignitions that light nothing, and explosives whose constants do not fit each other. NULL, or
 * messages, each located as an error would be. */
struct error *input_warnings(const struct simulation_case *input);

/* Where the constants of an explosive contradict each other, as a detonation speed that is not that
 * of the products: a sentence (to be freed), else NULL. */
char *detonation_wrong(const struct material *material);

#endif
