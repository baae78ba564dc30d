/* What is wrong, doubtful or without effect in a case, in one list: the model, the solver and the
 * run add to it; `check`, the log, the verdict and the report show it. */
#ifndef BOLIDE_FINDINGS_H
#define BOLIDE_FINDINGS_H

#include "case/case.h"

enum severity {
    FINDING_NOTE,      /* what something is read as */
    FINDING_DOUBTFUL,  /* possible, but perhaps not what is meant */
    FINDING_NO_EFFECT, /* it does nothing, or contradicts itself */
    FINDING_COARSE,    /* the resolution is too coarse for it */
    FINDING_WRONG,     /* no solver, or not that of the case, can do it */
    SEVERITIES
};

/* Texts are as those of errors, each with its place: `case.yaml:14:9: bodies.flyer: ...`. */
struct findings {
    const struct simulation_case *input;
    struct error *of[SEVERITIES]; /* in the order of finding; NULL: nothing */
};

/* At SECTION.NAME of the case; NAME may be NULL. */
void finding_add(struct findings *findings, enum severity severity, const char *section,
                 const char *name, const char *format, ...) BOLIDE_PRINTF(5, 6);

/* What an error says, which it takes; NULL: nothing. */
void findings_take(struct findings *findings, enum severity severity, struct error *error);

/* How many there are of SEVERITY, and the text of one. */
int findings_count(const struct findings *findings, enum severity severity);
const char *findings_text(const struct findings *findings, enum severity severity, int index);

/* What is wrong, as an error, which the caller then owns. */
struct error *findings_refusal(struct findings *findings);

/* Finds ignitions outside every explosive, or too late for the run (ignitions.c). */
void ignitions_judge(struct findings *findings);

void findings_free(struct findings *findings);

#endif
