/* Explosives in cells. What is lit burns as programmed: its burnt fraction follows from the time
 * since the detonation has arrived at the centre of the cell. Its energy is there from the start
 * and counts as much as has burnt (row_unburn). Products that have burnt may burn on in the air
 * around them. */
#include "gas/gas_internal.h"
#include "gas/mixture.h"
#include "material/equilibrium.h"
#include "material/material.h"

/* When the detonation arrives at PLACE, in a cell that BODY had at the start. */
static double arrival(const struct gas *gas, const struct simulation_case *input, int body,
                      struct vec3 place)
{
    const int material = gas->material[gas->layout.explosive];
    double first = INFINITY;
    for (int b = 0; b < input->bodies.count; b++)
        if (case_body(input, b)->material_index == material &&
            (b == body || case_body(input, body)->material_index != material))
            first = minimum(first, detonation_arrival(input, b, place));
    return first;
}

/* The volumes in cell I of both materials, which have one pressure, become those of one pressure
 * when the second has burnt to the fraction AFTER: products compress the air beside them. */
static void relax(struct gas *gas, int32_t i, double before, double after)
{
    const struct eos *const eos[2] = {&gas->eos[0], &gas->eos[1]};
    const double fraction = gas->u[GAS_FRACTION][i], second = gas->u[GAS_SECOND][i],
                 mass[2] = {gas->u[GAS_DENSITY][i] - second, second};
    if (!(fraction > MIXTURE_TRACE) || !(1.0 - fraction > MIXTURE_TRACE) || !(mass[0] > 0.0))
        return;
    const double density[2] = {mixture_density(eos[0], mass[0], 1.0 - fraction),
                               mixture_density(eos[1], mass[1], fraction)},
                 burnt[2] = {1.0, before};
    const struct mixture mixture = mixture_of(eos, density, fraction, burnt);
    double kinetic = 0.0, energy[2];
    for (int axis = 0; axis < 3; axis++)
        kinetic += 0.5 * square(gas->u[GAS_MOMENTUM + axis][i]) / gas->u[GAS_DENSITY][i];
    const double heat = gas->u[GAS_ENERGY][i] - kinetic;
    energy[0] = mixture.part[0].weight * (mixture_pressure(&mixture, heat) - mixture.part[0].cold);
    energy[1] = heat - energy[0];
    gas->u[GAS_FRACTION][i] = gas_relax(gas->eos, mass, energy, fraction, after);
}

/* The fraction of the explosive in cell I that must have burnt, at least BURNT, for its pressure to
 * be one. Products that have done work flow into cells that the detonation has yet to reach. */
static double least_burnt(const struct gas *gas, int32_t i, double burnt)
{
    const double least = UNBURNT_LEAST;
    const double none[POINT_HISTORY] = {0.0};
    const bool two = gas->layout.two;
    const struct eos *const eos[2] = {&gas->eos[0], &gas->eos[two]};
    const double density = gas->u[GAS_DENSITY][i], fraction = two ? gas->u[GAS_FRACTION][i] : 1.0;
    double kinetic = 0.0;
    for (int axis = 0; axis < 3; axis++)
        kinetic += 0.5 * square(gas->u[GAS_MOMENTUM + axis][i]) / density;
    const double heat = gas->u[GAS_ENERGY][i] - kinetic;
    if (fraction >= 1.0) {
        const struct eos_value rest = eos_evaluate(eos[1], density, 0.0, none);
        return maximum(burnt, (least - rest.dp_de * heat / density) / rest.pressure);
    }
    if (!(fraction > MIXTURE_TRACE))
        return burnt;
    const double second = gas->u[GAS_SECOND][i],
                 densities[2] = {mixture_density(eos[0], density - second, 1.0 - fraction),
                                 mixture_density(eos[1], second, fraction)},
                 all[2] = {1.0, 1.0};
    const struct mixture mixture = mixture_of(eos, densities, fraction, all);
    const struct mixture_part *part = mixture.part;
    const double lacks =
        least * (part[0].weight + part[1].weight) - heat - part[0].weight * part[0].cold;
    return maximum(burnt, lacks / (part[1].weight * part[1].cold));
}

/* What has burnt in block B at TIME. Returns whether some has not. */
static bool burn_block(struct gas *gas, const struct simulation_case *input, int32_t b, double time)
{
    const struct cell_blocks *cells = gas->cells;
    const struct cell_block *block = &cells->block[b];
    const int32_t end = block->first + cell_block_cells(block);
    const struct burn *burn =
        &case_material(input, gas->material[gas->layout.explosive])->material->burn;
    double *burnt = gas->u[gas->layout.burnt];
    bool left = false;
    gas->block[b].burns = false;
    for (int32_t i = block->first; i < end; i++) {
        if (burnt[i] >= 1.0)
            continue;
        const double *at = cells->position[i];
        struct burning burning = {0};
        burning.passed = time - arrival(gas, input, cells->body[i], vec3_make(at[0], at[1], at[2]));
        burning.length = cells->edge;
        const double before = minimum(least_burnt(gas, i, burnt[i]), 1.0),
                     after = burn_fraction(burn, &burning, before);
        if (after != burnt[i]) {
            gas->block[b].burns = true;
            if (gas->layout.two)
                relax(gas, i, before, after);
        }
        burnt[i] = after;
        left |= after < 1.0;
    }
    return left;
}

struct error *gas_burn(struct gas *gas, const struct simulation *simulation, double time)
{
    const struct cell_blocks *cells = gas->cells;
    int left = 0;
    for (int32_t b = 0; b < cells->blocks && !gas->unburnt; b++)
        gas->block[b].burns = false;
    if (!gas->unburnt)
        return NULL;
#pragma omp parallel for schedule(static) reduction(| : left) num_threads(simulation->threads)
    for (int32_t b = 0; b < cells->blocks; b++)
        left |= burn_block(gas, simulation->problem->input, b, time);
    gas->unburnt = ranks_maximum(simulation->ranks, left) > 0.0;
    return NULL;
}

/* Masses of air and of products, and the volume, of all open cells. */
static void count_masses(const struct gas *gas, const struct simulation *simulation, double mass[2],
                         double *room)
{
    const struct cell_blocks *cells = gas->cells;
    struct exact_sum sum[3] = {{{0}, 0, false}, {{0}, 0, false}, {{0}, 0, false}};
    for (int32_t i = 0; i < cells->count; i++) {
        if (gas->open && gas->open[i] == 0.0)
            continue;
        const double size = gas_volume_of(gas, i);
        const double second = gas->u[GAS_SECOND][i];
        exact_sum_add(&sum[0], size * (gas->u[GAS_DENSITY][i] - second));
        exact_sum_add(&sum[1], size * second);
        exact_sum_add(&sum[2], size);
    }
    ranks_sum_exact(simulation->ranks, sum, 3);
    mass[0] = exact_sum_value(&sum[0]);
    mass[1] = exact_sum_value(&sum[1]);
    *room = exact_sum_value(&sum[2]);
}

void gas_count_air(struct gas *gas, const struct simulation *simulation)
{
    const double none[POINT_HISTORY] = {0.0}, takes = gas->afterburn.air;
    double mass[2], volume;
    struct point air;
    if (!gas->layout.afterburns || !(takes > 0.0 || gas->afterburn.mixing > 0.0))
        return;
    count_masses(gas, simulation, mass, &volume);
    struct room room = {mass[1] / volume, mass[0] / volume, 0.0};
    if (gas->afterburn.load > 0.0 && gas_state_of_air(gas, simulation, &air)) {
        room.load = gas->afterburn.load;
        room.air = air.density;
    }
    if (takes > 0.0)
        gas->most_afterburnt = room.load > 0.0 ? minimum(1.0, room.air / (takes * room.load)) : 1.0;
    if (!(gas->afterburn.mixing > 0.0) || !(room.load > 0.0) ||
        !gas_state_of_air(gas, simulation, &air))
        return;
    /* explosives at rest have no energy, and all products have burnt as far as they may */
    const struct eos_value value = eos_evaluate(&gas->eos[0], air.density, air.energy, none);
    room.temperature = equilibrium_temperature_of_air(value.pressure, air.density);
    const double per_energy = value.dp_de / air.density,
                 pressure = equilibrium_of_room(
                                &simulation->problem->material[gas->material[1]].composition, &room)
                                .pressure;
    gas->mixing_heat = (pressure / per_energy - room.air * air.energy) / room.load -
                       gas->most_afterburnt * gas->afterburn.energy;
}

/* The pressure of cell I of both materials, all burnt, with FRACTION and mass SECOND of the second
 * and ENERGY, rho e. */
static double pressure_of(const struct gas *gas, int32_t i, double fraction, double second,
                          double energy)
{
    const struct eos *const eos[2] = {&gas->eos[0], &gas->eos[1]};
    const double first = gas->u[GAS_DENSITY][i] - second, all[2] = {1.0, 1.0},
                 density[2] = {mixture_density(eos[0], first, 1.0 - fraction),
                               mixture_density(eos[1], second, fraction)};
    const struct mixture mixture = mixture_of(eos, density, fraction, all);
    return mixture_pressure(&mixture, energy);
}

/* Over DT products in cell I become air that has their volume, energy and velocity, and the heat of
 * mixing, which is returned, J/m^3. What is next to nothing becomes air at once. Air is warmer than
 * cold products: where the heat is not enough for it they wait until they have more energy. */
static double mix(struct gas *gas, int32_t i, double dt)
{
    static const double little = 1e-5, least = 0.5;
    double *second = &gas->u[GAS_SECOND][i], *fraction = &gas->u[GAS_FRACTION][i];
    const double density = gas->u[GAS_DENSITY][i],
                 part = *second < little * density ? 1.0
                                                   : 1.0 - exponential(-gas->afterburn.mixing * dt),
                 heat = part * *second * gas->mixing_heat, left = 1.0 - part;
    if (left > 0.0) {
        double energy = gas->u[GAS_ENERGY][i];
        for (int axis = 0; axis < 3; axis++)
            energy -= 0.5 * square(gas->u[GAS_MOMENTUM + axis][i]) / density;
        if (!(pressure_of(gas, i, left * *fraction, left * *second, energy + heat) >
              least * gas->cells->pressure[i]))
            return 0.0;
    }
    *second *= left;
    *fraction *= left;
    gas->u[GAS_AFTERBURNT][i] *= left;
    gas->u[GAS_ENERGY][i] += heat;
    return heat;
}

/* Block B over DT. */
static void afterburn_block(struct gas *gas, int32_t b, double dt, struct ledger *ledger)
{
    const struct cell_blocks *cells = gas->cells;
    const struct cell_block *block = &cells->block[b];
    const int32_t end = block->first + cell_block_cells(block);
    const double done = gas->most_afterburnt * (1.0 - 1e-9), /* what rounding leaves */
        *burnt = gas->layout.lit ? gas->u[gas->layout.burnt] : NULL;
    for (int32_t i = block->first; i < end; i++) {
        const double mass = gas->u[GAS_SECOND][i];
        if (mass <= 0.0 || (burnt && burnt[i] < 1.0) || (gas->open && gas->open[i] == 0.0))
            continue;
        double *own = &gas->u[GAS_AFTERBURNT][i];
        const double gain = afterburn_gain(&gas->afterburn, *own / mass, cells->pressure[i],
                                           gas->most_afterburnt, dt);
        double heat = mass * gain * afterburn_heat(&gas->afterburn);
        *own += mass * gain;
        gas->u[GAS_ENERGY][i] += heat;
        if (gas->afterburn.mixing > 0.0 && *own >= done * mass)
            heat += mix(gas, i, dt);
        if (heat != 0.0)
            ledger_book(ledger, LEDGER_AFTERBURN, 0.0, vec3_make(0.0, 0.0, 0.0),
                        vec3_make(0.0, 0.0, 0.0), heat * gas_volume_of(gas, i));
    }
}

void gas_afterburn(struct gas *gas, struct simulation *simulation, double dt)
{
    if (!gas->layout.afterburns)
        return;
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ledger own = {0};
#pragma omp for schedule(static)
        for (int32_t b = 0; b < gas->cells->blocks; b++)
            if (gas->block[b].awake)
                afterburn_block(gas, b, dt, &own);
#pragma omp critical(bolide_gas_afterburn)
        ledger_join(&simulation->ledger, &own);
    }
}
