/* The state of a body at the start: two of density, pressure and energy are free, the equation of state
 * gives the third. */
#include "model/case_internal.h"

static double pressure_at(const struct eos *eos, double density, double energy, unsigned *status)
{
    const double history[POINT_HISTORY] = {0.0};
    struct eos_value value = eos_evaluate(eos, density, energy, history);
    *status = value.status | (isfinite(value.pressure) ? 0u : POINT_OUT_OF_RANGE);
    return value.pressure;
}

/* The density nearest to the reference density at which ENERGY gives PRESSURE; NAN when there is none
 * between a hundredth and a hundred times that. Steps outwards as long as pressure grows with density,
 * then bisects to the last bit. */
static double density_of_pressure(const struct eos *eos, double pressure, double energy)
{
    static const double step = 1.02, reach = 100.0;
    unsigned status;
    double reference = eos_reference_density(eos);
    double start = pressure_at(eos, reference, energy, &status) - pressure;
    if (start == 0.0 && !status)
        return reference;
    double factor = start < 0.0 ? step : 1.0 / step;
    double near = reference, far = reference, before = start, now = start;
    while ((now < 0.0) == (start < 0.0)) {
        near = far;
        far *= factor;
        before = now;
        now = pressure_at(eos, far, energy, &status) - pressure;
        bool grows = start < 0.0 ? now > before : now < before;
        if (status || !grows || far > reach * reference || far * reach < reference)
            return NAN;
    }
    for (int i = 0; i < 200; i++) {
        double middle = 0.5 * (near + far);
        double value = pressure_at(eos, middle, energy, &status) - pressure;
        if (value == 0.0)
            return middle;
        if ((value < 0.0) == (start < 0.0))
            near = middle;
        else
            far = middle;
    }
    return far;
}

/* The energy at which DENSITY gives PRESSURE, by Newton's method; NAN when there is none. */
static double energy_of_pressure(const struct eos *eos, double pressure, double density)
{
    const double history[POINT_HISTORY] = {0.0};
    double energy = 0.0;
    for (int i = 0; i < 50; i++) {
        struct eos_value value = eos_evaluate(eos, density, energy, history);
        double missing = pressure - value.pressure;
        if (!isfinite(missing / value.dp_de))
            return NAN;
        energy += missing / value.dp_de;
        if (fabs(missing) <= 1e-14 * (fabs(pressure) + fabs(value.dp_de * energy)))
            return energy;
    }
    return NAN;
}

static bool depends_on_energy(const struct eos *eos)
{
    const double history[POINT_HISTORY] = {0.0};
    return eos_evaluate(eos, eos_reference_density(eos), 0.0, history).dp_de != 0.0;
}

/* PRESSURE is given, and perhaps one of density and energy. */
static const char *from_pressure(const struct body_input *body, const struct eos *eos,
                                 struct point *point, const char **key)
{
    *key = "pressure";
    if (!isnan(body->density)) {
        if (!depends_on_energy(eos))
            return "pressure follows from density here, as the equation of state has no energy: "
                   "give "
                   "one of the two";
        point->energy = energy_of_pressure(eos, body->pressure, point->density);
        return isnan(point->energy) ? "no energy gives this pressure at this density" : NULL;
    }
    double density = density_of_pressure(eos, body->pressure, point->energy);
    if (!isnan(density)) {
        point->density = density;
        return NULL;
    }
    if (isnan(body->energy) && depends_on_energy(eos))
        point->energy = energy_of_pressure(eos, body->pressure, point->density);
    else
        point->energy = NAN;
    return isnan(point->energy) ? "the equation of state does not reach this pressure" : NULL;
}

const char *body_start_state(struct body_input *body, const struct material *material,
                             const char **key)
{
    struct point point = {.density = material_density(material)};
    *key = "";
    if (!isnan(body->density))
        point.density = body->density;
    if (!isnan(body->energy))
        point.energy = body->energy;
    if (!isnan(body->pressure)) {
        if (!isnan(body->density) && !isnan(body->energy)) {
            *key = "energy";
            return "of density, pressure and energy two at most can be given";
        }
        const char *wrong = from_pressure(body, &material->eos, &point, key);
        if (wrong)
            return wrong;
    }
    *key = "";
    struct response response = material_evaluate(material, &point);
    if (response.status & POINT_OUT_OF_RANGE || !isfinite(point.pressure))
        return "the state at the start is outside the range of the equation of state";
    if (response.status & POINT_NO_SOUND)
        return isnan(body->pressure) && isnan(body->energy)
                   ? "at this start state sound does not travel: give `pressure` or `energy`"
                   : "at this start state sound does not travel: give a larger `pressure` or "
                     "`energy`";
    body->start = point;
    return NULL;
}
