/* The columns of a population: which it has, and reading them by slices. */
#ifndef BOLIDE_COLUMNS_H
#define BOLIDE_COLUMNS_H

#include "model/population.h"

/* Fills COLUMNS, COLUMNS_MAX at most, with those that POPULATION has, and returns how many: every
 * double field of the store that is declared with a unit, and from them speed, stress (6) and
 * equivalent_stress, temperature where all materials have a heat capacity; of particles that were
 * made from a case also diameter and displacement. */
int columns_make(const struct population *population, struct column *columns);

/* Finds "pressure", or one component of a column: "velocity.x", "stress.xx". *component is -1 for a
 * whole column. NULL when there is none. */
const struct column *column_find(const struct population *population, const char *name,
                                 int *component);

/* The same for a NAME that must be one number a member: ERROR_INPUT, not located, when there is
 * none or it has several components. MORE are COUNT other words that would have been right, for
 * suggestions. */
struct error *column_choose(const struct population *population, const char *name,
                            const char *const *more, int count, const struct column **column,
                            int *component);

/* What COMPONENT of a column of COMPONENTS is called: "x", "xy"; "" for that of a scalar. */
const char *column_component_name(int components, int component);

/* Whether a component means something in DIMENSION dimensions: of a vector those along the axes
 * that the case has, of a tensor those on the diagonal too, since stress acts along all three. */
bool column_component_shown(int components, int component, int dimension);

/* Copies COLUMN of the members begin .. end - 1 of POPULATION to OUT. */
void column_read(const struct population *population, const struct column *column, int64_t begin,
                 int64_t end, double *out);

/* The same for one component of it. */
void column_read_component(const struct population *population, const struct column *column,
                           int component, int64_t begin, int64_t end, double *out);

#endif
