/* Loads on the free surfaces of bodies: the force on an element of a surface (model/surface.h)
 * accelerates the particle that it is attached to. */
#include "model/loads.h"

#include <stdlib.h>

#include "base/memory.h"
#include "model/particles/held.h"
#include "model/particles/population.h"
#include "sph/scheme.h"

struct error *sph_create_loads(struct sph *sph, const struct simulation *simulation)
{
    if (simulation->problem->input->loads.count == 0)
        return NULL;
    sph->loads = memory_allocate(sizeof *sph->loads);
    return sph->loads ? loads_create(simulation, sph->loads) : out_of_memory_for("loads");
}

void sph_free_loads(struct sph *sph)
{
    if (sph->loads)
        loads_free(sph->loads);
    free(sph->loads);
}

const double (*sph_load_of(const struct sph *sph))[3]
{
    return sph->loads ? (const double(*)[3])sph->loads->force : NULL;
}

struct error *sph_add_loads(const struct sph *sph, struct simulation *simulation,
                            const struct sph_fields *f, double from, double dt)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct particles *p = f->particles;
    const struct population population = population_of_particles(p);
    struct loads *loads = sph->loads;
    if (!loads)
        return NULL;
    TRY(ranks_agree(simulation->ranks, loads_follow(loads, simulation, &population)));
    loads_clear(loads, &population);
    for (int i = 0; i < input->loads.count; i++) {
        const struct load_input *load = case_load(input, i);
        if (!load_acts_at(load, from))
            continue;
        const bool free = !body_is_prescribed(simulation, load->body);
        TRY(loads_push(loads, simulation, i, from, dt, free));
        if (free)
            loads_deliver(loads, simulation, i, dt);
    }
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            loads->force[i][axis] /= p->mass[i];
            f->rates.acceleration[i][axis] += loads->force[i][axis];
        }
    return NULL;
}

struct booking {
    const struct sph_fields *fields;
    const double (*load)[3];
    double dt, ahead;
};

static void book_load(const struct simulation *simulation, const struct particles *p,
                      const void *of, int32_t i, struct ledger *ledger)
{
    (void)simulation;
    const struct booking *booking = of;
    const double *load = booking->load[i];
    if (load[0] == 0.0 && load[1] == 0.0 && load[2] == 0.0)
        return;
    const struct vec3 u = vector_at(p->velocity[i]),
                      a = vector_at(booking->fields->rates.acceleration[i]),
                      impulse = vec3_scale(booking->dt * p->mass[i], vector_at(load));
    ledger_book(ledger, LEDGER_LOADS, 0.0, impulse,
                vec3_add(vector_at(p->position[i]), vec3_scale(booking->ahead, u)),
                vec3_dot(impulse, vec3_add(u, vec3_scale(booking->ahead, a))));
}

void sph_book_loads(const struct sph *sph, struct simulation *simulation,
                    const struct sph_fields *f, double dt, double ahead)
{
    if (sph->loads)
        act_on_particles(simulation, f->particles, NULL, book_load,
                         &(struct booking){f, sph_load_of(sph), dt, ahead});
}
