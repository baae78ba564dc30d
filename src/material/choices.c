/* The lists of equations of state and strength models; see choices.h. */
#include "material/choices.h"

#define EOS_CHOICE(identifier)                                              \
    [EOS_##identifier] = {eos_##identifier##_name, eos_##identifier##_help, \
                          eos_##identifier##_parameters, sizeof(struct eos_##identifier), NULL},

const struct choice eos_choices[EOS_KINDS] = {EOS_LIST(EOS_CHOICE)};

const struct choice strength_choices[STRENGTH_KINDS] = {
    [STRENGTH_NONE] = {"none", "no shear strength: a fluid", NULL, 0, NULL},
    [STRENGTH_PERFECT_PLASTIC] = {"perfect-plastic",
                                  "elastic up to a constant von Mises yield stress",
                                  strength_perfect_plastic_parameters,
                                  sizeof(struct strength_perfect_plastic), NULL},
};
