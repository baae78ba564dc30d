/* Building neighbour rows; see neighbours.h. A row entry is put together as one 64-bit word, part (2 bits) | rank
 * of (id, image) (32) | record (30), so that sorting a row is sorting words. */
#include "particle/neighbours.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "particle/cells.h"
#include "particle/neighbours_hold.h"

/* Images are planned this far from a wall, in supports of the largest reach, so that the plan outlives
 * the rows of most runs. */
static const double plan_margin = 1.5;

/* What a build needs for a while. */
struct build {
    struct neighbours *n;
    const struct particles *p;
    struct reach reach;
    const struct mirrors *mirrors;
    const struct contact_groups *groups;
    struct cell_point *point; /* owned, then ghosts */
    struct cells cells;
};

/* The points around one cell, and room for one row. */
struct workspace {
    const struct cell_point **run;
    int32_t *length;
    int64_t runs, run_capacity, length_capacity;
    uint64_t *word, *scratch;
    int64_t word_capacity, scratch_capacity;
    bool failed;
};

static struct error *out_of_memory(const struct particles *p)
{
    return error_new(ERROR_SYSTEM, "out of memory for the neighbours of %d particles", p->count);
}

static double largest_reach(const struct particles *p, struct reach reach)
{
    double largest = 0.0;
    for (int32_t i = 0; i < p->count; i++)
        largest = maximum(largest, reach.smoothing * reach.diameter[i]);
    return largest;
}

static uint16_t group_of(const struct build *b, uint16_t body)
{
    return b->groups->groups > 1 ? b->groups->of_body[body] : 0;
}

static void place_points(struct build *b)
{
    const struct particles *p = b->p;
    const struct ghosts *ghosts = &b->n->ghosts;
    for (int32_t i = 0; i < p->count; i++) {
        const double *x = p->position[i];
        double own = (1.0 + b->n->skin) * b->reach.smoothing * b->reach.diameter[i];
        b->point[i] = (struct cell_point){x[0], x[1], x[2], own, 0, group_of(b, p->body[i])};
    }
    for (int32_t g = 0; g < ghosts->count; g++) {
        struct cell_point point = b->point[ghosts->source[g]];
        struct vec3 x =
            image_position(b->mirrors, ghosts->image[g], vec3_make(point.x, point.y, point.z));
        point.x = x.x;
        point.y = x.y;
        point.z = x.z;
        b->point[p->count + g] = point;
    }
}

/* Ranks all points by id, then image, and puts their words together. */
static struct error *rank_points(struct build *b, int32_t count)
{
    struct keyed *entry = memory_allocate((size_t)count * sizeof *entry);
    struct keyed *scratch = memory_allocate((size_t)count * sizeof *scratch);
    if (entry && scratch) {
        const struct ghosts *ghosts = &b->n->ghosts;
        int32_t owned = b->p->count;
        for (int32_t i = 0; i < count; i++)
            entry[i] = (struct keyed){i < owned ? 0 : ghosts->image[i - owned], i};
        radix_sort(entry, scratch, count);
        for (int32_t k = 0; k < count; k++) {
            int32_t i = entry[k].index;
            entry[k].key = b->p->id[i < owned ? i : ghosts->source[i - owned]];
        }
        radix_sort(entry, scratch, count);
        for (int32_t k = 0; k < count; k++)
            b->point[entry[k].index].word =
                (uint64_t)(entry[k].index < owned ? 0 : PART_IMAGE) << 62 |
                (uint64_t)k << ENTRY_PART_SHIFT | (uint64_t)entry[k].index;
    }
    bool done = entry && scratch;
    free(entry);
    free(scratch);
    return done ? NULL : out_of_memory(b->p);
}

static void collect_run(void *context, const struct cell_point *point, int32_t count)
{
    struct workspace *w = context;
    if (!memory_reserve((void **)&w->run, &w->run_capacity, w->runs + 1, w->runs, sizeof *w->run) ||
        !memory_reserve((void **)&w->length, &w->length_capacity, w->runs + 1, w->runs,
                        sizeof *w->length)) {
        w->failed = true;
        return;
    }
    w->run[w->runs] = point;
    w->length[w->runs++] = count;
}

static bool workspace_reserve_words(struct workspace *w, int64_t count)
{
    return memory_reserve((void **)&w->word, &w->word_capacity, count, 0, sizeof *w->word) &&
           memory_reserve((void **)&w->scratch, &w->scratch_capacity, count, 0, sizeof *w->scratch);
}

/* Sorts COUNT words: runs of eight by insertion, then merges; rows are short. */
static void sort_words(uint64_t *word, uint64_t *scratch, int64_t count)
{
    for (int64_t begin = 0; begin < count; begin += 8) {
        int64_t end = begin + 8 < count ? begin + 8 : count;
        for (int64_t i = begin + 1; i < end; i++) {
            uint64_t moving = word[i];
            int64_t k = i;
            for (; k > begin && word[k - 1] > moving; k--)
                word[k] = word[k - 1];
            word[k] = moving;
        }
    }
    uint64_t *from = word, *to = scratch;
    for (int64_t width = 8; width < count; width *= 2) {
        for (int64_t begin = 0; begin < count; begin += 2 * width) {
            int64_t middle = begin + width < count ? begin + width : count;
            int64_t end = begin + 2 * width < count ? begin + 2 * width : count;
            int64_t left = begin, right = middle;
            for (int64_t k = begin; k < end; k++) {
                bool take_left = right == end || (left < middle && from[left] < from[right]);
                to[k] = take_left ? from[left] : from[right];
                left += take_left;
                right += !take_left;
            }
        }
        uint64_t *swap = from;
        from = to;
        to = swap;
    }
    if (from != word)
        memcpy(word, from, (size_t)count * sizeof *word);
}

/* Finds the neighbours of one owned point among the runs; returns how many words were written. Every candidate
 * is written and the next one overwrites it unless it counts: no branch to mispredict. */
BOLIDE_INLINE int64_t find_row_with(const struct workspace *w, const struct cell_point *own,
                                    bool with_law, const uint8_t *law)
{
    uint64_t *word = w->word;
    for (int64_t r = 0; r < w->runs; r++) {
        const struct cell_point *other = w->run[r], *end = other + w->length[r];
        for (; other < end; other++) {
            double dx = other->x - own->x, dy = other->y - own->y, dz = other->z - own->z;
            double range = own->reach + other->reach;
            *word = other->word;
            if (with_law)
                *word |= (uint64_t)(law[other->group] != 0) << 62;
            word += dx * dx + dy * dy + dz * dz < range * range && other != own;
        }
    }
    return word - w->word;
}

static int64_t find_row(const struct build *b, const struct workspace *w,
                        const struct cell_point *own)
{
    size_t groups = (size_t)b->groups->groups;
    return groups > 1 ? find_row_with(w, own, true, b->groups->law + own->group * groups)
                      : find_row_with(w, own, false, NULL);
}

/* realloc moves the pages of a large array instead of copying them: rows are the largest array of a run. */
static bool segment_reserve(struct segment *segment, int64_t needed)
{
    if (needed <= segment->capacity)
        return true;
    int64_t wanted = segment->capacity + segment->capacity / 4;
    wanted = wanted < needed ? needed + 1024 : wanted;
    uint32_t *grown = realloc(segment->entry, (size_t)wanted * sizeof *grown);
    if (!grown)
        return false;
    segment->entry = grown;
    segment->capacity = wanted;
    return true;
}

static bool store_row(struct neighbours *n, int thread, int32_t i, const uint64_t *word,
                      int64_t count)
{
    struct segment *segment = &n->segment[thread];
    if (!segment_reserve(segment, segment->count + count))
        return false;
    uint32_t *entry = segment->entry + segment->count;
    for (int64_t k = 0; k < count; k++)
        entry[k] =
            (uint32_t)(word[k] >> 62) << ENTRY_PART_SHIFT | (uint32_t)(word[k] & ENTRY_INDEX);
    n->row[i] = (struct row){(uint32_t)segment->count, (uint16_t)(segment->count >> 32),
                             (uint16_t)thread, (uint32_t)count};
    segment->count += count;
    return true;
}

static int32_t index_of(const struct cell_point *point)
{
    return (int32_t)(point->word & ENTRY_INDEX);
}

/* Rows of the owned points of one cell. */
static bool build_cell(struct build *b, struct workspace *w, int thread, int32_t cell)
{
    const struct cell *c = &b->cells.cell[cell];
    const struct cell_point *own = b->cells.point + c->first;
    bool any = false;
    for (int32_t k = 0; k < c->count; k++)
        any |= index_of(&own[k]) < b->p->count;
    if (!any)
        return true;
    w->runs = 0;
    cells_around(&b->cells, cell, collect_run, w);
    int64_t candidates = 0;
    for (int64_t r = 0; r < w->runs; r++)
        candidates += w->length[r];
    if (w->failed || !workspace_reserve_words(w, candidates + 1))
        return false;
    for (int32_t k = 0; k < c->count; k++, own++) {
        if (index_of(own) >= b->p->count)
            continue;
        int64_t count = find_row(b, w, own);
        sort_words(w->word, w->scratch, count);
        if (!store_row(b->n, thread, index_of(own), w->word, count))
            return false;
    }
    return true;
}

static void workspace_free(struct workspace *w)
{
    free(w->run);
    free(w->length);
    free(w->word);
    free(w->scratch);
}

static struct error *build_rows(struct build *b, int threads)
{
    bool failed = false;
    for (int t = 0; t < b->n->segments; t++)
        b->n->segment[t].count = 0;
#pragma omp parallel num_threads(threads) reduction(|| : failed)
    {
        struct workspace w = {0};
#pragma omp for schedule(dynamic, 16)
        for (int32_t cell = 0; cell < b->cells.count; cell++)
            if (!failed)
                failed = !build_cell(b, &w, omp_get_thread_num(), cell);
        workspace_free(&w);
    }
    return failed ? out_of_memory(b->p) : NULL;
}

static struct error *reserve(struct neighbours *n, const struct particles *p, int threads)
{
    if (n->segments < threads) {
        struct segment *segment = memory_allocate((size_t)threads * sizeof *segment);
        if (!segment)
            return out_of_memory(p);
        if (n->segments)
            memcpy(segment, n->segment, (size_t)n->segments * sizeof *segment);
        free(n->segment);
        n->segment = segment;
        n->segments = threads;
    }
    if (!memory_reserve((void **)&n->row, &n->row_capacity, p->count, 0, sizeof *n->row))
        return out_of_memory(p);
    n->count = p->count;
    return NULL;
}

static struct error *build_with(struct build *b, int threads)
{
    struct neighbours *n = b->n;
    int32_t count = b->p->count + n->ghosts.count;
    if ((uint32_t)count >= ENTRY_INDEX)
        return error_new(ERROR_INPUT, "%d particles and images are too many for one rank", count);
    b->point = memory_allocate((size_t)count * sizeof *b->point);
    if (!b->point)
        return out_of_memory(b->p);
    place_points(b);
    TRY(rank_points(b, count));
    TRY(cells_make(&b->cells, b->p->dimension, b->p->cell, b->point, count));
    free(b->point); /* the cells have them now */
    b->point = NULL;
    return build_rows(b, threads);
}

struct error *neighbours_build(struct neighbours *neighbours, const struct particles *particles,
                               struct reach reach, const struct mirrors *mirrors,
                               const struct contact_groups *groups, int threads)
{
    TRY(reserve(neighbours, particles, threads));
    double distance =
        plan_margin * 2.0 * (1.0 + neighbours->skin) * largest_reach(particles, reach);
    TRY(ghosts_plan(mirrors, particles->dimension, particles->count,
                    (const double(*)[3])particles->position, distance, &neighbours->ghosts));
    struct build build = {
        .n = neighbours, .p = particles, .reach = reach, .mirrors = mirrors, .groups = groups};
    struct error *error = build_with(&build, threads);
    free(build.point);
    cells_free(&build.cells);
    TRY(error);
    neighbours->builds++;
    return motion_start(neighbours, particles, reach, mirrors, distance, threads);
}

void neighbours_free(struct neighbours *neighbours)
{
    for (int t = 0; t < neighbours->segments; t++)
        free(neighbours->segment[t].entry);
    free(neighbours->segment);
    free(neighbours->row);
    ghosts_free(&neighbours->ghosts);
    motion_free(neighbours);
    *neighbours = (struct neighbours){0};
}

size_t neighbours_bytes(const struct neighbours *n)
{
    size_t bytes = (size_t)n->row_capacity * sizeof *n->row +
                   (size_t)n->reference_capacity * 4 * sizeof(double) +
                   (size_t)n->ghosts.capacity * (sizeof *n->ghosts.source + 1);
    for (int t = 0; t < n->segments; t++)
        bytes += (size_t)n->segment[t].capacity * sizeof *n->segment[t].entry;
    return bytes;
}
