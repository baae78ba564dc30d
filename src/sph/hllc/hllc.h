/* SPH with corrected kernel gradients and Heun's step: pairs solve elastic-plastic Riemann problems
 * (`hllc`), or have artificial viscosity (`monaghan`, ../monaghan), which uses the parts below.
 * Source: Wang et al., Explosion and Shock Waves 44 (2024) 081431, section 2. Private to SPH. */
#ifndef BOLIDE_SPH_HLLC_H
#define BOLIDE_SPH_HLLC_H

#include "sph/hllc/kernel.h"
#include "sph/scheme.h"

enum hllc_continuity { HLLC_CONTINUITY_VOLUME, HLLC_CONTINUITY_MASS };
enum hllc_correction { HLLC_CORRECTION_OWN, HLLC_CORRECTION_SYMMETRIC };
enum hllc_reconstruction {
    HLLC_RECONSTRUCTION_NONE,
    HLLC_RECONSTRUCTION_VELOCITY,
    HLLC_RECONSTRUCTION_ALL
};

struct hllc_options {
    int continuity, correction, reconstruction;
    bool approach_switch;
};

/* Rows of both schemes. */
extern const char *const hllc_continuity_names[], *const hllc_correction_names[];
#define HLLC_CONTINUITY_ROW(type)                                                                \
    {                                                                                            \
        .key = "continuity", .kind = PARAMETER_CHOICE, .offset = offsetof(type, continuity),     \
        .standard = "volume", .names = hllc_continuity_names,                                    \
        .help =                                                                                  \
            "rate of density; volume: by rho_i V_j, exact for linear velocities; mass: by m_j, " \
            "as in the source"                                                                   \
    }
#define HLLC_CORRECTION_ROW(type)                                                             \
    {                                                                                         \
        .key = "correction", .kind = PARAMETER_CHOICE, .offset = offsetof(type, correction),  \
        .standard = "own", .names = hllc_correction_names,                                    \
        .help = "matrix of the gradients in the forces; own: L_i; symmetric: (L_i + L_j)/2, " \
                "which conserves momentum"                                                    \
    }

/* The state of both schemes. */
struct hllc_state {
    struct hllc_kind kind;
    struct hllc_selection selection;
    bool by_mass; /* continuity by m_j */
};

/* What moves a particle from level to level. */
struct hllc_derivative {
    double density, acceleration[3], power, strain_rate[6], spin[3];
};

/* A particle at level n, kept while the first stage of a step stands in the store. */
struct hllc_level {
    double density, energy, position[3], velocity[3], deviator[6], plastic_strain;
    struct hllc_derivative rate;
};

/* The fields of the schemes. Diameters are those of the start: h is constant. */
struct hllc_own_fields {
    double (*correction)[6];
    double (*slopes)[3]; /* NULL unless all is reconstructed */
    double *dp_drho, *dp_de;
    struct hllc_level *level;
    double (*level_history)[POINT_HISTORY]; /* with it; NULL where the plastic strain is all */
};
struct hllc_fields {
    struct sph_fields sph;
    struct hllc_own_fields own;
};

/* As in solver_class, with `correction`. */
const char *hllc_energy_lost_by(int correction);

extern const struct parameter hllc_table[];
extern const struct sph_scheme hllc_scheme;

extern const struct field_row hllc_rows[];
struct hllc_fields hllc_fields_of(const struct sph *sph, const struct simulation *simulation);

/* What neither scheme can do, then the kind of pair loop. */
struct error *hllc_choose_kind(struct sph *sph, const struct simulation *simulation, bool viscous,
                               bool reconstructed);

/* record.c. Records of the first pass, for gradients, or of the second, for FORCES. */
struct sph_records hllc_records(const struct sph *sph, bool forces);
void hllc_pack(struct sph *sph, const struct simulation *simulation, const struct hllc_fields *f,
               bool forces);

/* scheme.c. Collective: all rates of the state as it stands; lists must hold. */
void hllc_find_rates(struct sph *sph, struct simulation *simulation, const struct hllc_fields *f);

/* Members of struct sph_scheme. */
void hllc_start(const struct sph *sph, struct simulation *simulation);
void hllc_prepare(struct sph *sph, struct simulation *simulation, struct limit *limit);
struct error *hllc_advance(struct sph *sph, struct simulation *simulation, double dt);

#endif
