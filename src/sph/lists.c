/* When neighbour lists are rebuilt: particles go to the ranks that own them, neighbours are
 * searched anew, and records get room. */
#include "base/memory.h"
#include "sph/lanes.h"
#include "sph/scheme.h"

double sph_near_skin(const struct sph_parameters *parameters, unsigned traits)
{
    const double fraction = 0.3; /* a smaller one leaves shorter lists, made more often */
    const bool compressed = (traits & SPH_PLANE) && !(traits & (SPH_SUPPORT_KEPT | SPH_STILL));
    return compressed ? fraction * parameters->skin : 0.0;
}

/* Records are in the scratch of the store until particles are sorted again. */
static struct error *reserve_records(struct sph *sph)
{
    struct scratch *scratch = &sph->particles->scratch;
    int64_t count = (int64_t)sph->particles->count + sph->neighbours.ghosts.count + 1;
    const size_t bytes = (size_t)count * sph->stride * sizeof(double);
    if (!scratch_begin(scratch, bytes) ||
        (sph->places && !memory_reserve((void **)&sph->place, &sph->place_capacity, count, 0,
                                        PLACE_STRIDE * sizeof(double))))
        return out_of_memory_for("the records of %lld particles", (long long)count);
    sph->record = scratch_part(scratch, bytes);
    return exchange_reserve(&sph->neighbours.ghosts.exchange, sph->stride * sizeof(double));
}

/* True at the steps at which the case has the blocks divided anew. */
static bool recuts(const struct sph *sph, const struct simulation *simulation)
{
    int64_t every = simulation->problem->input->run.rebalance;
    return every > 0 && simulation->ranks->joined && simulation->step % every == 0 &&
           sph->steps_since_build > 0;
}

/* Supports are found again after particles have moved in the store. */
struct reach sph_reach(const struct sph *sph, const struct simulation *simulation)
{
    const struct sph_fields f = sph_fields_of(sph, simulation);
    return (struct reach){f.support ? f.support : f.diameter, sph->parameters.smoothing};
}

/* The clusters of bodies, where there are several. */
static const uint16_t *clusters(const struct sph *sph)
{
    for (int b = 1; b < sph->bodies && sph->cluster; b++)
        if (sph->cluster[b] != sph->cluster[0])
            return sph->cluster;
    return NULL;
}

struct error *sph_rebuild_lists(struct sph *sph, struct simulation *simulation)
{
    sph->groups.cluster = clusters(sph);
    TRY(neighbours_build(&sph->neighbours, sph->particles, sph_reach(sph, simulation),
                         &simulation->problem->images, &sph->groups, simulation->threads));
    sph->steps_since_build = 0;
    simulation_end_phase(simulation, PHASE_SHARED, "neighbour search");
    return ranks_agree(simulation->ranks, reserve_records(sph));
}

struct error *sph_refresh_lists(struct sph *sph, struct simulation *simulation, bool *rebuilt)
{
    struct particles *p = sph->particles;
    int64_t most = sph->parameters.rebuild;
    bool recut = recuts(sph, simulation);
    *rebuilt =
        (most && sph->steps_since_build >= most) || recut ||
        !neighbours_hold(&sph->neighbours, p, sph_reach(sph, simulation), simulation->threads);
    if (!*rebuilt) {
        simulation_end_phase(simulation, PHASE_SHARED, "neighbour search");
        return NULL;
    }
    TRY(particles_distribute(p, recut));
    return sph_rebuild_lists(sph, simulation);
}
