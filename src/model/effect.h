/* What of a case has no effect, as far as its text tells. */
#ifndef BOLIDE_EFFECT_H
#define BOLIDE_EFFECT_H

#include "case/case.h"

/* Ignitions outside every explosive, or too late for the run. NULL, or messages, each located as an
 * error would be. */
struct error *effect_warnings(const struct simulation_case *input);

#endif
