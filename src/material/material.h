/* The physics of one point: a material owns the order of equation of state and strength.
 *
 * Every function here is pure, takes small structs by value or pointer and touches nothing else, so that
 * particle methods, exact solutions, unit tests and a GPU call the same code. SI units throughout;
 * pressure is positive in compression, stress and its deviator in tension: sigma = -p I + S.
 * Source: Parshikov (2013), chapter 1, equation numbers at the functions. */
#ifndef BOLIDE_MATERIAL_H
#define BOLIDE_MATERIAL_H

#include "base/vector.h"
#include "material/eos.h"
#include "material/heat.h"
#include "material/strength.h"

/* What the contact problem and the time step need of a point: longitudinal and shear sound speed (m/s),
 * (dp/drho)_e, (dp/de)_rho, shear modulus and yield stress. */
struct response {
    double dp_drho, dp_de, shear_modulus, yield, sound_long, sound_shear;
    unsigned status;
};

/* A material as plain data, copied by value. */
struct material {
    struct eos eos;
    struct strength strength;
    struct heat heat;
};

/* Reference density of the equation of state, kg/m^3. */
BOLIDE_INLINE double material_density(const struct material *material)
{
    return eos_reference_density(&material->eos);
}

BOLIDE_INLINE bool material_has_strength(const struct material *material)
{
    return material->strength.kind != STRENGTH_NONE;
}

/* Sound speeds of a point from its equation of state and shear modulus:
 * c_b^2 = (dp/drho)_e + (dp/de)_rho p/rho^2,  C_l^2 = c_b^2 + 4G/(3 rho),  C_t^2 = G/rho (1.29), (1.30)
 * with the local bulk modulus in place of a constant one. */
BOLIDE_INLINE struct response material_response(const struct eos_value *eos, double density,
                                                double shear_modulus, double yield)
{
    struct response r;
    double bulk = eos->dp_drho + eos->dp_de * eos->pressure / square(density);
    double shear = shear_modulus / density;
    double longitudinal = bulk + 4.0 / 3.0 * shear;
    r.dp_drho = eos->dp_drho;
    r.dp_de = eos->dp_de;
    r.shear_modulus = shear_modulus;
    r.yield = yield;
    r.sound_long = sqrt(maximum(longitudinal, 0.0));
    r.sound_shear = sqrt(shear);
    r.status = eos->status | (longitudinal > 0.0 ? 0u : POINT_NO_SOUND);
    return r;
}

/* Pressure and response of a point as it stands. */
BOLIDE_INLINE struct response material_evaluate(const struct material *material,
                                                struct point *point)
{
    struct eos_value value =
        eos_evaluate(&material->eos, point->density, point->energy, point->history);
    point->pressure = value.pressure;
    return material_response(&value, point->density, strength_shear_modulus(&material->strength),
                             strength_yield(&material->strength, point));
}

/* Advances a point by one step (section 7.3 of the source, steps 4 to 7): elastic trial deviator, its
 * rotation, plastic return, then pressure from the new density and energy. */
BOLIDE_INLINE struct response material_step(const struct material *material, struct point *point,
                                            const struct motion *motion)
{
    point->density = motion->density;
    point->energy = motion->energy;
    if (material_has_strength(material))
        strength_step(&material->strength, motion, 0.0, point);
    return material_evaluate(material, point);
}

/* The slots of history that it needs beside the plastic strain. */
BOLIDE_INLINE unsigned material_history(const struct material *material)
{
    return strength_history(&material->strength);
}

#endif
