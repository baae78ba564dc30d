/* Measures: what a check finds out about the particles of a moment. A measure is a choice of the
 * catalogue's kind "measure"; its thing is a struct measure_class. To add one: its file
 * <name>.c, and below the struct of its parameters and its line in the list. */
#ifndef BOLIDE_MEASURE_H
#define BOLIDE_MEASURE_H

#include "exact/exact.h"
#include "model/columns.h"
#include "model/simulation.h"

struct probes;

/* Why a measure has no finite value. */
enum nothing {
    NOTHING_SAID,
    NOTHING_NO_MEMBER,
    NOTHING_NOT_FINITE,
    NOTHING_NOT_REACHED,
    NOTHING_NOT_RECORDED,
    NOTHING_ONE_ROW,
    NOTHING_NO_PEAKS,
    NOTHING_NO_RISE,
    NOTHING_NO_END,
    NOTHING_NO_EVENT,
    NOTHING_NO_FRAGMENT,
    NOTHING_OPEN,
    NOTHING_NOT_AROUND,
    NOTHING_FEW,
    NOTHING_NO_IMAGE,
    NOTHING_NO_ZONE,
    NOTHING_NO_ROWS,
    NOTHING_NO_RANGE,
    NOTHING_ADDED_LATE,
    NOTHING_REASONS
};
/* The reason in words. */
const char *nothing_text(enum nothing why);

/* What a measure may look at. */
struct measurement {
    const struct simulation *simulation;
    const struct population *population;
    const struct probes *probes; /* NULL: there are none */
    const struct totals *start;  /* at time zero */
    const struct check_input *check;
    const char *name;                /* of the check, for messages */
    bool unplaced;                   /* messages are only counted: to find their place takes long */
    const struct exact_class *exact; /* NULL: nothing to compare with */
    const void *solved;
    double at_start;   /* what the class kept from time zero */
    enum nothing *why; /* filled where the value is not finite; NULL: nobody asks */
};

/* NAN, for the reason WHY. */
double measure_nothing(const struct measurement *measurement, enum nothing why);

struct measure_class {
    bool needs_exact;
    bool needs_contact; /* an exact solution that has one */
    bool of_field;      /* the parameters start with a struct measure_field */
    /* The SI unit of the value, "" for a ratio, NULL where it hangs on something that is wrong
     * itself; an ERROR_INPUT when the measure makes no sense here. */
    struct error *(*unit)(const struct measurement *measurement, const char **unit);
    /* Collective: the value; NAN when there is nothing to measure (no particle in the window, no
     * front). */
    struct error *(*measure)(const struct measurement *measurement, double *value);
    bool of_bodies; /* of whole bodies: `between` has no meaning */
    bool of_run;    /* of what a run did until now, not of a moment */
    /* What the measure wants to keep from time zero; may be NULL. */
    struct error *(*start)(const struct measurement *measurement, double *value);
    /* What the exact solution says that the value is, for a check that has `within` and no `is`;
     * NAN where it says nothing. May be NULL. */
    double (*expected)(const struct measurement *measurement);
};

struct measure_field {
    char *field; /* a column or one component of it: "pressure", "velocity.x" */
};

/* A statistic over members, each of which counts by its number, mass or volume. */
struct measure_weighted {
    struct measure_field of;
    int weight; /* enum weighing */
};

struct measure_quantile {
    struct measure_field of;
    double fraction;
    int weight; /* enum weighing */
};

struct measure_front {
    char *field;
    struct quantity value; /* of the field at the front; NAN: not given */
    bool half;             /* it is half the jump instead */
    int from;              /* enum front_end */
    double slab;           /* m; particles are averaged over slabs of this thickness; 0: not */
    double frame;          /* m/s, of the frame in which the place is given */
};
struct measure_width {
    char *field;
    struct quantity ahead, behind; /* of the field */
};
struct measure_event {
    char *name;
};
struct measure_recorded {
    char *probe, *column;
    int take;             /* enum take of recorded.c */
    double after, before; /* s; NAN: the whole run */
    char *when;           /* another column; NULL: any time */
    struct quantity reaches;
    bool absolute;
    char *less;            /* another probe; NULL: none */
    double less_mean;      /* s; NAN: nothing is subtracted */
    struct quantity noise; /* NAN: a hundredth of the range */
};
enum front_end { FRONT_FROM_LOW, FRONT_FROM_HIGH };

struct measure_blast {
    char *probe;
    int take;               /* enum blast_take of blast.c */
    double ambient, before; /* Pa, NAN: the first recorded; s, NAN: the whole run */
};

struct measure_conserved {
    int total; /* enum conserved_total */
};
enum conserved_total {
    CONSERVED_MASS,
    CONSERVED_MOMENTUM,
    CONSERVED_ANGULAR_MOMENTUM,
    CONSERVED_ENERGY
};

/* total, decay: momentum.x, kinetic_energy, ... */
struct measure_total {
    int quantity;
};

struct measure_extent {
    int along; /* x, y, z or the radius */
    bool edges;
};

struct measure_turn {
    int axis;
};

struct measure_pieces {
    double link;
};

struct measure_fragments {
    int take;                     /* enum of fragment_checks.c */
    struct quantity above, below; /* mass; NAN: any */
    double link;
};

struct measure_interface {
    int along;
    char *with;
    double radius; /* m */
    struct vector_value center;
};

struct measure_largest_fragment {
    int take;
    double link;
};

struct measure_length {
    int along;
    double link;
};

struct measure_hole {
    int along;
    double at; /* m; NAN: all along the axis */
    struct vector_value center;
    double link;
};

struct measure_crater {
    int along, side, take;
    struct vector_value center;
    double link;
};

struct measure_bulge {
    int along, side;
    double link;
};

struct measure_perforation {
    int along, side, take;
    struct vector_value center;
    double link;
};

struct measure_zone {
    char *field;
    double value;
    int along, side, take;
    struct vector_value center;
};

struct measure_asymmetry {
    char *field;
    int across, parity;
    struct vector_value center;
};

struct measure_radius {
    double start;
    int take;
    double layer; /* NAN: the resolution of the case */
    struct vector_value center;
};

struct measure_shear_layer {
    int value; /* what of the fit */
    double speed, plane;
};

/* Relative change since START of a total of SIMULATION, less what the ledger booked. Mass is
 * measured by its start value, momentum by sum m|u|, angular momentum by sum m|u| times the size of
 * the cloud of particles about the origin, energy by the largest of total, kinetic and internal
 * energy, now or at the start. Collective. */
double conserved_change(const struct simulation *simulation, const struct totals *start,
                        enum conserved_total total);

/* X(name, parameters, help): a key of a check, its struct measure_<parameters> and
 * measure_<parameters>_table, and its measure_<name>, a struct measure_class. */
#define MEASURE_LIST(X)                                                                           \
    X(mean, weighted, "mean of a field over particles")                                           \
    X(minimum, field, "smallest value of a field")                                                \
    X(maximum, field, "largest value of a field")                                                 \
    X(quantile, quantile, "value of a field that a fraction of the particles does not exceed")    \
    X(l1, field, "mean distance of a field from the exact solution, by volume, over `scale`")     \
    X(rms, field,                                                                                 \
      "root of the mean square distance from the exact solution, by volume, over `scale`")        \
    X(max_error, field, "largest distance from the exact solution, over `scale`")                 \
    X(contact_max, field,                                                                         \
      "largest |f/f* - 1| of the 10 particles nearest the contact on either side")                \
    X(contact_rms, field, "root mean square of f/f* - 1 of the same 20 particles")                \
    X(front, front, "position where a field first crosses a value, seen from one end")            \
    X(width, width, "number of particles in a front, between 10 and 90 % of its jump")            \
    X(conserved, conserved,                                                                       \
      "relative change of a total since the start, less what the ledger booked")                  \
    X(total, total, "a sum over particles: momentum.x, kinetic_energy")                           \
    X(decay, total, "decay rate of such a sum: the logarithm of start over now, over the time")   \
    X(spread, weighted, "standard deviation of a field over particles")                           \
    X(extent, extent,                                                                             \
      "width of a body along an axis between its outermost particles, or its radius")             \
    X(turn, turn, "rotation angle of a body since the start, within half a turn")                 \
    X(pieces, pieces, "number of pieces into which bodies are broken")                            \
    X(fragments, fragments,                                                                       \
      "number of fragments into which bodies have broken, failed particles aside")                \
    X(largest_fragment, largest_fragment, "mass, size or velocity of the heaviest fragment")      \
    X(length, length, "length of the heaviest fragment of a body along an axis, debris aside")    \
    X(hole, hole, "diameter of the hole in a body about an axis; 0 if there is none")             \
    X(crater, crater, "depth, diameter or volume of a crater below the original face of a body")  \
    X(interface, interface, "where two bodies meet on an axis: the floor of a hole around a rod") \
    X(bulge, bulge, "how far a body has been pushed out of one of its faces")                     \
    X(perforation, perforation,                                                                   \
      "hole, least thickness left, or mass that came through, of a wall that was struck")         \
    X(zone, zone, "diameter or shape of the part of a face in which a field reaches a value")     \
    X(asymmetry, asymmetry,                                                                       \
      "largest difference of a field from its mirror image, over its largest value")              \
    X(radius, radius, "radius of a material circle or sphere, estimated from adjacent particles") \
    X(shear_layer, shear_layer, "effective viscosity with which two sliding streams mix")         \
    X(recorded, recorded, "number from the record of a probe")                                    \
    X(blast, blast, "peak, arrival, duration or impulse of a blast wave at a probe")              \
    X(event, event,                                                                               \
      "time at which the solver does something that it does once: the stages of `afdmp`")         \
    X(finite, field, "number of particles whose field is not a finite number")

#define MEASURE_DECLARE(name, parameters, help)                   \
    extern const struct parameter measure_##parameters##_table[]; \
    extern const struct measure_class measure_##name;
MEASURE_LIST(MEASURE_DECLARE)
#undef MEASURE_DECLARE

#define MEASURE_COUNT(name, parameters, help) +1
enum { MEASURES = 0 MEASURE_LIST(MEASURE_COUNT) };
extern const struct choice measure_choices[MEASURES];

/* One particle as a measure sees it. */
struct sample {
    double at; /* position along the check's axis, or distance from its point */
    double value, volume, mass;
    int body;
};

/* What SAMPLE counts by. */
static inline double sample_weight(const struct sample *sample, int weight)
{
    return weight == WEIGHT_MASS ? sample->mass : weight == WEIGHT_VOLUME ? sample->volume : 1.0;
}

struct samples {
    int64_t count;
    struct sample *at;
};

/* The unit of the check's field; ERROR_INPUT when there is no such field or it has several
 * components. */
struct error *measure_field_unit(const struct measurement *measurement, const char **unit);
struct error *measure_no_unit(const struct measurement *measurement, const char **unit);

/* Which particles are looked at. */
struct selection {
    int body;                    /* -1: all */
    int axis;                    /* along which they stand */
    struct vector_value between; /* count 0: everywhere */
    struct vector_value about;   /* places are distances from this point; count 0: along the axis */
};

/* The owned particles of SELECTION with COMPONENT of COLUMN. */
struct error *samples_select(const struct population *population, const struct column *column,
                             int component, const struct selection *selection,
                             struct samples *samples);
/* The index of the body that the check is `of`, -1 for all. */
int measure_body(const struct measurement *measurement);
/* Whether the check speaks of particle I of BODY (-1: all), by `between`. */
bool measure_takes(const struct measurement *measurement, int body, int32_t i);

/* Collective: the mean of the places AT of the particles of BODY (-1: all), by mass. */
struct vec3 measure_center(const struct measurement *measurement, const double (*at)[3], int body);

/* Collective: the owned particles that the check speaks of (`of`, `between`) with the values of its
 * field. */
struct error *samples_take(const struct measurement *measurement, struct samples *samples);
void samples_free(struct samples *samples);
/* Sorts by position, low first, and by value at the same place; below zero where A comes before
 * B. */
void samples_sort(struct samples *samples);
int sample_order(const struct sample *a, const struct sample *b);

/* Whether FRONT makes sense for a field of UNIT: an ERROR_INPUT, not located, where it does not. */
struct error *front_check(const struct measure_front *front, const char *unit);

/* Collective: where the samples OWN of all ranks at TIME, which it may replace by averages, first
 * cross the value of FRONT, told in its frame; NAN where they do not. *level is that value. */
struct error *front_place(const struct ranks *ranks, struct samples *own,
                          const struct measure_front *front, double time, double *place,
                          double *level);

/* The side of the contact that SAMPLE is compared with. A particle belongs to the side on which its
 * body started, that of the middle of the body's shape, wherever it drifted; a cell to the side on
 * which it lies now. */
enum exact_side measure_side(const struct measurement *measurement, const struct sample *sample);

/* The member of STATE that a field of particles corresponds to; NAN when it has none. */
double exact_field(const struct exact_state *state, const char *field);

/* The distance of PLACE from the centre of an exact solution. */
double exact_distance(const struct exact_class *exact, const void *solved,
                      const struct vector_value *place);

/* An ERROR_INPUT at the check in the case file. */
struct error *measure_error(const struct measurement *measurement, const char *format, ...)
    BOLIDE_PRINTF(2, 3);

/* ERROR (NULL stays NULL), which it takes, told at the check. */
struct error *measure_located(const struct measurement *measurement, struct error *error);

#endif
