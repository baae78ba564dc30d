/* What a case may name for a material: the equations of state, strength, failure and burn models,
 * each with its parameter table. The index in an array is the enum of the model, so that a choice
 * read from a case becomes plain data by a copy. */
#ifndef BOLIDE_CHOICES_H
#define BOLIDE_CHOICES_H

#include "base/parameter.h"
#include "material/burn.h"
#include "material/eos.h"
#include "material/failure.h"
#include "material/strength.h"

#define EOS_TABLE(identifier) extern const struct parameter eos_##identifier##_parameters[];
EOS_LIST(EOS_TABLE)
#undef EOS_TABLE

/* By enum eos_kind, strength_kind, failure_kind and burn_kind. */
extern const struct choice eos_choices[EOS_KINDS];
extern const struct choice strength_choices[STRENGTH_KINDS];
extern const struct choice failure_choices[FAILURE_KINDS];
extern const struct choice burn_choices[BURN_KINDS];

#endif
