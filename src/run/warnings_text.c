/* The words of warnings, and those that a case expects. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/material.h"
#include "model/solver.h"
#include "output/report.h"
#include "run/warnings_internal.h"

static const struct {
    const char *name, *unit, *what, *advice;
    double sign; /* of the value that is shown */
} kinds[WARNING_KINDS] = {
    [WARNING_TENSION] = {"tension", "Pa", "mean tension of", NULL, 1.0},
    [WARNING_SPEED] = {"speed", "m/s", "a speed of",
                       "look for an instability of the method or a state outside its models", 1.0},
    [WARNING_TEMPERATURE] = {"temperature", "K", "a temperature of",
                             "its equation of state ends before this state", -1.0},
    [WARNING_DENSITY] = {"density", "kg/m^3", "a density of", NULL, 1.0},
    [WARNING_INSTABILITY] =
        {"tensile-instability", "", "lasting tension of",
         "SPH bodies creep and break in lasting tension, without a physical cause and with energy "
         "conserved: use `solver: mpm`",
         1.0},
    [WARNING_UNLIT] =
        {"unlit", "kg/m^3", "a density of",
         "it has no pressure until then: use `burn: beta`, or an explosive that a shock starts "
         "(docs/detonation.md)",
         1.0},
    [WARNING_REGION] = {"region", "m", "a solid", "enlarge the `region` of the solver", 1.0},
    [WARNING_ENERGY] = {"energy", "", NULL, NULL, 1.0},
    [WARNING_TRACER] = {"tracer", "", NULL, NULL, 1.0},
    [WARNING_COARSE] = {"coarse", "", NULL, NULL, 1.0},
    [WARNING_INPUT] = {"input", "", NULL, NULL, 1.0},
    [WARNING_LOAD] = {"load", "", NULL, NULL, 1.0},
};

static enum warning_kind kind_of(const struct warnings *warnings, int index)
{
    return index >= warnings->of_loads    ? WARNING_LOAD
           : index > warnings->of_energy  ? WARNING_TRACER
           : index == warnings->of_energy ? WARNING_ENERGY
                                          : (enum warning_kind)(index % WARNING_ENERGY);
}

char *warning_name(const struct warnings *warnings, const struct simulation *simulation, int index)
{
    const enum warning_kind kind = kind_of(warnings, index);
    if (kind == WARNING_ENERGY)
        return text_copy(kinds[kind].name);
    if (kind == WARNING_TRACER)
        return text_format(
            "tracer \"%s\"",
            simulation->problem->input->probes.names[index - warnings->of_energy - 1]);
    if (kind == WARNING_LOAD)
        return text_format("load \"%s\"",
                           simulation->problem->input->loads.names[index - warnings->of_loads]);
    return text_format("%s in %s", kinds[kind].name,
                       simulation->problem->input->materials.names[index / WARNING_ENERGY]);
}

/* What LIMIT is. */
static void put_limit(const struct warnings *warnings, const struct simulation *simulation,
                      int index, double limit, char *text, size_t size)
{
    char value[48];
    const struct material *material = &simulation->problem->material[index / WARNING_ENERGY];
    const enum warning_kind kind = kind_of(warnings, index);
    readable(limit, kinds[kind].unit, value, sizeof value);
    switch (kind) {
    case WARNING_TENSION:
        snprintf(text, size, "%s %s",
                 warnings->watch[index / WARNING_ENERGY].estimated
                     ? "more than an estimate of its strength, K/20 ="
                     : "more than its tensile strength of",
                 value);
        break;
    case WARNING_SPEED:
        snprintf(text, size, "more than %s, three times what the case can cause", value);
        break;
    case WARNING_DENSITY:
        snprintf(text, size, "more than %.3g times that at rest, where its equation of state ends",
                 limit / material_density(material));
        break;
    case WARNING_UNLIT:
        snprintf(text, size, "more than %.3g times that at rest, before the detonation arrives",
                 limit / material_density(material));
        break;
    case WARNING_INSTABILITY:
        snprintf(text, size, "more than the 1 that SPH can hold");
        break;
    case WARNING_REGION:
        snprintf(text, size,
                 "in the cells behind the overlap of a coupling, which the gas sees without it");
        break;
    default:
        snprintf(text, size, "below 0 K");
    }
}

/* The key that limits the tension of the material NAME. */
static void put_remedy(const struct material *material, const char *name, char *text, size_t size)
{
    if (!material_has_strength(material))
        snprintf(text, size,
                 "voids are missing: `materials.%s.eos` does not limit the tension of this fluid",
                 name);
    else if (strength_takes_pressure(&material->strength))
        snprintf(text, size, "see the tension limit of `materials.%s.strength`", name);
    else if (material_fails(material))
        snprintf(text, size, "see the tension limit of `materials.%s.failure`", name);
    else
        snprintf(text, size,
                 "holes and fragments are missing: set `materials.%s.failure` (bolide help "
                 "failure)",
                 name);
}

/* A model without energy lacks the heat of shocks. BUFFER is for advice that names a material. */
static const char *advice_of(const struct simulation *simulation, int index, enum warning_kind kind,
                             char *buffer, size_t size)
{
    const int material = index / WARNING_ENERGY;
    if (kind == WARNING_TENSION) {
        put_remedy(&simulation->problem->material[material],
                   simulation->problem->input->materials.names[material], buffer, size);
        return buffer;
    }
    if (kind != WARNING_DENSITY)
        return kinds[kind].advice;
    const struct eos *eos = &simulation->problem->material[index / WARNING_ENERGY].eos;
    const double none[POINT_HISTORY] = {0.0};
    return eos_evaluate(eos, 2.0 * eos_reference_density(eos), 0.0, none).dp_de == 0.0
               ? "one that depends on energy, such as mie-grueneisen, goes further"
               : "no shock compresses a solid that far";
}

/* Why energy is lost is the solver's to say. */
static char *energy_text(const struct warning_memory *memory, const char *why)
{
    char later[64] = "";
    if (memory->worst > memory->value)
        snprintf(later, sizeof later, ", later by %.2g", memory->worst);
    return text_format(
        "energy: the total energy has drifted by %.2g of the largest energy of the case, first "
        "seen at step %.0f, t = %.6g s%s%s%s; `run: {energy_drift: 5 %%}` makes this an error, "
        "`energy_drift: 0` silences it",
        memory->value, memory->step, memory->time, later, why ? "; " : "", why ? why : "");
}

static char *tracer_text(const struct warnings *warnings, const struct simulation *simulation,
                         int index)
{
    char time[48], *name = warning_name(warnings, simulation, index), *text = NULL;
    readable(warnings->memory[index].time, "s", time, sizeof time);
    if (name)
        text = text_format("%s follows a particle that failed at t = %s: it may have come off and "
                           "fly alone; the outermost particle does so most easily: start the "
                           "tracer two resolutions inside the body",
                           name, time);
    free(name);
    return text;
}

void load_impulse_text(const struct problem *problem, const double impulse[3], char *text,
                       size_t size)
{
    size_t used = (size_t)snprintf(text, size, "%s", problem->dimension > 1 ? "(" : "");
    for (int k = 0; k < problem->dimension; k++)
        used += (size_t)snprintf(text + used, size - used, "%s%.4g", k > 0 ? ", " : "", impulse[k]);
    snprintf(text + used, size - used, "%s %s", problem->dimension > 1 ? ")" : "",
             ledger_unit(LEDGER_MOMENTUM_X, problem->dimension, problem->geometry));
}

/* What a load has delivered and should have is the state now, not that of its first warning. */
static char *load_text(const struct warnings *warnings, const struct simulation *simulation,
                       int index)
{
    const int load = index - warnings->of_loads;
    const struct simulation_case *input = simulation->problem->input;
    const struct warning_memory *memory = &warnings->memory[index];
    const char *body = input->bodies.names[case_load(input, load)->body];
    char time[48], *name = warning_name(warnings, simulation, index), *text = NULL;
    readable(memory->time, "s", time, sizeof time);
    if (name && memory->value == 1.0)
        text = text_format("%s has delivered nothing to body \"%s\": see `bolide check`, and the "
                           "times and the place of the load",
                           name, body);
    else if (name)
        text = text_format(
            "%s has not delivered the impulse of its pressure over the surface of body \"%s\": "
            "%.2g %% apart at t = %s, at most %.2g %%; the columns load.%s of history.csv show "
            "when. A thin part has lost it, or `between` cuts the surface or holds both faces",
            name, body, 100.0 * memory->value, time, 100.0 * maximum(memory->value, memory->worst),
            input->loads.names[load]);
    free(name);
    return text;
}

char *warning_text(const struct warnings *warnings, const struct simulation *simulation, int index)
{
    const struct warning_memory *memory = &warnings->memory[index];
    const enum warning_kind kind = kind_of(warnings, index);
    char value[48], worst[48], time[48], later[128] = "", limit[160], advice[256];
    if (kind == WARNING_ENERGY)
        return energy_text(memory, warnings->judgement->energy_lost);
    if (kind == WARNING_TRACER)
        return tracer_text(warnings, simulation, index);
    if (kind == WARNING_LOAD)
        return load_text(warnings, simulation, index);
    readable(kinds[kind].sign * memory->value, kinds[kind].unit, value, sizeof value);
    put_limit(warnings, simulation, index, memory->limit, limit, sizeof limit);
    if (memory->worst > memory->value) {
        readable(kinds[kind].sign * memory->worst, kinds[kind].unit, worst, sizeof worst);
        readable(memory->worst_time, "s", time, sizeof time);
        snprintf(later, sizeof later, ", at worst %s at t = %s", worst, time);
    }
    char *name = warning_name(warnings, simulation, index);
    readable(memory->time, "s", time, sizeof time);
    char *text =
        name ? text_format("%s: %s %s, %s; first seen at step %.0f, t = %s, in body \"%s\" at (%g, "
                           "%g, %g) m; up to %.0f %s%s at once%s; %s",
                           name, kinds[kind].what, value, limit, memory->step, time,
                           simulation->problem->input->bodies.names[(int)memory->body],
                           memory->place[0], memory->place[1], memory->place[2], memory->count,
                           "particle", memory->count == 1.0 ? "" : "s", later,
                           advice_of(simulation, index, kind, advice, sizeof advice))
             : NULL;
    free(name);
    return text;
}

/* The reason that the case gives for KIND in MATERIAL (-1: in none); NULL: it does not expect
 * it. */
static const char *expected(const struct simulation_case *input, enum warning_kind kind,
                            int material)
{
    for (int i = 0; i < input->expected.count; i++) {
        const struct expected_warning_input *item = case_expected_warning(input, i);
        bool fits = item->of.count == 0 || material < 0;
        for (int k = 0; k < item->of.count && !fits; k++)
            fits = !strcmp(item->of.names[k], input->materials.names[material]);
        if (item->warning == (int)kind && fits)
            return item->reason;
    }
    return NULL;
}

/* The reason for which the case expects what memory INDEX has. */
static const char *reason_of(const struct warnings *warnings, const struct simulation *simulation,
                             int index)
{
    const enum warning_kind kind = kind_of(warnings, index);
    return expected(simulation->problem->input, kind,
                    kind < WARNING_ENERGY ? index / WARNING_ENERGY : -1);
}

char *warning_line(const struct warnings *warnings, const struct simulation *simulation, int index)
{
    const struct warning_memory *memory = &warnings->memory[index];
    const bool is_expected = reason_of(warnings, simulation, index) != NULL;
    char time[48], *line = NULL;
    char *text = is_expected ? warning_name(warnings, simulation, index)
                             : warning_text(warnings, simulation, index);
    readable(memory->time, "s", time, sizeof time);
    if (text && is_expected)
        line = text_format("expected warning: %s, first seen at step %.0f, t = %s", text,
                           memory->step, time);
    else if (text)
        line = text_format("warning: %s", text);
    free(text);
    return line;
}

/* Adds the warning of KIND with NAME and TEXT, which it takes, for the REASON that the case gives
 * (NULL: none); false when memory is out. */
static bool add(enum warning_kind kind, char *name, char *text, const char *reason,
                struct warning_results *results)
{
    struct warning *warning = &results->item[results->count++];
    *warning = (struct warning){kind, name, text, text_copy(reason)};
    results->unexpected += !reason;
    return name && text && (warning->expected || !reason);
}

/* What was found before the run, of SEVERITY, as warnings of KIND. */
static bool add_found(const struct findings *findings, enum severity severity,
                      enum warning_kind kind, struct warning_results *results)
{
    bool done = true;
    for (int k = 0; k < findings_count(findings, severity) && done; k++)
        done = add(kind, text_copy(kinds[kind].name),
                   text_format("%s: %s", kinds[kind].name, findings_text(findings, severity, k)),
                   expected(findings->input, kind, -1), results);
    return done;
}

struct error *warnings_conclude(const struct warnings *warnings,
                                const struct simulation *simulation,
                                struct warning_results *results)
{
    bool done = true;
    int happened = 0;
    *results = (struct warning_results){0};
    for (int k = 0; k < warnings->memories; k++)
        happened += warnings->memory[k].count > 0.0;
    const struct findings *findings = &warnings->judgement->findings;
    const int said =
        findings_count(findings, FINDING_COARSE) + findings_count(findings, FINDING_NO_EFFECT);
    if (!happened && !said)
        return NULL;
    results->item = memory_allocate((size_t)(happened + said) * sizeof *results->item);
    done = results->item != NULL;
    for (int k = 0; k < warnings->memories && done; k++)
        if (warnings->memory[k].count > 0.0)
            done = add(kind_of(warnings, k), warning_name(warnings, simulation, k),
                       warning_text(warnings, simulation, k), reason_of(warnings, simulation, k),
                       results);
    done = done && add_found(findings, FINDING_COARSE, WARNING_COARSE, results) &&
           add_found(findings, FINDING_NO_EFFECT, WARNING_INPUT, results);
    return done ? NULL : out_of_memory_for("warnings");
}

void warning_results_free(struct warning_results *results)
{
    for (int i = 0; i < results->count; i++) {
        free(results->item[i].name);
        free(results->item[i].text);
        free(results->item[i].expected);
    }
    free(results->item);
    *results = (struct warning_results){0};
}

char *warnings_count_text(int count, int unexpected)
{
    if (!count)
        return text_copy("");
    const int known = count - unexpected;
    return text_format("; %d warning%s%s", count, count == 1 ? "" : "s",
                       !known           ? ""
                       : known == count ? count == 1 ? ", expected" : ", all expected"
                                        : ", some of them expected");
}
