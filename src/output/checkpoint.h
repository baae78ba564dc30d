/* checkpoint.h5: every array that a resumed run needs, through visitors. */
#ifndef BOLIDE_CHECKPOINT_H
#define BOLIDE_CHECKPOINT_H

#include "model/solver.h"

/* EXTRA shows what the run loop itself must keep (next output times, ...). CASE_TEXT is the case as
 * run, which is stored. */
struct checkpoint {
    struct simulation *simulation;
    const struct solver_class *method;
    void *solver;
    struct error *(*extra)(void *context, struct visitor *visitor);
    void *context;
    const char *case_text;
};

/* Collective: the case as run that the checkpoint at PATH stores, in fresh memory, for whoever is
 * to say whether it may be read with another (case/changes.h). */
struct error *checkpoint_case(const char *path, const struct ranks *ranks, char **text);

/* Collective. All ranks write beside, then rank 0 renames, so that PATH is whole at every moment;
 * every rank reads its share of the particles, on as many ranks as there are. Members have the
 * same bytes on any number of ranks where they have the same order. */
struct error *checkpoint_write(const char *path, const struct checkpoint *checkpoint);
struct error *checkpoint_read(const char *path, const struct checkpoint *checkpoint);

#endif
