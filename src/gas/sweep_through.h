/* Rows of a sweep, and what is noted of the fluxes through their faces: ends of strips, blocked
 * cells, and the box that a coupling watches. For the file that is compiled once an instruction
 * set. */
#ifndef BOLIDE_GAS_SWEEP_THROUGH_H
#define BOLIDE_GAS_SWEEP_THROUGH_H

#include "gas/sweep.h"

/* The axes across a sweep, the lower first. */
struct across {
    int first, second;
};

BOLIDE_INLINE struct across across_of(int axis)
{
    const struct across across = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
    return across;
}

/* A row: its place across the strip, and where its cells are, by segments of blocks. */
struct gather {
    const struct gas_sweep *sweep;
    const struct gas_strip *strip;
    int i, j; /* across, the lower axis first */
    int rows; /* along the lower axis */
};

BOLIDE_INLINE void note_flux(const struct gas_numbers *flux, int face, double *out)
{
    for (int n = 0; n < GAS_NUMBERS; n++)
        out[n] = flux->of[n][face + ROW_GHOSTS];
}

/* What has passed through FACE of a row at an end of its strip. */
BOLIDE_INLINE void note_end(const struct gas_row *row, const struct gas_numbers *flux, int face,
                            double *out)
{
    note_flux(flux, face, out);
    if (!row->watched || !row->closure.other)
        return;
    out[THROUGH_SECOND] = row->second_flux[face + ROW_GHOSTS];
    out[THROUGH_VOLUME] = row->volume_flux[face + ROW_GHOSTS];
    out[THROUGH_SPEED] = row->face_speed[face + ROW_GHOSTS];
    if (row->afterburns)
        out[THROUGH_AFTERBURNT] = row->afterburnt_flux[face + ROW_GHOSTS];
}

/* The cells BEGIN .. END - 1 of a row, counted from its first, that lie in the cut. */
BOLIDE_INLINE void find_cut(const struct gather *g, int *begin, int *end)
{
    const struct gas_cut *cut = g->sweep->cut;
    const struct cell_block *block = &g->sweep->cells->block[g->strip->block[0]];
    const struct across across = across_of(g->sweep->axis);
    const int64_t at[2] = {block->corner[across.first] + g->i, block->corner[across.second] + g->j};
    const bool meets = cut && block->level == 0 && at[0] >= cut->low[across.first] &&
                       at[0] < cut->high[across.first] && at[1] >= cut->low[across.second] &&
                       at[1] < cut->high[across.second];
    *begin = meets ? (int)(cut->low[g->sweep->axis] - block->corner[g->sweep->axis]) : 0;
    *end = meets ? (int)(cut->high[g->sweep->axis] - block->corner[g->sweep->axis]) : 0;
}

/* Adds what passes through the faces of the cut that lie among those below the CELLS of a row,
 * whose first is cell BEGIN of the strip. */
BOLIDE_INLINE void note_cut(const struct gather *g, const struct gas_row *row,
                            const struct gas_numbers *flux, int begin)
{
    const struct gas_sweep *sweep = g->sweep;
    const struct gas_cut *cut = sweep->cut;
    const struct cell_block *block = &sweep->cells->block[g->strip->block[0]];
    const struct across across = across_of(sweep->axis);
    const int64_t first = block->corner[sweep->axis] + begin;
    const int64_t at[2] = {block->corner[across.first] + g->i, block->corner[across.second] + g->j};
    if (block->level > 0 || at[0] < cut->low[across.first] || at[0] >= cut->high[across.first] ||
        at[1] < cut->low[across.second] || at[1] >= cut->high[across.second])
        return;
    const int64_t number =
        at[0] - cut->low[across.first] +
        (at[1] - cut->low[across.second]) * (cut->high[across.first] - cut->low[across.first]);
    for (int side = 0; side < 2; side++) {
        const int64_t plane = side ? cut->high[sweep->axis] : cut->low[sweep->axis];
        if (!cut->open[sweep->axis][side] || plane < first || plane >= first + row->cells)
            continue;
        double *passed = cut->passed[sweep->axis][side] + number * GAS_PASSED;
        const int k = (int)(plane - first) + ROW_GHOSTS;
        for (int n = 0; n < GAS_NUMBERS; n++)
            passed[n] += sweep->dt * flux->of[n][k];
        passed[GAS_NUMBERS] += row->closure.other ? sweep->dt * row->second_flux[k] : 0.0;
    }
}

/* Along a radius, the sums of PUSH over the cells of each block of the strip. */
BOLIDE_INLINE void note_push(const struct gather *g, const double *push, int number,
                             struct gas_through *through)
{
    int k = ROW_GHOSTS, begin, end; /* what is in the cut does not count */
    find_cut(g, &begin, &end);
    for (int s = 0; s < g->strip->count && g->sweep->round; s++) {
        const int count = g->sweep->cells->block[g->strip->block[s]].count[g->sweep->axis];
        double sum = 0.0;
        for (int c = 0; c < count; c++)
            if (k + c - ROW_GHOSTS < begin || k + c - ROW_GHOSTS >= end)
                sum += push[k + c];
        through->push[number][s] = sum;
        k += count;
    }
}

BOLIDE_INLINE void note_obstacle(const struct gas_numbers *flux, int face, int row, int at,
                                 int side, struct gas_through *through)
{
    through->obstacle[through->obstacles].row = row;
    through->obstacle[through->obstacles].face = at;
    through->obstacle[through->obstacles].side = side;
    note_flux(flux, face, through->obstacle[through->obstacles].flux);
    through->obstacles++;
}

#endif
