/* What is found in a case before it runs; see judge.h. */
#include "run/judge.h"

#include <stdlib.h>

#include "base/memory.h"
#include "exact/detonation.h"
#include "material/any.h"
#include "material/material.h"
#include "material/whole.h"
#include "model/generate.h"
#include "model/loads.h"
#include "run/blast_cells.h"
#include "run/grain_cells.h"
#include "run/rod_cells.h"

/* Measured pressures of Chapman and Jouguet scatter by about a tenth. */
static const double PRESSURE_TOLERANCE = 0.2;

/* The pressure of products in the volume of the explosive. */
static double closed_pressure(const struct material *material)
{
    struct point rest = {.density = material_density(material)};
    rest.history[HISTORY_burnt] = 1.0;
    any_material_evaluate(material, &rest);
    return rest.pressure;
}

char *detonation_wrong(const struct material *material)
{
    struct detonation d;
    const bool lit = material_is_lit(material), gas = eos_traits(&material->eos).gas;
    const double given = lit ? material_detonation_speed(material) : NAN,
                 pressure = burn_traits(&material->burn).pressure;
    if (!lit && (material_burns(material) || !gas || closed_pressure(material) == 0.0))
        return NULL;
    if (!gas)
        return text_copy("its products hold together instead of expanding like a gas: a JWL set of "
                         "products has no negative constants");
    if (!detonation_solve(material, material_density(material), &d))
        return text_copy("its products have no state of Chapman and Jouguet, so that no detonation "
                         "is steady: look at the signs and the order of their constants (JWL: "
                         "a > b > 0, r1 > r2) and at their energy");
    if (fabs(given / d.speed - 1.0) > DETONATION_SPEED_TOLERANCE)
        return text_format("the detonation speed of %.6g m/s that it gives is %.3g %% %s than that "
                           "of its products, %.6g m/s",
                           round(given), 100.0 * fabs(given / d.speed - 1.0),
                           given > d.speed ? "more" : "less", round(d.speed));
    if (fabs(pressure / d.cj.pressure - 1.0) > PRESSURE_TOLERANCE)
        return text_format("the Chapman-Jouguet pressure of %.4g Pa that it gives is not that of "
                           "its products, %.4g Pa",
                           pressure, d.cj.pressure);
    return NULL;
}

/* Explosives whose constants contradict each other. */
static void judge_explosives(struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    for (int i = 0; i < input->materials.count; i++) {
        char *text = detonation_wrong(case_material(input, i)->material);
        if (text)
            finding_add(findings, FINDING_NO_EFFECT, "materials", input->materials.names[i], "%s",
                        text);
        free(text);
    }
}

/* Strength whose constants contradict the elastic limit that scales them, at the strain rate of a
 * shock, 1/s. Published sets that are consistent deviate by less than the tolerance. */
static void judge_limits(struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    const double rate = 1e5, tolerance = 0.1;
    for (int i = 0; i < input->materials.count; i++) {
        const struct material *material = case_material(input, i)->material;
        const double given = strength_given_limit(&material->strength),
                     computed = material_elastic_limit(material, rate);
        if (fabs(computed / given - 1.0) > tolerance)
            finding_add(findings, FINDING_DOUBTFUL, "materials", input->materials.names[i],
                        "its constants give an elastic limit (HEL) of %.4g GPa at %.0e/s, not the "
                        "%.4g GPa that they are scaled by: they do not belong together, and it "
                        "yields at the computed one",
                        computed * 1e-9, rate, given * 1e-9);
    }
}

struct contact_side {
    double pressure, sound, impedance;
    struct extremes speed;
};

static struct contact_side contact_side_of(const struct simulation_case *input, int body,
                                           const struct body_summary *summary)
{
    const struct material *material = body_material(input, body);
    struct point point = summary->fastest;
    const double sound = any_material_evaluate(material, &point).sound_long;
    return (struct contact_side){point.pressure, sound, point.density * sound, summary->speed};
}

/* The jump of velocity over the speed of sound, the larger of both sides, of the acoustic contact
 * problem. Of velocities only the speeds count: bodies may move apart, side by side or in step. */
static double contact_jump(const struct contact_side *a, const struct contact_side *b)
{
    const double impedance = a->impedance + b->impedance;
    const double pressure = fabs(a->pressure - b->pressure) / impedance;
    const double closing =
        maximum(0.0, maximum(a->speed.low - b->speed.high, b->speed.low - a->speed.high)) /
        impedance;
    return maximum((pressure + b->impedance * closing) / a->sound,
                   (pressure + a->impedance * closing) / b->sound);
}

static void strong_contacts(struct findings *findings, double largest)
{
    const struct simulation_case *input = findings->input;
    const int bodies = input->bodies.count;
    struct body_summary *summary = memory_allocate(((size_t)bodies + 1) * sizeof *summary);
    if (!summary)
        return;
    struct error *error = generate_summary(input, NULL, summary);
    for (int i = 0; i < bodies && !error; i++)
        for (int j = 0; j < i; j++) {
            const struct contact_side a = contact_side_of(input, i, &summary[i]),
                                      b = contact_side_of(input, j, &summary[j]);
            const double jump = contact_jump(&a, &b);
            if (jump > largest)
                finding_add(findings, FINDING_DOUBTFUL, "solver", NULL,
                            "the contact between bodies \"%s\" and \"%s\" has a jump of %.2g times "
                            "the speed of sound, and the Riemann solver of this method is made for "
                            "weaker waves: shocks will be too slow",
                            input->bodies.names[j], input->bodies.names[i], jump);
        }
    error_free(error); /* run_case and estimate_run report it */
    free(summary);
}

/* Bodies that are to be taken away, slowed or left out by a solver that cannot. */
static void judge_what_happens(struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    const struct solver_class *method = input->solver.choice->thing;
    if (input->start.without.count && !method->removes)
        finding_add(findings, FINDING_WRONG, "start", "without",
                    "this solver begins with a blast; only mpm and sph leave out bodies");
    for (int i = 0; i < input->bodies.count && !method->removes; i++) {
        const struct body_input *body = case_body(input, i);
        const bool removed = !isnan(body->remove_at);
        if (!removed && !(body->damping > 0.0))
            continue;
        char *name =
            text_format("%s.%s", input->bodies.names[i], removed ? "remove_at" : "damping");
        if (name)
            finding_add(findings, FINDING_WRONG, "bodies", name,
                        "only the solvers sph and mpm %s bodies", removed ? "take away" : "slow");
        free(name);
    }
}

struct judgement judge_solver(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    struct judgement judgement =
        judge_with(input->solver.choice->thing, input->solver.value, simulation);
    struct findings *findings = &judgement.findings;
    for (int i = 0; input->notes && i < error_count(input->notes); i++)
        findings_take(findings, FINDING_NOTE,
                      error_new(ERROR_INPUT, "%s", error_message(input->notes, i)));
    blast_cells(findings);
    rod_cells(findings);
    grain_cells(findings);
    judge_explosives(findings);
    judge_limits(findings);
    judge_what_happens(findings);
    ignitions_judge(findings);
    loads_judge(findings);
    return judgement;
}

void judge_bodies(struct judgement *judgement)
{
    generate_judge(&judgement->findings);
    if (isfinite(judgement->largest_jump))
        strong_contacts(&judgement->findings, judgement->largest_jump);
}

void judge_tell(const struct findings *findings, void (*tell)(void *context, const char *text),
                void *context)
{
    static const char *const words[SEVERITIES] = {[FINDING_NOTE] = "note"};
    for (int severity = 0; severity < FINDING_WRONG; severity++)
        for (int i = 0; i < findings_count(findings, severity); i++) {
            char *text = text_format("%s: %s", words[severity] ? words[severity] : "warning",
                                     findings_text(findings, severity, i));
            if (text)
                tell(context, text);
            free(text);
        }
}
