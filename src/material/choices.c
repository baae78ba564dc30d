/* The lists of equations of state and strength models; see choices.h. */
#include "material/choices.h"

#define EOS_CHOICE(identifier)                                              \
    [EOS_##identifier] = {eos_##identifier##_name, eos_##identifier##_help, \
                          eos_##identifier##_parameters, sizeof(struct eos_##identifier), NULL},

const struct choice eos_choices[EOS_KINDS] = {EOS_LIST(EOS_CHOICE)};

#define STRENGTH_CHOICE(identifier)                                                        \
    [STRENGTH_##identifier] = {strength_##identifier##_name, strength_##identifier##_help, \
                               strength_##identifier##_parameters,                         \
                               sizeof(struct strength_##identifier), NULL},

const struct choice strength_choices[STRENGTH_KINDS] = {
    [STRENGTH_NONE] = {"none", "no shear strength: a fluid", NULL, 0, NULL},
    STRENGTH_LIST(STRENGTH_CHOICE)};
