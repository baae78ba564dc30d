/* What a contact solver needs of a material beside its state: the slope of its shock adiabat, or
 * for the exact solver the ratio of its specific heats. */
#include "riemann/bend.h"

#include "sph/sph_internal.h"

struct error *sph_choose_bend(struct sph *sph, const struct simulation *simulation, int m)
{
    const struct material *material = &simulation->material[m];
    const char *name = simulation->input->materials.names[m];
    if (sph->kind.star == STAR_EXACT_GAS) {
        sph->bend[m] = eos_ratio_of_heats(&material->eos);
        if (isnan(sph->bend[m]) || material_has_strength(material))
            return input_error(simulation->input, "solver", "sph.contact",
                               "exact-gas solves contacts of ideal gases, and material \"%s\" is "
                               "none: use acoustic or dukowicz",
                               name);
        return NULL;
    }
    sph->bend[m] = riemann_shock_slope(material);
    if (isnan(sph->bend[m]) && (sph_second_order(sph) || sph->kind.star == STAR_DUKOWICZ))
        return input_error(simulation->input, "materials", name,
                           "its shock adiabat has no slope, since its equation of state has no "
                           "sound at its reference density without energy");
    return NULL;
}
