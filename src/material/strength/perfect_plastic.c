/* What a case says of perfect plasticity; the physics is in perfect_plastic.h. */
#include "material/choices.h"

const char strength_perfect_plastic_name[] = "perfect-plastic";
const char strength_perfect_plastic_help[] = "elastic up to a constant von Mises yield stress";

const struct parameter strength_perfect_plastic_parameters[] = {
    {.key = "shear_modulus",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct strength_perfect_plastic, shear_modulus),
     .unit = "Pa",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "shear modulus"},
    {.key = "yield",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct strength_perfect_plastic, yield),
     .unit = "Pa",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "yield stress in simple tension"},
    PARAMETER_END,
};
