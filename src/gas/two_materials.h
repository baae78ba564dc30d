/* What a sweep of MUSCL and Hancock (muscl_hancock.h) does with the parts of two materials in the
 * cells of a row (mixture.h); cells of one material are as in a row of it, to the bit. In cells of
 * both
 *
 * - the fraction of volume has the steepest slope that brings no new extremes, twice the smaller
 *   difference to the neighbours (Overbee: Chiapolino, Saurel and Nkonga, J. Comput. Phys. 340
 *   (2017) 389), which keeps a contact two to three cells wide;
 * - each material's own density is reconstructed, so that a contact between two uniform materials
 *   keeps its pressure, velocity and densities.
 *
 * A face moves the volume that the Riemann solver's mass flux has at the density of the side that
 * it comes from, and the masses and fractions of that side with it. */
#ifndef BOLIDE_GAS_TWO_MATERIALS_H
#define BOLIDE_GAS_TWO_MATERIALS_H

#include "gas/part_limits.h"

/* Less than this fraction of volume is next to nothing. */
static const double PART_LITTLE = 1e-6;

/* What a row of two materials needs beside its states. */
struct row_parts {
    uint8_t kind[ROW_ROOM];                                /* enum content_kind */
    double density[2][ROW_ROOM];                           /* of each material */
    double below[PARTS][ROW_ROOM], above[PARTS][ROW_ROOM]; /* on faces */
    double flux[PARTS][ROW_ROOM], speed[ROW_ROOM];         /* of volume, through faces */
    double inner[2][2][ROW_ROOM];                          /* of cells of both at their faces */
};

BOLIDE_INLINE void parts_find(const struct gas_row *row, struct row_parts *parts)
{
    FOR_ROW (k, -2, row->cells + 1) {
        const double fraction = row->part[PART_FRACTION][k], mass = row->part[PART_MASS][k],
                     density = row->u.of[GAS_DENSITY][k];
        parts->kind[k] = content_kind_of(fraction);
        parts->density[0][k] = parts->density[1][k] = density;
        if (parts->kind[k] != CONTENT_BOTH)
            continue;
        parts->density[0][k] = mixture_density(row->closure.eos, density - mass, 1.0 - fraction);
        parts->density[1][k] = mixture_density(row->closure.other, mass, fraction);
    }
}

/* The content of the cells of a row, PARTS of two materials or NULL. Of an explosive some pressure
 * is left while it burns. */
BOLIDE_INLINE struct gas_content parts_content_of_cells(const struct gas_row *row,
                                                        const struct row_parts *parts)
{
    struct gas_content content = {.kind = NULL, .burnt = row->burnt};
    if (parts) {
        content.kind = parts->kind;
        content.own[0] = parts->density[0];
        content.own[1] = parts->density[1];
        content.fraction = row->part[PART_FRACTION];
        content.least = row->closure.lit ? UNBURNT_LEAST : -(double)INFINITY;
    }
    return content;
}

/* That of the faces 0 .. cells on SIDE, 0 low and 1 high, of the cells OFFSET from them. */
BOLIDE_INLINE struct gas_content parts_content_of_faces(const struct gas_row *row,
                                                        const struct row_parts *parts, int offset,
                                                        int side)
{
    struct gas_content content = {.kind = NULL, .burnt = row->burnt + offset};
    if (parts) {
        content.kind = parts->kind + offset;
        content.own[0] = parts->inner[0][side] + offset;
        content.own[1] = parts->inner[1][side] + offset;
        content.fraction = side ? parts->below[PART_FRACTION] : parts->above[PART_FRACTION];
        content.least = -(double)INFINITY;
    }
    return content;
}

/* The density of material M in cell K; HERE where the cell has none to speak of. */
BOLIDE_INLINE double parts_density(const struct gas_row *row, const struct row_parts *parts, int m,
                                   int k, double here)
{
    const double second = row->part[PART_FRACTION][k], fraction = m ? second : 1.0 - second;
    return fraction >= MIXTURE_COUNTS ? parts->density[m][k] : here;
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
        if (kind == CONTENT_BOTH || parts->kind[k - 1] != kind || parts->kind[k + 1] != kind) {
            if (kind == CONTENT_BOTH)
                parts_fractions(fraction, k, r * u[k], at);
            double widening = limited(u[k] - u[k - 1], u[k + 1] - u[k]);
            if (row->round)
                widening += row_widening(row, u[k], k);
            for (int m = 0; m < 2; m++) {
                double face[2] = {0.0, 0.0};
                if (kind == CONTENT_BOTH || kind == m)
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
            kind == CONTENT_BOTH ? at[0] * parts->inner[1][0][k] : at[0] * low;
        parts->below[PART_MASS][k + 1] =
            kind == CONTENT_BOTH ? at[1] * parts->inner[1][1][k] : at[1] * high;
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

/* All fluxes. Waves of cells of both materials are those of all that is in them: where such a cell
 * has the light material alone at its face, waves there would follow its pressure too fast. */
APART void parts_fluxes(const struct gas_row *row, const struct row_states *cell,
                        const struct row_states *below, const struct row_states *above,
                        struct row_parts *parts, struct gas_numbers *flux)
{
    const double *own = cell->of.of[PRIMITIVE_DENSITY], *low = below->of.of[PRIMITIVE_DENSITY],
                 *high = above->of.of[PRIMITIVE_DENSITY];
    double surplus[2][ROW_ROOM];
    FOR_ROW (k, 0, row->cells) {
        surplus[0][k] = parts->kind[k - 1] == CONTENT_BOTH ? low[k] - own[k - 1] : 0.0;
        surplus[1][k] = parts->kind[k] == CONTENT_BOTH ? high[k] - own[k] : 0.0;
    }
    row_fluxes(row, below, above, surplus, flux);
    FOR_ROW (k, 0, row->cells)
        parts_flow(flux, below, parts->below, 0, above, parts->above, k, parts);
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
        const struct gas_hll_weights w = gas_hll_weights_of(&low, &high);
        parts->speed[k] = w.from_low * low.normal + w.from_high * high.normal;
        for (int n = 0; n < PARTS; n++)
            parts->flux[n][k] = w.from_low * low.normal * parts->below[n][k] +
                                w.from_high * high.normal * parts->above[n][k] +
                                w.spread * (parts->above[n][k] - parts->below[n][k]);
    }
}

/* The second material after the step: its mass as other numbers, its fraction less what only
 * widens. */
static inline void parts_move(struct gas_row *row, const struct row_parts *parts, double r)
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
    FOR_ROW (k, 0, row->watched ? row->cells : -1)
        row->afterburnt_flux[k] = flow[k];
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
    const struct eos *const eos[2] = {row->closure.eos, row->closure.other};
    const double *own = row->part[PART_FRACTION], *second = row->part[PART_MASS];
    struct mixtures mixtures;
    mixtures.count = 0;
    FOR_ROW (k, 0, row->cells) {
        const int c = k + offset;
        if (parts->kind[c] != CONTENT_BOTH || lost[k] > 0.0)
            continue;
        const double velocity = cell->of.of[PRIMITIVE_VELOCITY + row->axis][c],
                     pressure = cell->of.of[PRIMITIVE_PRESSURE][c], part = 2.0 * side * r;
        double half[GAS_NUMBERS], kinetic = 0.0, mass[2];
        for (int n = 0; n < GAS_NUMBERS; n++) {
            const double u = row->u.of[n][c];
            const double push = n == GAS_MOMENTUM + row->axis ? pressure
                                : n == GAS_ENERGY             ? pressure * velocity
                                                              : 0.0;
            half[n] = u - part * (flux->of[n][k] - velocity * u - push);
        }
        for (int n = GAS_MOMENTUM; n < GAS_ENERGY; n++)
            kinetic += 0.5 * square(half[n]) / half[GAS_DENSITY];
        mass[1] = second[c] - part * (parts->flux[PART_MASS][k] - velocity * second[c]);
        mass[0] = half[GAS_DENSITY] - mass[1];
        const double fraction =
            own[c] - part * (parts->flux[PART_FRACTION][k] - own[c] * parts->speed[k]);
        const bool stays = half[GAS_DENSITY] > GAS_LEAST * row->u.of[GAS_DENSITY][c];
        lost[k] = stays ? 0.0 : 1.0;
        if (stays && !row->closure.liquid && 1.0 - fraction > 0.0 && fraction > 0.0)
            gas_add_mixture(&row->closure, mass, fraction, row->burnt[c],
                            half[GAS_ENERGY] - kinetic, k, &mixtures);
    }
    mixtures_find(&mixtures, eos);
    for (int i = 0; i < mixtures.count; i++) {
        const int k = mixtures.place[i];
        const bool stays =
            mixtures.pressure[i] > GAS_LEAST * cell->of.of[PRIMITIVE_PRESSURE][k + offset];
        lost[k] = stays ? 0.0 : 1.0;
    }
}

/* The parts after a sweep whose fluxes through faces are FLUX, and before which cells were CELL. */
APART void parts_advance(struct gas_row *row, struct row_parts *parts,
                         const struct row_states *cell, double r, const struct gas_numbers *flux)
{
    if (row->afterburns) {
        FOR_ROW (k, 0, row->cells) /* as in a row of the second alone, to the bit */
            if (parts->kind[k - 1] == CONTENT_SECOND && parts->kind[k] == CONTENT_SECOND)
                parts->flux[PART_MASS][k] = flux->of[GAS_DENSITY][k];
        row_carry_afterburnt(row, parts->flux[PART_MASS], row->part[PART_MASS], r);
    }
    FOR_ROW (k, 0, row->watched ? row->cells : -1) {
        row->second_flux[k] = parts->flux[PART_MASS][k];
        row->volume_flux[k] = parts->flux[PART_FRACTION][k];
        row->face_speed[k] = parts->speed[k];
    }
    parts_move(row, parts, r);
    parts_clean(row);
    if (row->thaws)
        parts_thaw(row);
    if (row->closure.liquid)
        parts_open(row);
    if (!row->closure.lit && !row->closure.liquid)
        row->spent |= parts_are_spent(row, cell);
}

/* The same of a row that one material fills, the SECOND or the first. */
static inline void parts_follow(struct gas_row *row, bool second, double r,
                                const struct gas_numbers *flux)
{
    if (row->afterburns && second)
        row_carry_afterburnt(row, flux->of[GAS_DENSITY], row->part[PART_MASS], r);
    FOR_ROW (k, 0, row->watched ? row->cells : -1) {
        row->afterburnt_flux[k] = second && row->afterburns ? row->afterburnt_flux[k] : 0.0;
        row->second_flux[k] = second ? flux->of[GAS_DENSITY][k] : 0.0;
        row->volume_flux[k] = row->face_speed[k] = 0.0; /* of no account: the fraction stays */
    }
    FOR_ROW (k, 0, row->cells - 1)
        row->part[PART_MASS][k] = second ? row->u.of[GAS_DENSITY][k] : 0.0;
}

#endif
