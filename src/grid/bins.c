/* Particles into blocks and cells; see bins.h. Most still lie in the block they are stored in, and
 * their cell there is all that must be found. The others, strays, are few and go by a hash table of
 * blocks. */
#include "grid/bins.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "grid/cell_kernel.h"

struct stray {
    int32_t candidate, index;
    uint8_t cell;
};

/* A block that may have particles of a group: one of storage, or one that strays have come to.
 * Those of a block stand side by side, one a group. */
struct candidate {
    uint64_t key;
    int32_t block; /* of storage, -1: none */
    int32_t group;
    int32_t locals,
        leaving; /* stored there and lying there; of the block, lying elsewhere (in its first) */
    int32_t first, strays; /* that have come, once they are sorted */
};

static struct error *no_room(const struct binned *p)
{
    return out_of_memory_for("the cells of %d particles", p->count);
}

int64_t bins_reach(int dimension)
{
    return (int64_t)block_cells(dimension) * (BLOCK_MIDDLE - 2) - 1;
}

/* The index of the cell along AXIS. */
static inline int64_t cell_along(const struct binned *p, int axis, double x)
{
    int64_t index = cell_index(x + p->shift, p->edge, bins_reach(p->dimension) + 1);
    index = index < p->low[axis] ? p->low[axis] : index;
    return index > p->high[axis] ? p->high[axis] : index;
}

static inline int group_of(const struct binned *p, int32_t i)
{
    return p->groups > 1 ? p->group_of_body[p->body[i]] : 0;
}

/* Where the particles of storage block B lie. */
static void find_cells(struct bins *bins, const struct binned *p, const struct cell_loop *loop,
                       int32_t b)
{
    const struct block *block = &p->block[b];
    const int32_t end = block->first + block->count;
    struct candidate *candidate = &bins->candidate[(int64_t)b * p->groups];
    int64_t at[3];
    double corner[3];
    block_coordinates(block->key, at);
    for (int axis = 0; axis < 3; axis++)
        corner[axis] = (double)(at[axis] * block_cells(p->dimension));
    cell_loop_run(loop, corner, block->first, end, bins->cell);
    int32_t leaving = 0;
    for (int32_t i = block->first; i < end; i++)
        leaving += bins->cell[i] == CELL_ELSEWHERE;
    for (int g = 0; g < p->groups; g++)
        candidate[g] = (struct candidate){block->key, b, g, 0, 0, 0, 0};
    candidate->leaving = leaving;
    if (p->groups == 1)
        candidate->locals = block->count - leaving;
    else
        for (int32_t i = block->first; i < end; i++)
            candidate[group_of(p, i)].locals += bins->cell[i] != CELL_ELSEWHERE;
}

/* How many particles have left the cell that they were stored by. */
static int64_t count_moved(struct bins *bins, const struct binned *p, int threads)
{
    int64_t moved = 0;
    if (bins->order != p->order) {
        bins->order = p->order;
        if (p->count > 0)
            memcpy(bins->home, bins->cell, (size_t)p->count);
        return 0;
    }
#pragma omp parallel for schedule(static) num_threads(threads) reduction(+ : moved)
    for (int32_t i = 0; i < p->count; i++)
        moved += bins->cell[i] != bins->home[i];
    return moved;
}

/* The block and cell of a particle that is not where it is stored. */
static struct error *place_stray(struct bins *bins, const struct binned *p, int32_t i,
                                 struct stray *stray)
{
    const int64_t cells = block_cells(p->dimension), limit = bins_reach(p->dimension);
    int64_t at[3] = {0, 0, 0}, cell = 0;
    for (int axis = 0; axis < p->dimension; axis++) {
        int64_t index = cell_along(p, axis, p->position[i][axis]);
        if (!(index > -limit) || index >= limit)
            return error_new(ERROR_STATE,
                             "particle %llu at (%.6g, %.6g, %.6g) m is beyond the grid: with cells "
                             "of %.6g m it reaches %.6g m from zero",
                             (unsigned long long)p->id[i], p->position[i][0], p->position[i][1],
                             p->position[i][2], p->edge, p->edge * (double)limit);
        at[axis] = block_of_cell(index, cells);
        cell = cell * cells + index - at[axis] * cells;
    }
    const int32_t block = block_table_add(&bins->table, block_key(at));
    *stray = (struct stray){block * p->groups + group_of(p, i), i, (uint8_t)cell};
    return NULL;
}

/* Finds the strays, and the candidates that they come to. */
static struct error *find_strays(struct bins *bins, const struct binned *p)
{
    int64_t strays = 0;
    for (int32_t b = 0; b < p->blocks; b++)
        strays += bins->candidate[(int64_t)b * p->groups].leaving;
    if (!memory_reserve((void **)&bins->stray, &bins->stray_capacity, strays, 0,
                        sizeof *bins->stray) ||
        !memory_reserve((void **)&bins->sorted, &bins->sorted_capacity, strays, 0,
                        sizeof *bins->sorted) ||
        !memory_reserve((void **)&bins->candidate, &bins->candidate_capacity,
                        (p->blocks + strays) * p->groups, (int64_t)p->blocks * p->groups,
                        sizeof *bins->candidate) ||
        !block_table_clear(&bins->table, p->blocks + strays))
        return no_room(p);
    bins->strays = 0;
    for (int32_t b = 0; b < p->blocks; b++)
        block_table_add(&bins->table, p->block[b].key);
    for (int32_t b = 0; b < p->blocks; b++) {
        const struct block *block = &p->block[b];
        if (!bins->candidate[(int64_t)b * p->groups].leaving)
            continue;
        for (int32_t i = block->first; i < block->first + block->count; i++)
            if (bins->cell[i] == CELL_ELSEWHERE)
                TRY(place_stray(bins, p, i, &bins->stray[bins->strays++]));
    }
    for (uint64_t slot = 0; slot < bins->table.slots && bins->table.count > p->blocks; slot++) {
        const struct block_slot *at = &bins->table.slot[slot];
        for (int g = 0; g < p->groups && at->number > p->blocks; g++)
            bins->candidate[(int64_t)(at->number - 1) * p->groups + g] =
                (struct candidate){at->key, -1, g, 0, 0, 0, 0};
    }
    return NULL;
}

/* Strays by the candidate that they have come to. */
static void sort_strays(struct bins *bins, int groups)
{
    int32_t before = 0;
    for (int32_t k = 0; k < bins->strays; k++)
        bins->candidate[bins->stray[k].candidate].strays++;
    for (int32_t c = 0; c < bins->table.count * groups; c++) {
        bins->candidate[c].first = before;
        before += bins->candidate[c].strays;
        bins->candidate[c].strays = 0;
    }
    for (int32_t k = 0; k < bins->strays; k++) {
        struct candidate *to = &bins->candidate[bins->stray[k].candidate];
        bins->sorted[to->first + to->strays++] = bins->stray[k];
    }
}

static int compare_candidates(const void *a, const void *b)
{
    const struct candidate *x = a, *y = b;
    if (x->group != y->group)
        return x->group < y->group ? -1 : 1;
    return x->key < y->key ? -1 : x->key > y->key;
}

/* Candidates that have particles, by group and key, become bins. */
static struct error *choose_bins(struct bins *bins, const struct binned *p)
{
    int32_t kept = 0, before = 0;
    for (int32_t c = 0; c < bins->table.count * p->groups; c++)
        if (bins->candidate[c].locals + bins->candidate[c].strays > 0)
            bins->candidate[kept++] = bins->candidate[c];
    if (kept > 1)
        qsort(bins->candidate, (size_t)kept, sizeof *bins->candidate, compare_candidates);
    if (!memory_reserve((void **)&bins->bin, &bins->bin_capacity, kept, 0, sizeof *bins->bin))
        return no_room(p);
    bins->count = kept;
    memset(bins->begin, 0, sizeof bins->begin);
    for (int32_t b = 0; b < kept; b++)
        for (int g = bins->candidate[b].group; g < BIN_GROUPS; g++)
            bins->begin[g + 1] = b + 1;
    for (int32_t b = 0; b < kept; b++) {
        bins->bin[b].key = bins->candidate[b].key;
        bins->bin[b].first = before;
        before += bins->candidate[b].locals + bins->candidate[b].strays;
    }
    return NULL;
}

/* Few, and nearly in order. */
static void order_by_id(int32_t *list, int32_t count, const uint64_t *id)
{
    for (int32_t i = 1; i < count; i++) {
        int32_t moving = list[i], k = i;
        while (k > 0 && id[list[k - 1]] > id[moving]) {
            list[k] = list[k - 1];
            k--;
        }
        list[k] = moving;
    }
}

static void fill_bin(struct bins *bins, const struct binned *p, int32_t b)
{
    const struct candidate *from = &bins->candidate[b];
    const struct stray *stray = bins->sorted + from->first;
    struct bin *bin = &bins->bin[b];
    int32_t *list = bins->list + bin->first, next[BLOCK_CELLS], begin = 0, end = 0;
    if (from->block >= 0) {
        begin = p->block[from->block].first;
        end = begin + p->block[from->block].count;
    }
    memset(bin->cell, 0, sizeof bin->cell);
    for (int32_t i = begin; i < end; i++)
        if (bins->cell[i] != CELL_ELSEWHERE && group_of(p, i) == from->group)
            bin->cell[bins->cell[i] + 1]++;
    for (int32_t k = 0; k < from->strays; k++)
        bin->cell[stray[k].cell + 1]++;
    for (int c = 0; c < BLOCK_CELLS; c++) {
        next[c] = bin->cell[c];
        bin->cell[c + 1] += bin->cell[c];
    }
    for (int32_t i = begin; i < end; i++)
        if (bins->cell[i] != CELL_ELSEWHERE && group_of(p, i) == from->group)
            list[next[bins->cell[i]]++] = i;
    for (int32_t k = 0; k < from->strays; k++)
        list[next[stray[k].cell]++] = stray[k].index;
    for (int c = 0; c < BLOCK_CELLS; c++)
        order_by_id(list + bin->cell[c], bin->cell[c + 1] - bin->cell[c], p->id);
}

/* Finds the cells of the particles of the storage blocks with a flag in AGAIN; NULL: of all. */
static void find_cells_of(struct bins *bins, const struct binned *p, const bool *again, int threads)
{
    struct cell_loop loop = {p->dimension, p->edge, p->shift, p->position, {0.0}, {0.0}};
    for (int axis = 0; axis < 3; axis++) {
        loop.low[axis] = (double)p->low[axis];
        loop.high[axis] = (double)p->high[axis];
    }
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t b = 0; b < p->blocks; b++)
        if (!again || again[b])
            find_cells(bins, p, &loop, b);
}

/* Room for the particles; what is known of KEPT of them stays. */
static struct error *reserve(struct bins *bins, const struct binned *p, int32_t kept)
{
    return memory_reserve((void **)&bins->list, &bins->list_capacity, p->count, 0,
                          sizeof *bins->list) &&
                   memory_reserve((void **)&bins->cell, &bins->cell_capacity, p->count, kept, 1) &&
                   memory_reserve((void **)&bins->home, &bins->home_capacity, p->count,
                                  bins->home_capacity, 1) &&
                   memory_reserve((void **)&bins->candidate, &bins->candidate_capacity,
                                  (int64_t)p->blocks * p->groups, 0, sizeof *bins->candidate)
               ? NULL
               : no_room(p);
}

struct error *bins_find(struct bins *bins, const struct binned *p, int threads)
{
    TRY(reserve(bins, p, 0));
    find_cells_of(bins, p, NULL, threads);
    bins->moved = count_moved(bins, p, threads);
    return find_strays(bins, p);
}

struct error *bins_find_again(struct bins *bins, const struct binned *p, const bool *again,
                              int32_t before, int threads)
{
    TRY(reserve(bins, p, before < p->count ? before : p->count));
    for (int32_t i = before; i < p->count; i++)
        bins->home[i] = 0;
    bins->order = p->order;
    find_cells_of(bins, p, again, threads);
    return find_strays(bins, p);
}

uint64_t bins_stray(const struct bins *bins, int32_t k, int32_t *index)
{
    *index = bins->stray[k].index;
    return bins->candidate[bins->stray[k].candidate].key;
}

bool bins_is_stray(const struct bins *bins, int32_t i) { return bins->cell[i] == CELL_ELSEWHERE; }

struct error *bins_fill(struct bins *bins, const struct binned *p, int threads)
{
    sort_strays(bins, p->groups);
    TRY(choose_bins(bins, p));
#pragma omp parallel for schedule(dynamic, 8) num_threads(threads)
    for (int32_t b = 0; b < bins->count; b++)
        fill_bin(bins, p, b);
    return NULL;
}

void bins_settle(struct bins *bins, uint64_t order, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t b = 0; b < bins->count; b++) {
        const struct bin *bin = &bins->bin[b];
        for (int c = 0; c < BLOCK_CELLS; c++)
            for (int32_t k = bin->first + bin->cell[c]; k < bin->first + bin->cell[c + 1]; k++) {
                bins->list[k] = k;
                bins->home[k] = (uint8_t)c;
            }
    }
    bins->moved = 0;
    bins->order = order;
}

void bins_free(struct bins *bins)
{
    free(bins->list);
    free(bins->bin);
    free(bins->cell);
    free(bins->home);
    free(bins->stray);
    free(bins->sorted);
    free(bins->candidate);
    block_table_free(&bins->table);
    *bins = (struct bins){0};
}
