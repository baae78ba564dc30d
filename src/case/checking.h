/* What the checks of a case's meaning share. Private to check*.c. */
#ifndef BOLIDE_CASE_CHECKING_H
#define BOLIDE_CASE_CHECKING_H

#include "case/internal.h"

/* Where a check stands: a path, to which a key may be added. */
struct checking {
    struct simulation_case *input;
    struct error *error;
    const char *map, *name; /* "bodies", "flyer" */
};

enum { PATH_TEXT = 512 };

/* True when the reader complained about KEY or something in it: what it means is not known. */
bool case_is_wrong(const struct checking *checking, const char *key);

/* A complaint about KEY, unless the reader had one already. */
void case_wrong(struct checking *checking, const char *key, const char *format, ...)
    BOLIDE_PRINTF(3, 4);

/* Complains about the key `of` unless OF, which may be NULL, is a body or a population. */
void case_find_members(struct checking *checking, const char *of);

/* The index of NAME in MAP; -1 after a complaint. WHAT is `body` or `material`. */
int case_find_name(struct checking *checking, const struct named_map *map, const char *what,
                   const char *name, const char *key);

bool case_dimension_known(const struct checking *checking);

/* The COUNT components of KEY must be one for each dimension; false after a complaint. */
bool case_check_components(struct checking *checking, const char *key, int count);

/* The case must have AXIS. */
void case_check_axis(struct checking *checking, const char *key, int axis);

/* BETWEEN is nothing or two positions. */
void case_check_between(struct checking *checking, const struct vector_value *between);

/* Of names and texts (check_text.c); texts get into one line. */
void case_check_texts(struct checking *checking);
/* An interval of output must leave a number of them that can be counted. */
void case_check_interval(struct checking *checking, const char *key, double interval);

/* Of checks and the study of convergence (check_check.c). */
void case_check_check(struct checking *checking, int index);
void case_check_fit(struct checking *checking, int index);
/* `repetitions` is a key of the sweep. */
void case_check_repetitions(struct checking *checking);
void case_check_order(struct checking *checking, int index);
void case_check_study(struct checking *checking);
/* `calibrate` (calibrate.c). */
void case_check_calibrate(struct checking *checking);

/* Of what acts from outside (check_outside.c, boundary.c). */
void case_check_domain(struct checking *checking);
void case_check_start(struct checking *checking);
void case_check_map(struct checking *checking, int index);
void case_check_boundary(struct checking *checking, int index);
void case_check_fine(struct checking *checking, int index);
void case_check_load(struct checking *checking, int index);
/* What is driven may follow the time, all of it alike. */
void case_check_driven(struct checking *checking, const struct body_input *body);
void case_check_gravity(struct checking *checking);

#endif
