/* What a run watches of its physics at every row of the history: whether energy is conserved, and
 * what its models do not cover. */
#include <math.h>

#include "run/run_internal.h"

/* Energy that appears from nowhere is an impossible state. */
static struct error *watch_energy(struct run *run, const struct totals *now)
{
    struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    double drift = fabs(energy_drift(now, &booked, &run->start));
    double allowed = run->input->run.energy_drift;
    run->result->energy_drift = drift;
    if (drift <= allowed || ((allowed == 0.0 || isnan(allowed)) && !isnan(drift)))
        return NULL;
    if (isnan(drift)) {
        run->sound = false;
        return error_new(ERROR_STATE, "step %lld, t = %.6g s: the total energy is not finite",
                         (long long)run->simulation.step, run->simulation.time);
    }
    return error_new(ERROR_STATE,
                     "step %lld, t = %.6g s: the total energy has drifted by %.3g of the largest "
                     "energy of the case; "
                     "`run.energy_drift` allows %.3g (0: any)",
                     (long long)run->simulation.step, run->simulation.time, drift, allowed);
}

static void report_warning(void *context, const char *text) { run_say(context, "%s", text); }

struct error *run_watch_tracers(struct run *run)
{
    return warnings_watch_tracers(run->warnings, &run->simulation, &run->probes, report_warning,
                                  run);
}

/* The drift to warn of: of the energies that there are. Those that the start may release, as
 * an explosive that is never lit, count little, but more than rounding. */
static double drift_to_watch(const struct run *run, const struct totals *now)
{
    static const double part = 0.02;
    const struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    struct totals start = run->start;
    start.released *= part;
    return isnan(run->input->run.energy_drift) ? fabs(energy_drift(now, &booked, &start)) : 0.0;
}

struct error *run_watch_physics(struct run *run, const struct totals *now)
{
    struct error *error = watch_energy(run, now);
    error = error_join(error,
                       warnings_watch_loads(run->warnings, &run->simulation, report_warning, run));
    return error_join(error, warnings_watch(run->warnings, &run->simulation, now,
                                            drift_to_watch(run, now), report_warning, run));
}

void run_report_loads(struct run *run)
{
    const struct problem *problem = run->simulation.problem;
    for (int i = 0; i < problem->input->loads.count; i++) {
        const struct load_totals totals = load_record_totals(&run->simulation.load[i], &run->ranks);
        char delivered[160], expected[160];
        load_impulse_text(problem, totals.delivered, delivered, sizeof delivered);
        load_impulse_text(problem, totals.expected, expected, sizeof expected);
        run_say(
            run,
            "  load %s: impulse delivered %s; pressure times area of its surface %s; %.2g %% apart",
            problem->input->loads.names[i], delivered, expected, 100.0 * load_deviation(&totals));
    }
}
