/* What a run watches of its physics at every row of the history: whether energy is conserved, and
 * whether materials stay where their models hold. */
#include <math.h>

#include "material/material.h"
#include "run/run_internal.h"

static const double DRIFT_TO_WARN_OF = 0.05;

/* Says once that energy is not conserved, where the case has no limit of its own. */
static void warn_of_drift(struct run *run, double drift)
{
    if (run->drift_is_known || !(drift > DRIFT_TO_WARN_OF))
        return;
    run->drift_is_known = true;
    run_say(run,
            "warning: step %lld, t = %.6g s: the total energy has drifted by %.2g of the largest "
            "energy of the case. Where bodies strike or shocks pass, nodes of a grid equalise the "
            "velocities of particles and that energy is lost: finer particles lose less. "
            "`run: {energy_drift: 5 %%}` makes this an error, `energy_drift: 0` silences it",
            (long long)run->simulation.step, run->simulation.time, drift);
}

/* Energy that appears from nowhere is an impossible state. */
static struct error *watch_energy(struct run *run)
{
    struct totals now = population_totals(simulation_population(&run->simulation), &run->ranks, -1);
    struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    double drift = fabs(energy_drift(&now, &booked, &run->start));
    double allowed = run->input->run.energy_drift;
    run->result->energy_drift = drift;
    if (isnan(allowed))
        warn_of_drift(run, drift);
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

/* Warns once of each material that is denser than its equation of state is good for. Collective. */
static void watch_range(struct run *run)
{
    const struct simulation *simulation = &run->simulation;
    const struct population population = simulation_population(simulation), *p = &population;
    for (int m = 0; m < simulation->materials; m++) {
        const struct material *material = &simulation->material[m];
        const double limit =
            eos_traits(&material->eos).largest_compression * material_density(material);
        if (!(limit < INFINITY) || run->range_is_known & (UINT64_C(1) << (m & 63)))
            continue;
        double most = 0.0;
        for (int32_t i = 0; i < p->count; i++)
            most = p->material[i] == m ? maximum(most, p->density[i]) : most;
        most = ranks_maximum(&run->ranks, most);
        if (!(most > limit))
            continue;
        run->range_is_known |= UINT64_C(1) << (m & 63);
        run_say(
            run,
            "warning: step %lld, t = %.6g s: material %s is compressed to %.3g times its density; "
            "its equation of state ignores heat and is valid up to %.3g; one that depends on "
            "energy, such as mie-grueneisen, goes further",
            (long long)simulation->step, simulation->time, run->input->materials.names[m],
            most / material_density(material), limit / material_density(material));
    }
}

struct error *run_watch_physics(struct run *run)
{
    watch_range(run);
    return watch_energy(run);
}
