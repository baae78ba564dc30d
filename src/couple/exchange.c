/* What passes between the gas and the particles through the open faces of the region (4-10) to
 * (4-21), so that nothing is lost: the flux of the gas solver's step gives the pressure, which
 * pushes on the particles, and the flow of material, which is kept at the face until it makes a
 * layer of particles. Particles that leave are kept there likewise, and the gas, which had taken
 * the flow already, gets the difference little by little. */
#include <string.h>

#include "base/memory.h"
#include "couple/gates.h"
#include "material/material.h"

/* Splits what has passed through a gate in the gas's step of DT into pressure and flow, by the
 * velocity BESIDE it. */
static void split(struct cfdmp *cfdmp, int axis, int side, int64_t number,
                  const struct beside *beside, double dt)
{
    struct gate *gate = &cfdmp->side[axis][side].gate[number];
    const double *passed = &cfdmp->cut.passed[axis][side][number * GAS_PASSED];
    const double area = gate_area(cfdmp, axis, side, number), into = side ? -area : area;
    const double velocity = beside->velocity[axis],
                 push = passed[GAS_MOMENTUM + axis] - passed[GAS_DENSITY] * velocity;
    gate->pressure = push / dt;
    gate->flow = into * passed[GAS_DENSITY];
    for (int k = 0; k < 3; k++)
        gate->push[k] = k == axis ? into * push : 0.0;
    gate->push[3] = into * push * velocity;
    if (cfdmp->parameters.transport == CFDMP_CONSERVATIVE) {
        for (int n = 0; n < GAS_NUMBERS; n++)
            gate->pending[n] += into * passed[n];
        gate->pending[PASS_SECOND] += into * passed[GAS_NUMBERS];
        gate->pending[PASS_MOMENTUM + axis] -= gate->push[axis];
        gate->pending[PASS_ENERGY] -= gate->push[3];
    }
    for (int k = 0; k < 4; k++)
        gate->pushed[k] = 0.0;
    for (int k = 0; k < 3; k++)
        gate->uncovered[k] = k == axis ? into * dt : 0.0;
}

void cfdmp_find_pressures(struct cfdmp *cfdmp, double dt)
{
    cfdmp_look(cfdmp);
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int s = 0; s < 2; s++) {
            const struct side *side = &cfdmp->side[axis][s];
            if (side->gates)
                cfdmp_unite(cfdmp, cfdmp->cut.passed[axis][s], side->gates * GAS_PASSED);
            for (int64_t n = 0; n < side->gates; n++) {
                const struct beside beside = gate_beside(cfdmp, axis, s, n);
                split(cfdmp, axis, s, n, &beside, dt);
            }
        }
}

/* What comes in through a gate: of one material, at one state. */
struct arrival {
    int axis, side, material;
    int64_t number;
    double mass, density, energy, depth; /* depth: of the layer, m */
    double velocity[3];
};

/* Where what comes in is along ACROSS, from PLACE at the face: its middle has moved since it passed
 * the face. It stays in the region, and half the distance ROOM of particles off a wall. */
static double drifted(const struct cfdmp *cfdmp, const struct arrival *arrival, int across,
                      double place, double room)
{
    static const double most = 2.0; /* cells */
    const double *u = arrival->velocity, in = (arrival->side ? -1.0 : 1.0) * u[arrival->axis],
                 half = 0.5 * arrival->depth, limit = most * cfdmp->edge;
    const bool *open = cfdmp->cut.open[across];
    const double low = (double)cfdmp->cut.low[across] * cfdmp->edge + (open[0] ? 0.0 : 0.5 * room),
                 high =
                     (double)cfdmp->cut.high[across] * cfdmp->edge - (open[1] ? 0.0 : 0.5 * room);
    if (fabs(u[across]) * half < limit * in)
        place += half * u[across] / in;
    else if (in > 0.0)
        place += copysign(limit, u[across]);
    return minimum(maximum(place, low), high);
}

/* Whether this rank owns the particles of the cell AT. */
static bool is_own(const struct cfdmp *cfdmp, const int64_t at[3])
{
    double x[3] = {0.0, 0.0, 0.0};
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        x[axis] = ((double)at[axis] + 0.5) * cfdmp->edge;
    return partition_owner(&cfdmp->mpm_part.simulation.partition,
                           particles_block_key(mpm_particles(cfdmp->mpm), x)) == cfdmp->ranks->rank;
}

static struct error *emit(struct cfdmp *cfdmp, const struct arrival *arrival)
{
    struct particles *p = mpm_particles(cfdmp->mpm);
    const int axis = arrival->axis, side = arrival->side;
    struct gate *gate = &cfdmp->side[axis][side].gate[arrival->number];
    const int body = part_body_of(&cfdmp->gas_part.place, arrival->material);
    const int64_t each = part_particles_across(cfdmp->mpm, body);
    int64_t count = 1, at[3];
    int across[2];
    gate_axes(axis, across);
    for (int k = 1; k < cfdmp->dimension; k++)
        count *= each;
    int32_t first;
    gate->emitted++;
    gate_cell(cfdmp, axis, side, arrival->number, true, at);
    if (!is_own(cfdmp, at))
        return NULL;
    TRY(particles_append(p, (int32_t)count, &first));
    /* by layer, face and place */
    const int64_t emitted =
        (int64_t)PARTICLE_CREATED +
        ((((int64_t)gate->emitted - 1) * 6 + 2 * axis + side) * cfdmp->side[axis][side].gates +
         arrival->number) *
            count;
    const double sign = side ? -1.0 : 1.0,
                 plane = (double)(side ? cfdmp->cut.high : cfdmp->cut.low)[axis] * cfdmp->edge;
    for (int32_t k = 0; k < count; k++) {
        const int32_t i = first + k;
        const int64_t place[2] = {k % each, k / each};
        p->id[i] = particle_id(body, emitted + k);
        p->body[i] = (uint16_t)body;
        p->material[i] = (uint16_t)arrival->material;
        p->density[i] = arrival->density;
        p->energy[i] = arrival->energy;
        p->position[i][axis] = plane + sign * 0.5 * arrival->depth;
        for (int n = 0; n < cfdmp->dimension - 1; n++)
            p->position[i][across[n]] =
                ((double)at[across[n]] + ((double)place[n] + 0.5) / (double)each) * cfdmp->edge;
        p->mass[i] = arrival->mass / (double)count;
        if (cfdmp->round && axis > 0) /* in the cell, as the radius */
            p->mass[i] *= p->position[i][0] / (((double)at[0] + 0.5) * cfdmp->edge);
        for (int n = 0; n < cfdmp->dimension - 1; n++)
            p->position[i][across[n]] = drifted(
                cfdmp, arrival, across[n], p->position[i][across[n]], cfdmp->edge / (double)each);
        for (int n = 0; n < 3; n++)
            p->velocity[i][n] = arrival->velocity[n];
        part_burn(p, i);
        mpm_welcome(cfdmp->mpm, &cfdmp->mpm_part.simulation, i);
    }
    return NULL;
}

/* The specific energies of the materials that come in, of MASS and DENSITY: both have one pressure,
 * and together ENERGY, J, unless that takes them too far from the PRESSURE beside them. Returns
 * whether it does not. Where there are two, pressures grow in proportion to the energy. */
static bool share_energy(const struct gas_view *view, const double mass[2], const double density[2],
                         double energy, double pressure, double rest[2])
{
    const struct shared shared = gate_share(view, mass, density, energy);
    const bool near = shared.pressure > 0.5 * pressure && shared.pressure < 2.0 * pressure;
    for (int m = 0; m < 2; m++)
        rest[m] = ((near ? shared.pressure : pressure) - shared.cold[m]) / shared.slope[m];
    return near;
}

/* Where both gases are BESIDE a gate and one is next to nothing of what waits there, that comes in
 * as the other: a layer of it would be a single very hot particle, or never be full. */
static void drop_trace(const struct beside *beside, double pending[PASSES])
{
    static const double trace = 3e-5;
    const double all = pending[PASS_MASS];
    double *second = &pending[PASS_SECOND];
    if (!(beside->of[0] > 0.0 && beside->of[1] > 0.0))
        return;
    if (*second < trace * all)
        *second = 0.0;
    else if (all - *second < trace * all)
        *second = all;
}

/* Layers of particles, LAYER thick, come in through a gate: of each material of which one waits.
 * What is left waits on: particles of next to nothing, whose density follows from that of a trace
 * in cells of gas, would be squeezed with all that comes behind. */
static struct error *emit_layers(struct cfdmp *cfdmp, int axis, int side, int64_t number,
                                 const struct beside *beside, double layer)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    struct gate *gate = &cfdmp->side[axis][side].gate[number];
    const double area = gate_area(cfdmp, axis, side, number);
    drop_trace(beside, gate->pending);
    for (int m = 0; m < 2; m++) {
        const double all = gate->pending[PASS_MASS], second = gate->pending[PASS_SECOND];
        const double mass[2] = {beside->of[0] > 0.0 ? maximum(all - second, 0.0) : 0.0,
                                beside->of[1] > 0.0 ? maximum(second, 0.0) : 0.0};
        if (!(mass[m] > 0.0 && mass[m] >= beside->of[m] * area * layer))
            continue;
        double kinetic = 0.0, velocity[3], rest[2];
        for (int k = 0; k < 3; k++) {
            velocity[k] = gate->pending[PASS_MOMENTUM + k] / all;
            kinetic += 0.5 * square(velocity[k]);
        }
        if (!share_energy(&view, mass, beside->of, gate->pending[PASS_ENERGY] - all * kinetic,
                          beside->pressure, rest))
            for (int k = 0; k < 3; k++)
                velocity[k] = beside->velocity[k];
        const struct arrival arrival = {axis,
                                        side,
                                        view.material[m],
                                        number,
                                        mass[m],
                                        beside->of[m],
                                        rest[m],
                                        mass[m] / (beside->of[m] * area),
                                        {velocity[0], velocity[1], velocity[2]}};
        TRY(emit(cfdmp, &arrival));
        kinetic = 0.0;
        for (int k = 0; k < 3; k++) {
            gate->pending[PASS_MOMENTUM + k] -= mass[m] * velocity[k];
            kinetic += 0.5 * square(velocity[k]);
        }
        gate->pending[PASS_ENERGY] -= mass[m] * (rest[m] + kinetic);
        gate->pending[PASS_MASS] -= mass[m];
        gate->pending[PASS_SECOND] -= m ? mass[m] : 0.0;
    }
    return NULL;
}

/* Settling has two halves: what both want to give the cell outside stands in the side's `rest`, of
 * which comes back what it cannot bear. The first gives it what particles have not got of the
 * pressure, or as printed in the source, particles that have left. */
static void offer(struct cfdmp *cfdmp, int axis, int s, int64_t number)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    const struct side *side = &cfdmp->side[axis][s];
    const struct gate *gate = &side->gate[number];
    const struct beside beside = gate_beside(cfdmp, axis, s, number);
    double *rest = side->rest[number];
    int64_t outside[3];
    gate_cell(cfdmp, axis, s, number, false, outside);
    for (int n = 0; n < PASSES; n++)
        rest[n] = cfdmp->parameters.transport == CFDMP_PRINTED ? gate->pending[n] : 0.0;
    for (int k = 0; k < 3 && cfdmp->parameters.transport != CFDMP_PRINTED; k++)
        rest[PASS_MOMENTUM + k] = gate->push[k] - gate->pushed[k];
    if (cfdmp->parameters.transport != CFDMP_PRINTED)
        rest[PASS_ENERGY] = gate->push[3] - gate->pushed[3];
    gate_give(cfdmp, &view, outside, rest, beside.of);
}

/* The second, as printed in the source (4-10) to (4-21): the mean state of the cells beside a gate
 * flows into the region, a layer of particles each step. */
static struct error *settle_printed(struct cfdmp *cfdmp, int axis, int side, int64_t number,
                                    double dt)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    const struct beside beside = gate_beside(cfdmp, axis, side, number);
    const double area = gate_area(cfdmp, axis, side, number), sign = side ? -1.0 : 1.0;
    const double way = sign * beside.velocity[axis] * dt;
    const int m = view.layout->two && beside.of[0] == 0.0;
    const struct arrival arrival = {axis,
                                    side,
                                    view.material[m],
                                    number,
                                    beside.density * way * area,
                                    beside.density,
                                    beside.energy,
                                    way,
                                    {beside.velocity[0], beside.velocity[1], beside.velocity[2]}};
    return way > 0.0 ? emit(cfdmp, &arrival) : NULL;
}

/* Where material leaves, up to MOST of what waits at a gate between two layers of particles stays
 * there, in the state BESIDE the gate. The EXCESS is what the particles and the flow that the gas
 * took differ by. */
static void find_excess(const struct side *side, int64_t number, const struct beside *beside,
                        double most, double excess[PASSES])
{
    const struct gate *gate = &side->gate[number];
    const struct flank *flank = side->flank[number];
    const double mass = gate->pending[PASS_MASS], stays = minimum(maximum(mass, -most), most);
    double per_mass[PASSES] = {[PASS_MASS] = 1.0, [PASS_ENERGY] = beside->energy};
    for (int k = 0; k < 3; k++) {
        per_mass[PASS_MOMENTUM + k] = beside->velocity[k];
        per_mass[PASS_ENERGY] += 0.5 * square(beside->velocity[k]);
    }
    per_mass[PASS_SECOND] = 0.5 * (flank[0].second + flank[1].second) / beside->density;
    for (int n = 0; n < PASSES; n++)
        excess[n] = gate->pending[n] - stays * per_mass[n];
}

/* Of what waits, a layer becomes particles, or a part goes to the gas. */
static struct error *settle(struct cfdmp *cfdmp, int axis, int s, int64_t number, double dt)
{
    /* The excess goes to the gas over the time in which the flow crosses two cells. Much faster,
     * and each particle that leaves would be a pulse of sound. */
    static const double cells = 2.0;
    const struct gas_view view = gas_view(cfdmp->gas);
    const struct side *side = &cfdmp->side[axis][s];
    struct gate *gate = &side->gate[number];
    const struct beside beside = gate_beside(cfdmp, axis, s, number);
    const int body = part_body_of(&cfdmp->gas_part.place, view.material[0]);
    const double layer = cfdmp->edge / (double)part_particles_across(cfdmp->mpm, body);
    double *rest = side->rest[number];
    if (gate->flow > 0.0 && gate->pending[PASS_MASS] > 0.0)
        return emit_layers(cfdmp, axis, s, number, &beside, layer);
    if (!(gate->flow < 0.0))
        return NULL;
    const double part = minimum(dt * fabs(beside.velocity[axis]) / (cells * cfdmp->edge), 1.0);
    int64_t outside[3];
    find_excess(side, number, &beside, beside.density * layer * gate_area(cfdmp, axis, s, number),
                rest);
    for (int n = 0; n < PASSES; n++) {
        rest[n] *= part;
        gate->pending[n] -= rest[n];
    }
    gate_cell(cfdmp, axis, s, number, false, outside);
    gate_give(cfdmp, &view, outside, rest, beside.of);
    return NULL;
}

static struct error *(*const settle_of[])(struct cfdmp *, int axis, int side, int64_t number,
                                          double dt) = {settle, settle_printed};

/* Collective: all gates of a side. */
static struct error *settle_side(struct cfdmp *cfdmp, int axis, int s, double dt)
{
    const int transport = (int)cfdmp->parameters.transport;
    const struct side *side = &cfdmp->side[axis][s];
    struct error *error = NULL;
    for (int64_t n = 0; n < side->gates; n++)
        offer(cfdmp, axis, s, n);
    cfdmp_unite(cfdmp, &side->rest[0][0], side->gates * PASSES);
    for (int64_t n = 0; n < side->gates; n++) {
        for (int k = 0; k < PASSES; k++) {
            double *pending = &side->gate[n].pending[k];
            *pending = (transport == CFDMP_PRINTED ? 0.0 : *pending) + side->rest[n][k];
            side->rest[n][k] = 0.0;
        }
        if (!error)
            error = settle_of[transport](cfdmp, axis, s, n, dt);
    }
    TRY(ranks_agree(cfdmp->ranks, error));
    cfdmp_unite(cfdmp, &side->rest[0][0], side->gates * PASSES);
    for (int64_t n = 0; n < side->gates; n++)
        for (int k = 0; k < PASSES; k++)
            side->gate[n].pending[k] += side->rest[n][k];
    return NULL;
}

/* What waits at a gate is in neither part. */
static void book(const struct cfdmp *cfdmp, struct simulation *simulation, int axis, int side,
                 int64_t number, const double before[PASSES])
{
    const struct gate *gate = &cfdmp->side[axis][side].gate[number];
    int64_t at[3];
    double change[PASSES];
    gate_cell(cfdmp, axis, side, number, true, at);
    for (int n = 0; n < PASSES; n++)
        change[n] = before[n] - gate->pending[n];
    const double h = cfdmp->edge;
    ledger_book(
        &simulation->ledger, LEDGER_EXCHANGE, change[PASS_MASS],
        vec3_make(change[PASS_MOMENTUM], change[PASS_MOMENTUM + 1], change[PASS_MOMENTUM + 2]),
        vec3_make(((double)at[0] + 0.5) * h, ((double)at[1] + 0.5) * h, ((double)at[2] + 0.5) * h),
        change[PASS_ENERGY]);
}

/* Books what has come to the gates of a side and gone since the last step. */
static void book_side(struct cfdmp *cfdmp, struct simulation *simulation, int axis, int s)
{
    const struct side *side = &cfdmp->side[axis][s];
    for (int64_t n = 0; n < side->gates; n++) {
        if (cfdmp->ranks->rank == 0)
            book(cfdmp, simulation, axis, s, n, side->gate[n].booked);
        memcpy(side->gate[n].booked, side->gate[n].pending, sizeof side->gate[n].booked);
    }
}

struct error *cfdmp_transport(struct cfdmp *cfdmp, struct simulation *simulation, double dt)
{
    const bool awake = cfdmp->awake > 0.0; /* else what little comes waits */
    if (awake) {
        TRY(cfdmp_take_pushes(cfdmp));
        if (cfdmp->parameters.transport != CFDMP_PRINTED)
            cfdmp_share_uncovered(cfdmp, simulation);
        TRY(cfdmp_take_out(cfdmp));
        cfdmp_look(cfdmp);
        if (cfdmp->parameters.transport != CFDMP_PRINTED)
            cfdmp_even_out(cfdmp, dt);
    }
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int s = 0; s < 2; s++) {
            if (cfdmp->side[axis][s].gates == 0)
                continue;
            if (awake)
                TRY(settle_side(cfdmp, axis, s, dt));
            if (cfdmp->parameters.transport != CFDMP_PRINTED)
                book_side(cfdmp, simulation, axis, s);
        }
    return NULL;
}
