/* Of several parts of a material at once, when it is loaded: constants of one that follow from
 * another, and whether the parts go together. */
#ifndef BOLIDE_WHOLE_H
#define BOLIDE_WHOLE_H

#include "material/material.h"

/* Takes the constants of strength that follow from the equation of state and from failure. */
BOLIDE_INLINE void material_complete(struct material *material)
{
    const double none[POINT_HISTORY] = {0.0}, density = material_density(material);
    const struct eos_value rest = eos_evaluate(&material->eos, density, 0.0, none);
    strength_take(&material->strength, density, &rest);
    strength_weaken(&material->strength, failure_traits(&material->failure).weakening);
    material->melting = melting_of(&material->eos, &material->strength);
}

/* The elastic limit in uniaxial strain at RATE, 1/s, that follows from the constants of a strength
 * with a given limit, Pa; NAN: it has none. */
BOLIDE_INLINE double material_elastic_limit(const struct material *material, double rate)
{
    const double none[POINT_HISTORY] = {0.0}, density = material_density(material);
    double low = 0.0, high = 0.3; /* rho/rho_0 - 1 */
    if (isnan(strength_given_limit(&material->strength)))
        return NAN;
    for (int k = 0; k < 60; k++) {
        const double mu = 0.5 * (low + high);
        const double pressure =
            eos_evaluate(&material->eos, density * (1.0 + mu), 0.0, none).pressure;
        if (strength_bears(&material->strength, mu, pressure, rate))
            low = mu;
        else
            high = mu;
    }
    return eos_evaluate(&material->eos, density * (1.0 + low), 0.0, none).pressure +
           4.0 / 3.0 * strength_shear_modulus(&material->strength) * logarithm(1.0 + low);
}

/* Why strength and failure do not go together; NULL when they do. */
BOLIDE_INLINE const char *material_failure_wrong(const struct material *material)
{
    if (!material_fails(material))
        return NULL;
    const struct failure_traits failure = failure_traits(&material->failure);
    const bool of_fluids = failure.of_fluids;
    if (of_fluids && material_has_strength(material))
        return "only a liquid cavitates, and this material has strength: give `spall`";
    if (!of_fluids && !material_has_strength(material))
        return "only a material with strength fails; a liquid has `cavitation`, a gas `failure: "
               "none`";
    if (strength_takes_pressure(&material->strength))
        return "this strength model has a failure of its own";
    if (failure.weakening > 0.0 && !strength_traits(&material->strength).weakened)
        return "`coupling` weakens `strength: johnson-cook`, and no other";
    return NULL;
}

/* Why equation of state and burning do not go together; NULL when they do. */
BOLIDE_INLINE const char *material_burn_wrong(const struct material *material)
{
    const unsigned history = eos_history(&material->eos);
    const bool phases = history & HISTORY_BIT(explosive_volume),
               both = history & HISTORY_BIT(burnt);
    if (both && !burn_is_kinetic(&material->burn))
        return phases ? "`eos: reactive-jwl` needs `burn: ignition-growth` or `pressure-power`, "
                        "which tells how much has burnt"
                      : "`eos: blended-jwl` needs `burn: cj-threshold` or `pressure-power`, which "
                        "tells how much has burnt";
    if (burn_traits(&material->burn).phases && !phases)
        return "ignition-growth needs an equation of state of explosive and products: "
               "`eos: reactive-jwl`";
    if (!both && burn_is_kinetic(&material->burn))
        return "this burning needs an equation of state of explosive and products: "
               "`eos: blended-jwl`";
    return NULL;
}

#endif
