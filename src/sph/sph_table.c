/* The parameters of the SPH solver, as a case names them. */

#include "sph/sph_internal.h"

static const char *const method_names[] = {"contact", "standard", "muscl",
                                           "hllc",    "monaghan", NULL};
static const char *const contact_names[] = {"acoustic", "dukowicz", "exact-gas", NULL};
static const char *const energy_names[] = {"total", "internal", NULL};
static const char *const motion_names[] = {"particle", "contact", "none", NULL};
static const char *const rotation_names[] = {"faithful", "corrected", NULL};
static const char *const conduction_names[] = {"none", "contact", "harmonic", NULL};
static const char *const continuity_names[] = {"volume", "mass", NULL};
static const char *const correction_names[] = {"own", "symmetric", NULL};
static const char *const reconstruction_names[] = {"none", "velocity", "all", NULL};
static const char *const pair_stress_names[] = {"squares", "product", NULL};

const struct parameter sph_table[] = {
    {.key = "method",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph_parameters, method),
     .standard = "muscl",
     .names = method_names,
     .help =
         "muscl: Riemann problems between particles, second order; contact: the same, first order; "
         "standard: with artificial viscosity; hllc: elastic-plastic Riemann problems and "
         "corrected gradients; monaghan: corrected gradients with artificial viscosity"},
    {.key = "contact",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph_parameters, contact),
     .standard = PARAMETER_OPTIONAL,
     .names = contact_names,
     .help = "contact problem along a pair of `method: contact`: acoustic, when not given; "
             "dukowicz: two "
             "shocks; exact-gas: ideal gases"},
    {.key = "smoothing",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, smoothing),
     .standard = PARAMETER_OPTIONAL,
     .above = 0.5,
     .below = 3.0,
     .closed = true,
     .help = "alpha of h = alpha (D_i + D_j)/2; the support of a pair is 2h; when not given 1.2 "
             "for hllc and monaghan, else 1"},
    {.key = "courant",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, courant),
     .standard = PARAMETER_OPTIONAL,
     .above = 0.0,
     .below = 1.0,
     .help =
         "K of dt = min K D/sqrt(C^2 + (4 D div U)^2), 0.4 when not given, at most 0.45 for muscl, "
         "for contact stable up to 0.8 with smoothing 1; of dt = min K h/C, 0.3, for hllc and "
         "monaghan"},
    {.key = "energy",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph_parameters, energy),
     .standard = "total",
     .names = energy_names,
     .help = "total: conserved to round-off; internal: the rate of internal energy alone"},
    {.key = "motion",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph_parameters, motion),
     .standard = PARAMETER_OPTIONAL,
     .names = motion_names,
     .help =
         "what moves a particle: its own velocity, the kernel mean of its contact velocities, or "
         "nothing: heat flows and that is all; when not given particle, for muscl in one dimension "
         "contact"},
    {.key = "rotation",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph_parameters, rotation),
     .standard = PARAMETER_OPTIONAL,
     .names = rotation_names,
     .help =
         "velocities that meet at a contact of `method: contact`: the particles' own, which "
         "brakes rotation as the source does, when not given; or corrected by their spin to the "
         "contact point"},
    {.key = "viscosity_quadratic",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, viscosity_quadratic),
     .standard = "20",
     .above = 0.0,
     .below = 1e3,
     .closed = true,
     .help = "coefficient of D^2 rho k^2 in the artificial viscosity of the standard method"},
    {.key = "viscosity_linear",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, viscosity_linear),
     .standard = "0.5",
     .above = 0.0,
     .below = 1e3,
     .closed = true,
     .help = "coefficient of D rho C k in the artificial viscosity of the standard method"},
    {.key = "continuity",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph_parameters, continuity),
     .standard = "volume",
     .names = continuity_names,
     .help =
         "density of hllc and monaghan; volume: by rho_i V_j, exact for linear velocities; mass: "
         "by m_j, as printed"},
    {.key = "correction",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph_parameters, correction),
     .standard = "own",
     .names = correction_names,
     .help = "matrix of the gradients in the forces of hllc and monaghan; own: L_i; symmetric: "
             "(L_i + L_j)/2, which conserves"},
    {.key = "approach_switch",
     .kind = PARAMETER_FLAG,
     .offset = offsetof(struct sph_parameters, approach_switch),
     .standard = "yes",
     .help = "whether hllc leaves pairs that part to means"},
    {.key = "reconstruction",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph_parameters, reconstruction),
     .standard = "none",
     .names = reconstruction_names,
     .help = "what hllc carries to the middle of a pair by limited gradients, within a material: "
             "nothing, velocity, or all (one dimension)"},
    {.key = "pair_stress",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph_parameters, pair_stress),
     .standard = "squares",
     .names = pair_stress_names,
     .help = "stress of a pair of monaghan; squares: s_i/rho_i^2 + s_j/rho_j^2; product: (s_i + "
             "s_j)/(rho_i rho_j)"},
    {.key = "viscosity_alpha",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, viscosity_alpha),
     .standard = "1",
     .above = 0.0,
     .below = 1e3,
     .closed = true,
     .help = "linear coefficient of Monaghan's viscosity, method monaghan"},
    {.key = "viscosity_beta",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, viscosity_beta),
     .standard = "1",
     .above = 0.0,
     .below = 1e3,
     .closed = true,
     .help = "quadratic coefficient of Monaghan's viscosity, method monaghan"},
    {.key = "conduction",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct sph_parameters, conduction),
     .standard = "none",
     .names = conduction_names,
     .help =
         "heat conduction; contact: by the contact temperature of a decaying jump; harmonic: by "
         "the harmonic mean of conductivities"},
    {.key = "conduction_limit",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, conduction_limit),
     .standard = PARAMETER_OPTIONAL,
     .above = 0.0,
     .below = 1.0,
     .help = "beta of dt = min beta rho C_V h^2/lambda; when not given 0.15 for harmonic, for "
             "contact 0.35 in one dimension and 0.2 in more"},
    {.key = "skin",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct sph_parameters, skin),
     .standard = "0.3",
     .above = 0.0,
     .below = 1.0,
     .help = "margin of neighbour rows, relative to the support; a matter of speed, not of result"},
    {.key = "rebuild",
     .kind = PARAMETER_INTEGER,
     .offset = offsetof(struct sph_parameters, rebuild),
     .standard = "0",
     .above = 0,
     .below = 1e9,
     .closed = true,
     .help = "build neighbour rows at least every so many steps; 0: when they no longer hold"},
    PARAMETER_END};

struct sph_parameters sph_settled(const struct sph_parameters *parameters)
{
    struct sph_parameters settled = *parameters;
    bool corrected = settled.method == SPH_HLLC || settled.method == SPH_MONAGHAN;
    if (isnan(settled.smoothing))
        settled.smoothing = corrected ? 1.2 : 1.0;
    if (isnan(settled.courant))
        settled.courant = corrected ? 0.3 : 0.4;
    return settled;
}

double sph_near_skin(const struct sph_parameters *settled, int dimension)
{
    const double share = 0.3; /* a smaller one leaves less to walk, and must be found more often */
    bool heun = settled->method == SPH_HLLC || settled->method == SPH_MONAGHAN;
    return dimension > 1 && !heun && settled->motion != SPH_MOTION_NONE ? share * settled->skin
                                                                        : 0.0;
}
