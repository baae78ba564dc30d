/* Two bodies of different temperature that touch at a plane and exchange heat: an infinite rod, or
 * one of two insulated ends. */
#ifndef BOLIDE_EXACT_TEMPERATURE_JUMP_H
#define BOLIDE_EXACT_TEMPERATURE_JUMP_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_heat_body {
    double density, capacity, conductivity, temperature;
};

struct exact_temperature_jump {
    struct exact_heat_body body[2]; /* by enum exact_side */
    double at;
    double from, to; /* insulated ends; NAN: infinite */
};

extern const struct parameter exact_temperature_jump_table[];
extern const struct exact_class exact_temperature_jump_class;

#endif
