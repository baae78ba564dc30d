/* `bolide verify --record`: what cases measured, stored beside them; case/record.h has the file. */
#ifndef BOLIDE_STUDY_RECORD_H
#define BOLIDE_STUDY_RECORD_H

#include "study/verify.h"

/* ERROR_SYSTEM where the record of the case at PATH could not be written when it has been run. */
struct error *record_check(const char *path);

/* Stores what the COUNT runs of the case at PATH, called NAME, measured under READING's form and
 * settings. The rows of other forms and settings stay. */
struct error *record_store(const char *path, const char *name, const struct case_options *reading,
                           const struct verify_case *runs, int count);

/* Compares what the COUNT runs measured with the record instead. ERROR_CHECK that names each value
 * which differs by more than a unit of the last recorded digit, and each verdict and limit that
 * does. Runs give the same bits on every machine, so that no wider tolerance is needed. */
struct error *record_compare(const char *path, const char *name, const struct case_options *reading,
                             const struct verify_case *runs, int count);

#endif
