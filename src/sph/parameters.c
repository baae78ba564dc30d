/* The parameters that all SPH schemes share, as a case names them. */
#include "sph/scheme.h"

const char *const sph_motion_names[] = {"particle", "contact", "none", NULL};
const char *const sph_energy_names[] = {"total", "internal", NULL};
static const char *const conduction_names[] = {"none", "contact", "harmonic", NULL};

const struct parameter sph_table[] = {
    PARAMETER(ONE_OF, struct sph_parameters, method, "muscl",
              "the SPH scheme: its name, or {NAME: {options}}", .kind_of_thing = "scheme"),
    PARAMETER(NUMBER, struct sph_parameters, smoothing, OPTIONAL,
              "alpha of h = alpha (D_i + D_j)/2; the support of a pair is 2h; default: 1.2 for "
              "muscl in 2-D and 3-D, hllc and monaghan, else 1",
              .above = 0.5, .below = 3.0, .closed = true),
    PARAMETER(NUMBER, struct sph_parameters, courant, OPTIONAL,
              "Courant number K; contact, standard and muscl: dt = min K D/sqrt(C^2 + (4 D div "
              "U)^2); contact is stable up to 0.8 with smoothing 1, muscl up to 0.45; hllc and "
              "monaghan: dt = min K h/C; default: 0.4, for hllc and monaghan 0.3",
              .above = COURANT_LEAST, .below = 1.0, .change = CHANGE_FROM_HERE),
    PARAMETER(CHOICE, struct sph_parameters, conduction, "none",
              "heat conduction, for contact, standard and muscl; contact: with the contact "
              "temperature of two half-spaces; harmonic: with the harmonic mean of conductivities",
              .names = conduction_names),
    PARAMETER(NUMBER, struct sph_parameters, conduction_limit, OPTIONAL,
              "beta of dt = min beta rho C_V h^2/lambda; default: 0.15 for harmonic, for contact "
              "0.35 in 1-D and 0.2 in 2-D and 3-D",
              .above = 0.0, .below = 1.0),
    PARAMETER(NUMBER, struct sph_parameters, skin, "0.3",
              "margin of the neighbour lists, relative to the support; it changes the speed, never "
              "the result",
              .above = 0.0, .below = 1.0, .change = CHANGE_FREELY),
    PARAMETER(INTEGER, struct sph_parameters, rebuild, "0",
              "rebuild the neighbour lists at least every so many steps; 0: only when they expire",
              .above = 0, .below = 1e9, .closed = true, .change = CHANGE_FREELY),
    PARAMETER_END};
