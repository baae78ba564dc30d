/* The options of second-order contact SPH, as a case names them. */
#include "sph/muscl/muscl.h"

const struct parameter muscl_table[] = {
    {.key = "motion",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct muscl_options, motion),
     .standard = PARAMETER_OPTIONAL,
     .names = sph_motion_names,
     .help = "velocity that moves a particle; particle: its own; contact: the kernel mean of its "
             "contact velocities, in 1-D only; none: particles do not move, only heat is "
             "conducted; default: contact in 1-D, particle in 2-D and 3-D"},
    SPH_ENERGY_ROW(struct muscl_options),
    {.key = "support",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct muscl_options, support),
     .standard = "3",
     .above = 1.0,
     .below = 3.0,
     .closed = true,
     .help = "largest factor by which supports grow in 2-D and 3-D where plastic flow separates "
             "neighbours; 1: no growth"},
    PARAMETER_END};
