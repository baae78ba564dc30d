/* pieces: into how many pieces bodies are broken: the connected sets of their particles
 * (connected.h), failed ones included. */
#include <stdlib.h>

#include "base/memory.h"
#include "measure/connected.h"
#include "measure/measure.h"

const struct parameter measure_pieces_table[] = {
    CONNECTED_LINK(offsetof(struct measure_pieces, link)),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    if (!connected_has_diameters(measurement->population))
        return measure_error(measurement, "the particles of this solver have no diameter");
    *unit = "";
    return NULL;
}

/* A piece counts where its label is the id of a particle. */
static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_pieces *parameters = measurement->check->measure.value;
    const struct connection connection = {parameters->link, measure_body(measurement), true};
    const struct population *particles = measurement->population;
    const struct ranks *ranks = measurement->simulation->ranks;
    double *diameter;
    uint64_t *label = memory_allocate(((size_t)particles->count + 1) * sizeof *label);
    struct error *error = connected_diameters(particles, &diameter);
    if (!error && !label)
        error = out_of_memory_for("a check of %d particles", (int)particles->count);
    error = ranks_agree(ranks, error);
    if (!error)
        error = connected_find(ranks, particles, diameter, NULL, &connection, label);
    int64_t pieces = 0;
    for (int32_t i = 0; i < particles->count && !error; i++)
        pieces += label[i] == particles->id[i];
    *value = error ? NAN : (double)ranks_sum(ranks, pieces);
    free(label);
    free(diameter);
    return error;
}

const struct measure_class measure_pieces = {.unit = unit, .measure = measure, .of_bodies = true};
