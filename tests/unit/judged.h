/* All that is found in a case before it runs. */
#ifndef BOLIDE_TEST_JUDGED_H
#define BOLIDE_TEST_JUDGED_H

#include "run/judge.h"

/* FINDINGS are those of the result, which the caller frees. */
static inline struct judgement judged(const struct simulation_case *input,
                                      struct findings *findings)
{
    const struct ranks alone = ranks_alone();
    struct simulation simulation;
    struct error *error = simulation_create(input, &alone, 1, &simulation);
    if (error)
        fail_msg("%s", error_message(error, 0));
    struct judgement judgement = judge_solver(&simulation);
    judge_bodies(&judgement);
    simulation_destroy(&simulation);
    *findings = judgement.findings;
    return judgement;
}

#endif
