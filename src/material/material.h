/* The physics of one point: a material owns the order of burning, strength, failure and equation of
 * state.
 *
 * Every function here is pure, takes small structs by value or pointer and touches nothing else, so
 * that particle methods, exact solutions, unit tests and a GPU call the same code. SI units
 * throughout; pressure is positive in compression, stress and its deviator in tension: sigma = -p I
 * + S. Source: Parshikov (2013), chapter 1, equation numbers at the functions. */
#ifndef BOLIDE_MATERIAL_H
#define BOLIDE_MATERIAL_H

#include "base/vector.h"
#include "material/burn.h"
#include "material/composition.h"
#include "material/eos.h"
#include "material/failure.h"
#include "material/heat.h"
#include "material/melting.h"

/* A material as plain data, copied by value. */
struct material {
    struct eos eos;
    struct strength strength;
    struct failure failure;
    struct burn burn;
    struct afterburn afterburn;
    struct composition composition;
    struct heat heat;
    struct melting melting; /* follows from the others: material_complete() */
};

/* Reference density of the equation of state, kg/m^3. */
BOLIDE_INLINE double material_density(const struct material *material)
{
    return eos_reference_density(&material->eos);
}

BOLIDE_INLINE bool material_has_strength(const struct material *material)
{
    return strength_is_solid(&material->strength);
}

BOLIDE_INLINE bool material_burns(const struct material *material)
{
    return !burn_is_instant(&material->burn);
}

/* Whether it is a solid or a liquid: neither a gas nor an explosive without strength. */
BOLIDE_INLINE bool material_is_condensed(const struct material *material)
{
    return material_has_strength(material) ||
           !(material_burns(material) || eos_traits(&material->eos).gas);
}

/* Whether it is an explosive that a detonation of the case lights. */
BOLIDE_INLINE bool material_is_lit(const struct material *material)
{
    return material_burns(material) && !burn_is_kinetic(&material->burn);
}

/* The heat that the reaction of an explosive frees, J/kg, by which energies of its products are
 * less than those of the explosive; zero where nothing reacts by a rate or a threshold. */
BOLIDE_INLINE double material_reaction_heat(const struct material *material)
{
    return burn_is_kinetic(&material->burn)
               ? eos_traits(&material->eos).reaction_energy / material_density(material)
               : 0.0;
}

/* The speed of its detonation, m/s; of one that burns by a rate an estimate from its heat, that of
 * products with a ratio of specific heats of 3. Zero where there is none. */
BOLIDE_INLINE double material_detonation_speed(const struct material *material)
{
    if (burn_is_kinetic(&material->burn))
        return 4.0 * sqrt(material_reaction_heat(material));
    return material_burns(material) ? material->burn.of.speed : 0.0;
}

BOLIDE_INLINE bool material_fails(const struct material *material)
{
    return failure_acts(&material->failure);
}

/* Whether it breaks, by a failure model or by the damage of its strength. */
BOLIDE_INLINE bool material_breaks(const struct material *material)
{
    return material_fails(material) || strength_breaks(&material->strength);
}

/* Whether it opens voids where it has broken. */
BOLIDE_INLINE bool material_opens(const struct material *material)
{
    return material_fails(material) ||
           (strength_history(&material->strength) & HISTORY_BIT(void_ratio));
}

/* Whether POINT has failed by the failure model. */
BOLIDE_INLINE bool material_failed(const struct material *material, const double *history)
{
    return material_fails(material) && history[HISTORY_damage] >= 1.0;
}

/* The density that the equation of state is to see: soil that has gained volume by flow and tearing
 * is dense again once that volume is gone. rho_e = rho (1 + dilation). */
BOLIDE_INLINE double material_elastic_share(const struct material *material,
                                            const struct point *point)
{
    return strength_history(&material->strength) & HISTORY_BIT(dilation)
               ? 1.0 + point->history[HISTORY_dilation]
               : 1.0;
}

/* Pressure and its derivatives of a point as it stands. */
BOLIDE_INLINE struct eos_value material_pressure(const struct material *material,
                                                 const struct point *point)
{
    double share = material_elastic_share(material, point);
    struct eos_value value =
        eos_evaluate(&material->eos, point->density * share, point->energy, point->history);
    value.dp_drho *= share;
    if (material_is_lit(material))
        burn_mix(&material->burn, point->history[HISTORY_burnt], &value);
    strength_cut(&material->strength, point->history, &value);
    if (material_failed(material, point->history))
        value.pressure = maximum(value.pressure, 0.0);
    return value;
}

/* Sound speeds of a point from its equation of state and shear modulus: c_b^2 = (dp/drho)_e +
 * (dp/de)_rho p/rho^2,  C_l^2 = c_b^2 + 4G/(3 rho),  C_t^2 = G/rho (1.29), (1.30) with the local
 * bulk modulus in place of a constant one. */
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

/* The shear modulus at DENSITY and ENERGY, Pa. */
BOLIDE_INLINE double material_shear_modulus(const struct material *material, double density,
                                            double energy)
{
    return strength_shear_modulus(&material->strength) *
           melting_left(&material->melting, density, energy);
}

/* Pressure and response of a point as it stands. */
BOLIDE_INLINE struct response material_evaluate(const struct material *material,
                                                struct point *point)
{
    struct eos_value value = material_pressure(material, point);
    point->pressure = value.pressure;
    const double left = melting_left(&material->melting, point->density, point->energy);
    return material_response(&value, point->density,
                             left * strength_shear_modulus(&material->strength),
                             left * strength_yield(&material->strength, point));
}

/* Of the equation of state of POINT, whose pressure is TRIAL. */
BOLIDE_INLINE double material_bulk_modulus(const struct point *point, const struct eos_value *trial)
{
    return point->density * trial->dp_drho + trial->dp_de * trial->pressure / point->density;
}

/* Finds the dilation at which the equation of state gives the pressure that POINT has, by Newton's
 * method. */
BOLIDE_INLINE void material_dilate(const struct material *material, struct point *point)
{
    for (int round = 0; round < 20; round++) {
        struct eos_value value = material_pressure(material, point);
        double modulus = point->density * value.dp_drho;
        double share = material_elastic_share(material, point);
        double missing = point->pressure - value.pressure;
        if (!(fabs(missing) > 1e-14 * modulus))
            break;
        point->history[HISTORY_dilation] += share * missing / modulus;
    }
}

/* The density between that of POINT, whose equation of state gives more than TENSION, and a denser
 * state, at which it gives TENSION: by bisection, and by Newton's method where that stays
 * between. */
BOLIDE_INLINE double material_density_of_tension(const struct material *material,
                                                 const struct point *point, double tension)
{
    const struct eos *eos = &material->eos;
    const double bulking = point->history[HISTORY_bulking] + tension;
    double low = point->density, high = maximum(low, material_density(material));
    for (int k = 0; k < 8; k++, high *= 1.05)
        if (eos_evaluate(eos, high, point->energy, point->history).pressure + bulking >= 0.0)
            break;
    double density = high;
    for (int k = 0; k < 60; k++) {
        struct eos_value value = eos_evaluate(eos, density, point->energy, point->history);
        value.pressure += bulking;
        if (value.pressure < 0.0)
            low = density;
        else
            high = density;
        const double newton = density - value.pressure / value.dp_drho;
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (fabs(next - density) <= 1e-14 * density)
            break;
        density = next;
    }
    return density;
}

/* Failed material that is drawn apart keeps its density and opens voids: POINT, which a step has
 * taken to a density with its voids, is split into the two. Voids no longer count from VOIDS_MOST
 * on: fragments are then free, and are what they are made of. */
#define VOIDS_MOST 0.5
BOLIDE_INLINE void material_open(const struct material *material, struct point *point)
{
    point->history[HISTORY_void_ratio] = 0.0;
    const struct eos_value value =
        eos_evaluate(&material->eos, point->density, point->energy, point->history);
    if (!(value.pressure + point->history[HISTORY_bulking] < 0.0))
        return;
    const double density = material_density_of_tension(material, point, 0.0);
    point->history[HISTORY_void_ratio] = minimum(density / point->density - 1.0, VOIDS_MOST);
    point->density = density;
}

/* What of POINT the damage of a step depends on: FLOW is the plastic strain of the step, PRESSURE
 * that of the density and energy that are known. */
BOLIDE_INLINE struct failing material_failing(const struct motion *motion,
                                              const struct point *point, double flow,
                                              double pressure)
{
    struct failing failing = {0};
    failing.density = point->density;
    failing.pressure = pressure;
    failing.deviator = point->deviator;
    failing.flow = flow;
    failing.strain = point->history[HISTORY_plastic_strain];
    failing.rate = strength_strain_rate(motion->strain_rate);
    failing.stretching = sym3_trace(motion->strain_rate);
    failing.relative = 1.0 + point->history[HISTORY_strength_scatter];
    failing.length = motion->length;
    return failing;
}

/* Leaves of POINT, which has failed, what failed material bears: voids open or close, and friction
 * limits the shear. */
BOLIDE_INLINE void material_leave_rubble(const struct material *material, struct point *point)
{
    material_open(material, point);
    const double friction =
        material->failure.of.common.friction * material_pressure(material, point).pressure;
    const double mises = sym3_mises(point->deviator);
    if (mises > friction)
        point->deviator = sym3_scale(friction / mises, point->deviator);
}

/* Lets POINT, which has VALUE and waits for the edge of the tension to stand, fail when it does. */
BOLIDE_INLINE void material_wait(const struct material *material, const struct motion *motion,
                                 const struct eos_value *value, struct point *point)
{
    const struct failing failing = material_failing(motion, point, 0.0, value->pressure);
    const double shear = strength_shear_modulus(&material->strength);
    const double sound = material_response(value, point->density, shear, 0.0).sound_long;
    double *const overload = &point->history[HISTORY_overload];
    *overload = spall_overload(&material->failure.of.spall, &failing, motion, sound, *overload);
    if (*overload >= 1.0)
        point->history[HISTORY_damage] = 1.0;
}

/* Lets voids grow in POINT, which has not failed, at the density with its voids and the pressure
 * TRIAL, where its mean tension exceeds what the voids that have grown leave of the strength. The
 * work of failure is half the strength times the volume of the voids. Damage is that volume over
 * the one at failure. Source of the volume strain of 0.15 in metals: Grady, J. Mech. Phys. Solids
 * 36 (1988) 353; the linear fall is ours. */
BOLIDE_INLINE void material_grow_voids(const struct material *material,
                                       const struct void_growth *growth, double trial,
                                       struct point *point)
{
    double *const damage = &point->history[HISTORY_damage];
    const double bears =
        growth->strength * (1.0 + point->history[HISTORY_strength_scatter]) * (1.0 - *damage);
    point->history[HISTORY_void_ratio] = 0.0;
    if (!(-trial > bears))
        return;
    const double density = material_density_of_tension(material, point, bears);
    const double voids = density / point->density - 1.0;
    *damage = minimum(maximum(*damage, voids / growth->most), 1.0);
    if (*damage >= 1.0)
        return;
    point->history[HISTORY_void_ratio] = voids;
    point->density = density;
}

/* What the failure model does to POINT after the elastic and plastic part of a step, which flowed
 * FLOW. */
BOLIDE_INLINE void material_fail(const struct material *material, const struct motion *motion,
                                 double flow, struct point *point)
{
    double *const damage = &point->history[HISTORY_damage];
    if (*damage < 1.0) {
        const struct eos_value value = material_pressure(material, point);
        const double bulk = value.dp_drho + value.dp_de * value.pressure / square(point->density);
        struct failing failing = material_failing(motion, point, flow, value.pressure);
        failing.sound = sqrt(maximum(bulk, 0.0));
        failing.yield = strength_yield(&material->strength, point);
        failing.homologous =
            strength_homologous(&material->strength, point->history[HISTORY_plastic_heating]);
        *damage = minimum(failure_damage(&material->failure, &failing, *damage), 1.0);
        const struct void_growth growth = failure_traits(&material->failure).growth;
        if (growth.most > 0.0 && *damage < 1.0)
            material_grow_voids(material, &growth, value.pressure, point);
        if (failure_waits(&material->failure))
            material_wait(material, motion, &value, point);
    }
    if (*damage >= 1.0)
        material_leave_rubble(material, point);
}

/* The most that an explosive burns between two states of its mixture. */
#define REACTION_MOST 0.02

/* The pressure of an explosive that burns by itself, and the rate at which it does, 1/s. */
struct reaction {
    struct eos_value value;
    double rate;
};

/* That at DENSITY and ENERGY; HISTORY gets the volume of the unburnt part. */
BOLIDE_INLINE struct reaction material_reaction(const struct material *material, double density,
                                                double energy, double *history)
{
    struct reaction reaction;
    reaction.value = eos_react(&material->eos, density, energy, history);
    const struct reacting point = {history[HISTORY_burnt], reaction.value.pressure,
                                   material_density(material) / density,
                                   history[HISTORY_explosive_volume]};
    reaction.rate = burn_rate(&material->burn, &point);
    return reaction;
}

/* Burns POINT, at its new density, for DT at the rate of its state. */
BOLIDE_INLINE void material_react(const struct material *material, double dt, struct point *point)
{
    double *const burnt = &point->history[HISTORY_burnt];
    for (double left = dt; left > 0.0 && *burnt < 1.0;) {
        const double rate =
            material_reaction(material, point->density, point->energy, point->history).rate;
        const double time = rate * left > REACTION_MOST ? REACTION_MOST / rate : left;
        *burnt = minimum(*burnt + rate * time, 1.0);
        left = time < left ? left - time : 0.0;
    }
}

/* The fraction of POINT that has burnt after a step, at its new density. */
BOLIDE_INLINE void material_burn(const struct material *material, const struct motion *motion,
                                 struct point *point)
{
    if (burn_has_rate(&material->burn)) {
        material_react(material, motion->dt, point);
        return;
    }
    const double rest = material_density(material);
    struct burning burning;
    burning.passed = motion->time - point->history[HISTORY_lighting_time];
    burning.length = motion->length;
    burning.volume = rest / point->density;
    burning.rest = rest;
    point->history[HISTORY_burnt] =
        burn_fraction(&material->burn, &burning, point->history[HISTORY_burnt]);
}

/* Takes deviator and history of a point to its new density: burning, compaction, then elastic
 * trial, rotation and plastic return, with the damage that they do. */
BOLIDE_INLINE void material_flow(const struct material *material, struct point *point,
                                 const struct motion *motion)
{
    const double strain = point->history[HISTORY_plastic_strain];
    const bool pressed = strength_takes_pressure(&material->strength);
    const double before = pressed && strength_breaks(&material->strength)
                              ? material_pressure(material, point).pressure
                              : 0.0;
    point->density = motion->density;
    if (material_opens(material))
        point->density /= 1.0 + point->history[HISTORY_void_ratio];
    if (material_burns(material))
        material_burn(material, motion, point);
    double compaction = eos_compact(&material->eos, point->density, point->history);
    if (pressed) {
        struct eos_value trial = material_pressure(material, point);
        double bulk = material_bulk_modulus(point, &trial);
        point->pressure = trial.pressure;
        struct motion with = *motion;
        with.compaction = compaction;
        with.pressure = before;
        strength_step(&material->strength, &with, bulk, point);
        if (point->pressure != trial.pressure)
            material_dilate(material, point);
        if (strength_breaks(&material->strength) && material_opens(material) &&
            point->history[HISTORY_damage] >= 1.0)
            material_open(material, point);
    } else if (material_has_strength(material)) {
        melting_flow(&material->melting, &material->strength, motion, point);
    }
    if (material_fails(material))
        material_fail(material, motion, point->history[HISTORY_plastic_strain] - strain, point);
}

/* Advances a point by one step after which its energy is MOTION->energy (section 7.3 of the source,
 * steps 4 to 7). */
BOLIDE_INLINE struct response material_step(const struct material *material, struct point *point,
                                            const struct motion *motion)
{
    point->energy = motion->energy;
    material_flow(material, point, motion);
    return material_evaluate(material, point);
}

/* Advances a point by one step whose energy comes from the power of its stress; MOTION->energy is
 * not used:
 *
 *   e' = e + (v + v')/2 (S + S')/2 : d eps - (v' - v) [(p + p')/2 + q],   p' = p(rho', e')
 *
 * with v = 1/rho and q the mean viscous pressure. It is solved for a pressure that is linear in
 * energy, as nearly all are; others are taken along their slope. Source: the energy bookkeeping of
 * MPM3D, Zhang, Chen and Liu, The material point method (2017), with p = A + B e. The first
 * function is what does not depend on p', the second the rest, where VALUE is at the density and
 * energy that are known then. */
BOLIDE_INLINE double material_work(const struct point *point, const struct motion *motion,
                                   struct sym3 new_deviator)
{
    const struct sym3 mean = sym3_scale(0.5, sym3_add(point->deviator, new_deviator)),
                      rate = motion->strain_rate;
    const double volume = 1.0 / point->density, change = 1.0 / motion->density - volume;
    const double shear = mean.xx * rate.xx + mean.yy * rate.yy + mean.zz * rate.zz +
                         2.0 * (mean.xy * rate.xy + mean.yz * rate.yz + mean.zx * rate.zx);
    return (volume + 0.5 * change) * shear * motion->dt -
           change * (0.5 * point->pressure + motion->viscous_pressure);
}

BOLIDE_INLINE double material_work_of_pressure(double density, double new_density,
                                               const struct eos_value *value)
{
    const double change = 1.0 / new_density - 1.0 / density;
    return -0.5 * change * value->pressure / (1.0 + 0.5 * change * value->dp_de);
}

BOLIDE_INLINE struct response material_step_by_work(const struct material *material,
                                                    struct point *point,
                                                    const struct motion *motion)
{
    const struct point start = *point;
    material_flow(material, point, motion);
    point->energy += material_work(&start, motion, point->deviator);
    const struct eos_value value = material_pressure(material, point);
    point->energy += material_work_of_pressure(start.density, motion->density, &value);
    return material_evaluate(material, point);
}

/* How much hotter POINT starts than the material at rest, K: to a strength that softens by heat
 * this is as if plastic work had heated it. Zero where the material has no temperature. */
BOLIDE_INLINE double material_start_heating(const struct material *material,
                                            const struct point *point)
{
    if (heat_wrong(&material->heat, &material->eos))
        return 0.0;
    return heat_temperature(&material->heat, &material->eos, point->density, point->energy) -
           heat_temperature(&material->heat, &material->eos, material_density(material), 0.0);
}

/* The slots of history that it needs beside the plastic strain. */
BOLIDE_INLINE unsigned material_history(const struct material *material)
{
    const unsigned burning = HISTORY_BIT(lighting_time) | HISTORY_BIT(burnt);
    unsigned failing = HISTORY_BIT(damage) | HISTORY_BIT(void_ratio);
    if (failure_scatters(&material->failure))
        failing |= HISTORY_BIT(strength_scatter);
    if (failure_waits(&material->failure))
        failing |= HISTORY_BIT(overload);
    return eos_history(&material->eos) | strength_history(&material->strength) |
           (material_fails(material) ? failing : 0) | (material_is_lit(material) ? burning : 0);
}

/* Whether it remembers no more than its plastic strain and is a fluid or a plain solid, as most
 * are: where that is known, a compiler leaves the rest out. */
BOLIDE_INLINE bool material_is_plain(const struct material *material)
{
    return strength_is_plain(&material->strength) && !eos_history(&material->eos) &&
           !material_burns(material) && !material_fails(material);
}

#endif
