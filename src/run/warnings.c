/* What a run warns of: limits of every material, the search among the members; see warnings.h. The
 * words are in warnings_text.c. */
#include "run/warnings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/any.h"
#include "material/material.h"
#include "model/bodies.h"
#include "run/warnings_internal.h"

/* Of the largest speed that needs no warning. Gas of gamma = 1.3 that expands into vacuum in one
 * dimension reaches three times sqrt(2 e), Johnson-Cook's copper as the jet of a charge some 1.5
 * times the speed of its detonation. */
static const double SPEED_FACTOR = 3.0;

/* The strength of an ideal crystal is about a tenth of its bulk modulus. */
static const double TENSION_FRACTION = 1.0 / 20.0;

/* The compression that an explosive before its detonation does not come to at the foot of a wave in
 * time: that of products in the state of Chapman and Jouguet is 1.3 to 1.4. */
static const double UNLIT_COMPRESSION = 1.5;

static const double DRIFT_TO_WARN_OF = 0.05;

/* Of the impulse of a load: three times what a plate of 20 particles misses at an angle. */
static const double LOAD_TO_WARN_OF = 0.03;

/* The mean tension that the run takes as what MATERIAL bears. */
static double tension_limit(const struct material *material, double strength, bool *estimated)
{
    *estimated = false;
    if (!isnan(strength))
        return strength;
    if (eos_traits(&material->eos).limits_tension ||
        strength_traits(&material->strength).limits_tension ||
        failure_traits(&material->failure).limits_tension)
        return INFINITY;
    struct point rest = {.density = material_density(material)};
    rest.history[HISTORY_burnt] = 1.0;
    const struct response response = any_material_evaluate(material, &rest);
    const double bulk =
        rest.density * (response.dp_drho + response.dp_de * rest.pressure / square(rest.density));
    *estimated = bulk > 0.0;
    return bulk > 0.0 ? TENSION_FRACTION * bulk : INFINITY;
}

/* The energy at which temperature is zero at DENSITY. */
static double coldest(const struct material *material, double density)
{
    return heat_energy(&material->heat, &material->eos, density, 0.0);
}

static void find_limits(struct material_watch *watch, const struct material *material,
                        double strength)
{
    for (int kind = 0; kind < WARNING_ENERGY; kind++)
        watch->limit[kind] = INFINITY;
    watch->limit[WARNING_TENSION] = tension_limit(material, strength, &watch->estimated);
    watch->limit[WARNING_INSTABILITY] = 1.0;
    watch->limit[WARNING_DENSITY] =
        eos_traits(&material->eos).largest_compression * material_density(material);
    if (burn_traits(&material->burn).by_time)
        watch->limit[WARNING_UNLIT] = UNLIT_COMPRESSION * material_density(material);
    watch->warm = !heat_wrong(&material->heat, &material->eos);
    if (!watch->warm)
        return;
    watch->limit[WARNING_TEMPERATURE] = 0.0;
    for (int k = 0; k < COLDEST; k++)
        watch->coldest[k] = coldest(material, k * COLDEST_STEP * material_density(material));
}

struct warnings *warnings_create(const struct simulation *simulation,
                                 const struct judgement *judgement)
{
    const int materials = simulation->problem->materials;
    struct warnings *w = memory_allocate(sizeof *w);
    if (!w)
        return NULL;
    w->judgement = judgement;
    w->materials = materials;
    w->of_energy = materials * WARNING_ENERGY;
    w->of_loads = w->of_energy + 1 + simulation->problem->input->probes.count;
    w->memories = w->of_loads + simulation->problem->input->loads.count;
    w->watch = memory_allocate((size_t)materials * sizeof *w->watch);
    w->memory = memory_allocate((size_t)w->memories * sizeof *w->memory);
    w->prescribed = memory_allocate((size_t)simulation->problem->input->bodies.count);
    if (!w->watch || !w->memory || !w->prescribed || !tension_create(w, simulation)) {
        warnings_free(w);
        return NULL;
    }
    for (int m = 0; m < materials; m++) {
        const struct material *material = &simulation->problem->material[m];
        find_limits(&w->watch[m], material,
                    case_material(simulation->problem->input, m)->tensile_strength);
        if (judgement->narrow && judgement->narrow(material))
            w->watch[m].limit[WARNING_REGION] = 0.0;
    }
    for (int b = 0; b < simulation->problem->input->bodies.count; b++)
        w->prescribed[b] = body_is_prescribed(simulation, b);
    return w;
}

void warnings_free(struct warnings *warnings)
{
    if (!warnings)
        return;
    free(warnings->watch);
    free(warnings->memory);
    free(warnings->prescribed);
    free(warnings->tension);
    free(warnings->tension_watch);
    free(warnings);
}

static double speed_of(const struct population *p, int32_t i)
{
    return sqrt(vec3_dot(vector_at(p->velocity[i]), vector_at(p->velocity[i])));
}

/* What the state of member I at the start can set in motion: the particle velocity of a wave that
 * relieves its stress, all its energy as motion, as of a gas that expands without end, its
 * detonation. */
static double released_speed(const struct simulation *simulation, const struct population *p,
                             int32_t i)
{
    const struct material *material = &simulation->problem->material[p->material[i]];
    struct point point = {.density = p->density[i], .energy = p->energy[i]};
    point.history[HISTORY_burnt] = 1.0;
    const struct response response = any_material_evaluate(material, &point);
    double stress = fabs(point.pressure), energy = p->energy[i];
    if (eos_traits(&material->eos).gas) /* products count their energy from the explosive */
        energy -=
            eos_curve(&material->eos, &material->heat, 1e-9 * material_density(material)).energy;
    double speed = sqrt(2.0 * maximum(energy, 0.0));
    if (p->deviator) {
        memcpy(&point.deviator, p->deviator[i], sizeof point.deviator);
        stress += sym3_mises(point.deviator);
    }
    if (response.sound_long > 0.0)
        speed = maximum(speed, stress / (point.density * response.sound_long));
    return maximum(speed, material_detonation_speed(material));
}

void warnings_start(struct warnings *warnings, const struct simulation *simulation)
{
    double largest = 0.0;
    for (int k = 0; k < simulation->populations; k++) {
        const struct population population = simulation_population_at(simulation, k),
                                *p = &population;
        for (int32_t i = 0; i < p->count; i++)
            if (population_has(p, i) && !population_is_mixed(p, i))
                largest =
                    maximum(largest, maximum(speed_of(p, i), released_speed(simulation, p, i)));
    }
    warnings->speed = ranks_maximum(simulation->ranks, largest);
}

/* The speed to which the load at INDEX accelerates material from rest, sqrt(2 p/rho): now, or of a
 * record at any time, since its peak is short. */
static double load_speed(const struct simulation *simulation, int index)
{
    const struct load_input *load = case_load(simulation->problem->input, index);
    const struct body_input *body = case_body(simulation->problem->input, load->body);
    const struct vec3 nowhere = {0.0, 0.0, 0.0};
    double stress =
        load->traction.count ? 0.0 : field_at(&load->pressure, nowhere, simulation->time);
    for (int k = 0; k < load->traction.count; k++)
        stress = hypot(stress, field_at(&load->traction.at[k], nowhere, simulation->time));
    if (load->record.from)
        stress = simulation->trace[index].largest;
    const double speed =
        sqrt(2.0 * fabs(stress) /
             material_density(&simulation->problem->material[body->material_index]));
    return isfinite(speed) ? speed : 0.0;
}

/* What else moves members: loads; bodies with prescribed motion, and, where work is done on the
 * case, the mean speed of what moves, sum m u^2/sum m |u|. Collective. */
static void follow_speed(struct warnings *w, const struct simulation *simulation,
                         const struct population *p, const struct totals *now)
{
    double largest = w->speed;
    for (int i = 0; i < simulation->problem->input->loads.count; i++)
        largest = maximum(largest, load_speed(simulation, i));
    if (any_body(simulation, body_is_prescribed))
        for (int32_t i = 0; i < p->count; i++)
            if (w->prescribed[p->body[i]])
                largest = maximum(largest, speed_of(p, i));
    if (now->momentum_scale > 0.0)
        largest = maximum(largest, 2.0 * now->kinetic / now->momentum_scale);
    w->speed = ranks_maximum(simulation->ranks, largest);
    for (int m = 0; m < w->materials; m++)
        w->watch[m].limit[WARNING_SPEED] = w->speed > 0.0 ? SPEED_FACTOR * w->speed : INFINITY;
}

/* Less the temperature, or less than nothing where it is surely above 0 K: the exact one may be an
 * integral along an isentrope. */
static double coldness(const struct material_watch *watch, const struct material *material,
                       double density, double energy)
{
    const double place = density / (material_density(material) * COLDEST_STEP);
    if (place < COLDEST - 1) {
        const int k = (int)place;
        const double low = watch->coldest[k], high = watch->coldest[k + 1];
        if (energy > maximum(low, high) + fabs(high - low))
            return -1.0;
    }
    return -heat_temperature(&material->heat, &material->eos, density, energy);
}

/* The worst member of a warning, and how many there are. */
struct found {
    struct ranked worst; /* the value is negative: the first is the worst; `what` is its index */
    int64_t count;
};

static void keep(struct found *found, double value, uint64_t id, int32_t index)
{
    const struct ranked own = {-value, id, index};
    if (found->count++ == 0 || ranked_before(&own, &found->worst))
        found->worst = own;
}

/* How far member I is outside ROOM, m. */
static double beyond(const struct bounds *room, const struct population *p, int32_t i)
{
    const double *x = p->position[i];
    double most = 0.0;
    for (int axis = 0; axis < p->dimension; axis++)
        most = maximum(
            most, maximum(vec3_at(room->low, axis) - x[axis], x[axis] - vec3_at(room->high, axis)));
    return most;
}

static void look_at(const struct warnings *w, const struct simulation *simulation,
                    const struct population *p, const double *burnt, int32_t i, struct found *all)
{
    const int m = p->material[i];
    const struct material_watch *watch = &w->watch[m];
    struct found *found = all + (ptrdiff_t)m * WARNING_ENERGY;
    double value[WARNING_ENERGY] = {
        [WARNING_TENSION] = -p->pressure[i],
        [WARNING_SPEED] = speed_of(p, i),
        [WARNING_TEMPERATURE] = -1.0,
        [WARNING_DENSITY] = population_is_mixed(p, i) ? 0.0 : p->density[i],
        [WARNING_INSTABILITY] = tension_of(w, p, i),
        [WARNING_UNLIT] = burnt && burnt[i] == 0.0 ? p->density[i] : 0.0,
    };
    if (watch->limit[WARNING_REGION] < INFINITY)
        value[WARNING_REGION] = beyond(&w->judgement->room, p, i);
    if (watch->warm && !population_is_mixed(p, i))
        value[WARNING_TEMPERATURE] =
            coldness(watch, &simulation->problem->material[m], p->density[i], p->energy[i]);
    for (int kind = 0; kind < WARNING_ENERGY; kind++)
        if (value[kind] > watch->limit[kind])
            keep(&found[kind], value[kind], p->id[i], i);
}

static void join(struct found *found, const struct found *own, int count)
{
    for (int k = 0; k < count; k++) {
        if (own[k].count && (!found[k].count || ranked_before(&own[k].worst, &found[k].worst)))
            found[k].worst = own[k].worst;
        found[k].count += own[k].count;
    }
}

/* Fills FOUND, COUNT of them, for the members of this rank; false when memory is out. */
static bool search(const struct warnings *w, const struct simulation *simulation,
                   const struct population *p, struct found *found, int count)
{
    const double *burnt = fields_find(p->field, p->fields, "burnt");
    bool failed = false;
#pragma omp parallel num_threads(p->threads)
    {
        struct found *own = calloc((size_t)count, sizeof *own);
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++)
            if (own && population_has(p, i))
                look_at(w, simulation, p, burnt, i, own);
#pragma omp critical(bolide_warnings)
        {
            if (own)
                join(found, own, count);
            failed |= !own;
        }
        free(own);
    }
    return !failed;
}

/* Collective: body and place of the member of all ranks that FOUND is about, which is then that of
 * all ranks. */
static void agree_on_worst(const struct simulation *simulation, const struct population *p,
                           struct found *found, double body_and_place[4])
{
    struct ranked first = found->worst;
    if (!found->count)
        first = (struct ranked){INFINITY, UINT64_MAX, -1};
    const struct ranked own = first;
    ranks_first(simulation->ranks, &first);
    const bool here = found->count && own.id == first.id && own.value == first.value;
    for (int k = 0; k < 4; k++)
        body_and_place[k] = -INFINITY;
    if (here) {
        body_and_place[0] = p->body[own.what];
        memcpy(body_and_place + 1, p->position[own.what], 3 * sizeof(double));
    }
    ranks_maximum_of(simulation->ranks, body_and_place, 4);
    found->worst = first;
}

/* Takes VALUE, LIMIT and COUNT, the state of a warning now, into its memory. True where it is
 * new. */
static bool remember(struct warning_memory *memory, const struct simulation *simulation,
                     double value, double limit, double count)
{
    const bool new = memory->count == 0.0;
    if (new || value > memory->worst) {
        memory->worst = value;
        memory->worst_limit = limit;
        memory->worst_time = simulation->time;
    }
    memory->count = maximum(memory->count, count);
    if (!new)
        return false;
    memory->value = value;
    memory->limit = limit;
    memory->time = simulation->time;
    memory->step = (double)simulation->step;
    return true;
}

struct tell {
    void (*tell)(void *context, const char *text);
    void *context;
};

static struct error *report_new(const struct warnings *w, const struct simulation *simulation,
                                int k, const struct tell *tell)
{
    char *text = warning_line(w, simulation, k);
    if (!text)
        return out_of_memory_for("a warning");
    tell->tell(tell->context, text);
    free(text);
    return NULL;
}

/* What all ranks FOUND. Collective. */
static struct error *take_found(struct warnings *w, const struct simulation *simulation,
                                const struct population *p, struct found *found,
                                const struct tell *tell)
{
    int64_t *counts = calloc((size_t)w->of_energy, sizeof *counts);
    TRY(ranks_agree(simulation->ranks, counts ? NULL : out_of_memory_for("warnings")));
    for (int k = 0; k < w->of_energy; k++)
        counts[k] = found[k].count;
    ranks_sum_of(simulation->ranks, counts, w->of_energy);
    struct error *error = NULL;
    for (int k = 0; k < w->of_energy; k++) {
        double place[4];
        if (!counts[k])
            continue;
        agree_on_worst(simulation, p, &found[k], place);
        struct warning_memory *memory = &w->memory[k];
        const double limit = w->watch[k / WARNING_ENERGY].limit[k % WARNING_ENERGY];
        if (!remember(memory, simulation, -found[k].worst.value, limit, (double)counts[k]))
            continue;
        memory->body = place[0];
        memcpy(memory->place, place + 1, sizeof memory->place);
        error = error_join(error, report_new(w, simulation, k, tell));
    }
    free(counts);
    return error;
}

struct error *warnings_watch(struct warnings *w, const struct simulation *simulation,
                             const struct totals *now, double drift,
                             void (*tell)(void *context, const char *text), void *context)
{
    const struct population population = simulation_population(simulation), *p = &population;
    const struct tell teller = {tell, context};
    follow_speed(w, simulation, p, now);
    struct found *found = calloc((size_t)w->of_energy, sizeof *found);
    const bool followed = tension_follow(w, simulation, p);
    const bool done = found && followed && search(w, simulation, p, found, w->of_energy);
    struct error *error =
        ranks_agree(simulation->ranks, done ? NULL : out_of_memory_for("warnings"));
    if (!error)
        error = take_found(w, simulation, p, found, &teller);
    free(found);
    if (!error && drift > DRIFT_TO_WARN_OF &&
        remember(&w->memory[w->of_energy], simulation, drift, DRIFT_TO_WARN_OF, 1.0))
        error = report_new(w, simulation, w->of_energy, &teller);
    return error;
}

struct error *warnings_watch_tracers(struct warnings *w, const struct simulation *simulation,
                                     const struct probes *probes,
                                     void (*tell)(void *context, const char *text), void *context)
{
    const struct tell teller = {tell, context};
    struct error *error = NULL;
    for (int k = 0; k < probes->count; k++) {
        const int index = w->of_energy + 1 + k;
        const double failed = probes->item[k].failed;
        if (failed < 0.0 || !remember(&w->memory[index], simulation, 1.0, 1.0, 1.0))
            continue;
        w->memory[index].time = failed;
        error = error_join(error, report_new(w, simulation, index, &teller));
    }
    return error;
}

/* A load that has done nothing by the end of the run counts as wholly apart, unless that was known
 * from the start. */
struct error *warnings_watch_loads(struct warnings *w, const struct simulation *simulation,
                                   void (*tell)(void *context, const char *text), void *context)
{
    const struct tell teller = {tell, context};
    const struct simulation_case *input = simulation->problem->input;
    struct error *error = NULL;
    for (int i = 0; i < input->loads.count; i++) {
        const struct load_totals totals =
            load_record_totals(&simulation->load[i], simulation->ranks);
        const bool nothing = !findings_count(&w->judgement->findings, FINDING_NO_EFFECT) &&
                             totals.gross == 0.0 && simulation->time >= input->run.until;
        const double apart = nothing ? 1.0 : load_deviation(&totals);
        const int index = w->of_loads + i;
        if (!(apart > LOAD_TO_WARN_OF) ||
            !remember(&w->memory[index], simulation, apart, LOAD_TO_WARN_OF, 1.0))
            continue;
        error = error_join(error, report_new(w, simulation, index, &teller));
    }
    return error;
}

struct error *warnings_check_loaded(const struct warnings *warnings, int bodies)
{
    for (int i = 0; i < warnings->memories; i++)
        if (!(warnings->memory[i].body >= 0.0 && warnings->memory[i].body < bodies))
            return error_new(ERROR_SYSTEM,
                             "row %d of run/warnings is of body %g, where the case has "
                             "%d of them",
                             i, warnings->memory[i].body, bodies);
    if (!tension_check_loaded(warnings))
        return error_new(ERROR_SYSTEM, "a number of run/tension is not finite");
    return NULL;
}

/* What is loaded, of a case with STORED probes, of which PROBES knows its own; those that are new
 * have not warned. */
static void take_stored(struct warnings *w, const struct probes *probes, int stored,
                        const struct warning_memory *memory)
{
    const int before = w->of_energy + 1, loads = w->memories - w->of_loads;
    const size_t size = sizeof *memory;
    memcpy(w->memory, memory, (size_t)before * size);
    memcpy(w->memory + w->of_loads, memory + before + stored, (size_t)loads * size);
    for (int k = 0; k < probes->count; k++) {
        const int place = probes->item[k].stored;
        w->memory[before + k] =
            place >= 0 && place < stored ? memory[before + place] : (struct warning_memory){0};
    }
}

struct error *warnings_visit(struct warnings *warnings, const struct probes *probes, int stored,
                             struct visitor *visitor)
{
    const bool loads = visitor->most;
    const int count = warnings->memories + (loads ? stored - probes->count : 0);
    struct warning_memory *memory =
        loads ? memory_allocate((size_t)count * sizeof *memory) : warnings->memory;
    if (!memory)
        return out_of_memory_for("warnings");
    struct error *error = visitor->visit(visitor, "run/tension", NUMBER_DOUBLE, warnings->tension,
                                         warnings->bodies, TENSION_NUMBERS);
    if (!error)
        error =
            visitor->visit(visitor, "run/warnings", NUMBER_DOUBLE, memory, count, WARNING_NUMBERS);
    if (loads) {
        if (!error)
            take_stored(warnings, probes, stored, memory);
        free(memory);
    }
    TRY(error);
    return visitor->visit(visitor, "run/largest_speed", NUMBER_DOUBLE, &warnings->speed, 1, 1);
}
