/* The equations of state, one header each, and the one list of them.
 *
 * An equation of state is a parameter struct whose first member is its reference density, and a pure
 * function from density, specific internal energy and history to pressure and its two derivatives.
 * To add one: its header and its parameter table in eos/, and its line in the list below. */
#ifndef BOLIDE_EOS_H
#define BOLIDE_EOS_H

#include "material/eos/barotropic.h"
#include "material/eos/grueneisen_eta.h"
#include "material/eos/grueneisen_polynomial.h"
#include "material/eos/hjc.h"
#include "material/eos/ideal_gas.h"
#include "material/eos/jwl.h"
#include "material/eos/mie_grueneisen.h"
#include "material/eos/polynomial.h"
#include "material/eos/rubber.h"
#include "material/eos/stiffened_gas.h"
#include "material/eos/tillotson.h"

/* X(identifier): struct eos_<identifier>, eos_<identifier>() in eos/<identifier>.h, its table in
 * eos/<identifier>.c (see choices.h). */
#define EOS_LIST(X)          \
    X(ideal_gas)             \
    X(stiffened_gas)         \
    X(barotropic)            \
    X(rubber)                \
    X(polynomial)            \
    X(mie_grueneisen)        \
    X(grueneisen_eta)        \
    X(grueneisen_polynomial) \
    X(tillotson)             \
    X(jwl)                   \
    X(hjc)

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

BOLIDE_INLINE double eos_reference_density(const struct eos *eos)
{
    return eos->of.reference_density;
}

/* Pressure (Pa), (dp/drho)_e (Pa m^3/kg), (dp/de)_rho (Pa kg/J) at DENSITY and ENERGY (J/kg). */
BOLIDE_INLINE struct eos_value eos_evaluate(const struct eos *eos, double density, double energy,
                                            const double *history)
{
    struct eos_value none = {0.0, 0.0, 0.0, POINT_NO_SOUND};
    switch (eos->kind) {
#define EOS_CASE(name) \
    case EOS_##name:   \
        return eos_##name(&eos->of.name, density, energy, history);
        EOS_LIST(EOS_CASE)
#undef EOS_CASE
    default:
        return none;
    }
}

/* The slots of history that it needs. */
BOLIDE_INLINE unsigned eos_history(const struct eos *eos)
{
    return eos->kind == EOS_hjc ? HISTORY_BIT(largest_compression) : 0;
}

/* Why its parameters do not go together, *KEY is that it is about; NULL when they do. */
BOLIDE_INLINE const char *eos_wrong(const struct eos *eos, const char **key)
{
    return eos->kind == EOS_hjc ? eos_hjc_wrong(&eos->of.hjc, key) : NULL;
}

#endif
