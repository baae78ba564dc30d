/* A plane steady detonation; see detonation.h. */
#include "exact/detonation.h"

#include "exact/root.h"

/* What a point remembers where BURNT has burnt. */
static void set_burnt(double burnt, double history[POINT_HISTORY])
{
    for (int k = 0; k < POINT_HISTORY; k++)
        history[k] = 0.0;
    history[HISTORY_burnt] = burnt;
}

static struct eos_value pressure_of(const struct material *material, double density, double energy,
                                    double burnt)
{
    double history[POINT_HISTORY];
    set_burnt(burnt, history);
    return eos_evaluate(&material->eos, density, energy, history);
}

/* The pressure at which a shock or a front that burns BURNT leaves VOLUME; INFINITY where there is
 * none. */
static double hugoniot(const struct material *material, double ahead, double volume, double burnt)
{
    const double fall = 1.0 / ahead - volume;
    double pressure = 0.0;
    for (int round = 0; round < 50; round++) { /* pressures are nearly linear in energy */
        const struct eos_value value =
            pressure_of(material, 1.0 / volume, 0.5 * pressure * fall, burnt);
        const double slope = 1.0 - 0.5 * value.dp_de * fall;
        if (!(slope > 0.0))
            return INFINITY;
        const double step = (value.pressure - pressure) / slope;
        pressure += step;
        if (!(fabs(step) > 1e-14 * fabs(pressure)))
            break;
    }
    return pressure;
}

double detonation_temperature(const struct material *material, double density, double pressure,
                              double burnt, double explosive)
{
    double history[POINT_HISTORY];
    set_burnt(burnt, history);
    history[HISTORY_explosive_volume] = explosive;
    return eos_phases_temperature(&material->eos, density, pressure, history);
}

static struct detonation_state state_at(const struct material *material, double ahead, double speed,
                                        double volume, double burnt)
{
    const double fall = 1.0 / ahead - volume, density = 1.0 / volume;
    struct detonation_state s;
    s.density = density;
    s.velocity = speed * fall * ahead;
    s.pressure = square(speed * ahead) * fall;
    s.energy = 0.5 * s.pressure * fall;
    s.burnt = burnt;
    const struct eos_value value = pressure_of(material, density, s.energy, burnt);
    s.sound = sqrt(maximum(eos_sound_square(s.pressure, value.dp_drho, value.dp_de, density), 0.0));
    double history[POINT_HISTORY];
    set_burnt(burnt, history);
    if (burn_has_rate(&material->burn))
        (void)material_reaction(material, density, s.energy, history);
    s.temperature = detonation_temperature(material, density, s.pressure, burnt,
                                           history[HISTORY_explosive_volume]);
    return s;
}

/* By how much the square of the mass flow through a front that leaves VOLUME exceeds that of sound
 * behind it. */
static double flow_excess(const struct material *material, double ahead, double volume)
{
    const double pressure = hugoniot(material, ahead, volume, 1.0), fall = 1.0 / ahead - volume;
    if (isinf(pressure))
        return -INFINITY;
    const struct eos_value value = pressure_of(material, 1.0 / volume, 0.5 * pressure * fall, 1.0);
    const double sound = eos_sound_square(pressure, value.dp_drho, value.dp_de, 1.0 / volume);
    return pressure / fall - sound / square(volume);
}

/* By how much the pressure of a shock to VOLUME exceeds that of the Rayleigh line. */
static double shock_excess(const struct material *material, double ahead, double speed,
                           double volume)
{
    return hugoniot(material, ahead, volume, 0.0) - square(speed * ahead) * (1.0 / ahead - volume);
}

static struct detonation_state spike_of(const struct material *material, double ahead, double speed)
{
    const struct detonation_state none = {NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    const double rest = 1.0 / material_density(material), first = minimum(rest, 1.0 / ahead);
    double high = first * (1.0 - 1e-4), low = high;
    if (!burn_is_kinetic(&material->burn))
        return none;
    while (shock_excess(material, ahead, speed, low) < 0.0) {
        high = low;
        low -= 0.005 * first;
        if (low < 0.1 * first)
            return none;
    }
    for (double middle = 0.5 * (low + high); middle != low && middle != high;
         middle = 0.5 * (low + high))
        *(shock_excess(material, ahead, speed, middle) < 0.0 ? &high : &low) = middle;
    return high < first * (1.0 - 1e-4) ? state_at(material, ahead, speed, high, 0.0) : none;
}

bool detonation_solve(const struct material *material, double ahead, struct detonation *detonation)
{
    const double start = 1.0 / ahead, rest = material_density(material);
    const struct eos_value closed = pressure_of(material, rest, 0.0, 1.0);
    if (!(closed.pressure > 1e-3 * rest * fabs(closed.dp_drho)))
        return false;
    double high = start * (1.0 - 1e-6), low = high;
    if (!(flow_excess(material, ahead, high) > 0.0))
        return false;
    while (flow_excess(material, ahead, low) > 0.0) {
        high = low;
        low -= 0.005 * start;
        if (low < 0.1 * start)
            return false;
    }
    for (double middle = 0.5 * (low + high); middle != low && middle != high;
         middle = 0.5 * (low + high))
        *(flow_excess(material, ahead, middle) > 0.0 ? &high : &low) = middle;
    const double pressure = hugoniot(material, ahead, high, 1.0);
    if (!(pressure > 0.0 && isfinite(pressure)))
        return false;
    detonation->ahead = ahead;
    detonation->speed = sqrt(pressure / (start - high)) / ahead;
    detonation->cj = state_at(material, ahead, detonation->speed, high, 1.0);
    detonation->spike = spike_of(material, ahead, detonation->speed);
    return true;
}

struct zone {
    const struct material *material;
    const struct detonation *detonation;
    double burnt;
};

/* By how much the pressure of the Rayleigh line exceeds that of the equation of state, at
 * VOLUME. */
static struct root_value line_excess(const void *context, double volume)
{
    const struct zone *zone = context;
    const double flow = square(zone->detonation->speed * zone->detonation->ahead);
    const double fall = 1.0 / zone->detonation->ahead - volume, line = flow * fall;
    const double density = 1.0 / volume;
    const struct eos_value value =
        pressure_of(zone->material, density, 0.5 * line * fall, zone->burnt);
    const double slope = -value.dp_drho * square(density) - value.dp_de * line;
    return (struct root_value){line - value.pressure, -flow - slope};
}

struct detonation_state detonation_zone(const struct material *material,
                                        const struct detonation *detonation, double burnt,
                                        double *rate)
{
    const struct zone zone = {material, detonation, burnt};
    const double low = 1.0 / detonation->spike.density, high = 1.0 / detonation->cj.density;
    struct detonation_state s =
        burnt >= 1.0 ? detonation->cj
        : burnt <= 0.0
            ? detonation->spike
            : state_at(material, detonation->ahead, detonation->speed,
                       root_find(line_excess, &zone, low, high, low + burnt * (high - low) * 0.5),
                       burnt);
    *rate = NAN;
    if (burn_has_rate(&material->burn)) {
        double history[POINT_HISTORY];
        set_burnt(burnt, history);
        *rate = material_reaction(material, s.density, s.energy, history).rate;
    }
    return s;
}
