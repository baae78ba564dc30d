/* Bisection of a key of a case on whether one of its checks passes, for a ballistic limit or a
 * minimum thickness. A search is a sweep whose values are chosen as it proceeds: it writes the same
 * table and plots. */
#ifndef BOLIDE_SEARCH_H
#define BOLIDE_SEARCH_H

#include "study/verify.h"

/* The arguments of a search, as the user typed them. */
struct search {
    const char *key;       /* a name of let or a path, as in a sweep */
    const char *from, *to; /* values of the key */
    const char *check;     /* its name */
    const char *within;    /* the interval to end at, or for a key with a unit its fraction of the
                               * value; NULL: a hundredth of the first interval */
};

struct search_result {
    struct verify_result runs;
    int expected; /* runs, from the intervals */
    bool found;
    double passes, fails; /* the nearest values, in UNIT */
    char unit[DIMENSION_TEXT];
};

/* Runs the case at PATH as NAME with both values of SEARCH and then with values between, each in a
 * folder in FOLDER, which also gets the table and the plots of a sweep. ERROR_INPUT before the
 * first run when key, values or check are wrong, and after the second when the check gives the same
 * with both values. A run that does not come to its end ends the search with its error. Free RESULT
 * also after an error. Stopped early nothing is found. */
struct error *search_run(const char *path, const char *name, const char *folder,
                         const struct verify_options *options, const struct search *search,
                         struct search_result *result);
void search_result_free(struct search_result *result);

#endif
