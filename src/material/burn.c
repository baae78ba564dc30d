/* What a case says of burning; the physics is in burn.h. */
#include "material/choices.h"

static const struct parameter programmed_parameters[] = {
    {.key = "speed",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct burn_programmed, speed),
     .unit = "m/s",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "D: speed of the detonation"},
    PARAMETER_END,
};

static const struct parameter beta_parameters[] = {
    {.key = "speed",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct burn_beta, speed),
     .unit = "m/s",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "D: speed of the detonation"},
    {.key = "pressure",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct burn_beta, pressure),
     .unit = "Pa",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "p_CJ: pressure behind the front (Chapman and Jouguet's)"},
    PARAMETER_END,
};

const struct choice burn_choices[BURN_KINDS] = {
    [BURN_INSTANT] = {"instant", "all has burnt at the start: the artificial detonation", NULL, 0,
                      NULL},
    [BURN_PROGRAMMED] = {"programmed", "it burns when the detonation arrives from where it is lit",
                         programmed_parameters, sizeof(struct burn_programmed), NULL},
    [BURN_BETA] = {"beta", "as programmed, or sooner where it is compressed", beta_parameters,
                   sizeof(struct burn_beta), NULL},
};
