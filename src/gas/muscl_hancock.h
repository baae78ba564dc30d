/* A sweep of second order along a row: linear reconstruction with limited slopes, half a step of
 * the primitive equations (MUSCL-Hancock; van Leer, SIAM J. Sci. Stat. Comput. 5 (1984) 1), and
 * HLLC fluxes (Toro, Spruce and Speares, Shock Waves 4 (1994) 25) with the fastest waves after
 * Einfeldt (SIAM J. Numer. Anal. 25 (1988) 294), for any equation of state. Density, velocity
 * and pressure are reconstructed, so that both sides of a contact have one pressure; the energy
 * of a face follows from the equation of state, which is linear in it. */
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

/* (d p / d rho)_s from the derivatives of an equation of state. */
BOLIDE_INLINE double sound_square(struct eos_value value, double density)
{
    return value.dp_drho + value.pressure / square(density) * value.dp_de;
}

/* The states of cells FIRST to LAST. */
BOLIDE_INLINE void row_states(const struct gas_row *row, int first, int last,
                              struct row_states *states)
{
    const double none[POINT_HISTORY] = {0.0};
    const struct gas_numbers *u = &row->u;
    struct gas_numbers *w = &states->of;
    FOR_ROW(k, first, last)
    {
        const double density = u->of[GAS_DENSITY][k];
        double kinetic = 0.0;
        for (int n = 0; n < 3; n++) {
            w->of[PRIMITIVE_VELOCITY + n][k] = u->of[GAS_MOMENTUM + n][k] / density;
            kinetic += 0.5 * square(w->of[PRIMITIVE_VELOCITY + n][k]);
        }
        w->of[PRIMITIVE_DENSITY][k] = density;
        states->energy[k] = u->of[GAS_ENERGY][k] / density - kinetic;
        const struct eos_value value = eos_evaluate(row->eos, density, states->energy[k], none);
        w->of[PRIMITIVE_PRESSURE][k] = value.pressure;
        states->sound[k] = sqrt(maximum(sound_square(value, density), 0.0));
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
 * state ABOVE it is that of cell k, the state BELOW it that of cell k - 1. */
BOLIDE_INLINE void row_faces(const struct gas_row *row, const struct row_states *cell, double r,
                             struct row_states *below, struct row_states *above)
{
    const int normal = PRIMITIVE_VELOCITY + row->axis;
    struct gas_numbers slope;
    for (int n = 0; n < GAS_NUMBERS; n++) {
        const double *w = cell->of.of[n];
        FOR_ROW(k, -1, row->cells)
        slope.of[n][k] = limited(w[k] - w[k - 1], w[k + 1] - w[k]);
    }
    for (int n = 0; n < GAS_NUMBERS; n++) {
        const double *w = cell->of.of[n], *density = cell->of.of[PRIMITIVE_DENSITY];
        FOR_ROW(k, -1, row->cells)
        {
            double rate = cell->of.of[normal][k] * slope.of[n][k];
            if (n == PRIMITIVE_DENSITY)
                rate += density[k] * slope.of[normal][k];
            if (n == normal)
                rate += slope.of[PRIMITIVE_PRESSURE][k] / density[k];
            if (n == PRIMITIVE_PRESSURE)
                rate += density[k] * square(cell->sound[k]) * slope.of[normal][k];
            const double middle = w[k] - 0.5 * r * rate;
            above->of.of[n][k] = middle - 0.5 * slope.of[n][k];
            below->of.of[n][k + 1] = middle + 0.5 * slope.of[n][k];
        }
    }
}

/* Energies and sound speeds of the states FACE on faces 0 .. cells, beside cells that are OFFSET
 * from them. */
BOLIDE_INLINE void row_close_faces(const struct gas_row *row, const struct row_states *cell,
                                   int offset, struct row_states *face)
{
    const double none[POINT_HISTORY] = {0.0};
    FOR_ROW(k, 0, row->cells)
    {
        const double density = face->of.of[PRIMITIVE_DENSITY][k];
        const struct eos_value value =
            eos_evaluate(row->eos, density, cell->energy[k + offset], none);
        face->energy[k] = cell->energy[k + offset] +
                          (face->of.of[PRIMITIVE_PRESSURE][k] - value.pressure) / value.dp_de;
        struct eos_value there = value;
        there.pressure = face->of.of[PRIMITIVE_PRESSURE][k];
        face->sound[k] = sqrt(maximum(sound_square(there, density), 0.0));
    }
}

/* A side of a face: what HLLC needs of it. */
struct gas_side {
    double density, velocity[3], pressure, energy, sound;
};

BOLIDE_INLINE struct gas_side gas_side_of(const struct row_states *states, int k)
{
    struct gas_side side;
    side.density = states->of.of[PRIMITIVE_DENSITY][k];
    for (int n = 0; n < 3; n++)
        side.velocity[n] = states->of.of[PRIMITIVE_VELOCITY + n][k];
    side.pressure = states->of.of[PRIMITIVE_PRESSURE][k];
    side.energy = states->energy[k];
    side.sound = states->sound[k];
    return side;
}

/* What flows through a face normal to AXIS: that of SIDE, or, BEYOND the wave of SIDE that runs at
 * SPEED, that between this wave and the contact that moves at CONTACT. */
BOLIDE_INLINE void gas_flow(const struct gas_side *side, int axis, double speed, double contact,
                            bool beyond, double flow[GAS_NUMBERS])
{
    const double u = side->velocity[axis], density = side->density,
                 total =
                     side->energy + 0.5 * (square(side->velocity[0]) + square(side->velocity[1]) +
                                           square(side->velocity[2]));
    const double star = density * (speed - u) / (speed - contact),
                 gain = (contact - u) * (contact + side->pressure / (density * (speed - u)));
    const double jump = beyond ? speed : 0.0;
    flow[GAS_DENSITY] = density * u + jump * (star - density);
    for (int n = 0; n < 3; n++) {
        const double behind = n == axis ? contact : side->velocity[n];
        flow[GAS_MOMENTUM + n] = density * u * side->velocity[n] +
                                 (n == axis ? side->pressure : 0.0) +
                                 jump * (star * behind - density * side->velocity[n]);
    }
    flow[GAS_ENERGY] =
        u * (density * total + side->pressure) + jump * (star * (total + gain) - density * total);
}

/* HLLC: what flows between the gases LOW and HIGH. */
BOLIDE_INLINE void gas_hllc(const struct gas_side *low, const struct gas_side *high, int axis,
                            double flow[GAS_NUMBERS])
{
    const double a = sqrt(low->density), b = sqrt(high->density), part = b / (a + b);
    const double ul = low->velocity[axis], uh = high->velocity[axis], apart = uh - ul;
    const double mean = ul + part * apart,
                 sound =
                     sqrt(square(low->sound) + part * (square(high->sound) - square(low->sound)) +
                          0.5 * part * (1.0 - part) * square(apart));
    const double slow = minimum(ul - low->sound, mean - sound),
                 fast = maximum(uh + high->sound, mean + sound);
    const double ml = low->density * (slow - ul), mh = high->density * (fast - uh);
    const double contact = (high->pressure - low->pressure + ml * ul - mh * uh) / (ml - mh);
    if (contact >= 0.0)
        gas_flow(low, axis, slow, contact, slow < 0.0, flow);
    else
        gas_flow(high, axis, fast, contact, fast > 0.0, flow);
}

/* Takes the cells of a row through a sweep of R = dt/h, and gives what flows through the faces
 * 0 .. cells, per area and time, in FLUX. Cells -2 .. cells + 1 are known. */
BOLIDE_INLINE void row_muscl_hancock(struct gas_row *row, double r, struct gas_numbers *flux)
{
    struct row_states cell, below, above;
    row_states(row, -2, row->cells + 1, &cell);
    row_faces(row, &cell, r, &below, &above);
    row_close_faces(row, &cell, -1, &below);
    row_close_faces(row, &cell, 0, &above);
    FOR_ROW(k, 0, row->cells)
    {
        const struct gas_side low = gas_side_of(&below, k), high = gas_side_of(&above, k);
        double flow[GAS_NUMBERS];
        gas_hllc(&low, &high, row->axis, flow);
        for (int n = 0; n < GAS_NUMBERS; n++)
            flux->of[n][k] = flow[n];
    }
    for (int n = 0; n < GAS_NUMBERS; n++)
        FOR_ROW(k, 0, row->cells - 1)
    row->u.of[n][k] -= r * (flux->of[n][k + 1] - flux->of[n][k]);
}

#endif
