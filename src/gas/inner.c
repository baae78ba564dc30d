/* How the state changes inside a cell; see inner.h. */
#include "gas/inner.h"

#include <string.h>

#include "gas/states.h"

static const double no_history[POINT_HISTORY] = {0.0}, all_burnt[2] = {1.0, 1.0};

static double kinetic_of(const double *number)
{
    return 0.5 *
           (square(number[GAS_MOMENTUM]) + square(number[GAS_MOMENTUM + 1]) +
            square(number[GAS_MOMENTUM + 2])) /
           number[GAS_DENSITY];
}

static struct mixture mixture_in(const struct gas *gas, const double density[2], double fraction)
{
    const struct eos *const eos[2] = {&gas->eos[0], &gas->eos[1]};
    return mixture_of(eos, density, fraction, all_burnt);
}

struct gas_inner gas_inner_of(const struct gas *gas, const double *number)
{
    const double density = number[GAS_DENSITY], heat = number[GAS_ENERGY] - kinetic_of(number),
                 fraction = gas->layout.two ? number[GAS_FRACTION] : 0.0,
                 second = gas->layout.two ? number[GAS_SECOND] : 0.0;
    struct gas_inner inner = {.kind = content_kind_of(fraction), .energy = heat / density};
    double *own = inner.of + INNER_DENSITY;
    for (int axis = 0; axis < 3; axis++)
        inner.of[axis] = number[GAS_MOMENTUM + axis] / density;
    inner.of[INNER_FRACTION] = fraction;
    if (gas->layout.afterburns && second > 0.0)
        inner.afterburnt = number[GAS_AFTERBURNT] / second;
    if (inner.kind != CONTENT_BOTH) {
        own[0] = own[1] = density;
        inner.of[INNER_PRESSURE] =
            eos_evaluate(&gas->eos[inner.kind], density, inner.energy, no_history).pressure;
        return inner;
    }
    own[0] = mixture_density(&gas->eos[0], density - second, 1.0 - fraction);
    own[1] = mixture_density(&gas->eos[1], second, fraction);
    const struct mixture mixture = mixture_in(gas, own, fraction);
    inner.of[INNER_PRESSURE] = mixture_pressure(&mixture, heat);
    return inner;
}

double gas_pressure_of(const struct gas *gas, const double *number)
{
    return gas_inner_of(gas, number).of[INNER_PRESSURE];
}

/* Whether a cell says something of the density of material M. */
static bool tells(const struct gas_inner *inner, int m)
{
    const double second = inner->of[INNER_FRACTION];
    return (m ? second : 1.0 - second) >= MIXTURE_COUNTS;
}

void gas_inner_slope(const struct gas_inner *past, const struct gas_inner *here,
                     const struct gas_inner *next, double slope[INNERS])
{
    for (int n = 0; n < INNERS; n++) {
        const bool known =
            n < INNER_DENSITY || (tells(past, n - INNER_DENSITY) && tells(next, n - INNER_DENSITY));
        slope[n] = known ? gas_lesser(here->of[n] - past->of[n], next->of[n] - here->of[n]) : 0.0;
    }
}

/* Conserved numbers of a state. */
static void conserve(const struct gas *gas, const struct gas_inner *of, double *number)
{
    const double *own = of->of + INNER_DENSITY, pressure = of->of[INNER_PRESSURE],
                 fraction = of->of[INNER_FRACTION];
    double heat = 0.0;
    if (of->kind != CONTENT_BOTH) {
        const double density = own[of->kind];
        const struct eos_value value =
            eos_evaluate(&gas->eos[of->kind], density, of->energy, no_history);
        number[GAS_DENSITY] = density;
        heat = density * (of->energy + (pressure - value.pressure) / value.dp_de);
    } else {
        const struct mixture mixture = mixture_in(gas, own, fraction);
        number[GAS_DENSITY] = mixture.density;
        for (int m = 0; m < 2; m++)
            heat += mixture.part[m].weight * (pressure - mixture.part[m].cold);
    }
    for (int axis = 0; axis < 3; axis++)
        number[GAS_MOMENTUM + axis] = number[GAS_DENSITY] * of->of[axis];
    number[GAS_ENERGY] = heat + kinetic_of(number);
    if (!gas->layout.two)
        return;
    number[GAS_FRACTION] = fraction;
    number[GAS_SECOND] = of->kind == CONTENT_BOTH     ? fraction * own[1]
                         : of->kind == CONTENT_SECOND ? number[GAS_DENSITY]
                                                      : 0.0;
    if (gas->layout.afterburns)
        number[GAS_AFTERBURNT] = of->afterburnt * number[GAS_SECOND];
}

void gas_inner_part(const struct gas *gas, const struct gas_inner *here, double (*slope)[INNERS],
                    int dimension, const int side[3], double *number)
{
    struct gas_inner part = *here;
    for (int axis = 0; axis < dimension; axis++)
        for (int n = 0; n < INNERS; n++)
            part.of[n] += (side[axis] ? 0.25 : -0.25) * slope[axis][n];
    conserve(gas, &part, number);
}

/* The part of a cell of both materials, HERE, with FRACTION: mass, energy and volume of each are in
 * proportion. */
static void share(const struct gas *gas, const struct gas_inner *here, const double *number,
                  double fraction, double *part)
{
    const double *own = here->of + INNER_DENSITY, pressure = here->of[INNER_PRESSURE],
                 before = number[GAS_FRACTION], gain = fraction - before,
                 mass[2] = {(number[GAS_DENSITY] - number[GAS_SECOND]) / (1.0 - before),
                            number[GAS_SECOND] / before};
    const struct mixture mixture = mixture_in(gas, own, before);
    const double heat[2] = {mixture.part[0].weight * (pressure - mixture.part[0].cold) /
                                (1.0 - before),
                            mixture.part[1].weight * (pressure - mixture.part[1].cold) / before};
    part[GAS_FRACTION] = fraction;
    part[GAS_SECOND] = number[GAS_SECOND] + gain * mass[1];
    part[GAS_DENSITY] = number[GAS_DENSITY] + gain * (mass[1] - mass[0]);
    for (int axis = 0; axis < 3; axis++)
        part[GAS_MOMENTUM + axis] = part[GAS_DENSITY] * here->of[axis];
    part[GAS_ENERGY] =
        number[GAS_ENERGY] - kinetic_of(number) + gain * (heat[1] - heat[0]) + kinetic_of(part);
    if (gas->layout.afterburns)
        part[GAS_AFTERBURNT] = here->afterburnt * part[GAS_SECOND];
}

/* How the conserved numbers of a cell of one material change along an axis. */
static void conserved_slope(const struct gas *gas, const double *number,
                            const double *const beside[2], double slope[GAS_NUMBERS])
{
    bool alike = beside[0] && beside[1];
    for (int side = 0; side < 2 && alike && gas->layout.two; side++)
        alike = beside[side][GAS_FRACTION] == number[GAS_FRACTION];
    for (int n = 0; n < GAS_NUMBERS; n++)
        slope[n] = alike ? gas_lesser(number[n] - beside[0][n], beside[1][n] - number[n]) : 0.0;
}

void gas_divide(const struct gas *gas, const double *number, const double *(*beside)[2],
                const double upper[3], double (*part)[GAS_FIELDS])
{
    const int dimension = gas->cells->dimension;
    const struct gas_inner here = gas_inner_of(gas, number);
    const bool both = here.kind == CONTENT_BOTH;
    double slope[3][GAS_NUMBERS] = {{0.0}}, volume[3] = {0.0};
    bool holds = true;
    for (int axis = 0; axis < dimension; axis++)
        if (!both)
            conserved_slope(gas, number, beside[axis], slope[axis]);
        else if (beside[axis][0] && beside[axis][1])
            volume[axis] = gas_lesser(number[GAS_FRACTION] - beside[axis][0][GAS_FRACTION],
                                      beside[axis][1][GAS_FRACTION] - number[GAS_FRACTION]);
    for (int k = 0; k < 1 << dimension; k++) {
        double fraction = both ? number[GAS_FRACTION] : 0.0;
        memcpy(part[k], number, GAS_FIELDS * sizeof *number);
        for (int axis = 0; axis < dimension; axis++) {
            const double by = k >> axis & 1 ? 0.5 - 0.5 * upper[axis] : -0.5 * upper[axis];
            fraction += by * volume[axis];
            for (int n = 0; n < GAS_NUMBERS && !both; n++)
                part[k][n] += by * slope[axis][n];
        }
        if (both)
            share(gas, &here, number, fraction, part[k]);
        else if (gas->layout.two)
            part[k][GAS_SECOND] = here.kind == CONTENT_SECOND ? part[k][GAS_DENSITY] : 0.0;
        if (gas->layout.afterburns)
            part[k][GAS_AFTERBURNT] = here.afterburnt * part[k][GAS_SECOND];
        holds &= gas_pressure_of(gas, part[k]) > GAS_LEAST * here.of[INNER_PRESSURE];
    }
    for (int k = 0; k < 1 << dimension && !holds; k++)
        memcpy(part[k], number, GAS_FIELDS * sizeof *number);
}

void gas_settle(const struct gas *gas, double *number)
{
    const struct eos *const eos[2] = {&gas->eos[0], &gas->eos[1]};
    double *fraction = &number[GAS_FRACTION], *second = &number[GAS_SECOND];
    const double density = number[GAS_DENSITY];
    const bool none = *fraction < MIXTURE_NONE[1], all = 1.0 - *fraction < MIXTURE_NONE[0];
    *fraction = none ? 0.0 : all ? 1.0 : *fraction;
    *second = none ? 0.0 : all ? density : minimum(maximum(*second, 0.0), density);
    if (gas->thaws && *fraction > MIXTURE_TRACE && *fraction < 0.999) {
        const double mass[2] = {density - *second, *second};
        *fraction = mixture_thawed(eos, mass, *fraction, number[GAS_ENERGY] - kinetic_of(number));
    }
}
