/* The options of second-order contact SPH, as a case names them. */
#include "sph/muscl/muscl.h"

const struct parameter muscl_table[] = {
    PARAMETER(CHOICE, struct muscl_options, motion, OPTIONAL,
              "velocity that moves a particle; particle: its own; contact: the kernel mean of its "
              "contact velocities, in 1-D only; none: particles do not move, only heat is "
              "conducted; default: contact in 1-D, particle in 2-D and 3-D",
              .names = sph_motion_names),
    SPH_ENERGY_ROW(struct muscl_options),
    PARAMETER(NUMBER, struct muscl_options, support, "3",
              "largest factor by which supports grow in 2-D and 3-D where plastic flow separates "
              "neighbours; 1: no growth",
              .above = 1.0, .below = 3.0, .closed = true),
    PARAMETER_END};
