/* What the parts of a material give back. */
#ifndef BOLIDE_POINT_H
#define BOLIDE_POINT_H

#include "base/vector.h"

/* Status bits of point physics. */
enum {
    POINT_OUT_OF_RANGE = 1, /* outside the range where the equation of state is defined */
    POINT_NO_SOUND = 2,     /* the square of the sound speed is not positive */
};

struct eos_value {
    double pressure, dp_drho, dp_de;
    unsigned status;
};

#endif
