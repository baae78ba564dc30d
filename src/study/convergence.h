/* Convergence studies: a case on several resolutions, the errors of what its checks measure, and
 * their orders. */
#ifndef BOLIDE_CONVERGENCE_H
#define BOLIDE_CONVERGENCE_H

#include "page/study.h"
#include "study/verify.h"

/* Runs the study of the case at PATH as NAME, its runs into folders in FOLDER/convergence, and
 * fills STUDY, empty before, which the caller frees; study_write puts it into FOLDER. NULL when all
 * wanted orders are there; ERROR_CHECK when one is not, ERROR_INPUT when the case cannot be studied
 * (STUDY has no runs then), the gravest error when a run failed: STUDY then goes without it.
 * Stopped early it has no runs. */
struct error *convergence_run(const char *path, const char *name, const char *folder,
                              const struct verify_options *options, struct study *study);

#endif
