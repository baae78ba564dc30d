/* Probes: what is recorded while a case runs, one table a probe: in memory where a check reads it,
 * and as probes/NAME.csv. A probe is a choice of the catalogue's kind "probe"; its thing is a
 * struct probe_class. To add one: its file probe_<name>.c, and below the struct of its parameters
 * and its line in the list.
 * Source of what is recorded: Parshikov (2013), chapter 3: tracers, fronts at half amplitude. */
#ifndef BOLIDE_PROBES_H
#define BOLIDE_PROBES_H

#include "base/csv.h"
#include "measure/fields.h"
#include "measure/measure.h"

struct probe_column {
    char name[72];
    char unit[DIMENSION_TEXT], rate[DIMENSION_TEXT]; /* its own, and that of its rate of change */
};

enum { PROBE_COLUMNS = 1 + FIELDS_MAX };

struct probe {
    const char *name;
    const struct probe_input *input;
    int stored; /* its number in the checkpoint that is loaded; -1: it begins with the resume */
    struct selection selection; /* what `of`, `axis` and `between` say */
    struct chosen_fields *fields;
    int columns; /* the first is the time */
    struct probe_column *column;
    int64_t rows, due; /* taken; times that `every` has passed */
    int64_t step;      /* of the last row */
    uint64_t id;       /* tracer: of its particle, known from the first row on */
    uint64_t order;    /* of the store, for which `index` and `near` hold */
    int32_t index;     /* tracer */
    int32_t *near;     /* gauge, line: the members that may count, by number; NULL: not known */
    int64_t nears, near_room;
    void *solved;  /* gauge: the exact solution that is recorded beside it; NULL: none */
    double failed; /* tracer: when its particle failed, s; -1: it has not, or it had at the start */
    bool kept;     /* a check reads the rows */
    double *value;
    int64_t room;
    bool writes; /* the rows that are not in the file yet: */
    char *text;
    int64_t text_bytes, text_room;
    char *path;
    struct csv_mark mark; /* of the rows that the last checkpoint counts */
};

/* Keys of a probe that not every kind takes. */
enum probe_keys { PROBE_TAKES_OF = 1, PROBE_TAKES_FIELDS = 2, PROBE_TAKES_AXIS = 4 };

struct probe_class {
    unsigned takes; /* enum probe_keys */
    /* Adds the columns behind the time. ERROR_INPUT, located, for what makes no sense. */
    struct error *(*prepare)(struct probe *probe, const struct simulation *simulation,
                             const struct population *population);
    /* Fills ROW, a number for each column behind the time; NAN where there is nothing.
     * Collective. */
    struct error *(*sample)(struct probe *probe, const struct simulation *simulation,
                            const struct population *population, double *row);
};

struct probe_tracer {
    struct vector_value at;
};

struct probe_gauge {
    struct vector_value at;
    double radius; /* m; NAN: the case's resolution */
};

struct probe_line {
    struct vector_value from, to;
    int64_t points;
    double radius; /* m; NAN: by the case's resolution */
};
/* Its columns are called by their field and their distance from the first point, in m. */
#define PROBE_LINE_AT " at "

struct probe_body {
    char *name;
};

struct probe_check {
    char *name;
};

/* X(name, parameters, help): a key of a probe, its struct <parameters> and <parameters>_table, and
 * its probe_<name>, a struct probe_class. */
#define PROBE_LIST(X)                                                                             \
    X(tracer, probe_tracer, "fields of one particle, which it follows")                           \
    X(gauge, probe_gauge, "fields at a fixed position: means over the particles near it")         \
    X(line, probe_line, "fields at equal distances on a straight line, as many gauges have them") \
    X(body, probe_body, "motion of a body: mass, centre, momentum, rotation, energy, extents")    \
    X(check, probe_check, "what a check measures, over time")                                     \
    X(front, measure_front, "position where a field first crosses a value, seen from one end")

#define PROBE_DECLARE(name, parameters, help)           \
    extern const struct parameter parameters##_table[]; \
    extern const struct probe_class probe_##name;
PROBE_LIST(PROBE_DECLARE)
#undef PROBE_DECLARE

#define PROBE_COUNT(name, parameters, help) +1
enum { PROBES = 0 PROBE_LIST(PROBE_COUNT) };
extern const struct choice probe_choices[PROBES];

/* All probes of a run. */
struct probes {
    int count;
    struct probe *item;
};

/* Makes the probes of INPUT; probes_prepare then finds what they look at, with all mistakes joined
 * in one ERROR_INPUT. */
struct error *probes_create(const struct simulation_case *input, struct probes *probes);
struct error *probes_prepare(struct probes *probes, const struct simulation *simulation,
                             const struct population *population);
void probes_free(struct probes *probes);

/* Opens FOLDER/probes/NAME.csv of each where this rank WRITES; with RESUME behind the rows that
 * were taken, which are read back where a check wants them. */
struct error *probes_open(struct probes *probes, const char *folder, bool resume, bool writes);

/* Takes the rows that are due at this step; those of the last step with LAST. Collective. */
struct error *probes_watch(struct probes *probes, const struct simulation *simulation,
                           const struct population *population, bool last);

/* Hands all rows to the system, and marks them: before a checkpoint that counts them; and ends
 * writing. A probe's file is open only while rows go into it: there may be more probes than a
 * process may have open files. */
struct error *probes_mark(struct probes *probes);
struct error *probes_close(struct probes *probes);

/* Counts the times that are due as if each probe had been watched up to TIME. */
void probes_catch_up(struct probes *probes, double time);

/* What a resumed run needs. */
struct error *probes_visit(struct probes *probes, struct visitor *visitor);
/* ERROR_SYSTEM when PROBES, just loaded, have more rows than STEPS give, or others that no run
 * writes. */
struct error *probes_check_loaded(const struct probes *probes, int64_t steps);

/* The probe called NAME, NULL when there is none. */
struct probe *probes_find(const struct probes *probes, const char *name);
/* Where a gauge stands; NULL for other probes. */
const struct vector_value *probe_place(const struct probe *probe);

/* For measures: the probe NAME and the column WANTED of it; without an error the column is past the
 * last where the probe has a mistake of its own, which is reported. */
struct error *measure_find_record(const struct measurement *measurement, const char *name,
                                  const char *wanted, struct probe **probe, int *column);

/* The square of the distance between two places. */
static inline double distance_square(const struct vector_value *place, const double at[3])
{
    double sum = 0.0;
    for (int i = 0; i < place->count; i++)
        sum += square(at[i] - place->at[i]);
    return sum;
}

/* The distance from a point within which member INDEX counts where RADIUS is asked for. A cell that
 * is not of the finest level counts wherever the point may lie in it. */
static inline double probe_reach(const struct population *population, int32_t index, double radius)
{
    const double size = population->size ? population->size[index] : 0.0;
    return size > 1.5 * population->edge
               ? maximum(radius, 0.501 * sqrt((double)population->dimension) * size)
               : radius;
}

/* For the kinds: the members that IS_NEAR, with CONTEXT, says yes to become those of `near`. Cells
 * stay where they are: theirs are found once. */
typedef bool probe_is_near(const void *context, const struct population *population, int32_t index);
struct error *probe_find_near(struct probe *probe, const struct population *population,
                              probe_is_near *is_near, const void *context);

/* For the kinds: whether PLACE, which KEY gives, has a number a dimension; columns for the fields
 * that the case names, which are chosen here, behind those that are chosen already. */
struct error *probe_check_place(const struct probe *probe, const struct simulation *simulation,
                                const char *key, const struct vector_value *place);
struct error *probe_add_fields(struct probe *probe, const struct simulation *simulation,
                               const struct population *population);

/* For the kinds: a new column, and a mistake at KEY ("" for the probe as a whole) of PROBE. */
void probe_add_column(struct probe *probe, const char *name, const char *unit);
struct error *probe_error(const struct probe *probe, const struct simulation *simulation,
                          const char *key, const char *format, ...) BOLIDE_PRINTF(4, 5);

#endif
