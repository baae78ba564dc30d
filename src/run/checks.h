/* The checks of a case: each measures something, at its time or at the end of the run, and compares
 * it with what the case wants. */
#ifndef BOLIDE_CHECKS_H
#define BOLIDE_CHECKS_H

#include "measure/measure.h"

enum check_verdict {
    CHECK_FAILED,
    CHECK_PASSED,
    CHECK_KNOWN_DEVIATION, /* outside its limits, for the reason that the case states */
    CHECK_PASSES_NOW,      /* within them although the case gives a reason: a failure too */
    CHECK_MEASURED_ONLY,   /* the case gives no limit */
};

/* One line of the table; SI units. It stands by itself when the run is gone. */
struct check_result {
    char *name, *source;     /* source may be NULL */
    char *known_deviation;   /* its reason; else NULL */
    char *nothing;           /* why what was measured is not finite; else NULL */
    bool regression_bound;   /* the limit bounds the change from an earlier result of Bolide, */
    struct quantity changes; /* by this fraction of the error or this quantity */
    const char *measure;     /* static text */
    char unit[DIMENSION_TEXT];
    double measured, time; /* s, when it was measured; NAN: never */
    double wanted;         /* NAN: there are only limits */
    double low, high;      /* allowed from .. to; -INFINITY, INFINITY: no limit */
    enum check_verdict verdict;
};

static inline bool check_failed(const struct check_result *result)
{
    return result->verdict == CHECK_FAILED || result->verdict == CHECK_PASSES_NOW;
}

struct check_results {
    int count, failed, known_deviations, measured_only;
    int regression_bounds; /* passed, with such a bound */
    struct check_result *item;
};

/* What a resumed run must remember of a check: numbers only, as a checkpoint takes them. */
struct check_memory {
    double start;          /* what is wanted from time zero; NAN: nothing */
    double measured, time; /* of one whose time has come, and when that was; NAN: it has not */
    double why;            /* enum nothing: of a value that is not finite */
};
enum { CHECK_MEMORY_NUMBERS = sizeof(struct check_memory) / sizeof(double) };

struct checks;

/* The unit of what the check at INDEX measures. */
const char *checks_unit(const struct checks *checks, int index);

/* Readies the checks of a run before its first step: finds their fields in VIEWS, looks at
 * dimensions, solves the exact problems. PROBES (NULL: none), which stay, keep what checks read.
 * All mistakes come joined in one ERROR_INPUT. */
struct error *checks_prepare(const struct simulation *simulation,
                             const struct population *population, const struct probes *probes,
                             struct checks **result);
void checks_free(struct checks *checks);

/* A run's moment: START are the totals at time zero, MEMORY has an entry a check. */
struct check_moment {
    const struct simulation *simulation;
    const struct population *population;
    const struct totals *start;
    struct check_memory *memory;
};

/* Fills the memory at time zero. Collective. */
struct error *checks_start(const struct checks *checks, const struct check_moment *moment);
/* Measures the checks whose time has come, after a step. Collective. */
struct error *checks_watch(const struct checks *checks, const struct check_moment *moment);
/* Measures the others now, and judges all. Collective. */
struct error *checks_evaluate(const struct checks *checks, const struct check_moment *moment,
                              struct check_results *results);

/* The name of the picture that checks_draw makes for the check at INDEX, NULL where it makes
 * none. Free it. */
char *checks_picture(const struct checks *checks, int index);

/* Collective: draws FOLDER/check-FIELD.png for every field that is measured against an exact
 * solution: the solution as a line, the particles as dots, over the check's axis or distance. */
struct error *checks_draw(const struct checks *checks, const struct simulation *simulation,
                          const struct population *population, const char *folder);

/* Counts the item that was filled in after the last one. */
void check_results_count(struct check_results *results);
/* Writes the table as CSV. */
struct error *check_results_write(const struct check_results *results, const char *path);
void check_results_free(struct check_results *results);

/* "1.98 GPa +- 0.02 GPa", "at most 0.03": what is allowed, and the value measured, as a person
 * reads them. BUFFER holds SIZE bytes. */
void check_allowed_text(const struct check_result *result, char *buffer, size_t size);
void check_measured_text(const struct check_result *result, char *buffer, size_t size);
/* "passed", "FAILED", "known deviation", with a reason or a remedy after a colon. Owned by the
 * caller; NULL when memory is out. */
char *check_verdict_text(const struct check_result *result);
/* ERROR_INPUT without a place where QUANTITY, the value of KEY, has not the dimension of WHAT; not
 * given is right too. */
struct error *check_same_dimension(const char *what, const char *key,
                                   const struct quantity *quantity, struct dimension wanted);
/* The interval that CHECK allows to a value of DIMENSION, which WHAT names in messages. ERROR_INPUT
 * without a place. */
struct error *check_find_limits(const struct check_input *check, const char *what,
                                struct dimension dimension, double *wanted, double *low,
                                double *high);
/* Narrows the limits of RESULT, whose measured value and other limits are known, by the regression
 * bound of CHECK, and fills in its verdict, source and reasons. IS_ERROR: what is measured is an
 * error, the smaller the better. */
void check_judge(const struct check_input *check, bool is_error, struct check_result *result);
/* "10 %", "5 MPa": the regression bound of RESULT. */
void check_bound_text(const struct check_result *result, char *buffer, size_t size);
const char *check_verdict_name(enum check_verdict verdict);

#endif
