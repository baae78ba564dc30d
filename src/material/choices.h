/* What a case may name for a material: the equations of state, strength and burn models, each with its
 * parameter table. The index in an array is the enum of the model, so that a choice read from a case
 * becomes plain data by a copy. */
#ifndef BOLIDE_CHOICES_H
#define BOLIDE_CHOICES_H

#include "base/parameter.h"
#include "material/burn.h"
#include "material/eos.h"
#include "material/strength.h"

/* An equation of state's table file (eos/<identifier>.c) defines its name in a case, one line of help
 * and the parameters of its struct. */
#define EOS_TABLE(identifier)                    \
    extern const char eos_##identifier##_name[]; \
    extern const char eos_##identifier##_help[]; \
    extern const struct parameter eos_##identifier##_parameters[];
EOS_LIST(EOS_TABLE)
#undef EOS_TABLE

/* The same of a strength model in strength/<identifier>.c. */
#define STRENGTH_TABLE(identifier)                    \
    extern const char strength_##identifier##_name[]; \
    extern const char strength_##identifier##_help[]; \
    extern const struct parameter strength_##identifier##_parameters[];
STRENGTH_LIST(STRENGTH_TABLE)
#undef STRENGTH_TABLE

/* By enum eos_kind, strength_kind and burn_kind. */
extern const struct choice eos_choices[EOS_KINDS];
extern const struct choice strength_choices[STRENGTH_KINDS];
extern const struct choice burn_choices[BURN_KINDS];

#endif
