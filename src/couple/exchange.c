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

/* The volume of the cell AT, of a radian in axisymmetry. */
static double cell_volume(const struct cfdmp *cfdmp, const int64_t at[3])
{
    double volume = cfdmp->round ? ((double)at[0] + 0.5) * cfdmp->edge : 1.0;
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        volume *= cfdmp->edge;
    return volume;
}

/* The area of gate NUMBER. */
static double gate_area(const struct cfdmp *cfdmp, int axis, int side, int64_t number)
{
    int64_t at[3];
    cell_of_gate(cfdmp, axis, side, number, true, at);
    const double radius =
        axis > 0 ? (double)at[0] + 0.5 : (double)(side ? cfdmp->cut.high : cfdmp->cut.low)[0];
    double area = cfdmp->round ? radius * cfdmp->edge : 1.0;
    for (int k = 1; k < cfdmp->dimension; k++)
        area *= cfdmp->edge;
    return area;
}

/* The state of a cell: conserved numbers, the second material's mass per volume and its fraction. */
struct content {
    double u[GAS_NUMBERS], second, fraction;
};

static struct content content_of(const struct gas_view *view, int32_t i)
{
    struct content content = {{0.0}, 0.0, 0.0};
    for (int n = 0; n < GAS_NUMBERS; n++)
        content.u[n] = view->u[n][i];
    if (view->layout->two) {
        content.second = view->u[GAS_SECOND][i];
        content.fraction = view->u[GAS_FRACTION][i];
    }
    return content;
}

/* The pressure of both materials of a cell together, which grows in proportion to the energy where
 * there are two. */
static double pressure_of(const struct gas_view *view, const struct content *content)
{
    const double none[POINT_HISTORY] = {0.0}, *u = content->u;
    double kinetic = 0.0, over, per = 0.0;
    for (int axis = 0; axis < 3; axis++)
        kinetic += 0.5 * square(u[GAS_MOMENTUM + axis]) / u[GAS_DENSITY];
    over = u[GAS_ENERGY] - kinetic;
    if (!view->layout->two)
        return eos_evaluate(view->eos, u[GAS_DENSITY], over / u[GAS_DENSITY], none).pressure;
    const double mass[2] = {u[GAS_DENSITY] - content->second, content->second},
                 part[2] = {1.0 - content->fraction, content->fraction};
    for (int m = 0; m < 2; m++)
        if (part[m] > 0.0 && mass[m] > 0.0) {
            const struct eos_value cold = eos_evaluate(&view->eos[m], mass[m] / part[m], 0.0, none);
            over += mass[m] * cold.pressure / cold.dp_de;
            per += mass[m] / cold.dp_de;
        }
    return over / per;
}

/* CONTENT with VALUES per volume more; materials have the densities OF, 0 where they are not
 * known. */
static struct content content_with(const struct gas_view *view, struct content content,
                                   const double values[PASSES], const double of[2])
{
    for (int n = 0; n < GAS_NUMBERS; n++)
        content.u[n] += values[n];
    if (!view->layout->two)
        return content;
    const double given[2] = {values[PASS_MASS] - values[PASS_SECOND], values[PASS_SECOND]};
    const double volume[2] = {of[0] > 0.0 ? given[0] / of[0] : 0.0,
                              of[1] > 0.0 ? given[1] / of[1] : 0.0};
    content.second += given[1];
    content.fraction = (content.fraction + volume[1]) / (1.0 + volume[0] + volume[1]);
    const double all = content.u[GAS_DENSITY], trace = 1e-8;
    if (fabs(content.second) <= trace * all)
        content.fraction = content.second = 0.0;
    if (fabs(content.second - all) <= trace * all) {
        content.fraction = 1.0;
        content.second = all;
    }
    return content;
}

/* The density of material M in a cell, 0 where there is none. */
static double density_in(const struct content *content, int m)
{
    const double mass = m ? content->second : content->u[GAS_DENSITY] - content->second,
                 part = m ? content->fraction : 1.0 - content->fraction;
    return part > 0.0 ? mass / part : 0.0;
}

/* Whether a cell keeps half of its density and of its pressure, and of each material some at about
 * the density that it had, or that it has beside the gate, OF. */
static bool is_bearable(const struct gas_view *view, const struct content *before,
                        const struct content *after, const double of[2])
{
    static const double most = 5.0;
    const double all = after->u[GAS_DENSITY];
    if (!(all > 0.5 * before->u[GAS_DENSITY]))
        return false;
    if (after->second < 0.0 || after->second > all || !(after->fraction >= 0.0) ||
        after->fraction > 1.0 || (after->fraction == 0.0) != (after->second == 0.0) ||
        (after->fraction == 1.0) != (after->second == all && view->layout->two))
        return false;
    for (int m = 0; m < 2 && view->layout->two; m++) {
        const double now = density_in(after, m), was = density_in(before, m);
        const double than = was > 0.0 ? was : of[m];
        if (now != 0.0 && !(now < most * than && than < most * now))
            return false;
    }
    return pressure_of(view, after) > 0.5 * pressure_of(view, before);
}

/* Adds REST, conserved, to the cell outside a gate; materials have the densities OF, 0 where they
 * are not known. REST becomes what the cell cannot bear at once: it takes all, a half, a quarter
 * and so on. */
static void give_gas(struct cfdmp *cfdmp, const struct gas_view *view, const int64_t at[3],
                     double rest[PASSES], const double of[2])
{
    enum { HALVINGS = 10 };
    int32_t block;
    const int32_t i = cfdmp_cell(view->cells, at, &block);
    const struct content before = content_of(view, i);
    double part = 1.0 / cell_volume(cfdmp, at), values[PASSES];
    const double all = part;
    struct content after = before;
    bool bearable = false;
    for (int k = 0; k < HALVINGS && !bearable; k++, part *= bearable ? 1.0 : 0.5) {
        for (int n = 0; n < PASSES; n++)
            values[n] = part * rest[n];
        after = content_with(view, before, values, of);
        bearable = is_bearable(view, &before, &after, of);
    }
    if (!bearable)
        return;
    for (int n = 0; n < PASSES; n++)
        rest[n] -= values[n] / all;
    for (int n = 0; n < GAS_NUMBERS; n++)
        view->u[n][i] = after.u[n];
    if (view->layout->two) {
        view->u[GAS_SECOND][i] = after.second;
        view->u[GAS_FRACTION][i] = after.fraction;
    }
    cfdmp->changed[block] = true;
}

/* The mean of the cells on both sides of a gate; the densities of both materials where they are, 0
 * where there is none. */
struct beside {
    double density, velocity[3], energy, sound, pressure, of[2];
};

static struct beside beside_of(const struct cfdmp *cfdmp, const struct gas_view *view, int axis,
                               int side, int64_t number)
{
    struct beside beside = {0.0, {0.0, 0.0, 0.0}, 0.0, 0.0, 0.0, {0.0, 0.0}};
    const double *sound = cell_blocks_field(view->cells, "sound_long");
    double mass[2] = {0.0, 0.0}, volume[2] = {0.0, 0.0};
    for (int inside = 0; inside < 2; inside++) {
        int64_t at[3];
        int32_t block;
        cell_of_gate(cfdmp, axis, side, number, inside, at);
        const int32_t i = cfdmp_cell(view->cells, at, &block);
        const double second = view->layout->two ? view->u[GAS_SECOND][i] : 0.0,
                     fraction = view->layout->two ? view->u[GAS_FRACTION][i] : 0.0;
        beside.density += 0.5 * view->cells->density[i];
        beside.energy += 0.5 * view->cells->energy[i];
        beside.pressure += 0.5 * view->cells->pressure[i];
        beside.sound = maximum(beside.sound, sound[i]);
        for (int k = 0; k < 3; k++)
            beside.velocity[k] += 0.5 * view->cells->velocity[i][k];
        mass[0] += view->cells->density[i] - second;
        mass[1] += second;
        volume[0] += 1.0 - fraction;
        volume[1] += fraction;
    }
    for (int m = 0; m < 2; m++)
        beside.of[m] = volume[m] > 1e-6 && mass[m] > 0.0 ? mass[m] / volume[m] : 0.0;
    return beside;
}

/* Splits what has passed through a gate into pressure and flow; of the begin of the step is
 * BESIDE. */
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
}

void cfdmp_find_pressures(struct cfdmp *cfdmp, double dt)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int64_t n = 0; n < cfdmp->side[axis][side].gates; n++) {
                const struct beside beside = beside_of(cfdmp, &view, axis, side, n);
                split(cfdmp, axis, side, n, &beside, dt);
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

/* The body whose particles those that come in belong to: the first of MATERIAL, or where the products
 * of another case have none, the first that is gas. */
static int body_of(const struct cfdmp *cfdmp, int material)
{
    const struct simulation_case *input = &cfdmp->gas_part.input;
    int first = -1;
    for (int body = 0; body < input->bodies.count; body++) {
        if (case_body(input, body)->material_index == material)
            return body;
        if (first < 0 && !case_body(input, body)->elsewhere)
            first = body;
    }
    return first;
}

/* Particles of a layer along an axis, in a cell. */
static int64_t particles_across(const struct cfdmp *cfdmp, int body)
{
    const double count = 0.5 / mpm_half_size(cfdmp->mpm, body);
    return count < 1.0 ? 1 : (int64_t)(count + 0.5);
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

static struct error *emit(struct cfdmp *cfdmp, const struct arrival *arrival)
{
    struct particles *p = mpm_particles(cfdmp->mpm);
    const int axis = arrival->axis, side = arrival->side;
    struct gate *gate = &cfdmp->side[axis][side].gate[arrival->number];
    const int body = body_of(cfdmp, arrival->material);
    const int64_t each = particles_across(cfdmp, body);
    int64_t count = 1, at[3];
    int across[2];
    across_of(axis, across);
    for (int k = 1; k < cfdmp->dimension; k++)
        count *= each;
    int32_t first;
    TRY(particles_append(p, (int32_t)count, &first));
    cell_of_gate(cfdmp, axis, side, arrival->number, true, at);
    /* by layer, face and place */
    const int64_t emitted =
        (int64_t)PARTICLE_CREATED +
        (((int64_t)gate->emitted * 6 + 2 * axis + side) * cfdmp->side[axis][side].gates +
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
        if (p->history[HISTORY_lighting_time])
            p->history[HISTORY_lighting_time][i] = -1.0; /* it has burnt */
        mpm_welcome(cfdmp->mpm, &cfdmp->mpm_part.simulation, i);
    }
    gate->emitted++;
    return NULL;
}

/* The specific energies of the materials that come in, of MASS and DENSITY: both have one pressure,
 * and together ENERGY, J, unless that takes them too far from the PRESSURE beside them. Returns
 * whether it does not. Where there are two, pressures grow in proportion to the energy. */
static bool share_energy(const struct gas_view *view, const double mass[2], const double density[2],
                         double energy, double pressure, double rest[2])
{
    const double none[POINT_HISTORY] = {0.0};
    double cold[2] = {0.0, 0.0}, slope[2] = {1.0, 1.0}, over = energy, per = 0.0;
    for (int m = 0; m < 2; m++)
        if (mass[m] > 0.0) {
            const struct eos_value value = eos_evaluate(&view->eos[m], density[m], 0.0, none);
            cold[m] = value.pressure;
            slope[m] = value.dp_de;
            over += mass[m] * cold[m] / slope[m];
            per += mass[m] / slope[m];
        }
    const double common = over / per;
    const bool near = common > 0.5 * pressure && common < 2.0 * pressure;
    for (int m = 0; m < 2; m++)
        rest[m] = ((near ? common : pressure) - cold[m]) / slope[m];
    return near;
}

/* Layers of particles, LAYER thick, come in through a gate: of each material of which one waits.
 * What is left waits on: particles of next to nothing, whose density follows from that of a trace in
 * cells of gas, would be squeezed with all that comes behind. */
static struct error *emit_layers(struct cfdmp *cfdmp, int axis, int side, int64_t number,
                                 const struct beside *beside, double layer)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    struct gate *gate = &cfdmp->side[axis][side].gate[number];
    const double area = gate_area(cfdmp, axis, side, number);
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

/* A part of what waits goes to the gas. */
static void pour(struct cfdmp *cfdmp, const struct gas_view *view, const int64_t at[3],
                 struct gate *gate, const struct beside *beside, double part)
{
    double values[PASSES];
    for (int n = 0; n < PASSES; n++) {
        values[n] = part * gate->pending[n];
        gate->pending[n] -= values[n];
    }
    give_gas(cfdmp, view, at, values, beside->of);
    for (int n = 0; n < PASSES; n++)
        gate->pending[n] += values[n];
}

/* As printed in the source (4-10) to (4-21): the mean state of the cells beside a gate flows into
 * the region, a layer of particles each step, and the cell outside gets the particles that have
 * left, beside what the gas solver's own step has moved. */
static struct error *settle_printed(struct cfdmp *cfdmp, int axis, int side, int64_t number,
                                    double dt)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    struct gate *gate = &cfdmp->side[axis][side].gate[number];
    const struct beside beside = beside_of(cfdmp, &view, axis, side, number);
    const double area = gate_area(cfdmp, axis, side, number), sign = side ? -1.0 : 1.0;
    const double way = sign * beside.velocity[axis] * dt;
    const int m = view.layout->two && beside.of[0] == 0.0;
    int64_t outside[3];
    cell_of_gate(cfdmp, axis, side, number, false, outside);
    give_gas(cfdmp, &view, outside, gate->pending, beside.of);
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

static struct error *settle(struct cfdmp *cfdmp, int axis, int side, int64_t number, double dt)
{
    /* What waits goes to the gas over the time in which the flow crosses two cells. Much faster, and
     * each particle that leaves would be a pulse of sound. */
    static const double cells = 2.0;
    const struct gas_view view = gas_view(cfdmp->gas);
    struct gate *gate = &cfdmp->side[axis][side].gate[number];
    const struct beside beside = beside_of(cfdmp, &view, axis, side, number);
    const int body = body_of(cfdmp, view.material[0]);
    const double layer = cfdmp->edge / (double)particles_across(cfdmp, body);
    double difference[PASSES] = {0.0};
    int64_t outside[3];
    cell_of_gate(cfdmp, axis, side, number, false, outside);
    for (int k = 0; k < 3; k++)
        difference[PASS_MOMENTUM + k] = gate->push[k] - gate->pushed[k];
    difference[PASS_ENERGY] = gate->push[3] - gate->pushed[3];
    give_gas(cfdmp, &view, outside, difference, beside.of);
    for (int n = 0; n < PASSES; n++)
        gate->pending[n] += difference[n];
    if (gate->flow > 0.0 && gate->pending[PASS_MASS] > 0.0)
        TRY(emit_layers(cfdmp, axis, side, number, &beside, layer));
    else if (gate->flow < 0.0) {
        const double part = dt * fabs(beside.velocity[axis]) / (cells * cfdmp->edge);
        pour(cfdmp, &view, outside, gate, &beside, minimum(part, 1.0));
    }
    return NULL;
}

static struct error *(*const settle_of[])(struct cfdmp *, int axis, int side, int64_t number,
                                          double dt) = {settle, settle_printed};

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
    const bool awake = cfdmp->awake > 0.0; /* else what little comes waits */
    for (int32_t i = 0; i < p->count && awake; i++)
        take_out(cfdmp, p, i, view.layout->two && p->material[i] == view.material[1]);
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int64_t n = 0; n < cfdmp->side[axis][side].gates; n++) {
                double *booked = cfdmp->side[axis][side].gate[n].booked;
                if (awake)
                    TRY(settle_of[cfdmp->parameters.transport](cfdmp, axis, side, n, dt));
                if (cfdmp->parameters.transport == CFDMP_PRINTED)
                    continue;
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

static double pressure_outside(const struct cfdmp *cfdmp, const struct gas_view *view, int axis,
                               int side, int64_t number)
{
    int64_t at[3];
    int32_t block;
    cell_of_gate(cfdmp, axis, side, number, false, at);
    return view->cells->pressure[cfdmp_cell(view->cells, at, &block)];
}

void cfdmp_note_rest(struct cfdmp *cfdmp)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int64_t n = 0; n < cfdmp->side[axis][side].gates; n++)
                cfdmp->side[axis][side].gate[n].rest =
                    pressure_outside(cfdmp, &view, axis, side, n);
}

bool cfdmp_stirs(const struct cfdmp *cfdmp)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    const double wake = cfdmp->parameters.wake;
    bool stirs = false;
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int64_t n = 0; n < cfdmp->side[axis][side].gates && !stirs; n++) {
                const double now = pressure_outside(cfdmp, &view, axis, side, n),
                             rest = cfdmp->side[axis][side].gate[n].rest;
                stirs = !(now < wake * rest && rest < wake * now);
            }
    return stirs;
}

void cfdmp_lean(struct cfdmp *cfdmp, struct simulation *simulation)
{
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int64_t n = 0; n < cfdmp->side[axis][side].gates; n++) {
                struct gate *gate = &cfdmp->side[axis][side].gate[n];
                int64_t at[3];
                cell_of_gate(cfdmp, axis, side, n, true, at);
                for (int k = 0; k < 4; k++)
                    gate->pushed[k] = gate->push[k];
                ledger_book(
                    &simulation->ledger, LEDGER_WALLS, 0.0,
                    vec3_make(-gate->push[0], -gate->push[1], -gate->push[2]),
                    vec3_scale(cfdmp->edge, vec3_make((double)at[0] + 0.5, (double)at[1] + 0.5,
                                                      (double)at[2] + 0.5)),
                    -gate->push[3]);
            }
}
