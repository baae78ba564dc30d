#include "exact/material_curves.h"

#include <math.h>

/* What HISTORY a point at rest has. */
static const double none[POINT_HISTORY] = {0.0};

static struct eos_value pressure_of(const struct material *material, double density, double energy)
{
    return eos_evaluate(&material->eos, density, energy, none);
}

static struct curve_state state_of(const struct material *material, double density, double energy)
{
    const struct eos_value value = pressure_of(material, density, energy);
    const struct response r = material_response(&value, density, 0.0, 0.0);
    const bool warm = !heat_wrong(&material->heat, &material->eos);
    return (struct curve_state){
        .density = density,
        .pressure = value.pressure,
        .energy = energy,
        .temperature =
            warm ? heat_temperature(&material->heat, &material->eos, density, energy) : NAN,
        .sound = r.sound_long,
        .shock = NAN,
        .particle = NAN};
}

bool curve_rest(const struct material *material, struct curve_state *rest)
{
    const double atmosphere = 101325.0, density = material_density(material);
    const struct eos_value value = pressure_of(material, density, 0.0);
    double energy = 0.0;
    if (value.pressure == 0.0 && !(value.dp_drho > 0.0) && value.dp_de > 0.0)
        energy = atmosphere / value.dp_de; /* a gas */
    *rest = state_of(material, density, energy);
    return rest->sound > 0.0 && isfinite(rest->pressure);
}

void curve_isentrope(const struct material *material, const double *densities, int count,
                     struct curve_state *states)
{
    struct curve_state at;
    curve_rest(material, &at);
    for (int i = 0; i < count; i++) {
        const double way = log(densities[i] / at.density);
        const int steps = 1 + (int)ceil(1000.0 * fabs(way));
        const double step = way / steps, half = exp(0.5 * step);
        double rho = at.density, energy = at.energy;
        for (int k = 0; k < steps; k++) { /* de/d(ln rho) = p/rho */
            const double middle = rho * half, end = middle * half;
            const double a = pressure_of(material, rho, energy).pressure / rho;
            const double b =
                pressure_of(material, middle, energy + 0.5 * step * a).pressure / middle;
            const double c =
                pressure_of(material, middle, energy + 0.5 * step * b).pressure / middle;
            const double d = pressure_of(material, end, energy + step * c).pressure / end;
            energy += step / 6.0 * (a + 2.0 * (b + c) + d);
            rho = end;
        }
        states[i] = at = state_of(material, densities[i], energy);
    }
}

bool curve_shock(const struct material *material, const struct curve_state *ahead,
                 double density_ahead, double density, struct curve_state *behind)
{
    const double change = 1.0 / density_ahead - 1.0 / density;
    double energy = ahead->energy;
    if (!(change > 0.0))
        return false;
    for (int round = 0; round < 50; round++) { /* Newton's method */
        const struct eos_value value = pressure_of(material, density, energy);
        const double slope = 1.0 - 0.5 * change * value.dp_de;
        const double excess =
            energy - ahead->energy - 0.5 * change * (value.pressure + ahead->pressure);
        if (!(slope > 0.0))
            return false;
        energy -= excess / slope;
        if (fabs(excess) <= 1e-13 * (fabs(energy) + change * fabs(value.pressure)))
            break;
    }
    *behind = state_of(material, density, energy);
    const double rise = behind->pressure - ahead->pressure;
    behind->shock = sqrt(rise / change) / density_ahead;
    behind->particle = sqrt(rise * change);
    return rise > 0.0 && isfinite(rise) && isfinite(energy);
}
