/* First-order contact SPH: every pair of particles solves a Riemann problem between their states.
 * Source: Parshikov (2013), sections 1.2 to 1.5. The classical scheme (../standard) is the same
 * with means in place of contacts, and uses the parts below. Private to SPH. */
#ifndef BOLIDE_SPH_CONTACT_H
#define BOLIDE_SPH_CONTACT_H

#include "sph/contact/kernel.h"
#include "sph/scheme.h"

enum contact_riemann { CONTACT_ACOUSTIC, CONTACT_DUKOWICZ, CONTACT_EXACT_GAS };
enum contact_rotation { CONTACT_ROTATION_FAITHFUL, CONTACT_ROTATION_CORRECTED };

struct contact_options {
    int riemann, rotation;
    int motion, energy; /* enum sph_motion, enum sph_energy */
};

/* The state of both schemes. */
struct contact_state {
    struct pair_kind kind;
    double shock_slope
        [MATERIALS_MAX]; /* slope of the shock adiabat, or ratio of specific heats, by material */
};

extern const struct parameter contact_table[];
extern const struct sph_scheme contact_scheme;

/* The kind of pair loop for contacts solved by STAR, and the length of its record. */
void contact_choose_kind(struct sph *sph, const struct simulation *simulation, enum pair_star star);

/* The records of all particles. */
struct sph_records contact_records(const struct sph *sph);

/* Collective: records of all particles, with the viscosity as it stands; the pair sums from them.
 */
void contact_pack(struct sph *sph, const struct simulation *simulation,
                  const struct sph_fields *fields);
void contact_sum_pairs(struct sph *sph, struct simulation *simulation,
                       const struct sph_fields *fields);

/* Collective: both, and the step that they allow: members of struct sph_scheme. */
void contact_prepare(struct sph *sph, struct simulation *simulation, struct limit *limit);
size_t contact_stride(const void *options, int dimension);
struct error *contact_advance(struct sph *sph, struct simulation *simulation, double dt);

#endif
