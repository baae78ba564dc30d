/* The constants of explosives against each other, and what has no effect; see input_warnings.h. */
#include "run/input_warnings.h"

#include <stdlib.h>

#include "base/memory.h"
#include "exact/detonation.h"
#include "material/any.h"
#include "material/material.h"
#include "model/effect.h"
#include "model/loads.h"

/* Measured pressures of Chapman and Jouguet scatter by about a tenth. */
static const double PRESSURE_TOLERANCE = 0.2;

/* The pressure of products in the volume of the explosive. */
static double closed_pressure(const struct material *material)
{
    struct point rest = {.density = material_density(material)};
    rest.history[HISTORY_burnt] = 1.0;
    any_material_evaluate(material, &rest);
    return rest.pressure;
}

char *detonation_wrong(const struct material *material)
{
    struct detonation d;
    const bool lit = material_is_lit(material), gas = eos_traits(&material->eos).gas;
    const double given = lit ? material_detonation_speed(material) : NAN,
                 pressure = burn_traits(&material->burn).pressure;
    if (!lit && (material_burns(material) || !gas || closed_pressure(material) == 0.0))
        return NULL;
    if (!gas)
        return text_copy("its products hold together instead of expanding like a gas: a JWL set of "
                         "products has no negative constants");
    if (!detonation_solve(material, material_density(material), &d))
        return text_copy("its products have no state of Chapman and Jouguet, so that no detonation "
                         "is steady: look at the signs and the order of their constants (JWL: "
                         "a > b > 0, r1 > r2) and at their energy");
    if (fabs(given / d.speed - 1.0) > DETONATION_SPEED_TOLERANCE)
        return text_format("the detonation speed of %.6g m/s that it gives is %.3g %% %s than that "
                           "of its products, %.6g m/s",
                           round(given), 100.0 * fabs(given / d.speed - 1.0),
                           given > d.speed ? "more" : "less", round(d.speed));
    if (fabs(pressure / d.cj.pressure - 1.0) > PRESSURE_TOLERANCE)
        return text_format("the Chapman-Jouguet pressure of %.4g Pa that it gives is not that of "
                           "its products, %.4g Pa",
                           pressure, d.cj.pressure);
    return NULL;
}

struct error *input_warnings(const struct simulation_case *input)
{
    struct error *warnings = NULL;
    for (int i = 0; i < input->materials.count; i++) {
        char *text = detonation_wrong(case_material(input, i)->material);
        char path[256];
        snprintf(path, sizeof path, "materials.%s", input->materials.names[i]);
        if (text)
            warnings = error_join(warnings, document_error(input->document, path, "%s", text));
        free(text);
    }
    return error_join(error_join(warnings, effect_warnings(input)), load_warnings(input));
}
