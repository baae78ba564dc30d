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

struct error *run_watch_physics(struct run *run)
{
    const struct totals now = simulation_totals(&run->simulation);
    struct error *error = watch_energy(run, &now);
    const bool drift_is_limited = !isnan(run->input->run.energy_drift);
    return error_join(error, warnings_watch(run->warnings, &run->simulation, &now,
                                            drift_is_limited ? 0.0 : run->result->energy_drift,
                                            report_warning, run));
}
