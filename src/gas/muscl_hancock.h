/* A sweep of second order along a row: linear reconstruction with limited slopes, half a step of
 * the primitive equations (MUSCL-Hancock; van Leer, SIAM J. Sci. Stat. Comput. 5 (1984) 1), and the
 * fluxes of a Riemann solver (riemann/gas_solvers.h), for any closure of the cells (closure.h).
 * Density, velocity and pressure are reconstructed, so that both sides of a contact have one
 * pressure; the energy of a face follows from the closure, which is linear in it.
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

#include "gas/two_materials.h"

/* The rise of pressure over rho c^2 from which a shock is strong: its Mach number is about 1.5. */
static const double GAS_STRONG = 1.0;

/* (d p / d rho)_s at K; PRESSURE is the pressure there. */
BOLIDE_INLINE double row_sound_square(const struct row_values *values, double pressure,
                                      double density, int k)
{
    return eos_sound_square(pressure, values->dp_drho[k], values->dp_de[k], density);
}

/* What a floor of the pressure adds in cells, and no bounds of the energy where it serves. */
static inline void row_find_cavities(const struct gas_row *row, const struct gas_content *content,
                                     const struct row_values *values, struct row_states *states,
                                     double *fall)
{
    const bool second = row->closure.other && row->closure.floor[1] > -(double)INFINITY;
    FOR_ROW (k, -2, row->cells + 1) {
        states->lift[k] = values->lift[k];
        if (!content->kind || content->kind[k] != CONTENT_BOTH)
            continue;
        const double density = states->of.of[PRIMITIVE_DENSITY][k], mass = row->part[PART_MASS][k],
                     liquid = second ? mass : density - mass;
        states->lacks[k] =
            liquid > 0.0 ? values->lift[k] * density / (values->dp_de[k] * liquid) : 0.0;
        fall[k] = (double)INFINITY;
    }
}

/* The states of cells -2 .. cells + 1, and by how much their energies may FALL. */
BOLIDE_INLINE void row_states(const struct gas_row *row, const struct gas_content *content,
                              struct row_states *states, double *fall)
{
    const int first = -2, last = row->cells + 1;
    const struct gas_numbers *u = &row->u;
    struct gas_numbers *w = &states->of;
    struct row_values values;
    w->of[PRIMITIVE_DENSITY][0] = states->energy[0] = 0.0; /* or compilers take them for unset */
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
    gas_evaluate(&row->closure, content, w->of[PRIMITIVE_DENSITY], states->energy, first, last,
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
    if (row->closure.liquid)
        row_find_cavities(row, content, &values, states, fall);
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

/* The same where a floor raises the pressure of the cell: the energy that its liquid lacks for it
 * flows with the liquid. SECOND is the mass of the second material on the faces. */
static inline void row_close_cavities(const struct gas_row *row, const struct gas_content *content,
                                      const struct row_states *cell, int offset,
                                      const double *second, struct row_states *face)
{
    const bool of_second = row->closure.other && row->closure.floor[1] > -(double)INFINITY;
    FOR_ROW (k, 0, row->cells) {
        const double density = face->of.of[PRIMITIVE_DENSITY][k];
        if (!(cell->lift[k + offset] > 0.0))
            continue;
        face->sound[k] = cell->sound[k + offset];
        if (!content->kind || content->kind[k] != CONTENT_BOTH)
            face->energy[k] = cell->energy[k + offset];
        else
            face->energy[k] -=
                cell->lacks[k + offset] * (of_second ? second[k] : density - second[k]) / density;
    }
}

/* Energies and sound speeds of the states FACE on faces 0 .. cells, whose content is CONTENT,
 * beside cells that are OFFSET from them. A cell of two materials may have the light one alone at
 * its face: sound is that of all of it. */
BOLIDE_INLINE void row_close_faces(const struct gas_row *row, const struct gas_content *content,
                                   const struct row_states *cell, int offset, const double *second,
                                   struct row_states *face)
{
    struct gas_closure closure = row->closure;
    struct row_values values;
    closure.liquid = false; /* a floor has no inverse */
    gas_evaluate(&closure, content, face->of.of[PRIMITIVE_DENSITY], cell->energy + offset, 0,
                 row->cells, &values);
    FOR_ROW (k, 0, row->cells) {
        const double density = face->of.of[PRIMITIVE_DENSITY][k],
                     pressure = face->of.of[PRIMITIVE_PRESSURE][k],
                     lacks = pressure - values.pressure[k];
        face->energy[k] =
            cell->energy[k + offset] + (values.dp_de[k] > 0.0 ? lacks / values.dp_de[k] : 0.0);
        face->sound[k] = sqrt(maximum(row_sound_square(&values, pressure, density, k), 0.0));
    }
    if (content->kind)
        FOR_ROW (k, 0, row->cells)
            if (content->kind[k] == CONTENT_BOTH)
                face->sound[k] = cell->sound[k + offset];
    if (row->closure.liquid)
        row_close_cavities(row, content, cell, offset, second, face);
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
        row_put_flow(gas_riemann_hll(gas_side_of(below, axes, k), gas_side_of(above, axes, k)),
                     axes, k, flux);
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
 * GAS_LEAST keeps at its faces. Of the next to nothing that an explosive has before it burns the
 * products beside it may take all, see row_unburn: no shorter sweep would leave it more. */
BOLIDE_INLINE bool row_is_spent(const struct gas_row *row, const struct row_states *cell,
                                const double *fall, const struct gas_numbers *to)
{
    const double most = (1.0 - 0.5 * GAS_LEAST) / (1.0 - GAS_LEAST);
    double bound[ROW_ROOM];
    uint64_t spent = 0;
    FOR_ROW (k, 0, row->cells - 1)
        bound[k] = most * fall[k];
    if (row->closure.lit)
        FOR_ROW (k, 0, row->cells - 1)
            bound[k] = row->burnt[k] < 1.0 ? (double)INFINITY : bound[k];
    FOR_ROW (k, 0, row->cells - 1) {
        const double density = to->of[GAS_DENSITY][k],
                     kinetic = 0.5 * (square(to->of[GAS_MOMENTUM][k]) +
                                      square(to->of[GAS_MOMENTUM + 1][k]) +
                                      square(to->of[GAS_MOMENTUM + 2][k]));
        const bool stays = (density > 0.5 * GAS_LEAST * row->u.of[GAS_DENSITY][k]) &
                           (density * to->of[GAS_ENERGY][k] - kinetic >
                            square(density) * (cell->energy[k] - bound[k]));
        spent |= !stays;
    }
    return spent != 0;
}

/* Puts fluxes of first order through faces that are LOST. */
APART void row_replace_lost(struct gas_row *row, const struct row_states *cell, const double *lost,
                            struct row_parts *parts, struct gas_numbers *flux)
{
    const struct gas_axes axes = gas_axes_of(row->axis);
    FOR_ROW (k, 0, row->cells)
        if (lost[k] > 0.0) {
            row_put_flow(gas_riemann_solve(row->riemann, gas_side_of(cell, axes, k - 1),
                                           gas_side_of(cell, axes, k)),
                         axes, k, flux);
            if (parts)
                parts_flow(flux, cell, row->part, -1, cell, row->part, k, parts);
        }
}

/* Fluxes through the faces 0 .. cells of CELL, R = dt/h and what energies may FALL, and the mean
 * pressures that PUSH. Whether some are of first order, so that a cell may be left with little. */
BOLIDE_INLINE bool row_find_fluxes(struct gas_row *row, struct row_parts *parts, double r,
                                   const struct row_states *cell, const double *fall, double *push,
                                   struct gas_numbers *flux)
{
    const struct gas_content below_content = parts_content_of_faces(row, parts, -1, 1),
                             above_content = parts_content_of_faces(row, parts, 0, 0);
    struct row_states below, above;
    double lost[ROW_ROOM], any = 0.0;
    row_faces(row, cell, r, &below, &above, push);
    if (parts)
        parts_faces(row, cell, r, parts, &below, &above);
    row_close_faces(row, &below_content, cell, -1, parts ? parts->below[PART_MASS] : NULL, &below);
    row_close_faces(row, &above_content, cell, 0, parts ? parts->above[PART_MASS] : NULL, &above);
    if (parts)
        parts_fluxes(row, cell, &below, &above, parts, flux);
    else
        row_fluxes(row, &below, &above, NULL, flux);
    if (row->crossed) {
        row_damp(row, &below, &above, flux);
        if (parts)
            parts_damp(row, &below, &above, parts);
    }
    FOR_ROW (k, 0, row->cells)
        lost[k] = 0.0;
    row_mark_lost(row, cell, fall, -1, 1.0, row_strict(row, r), flux, lost);
    row_mark_lost(row, cell, fall, 0, -1.0, row_strict(row, r), flux, lost);
    if (parts) {
        parts_mark_lost(row, parts, cell, -1, 1.0, row_strict(row, r), flux, lost);
        parts_mark_lost(row, parts, cell, 0, -1.0, row_strict(row, r), flux, lost);
    }
    FOR_ROW (k, 0, row->cells)
        any = maximum(any, lost[k]);
    if (any > 0.0)
        row_replace_lost(row, cell, lost, parts, flux);
    return any > 0.0;
}

/* Takes the cells of a row through a sweep of R = dt/h, and gives what flows through the faces
 * 0 .. cells, per area and time, in FLUX. Cells -2 .. cells + 1 are known. PARTS are those of a row
 * in which both materials are, NULL elsewhere. */
static inline void row_sweep(struct gas_row *row, struct row_parts *parts, double r,
                             struct gas_numbers *flux)
{
    const struct gas_content content = parts_content_of_cells(row, parts);
    struct row_states cell;
    struct gas_numbers to;
    double fall[ROW_ROOM], push[ROW_ROOM];
    row_states(row, &content, &cell, fall);
    const bool lost = row_find_fluxes(row, parts, r, &cell, fall, push, flux);
    row_find_shocks(row, &cell);
    row_advance(row, &row->u, flux, push, r, 0, row->cells - 1, &to);
    /* on a plane no cell has less than the mean of its halves */
    if (lost || row->round)
        row->spent |= row_is_spent(row, &cell, fall, &to);
    row_keep_push(row, push);
    for (int n = 0; n < GAS_NUMBERS; n++)
        FOR_ROW (k, 0, row->cells - 1)
            row->u.of[n][k] = to.of[n][k];
    if (parts)
        parts_advance(row, parts, &cell, r, flux);
}

/* row_sweep for a row that any of both materials may fill; where it is one, as where there is no
 * other. */
static inline void row_muscl_hancock(struct gas_row *row, double r, struct gas_numbers *flux)
{
    const struct gas_closure both = row->closure;
    double least = both.other ? 1.0 : 0.0, most = 0.0;
    FOR_ROW (k, -2, both.other ? row->cells + 1 : -3) {
        least = minimum(least, row->part[PART_FRACTION][k]);
        most = maximum(most, row->part[PART_FRACTION][k]);
    }
    if (most > 0.0 && least < 1.0) {
        struct row_parts parts;
        parts_find(row, &parts);
        row_sweep(row, &parts, r, flux);
        return;
    }
    row->closure.eos = most > 0.0 ? both.other : both.eos;
    row->closure.floor[0] = both.floor[most > 0.0];
    row->closure.liquid = both.liquid && row->closure.floor[0] > -(double)INFINITY;
    row->closure.other = NULL;
    row_sweep(row, NULL, r, flux);
    row->closure = both;
    if (both.other)
        parts_follow(row, most > 0.0, r, flux);
}

#endif
