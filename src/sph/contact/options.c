/* The options of first-order contact SPH, as a case names them. */
#include "sph/contact/contact.h"

static const char *const riemann_names[] = {"acoustic", "dukowicz", "exact-gas", NULL};
static const char *const rotation_names[] = {"faithful", "corrected", NULL};

const struct parameter contact_table[] = {
    {.key = "riemann",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct contact_options, riemann),
     .standard = "acoustic",
     .names = riemann_names,
     .help = "Riemann solver along a pair; acoustic: weak waves; dukowicz: two shocks; exact-gas: "
             "ideal gases, by iteration"},
    {.key = "rotation",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct contact_options, rotation),
     .standard = "faithful",
     .names = rotation_names,
     .help =
         "velocities in the Riemann problem; faithful: those of the particles, which slows "
         "rotation as in the source; corrected: extrapolated to the contact point with their spin"},
    SPH_MOTION_ROW(struct contact_options),
    SPH_ENERGY_ROW(struct contact_options),
    PARAMETER_END};
