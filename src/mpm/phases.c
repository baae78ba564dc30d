/* What a coupling sees and does of the material point method, see mpm_phases.h. */
#include "mpm/mpm_phases.h"

#include "material/any.h"
#include "material/material.h"
#include "mpm/mpm_internal.h"

void mpm_surround(struct mpm *mpm, const struct mpm_outside *outside) { mpm->outside = outside; }

void mpm_limit_by_nodes(struct mpm *mpm) { mpm->limits_by_nodes = true; }

struct particles *mpm_particles(const struct mpm *mpm) { return mpm->particles; }

double mpm_half_size(const struct mpm *mpm, int body) { return mpm->half_size[body]; }

enum grid_shape mpm_shape(const struct mpm *mpm) { return (enum grid_shape)mpm->parameters.shape; }

double mpm_gauge(const struct mpm *mpm, int material) { return mpm->gauge[material]; }

void mpm_welcome(const struct mpm *mpm, const struct simulation *simulation, int32_t i)
{
    struct particles *p = mpm->particles;
    const struct mpm_fields fields = mpm_fields_of(mpm);
    struct point point = {.density = p->density[i], .energy = p->energy[i]};
    particle_load_history(p, i, point.history);
    const struct response response =
        any_material_evaluate(&simulation->problem->material[p->material[i]], &point);
    p->pressure[i] = point.pressure;
    fields.sound_long[i] = response.sound_long;
    if (fields.at_state)
        fields.at_state[i] = p->energy[i];
}
