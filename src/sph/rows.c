/* When rows are built again: particles go to the ranks that own them, neighbours are found, and records get room. */
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "sph/lanes.h"
#include "sph/sph_internal.h"

/* Records stand in the scratch of the store until particles are sorted again. */
static struct error *reserve_records(struct sph *sph, struct simulation *simulation)
{
    struct scratch *scratch = &simulation->particles.scratch;
    int64_t count = (int64_t)simulation->particles.count + sph->neighbours.ghosts.count + 1;
    size_t stride = (size_t)(sph_corrected(sph)      ? hllc_stride(sph->hllc)
                             : sph_second_order(sph) ? muscl_stride(muscl_kind_of(sph))
                                                     : record_stride(sph->kind));
    const size_t bytes = (size_t)count * stride * sizeof(double);
    if (!scratch_begin(scratch, bytes) ||
        (sph_second_order(sph) && !memory_reserve((void **)&sph->place, &sph->place_capacity, count,
                                                  0, PLACE_STRIDE * sizeof(double))))
        return error_new(ERROR_SYSTEM, "out of memory for the records of %lld particles",
                         (long long)count);
    sph->record = scratch_part(scratch, bytes);
    return exchange_reserve(&sph->neighbours.ghosts.exchange, stride * sizeof(double));
}

/* Seconds that this rank's particles have taken up to now. */
static double work_of(const struct sph *sph, const struct simulation *simulation)
{
    static const char *const names[] = {"pairs", "gradients", "heat"};
    double sum = 0.0;
    for (int i = 0; i < simulation->phases; i++)
        for (size_t k = 0; k < COUNT_OF(names); k++)
            sum += strcmp(simulation->phase[i].name, names[k]) ? 0.0 : simulation->phase[i].seconds;
    return sum - sph->neighbours.ghosts.waited;
}

/* True at the steps at which the case has the blocks divided anew. */
static bool recuts(const struct sph *sph, const struct simulation *simulation)
{
    int64_t every = simulation->input->run.rebalance;
    return every > 0 && simulation->ranks->joined && simulation->step % every == 0 &&
           sph->steps_since_build > 0;
}

struct error *sph_refresh_rows(struct sph *sph, struct simulation *simulation)
{
    struct particles *p = &simulation->particles;
    const bool grows = sph_second_order(sph) && p->dimension > 1;
    const char *const diameter = grows ? "support" : "diameter";
    struct reach reach = {particles_field(p, diameter), sph->parameters.smoothing};
    int64_t most = sph->parameters.rebuild;
    double begin = clock_seconds();
    bool recut = recuts(sph, simulation);
    if (!(most && sph->steps_since_build >= most) && !recut &&
        neighbours_hold(&sph->neighbours, p, reach, simulation->threads)) {
        simulation_spend(simulation, "neighbours", clock_seconds() - begin);
        return NULL;
    }
    double work = work_of(sph, simulation);
    TRY(particles_distribute(p, work - sph->work, recut));
    sph->work = work;
    reach.diameter = particles_field(p, diameter);
    TRY(neighbours_build(&sph->neighbours, p, reach, &simulation->mirrors, &sph->groups,
                         simulation->threads));
    sph->steps_since_build = 0;
    simulation_spend(simulation, "neighbours", clock_seconds() - begin);
    struct error *error = conduction_on(sph) ? conduction_reserve(sph, simulation) : NULL;
    if (!error)
        error = reserve_records(sph, simulation);
    if (!error)
        error = frozen_find(sph, simulation);
    return ranks_agree(simulation->ranks, error);
}
