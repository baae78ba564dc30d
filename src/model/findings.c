/* Lists of findings; see findings.h. */
#include "model/findings.h"

#include <stdlib.h>

#include "base/memory.h"
#include "model/solver.h"

void finding_add(struct findings *findings, enum severity severity, const char *section,
                 const char *name, const char *format, ...)
{
    if (error_is_full(findings->of[severity])) { /* it is counted only */
        findings_take(findings, severity, error_new(ERROR_INPUT, "%s", section));
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    char *text = text_vformat(format, arguments);
    va_end(arguments);
    findings_take(findings, severity,
                  text ? input_error(findings->input, section, name, "%s", text) : out_of_memory());
    free(text);
}

void findings_take(struct findings *findings, enum severity severity, struct error *error)
{
    findings->of[severity] = error_join(findings->of[severity], error);
}

int findings_count(const struct findings *findings, enum severity severity)
{
    return findings->of[severity] ? error_count(findings->of[severity]) : 0;
}

const char *findings_text(const struct findings *findings, enum severity severity, int index)
{
    return error_message(findings->of[severity], index);
}

struct error *findings_refusal(struct findings *findings)
{
    struct error *error = findings->of[FINDING_WRONG];
    findings->of[FINDING_WRONG] = NULL;
    return error;
}

void findings_free(struct findings *findings)
{
    for (int severity = 0; severity < SEVERITIES; severity++)
        error_free(findings->of[severity]);
    *findings = (struct findings){0};
}

struct judgement judge_with(const struct solver_class *solver, const void *parameters,
                            const struct simulation *simulation)
{
    struct judgement judgement = {.findings = {.input = simulation->problem->input},
                                  .largest_jump = INFINITY};
    if (solver->judge)
        solver->judge(parameters, simulation, &judgement);
    return judgement;
}
