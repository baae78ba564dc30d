/* Sweeps over strips and the state of blocks for one instruction set, named by BOLIDE_ISA; see
 * sweep.h. */
#include "gas/sweep.h"

#include <string.h>

#include "base/isa.h"
#include "gas/muscl_hancock.h"
#include "gas/sweep_through.h"

static int32_t place_of(const struct gather *g, const struct cell_block *block)
{
    const struct across across = across_of(g->sweep->axis);
    return block->first + g->i * cell_stride(block, across.first) +
           g->j * cell_stride(block, across.second);
}

/* The fields FIRST to END - 1 of a ghost of the row into place K. */
static void load_ghost(const struct gather *g, const struct cell_source *source, int first, int end,
                       int k, double (*out)[ROW_ROOM])
{
    const struct gas_sweep *sweep = g->sweep;
    const int dimension = sweep->cells->dimension;
    if (source->block >= 0) {
        const struct cell_block *block = &sweep->cells->block[source->block];
        const int32_t at = place_of(g, block) + source->at * cell_stride(block, sweep->axis);
        for (int n = first; n < end; n++)
            out[n - first][k] = sweep->from[n][at];
    } else
        for (int n = first; n < end; n++)
            out[n - first][k] = cell_plane(sweep->halo, dimension, sweep->axis, source->at,
                                           n)[g->i + g->j * g->rows];
    if (source->turned && first == 0)
        out[GAS_MOMENTUM + sweep->axis][k] = -out[GAS_MOMENTUM + sweep->axis][k];
}

/* The fields FIRST to END - 1, all conserved numbers or none, of the cells of a row and those
 * beyond its ends. Returns the number of its cells. */
static int load_row(const struct gather *g, int first, int end, double (*out)[ROW_ROOM])
{
    const struct gas_sweep *sweep = g->sweep;
    const struct gas_strip *strip = g->strip;
    const struct cell_halo_axis *halo = &sweep->halo->axis[sweep->axis];
    int k = ROW_GHOSTS;
    for (int s = 0; s < strip->count; s++) {
        const struct cell_block *block = &sweep->cells->block[strip->block[s]];
        const int32_t at = place_of(g, block), stride = cell_stride(block, sweep->axis);
        const int count = block->count[sweep->axis];
        for (int n = first; n < end; n++) {
            const double *in = sweep->from[n] + at;
            for (int c = 0; c < count; c++)
                out[n - first][k + c] = in[c * stride];
        }
        k += count;
    }
    const int32_t low = strip->block[0], high = strip->block[strip->count - 1];
    for (int depth = 0; depth < sweep->halo->depth; depth++) {
        load_ghost(g, &halo->beyond[low][0][depth], first, end, ROW_GHOSTS - 1 - depth, out);
        load_ghost(g, &halo->beyond[high][1][depth], first, end, k + depth, out);
    }
    return k - ROW_GHOSTS;
}

/* Cells BEGIN to END - 1 of a block, of a row whose cell IN[0] is the first of the block. */
static inline void store_cells(const double *in, double *out, int32_t stride, int begin, int end)
{
    for (int c = begin; c < end; c++)
        out[c * stride] = in[c];
}

/* The cells of a row that begins with cell FIRST of the strip. */
static void store_row(const struct gather *g, const struct gas_row *row, int first)
{
    const struct gas_sweep *sweep = g->sweep;
    const bool marks = !g->strip->calm || row->shocked;
    int k = 0;
    for (int s = 0; s < g->strip->count; s++) {
        const struct cell_block *block = &sweep->cells->block[g->strip->block[s]];
        const int32_t at = place_of(g, block), stride = cell_stride(block, sweep->axis);
        const int count = block->count[sweep->axis], begin = first > k ? first - k : 0,
                  end = first + row->cells < k + count ? first + row->cells - k : count,
                  in = ROW_GHOSTS + k - first;
        for (int n = 0; n < GAS_NUMBERS; n++)
            store_cells(row->u.of[n] + in, sweep->to[n] + at, stride, begin, end);
        if (marks) {
            store_cells(row->shock + in, sweep->to[GAS_SHOCK] + at, stride, begin, end);
            for (int c = begin; c < end; c++)
                sweep->shocked[g->strip->block[s]] |= row->shock[in + c] != 0.0;
        }
        for (int n = 0; n < PARTS && row->closure.other; n++)
            store_cells(row->part[n] + in, sweep->to[GAS_SECOND + n] + at, stride, begin, end);
        if (row->afterburns)
            store_cells(row->afterburnt + in, sweep->to[GAS_AFTERBURNT] + at, stride, begin, end);
        k += count;
    }
}

static void sweep_row(const struct gather *g, struct gas_row *row, struct gas_numbers *flux)
{
    const double r = g->sweep->r * g->strip->part;
    if (g->sweep->second_order)
        row_muscl_hancock(row, r, flux);
    else
        row_lax_wendroff(row, &g->sweep->scheme, r, flux);
}

/* Copies cell FROM of ALL, in LAYOUT, to place K of a row, turned where it is an image. */
static void copy_cell(double (*all)[ROW_ROOM], const struct gas_layout *layout, int from,
                      bool turned, struct gas_row *to, int k)
{
    const int axis = to->axis;
    to->shock[k] = all[GAS_SHOCK][from];
    for (int n = 0; n < PARTS && to->closure.other; n++)
        to->part[n][k] = all[GAS_SECOND + n][from];
    if (to->afterburns)
        to->afterburnt[k] = all[GAS_AFTERBURNT][from];
    if (to->closure.lit)
        to->burnt[k] = all[layout->burnt][from];
    if (layout->marked)
        to->gamma[k] = all[layout->gamma][from];
    for (int n = 0; n < GAS_NUMBERS; n++)
        to->u.of[n][k] = turned && n == GAS_MOMENTUM + axis ? -all[n][from] : all[n][from];
}

/* The place in a run LOW .. HIGH of open cells that stands for place K outside it, reflected at its
 * ends as often as it takes. */
static int reflected(int k, int low, int high, bool *turned)
{
    *turned = false;
    while (k < low || k > high) {
        k = k < low ? 2 * low - 1 - k : 2 * high + 1 - k;
        *turned = !*turned;
    }
    return k;
}

/* A row of CELLS cells some of which, or of their ghosts, are blocked: each run of open cells
 * between blocked ones is a row of its own, whose ghosts beyond a blocked cell are images. */
static void sweep_runs(const struct gather *g, double (*all)[ROW_ROOM], int cells, int number,
                       struct gas_row *row, struct gas_through *through)
{
    const struct gas_layout *layout = g->sweep->layout;
    const int depth = g->sweep->halo->depth;
    const int begin = ROW_GHOSTS, end = ROW_GHOSTS + cells; /* of the row's own cells */
    const double *open = all[layout->open], first = row->first;
    double push[ROW_ROOM] = {0.0};
    struct gas_numbers flux;
    for (int k = begin - depth; k < end + depth;) {
        if (open[k] == 0.0) {
            if (k >= begin && k < end) { /* as it was */
                row->cells = 1;
                copy_cell(all, layout, k, false, row, ROW_GHOSTS);
                store_row(g, row, k - begin);
            }
            k++;
            continue;
        }
        int last = k;
        while (last + 1 < end + depth && open[last + 1] != 0.0)
            last++;
        const int from = k > begin ? k : begin, to = last < end ? last + 1 : end;
        if (from < to) {
            const bool closed_low = k > begin - depth, closed_high = last < end + depth - 1;
            row->cells = to - from;
            row->first = first + (from - begin);
            for (int at = from - depth; at < to + depth; at++) {
                bool turned = false;
                int source = at;
                if ((closed_low && at < k) || (closed_high && at > last))
                    source =
                        reflected(at, closed_low ? k : -1000, closed_high ? last : 1000, &turned);
                copy_cell(all, layout, source, turned, row, at - from + ROW_GHOSTS);
            }
            sweep_row(g, row, &flux);
            if (g->sweep->cut)
                note_cut(g, row, &flux, from - begin);
            store_row(g, row, from - begin);
            for (int at = from; at < to && row->round; at++)
                push[at] = row->push[at - from + ROW_GHOSTS];
            if (from == begin)
                note_end(row, &flux, 0, through->end[0][number]);
            if (to == end)
                note_end(row, &flux, row->cells, through->end[1][number]);
            if (closed_low && from == k)
                note_obstacle(&flux, 0, number, from - begin, 1, through);
            if (closed_high && to == last + 1)
                note_obstacle(&flux, row->cells, number, to - begin, -1, through);
        }
        k = last + 1;
    }
    note_push(g, push, number, through);
    row->first = first;
}

static bool any_blocked(const double *open, int cells, int depth)
{
    bool any = false;
    FOR_ROW (k, -depth, cells - 1 + depth)
        any |= open[k] == 0.0;
    return any;
}

ISA_KERNEL(void, gas_sweep_strip, const struct gas_sweep *sweep, const struct gas_strip *strip,
           struct gas_through *through)
{
    const struct gas_layout *layout = sweep->layout;
    const struct cell_block *block = &sweep->cells->block[strip->block[0]];
    const struct across across = across_of(sweep->axis);
    const int rows = block->count[across.first], columns = block->count[across.second],
              through_numbers = sweep->joins ? gas_numbers_through(layout) : GAS_NUMBERS;
    struct gas_row row;
    row.closure = sweep->closure;
    row.riemann = sweep->riemann;
    row.afterburns = layout->afterburns;
    row.axis = sweep->axis;
    row.round = sweep->round;
    row.shocked = true;
    row.watched = sweep->cut || sweep->joins;
    row.thaws = sweep->thaws;
    row.spent = false;
    row.first = (double)block->corner[sweep->axis];
    through->obstacles = 0;
    for (int j = 0; j < columns; j++)
        for (int i = 0; i < rows; i++) {
            if (strip->sleeps && i + j > 0) {
                for (int side = 0; side < 2; side++)
                    for (int n = 0; n < through_numbers; n++)
                        through->end[side][i + j * rows][n] = through->end[side][0][n];
                for (int s = 0; s < strip->count && sweep->round; s++)
                    through->push[i + j * rows][s] = through->push[0][s];
                continue;
            }
            const struct gather g = {sweep, strip, i, j, rows};
            const int number = i + j * rows;
            double all[GAS_FIELDS][ROW_ROOM];
            struct gas_numbers flux;
            const int cells = layout->blocked ? load_row(&g, 0, layout->fields, all)
                                              : load_row(&g, 0, GAS_NUMBERS, row.u.of);
            row.cells = cells;
            row.crossed = !strip->calm;
            if (!layout->blocked && !strip->calm)
                load_row(&g, GAS_SHOCK, GAS_SHOCK + 1, &row.shock);
            else if (row.shocked)
                memset(row.shock, 0, sizeof row.shock);
            row.shocked = false;
            if (!layout->blocked && row.closure.other)
                load_row(&g, GAS_SECOND, GAS_SECOND + PARTS, row.part);
            if (!layout->blocked && row.afterburns)
                load_row(&g, GAS_AFTERBURNT, GAS_AFTERBURNT + 1, &row.afterburnt);
            if (!layout->blocked && row.closure.lit)
                load_row(&g, layout->burnt, layout->burnt + 1, &row.burnt);
            if (!layout->blocked && layout->marked)
                load_row(&g, layout->gamma, layout->gamma + 1, &row.gamma);
            if (layout->blocked) {
                if (any_blocked(all[layout->open], cells, sweep->halo->depth)) {
                    for (int n = 0; n < through_numbers; n++)
                        through->end[0][number][n] = through->end[1][number][n] = 0.0;
                    sweep_runs(&g, all, cells, number, &row, through);
                    continue;
                }
                FOR_ROW (k, -sweep->halo->depth, cells - 1 + sweep->halo->depth)
                    copy_cell(all, layout, k, false, &row, k);
            }
            sweep_row(&g, &row, &flux);
            if (sweep->cut)
                note_cut(&g, &row, &flux, 0);
            store_row(&g, &row, 0);
            note_push(&g, row.push, number, through);
            note_end(&row, &flux, 0, through->end[0][number]);
            note_end(&row, &flux, cells, through->end[1][number]);
        }
    through->spent = row.spent;
}

/* Cells of a block, ROW_CELLS at most, as the closure and the store take them. */
struct run {
    int32_t first;
    int count;
    double density[ROW_ROOM], energy[ROW_ROOM], velocity[3][ROW_ROOM], fastest[ROW_ROOM];
    uint8_t kind[ROW_ROOM]; /* where there are two materials */
    double own[2][ROW_ROOM];
};

/* The kinds of the cells of a run, and the densities of both materials in them. */
static void find_parts(const struct gas_look *look, struct run *run)
{
    const double *second = look->u[GAS_SECOND] + run->first,
                 *fraction = look->u[GAS_FRACTION] + run->first;
    for (int c = 0; c < run->count; c++) {
        const int k = c + ROW_GHOSTS;
        run->kind[k] = content_kind_of(fraction[c]);
        if (run->kind[k] != CONTENT_BOTH)
            continue;
        run->own[0][k] =
            mixture_density(look->closure.eos, run->density[k] - second[c], 1.0 - fraction[c]);
        run->own[1][k] = mixture_density(look->closure.other, second[c], fraction[c]);
    }
}

/* Pressures, and derivatives that give the speed of sound. */
static void evaluate_run(const struct gas_look *look, struct run *run, struct row_values *values)
{
    const struct gas_layout *layout = look->layout;
    const double *const *u = look->u;
    const int32_t at = run->first - ROW_GHOSTS;
    struct gas_content content = {.kind = NULL, .least = -(double)INFINITY};
    if (look->closure.lit)
        content.burnt = u[layout->burnt] + at;
    if (look->closure.other) {
        find_parts(look, run);
        content.kind = run->kind;
        content.own[0] = run->own[0];
        content.own[1] = run->own[1];
        content.fraction = u[GAS_FRACTION] + at;
        content.gamma = layout->marked ? u[layout->gamma] + at : NULL;
    }
    gas_evaluate(&look->closure, &content, run->density, run->energy, 0, run->count - 1, values);
}

static bool is_closed(const struct gas_look *look, int32_t i)
{
    return look->open && look->open[i] == 0.0;
}

/* Velocities and specific energies of the cells; closed ones get a density that can be
 * divided by. */
static void take_run(const struct gas_look *look, struct run *run)
{
    const double *const *u = look->u;
    const int32_t first = run->first;
    FOR_ROW (k, 0, run->count - 1) {
        const int32_t i = first + k - ROW_GHOSTS;
        run->density[k] = u[GAS_DENSITY][i];
        double kinetic = 0.0, fastest = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            const double v = u[GAS_MOMENTUM + axis][i] / u[GAS_DENSITY][i];
            run->velocity[axis][k] = v;
            kinetic += 0.5 * v * v;
            fastest = maximum(fastest, fabs(v));
        }
        run->energy[k] = u[GAS_ENERGY][i] / u[GAS_DENSITY][i] - kinetic;
        run->fastest[k] = fastest;
    }
    for (int k = 0; k < run->count && look->open; k++)
        if (is_closed(look, first + k)) {
            const int at = k + ROW_GHOSTS;
            run->density[at] = eos_reference_density(look->closure.eos);
            run->energy[at] = run->fastest[at] = 0.0;
            for (int axis = 0; axis < 3; axis++)
                run->velocity[axis][at] = 0.0;
        }
}

/* What the store shows of the cells, whose edge is EDGE and whose volume is VOLUME, per radian that
 * of the plane. */
static void put_run(const struct gas_look *look, const struct run *run,
                    const struct row_values *values, double volume, double edge)
{
    const struct cell_blocks *cells = look->cells;
    for (int k = 0; k < run->count; k++) {
        const int32_t i = run->first + k;
        const int at = k + ROW_GHOSTS;
        const bool open = !is_closed(look, i);
        const double density = run->density[at],
                     sound = eos_sound_square(values->pressure[at], values->dp_drho[at],
                                              values->dp_de[at], density);
        for (int axis = 0; axis < 3; axis++)
            cells->velocity[i][axis] = run->velocity[axis][at];
        cells->energy[i] = run->energy[at];
        cells->mass[i] =
            open ? density * gas_cell_volume(volume, edge, cells->position[i][0], look->round)
                 : 0.0;
        cells->pressure[i] = open ? values->pressure[at] : 0.0;
        look->sound[i] = open ? sqrt(sound) : 0.0;
        if (look->closure.other)
            cells->material[i] = look->material[look->u[GAS_FRACTION][i] > 0.5];
    }
}

static void find_fastest(const struct gas_look *look, const struct run *run,
                         struct gas_fastest *fastest)
{
    for (int k = 0; k < run->count; k++) {
        const int32_t i = run->first + k;
        if (is_closed(look, i))
            continue;
        const double speed = run->density[k + ROW_GHOSTS] > 0.0
                                 ? run->fastest[k + ROW_GHOSTS] + look->sound[i]
                                 : (double)NAN;
        if (!(speed <= fastest->speed) && !isnan(fastest->speed)) {
            fastest->speed = speed;
            fastest->cell = i;
        }
    }
}

/* Whether the cells FIRST .. END - 1 are open and hold one gas at rest. */
static bool is_still(const struct gas_look *look, int32_t first, int32_t end)
{
    bool still = !look->layout->afterburns || look->u[GAS_FRACTION][first] == 0.0;
    for (int32_t i = first; i < end && look->open; i++)
        still &= !is_closed(look, i);
    for (int n = 0; n < GAS_NUMBERS && still; n++) {
        const bool rests = n >= GAS_MOMENTUM && n < GAS_ENERGY;
        const double *u = look->u[n], value = rests ? 0.0 : u[first];
        for (int32_t i = first; i < end; i++)
            still &= u[i] == value;
    }
    for (int n = GAS_SHOCK; n < look->layout->written && still; n++) {
        const double *u = look->u[n], value = n == GAS_SHOCK ? 0.0 : u[first];
        for (int32_t i = first; i < end; i++)
            still &= u[i] == value;
    }
    return still;
}

ISA_KERNEL(struct gas_fastest, gas_look_at_block, const struct gas_look *look, int32_t b)
{
    const struct cell_block *block = &look->cells->block[b];
    const double h = cell_block_edge(look->cells, block);
    const double volume = look->cells->dimension == 1   ? h
                          : look->cells->dimension == 2 ? h * h
                                                        : h * h * h;
    const int32_t end = block->first + cell_block_cells(block);
    struct gas_fastest fastest = {-1.0, block->first, is_still(look, block->first, end)};
    struct row_values values;
    struct run run;
    for (run.first = block->first; run.first < end; run.first += run.count) {
        run.count = end - run.first < ROW_CELLS ? end - run.first : ROW_CELLS;
        take_run(look, &run);
        evaluate_run(look, &run, &values);
        put_run(look, &run, &values, volume, h);
        find_fastest(look, &run, &fastest);
    }
    fastest.speed /= (double)(1 << block->level);
    return fastest;
}
