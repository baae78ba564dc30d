/* Particles of an earlier run; see carry.h. */
#include "model/particles/carry.h"

#include <string.h>

#include "model/particles/population.h"
#include "particle/particles.h"

/* Marks the particles of BODY for deletion. */
static void drop_body(struct particles *particles, int body)
{
    for (int32_t i = 0; i < particles->count; i++)
        if (particles->body[i] == body)
            particles_delete(particles, i);
}

/* Copies the saved fields of particle I of FROM to particle J of TO, which has zeros for those that
 * FROM has not. */
static void copy_particle(struct particles *to, int32_t j, const struct particles *from, int32_t i)
{
    for (int k = 0; k < to->fields; k++) {
        const struct field *field = &to->field[k];
        const size_t bytes = field_bytes(field);
        const char *data = fields_find(from->field, from->fields, field->declaration.name);
        if ((field->declaration.kind & FIELD_STATE) && data)
            memcpy((char *)field->data + (size_t)j * bytes, data + (size_t)i * bytes, bytes);
    }
}

static struct error *carry(struct particles *to, const struct particles *from, const int *body,
                           const int *material)
{
    int32_t count = 0, next;
    for (int32_t i = 0; i < from->count; i++)
        count += body[from->body[i]] >= 0;
    TRY(particles_append(to, count, &next));
    for (int32_t i = 0; i < from->count; i++) {
        if (body[from->body[i]] < 0)
            continue;
        copy_particle(to, next, from, i);
        to->body[next] = (uint16_t)body[from->body[i]];
        to->material[next] = (uint16_t)material[from->material[i]];
        to->id[next] = particle_id(to->body[next], (int64_t)(from->id[i] & PARTICLE_SITE));
        next++;
    }
    return NULL;
}

struct error *carry_particles(struct simulation *simulation, const struct simulation *before,
                              const int *body, const int *material)
{
    struct error *error = NULL;
    for (int k = 0; k < simulation->populations && k < before->populations && !error; k++) {
        if (simulation->population[k].type != &particle_population ||
            before->population[k].type != &particle_population)
            continue;
        struct particles *to = particles_in(&simulation->population[k]);
        for (int b = 0; b < before->problem->input->bodies.count; b++)
            if (body[b] >= 0)
                drop_body(to, body[b]);
        error = carry(to, particles_in(&before->population[k]), body, material);
    }
    TRY(ranks_agree(simulation->ranks, error));
    return ranks_agree(simulation->ranks, simulation_commit(simulation));
}
