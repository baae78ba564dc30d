/* How the state changes inside a cell: where cells of one level take the place of those of another,
 * be it beyond an end of a block or when levels change. Private to gas/. */
#ifndef BOLIDE_GAS_INNER_H
#define BOLIDE_GAS_INNER_H

#include "gas/gas_internal.h"

/* What changes linearly: velocity, pressure, the fraction of the volume of the second material, and
 * each material's own density. Of a contact at one pressure between two uniform materials nothing
 * changes but the fraction. */
enum { INNER_PRESSURE = 3, INNER_FRACTION, INNER_DENSITY, INNERS = INNER_DENSITY + 2 };

struct gas_inner {
    double of[INNERS];
    uint8_t kind;      /* enum content_kind */
    double energy;     /* specific, J/kg */
    double afterburnt; /* of the mass of the second material */
};

/* That of a cell whose fields that sweeps write are NUMBER. */
struct gas_inner gas_inner_of(const struct gas *gas, const double *number);

/* What HERE changes over its cell along an axis between neighbours PAST and NEXT: limited, and
 * nothing where the neighbours do not tell. */
void gas_inner_slope(const struct gas_inner *past, const struct gas_inner *here,
                     const struct gas_inner *next, double slope[INNERS]);

/* The numbers of the part of HERE at SIDE (0 low, 1 high) of DIMENSION axes with SLOPE; shocks are
 * not among them. */
void gas_inner_part(const struct gas *gas, const struct gas_inner *here, double (*slope)[INNERS],
                    int dimension, const int side[3], double *number);

/* Divides a cell with NUMBER, and neighbours along each axis with those of BESIDE, NULL where they
 * do not tell, into parts whose mean it is: of each conserved number, to rounding. UPPER of the
 * volume lies in the upper parts along each axis. Of a cell of both materials the fraction alone
 * changes. */
void gas_divide(const struct gas *gas, const double *number, const double *(*beside)[2],
                const double upper[3], double (*part)[GAS_FIELDS]);

/* Traces in a cell with NUMBER that are rounding go to the other material, and the second takes as
 * much volume as it needs not to be colder than 0 K. */
void gas_settle(const struct gas *gas, double *number);

/* The pressure of a cell with NUMBER. */
double gas_pressure_of(const struct gas *gas, const double *number);

#endif
