/* The closure of cells of gas, and of states at their faces: from density and specific energy to
 * pressure and its derivatives. One material by its equation of state; two as a mixture
 * (mixture.h), or with the ratio that markers give them; of an explosive its products, as far as it
 * has burnt. Sweeps, and what looks at cells, know no other way.
 *
 *   content (kinds, own densities, fractions, burnt)  \
 *   density, specific energy                           > gas_evaluate -> p, dp/drho, dp/de
 *   closure (equations of state, explosive, markers)  /
 *
 * For files that are compiled once an instruction set: a loop here runs over the cells of a row. */
#ifndef BOLIDE_GAS_CLOSURE_H
#define BOLIDE_GAS_CLOSURE_H

#include "gas/mixtures.h"

/* Where the cells or faces FIRST to LAST are in the numbers of a row: cell c is at [c +
 * ROW_GHOSTS], the face below it too. */
#define FOR_ROW(k, first, last) for (int k = (first) + ROW_GHOSTS; k <= (last) + ROW_GHOSTS; k++)

struct gas_closure {
    const struct eos *eos, *other; /* of the second material, NULL: there is one */
    const struct eos *lit;         /* of an explosive of which some is unburnt, NULL: none is */
    bool marked;                   /* markers divide the materials (markers.h) */
    bool liquid;                   /* a material is one: floors count */
    double floor[2];               /* pressures below which no liquid is, Pa; -INFINITY in gases */
};

enum content_kind { CONTENT_FIRST, CONTENT_SECOND, CONTENT_BOTH };

/* What else the states of cells or faces depend on; each of them by its place, as in a row. NULL
 * where the closure does not ask: all but `burnt` where there is one material. */
struct gas_content {
    const uint8_t *kind;    /* enum content_kind; NULL: all are of closure.eos */
    const double *own[2];   /* density of each material, kg/m^3 */
    const double *fraction; /* of the volume, of the second material */
    const double *burnt;    /* the fraction burnt of the explosive */
    const double *gamma;    /* p/(rho e), where markers divide the materials */
    double least;           /* pressure of a mixture, where fluxes want one; -INFINITY: none */
};

/* What the closure says of the cells or faces of a row. */
struct row_values {
    double pressure[ROW_ROOM], dp_drho[ROW_ROOM], dp_de[ROW_ROOM];
    double lift[ROW_ROOM]; /* by how much a floor raises the pressure; where floors count */
};

/* Of two materials in a cell, the kind that its FRACTION says. */
BOLIDE_INLINE uint8_t content_kind_of(double fraction)
{
    return fraction <= 0.0 ? CONTENT_FIRST : fraction >= 1.0 ? CONTENT_SECOND : CONTENT_BOTH;
}

/* What has burnt of both materials where BURNT of the explosive has. */
BOLIDE_INLINE void gas_burnt_of(const struct gas_closure *closure, double burnt, double of[2])
{
    of[0] = closure->lit && closure->lit == closure->eos ? burnt : 1.0;
    of[1] = closure->lit && closure->lit == closure->other ? burnt : 1.0;
}

/* Adds the mixture in a cell with MASS of each material, kg/m^3 of the cell. */
BOLIDE_INLINE void gas_add_mixture(const struct gas_closure *closure, const double mass[2],
                                   double fraction, double burnt, double energy, int k,
                                   struct mixtures *mixtures)
{
    const double density[2] = {mixture_density(closure->eos, mass[0], 1.0 - fraction),
                               mixture_density(closure->other, mass[1], fraction)};
    double of[2];
    gas_burnt_of(closure, burnt, of);
    mixtures_add(mixtures, k, density, fraction, of, energy);
}

/* Evaluates EOS at FIRST to LAST. The loops evaluate the form of the source, which has no branches;
 * the few places beyond it are done once more. */
static inline void row_evaluate(const struct eos *eos, const double *density, const double *energy,
                                int first, int last, struct row_values *values)
{
    const double none[POINT_HISTORY] = {0.0};
    uint64_t beyond[ROW_ROOM], any = 0;
    switch (eos->kind) {
#define ROW_CASE(name)                                                                             \
    case EOS_##name:                                                                               \
        FOR_ROW (k, first, last) {                                                                 \
            const struct eos_value value = eos_##name(&eos->of.name, density[k], energy[k], none); \
            values->pressure[k] = value.pressure;                                                  \
            values->dp_drho[k] = value.dp_drho;                                                    \
            values->dp_de[k] = value.dp_de;                                                        \
            beyond[k] = value.status & POINT_BEYOND;                                               \
            any |= beyond[k];                                                                      \
        }                                                                                          \
        break;
        EOS_STATELESS(ROW_CASE)
#undef ROW_CASE
    default:
        break;
    }
    if (any)
        FOR_ROW (k, first, last)
            if (beyond[k]) {
                const struct eos_value value = eos_beyond(eos, density[k], energy[k]);
                values->pressure[k] = value.pressure;
                values->dp_drho[k] = value.dp_drho;
                values->dp_de[k] = value.dp_de;
            }
}

static const double LIQUID_LEAST = 1e-3; /* Pa, of a mixture with a liquid */

/* Of a liquid full of bubbles: its sound speed, m/s, of which any small one serves since its
 * pressure does not change; and the fraction of its density at rest below which little liquid is
 * left and the pressure vanishes with the density, so that it cannot accelerate next to nothing. */
static const double CAVITY_SOUND = 10.0, CAVITY_LEAST = 1e-3;

/* What values at FIRST to LAST become in the liquid EOS whose pressure does not fall below FLOOR:
 * bubbles take the volume that is missing. The energy stays what it is, so that the liquid bears
 * pressure again when it is back at the density that it had. */
static inline void row_cavitate(const struct eos *eos, double floor, const double *density,
                                int first, int last, struct row_values *values)
{
    const double sparse = CAVITY_LEAST * eos_reference_density(eos);
    FOR_ROW (k, first, last) {
        const double least = floor * minimum(1.0, density[k] / sparse);
        const bool cavity = values->pressure[k] < least;
        values->lift[k] = cavity ? least - values->pressure[k] : 0.0;
        values->pressure[k] = cavity ? least : values->pressure[k];
        values->dp_drho[k] =
            cavity ? maximum(square(CAVITY_SOUND), 2.0 * least / density[k]) : values->dp_drho[k];
        values->dp_de[k] = cavity ? 0.0 : values->dp_de[k];
    }
}

/* The least pressure of a mixture with a liquid, which bears no tension: what else is there would
 * not either. */
BOLIDE_INLINE double gas_mixed_floor(const struct gas_closure *closure)
{
    return maximum(maximum(closure->floor[0], closure->floor[1]), LIQUID_LEAST);
}

/* What values at FIRST to LAST become where only the fraction BURNT of the explosive EOS is. Its
 * ENERGY counts from the explosive at rest, whose pressure vanishes: with the pressure P(rho, e) =
 * P_0(rho) + b(rho) e of the products
 *
 *   p = F P_0 + b e
 *
 * Unburnt it is a gas without pressure but that of its heat, so that nothing runs ahead of a
 * detonation and energy is conserved whatever F is. Products that have done work may flow into it
 * and take that away: fluxes take some pressure then, until F grows by as much as they need
 * (burn.c). */
static const double UNBURNT_LEAST = 1e-3; /* Pa; less than any air around it has */

static inline void row_unburn(const struct eos *eos, const double *density, const double *energy,
                              const double *burnt, int first, int last, struct row_values *values)
{
    double none[ROW_ROOM] = {0.0};
    struct row_values rest;
    row_evaluate(eos, density, none, first, last, &rest);
    FOR_ROW (k, first, last) {
        const double pressure = burnt[k] * rest.pressure[k] + values->dp_de[k] * energy[k],
                     slope = values->dp_drho[k] - (1.0 - burnt[k]) * rest.dp_drho[k];
        values->pressure[k] = maximum(pressure, UNBURNT_LEAST);
        values->dp_drho[k] = maximum(slope, 0.0);
    }
}

/* Place K of both materials, which markers divide, at DENSITY and ENERGY. */
BOLIDE_INLINE void gas_evaluate_marked(const struct gas_content *of, double density, double energy,
                                       int k, struct row_values *values)
{
    values->pressure[k] = of->gamma[k] * density * energy;
    values->dp_drho[k] = 4.0 * fabs(values->pressure[k]) / density; /* above that of both */
    values->dp_de[k] = 0.0;
}

/* The places FIRST to LAST of both materials at DENSITY and ENERGY. */
APART void gas_evaluate_mixed(const struct gas_closure *closure, const struct gas_content *of,
                              const double *density, const double *energy, int first, int last,
                              struct row_values *values)
{
    const struct eos *const eos[2] = {closure->eos, closure->other};
    double gamma[ROW_ROOM], slope[ROW_ROOM], lift[ROW_ROOM];
    struct mixtures mixtures;
    mixtures.count = 0;
    FOR_ROW (k, first, last) {
        if (of->kind[k] != CONTENT_BOTH)
            continue;
        const double own[2] = {of->own[0][k], of->own[1][k]};
        double burnt[2];
        gas_burnt_of(closure, closure->lit ? of->burnt[k] : 1.0, burnt);
        mixtures_add(&mixtures, k, own, of->fraction[k], burnt, density[k] * energy[k]);
    }
    const double bound = closure->liquid ? maximum(of->least, gas_mixed_floor(closure)) : of->least;
    const int lanes = mixtures_find(&mixtures, eos);
    for (int i = 0; i < lanes; i++) {
        const struct mixture mixture = mixtures_at(&mixtures, i);
        const double pressure = maximum(mixtures.pressure[i], bound),
                     least = of->least > 0.0 ? pressure / mixture.density : -(double)INFINITY,
                     sound_square = maximum(mixture_sound_square(&mixture, pressure), least);
        gamma[i] = mixture_gamma(&mixture);
        lift[i] = pressure - mixtures.pressure[i];
        mixtures.pressure[i] = pressure;
        slope[i] = sound_square;
    }
    for (int i = 0; i < mixtures.count; i++) {
        const int k = mixtures.place[i];
        values->lift[k] = lift[i];
        values->pressure[k] = mixtures.pressure[i];
        values->dp_de[k] = gamma[i] * density[k];
        values->dp_drho[k] = slope[i] - gamma[i] * mixtures.pressure[i] / density[k];
    }
}

/* Where some places are of the second material or of both: VALUES are those of the first. */
APART void gas_evaluate_two(const struct gas_closure *closure, const struct gas_content *of,
                            const double *density, const double *energy, int first, int last,
                            struct row_values *values)
{
    struct row_values other;
    row_evaluate(closure->other, density, energy, first, last, &other);
    if (closure->lit == closure->other)
        row_unburn(closure->other, density, energy, of->burnt, first, last, &other);
    if (closure->liquid)
        row_cavitate(closure->other, closure->floor[1], density, first, last, &other);
    FOR_ROW (k, first, last) {
        const bool second = of->kind[k] == CONTENT_SECOND;
        values->pressure[k] = second ? other.pressure[k] : values->pressure[k];
        values->dp_drho[k] = second ? other.dp_drho[k] : values->dp_drho[k];
        values->dp_de[k] = second ? other.dp_de[k] : values->dp_de[k];
    }
    if (closure->liquid)
        FOR_ROW (k, first, last)
            values->lift[k] = of->kind[k] == CONTENT_SECOND ? other.lift[k] : values->lift[k];
    if (!closure->marked)
        gas_evaluate_mixed(closure, of, density, energy, first, last, values);
    else
        FOR_ROW (k, first, last)
            if (of->kind[k] == CONTENT_BOTH)
                gas_evaluate_marked(of, density[k], energy[k], k, values);
}

/* The closure at FIRST to LAST, whose content is OF. */
static inline void gas_evaluate(const struct gas_closure *closure, const struct gas_content *of,
                                const double *density, const double *energy, int first, int last,
                                struct row_values *values)
{
    row_evaluate(closure->eos, density, energy, first, last, values);
    if (closure->lit == closure->eos)
        row_unburn(closure->eos, density, energy, of->burnt, first, last, values);
    if (closure->liquid)
        row_cavitate(closure->eos, closure->floor[0], density, first, last, values);
    if (of->kind)
        gas_evaluate_two(closure, of, density, energy, first, last, values);
}

#endif
