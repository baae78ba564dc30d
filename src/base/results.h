/* The folder that holds a run's results: whose it is, what in it is the run's own, and a lock,
 * so that two runs do not write into it at the same time. */
#ifndef BOLIDE_RESULTS_H
#define BOLIDE_RESULTS_H

#include "base/error.h"

/* The ERROR_INPUT with which results_begin would refuse FOLDER; changes nothing. */
struct error *results_check(const char *folder, bool overwrite);

/* ERROR_INPUT when a folder inside FOLDER that a run writes into is a symbolic link; results_check
 * looks for that too. */
struct error *results_check_links(const char *folder);

/* Stands for the digits of a number in the name of a file. */
#define RESULTS_NUMBER "\t"

/* Readies FOLDER for the results of a fresh run: makes it, or, when it holds results of a run
 * already, removes those when OVERWRITE is set and refuses with ERROR_INPUT otherwise. Other
 * files stay. NAMES, with a NULL after the last, are the files that the run may write into the
 * folders inside it: "pictures/speed-" RESULTS_NUMBER ".png". They are kept in FOLDER, for the
 * run that overwrites these results. */
struct error *results_begin(const char *folder, bool overwrite, const char *const *names);

/* Adds NAMES to those of the results in FOLDER, which a resumed run writes too. */
struct error *results_add(const char *folder, const char *const *names);

/* A lock on a folder; zeroed: none. */
struct results_lock {
    char *path;
    int descriptor;
};

/* Locks FOLDER, which is there, until results_unlock or the end of the process, whatever ends it.
 * ERROR_INPUT, which names the process, when another one has it. */
struct error *results_lock(const char *folder, struct results_lock *lock);
void results_unlock(struct results_lock *lock);

#endif
