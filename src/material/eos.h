/* The equations of state, one header each, and the one list of them.
 *
 * An equation of state is a parameter struct whose first member is its reference density, a pure
 * function from density, specific internal energy and history to pressure and its two derivatives,
 * the curve that temperatures are counted from, its traits, and its parameters as rows. To add one:
 * its header in eos/, and its line in the list below. */
#ifndef BOLIDE_EOS_H
#define BOLIDE_EOS_H

#include "material/eos/barotropic.h"
#include "material/eos/blended_jwl.h"
#include "material/eos/grueneisen_eta.h"
#include "material/eos/grueneisen_polynomial.h"
#include "material/eos/hjc.h"
#include "material/eos/ideal_gas.h"
#include "material/eos/jwl.h"
#include "material/eos/mie_grueneisen.h"
#include "material/eos/noble_abel.h"
#include "material/eos/polynomial.h"
#include "material/eos/reactive_jwl.h"
#include "material/eos/rubber.h"
#include "material/eos/stiffened_gas.h"
#include "material/eos/tillotson.h"

/* X(identifier): in eos/<identifier>.h struct eos_<identifier>, eos_<identifier>(),
 * eos_<identifier>_traits(), eos_<identifier>_curve(), and the name, help and parameters
 * EOS_<identifier>_NAME, _HELP and _PARAMETERS (see choices.c), and EOS_<identifier>_SAMPLE, the
 * constants of some material for the tests of all equations of state. */
#define EOS_LIST(X, ...)            \
    EOS_STATELESS(X, ##__VA_ARGS__) \
    X(hjc, ##__VA_ARGS__)           \
    X(reactive_jwl, ##__VA_ARGS__)  \
    X(blended_jwl, ##__VA_ARGS__)

/* Those that need no history, of density and energy alone: loops over many points know no
 * others. */
#define EOS_STATELESS(X, ...)               \
    X(ideal_gas, ##__VA_ARGS__)             \
    X(stiffened_gas, ##__VA_ARGS__)         \
    X(barotropic, ##__VA_ARGS__)            \
    X(rubber, ##__VA_ARGS__)                \
    X(polynomial, ##__VA_ARGS__)            \
    X(mie_grueneisen, ##__VA_ARGS__)        \
    X(grueneisen_eta, ##__VA_ARGS__)        \
    X(grueneisen_polynomial, ##__VA_ARGS__) \
    X(tillotson, ##__VA_ARGS__)             \
    X(jwl, ##__VA_ARGS__)                   \
    X(noble_abel, ##__VA_ARGS__)

/* Models of irreversible compaction: eos_<identifier>_compact() notes it in the history. */
#define EOS_COMPACTING(X, ...) X(hjc, ##__VA_ARGS__)

/* Mixtures of an explosive and products with volumes of their own: eos_<identifier>_react() is
 * eos_<identifier>() and notes the volume of the explosive in the history,
 * eos_<identifier>_temperature() gives the temperature that both have, K, of density, pressure and
 * that history. */
#define EOS_PHASES(X, ...) X(reactive_jwl, ##__VA_ARGS__)

/* Products whose energy counts from the explosive at rest: eos_<identifier>_take_heat() makes it
 * count from cold products and returns the difference, J/kg. */
#define EOS_CHARGED(X, ...) X(jwl, ##__VA_ARGS__)

/* Models whose published formula has a limited range: outside it eos_<identifier>() returns
 * POINT_BEYOND, and eos_<identifier>_beyond() continues it. */
#define EOS_CONTINUED(X, ...)               \
    X(mie_grueneisen, ##__VA_ARGS__)        \
    X(grueneisen_eta, ##__VA_ARGS__)        \
    X(grueneisen_polynomial, ##__VA_ARGS__) \
    X(jwl, ##__VA_ARGS__)

#define EOS_ENUM(name) EOS_##name,
enum eos_kind { EOS_LIST(EOS_ENUM) EOS_KINDS };
#undef EOS_ENUM

#define EOS_MEMBER(name) struct eos_##name name;
struct eos {
    enum eos_kind kind;
    union {
        double reference_density;
        EOS_LIST(EOS_MEMBER)
    } of;
};
#undef EOS_MEMBER

/* In a switch: models of a list answer by eos_<identifier>FUNCTION() of their parameters. */
#define EOS_ANSWER(name, function, ...) \
    case EOS_##name:                    \
        return eos_##name##function(&eos->of.name, ##__VA_ARGS__);

/* eos_make_<identifier>(): PARAMETERS as an equation of state. */
#define EOS_MAKE(name)                                                            \
    BOLIDE_INLINE struct eos eos_make_##name(const struct eos_##name *parameters) \
    {                                                                             \
        struct eos eos;                                                           \
        eos.kind = EOS_##name;                                                    \
        eos.of.name = *parameters;                                                \
        return eos;                                                               \
    }
EOS_LIST(EOS_MAKE)
#undef EOS_MAKE

BOLIDE_INLINE double eos_reference_density(const struct eos *eos)
{
    return eos->of.reference_density;
}

/* Where the form of its source ends. */
BOLIDE_INLINE struct eos_value eos_beyond(const struct eos *eos, double density, double energy)
{
    struct eos_value none = {0.0, 0.0, 0.0, POINT_NO_SOUND};
    switch (eos->kind) {
        EOS_CONTINUED(EOS_ANSWER, _beyond, density, energy)
    default:
        return none;
    }
}

/* Pressure (Pa), (dp/drho)_e (Pa m^3/kg), (dp/de)_rho (Pa kg/J) at DENSITY and ENERGY (J/kg). */
BOLIDE_INLINE struct eos_value eos_evaluate(const struct eos *eos, double density, double energy,
                                            const double *history)
{
    struct eos_value value = {0.0, 0.0, 0.0, POINT_NO_SOUND};
    switch (eos->kind) {
#define EOS_CASE(name)                                               \
    case EOS_##name:                                                 \
        value = eos_##name(&eos->of.name, density, energy, history); \
        break;
        EOS_LIST(EOS_CASE)
#undef EOS_CASE
    default:
        break;
    }
    return value.status & POINT_BEYOND ? eos_beyond(eos, density, energy) : value;
}

/* The square of the speed of sound in a fluid, (dp/drho)_s, from the PRESSURE and its
 * derivatives. */
BOLIDE_INLINE double eos_sound_square(double pressure, double dp_drho, double dp_de, double density)
{
    return dp_drho + pressure / square(density) * dp_de;
}

BOLIDE_INLINE struct eos_traits eos_traits(const struct eos *eos)
{
    switch (eos->kind) {
        EOS_LIST(EOS_ANSWER, _traits)
    default:
        return eos_default_traits();
    }
}

/* The reference curve of the temperature, at DENSITY. */
BOLIDE_INLINE struct heat_curve eos_curve(const struct eos *eos, const struct heat *heat,
                                          double density)
{
    struct heat_curve none = {NAN, 0.0};
    switch (eos->kind) {
        EOS_LIST(EOS_ANSWER, _curve, heat, density)
    default:
        return none;
    }
}

/* The slots of history that it needs. */
BOLIDE_INLINE unsigned eos_history(const struct eos *eos) { return eos_traits(eos).history; }

/* gamma of an ideal gas; NAN for others. */
BOLIDE_INLINE double eos_ratio_of_heats(const struct eos *eos)
{
    return eos_traits(eos).ratio_of_heats;
}

/* Why its parameters do not go together, *KEY is that it is about; NULL when they do. */
BOLIDE_INLINE const char *eos_wrong(const struct eos *eos, const char **key)
{
    struct eos_traits traits = eos_traits(eos);
    *key = traits.wrong_key;
    return traits.wrong;
}

/* Notes in HISTORY the compaction on the way to DENSITY. Returns its irreversible part of
 * rho/rho_0. */
BOLIDE_INLINE double eos_compact(const struct eos *eos, double density, double *history)
{
    switch (eos->kind) {
        EOS_COMPACTING(EOS_ANSWER, _compact, density, history)
    default:
        return 0.0;
    }
}

/* eos_evaluate, and HISTORY gets the volume of the explosive, over that at rest. */
BOLIDE_INLINE struct eos_value eos_react(const struct eos *eos, double density, double energy,
                                         double *history)
{
    switch (eos->kind) {
        EOS_PHASES(EOS_ANSWER, _react, density, energy, history)
    default:
        history[HISTORY_explosive_volume] = eos_reference_density(eos) / density;
        return eos_evaluate(eos, density, energy, history);
    }
}

/* The temperature of a mixture whose phases have one, K; NAN: it has none of its own. */
BOLIDE_INLINE double eos_phases_temperature(const struct eos *eos, double density, double pressure,
                                            const double *history)
{
    switch (eos->kind) {
        EOS_PHASES(EOS_ANSWER, _temperature, density, pressure, history)
    default:
        return NAN;
    }
}

/* Makes the energy of products count from cold ones; by how much it grows, J/kg. */
BOLIDE_INLINE double eos_take_heat(struct eos *eos)
{
    switch (eos->kind) {
        EOS_CHARGED(EOS_ANSWER, _take_heat)
    default:
        return 0.0;
    }
}

#endif
