/* The options of first-order contact SPH, as a case names them. */
#include "sph/contact/contact.h"

static const char *const riemann_names[] = {"acoustic", "dukowicz", "exact-gas", NULL};
static const char *const rotation_names[] = {"faithful", "corrected", NULL};

const struct parameter contact_table[] = {
    PARAMETER(CHOICE, struct contact_options, riemann, "acoustic",
              "Riemann solver along a pair; acoustic: weak waves; dukowicz: two shocks; exact-gas: "
              "ideal gases, by iteration",
              .names = riemann_names),
    PARAMETER(
        CHOICE, struct contact_options, rotation, "faithful",
        "velocities in the Riemann problem; faithful: those of the particles, which slows rotation "
        "as in the source; corrected: extrapolated to the contact point with their spin",
        .names = rotation_names),
    SPH_MOTION_ROW(struct contact_options), SPH_ENERGY_ROW(struct contact_options), PARAMETER_END};
