/* What passes between the gas and the particles through the open faces of the region (4-10) to
 * (4-21), so that nothing is lost: the flux of the gas solver's step gives the pressure, which
 * pushes on the particles, and the flow of material, which is kept at the face until it makes a
 * layer of particles. Particles that leave are kept there likewise, and the gas, which had taken the
 * flow already, gets the difference little by little. */
#include "couple/cfdmp.h"
#include "material/material.h"

int32_t cfdmp_cell(const struct cell_blocks *cells, const int64_t at[3], int32_t *block)
{
    const struct cell_block *found = cell_block_find(cells, cell_block_key(cells->dimension, at));
    assert(found);
    int32_t i = found->first;
    for (int axis = 0; axis < cells->dimension; axis++)
        i += (int32_t)(at[axis] - found->corner[axis]) * cell_stride(found, axis);
    *block = (int32_t)(found - cells->block);
    return i;
}

static void across_of(int axis, int across[2])
{
    across[0] = axis == 0 ? 1 : 0;
    across[1] = axis == 2 ? 1 : 2;
}

struct gate *cfdmp_gate(struct cfdmp *cfdmp, int axis, int side, const int64_t at[3])
{
    int across[2];
    int64_t n[2];
    across_of(axis, across);
    for (int k = 0; k < 2; k++) {
        const int64_t last = cfdmp->count[across[k]] - 1,
                      here = at[across[k]] - cfdmp->cut.low[across[k]];
        n[k] = here < 0 ? 0 : here > last ? last : here;
    }
    return &cfdmp->side[axis][side].gate[n[0] + n[1] * cfdmp->count[across[0]]];
}

/* The cell behind gate NUMBER of a face, INSIDE the region or outside. */
static void cell_of_gate(const struct cfdmp *cfdmp, int axis, int side, int64_t number, bool inside,
                         int64_t at[3])
{
    int across[2];
    across_of(axis, across);
    at[across[0]] = cfdmp->cut.low[across[0]] + number % cfdmp->count[across[0]];
    at[across[1]] = cfdmp->cut.low[across[1]] + number / cfdmp->count[across[0]];
    at[axis] = side ? cfdmp->cut.high[axis] - inside : cfdmp->cut.low[axis] - !inside;
}

static double cell_volume(const struct cfdmp *cfdmp)
{
    double volume = 1.0;
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        volume *= cfdmp->edge;
    return volume;
}

/* Adds VALUES, conserved, to the cell outside a gate. */
static void give_gas(struct cfdmp *cfdmp, const struct gas_view *view, const int64_t at[3],
                     const double values[PASSES])
{
    const double per = 1.0 / cell_volume(cfdmp);
    int32_t block;
    const int32_t i = cfdmp_cell(view->cells, at, &block);
    for (int n = 0; n < GAS_NUMBERS; n++)
        view->u[n][i] += per * values[n];
    if (view->layout->two)
        view->u[GAS_SECOND][i] += per * values[PASS_SECOND];
    cfdmp->changed[block] = true;
}

/* The mean of the cells on both sides of a gate. */
struct beside {
    double density, velocity[3], energy, sound;
};

static struct beside beside_of(const struct cfdmp *cfdmp, const struct gas_view *view, int axis,
                               int side, int64_t number)
{
    struct beside beside = {0.0, {0.0, 0.0, 0.0}, 0.0, 0.0};
    const double *sound = cell_blocks_field(view->cells, "sound_long");
    for (int inside = 0; inside < 2; inside++) {
        int64_t at[3];
        int32_t block;
        cell_of_gate(cfdmp, axis, side, number, inside, at);
        const int32_t i = cfdmp_cell(view->cells, at, &block);
        beside.density += 0.5 * view->cells->density[i];
        beside.energy += 0.5 * view->cells->energy[i];
        beside.sound = maximum(beside.sound, sound[i]);
        for (int k = 0; k < 3; k++)
            beside.velocity[k] += 0.5 * view->cells->velocity[i][k];
    }
    return beside;
}

/* Splits what has passed through a gate into pressure and flow; of the begin of the step is
 * BESIDE. */
static void split(struct cfdmp *cfdmp, int axis, int side, const struct beside *beside,
                  const double *passed, double dt, struct gate *gate)
{
    const double area = cell_volume(cfdmp) / cfdmp->edge, into = side ? -area : area;
    const double velocity = beside->velocity[axis],
                 push = passed[GAS_MOMENTUM + axis] - passed[GAS_DENSITY] * velocity;
    gate->pressure = push / dt;
    gate->flow = into * passed[GAS_DENSITY];
    for (int k = 0; k < 3; k++)
        gate->push[k] = k == axis ? into * push : 0.0;
    gate->push[3] = into * push * velocity;
    for (int n = 0; n < GAS_NUMBERS; n++)
        gate->pending[n] += into * passed[n];
    gate->pending[PASS_SECOND] += into * passed[GAS_NUMBERS];
    gate->pending[PASS_MOMENTUM + axis] -= gate->push[axis];
    gate->pending[PASS_ENERGY] -= gate->push[3];
    for (int k = 0; k < 4; k++)
        gate->pushed[k] = 0.0;
}

void cfdmp_find_pressures(struct cfdmp *cfdmp, double dt)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int64_t n = 0; n < cfdmp->side[axis][side].gates; n++) {
                const struct beside beside = beside_of(cfdmp, &view, axis, side, n);
                split(cfdmp, axis, side, &beside, &cfdmp->cut.passed[axis][side][n * GAS_PASSED],
                      dt, &cfdmp->side[axis][side].gate[n]);
            }
}

/* A particle that has left through an open face of the region waits there. */
static bool take_out(struct cfdmp *cfdmp, struct particles *p, int32_t i, bool second)
{
    const double *x = p->position[i], *u = p->velocity[i], m = p->mass[i];
    int64_t at[3] = {0, 0, 0};
    double most = 0.0;
    int through = -1, at_side = 0;
    for (int axis = 0; axis < cfdmp->dimension; axis++) {
        const double place = x[axis] / cfdmp->edge;
        at[axis] = (int64_t)floor(place);
        for (int side = 0; side < 2; side++) {
            const double beyond =
                side ? place - (double)cfdmp->cut.high[axis] : (double)cfdmp->cut.low[axis] - place;
            if (cfdmp->cut.open[axis][side] && beyond > most) {
                most = beyond;
                through = axis;
                at_side = side;
            }
        }
    }
    if (through < 0)
        return false;
    struct gate *gate = cfdmp_gate(cfdmp, through, at_side, at);
    double kinetic = 0.0;
    for (int k = 0; k < 3; k++) {
        gate->pending[PASS_MOMENTUM + k] += m * u[k];
        kinetic += 0.5 * u[k] * u[k];
    }
    gate->pending[PASS_MASS] += m;
    gate->pending[PASS_ENERGY] += m * (p->energy[i] + kinetic);
    gate->pending[PASS_SECOND] += second ? m : 0.0;
    particles_delete(p, i);
    return true;
}

/* The body whose particles those that come in belong to: the first of MATERIAL. */
static int body_of(const struct cfdmp *cfdmp, int material)
{
    const struct simulation_case *input = &cfdmp->mpm_part.input;
    int body = 0;
    while (body + 1 < input->bodies.count && case_body(input, body)->material_index != material)
        body++;
    return body;
}

/* Particles of a layer along an axis, in a cell. */
static int64_t particles_across(const struct cfdmp *cfdmp, int body)
{
    const double count = 0.5 / mpm_half_size(cfdmp->mpm, body);
    return count < 1.0 ? 1 : (int64_t)(count + 0.5);
}

/* A layer of particles of one material comes in through a gate. */
static struct error *emit(struct cfdmp *cfdmp, struct simulation *simulation, int axis, int side,
                          int64_t number, const struct beside *beside, bool second)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    struct particles *p = mpm_particles(cfdmp->mpm);
    struct gate *gate = &cfdmp->side[axis][side].gate[number];
    const int material = view.material[second], body = body_of(cfdmp, material);
    const int64_t each = particles_across(cfdmp, body);
    const double area = cell_volume(cfdmp) / cfdmp->edge, mass = gate->pending[PASS_MASS];
    const double layer = mass / (beside->density * area);
    int64_t count = 1, at[3];
    int across[2];
    across_of(axis, across);
    for (int k = 1; k < cfdmp->dimension; k++)
        count *= each;
    double kinetic = 0.0, velocity[3];
    for (int k = 0; k < 3; k++) {
        velocity[k] = gate->pending[PASS_MOMENTUM + k] / mass;
        kinetic += 0.5 * square(velocity[k]);
    }
    double energy = gate->pending[PASS_ENERGY] / mass - kinetic;
    if (!(energy > 0.5 * beside->energy && energy < 2.0 * beside->energy)) {
        energy = beside->energy;
        for (int k = 0; k < 3; k++)
            velocity[k] = beside->velocity[k];
    }
    int32_t first;
    TRY(particles_append(p, (int32_t)count, &first));
    cell_of_gate(cfdmp, axis, side, number, true, at);
    /* by layer, face and place, beyond the sites of any body */
    const int64_t emitted =
        ((int64_t)1 << (PARTICLE_SITE_BITS - 1)) +
        (((int64_t)gate->emitted * 6 + 2 * axis + side) * cfdmp->side[axis][side].gates + number) *
            count;
    const double sign = side ? -1.0 : 1.0,
                 plane = (double)(side ? cfdmp->cut.high : cfdmp->cut.low)[axis] * cfdmp->edge;
    for (int32_t k = 0; k < count; k++) {
        const int32_t i = first + k;
        const int64_t place[2] = {k % each, k / each};
        p->id[i] = particle_id(body, emitted + k);
        p->body[i] = (uint16_t)body;
        p->material[i] = (uint16_t)material;
        p->mass[i] = mass / (double)count;
        p->density[i] = beside->density;
        p->energy[i] = energy;
        p->position[i][axis] = plane + sign * 0.5 * layer;
        for (int n = 0; n < cfdmp->dimension - 1; n++)
            p->position[i][across[n]] =
                ((double)at[across[n]] + ((double)place[n] + 0.5) / (double)each) * cfdmp->edge;
        for (int n = 0; n < 3; n++)
            p->velocity[i][n] = velocity[n];
        mpm_welcome(cfdmp->mpm, &cfdmp->mpm_part.simulation, i);
    }
    (void)simulation;
    gate->emitted++;
    gate->pending[PASS_MASS] = gate->pending[PASS_SECOND] = 0.0;
    kinetic = 0.0;
    for (int k = 0; k < 3; k++) {
        gate->pending[PASS_MOMENTUM + k] -= mass * velocity[k];
        kinetic += 0.5 * square(velocity[k]);
    }
    gate->pending[PASS_ENERGY] -= mass * (energy + kinetic);
    return NULL;
}

/* A part of what waits goes to the gas. */
static void pour(struct cfdmp *cfdmp, const struct gas_view *view, const int64_t at[3],
                 struct gate *gate, double part)
{
    double values[PASSES];
    for (int n = 0; n < PASSES; n++) {
        values[n] = part * gate->pending[n];
        gate->pending[n] -= values[n];
    }
    give_gas(cfdmp, view, at, values);
}

static struct error *settle(struct cfdmp *cfdmp, struct simulation *simulation, int axis, int side,
                            int64_t number, double dt)
{
    static const double rate = 0.25; /* of what the gas gets, of the time that sound takes */
    const struct gas_view view = gas_view(cfdmp->gas);
    struct gate *gate = &cfdmp->side[axis][side].gate[number];
    const struct beside beside = beside_of(cfdmp, &view, axis, side, number);
    const int body = body_of(cfdmp, view.material[0]);
    const double layer = cell_volume(cfdmp) / (double)particles_across(cfdmp, body);
    double difference[PASSES] = {0.0};
    int64_t outside[3];
    cell_of_gate(cfdmp, axis, side, number, false, outside);
    for (int k = 0; k < 3; k++)
        difference[PASS_MOMENTUM + k] = gate->push[k] - gate->pushed[k];
    difference[PASS_ENERGY] = gate->push[3] - gate->pushed[3];
    give_gas(cfdmp, &view, outside, difference);
    if (gate->flow > 0.0 && gate->pending[PASS_MASS] >= beside.density * layer) {
        TRY(emit(cfdmp, simulation, axis, side, number, &beside, false));
        pour(cfdmp, &view, outside, gate, 1.0);
    } else if (gate->flow < 0.0) {
        const double part = rate * dt * (beside.sound + fabs(beside.velocity[axis])) / cfdmp->edge;
        pour(cfdmp, &view, outside, gate, minimum(part, 1.0));
    }
    return NULL;
}

/* What waits at a gate is in neither part. */
static void book(const struct cfdmp *cfdmp, struct simulation *simulation, int axis, int side,
                 int64_t number, const double before[PASSES])
{
    const struct gate *gate = &cfdmp->side[axis][side].gate[number];
    int64_t at[3];
    double change[PASSES];
    cell_of_gate(cfdmp, axis, side, number, true, at);
    for (int n = 0; n < PASSES; n++)
        change[n] = before[n] - gate->pending[n];
    const double h = cfdmp->edge;
    ledger_book(
        &simulation->ledger, LEDGER_EXCHANGE, change[PASS_MASS],
        vec3_make(change[PASS_MOMENTUM], change[PASS_MOMENTUM + 1], change[PASS_MOMENTUM + 2]),
        vec3_make(((double)at[0] + 0.5) * h, ((double)at[1] + 0.5) * h, ((double)at[2] + 0.5) * h),
        change[PASS_ENERGY]);
}

struct error *cfdmp_transport(struct cfdmp *cfdmp, struct simulation *simulation, double dt)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    struct particles *p = mpm_particles(cfdmp->mpm);
    for (int32_t i = 0; i < p->count; i++)
        take_out(cfdmp, p, i, view.layout->two && p->material[i] == view.material[1]);
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int64_t n = 0; n < cfdmp->side[axis][side].gates; n++) {
                double *booked = cfdmp->side[axis][side].gate[n].booked;
                TRY(settle(cfdmp, simulation, axis, side, n, dt));
                book(cfdmp, simulation, axis, side, n, booked);
                for (int k = 0; k < PASSES; k++)
                    booked[k] = cfdmp->side[axis][side].gate[n].pending[k];
            }
    return NULL;
}

/* Whether the node AT of the part across AXIS lies near the open face on SIDE. */
static double distance_to(const struct cfdmp *cfdmp, int axis, int side, const int64_t at[3])
{
    const int64_t plane = (side ? cfdmp->cut.high : cfdmp->cut.low)[axis];
    return cfdmp->cut.open[axis][side] ? fabs((double)(at[axis] - plane)) : (double)INFINITY;
}

/* The gates around the node AT through which its force along COMPONENT comes, with equal parts:
 * across that axis where a face is near, else across another. Returns their number. */
static int gates_at(struct cfdmp *cfdmp, const int64_t at[3], int component, struct gate *gate[4])
{
    static const double near = 2.0;
    int axis = -1, side = 0, count = 0, across[2];
    double least = (double)INFINITY;
    for (int k = 0; k < 3; k++)
        for (int s = 0; s < 2; s++) {
            double distance = distance_to(cfdmp, k, s, at);
            if (distance > near)
                continue;
            distance -= k == component ? 2.0 * near : 0.0;
            if (distance < least) {
                least = distance;
                axis = k;
                side = s;
            }
        }
    if (axis < 0)
        return 0;
    across_of(axis, across);
    for (int k = 0; k < 4; k++) {
        int64_t cell[3] = {at[0], at[1], at[2]};
        cell[across[0]] -= k % 2;
        cell[across[1]] -= k / 2;
        gate[count++] = cfdmp_gate(cfdmp, axis, side, cell);
    }
    return count;
}

static double pressure_at(void *of, const int64_t at[3], int component)
{
    struct cfdmp *cfdmp = of;
    struct gate *gate[4];
    const int count = gates_at(cfdmp, at, component, gate);
    double sum = 0.0;
    for (int k = 0; k < count; k++)
        sum += gate[k]->pressure / count;
    return sum - mpm_gauge(cfdmp->mpm, gas_view(cfdmp->gas).material[0]);
}

static void take_push(void *of, const int64_t at[3], const double impulse[3], double work)
{
    struct cfdmp *cfdmp = of;
    double strength = 0.0;
    for (int c = 0; c < 3; c++)
        strength += fabs(impulse[c]);
    for (int c = 0; c < 3; c++) {
        struct gate *gate[4];
        const int count = gates_at(cfdmp, at, c, gate);
        for (int k = 0; k < count; k++) {
            gate[k]->pushed[c] += impulse[c] / count;
            gate[k]->pushed[3] += work * fabs(impulse[c]) / (strength * count);
        }
    }
}

void cfdmp_surround(struct cfdmp *cfdmp)
{
    struct mpm_outside *outside = &cfdmp->outside;
    for (int axis = 0; axis < 3; axis++) {
        outside->low[axis] = cfdmp->cut.low[axis];
        outside->high[axis] = cfdmp->cut.high[axis];
        for (int side = 0; side < 2; side++)
            outside->open[axis][side] = cfdmp->cut.open[axis][side];
    }
    outside->of = cfdmp;
    outside->pressure = pressure_at;
    outside->pushed = take_push;
    mpm_surround(cfdmp->mpm, outside);
}
