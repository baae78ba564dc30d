/* What is found in a case before it runs: one list, which `check`, the log and the verdict show. */
#ifndef BOLIDE_RUN_JUDGE_H
#define BOLIDE_RUN_JUDGE_H

#include "model/solver.h"

/* What the solver finds in its case; explosives whose constants contradict each other,
 * ignitions and loads without effect, gauges that a blast reaches too weakly. The caller frees its
 * findings. */
struct judgement judge_solver(const struct simulation *simulation);

/* Adds what is found in the bodies of a case that nothing refuses: takes as long as filling
 * them. */
void judge_bodies(struct judgement *judgement);

/* All findings but what is wrong, a line each: `warning: case.yaml:14:9: bodies.flyer: ...`. */
void judge_tell(const struct findings *findings, void (*tell)(void *context, const char *text),
                void *context);

/* Where the constants of an explosive contradict each other, as a detonation speed that is not that
 * of the products: a sentence (to be freed), else NULL. */
char *detonation_wrong(const struct material *material);

#endif
