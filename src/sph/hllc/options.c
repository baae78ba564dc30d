/* The options of SPH with elastic-plastic contacts, as a case names them. */
#include "sph/hllc/hllc.h"

const char *const hllc_continuity_names[] = {"volume", "mass", NULL};
const char *const hllc_correction_names[] = {"own", "symmetric", NULL};
static const char *const reconstruction_names[] = {"none", "velocity", "all", NULL};

const struct parameter hllc_table[] = {
    PARAMETER(CHOICE, struct hllc_options, reconstruction, "none",
              "what limited gradients extrapolate to the middle of a pair of one material; all: "
              "density, pressure and deviator too, in 1-D only",
              .names = reconstruction_names),
    PARAMETER(FLAG, struct hllc_options, approach_switch, "yes",
              "whether pairs that separate use means instead of Riemann problems"),
    HLLC_CONTINUITY_ROW(struct hllc_options), HLLC_CORRECTION_ROW(struct hllc_options),
    PARAMETER_END};
