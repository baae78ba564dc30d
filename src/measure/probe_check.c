/* check: what a check of the case measures, over time. */
#include "measure/probes.h"

const struct parameter probe_check_table[] = {
    PARAMETER(TEXT, struct probe_check, name, REQUIRED, "name of the check"),
    PARAMETER_END,
};

static struct measurement measurement_of(const struct probe *probe,
                                         const struct simulation *simulation,
                                         const struct population *population)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct probe_check *parameters = probe->input->probe.value;
    const int check = named_map_find(&input->checks, parameters->name);
    return (struct measurement){
        .simulation = simulation,
        .population = population,
        .check = check < 0 ? NULL : case_check(input, check),
        .name = parameters->name,
        .at_start = NAN,
    };
}

static struct error *prepare(struct probe *probe, const struct simulation *simulation,
                             const struct population *population)
{
    const struct simulation_case *input = simulation->problem->input;
    struct measurement m = measurement_of(probe, simulation, population);
    if (!m.check) {
        const struct named_map *checks = &input->checks;
        const char *near = nearest_name(m.name, (const char *const *)checks->names, checks->count);
        return probe_error(probe, simulation, "check", "there is no check \"%s\"%s%s%s", m.name,
                           near ? " (did you mean \"" : "", near ? near : "", near ? "\"?)" : "");
    }
    const struct measure_class *class = m.check->measure.choice->thing;
    const char *unit = NULL;
    if (class->of_run || class->needs_exact || class->start)
        return probe_error(probe, simulation, "check",
                           "`%s` of the check \"%s\" has no value at a moment of its own",
                           m.check->measure.choice->name, m.name);
    m.population = simulation_seen(simulation, m.check->of, population);
    error_free(class->unit(&m, &unit)); /* told where the check is prepared */
    probe_add_column(probe, "value", unit ? unit : "");
    return NULL;
}

static struct error *sample(struct probe *probe, const struct simulation *simulation,
                            const struct population *population, double *row)
{
    struct measurement m = measurement_of(probe, simulation, population);
    const struct measure_class *class = m.check->measure.choice->thing;
    m.population = simulation_seen(simulation, m.check->of, population);
    return ranks_agree(simulation->ranks, class->measure(&m, row));
}

const struct probe_class probe_check = {0, prepare, sample};
