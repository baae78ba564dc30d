/* The options of SPH with elastic-plastic contacts, as a case names them. */
#include "sph/hllc/hllc.h"

const char *const hllc_continuity_names[] = {"volume", "mass", NULL};
const char *const hllc_correction_names[] = {"own", "symmetric", NULL};
static const char *const reconstruction_names[] = {"none", "velocity", "all", NULL};

const struct parameter hllc_table[] = {
    {.key = "reconstruction",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct hllc_options, reconstruction),
     .standard = "none",
     .names = reconstruction_names,
     .help = "what limited gradients extrapolate to the middle of a pair of one material; all: "
             "density, pressure and deviator too, in 1-D only"},
    {.key = "approach_switch",
     .kind = PARAMETER_FLAG,
     .offset = offsetof(struct hllc_options, approach_switch),
     .standard = "yes",
     .help = "whether pairs that separate use means instead of Riemann problems"},
    HLLC_CONTINUITY_ROW(struct hllc_options),
    HLLC_CORRECTION_ROW(struct hllc_options),
    PARAMETER_END};
