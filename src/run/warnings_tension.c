/* Tension that lasts, in which SPH loses a body with energy conserved to rounding.
 *
 * Pairs that follow the particles are unstable in tension: a particle that nears a neighbour is
 * drawn nearer, and contacts damp that with the impedance rho c. So the state of a body follows
 * from the integral over time of sigma/(rho c spacing). A nudged square of aluminium under 0.25 to
 * 4 GPa, fluid or solid, has its least kinetic energy where that is 0.1 to 0.3, ten times as much
 * at 0.7 to 0.9, that of the start at 1 to 2, and opens at 2 to 4. A cube does the same; `standard`
 * opens at 0.9, and a hexagonal lattice that does not fit the walls at 0.2. The default method
 * holds such bodies, but for soft solids (judgement.loses_tension).
 *
 * With the methods that lose tension elastic strain creeps at surfaces that cut the lattice,
 * however small it is: a bent beam of 10 particles across loses nine tenths of its energy while
 * waves pass 600 particles, at that rate half of it in 200.
 *
 * A pulse that passes through a body leaves most of it alone, or stays below these limits. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/any.h"
#include "material/material.h"
#include "model/bodies.h"
#include "model/solver.h"
#include "run/warnings_internal.h"

/* Of sigma/(rho c spacing) over time, and of c/spacing over time. */
static const double LARGEST_PULL = 1.0, MOST_WAVES = 200.0;

/* Of the modulus of longitudinal waves: smaller tension is the noise of a body at rest. */
static const double LEAST_STRAIN = 1e-5;

/* Of the members of a body: what pulls at fewer of them passes. */
static const double LEAST_FRACTION = 0.25;

/* Strains are summed as whole numbers of this, up to 1: the same sum in any order. */
static const double STRAIN_UNIT = 1e-9;

/* Whether it has surfaces that cut its lattice. */
static bool is_oblique(const struct body_input *body)
{
    return strcmp(body->shape.choice->name, "box") != 0 ||
           strcmp(body->lattice.choice->name, "square") != 0;
}

static void watch_body(struct tension_watch *watch, const struct simulation *simulation,
                       bool (*loses)(const struct material *material), int b)
{
    const struct body_input *body = case_body(simulation->problem->input, b);
    const struct material *material = &simulation->problem->material[body->material_index];
    struct point rest = {.density = material_density(material)};
    if (body_is_prescribed(simulation, b) || eos_traits(&material->eos).gas ||
        material_burns(material) || !loses(material))
        return;
    const double c = any_material_evaluate(material, &rest).sound_long;
    if (!(c > 0.0))
        return;
    watch->wave =
        c / (isnan(body->resolution) ? simulation->problem->input->resolution : body->resolution);
    watch->modulus = rest.density * square(c);
    watch->creep = is_oblique(body) ? 1.0 / MOST_WAVES : 0.0;
}

/* In 1-D waves are aligned with the particles, and the default holds thirty times as much. */
static bool follows_tension(const struct warnings *w, const struct simulation *simulation)
{
    return w->judgement->loses_tension && simulation->problem->dimension > 1;
}

bool tension_create(struct warnings *w, const struct simulation *simulation)
{
    w->bodies = simulation->problem->input->bodies.count;
    w->tension = memory_allocate((size_t)w->bodies * sizeof *w->tension);
    w->tension_watch = memory_allocate((size_t)w->bodies * sizeof *w->tension_watch);
    if (!w->tension || !w->tension_watch)
        return false;
    for (int b = 0; b < w->bodies && follows_tension(w, simulation); b++)
        watch_body(&w->tension_watch[b], simulation, w->judgement->loses_tension, b);
    return true;
}

/* The strain that the largest principal stress of member I makes in a wave, where it is tension;
 * else 0. */
static double tensile_strain(const struct warnings *w, const struct population *p, int32_t i)
{
    const double modulus = w->tension_watch[p->body[i]].modulus;
    double stress = -p->pressure[i];
    if (!(modulus > 0.0))
        return 0.0;
    if (p->deviator) {
        struct sym3 deviator;
        memcpy(&deviator, p->deviator[i], sizeof deviator);
        stress += sym3_largest(deviator);
    }
    return stress > LEAST_STRAIN * modulus ? minimum(stress / modulus, 1.0) : 0.0;
}

double tension_of(const struct warnings *w, const struct population *p, int32_t i)
{
    const double borne = w->tension[p->body[i]].borne;
    return borne > 1.0 && tensile_strain(w, p, i) > 0.0 ? borne : 0.0;
}

/* Of a body: its members, those in tension, and the sum of their strains. */
enum { MEMBERS, TENSILE, STRAIN, SUMS };

static void sum_member(const struct warnings *w, const struct population *p, int32_t i,
                       int64_t *sums)
{
    int64_t *of = sums + (ptrdiff_t)p->body[i] * SUMS;
    const double strain = tensile_strain(w, p, i);
    of[MEMBERS]++;
    if (strain > 0.0) {
        of[TENSILE]++;
        of[STRAIN] += (int64_t)(strain / STRAIN_UNIT);
    }
}

/* False when memory is out. */
static bool sum_members(const struct warnings *w, const struct population *p, int64_t *sums)
{
    const int count = w->bodies * SUMS;
    bool failed = false;
#pragma omp parallel num_threads(p->threads)
    {
        int64_t *own = calloc((size_t)count, sizeof *own);
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++)
            if (own)
                sum_member(w, p, i, own);
#pragma omp critical(bolide_tension)
        {
            for (int k = 0; k < count && own; k++)
                sums[k] += own[k];
            failed |= !own;
        }
        free(own);
    }
    return !failed;
}

static void follow_body(struct body_tension *body, const struct tension_watch *watch,
                        const int64_t *sums, double time)
{
    const bool tensile = (double)sums[TENSILE] > LEAST_FRACTION * (double)sums[MEMBERS];
    const double mean = tensile ? (double)sums[STRAIN] * STRAIN_UNIT / (double)sums[TENSILE] : 0.0;
    const double rate = tensile ? (mean / LARGEST_PULL + watch->creep) * watch->wave : 0.0;
    if (rate > 0.0 && body->rate > 0.0)
        body->borne += 0.5 * (body->rate + rate) * (time - body->time);
    else
        body->borne = 0.0;
    body->rate = rate;
    body->time = time;
}

bool tension_follow(struct warnings *w, const struct simulation *simulation,
                    const struct population *p)
{
    if (!follows_tension(w, simulation))
        return true;
    int64_t *sums = calloc((size_t)w->bodies * SUMS, sizeof *sums);
    const bool done = sums && sum_members(w, p, sums);
    if (ranks_sum(simulation->ranks, !done) == 0) {
        ranks_sum_of(simulation->ranks, sums, w->bodies * SUMS);
        for (int b = 0; b < w->bodies; b++)
            follow_body(&w->tension[b], &w->tension_watch[b], sums + (ptrdiff_t)b * SUMS,
                        simulation->time);
    }
    free(sums);
    return done;
}

bool tension_check_loaded(const struct warnings *w)
{
    bool sound = true;
    for (int b = 0; b < w->bodies; b++)
        sound = sound && isfinite(w->tension[b].time) && isfinite(w->tension[b].rate) &&
                isfinite(w->tension[b].borne);
    return sound;
}
