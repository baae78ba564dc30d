/* A slab of explosive that is lit at a rigid wall: Chapman and Jouguet's detonation and the Taylor
 * wave behind it, for products after Jones, Wilkins and Lee. Positions are distances from the
 * wall. */
#ifndef BOLIDE_EXACT_SLAB_DETONATION_H
#define BOLIDE_EXACT_SLAB_DETONATION_H

#include "base/parameter.h"
#include "exact/exact.h"
#include "material/eos/jwl.h"

struct exact_slab_detonation {
    struct eos_jwl jwl;
};

extern const struct parameter exact_slab_detonation_table[];
extern const struct exact_class exact_slab_detonation_class;

#endif
