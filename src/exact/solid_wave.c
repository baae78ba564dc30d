/* Jumps and fans in a solid; see solid_wave.h. Behind a jump, dv = V_base - V (Rankine-Hugoniot),
 *   e = e_base + (P_base + P) dv/2,   P = p(1/V, e) - S,
 * and in a fan de/dx = -P V, du/dx = -C with the speed of sound along the curve,
 *   C^2 = (dp/drho)_e + (dp/de)_rho P/rho^2 + shear/rho (6), with P in place of p as S works
 * too. */
#include "exact/solid_wave.h"

#include "exact/root.h"

static struct eos_value value_at(const struct solid_base *base, double volume, double energy)
{
    static const double fresh[POINT_HISTORY] = {0.0};
    return eos_evaluate(base->eos, 1.0 / volume, energy, fresh);
}

/* A place at STRAIN without its state. */
static struct solid_place place_at(const struct solid_base *base, double strain)
{
    struct solid_place place = {.strain = strain, .volume = base->volume * exp(strain)};
    place.deviator = base->deviator + base->shear * strain;
    place.energy = base->energy;
    return place;
}

/* Sound speed along the curve, squared. */
static double sound2_at(const struct solid_base *base, const struct eos_value *value, double normal,
                        double volume)
{
    return value->dp_drho + value->dp_de * normal * square(volume) + base->shear * volume;
}

static bool is_fine(const struct eos_value *value)
{
    return value->status == 0 && isfinite(value->pressure);
}

/* Below this strain a chord is the mean of the slopes at its ends: closer than its own
 * difference. */
static const double short_strain = 1e-5;

static double chord_of(const struct solid_base *base, const struct solid_place *place,
                       double shrink)
{
    if (base->sudden || fabs(place->strain) > short_strain)
        return (place->normal - base->normal) / shrink;
    struct eos_value value = value_at(base, base->volume, base->energy);
    double start = sound2_at(base, &value, base->normal, base->volume) / square(base->volume);
    return 0.5 * (start + place->stiffness);
}

struct solid_place solid_jump(const struct solid_base *base, double strain)
{
    enum { STEPS = 60 }; /* Newton's: one where pressure is linear in energy */
    struct solid_place place = place_at(base, strain);
    double shrink = -base->volume * expm1(strain), less = 0.0;
    struct eos_value value;
    for (int step = 0; step < STEPS; step++) {
        value = value_at(base, place.volume, place.energy);
        place.normal = value.pressure - place.deviator;
        less = 1.0 - 0.5 * value.dp_de * shrink;
        if (!is_fine(&value) || !(less > 0.0))
            return place;
        double over = place.energy - base->energy - 0.5 * (base->normal + place.normal) * shrink;
        double next = place.energy - over / less;
        if (fabs(next - place.energy) <= 4e-16 * fabs(next))
            break;
        place.energy = next;
    }
    /* dP (1 - p_e dv/2) = [p_rho/V + p_e (P_base + P) V/2 + shear] (-dx) */
    double work = 0.5 * value.dp_de * (base->normal + place.normal);
    double slope = value.dp_drho / square(place.volume) + work + base->shear / place.volume;
    place.stiffness = slope / less;
    place.chord = chord_of(base, &place, shrink);
    place.valid = place.stiffness > 0.0 && (strain == 0.0 || place.chord > 0.0);
    place.push = place.valid ? sqrt(place.chord) * shrink : 0.0;
    return place;
}

/* Rates over strain in a fan: of energy, and of velocity towards the contact, the sound speed. */
struct fan_rate {
    double energy, sound;
};

static struct fan_rate fan_rate(const struct solid_base *base, double strain, double energy)
{
    struct solid_place place = place_at(base, strain);
    struct eos_value value = value_at(base, place.volume, energy);
    double normal = value.pressure - place.deviator;
    double sound2 = sound2_at(base, &value, normal, place.volume);
    return (struct fan_rate){-normal * place.volume, is_fine(&value) ? sqrt(sound2) : NAN};
}

/* Runge and Kutta's fourth-order method; its error is that of the last digits at these steps. */
struct solid_place solid_fan(const struct solid_base *base, double strain)
{
    enum { STEPS_A_UNIT = 128, LEAST_STEPS = 4 };
    struct solid_place place = place_at(base, strain);
    int steps = LEAST_STEPS + (int)(STEPS_A_UNIT * strain);
    double h = strain / steps, half = 0.5 * h;
    for (int step = 0; step < steps && strain > 0.0; step++) {
        double x = step * h, e = place.energy;
        struct fan_rate a = fan_rate(base, x, e);
        struct fan_rate b = fan_rate(base, x + half, e + half * a.energy);
        struct fan_rate c = fan_rate(base, x + half, e + half * b.energy);
        struct fan_rate d = fan_rate(base, x + h, e + h * c.energy);
        place.energy += h / 6.0 * (a.energy + 2.0 * (b.energy + c.energy) + d.energy);
        place.push -= h / 6.0 * (a.sound + 2.0 * (b.sound + c.sound) + d.sound);
    }
    struct eos_value value = value_at(base, place.volume, place.energy);
    place.normal = value.pressure - place.deviator;
    place.stiffness = sound2_at(base, &value, place.normal, place.volume) / square(place.volume);
    place.chord = place.stiffness;
    place.valid = is_fine(&value) && place.stiffness > 0.0 && isfinite(place.push);
    return place;
}

struct target {
    const struct solid_base *base;
    double normal;
};

/* The target less the normal pressure at STRAIN: increasing; endless where the material cannot
 * go. */
static struct root_value excess(const void *context, double strain)
{
    const struct target *target = context;
    bool jump = strain < 0.0 || (strain == 0.0 && target->normal > target->base->normal);
    struct solid_place place =
        jump ? solid_jump(target->base, strain) : solid_fan(target->base, strain);
    if (!place.valid)
        return (struct root_value){jump ? -INFINITY : INFINITY, NAN}; /* no slope: halve */
    return (struct root_value){target->normal - place.normal, place.stiffness * place.volume};
}

/* The first strain, doubled from a hundredth, that takes the base past the target; LIMIT if
 * none. */
static double past(const struct target *target, double limit)
{
    enum { FURTHEST = 20 }; /* in strain: a volume of e^20 or e^-20 of the first */
    double sign = limit > 0.0 ? 1.0 : -1.0, strain = sign * 0.01;
    while (fabs(strain) < minimum(fabs(limit), FURTHEST) &&
           sign * excess(target, strain).value < 0.0)
        strain *= 2.0;
    return fabs(strain) < fabs(limit) ? strain : limit;
}

bool solid_wave_to(const struct solid_base *base, double normal, double limit,
                   struct solid_place *place)
{
    struct target target = {base, normal};
    if (limit == 0.0 || (normal == base->normal && !base->sudden)) {
        *place = solid_jump(base, 0.0);
        return true;
    }
    double end = past(&target, limit), low = minimum(end, 0.0), high = maximum(end, 0.0);
    struct root_value there = excess(&target, end);
    double guess = there.value - (normal - base->normal);
    guess = isfinite(guess) && guess != 0.0 ? end * (base->normal - normal) / guess : 0.5 * end;
    if (!(guess > low && guess < high))
        guess = 0.5 * end;
    double strain = root_find(excess, &target, low, high, guess);
    *place = limit < 0.0 ? solid_jump(base, strain) : solid_fan(base, strain);
    /* A fan of one speed is a jump. */
    if (limit > 0.0) {
        struct solid_place head = solid_fan(base, 0.0);
        if (fabs(place->stiffness - head.stiffness) <= 1e-10 * head.stiffness)
            *place = solid_jump(base, strain);
    }
    double scale = fabs(normal) + fabs(base->normal) + place->stiffness * place->volume;
    return place->valid && fabs(place->normal - normal) <= 1e-9 * scale;
}
