/* A sweep of MUSCL and Hancock along a row of two materials (mixture.h). Cells of one material are
 * treated as in muscl_hancock.h, to the bit. In cells of both
 *
 * - the fraction of volume has the steepest slope that brings no new extremes, twice the smaller
 *   difference to the neighbours (Overbee: Chiapolino, Saurel and Nkonga, J. Comput. Phys. 340
 *   (2017) 389), which keeps a contact two to three cells wide;
 * - each material's own density is reconstructed, so that a contact between two uniform materials
 *   keeps its pressure, velocity and densities.
 *
 * A face moves the volume that HLLC's mass flux has at the density of the side that it comes from,
 * and the masses and fractions of that side with it. */
#ifndef BOLIDE_GAS_TWO_MATERIALS_H
#define BOLIDE_GAS_TWO_MATERIALS_H

#include "base/lanes.h"
#include "gas/mixture.h"
#include "gas/muscl_hancock.h"
#include "gas/part_limits.h"

/* Below this fraction of volume a cell says nothing of a material's density to its neighbours. */
static const double PART_COUNTS = 1e-3;

/* Less than this fraction of volume is next to nothing. */
static const double PART_LITTLE = 1e-6;

enum part_kind { PART_FIRST, PART_SECOND, PART_BOTH };

/* What a row of two materials needs beside its states. */
struct row_parts {
    uint8_t kind[ROW_ROOM];                                 /* enum part_kind */
    double density[2][ROW_ROOM];                            /* of each material */
    double below[PARTS][ROW_ROOM], above[PARTS][ROW_ROOM];  /* on faces */
    double flux[PARTS][ROW_ROOM], speed[ROW_ROOM];          /* of volume, through faces */
    double inner[2][2][ROW_ROOM], fraction_at[2][ROW_ROOM]; /* of cells of both at their faces */
};

BOLIDE_INLINE void parts_find(const struct gas_row *row, struct row_parts *parts)
{
    FOR_ROW (k, -2, row->cells + 1) {
        const double fraction = row->part[PART_FRACTION][k];
        parts->kind[k] = fraction <= 0.0 ? PART_FIRST : fraction >= 1.0 ? PART_SECOND : PART_BOTH;
        parts->density[0][k] = parts->density[1][k] = row->u.of[GAS_DENSITY][k];
        if (parts->kind[k] != PART_BOTH)
            continue;
        const double mass = row->part[PART_MASS][k];
        parts->density[0][k] =
            mixture_density(row->eos, row->u.of[GAS_DENSITY][k] - mass, 1.0 - fraction);
        parts->density[1][k] = mixture_density(row->other, mass, fraction);
    }
}

/* Takes the states of cells or faces FIRST to LAST from OTHER where the cell, OFFSET from them, has
 * the second material alone. */
BOLIDE_INLINE void parts_choose(const struct row_parts *parts, int first, int last, int offset,
                                const struct row_states *other, struct row_states *states)
{
    FOR_ROW (k, first, last) {
        const bool second = parts->kind[k + offset] == PART_SECOND;
        states->of.of[PRIMITIVE_PRESSURE][k] =
            second ? other->of.of[PRIMITIVE_PRESSURE][k] : states->of.of[PRIMITIVE_PRESSURE][k];
        states->energy[k] = second ? other->energy[k] : states->energy[k];
        states->sound[k] = second ? other->sound[k] : states->sound[k];
    }
}

/* The states of all cells, and by how much their energies may FALL. */
static inline void parts_states(struct gas_row *row, const struct row_parts *parts,
                                struct row_states *states, double *fall)
{
    const struct eos *const eos[2] = {row->eos, row->other};
    struct row_states other = {0};
    double fall_of_other[ROW_ROOM];
    row_states(row, -2, row->cells + 1, states, fall);
    row->eos = eos[1];
    row_states(row, -2, row->cells + 1, &other, fall_of_other);
    row->eos = eos[0];
    parts_choose(parts, -2, row->cells + 1, 0, &other, states);
    FOR_ROW (k, -2, row->cells + 1) {
        if (parts->kind[k] == PART_SECOND)
            fall[k] = fall_of_other[k];
        if (parts->kind[k] != PART_BOTH)
            continue;
        const double density[2] = {parts->density[0][k], parts->density[1][k]},
                     burnt[2] = {parts_burnt(row, 0, k), parts_burnt(row, 1, k)};
        const struct mixture mixture = mixture_of(eos, density, row->part[PART_FRACTION][k], burnt);
        const double pressure = maximum(
                         mixture_pressure(&mixture, row->u.of[GAS_DENSITY][k] * states->energy[k]),
                         row->lit ? UNBURNT_LEAST : -(double)INFINITY),
                     gamma = mixture_gamma(&mixture);
        const double square_of_sound = maximum(mixture_sound_square(&mixture, pressure),
                                               row->lit ? pressure / mixture.density : 0.0);
        states->of.of[PRIMITIVE_PRESSURE][k] = pressure;
        states->sound[k] = sqrt(square_of_sound);
        fall[k] = (1.0 - GAS_LEAST) * square_of_sound / (gamma * (gamma + 1.0));
    }
}

/* The density of material M in cell K; HERE where the cell has none to speak of. */
BOLIDE_INLINE double parts_density(const struct gas_row *row, const struct row_parts *parts, int m,
                                   int k, double here)
{
    const double second = row->part[PART_FRACTION][k], fraction = m ? second : 1.0 - second;
    return fraction >= PART_COUNTS ? parts->density[m][k] : here;
}

/* Density of material M on the low and high face of cell K, half a step on. */
BOLIDE_INLINE void parts_reconstruct(const struct gas_row *row, const struct row_parts *parts,
                                     int m, int k, double shift, double widening, double face[2])
{
    const double here = parts->density[m][k];
    const double slope = limited(here - parts_density(row, parts, m, k - 1, here),
                                 parts_density(row, parts, m, k + 1, here) - here);
    const double middle = maximum(here - 0.5 * (shift * slope + widening * here), GAS_LEAST * here);
    face[0] = middle - 0.5 * slope;
    face[1] = middle + 0.5 * slope;
}

/* The fraction AT the low and high face of cell K of both materials, which the flow crosses in
 * 1/|MOVES| steps. What is next to nothing of a material waits for more to come, or leaves at once
 * where more is. */
BOLIDE_INLINE void parts_fractions(const double *fraction, int k, double moves, double at[2])
{
    const double here = fraction[k], past = here - fraction[k - 1], next = fraction[k + 1] - here;
    const double slope = past * next > 0.0 ? 2.0 * (fabs(past) < fabs(next) ? past : next) : 0.0;
    for (int side = 0; side < 2; side++)
        at[side] = here - 0.5 * moves * slope + (side ? 0.5 : -0.5) * slope;
    const int out = moves > 0.0;
    const double beyond = fraction[out ? k + 1 : k - 1], most = 0.75 / fabs(moves);
    if (here < PART_LITTLE)
        at[out] = minimum(beyond, here * most);
    else if (1.0 - here < PART_LITTLE)
        at[out] = 1.0 - minimum(1.0 - beyond, (1.0 - here) * most);
    for (int side = 0; side < 2; side++)
        at[side] = minimum(maximum(at[side], 0.0), 1.0);
}

/* Reconstructs densities and fractions of cells of both materials and of those next to another
 * material; the rest of BELOW and ABOVE is known. */
APART void parts_faces(const struct gas_row *row, const struct row_states *cell, double r,
                       struct row_parts *parts, struct row_states *below, struct row_states *above)
{
    const double *u = cell->of.of[PRIMITIVE_VELOCITY + row->axis],
                 *fraction = row->part[PART_FRACTION];
    FOR_ROW (k, -1, row->cells) {
        const int kind = parts->kind[k];
        double at[2] = {fraction[k], fraction[k]}; /* low, high */
        if (kind == PART_BOTH || parts->kind[k - 1] != kind || parts->kind[k + 1] != kind) {
            if (kind == PART_BOTH)
                parts_fractions(fraction, k, r * u[k], at);
            double widening = limited(u[k] - u[k - 1], u[k + 1] - u[k]);
            if (row->round)
                widening += row_widening(row, u[k], k);
            for (int m = 0; m < 2; m++) {
                double face[2] = {0.0, 0.0};
                if (kind == PART_BOTH || kind == m)
                    parts_reconstruct(row, parts, m, k, r * u[k], r * widening, face);
                parts->inner[m][0][k] = face[0];
                parts->inner[m][1][k] = face[1];
            }
            above->of.of[PRIMITIVE_DENSITY][k] =
                (1.0 - at[0]) * parts->inner[0][0][k] + at[0] * parts->inner[1][0][k];
            below->of.of[PRIMITIVE_DENSITY][k + 1] =
                (1.0 - at[1]) * parts->inner[0][1][k] + at[1] * parts->inner[1][1][k];
        }
        const double low = above->of.of[PRIMITIVE_DENSITY][k],
                     high = below->of.of[PRIMITIVE_DENSITY][k + 1];
        parts->above[PART_FRACTION][k] = at[0];
        parts->below[PART_FRACTION][k + 1] = at[1];
        parts->above[PART_MASS][k] =
            kind == PART_BOTH ? at[0] * parts->inner[1][0][k] : at[0] * low;
        parts->below[PART_MASS][k + 1] =
            kind == PART_BOTH ? at[1] * parts->inner[1][1][k] : at[1] * high;
    }
}

/* Energies and sound speeds of the states FACE on SIDE, 0 low and 1 high, of the cells that are
 * OFFSET from the faces. */
static inline void parts_close_faces(struct gas_row *row, const struct row_parts *parts,
                                     const struct row_states *cell, int offset, int side,
                                     struct row_states *face)
{
    const struct eos *const eos[2] = {row->eos, row->other};
    struct row_states other = *face;
    row_close_faces(row, cell, offset, face);
    row->eos = eos[1];
    row_close_faces(row, cell, offset, &other);
    row->eos = eos[0];
    parts_choose(parts, 0, row->cells, offset, &other, face);
    FOR_ROW (k, 0, row->cells) {
        const int c = k + offset;
        if (parts->kind[c] != PART_BOTH)
            continue;
        const double density[2] = {parts->inner[0][side][c], parts->inner[1][side][c]},
                     burnt[2] = {parts_burnt(row, 0, c), parts_burnt(row, 1, c)};
        const double fraction =
            side ? parts->below[PART_FRACTION][k] : parts->above[PART_FRACTION][k];
        const struct mixture mixture = mixture_of(eos, density, fraction, burnt);
        const double pressure = face->of.of[PRIMITIVE_PRESSURE][k];
        face->energy[k] = mixture_energy(&mixture, pressure) / mixture.density;
        face->sound[k] = cell->sound[c];
    }
}

/* HLLC between gases whose waves are those of the densities OF_LOW and OF_HIGH, not of what they
 * carry through the face. Where a cell of both materials has the light one alone at its face, waves
 * there would follow its pressure too fast: the cell is as stiff and heavy as all of it. */
static inline struct gas_flow parts_hllc(struct gas_side low, struct gas_side high, double of_low,
                                         double of_high)
{
    struct gas_side slow_side = low, fast_side = high;
    slow_side.density = of_low;
    fast_side.density = of_high;
    const struct gas_waves waves = gas_waves_of(slow_side, fast_side);
    const double ml = of_low * (waves.slow - low.normal), mh = of_high * (waves.fast - high.normal);
    const double contact =
        (high.pressure - low.pressure + ml * low.normal - mh * high.normal) / (ml - mh);
    const bool from_low = contact >= 0.0;
    const struct gas_side side = from_low ? low : high;
    const double wave = from_low ? waves.slow : waves.fast, change = contact - side.normal,
                 push = side.pressure + (from_low ? ml : mh) * change;
    const double total =
        side.density * (side.energy + 0.5 * (square(side.normal) + square(side.across[0]) +
                                             square(side.across[1])));
    struct gas_flow flow;
    if (from_low ? wave >= 0.0 : wave <= 0.0) { /* all waves go one way */
        flow.mass = side.density * side.normal;
        flow.normal = flow.mass * side.normal + side.pressure;
        flow.energy = side.normal * (total + side.pressure);
    } else {
        const double volume = contact * (wave - side.normal) / (wave - contact);
        flow.mass = side.density * volume;
        flow.normal = flow.mass * contact + push;
        flow.energy = volume * total + flow.mass * change * contact +
                      contact * (side.pressure * change / (wave - contact) + push);
    }
    for (int n = 0; n < 2; n++)
        flow.across[n] = flow.mass * side.across[n];
    return flow;
}

BOLIDE_INLINE void row_put_flow(struct gas_flow flow, struct gas_axes axes, int k,
                                struct gas_numbers *flux)
{
    flux->of[GAS_DENSITY][k] = flow.mass;
    flux->of[GAS_MOMENTUM + axes.normal][k] = flow.normal;
    flux->of[GAS_MOMENTUM + axes.across[0]][k] = flow.across[0];
    flux->of[GAS_MOMENTUM + axes.across[1]][k] = flow.across[1];
    flux->of[GAS_ENERGY][k] = flow.energy;
}

/* Fluxes through the faces of cells of both materials. */
APART void parts_fluxes(const struct gas_row *row, const struct row_parts *parts,
                        const struct row_states *cell, const struct row_states *below,
                        const struct row_states *above, struct gas_numbers *flux)
{
    const struct gas_axes axes = gas_axes_of(row->axis);
    const double *own = cell->of.of[PRIMITIVE_DENSITY];
    FOR_ROW (k, 0, row->cells) {
        const bool low = parts->kind[k - 1] == PART_BOTH, high = parts->kind[k] == PART_BOTH;
        if (!low && !high)
            continue;
        row_put_flow(parts_hllc(gas_side_of(below, axes, k), gas_side_of(above, axes, k),
                                low ? own[k - 1] : below->of.of[PRIMITIVE_DENSITY][k],
                                high ? own[k] : above->of.of[PRIMITIVE_DENSITY][k]),
                     axes, k, flux);
    }
}

/* What flows of the second material through face K, where LOW and HIGH, at K + OFFSET and K, are
 * the states of both sides and of_low and of_high, likewise, their second material. */
BOLIDE_INLINE void parts_flow(const struct gas_numbers *flux, const struct row_states *low,
                              double (*of_low)[ROW_ROOM], int offset, const struct row_states *high,
                              double (*of_high)[ROW_ROOM], int k, struct row_parts *parts)
{
    const double mass = flux->of[GAS_DENSITY][k];
    const bool from_low = mass >= 0.0;
    const double speed = mass / (from_low ? low->of.of[PRIMITIVE_DENSITY][k + offset]
                                          : high->of.of[PRIMITIVE_DENSITY][k]);
    parts->speed[k] = speed;
    for (int n = 0; n < PARTS; n++)
        parts->flux[n][k] = speed * (from_low ? of_low[n][k + offset] : of_high[n][k]);
}

/* The same with HLL fluxes. */
static inline void parts_damp(const struct gas_row *row, const struct row_states *below,
                              const struct row_states *above, struct row_parts *parts)
{
    const struct gas_axes axes = gas_axes_of(row->axis);
    FOR_ROW (k, 0, row->cells) {
        if (!row_shock_across(row, k - 1) && !row_shock_across(row, k))
            continue;
        const struct gas_side low = gas_side_of(below, axes, k), high = gas_side_of(above, axes, k);
        const struct gas_waves waves = gas_waves_of(low, high);
        const double slow = minimum(waves.slow, 0.0), fast = maximum(waves.fast, 0.0);
        const double from_low = fast / (fast - slow), from_high = -slow / (fast - slow),
                     spread = slow * fast / (fast - slow);
        parts->speed[k] = from_low * low.normal + from_high * high.normal;
        for (int n = 0; n < PARTS; n++)
            parts->flux[n][k] = from_low * low.normal * parts->below[n][k] +
                                from_high * high.normal * parts->above[n][k] +
                                spread * (parts->above[n][k] - parts->below[n][k]);
    }
}

/* The second material after the step: its mass as other numbers, its fraction less what only
 * widens. */
static inline void parts_advance(struct gas_row *row, const struct row_parts *parts, double r)
{
    double *mass = row->part[PART_MASS], *fraction = row->part[PART_FRACTION];
    const double *flow = parts->flux[PART_MASS], *volume = parts->flux[PART_FRACTION],
                 *speed = parts->speed;
    FOR_ROW (k, 0, row->cells - 1) {
        const double low = row_area(row, k), high = row_area(row, k + 1), size = row_size(row, k);
        mass[k] -= r * (high * flow[k + 1] - low * flow[k]) / size;
        fraction[k] -= r *
                       (high * (volume[k + 1] - fraction[k] * speed[k + 1]) -
                        low * (volume[k] - fraction[k] * speed[k])) /
                       size;
    }
}

/* Traces that are rounding go to the other material. */
BOLIDE_INLINE void parts_clean(struct gas_row *row)
{
    double *mass = row->part[PART_MASS], *fraction = row->part[PART_FRACTION];
    const double *density = row->u.of[GAS_DENSITY];
    FOR_ROW (k, 0, row->cells - 1) {
        const bool none = fraction[k] < MIXTURE_NONE[1], all = 1.0 - fraction[k] < MIXTURE_NONE[0];
        fraction[k] = none ? 0.0 : all ? 1.0 : fraction[k];
        mass[k] = none ? 0.0 : all ? density[k] : minimum(maximum(mass[k], 0.0), density[k]);
    }
}

/* What has burnt in the air flows with its material, of which MASS flows through the faces; OWN is
 * its mass per volume in the cells. */
static inline void row_carry_afterburnt(struct gas_row *row, const double *mass, const double *own,
                                        double r)
{
    double flow[ROW_ROOM];
    FOR_ROW (k, 0, row->cells) {
        const int from = mass[k] >= 0.0 ? k - 1 : k;
        flow[k] = own[from] > 0.0 ? mass[k] * minimum(row->afterburnt[from] / own[from], 1.0) : 0.0;
    }
    FOR_ROW (k, 0, row->cells - 1)
        row->afterburnt[k] =
            maximum(row->afterburnt[k] -
                        r * (row_area(row, k + 1) * flow[k + 1] - row_area(row, k) * flow[k]) /
                            row_size(row, k),
                    0.0);
}

/* Marks in LOST the faces 0 .. cells whose FLUX would take too much out of half of a cell of both
 * materials, as row_mark_lost: mass, either material's mass, or pressure. */
static inline void parts_mark_lost(const struct gas_row *row, const struct row_parts *parts,
                                   const struct row_states *cell, int offset, double side, double r,
                                   const struct gas_numbers *flux, double *lost)
{
    const struct eos *const eos[2] = {row->eos, row->other};
    FOR_ROW (k, 0, row->cells) {
        const int c = k + offset;
        if (parts->kind[c] != PART_BOTH || lost[k] > 0.0)
            continue;
        const double velocity = cell->of.of[PRIMITIVE_VELOCITY + row->axis][c],
                     pressure = cell->of.of[PRIMITIVE_PRESSURE][c], part = 2.0 * side * r;
        double half[GAS_NUMBERS], kinetic = 0.0, mass[2], fraction[2];
        for (int n = 0; n < GAS_NUMBERS; n++) {
            const double u = row->u.of[n][c];
            const double push = n == GAS_MOMENTUM + row->axis ? pressure
                                : n == GAS_ENERGY             ? pressure * velocity
                                                              : 0.0;
            half[n] = u - part * (flux->of[n][k] - velocity * u - push);
        }
        for (int n = GAS_MOMENTUM; n < GAS_ENERGY; n++)
            kinetic += 0.5 * square(half[n]) / half[GAS_DENSITY];
        const double *own = row->part[PART_FRACTION];
        mass[1] = row->part[PART_MASS][c] -
                  part * (parts->flux[PART_MASS][k] - velocity * row->part[PART_MASS][c]);
        mass[0] = half[GAS_DENSITY] - mass[1];
        fraction[1] = own[c] - part * (parts->flux[PART_FRACTION][k] - own[c] * parts->speed[k]);
        fraction[0] = 1.0 - fraction[1];
        bool stays = half[GAS_DENSITY] > GAS_LEAST * row->u.of[GAS_DENSITY][c];
        if (stays && fraction[0] > 0.0 && fraction[1] > 0.0) {
            const double density[2] = {mixture_density(eos[0], mass[0], fraction[0]),
                                       mixture_density(eos[1], mass[1], fraction[1])},
                         burnt[2] = {parts_burnt(row, 0, c), parts_burnt(row, 1, c)};
            const struct mixture mixture = mixture_of(eos, density, fraction[1], burnt);
            stays = mixture_pressure(&mixture, half[GAS_ENERGY] - kinetic) > GAS_LEAST * pressure;
        }
        lost[k] = stays ? 0.0 : 1.0;
    }
}

/* Faces that are LOST have the fluxes of first order. */
APART void parts_replace_lost(const struct gas_row *row, const struct row_states *cell,
                              const double *lost, struct row_parts *parts, struct gas_numbers *flux)
{
    for (int k = 0; k <= row->cells; k++)
        if (lost[k + ROW_GHOSTS] > 0.0) {
            row_hllc(row, cell, -1, cell, k, k, flux);
            parts_flow(flux, cell, (double(*)[ROW_ROOM])row->part, -1, cell,
                       (double(*)[ROW_ROOM])row->part, k + ROW_GHOSTS, parts);
        }
}

/* row_muscl_hancock where cells of both materials, or of the one beside the other, are in the
 * row. */
static inline void parts_sweep(struct gas_row *row, struct row_parts *parts, double r,
                               struct gas_numbers *flux)
{
    struct row_states cell = {0}, below = {0}, above = {0};
    struct gas_numbers to;
    double fall[ROW_ROOM], push[ROW_ROOM], lost[ROW_ROOM];
    parts_states(row, parts, &cell, fall);
    row_faces(row, &cell, r, &below, &above, push);
    parts_faces(row, &cell, r, parts, &below, &above);
    parts_close_faces(row, parts, &cell, -1, 1, &below);
    parts_close_faces(row, parts, &cell, 0, 0, &above);
    row_hllc(row, &below, 0, &above, 0, row->cells, flux);
    parts_fluxes(row, parts, &cell, &below, &above, flux);
    FOR_ROW (k, 0, row->cells)
        parts_flow(flux, &below, parts->below, 0, &above, parts->above, k, parts);
    if (row->crossed) {
        row_damp(row, &below, &above, flux);
        parts_damp(row, &below, &above, parts);
    }
    row_find_shocks(row, &cell);
    FOR_ROW (k, 0, row->cells)
        lost[k] = 0.0;
    row_mark_lost(row, &cell, fall, -1, 1.0, row_strict(row, r), flux, lost);
    row_mark_lost(row, &cell, fall, 0, -1.0, row_strict(row, r), flux, lost);
    parts_mark_lost(row, parts, &cell, -1, 1.0, row_strict(row, r), flux, lost);
    parts_mark_lost(row, parts, &cell, 0, -1.0, row_strict(row, r), flux, lost);
    parts_replace_lost(row, &cell, lost, parts, flux);
    row_advance(row, &row->u, flux, push, r, 0, row->cells - 1, &to);
    row->spent |= row_is_spent(row, &cell, fall, &to);
    row_keep_push(row, push);
    for (int n = 0; n < GAS_NUMBERS; n++)
        FOR_ROW (k, 0, row->cells - 1)
            row->u.of[n][k] = to.of[n][k];
    if (row->afterburns) {
        FOR_ROW (k, 0, row->cells) /* as in a row of the second alone, to the bit */
            if (parts->kind[k - 1] == PART_SECOND && parts->kind[k] == PART_SECOND)
                parts->flux[PART_MASS][k] = flux->of[GAS_DENSITY][k];
        row_carry_afterburnt(row, parts->flux[PART_MASS], row->part[PART_MASS], r);
    }
    FOR_ROW (k, 0, row->watched ? row->cells : -1)
        row->second_flux[k] = parts->flux[PART_MASS][k];
    parts_advance(row, parts, r);
    parts_clean(row);
    if (row->thaws)
        parts_thaw(row);
    if (!row->lit)
        row->spent |= parts_are_spent(row, &cell);
}

/* Takes the cells of a row of two materials through a sweep, as row_muscl_hancock. */
static inline void row_two_materials(struct gas_row *row, double r, struct gas_numbers *flux)
{
    const struct eos *const first = row->eos;
    double least = 1.0, most = 0.0;
    FOR_ROW (k, -2, row->cells + 1) {
        least = minimum(least, row->part[PART_FRACTION][k]);
        most = maximum(most, row->part[PART_FRACTION][k]);
    }
    if (most > 0.0 && least < 1.0) {
        struct row_parts parts;
        parts_find(row, &parts);
        parts_sweep(row, &parts, r, flux);
        return;
    }
    row->eos = most > 0.0 ? row->other : first;
    row_muscl_hancock(row, r, flux);
    row->eos = first;
    if (row->afterburns && most > 0.0)
        row_carry_afterburnt(row, flux->of[GAS_DENSITY], row->part[PART_MASS], r);
    FOR_ROW (k, 0, row->watched ? row->cells : -1)
        row->second_flux[k] = most > 0.0 ? flux->of[GAS_DENSITY][k] : 0.0;
    FOR_ROW (k, 0, row->cells - 1)
        row->part[PART_MASS][k] = most > 0.0 ? row->u.of[GAS_DENSITY][k] : 0.0;
}

#endif
