/* What a sweep must leave to cells of two materials: neither material is colder than 0 K, and the
 * pressure does not vanish. */
#ifndef BOLIDE_GAS_PART_LIMITS_H
#define BOLIDE_GAS_PART_LIMITS_H

#include "gas/states.h"

/* Gives the second material of cells of both that has become colder than 0 K more of the volume. */
static inline void parts_thaw(struct gas_row *row)
{
    const struct gas_closure *closure = &row->closure;
    const struct eos *const eos[2] = {closure->eos, closure->other};
    FOR_ROW (k, 0, row->cells - 1) {
        double *fraction = &row->part[PART_FRACTION][k];
        const double density = row->u.of[GAS_DENSITY][k],
                     mass[2] = {density - row->part[PART_MASS][k], row->part[PART_MASS][k]};
        double kinetic = 0.0;
        if (!(*fraction > MIXTURE_TRACE && *fraction < 0.999) ||
            (closure->lit == closure->other && row->burnt[k] < 1.0))
            continue;
        for (int n = GAS_MOMENTUM; n < GAS_ENERGY; n++)
            kinetic += 0.5 * square(row->u.of[n][k]) / density;
        *fraction = mixture_thawed(eos, mass, *fraction, row->u.of[GAS_ENERGY][k] - kinetic);
    }
}

/* Opens bubbles in cells of a liquid and a gas whose pressure a sweep has left below the floor. */
static inline void parts_open(struct gas_row *row)
{
    const struct gas_closure *closure = &row->closure;
    const struct eos *const eos[2] = {closure->eos, closure->other};
    const int liquid = closure->floor[1] > -(double)INFINITY;
    struct mixtures mixtures;
    if (closure->floor[0] > -(double)INFINITY && liquid)
        return; /* two liquids */
    mixtures.count = 0;
    FOR_ROW (k, 0, row->cells - 1) {
        const double fraction = row->part[PART_FRACTION][k], density = row->u.of[GAS_DENSITY][k],
                     second = row->part[PART_MASS][k], mass[2] = {density - second, second};
        double kinetic = 0.0;
        if (!(fraction > 0.0 && fraction < 1.0))
            continue;
        for (int n = GAS_MOMENTUM; n < GAS_ENERGY; n++)
            kinetic += 0.5 * square(row->u.of[n][k]) / density;
        gas_add_mixture(closure, mass, fraction, row->burnt[k], row->u.of[GAS_ENERGY][k] - kinetic,
                        k, &mixtures);
    }
    mixtures_find(&mixtures, eos);
    for (int i = 0; i < mixtures.count; i++) {
        const int k = mixtures.place[i];
        const double second = row->part[PART_MASS][k],
                     mass[2] = {row->u.of[GAS_DENSITY][k] - second, second};
        const bool burnt = !closure->lit || row->burnt[k] >= 1.0;
        if (burnt && mixtures.pressure[i] < gas_mixed_floor(closure))
            row->part[PART_FRACTION][k] =
                mixture_opened(eos, mass, row->part[PART_FRACTION][k], mixtures.energy[i], liquid,
                               gas_mixed_floor(closure));
    }
}

/* Whether a sweep leaves a cell of both materials with hardly any of the least pressure that it and
 * its neighbours had. */
static inline bool parts_are_spent(const struct gas_row *row, const struct row_states *cell)
{
    const double *pressure = cell->of.of[PRIMITIVE_PRESSURE];
    const struct eos *const eos[2] = {row->closure.eos, row->closure.other};
    struct mixtures mixtures;
    double bound[ROW_ROOM];
    mixtures.count = 0;
    FOR_ROW (k, 0, row->cells - 1) {
        const double fraction = row->part[PART_FRACTION][k], density = row->u.of[GAS_DENSITY][k];
        const double least = minimum(pressure[k], minimum(pressure[k - 1], pressure[k + 1]));
        if (!(fraction > 0.0 && fraction < 1.0) || !(least > 0.0))
            continue;
        double kinetic = 0.0;
        for (int n = GAS_MOMENTUM; n < GAS_ENERGY; n++)
            kinetic += 0.5 * square(row->u.of[n][k]) / density;
        const double second = row->part[PART_MASS][k], mass[2] = {density - second, second};
        bound[mixtures.count] = 0.5 * GAS_LEAST * least;
        gas_add_mixture(&row->closure, mass, fraction, row->burnt[k],
                        row->u.of[GAS_ENERGY][k] - kinetic, k, &mixtures);
    }
    bool spent = false;
    mixtures_find(&mixtures, eos);
    for (int i = 0; i < mixtures.count; i++)
        spent |= !(mixtures.pressure[i] >= bound[i]);
    return spent;
}

#endif
