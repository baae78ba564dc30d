/* The parameters that all SPH schemes share, as a case names them. */
#include "sph/scheme.h"

const char *const sph_motion_names[] = {"particle", "contact", "none", NULL};
const char *const sph_energy_names[] = {"total", "internal", NULL};
static const char *const conduction_names[] = {"none", "contact", "harmonic", NULL};

const struct parameter sph_table[] = {
    {.key = "method",
     .kind = PARAMETER_ONE_OF,
     .offset = offsetof(struct sph_parameters, method),
     .standard = "muscl",
     .kind_of_thing = "scheme",
     .help = "the SPH scheme: its name, or {NAME: {options}}"},
    {.key = "smoothing",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, smoothing),
     .standard = PARAMETER_OPTIONAL,
     .above = 0.5,
     .below = 3.0,
     .closed = true,
     .help = "alpha of h = alpha (D_i + D_j)/2; the support of a pair is 2h; default: 1.2 for "
             "muscl in 2-D and 3-D, hllc and monaghan, else 1"},
    {.key = "courant",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, courant),
     .standard = PARAMETER_OPTIONAL,
     .above = 1e-6, /* a smaller step adds less than rounding takes, and no run of it ends */
     .below = 1.0,
     .help = "Courant number K; contact, standard and muscl: dt = min K D/sqrt(C^2 + (4 D div "
             "U)^2); contact is stable up to 0.8 with smoothing 1, muscl up to 0.45; hllc and "
             "monaghan: dt = min K h/C; default: 0.4, for hllc and monaghan 0.3"},
    {.key = "conduction",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph_parameters, conduction),
     .standard = "none",
     .names = conduction_names,
     .help = "heat conduction, for contact, standard and muscl; contact: with the contact "
             "temperature of two half-spaces; harmonic: with the harmonic mean of conductivities"},
    {.key = "conduction_limit",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, conduction_limit),
     .standard = PARAMETER_OPTIONAL,
     .above = 0.0,
     .below = 1.0,
     .help = "beta of dt = min beta rho C_V h^2/lambda; default: 0.15 for harmonic, for contact "
             "0.35 in 1-D and 0.2 in 2-D and 3-D"},
    {.key = "skin",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, skin),
     .standard = "0.3",
     .above = 0.0,
     .below = 1.0,
     .help = "margin of the neighbour lists, relative to the support; it changes the speed, never "
             "the result"},
    {.key = "rebuild",
     .kind = PARAMETER_INTEGER,
     .offset = offsetof(struct sph_parameters, rebuild),
     .standard = "0",
     .above = 0,
     .below = 1e9,
     .closed = true,
     .help = "rebuild the neighbour lists at least every so many steps; 0: only when they expire"},
    PARAMETER_END};
