/* A sweep of second order along a row: linear reconstruction with limited slopes, half a step of
 * the primitive equations (MUSCL-Hancock; van Leer, SIAM J. Sci. Stat. Comput. 5 (1984) 1), and
 * HLLC fluxes (Toro, Spruce and Speares, Shock Waves 4 (1994) 25) with the fastest waves after
 * Einfeldt (SIAM J. Numer. Anal. 25 (1988) 294), for any equation of state. Density, velocity and
 * pressure are reconstructed, so that both sides of a contact have one pressure; the energy of a
 * face follows from the equation of state, which is linear in it.
 *
 * HLLC lets strong shocks along the grid break up (Quirk, Int. J. Numer. Methods Fluids 18 (1994)
 * 555): each sweep marks the cells of strong shocks along its axis, and the sweeps across them have
 * HLL fluxes there.
 *
 * A face whose flux would take too much out of either cell in half a cell's width has the
 * first-order flux of the cells themselves (after Hu, Adams and Shu, J. Comput. Phys. 242 (2013)
 * 169): both cells and all ranks decide alike, since nothing but the two cells counts. A row in
 * which that leaves a cell with hardly any density or energy is `spent`: its sweep is repeated in
 * two halves (strips.c). */
#ifndef BOLIDE_GAS_MUSCL_HANCOCK_H
#define BOLIDE_GAS_MUSCL_HANCOCK_H

#include "gas/row.h"

/* Primitive numbers of a row. */
enum { PRIMITIVE_DENSITY, PRIMITIVE_VELOCITY, PRIMITIVE_PRESSURE = 4 };

/* States in cells or on one side of faces: primitive numbers, specific energy, J/kg, sound
 * speed. */
struct row_states {
    struct gas_numbers of;
    double energy[ROW_ROOM], sound[ROW_ROOM];
};

/* How far density and specific energy may fall at once: the density to this part of itself, the
 * energy by as much of what an ideal gas of the same sound speed c and G = (dp/de)/rho has, c^2/(G
 * (G + 1)). */
static const double GAS_LEAST = 0.2;

/* The rise of pressure over rho c^2 from which a shock is strong: its Mach number is about 1.5. */
static const double GAS_STRONG = 1.0;

/* (d p / d rho)_s at K; PRESSURE is the pressure there. */
BOLIDE_INLINE double row_sound_square(const struct row_values *values, double pressure,
                                      double density, int k)
{
    return eos_sound_square(pressure, values->dp_drho[k], values->dp_de[k], density);
}

/* The states of cells FIRST to LAST, and by how much their energies may FALL. */
BOLIDE_INLINE void row_states(const struct gas_row *row, int first, int last,
                              struct row_states *states, double *fall)
{
    const struct gas_numbers *u = &row->u;
    struct gas_numbers *w = &states->of;
    struct row_values values;
    FOR_ROW (k, first, last) {
        const double density = u->of[GAS_DENSITY][k];
        double kinetic = 0.0;
        for (int n = 0; n < 3; n++) {
            w->of[PRIMITIVE_VELOCITY + n][k] = u->of[GAS_MOMENTUM + n][k] / density;
            kinetic += 0.5 * square(w->of[PRIMITIVE_VELOCITY + n][k]);
        }
        w->of[PRIMITIVE_DENSITY][k] = density;
        states->energy[k] = u->of[GAS_ENERGY][k] / density - kinetic;
    }
    row_evaluate(row->eos, w->of[PRIMITIVE_DENSITY], states->energy, first, last, &values);
    if (row->lit == row->eos)
        row_unburn(row->eos, w->of[PRIMITIVE_DENSITY], states->energy, row->burnt, first, last,
                   &values);
    FOR_ROW (k, first, last) {
        const double density = w->of[PRIMITIVE_DENSITY][k], gamma = values.dp_de[k] / density;
        const double square_of_sound =
            maximum(row_sound_square(&values, values.pressure[k], density, k), 0.0);
        w->of[PRIMITIVE_PRESSURE][k] = values.pressure[k];
        states->sound[k] = sqrt(square_of_sound);
        fall[k] = gamma > 0.0 ? (1.0 - GAS_LEAST) * square_of_sound / (gamma * (gamma + 1.0))
                              : (double)INFINITY;
    }
}

/* The limited difference over a cell between differences to its neighbours: van Leer's harmonic
 * mean. */
BOLIDE_INLINE double limited(double past, double next)
{
    const double product = past * next;
    return product > 0.0 ? 2.0 * product / (past + next) : 0.0;
}

/* On the low and the high faces of cells -1 .. cells, half a step of R = dt/h on: of face k the
 * state ABOVE it is that of cell k, the state BELOW it that of cell k - 1. PUSH are the pressures
 * in the middle of the step. */
BOLIDE_INLINE void row_faces(const struct gas_row *row, const struct row_states *cell, double r,
                             struct row_states *below, struct row_states *above, double *push)
{
    const int cells = row->cells, normal = PRIMITIVE_VELOCITY + row->axis;
    const double *u = cell->of.of[normal], *density = cell->of.of[PRIMITIVE_DENSITY];
    struct gas_numbers slope;
    double rate[GAS_NUMBERS][ROW_ROOM], spread[ROW_ROOM];
    for (int n = 0; n < GAS_NUMBERS; n++) {
        const double *w = cell->of.of[n];
        FOR_ROW (k, -1, cells) {
            slope.of[n][k] = limited(w[k] - w[k - 1], w[k + 1] - w[k]);
            rate[n][k] = u[k] * slope.of[n][k];
        }
    }
    if (row->round)
        FOR_ROW (k, -1, cells)
            spread[k] = row_widening(row, u[k], k);
    else
        FOR_ROW (k, -1, cells)
            spread[k] = 0.0;
    ROWS_APART
    FOR_ROW (k, -1, cells) {
        const double widens = slope.of[normal][k] + spread[k];
        rate[PRIMITIVE_DENSITY][k] += density[k] * widens;
        rate[PRIMITIVE_PRESSURE][k] += density[k] * square(cell->sound[k]) * widens;
        rate[normal][k] += slope.of[PRIMITIVE_PRESSURE][k] / density[k];
    }
    for (int n = 0; n < GAS_NUMBERS; n++) {
        const double *w = cell->of.of[n];
        FOR_ROW (k, -1, cells) {
            const double middle = w[k] - 0.5 * r * rate[n][k];
            above->of.of[n][k] = middle - 0.5 * slope.of[n][k];
            below->of.of[n][k + 1] = middle + 0.5 * slope.of[n][k];
        }
    }
    FOR_ROW (k, -1, cells)
        push[k] = cell->of.of[PRIMITIVE_PRESSURE][k] - 0.5 * r * rate[PRIMITIVE_PRESSURE][k];
}

/* Energies and sound speeds of the states FACE on faces 0 .. cells, beside cells that are OFFSET
 * from them. */
BOLIDE_INLINE void row_close_faces(const struct gas_row *row, const struct row_states *cell,
                                   int offset, struct row_states *face)
{
    struct row_values values;
    row_evaluate(row->eos, face->of.of[PRIMITIVE_DENSITY], cell->energy + offset, 0, row->cells,
                 &values);
    if (row->lit == row->eos)
        row_unburn(row->eos, face->of.of[PRIMITIVE_DENSITY], cell->energy + offset,
                   row->burnt + offset, 0, row->cells, &values);
    FOR_ROW (k, 0, row->cells) {
        const double density = face->of.of[PRIMITIVE_DENSITY][k],
                     pressure = face->of.of[PRIMITIVE_PRESSURE][k],
                     lacks = pressure - values.pressure[k];
        face->energy[k] =
            cell->energy[k + offset] + (values.dp_de[k] > 0.0 ? lacks / values.dp_de[k] : 0.0);
        face->sound[k] = sqrt(maximum(row_sound_square(&values, pressure, density, k), 0.0));
    }
}

/* A side of a face: what HLLC needs of it. Velocities: normal to the face, then across. */
struct gas_side {
    double density, normal, across[2], pressure, energy, sound;
};

/* Where the numbers of a row along an axis are: normal first. */
struct gas_axes {
    int normal, across[2];
};

BOLIDE_INLINE struct gas_axes gas_axes_of(int axis)
{
    const struct gas_axes axes = {axis, {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2}};
    return axes;
}

BOLIDE_INLINE struct gas_side gas_side_of(const struct row_states *states, struct gas_axes axes,
                                          int k)
{
    struct gas_side side;
    side.density = states->of.of[PRIMITIVE_DENSITY][k];
    side.normal = states->of.of[PRIMITIVE_VELOCITY + axes.normal][k];
    for (int n = 0; n < 2; n++)
        side.across[n] = states->of.of[PRIMITIVE_VELOCITY + axes.across[n]][k];
    side.pressure = states->of.of[PRIMITIVE_PRESSURE][k];
    side.energy = states->energy[k];
    side.sound = states->sound[k];
    return side;
}

/* What flows through a face: mass, momentum normal to it and across, energy. */
struct gas_flow {
    double mass, normal, across[2], energy;
};

/* The fastest waves between the gases on both sides of a face. */
struct gas_waves {
    double slow, fast;
};

BOLIDE_INLINE struct gas_waves gas_waves_of(struct gas_side low, struct gas_side high)
{
    const double a = sqrt(low.density), b = sqrt(high.density), part = b / (a + b);
    const double apart = high.normal - low.normal, mean = low.normal + part * apart,
                 sound = sqrt(square(low.sound) + part * (square(high.sound) - square(low.sound)) +
                              0.5 * part * (1.0 - part) * square(apart));
    const struct gas_waves waves = {minimum(low.normal - low.sound, mean - sound),
                                    maximum(high.normal + high.sound, mean + sound)};
    return waves;
}

/* HLLC: what flows between the gases LOW and HIGH. Without branches: loops over faces call it. */
BOLIDE_INLINE struct gas_flow gas_hllc(struct gas_side low, struct gas_side high)
{
    const struct gas_waves waves = gas_waves_of(low, high);
    const double slow = waves.slow, fast = waves.fast;
    const double ml = low.density * (slow - low.normal), mh = high.density * (fast - high.normal);
    const double contact =
        (high.pressure - low.pressure + ml * low.normal - mh * high.normal) / (ml - mh);
    const bool from_low = contact >= 0.0;
    const double density = from_low ? low.density : high.density,
                 u = from_low ? low.normal : high.normal,
                 first = from_low ? low.across[0] : high.across[0],
                 second = from_low ? low.across[1] : high.across[1],
                 pressure = from_low ? low.pressure : high.pressure,
                 energy = from_low ? low.energy : high.energy, speed = from_low ? slow : fast;
    /* beyond the wave of that side the flux is that between the wave and the contact */
    const double jump = from_low ? minimum(speed, 0.0) : maximum(speed, 0.0);
    const double total = energy + 0.5 * (square(u) + square(first) + square(second));
    /* in this order the flux between equal gases at rest is exactly their pressure */
    const double star = density * ((speed - u) / (speed - contact)),
                 gain = (contact - u) * (contact + pressure / (density * (speed - u)));
    const double more = jump * (star - density), mass = density * u + more;
    struct gas_flow flow;
    flow.mass = mass;
    flow.normal = density * u * u + pressure + jump * (star * contact - density * u);
    flow.across[0] = mass * first;
    flow.across[1] = mass * second;
    flow.energy =
        u * (density * total + pressure) + jump * (star * (total + gain) - density * total);
    return flow;
}

/* Fluxes through the faces FIRST to LAST, between states that are those of LOW at k + OFFSET and of
 * HIGH at k. */
BOLIDE_INLINE void row_hllc(const struct gas_row *row, const struct row_states *low, int offset,
                            const struct row_states *high, int first, int last,
                            struct gas_numbers *flux)
{
    const struct gas_axes axes = gas_axes_of(row->axis);
    double *mass = flux->of[GAS_DENSITY], *normal = flux->of[GAS_MOMENTUM + axes.normal],
           *one = flux->of[GAS_MOMENTUM + axes.across[0]],
           *other = flux->of[GAS_MOMENTUM + axes.across[1]], *energy = flux->of[GAS_ENERGY];
    ROWS_APART
    FOR_ROW (k, first, last) {
        const struct gas_flow flow =
            gas_hllc(gas_side_of(low, axes, k + offset), gas_side_of(high, axes, k));
        mass[k] = flow.mass;
        normal[k] = flow.normal;
        one[k] = flow.across[0];
        other[k] = flow.across[1];
        energy[k] = flow.energy;
    }
}

/* HLL (Harten, Lax and van Leer, SIAM Review 25 (1983) 35) with the same waves: contacts and shear
 * are smeared. */
BOLIDE_INLINE struct gas_flow gas_hll(struct gas_side low, struct gas_side high)
{
    const struct gas_waves waves = gas_waves_of(low, high);
    const double slow = minimum(waves.slow, 0.0), fast = maximum(waves.fast, 0.0);
    const double from_low = fast / (fast - slow), from_high = -slow / (fast - slow),
                 spread = slow * fast / (fast - slow);
    const double energy[2] = {
        low.density * (low.energy +
                       0.5 * (square(low.normal) + square(low.across[0]) + square(low.across[1]))),
        high.density * (high.energy + 0.5 * (square(high.normal) + square(high.across[0]) +
                                             square(high.across[1])))};
    const double ml = low.density * low.normal, mh = high.density * high.normal;
    struct gas_flow flow;
    flow.mass = from_low * ml + from_high * mh + spread * (high.density - low.density);
    flow.normal = from_low * (ml * low.normal + low.pressure) +
                  from_high * (mh * high.normal + high.pressure) + spread * (mh - ml);
    for (int n = 0; n < 2; n++)
        flow.across[n] = from_low * ml * low.across[n] + from_high * mh * high.across[n] +
                         spread * (high.density * high.across[n] - low.density * low.across[n]);
    flow.energy = from_low * low.normal * (energy[0] + low.pressure) +
                  from_high * high.normal * (energy[1] + high.pressure) +
                  spread * (energy[1] - energy[0]);
    return flow;
}

/* Whether a strong shock along another axis than that of ROW is in cell K, as sweeps along that
 * left it. */
BOLIDE_INLINE bool row_shock_across(const struct gas_row *row, int k)
{
    return ((int)row->shock[k] & ~(1 << row->axis)) != 0;
}

/* Puts HLL fluxes through the faces 0 .. cells along a strong shock across which the gas flows at a
 * right angle to the row. */
static inline void row_damp(const struct gas_row *row, const struct row_states *below,
                            const struct row_states *above, struct gas_numbers *flux)
{
    const struct gas_axes axes = gas_axes_of(row->axis);
    FOR_ROW (k, 0, row->cells) {
        if (!row_shock_across(row, k - 1) && !row_shock_across(row, k))
            continue;
        const struct gas_flow flow =
            gas_hll(gas_side_of(below, axes, k), gas_side_of(above, axes, k));
        flux->of[GAS_DENSITY][k] = flow.mass;
        flux->of[GAS_MOMENTUM + axes.normal][k] = flow.normal;
        flux->of[GAS_MOMENTUM + axes.across[0]][k] = flow.across[0];
        flux->of[GAS_MOMENTUM + axes.across[1]][k] = flow.across[1];
        flux->of[GAS_ENERGY][k] = flow.energy;
    }
}

/* Where strong shocks along the row are in its cells: the pressure rises over two cells by more
 * than GAS_STRONG times rho c^2 of the cells, and the gas is compressed; and one cell to each
 * side. */
BOLIDE_INLINE void row_find_shocks(struct gas_row *row, const struct row_states *cell)
{
    const double *pressure = cell->of.of[PRIMITIVE_PRESSURE],
                 *density = cell->of.of[PRIMITIVE_DENSITY],
                 *u = cell->of.of[PRIMITIVE_VELOCITY + row->axis];
    double stiff[ROW_ROOM];
    uint64_t strong[ROW_ROOM], any = 0;
    FOR_ROW (k, -2, row->cells + 1)
        stiff[k] = density[k] * square(cell->sound[k]);
    FOR_ROW (k, -1, row->cells) {
        const double least = minimum(stiff[k], minimum(stiff[k - 1], stiff[k + 1]));
        const double rise = fabs(pressure[k + 1] - pressure[k - 1]) - GAS_STRONG * least;
        strong[k] = minimum(rise, u[k - 1] - u[k + 1]) > 0.0;
        any |= strong[k];
    }
    row->shocked = any != 0;
    if (row->shocked || row->crossed)
        FOR_ROW (k, 0, row->cells - 1) {
            const bool here = (strong[k - 1] | strong[k] | strong[k + 1]) != 0;
            const int others = (int)row->shock[k] & ~(1 << row->axis);
            row->shock[k] = (double)(others | (here ? 1 << row->axis : 0));
        }
}

/* Marks in LOST the faces 0 .. cells whose FLUX would take too much out of half of the cell that is
 * OFFSET from them, on its side that SIDE names: 1 for the high, -1 for the low one. */
BOLIDE_INLINE void row_mark_lost(const struct gas_row *row, const struct row_states *cell,
                                 const double *fall, int offset, double side, double r,
                                 const struct gas_numbers *flux, double *lost)
{
    const struct gas_numbers *u = &row->u, *w = &cell->of;
    const double *velocity = w->of[PRIMITIVE_VELOCITY + row->axis] + offset,
                 *pressure = w->of[PRIMITIVE_PRESSURE] + offset,
                 *density = u->of[GAS_DENSITY] + offset, *energy = u->of[GAS_ENERGY] + offset,
                 *heat = cell->energy + offset, *least = fall + offset;
    double momentum[ROW_ROOM];
    FOR_ROW (k, 0, row->cells)
        momentum[k] = 0.0;
    for (int n = 0; n < 3; n++) {
        const double *of = u->of[GAS_MOMENTUM + n] + offset, *flow = flux->of[GAS_MOMENTUM + n];
        const double pushes = n == row->axis ? 1.0 : 0.0;
        FOR_ROW (k, 0, row->cells)
            momentum[k] += square(
                of[k] - 2.0 * side * r * (flow[k] - velocity[k] * of[k] - pushes * pressure[k]));
    }
    FOR_ROW (k, 0, row->cells) {
        const double mass =
            density[k] - 2.0 * side * r * (flux->of[GAS_DENSITY][k] - velocity[k] * density[k]);
        const double total =
            energy[k] -
            2.0 * side * r * (flux->of[GAS_ENERGY][k] - velocity[k] * (energy[k] + pressure[k]));
        const bool stays = (mass > GAS_LEAST * density[k]) &
                           ((total - 0.5 * momentum[k] / mass) / mass > heat[k] - least[k]);
        lost[k] = stays ? lost[k] : 1.0;
    }
}

/* Whether the numbers TO, which a sweep gives cells, leave one of them with less than half of what
 * GAS_LEAST keeps at its faces. */
BOLIDE_INLINE bool row_is_spent(const struct gas_row *row, const struct row_states *cell,
                                const double *fall, const struct gas_numbers *to)
{
    const double most = (1.0 - 0.5 * GAS_LEAST) / (1.0 - GAS_LEAST);
    uint64_t spent = 0;
    FOR_ROW (k, 0, row->cells - 1) {
        const double density = to->of[GAS_DENSITY][k],
                     kinetic = 0.5 * (square(to->of[GAS_MOMENTUM][k]) +
                                      square(to->of[GAS_MOMENTUM + 1][k]) +
                                      square(to->of[GAS_MOMENTUM + 2][k]));
        const bool stays = (density > 0.5 * GAS_LEAST * row->u.of[GAS_DENSITY][k]) &
                           (density * to->of[GAS_ENERGY][k] - kinetic >
                            square(density) * (cell->energy[k] - most * fall[k]));
        spent |= !stays;
    }
    return spent != 0;
}

/* Takes the cells of a row through a sweep of R = dt/h, and gives what flows through the faces
 * 0 .. cells, per area and time, in FLUX. Cells -2 .. cells + 1 are known. */
BOLIDE_INLINE void row_muscl_hancock(struct gas_row *row, double r, struct gas_numbers *flux)
{
    struct row_states cell = {0}, below, above;
    struct gas_numbers to;
    double fall[ROW_ROOM], push[ROW_ROOM], lost[ROW_ROOM], any = 0.0;
    row_states(row, -2, row->cells + 1, &cell, fall);
    row_faces(row, &cell, r, &below, &above, push);
    row_close_faces(row, &cell, -1, &below);
    row_close_faces(row, &cell, 0, &above);
    row_hllc(row, &below, 0, &above, 0, row->cells, flux);
    if (row->crossed)
        row_damp(row, &below, &above, flux);
    row_find_shocks(row, &cell);
    FOR_ROW (k, 0, row->cells)
        lost[k] = 0.0;
    row_mark_lost(row, &cell, fall, -1, 1.0, row_strict(row, r), flux, lost);
    row_mark_lost(row, &cell, fall, 0, -1.0, row_strict(row, r), flux, lost);
    FOR_ROW (k, 0, row->cells)
        any = maximum(any, lost[k]);
    if (any > 0.0)
        for (int k = 0; k <= row->cells; k++)
            if (lost[k + ROW_GHOSTS] > 0.0)
                row_hllc(row, &cell, -1, &cell, k, k, flux);
    row_advance(row, &row->u, flux, push, r, 0, row->cells - 1, &to);
    /* on a plane no cell has less than the mean of its halves */
    if (any > 0.0 || row->round)
        row->spent |= row_is_spent(row, &cell, fall, &to);
    row_keep_push(row, push);
    for (int n = 0; n < GAS_NUMBERS; n++)
        FOR_ROW (k, 0, row->cells - 1)
            row->u.of[n][k] = to.of[n][k];
}

#endif
