/* Measures: what a check finds out about the particles of a moment. A measure is a choice of the
 * catalogue's kind "measure"; its thing is a struct measure_class. To add one: its file
 * measure_<name>.c, its class below, its line in measure.c. */
#ifndef BOLIDE_MEASURE_H
#define BOLIDE_MEASURE_H

#include "exact/exact.h"
#include "model/views.h"

/* What a measure may look at. */
struct measurement {
    const struct simulation *simulation;
    const struct views *views;
    const struct totals *start; /* at time zero */
    const struct check_input *check;
    const char *name;                /* of the check, for messages */
    const struct exact_class *exact; /* NULL: nothing to compare with */
    const void *solved;
};

struct measure_class {
    bool needs_exact;
    bool of_field; /* the parameters start with a struct measure_field */
    /* The SI unit of the value, "" for a ratio; an ERROR_INPUT when the measure makes no sense
     * here. */
    struct error *(*unit)(const struct measurement *measurement, const char **unit);
    /* The value; NAN when there is nothing to measure (no particle in the window, no front). */
    struct error *(*measure)(const struct measurement *measurement, double *value);
};

struct measure_field {
    char *field; /* a view or one component of it: "pressure", "velocity.x" */
};

struct measure_front {
    char *field;
    struct quantity value; /* of the field at the front */
    int from;              /* enum front_end */
    double slab;           /* m; particles are averaged over slabs of this thickness; 0: not */
};
enum front_end { FRONT_FROM_LOW, FRONT_FROM_HIGH };

struct measure_conserved {
    int total; /* enum conserved_total */
};
enum conserved_total {
    CONSERVED_MASS,
    CONSERVED_MOMENTUM,
    CONSERVED_ANGULAR_MOMENTUM,
    CONSERVED_ENERGY
};

/* Relative change since START of a total of SIMULATION, less what the ledger booked. Mass is
 * measured by its start value, momentum by sum m|u|, angular momentum by sum m|u| times the size of
 * the cloud of particles about the origin, energy by the largest of total, kinetic and internal
 * energy, now or at the start. Collective. */
double conserved_change(const struct simulation *simulation, const struct totals *start,
                        enum conserved_total total);

enum { MEASURES = 11 };
extern const struct choice measure_choices[MEASURES];

extern const struct parameter measure_field_table[];
extern const struct parameter measure_front_table[], measure_conserved_table[];
extern const struct measure_class measure_mean, measure_minimum, measure_maximum, measure_l1,
    measure_rms, measure_max_error, measure_contact_max, measure_contact_rms, measure_front,
    measure_conserved, measure_finite;

/* One particle as a measure sees it. */
struct sample {
    double at; /* position along the check's axis */
    double value, volume;
    int body;
};

struct samples {
    int64_t count;
    struct sample *at;
};

/* The unit of the check's field; ERROR_INPUT when there is no such field or it has several
 * components. */
struct error *measure_field_unit(const struct measurement *measurement, const char **unit);
struct error *measure_no_unit(const struct measurement *measurement, const char **unit);

/* The owned particles that the check speaks of (`of`, `between`) with the values of its field. */
struct error *samples_take(const struct measurement *measurement, struct samples *samples);
void samples_free(struct samples *samples);
/* Sorts by position, low first. */
void samples_sort(struct samples *samples);

/* On which side of the contact a body started: the side of the middle of its shape. A particle is
 * compared with the exact state of its own body's side, wherever it drifted. */
enum exact_side measure_side(const struct measurement *measurement, int body);

/* The member of STATE that a field of particles corresponds to; NAN when it has none. */
double exact_field(const struct exact_state *state, const char *field);

/* An ERROR_INPUT at the check in the case file. */
struct error *measure_error(const struct measurement *measurement, const char *format, ...)
    BOLIDE_PRINTF(2, 3);

#endif
