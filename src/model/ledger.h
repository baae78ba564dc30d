/* The ledger books what enters or leaves the particles, by cause, as exact sums: a conserved
 * quantity is the total of the particles less the ledger. */
#ifndef BOLIDE_LEDGER_H
#define BOLIDE_LEDGER_H

#include "base/vector.h"
#include "base/visitor.h"
#include "case/case.h"
#include "model/population.h"
#include "parallel/ranks.h"

/* Walls that push; the axis of symmetry, whose hoop stress does; what holds bodies (`driven`,
 * `stop`); gravity; what pushes on surfaces; faces that particles leave through; bodies that are
 * taken away; what slows bodies (`damping`); products that burn in air; what waits between the
 * parts of a coupling. */
enum ledger_cause {
    LEDGER_WALLS,
    LEDGER_AXIS,
    LEDGER_PISTONS,
    LEDGER_GRAVITY,
    LEDGER_LOADS,
    LEDGER_OUTFLOWS,
    LEDGER_REMOVED,
    LEDGER_DAMPING,
    LEDGER_AFTERBURN,
    LEDGER_EXCHANGE,
    LEDGER_CAUSES
};

/* kg, kg m/s, kg m^2/s, J; in a plane problem per metre of depth, in 1-D per square metre, in
 * axisymmetry per radian. */
enum ledger_entry {
    LEDGER_MASS,
    LEDGER_MOMENTUM_X,
    LEDGER_MOMENTUM_Y,
    LEDGER_MOMENTUM_Z,
    LEDGER_ANGULAR_X,
    LEDGER_ANGULAR_Y,
    LEDGER_ANGULAR_Z,
    LEDGER_ENERGY,
    LEDGER_ENTRIES
};

struct ledger {
    struct exact_sum sum[LEDGER_CAUSES][LEDGER_ENTRIES];
};

/* Total of the particles, or of the ledger over all causes and ranks. */
struct totals {
    double entry[LEDGER_ENTRIES];
    double kinetic, internal;
    double momentum_scale; /* sum of m |u|, against which a drift of momentum is judged */
    double released;       /* of the start alone: energy that the pressures can set free */
};

const char *ledger_cause_name(enum ledger_cause cause);

/* Name of an entry, and its unit in columns: of mass "kg/m^2", "kg/m" or "kg", in axisymmetry
 * "kg/rad". */
const char *ledger_entry_name(enum ledger_entry entry);
const char *ledger_unit(enum ledger_entry entry, int dimension, enum case_geometry geometry);

/* Books COUNT entries' worth of one particle's gain. */
void ledger_book(struct ledger *ledger, enum ledger_cause cause, double mass, struct vec3 momentum,
                 struct vec3 position, double energy);
void ledger_join(struct ledger *ledger, const struct ledger *other);

/* Collective: what all ranks booked under CAUSE, or under all causes for LEDGER_CAUSES. */
struct totals ledger_totals(const struct ledger *ledger, const struct ranks *ranks,
                            enum ledger_cause cause);

/* Collective: mass, momentum, angular momentum, energy of the members of BODY, of all for -1. The
 * sum of particles is exact, that of cells rounded like eight additions of what a block has. */
struct totals population_totals(struct population population, const struct ranks *ranks, int body);

/* The energy that is neither in NOW nor BOOKED, against the largest energy of NOW and START (the
 * total alone may be next to nothing, a sum of opposites), and at least what the pressures at the
 * start can set free: a case that starts at rest has next to no energy in its first steps. */
double energy_drift(const struct totals *now, const struct totals *booked,
                    const struct totals *start);

/* Collective: loads or saves the sum over all ranks. */
struct error *ledger_visit(struct ledger *ledger, const struct ranks *ranks,
                           struct visitor *visitor);

#endif
