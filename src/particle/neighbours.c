/* Building neighbour rows; see neighbours.h. A row is ordered by keys, part (2 bits) | rank of (id,
 * image) (30), and keeps entries, part | record. */
#include "particle/neighbours.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/periodic.h"
#include "particle/block_motion.h"
#include "particle/cells.h"
#include "particle/halo.h"
#include "particle/row_kernel.h"

/* Images are planned this far from a wall, in supports of the largest reach, so that the plan
 * outlives the rows of most runs. */
static const double plan_margin = 1.5;

/* What a build needs for a while. */
struct build {
    struct neighbours *n;
    struct particles *p; /* only its scratch changes */
    struct reach reach;
    const struct mirrors *mirrors;
    const struct contact_groups *groups;
    bool walled[IMAGE_CODES]; /* the image is behind a wall, not behind periodic faces alone */
    uint32_t *rank;           /* by (id, image), of owned particles, then of ghosts */
    struct cells cells;
};

/* The points around one cell, and room for one row. */
struct workspace {
    struct candidates near;
    uint16_t *body;                    /* of each */
    uint32_t *plain_key, *plain_entry; /* without the part of a contact law */
    uint32_t *key, *entry, *row;       /* kept of them */
    int64_t capacity;
    bool failed;
    struct segment segment; /* a copy: those of the threads lie in one line of the cache */
};

static struct error *no_room(const struct particles *p)
{
    return out_of_memory_for("the neighbours of %d particles", p->count);
}

static double largest_reach(const struct particles *p, struct reach reach, int threads)
{
    double largest = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : largest)
    for (int32_t i = 0; i < p->count; i++)
        largest = maximum(largest, reach.smoothing * reach.diameter[i]);
    return ranks_maximum(p->ranks, largest);
}

static bool is_image(const struct build *b, int32_t i)
{
    return i >= b->p->count + b->n->ghosts.remotes;
}

/* A cells_point: owned particle or ghost I. */
static struct cell_point point_of(const void *context, int32_t i)
{
    const struct build *b = context;
    const struct particles *p = b->p;
    const struct ghosts *ghosts = &b->n->ghosts;
    const int32_t from = is_image(b, i) ? ghosts->source[i - p->count] : i;
    const struct remote *remote = from < p->count ? NULL : &ghosts->remote[from - p->count];
    const double *place = remote ? remote->place : p->position[from];
    const double reach = remote ? remote->reach : b->reach.smoothing * b->reach.diameter[from];
    struct vec3 x = vec3_make(place[0], place[1], place[2]);
    if (is_image(b, i))
        x = image_position(b->mirrors, ghosts->image[i - p->count], x);
    const bool pushes = is_image(b, i) && b->walled[ghosts->image[i - p->count]];
    const uint32_t part = (uint32_t)(pushes ? PART_IMAGE : 0) << ENTRY_PART_SHIFT;
    return (struct cell_point){x.x,
                               x.y,
                               x.z,
                               (1.0 + b->n->skin) * reach,
                               part | b->rank[i],
                               part | (uint32_t)i,
                               remote ? remote->body : p->body[from]};
}

static uint64_t id_of(const struct build *b, int32_t i)
{
    const struct ghosts *ghosts = &b->n->ghosts;
    int32_t owned = b->p->count, source = i < owned ? i : ghosts->source[i - owned];
    return source < owned ? b->p->id[source] : ghosts->remote[source - owned].id;
}

/* Ranks all COUNT points by id, then image. */
static void rank_points(struct build *b, struct keyed *entry, struct keyed *spare, int32_t count,
                        int threads)
{
    const struct ghosts *ghosts = &b->n->ghosts;
    const int32_t owned = b->p->count;
    uint64_t order[IMAGE_CODES];
    for (int image = 0; image < IMAGE_CODES; image++)
        order[image] = (uint64_t)image_order(b->mirrors, (image_code)image);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t i = 0; i < count; i++)
        entry[i] = (struct keyed){order[i < owned ? 0 : ghosts->image[i - owned]], i};
    radix_sort(entry, spare, count, threads);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t k = 0; k < count; k++)
        entry[k].key = id_of(b, entry[k].index);
    radix_sort(entry, spare, count, threads);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t k = 0; k < count; k++)
        b->rank[entry[k].index] = (uint32_t)k;
}

/* Ranks the points, and puts them into cells, which take the room of the ranking. */
static struct error *make_cells(struct build *b, int32_t count, int threads)
{
    struct scratch *scratch = &b->p->scratch;
    const size_t ranks = (size_t)count * sizeof *b->rank;
    if (!scratch_begin(scratch, ranks + cells_bytes(count)))
        return no_room(b->p);
    b->rank = scratch_part(scratch, ranks);
    const size_t used = scratch->used;
    struct keyed *entry = scratch_part(scratch, (size_t)count * sizeof *entry);
    struct keyed *spare = scratch_part(scratch, (size_t)count * sizeof *spare);
    rank_points(b, entry, spare, count, threads);
    scratch->used = used;
    const struct cell_points points = {point_of, b, count};
    cells_make(&b->cells, b->p->dimension, b->p->cell, points, scratch, threads);
    return NULL;
}

static bool workspace_reserve(struct workspace *w, int64_t needed, int64_t kept)
{
    const struct {
        void *array;
        size_t element;
    } of[] = {{&w->near.x, sizeof *w->near.x},
              {&w->near.y, sizeof *w->near.y},
              {&w->near.z, sizeof *w->near.z},
              {&w->near.reach, sizeof *w->near.reach},
              {&w->near.key, sizeof *w->near.key},
              {&w->near.entry, sizeof *w->near.entry},
              {&w->body, sizeof *w->body},
              {&w->plain_key, sizeof *w->plain_key},
              {&w->plain_entry, sizeof *w->plain_entry},
              {&w->key, sizeof *w->key},
              {&w->entry, sizeof *w->entry},
              {&w->row, sizeof *w->row}};
    int64_t capacity = w->capacity;
    for (size_t k = 0; k < COUNT_OF(of); k++) {
        capacity = w->capacity;
        if (!memory_reserve(of[k].array, &capacity, needed, kept, of[k].element))
            return false;
    }
    w->capacity = capacity;
    return true;
}

static void collect_run(void *context, const struct cell_point *point, int32_t count)
{
    struct workspace *w = context;
    struct candidates *near = &w->near;
    if (w->failed || !workspace_reserve(w, near->count + count + CANDIDATES_STEP, near->count)) {
        w->failed = true;
        return;
    }
    for (int32_t k = 0, to = near->count; k < count; k++, to++) {
        near->x[to] = point[k].x;
        near->y[to] = point[k].y;
        near->z[to] = point[k].z;
        near->reach[to] = point[k].reach;
        w->body[to] = point[k].body;
        w->plain_key[to] = near->key[to] = point[k].key;
        w->plain_entry[to] = near->entry[to] = point[k].entry;
    }
    near->count += count;
}

static bool tells_apart(const struct contact_groups *groups)
{
    return groups->groups > 1 || groups->cluster;
}

/* What a contact law between two bodies, or that they started apart, puts into keys and entries. */
static uint32_t law_part(const struct contact_groups *groups, uint16_t body, uint16_t other)
{
    bool law = groups->cluster && groups->cluster[body] != groups->cluster[other];
    if (groups->groups > 1)
        law |= groups->law[(size_t)groups->of_body[body] * (size_t)groups->groups +
                           groups->of_body[other]] != 0;
    return (uint32_t)(law ? PART_LAW : 0) << ENTRY_PART_SHIFT;
}

/* Marks those that points of BODY meet under a law of their own. */
static void mark_laws(const struct contact_groups *groups, struct workspace *w, uint16_t body)
{
    for (int32_t k = 0; k < w->near.count; k++) {
        uint32_t part = law_part(groups, body, w->body[k]);
        w->near.key[k] = w->plain_key[k] | part;
        w->near.entry[k] = w->plain_entry[k] | part;
    }
}

/* realloc moves the pages of a large array instead of copying them: rows are the largest array of a
 * run. */
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

static bool store_row(struct row *at, struct segment *segment, int thread, const uint32_t *row,
                      int32_t count)
{
    if (!segment_reserve(segment, segment->count + count))
        return false;
    if (count > 0) /* else there may be no room yet */
        memcpy(segment->entry + segment->count, row, (size_t)count * sizeof *row);
    *at = (struct row){(uint32_t)segment->count, (uint16_t)(segment->count >> 32), (uint16_t)thread,
                       (uint32_t)count};
    segment->count += count;
    return true;
}

static int32_t index_of(const struct cell_point *point)
{
    return (int32_t)(point->entry & ENTRY_INDEX);
}

/* Rows of the owned points of one cell. */
static bool build_cell(struct build *b, struct workspace *w, int thread, int32_t cell)
{
    const struct key_run *c = &b->cells.cell[cell];
    const struct cell_point *own = b->cells.point + c->first;
    bool any = false;
    for (int32_t k = 0; k < c->count; k++)
        any |= index_of(&own[k]) < b->p->count;
    if (!any)
        return true;
    w->near.count = 0;
    cells_around(&b->cells, cell, collect_run, w);
    if (w->failed)
        return false;
    int marked = -1; /* the body that laws are marked for */
    for (int32_t k = 0; k < c->count; k++, own++) {
        if (index_of(own) >= b->p->count)
            continue;
        if (tells_apart(b->groups) && own->body != marked)
            mark_laws(b->groups, w, (uint16_t)(marked = own->body));
        const struct row_point point = {own->x, own->y, own->z, own->reach,
                                        own->key | law_part(b->groups, own->body, own->body)};
        int32_t count = row_find(&w->near, &point, w->key, w->entry, w->row);
        if (!store_row(&b->n->row[index_of(own)], &w->segment, thread, w->row, count))
            return false;
    }
    return true;
}

static void workspace_free(struct workspace *w)
{
    void *const arrays[] = {w->near.x,      w->near.y,     w->near.z, w->near.reach,
                            w->near.key,    w->near.entry, w->body,   w->plain_key,
                            w->plain_entry, w->key,        w->entry,  w->row};
    for (size_t k = 0; k < COUNT_OF(arrays); k++)
        free(arrays[k]);
}

static struct error *build_rows(struct build *b, int threads)
{
    bool failed = false;
    for (int t = 0; t < b->n->segments; t++)
        b->n->segment[t].count = 0;
#pragma omp parallel num_threads(threads) reduction(|| : failed)
    {
        const int thread = omp_get_thread_num();
        struct workspace w = {.segment = b->n->segment[thread]};
#pragma omp for schedule(dynamic, 16)
        for (int32_t cell = 0; cell < b->cells.count; cell++)
            if (!failed)
                failed = !build_cell(b, &w, thread, cell);
        b->n->segment[thread] = w.segment;
        workspace_free(&w);
    }
    return failed ? no_room(b->p) : NULL;
}

static struct error *reserve(struct neighbours *n, const struct particles *p, int threads)
{
    if (n->segments < threads) {
        struct segment *segment = memory_allocate((size_t)threads * sizeof *segment);
        if (!segment)
            return no_room(p);
        if (n->segments)
            memcpy(segment, n->segment, (size_t)n->segments * sizeof *segment);
        free(n->segment);
        n->segment = segment;
        n->segments = threads;
    }
    if (!memory_reserve((void **)&n->row, &n->row_capacity, p->count, 0, sizeof *n->row))
        return no_room(p);
    if (p->ranks->joined &&
        !memory_reserve((void **)&n->outer, &n->outer_capacity, p->blocks, 0, 1))
        return no_room(p);
    n->count = p->count;
    return NULL;
}

/* Which blocks must wait for other ranks. */
static void find_outer(struct neighbours *n, const struct particles *p, int threads)
{
    const uint32_t owned = (uint32_t)p->count, first_image = owned + (uint32_t)n->ghosts.remotes,
                   far_image = owned + (uint32_t)n->ghosts.early;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t b = 0; b < p->blocks; b++) {
        bool outer = false;
        int32_t end = p->block[b].first + p->block[b].count;
        for (int32_t i = p->block[b].first; i < end && !outer; i++) {
            const uint32_t *entry = neighbours_row(n, i);
            for (uint32_t k = 0; k < n->row[i].count; k++) {
                uint32_t j = entry[k] & ENTRY_INDEX;
                outer |= j >= owned && (j < first_image || j >= far_image);
            }
        }
        n->outer[b] = outer;
    }
}

static void find_walled(struct build *b)
{
    for (int image = 0; image < IMAGE_CODES; image++)
        for (int axis = 0; axis < 3; axis++)
            b->walled[image] |=
                image_along((image_code)image, axis) && !images_repeat(b->mirrors, axis);
}

static struct error *build_with(struct build *b, int threads)
{
    struct neighbours *n = b->n;
    int32_t count = b->p->count + n->ghosts.count;
    if ((uint32_t)count >= ENTRY_INDEX)
        return error_new(ERROR_INPUT, "%d particles and images are too many for one rank", count);
    TRY(make_cells(b, count, threads));
    TRY(build_rows(b, threads));
    if (b->p->ranks->joined)
        find_outer(n, b->p, threads);
    return NULL;
}

/* The images of a particle lie one period away: neighbours may not. */
static struct error *check_periods(const struct mirrors *mirrors, double support)
{
    for (int axis = 0; axis < 3; axis++)
        if (images_repeat(mirrors, axis) && support >= periodic_period(mirrors, axis))
            return error_new(ERROR_STATE,
                             "the supports of particles have grown to %.4g m, skin included: the "
                             "period along %c is %.4g m",
                             support, "xyz"[axis], periodic_period(mirrors, axis));
    return NULL;
}

struct error *neighbours_build(struct neighbours *neighbours, struct particles *particles,
                               struct reach reach, const struct mirrors *mirrors,
                               const struct contact_groups *groups, int threads)
{
    TRY(ranks_agree(particles->ranks, reserve(neighbours, particles, threads)));
    const double support =
        2.0 * (1.0 + neighbours->skin) * largest_reach(particles, reach, threads);
    const struct near_walls walls = {mirrors, particles->dimension, plan_margin * support};
    struct halo halo;
    TRY(check_periods(mirrors, support));
    TRY(halo_plan(particles, mirrors, reach, neighbours->skin, &neighbours->ghosts, &halo));
    struct error *error =
        ghosts_plan(walls, particles->count, (const double(*)[3])particles->position, threads,
                    &neighbours->ghosts);
    struct build build = {
        .n = neighbours, .p = particles, .reach = reach, .mirrors = mirrors, .groups = groups};
    find_walled(&build);
    if (!error)
        error = build_with(&build, threads);
    error = ranks_agree(particles->ranks, error);
    if (!error)
        error = motion_start(neighbours, particles, reach, walls, &halo, threads);
    halo_free(&halo);
    neighbours->builds++;
    return error;
}

void neighbours_free(struct neighbours *neighbours)
{
    for (int t = 0; t < neighbours->segments; t++)
        free(neighbours->segment[t].entry);
    free(neighbours->segment);
    free(neighbours->row);
    free(neighbours->outer);
    ghosts_free(&neighbours->ghosts);
    motion_free(neighbours);
    *neighbours = (struct neighbours){0};
}

size_t neighbours_bytes(const struct neighbours *n)
{
    size_t bytes =
        (size_t)n->row_capacity * sizeof *n->row +
        (size_t)n->near_row_capacity * sizeof *n->near_row +
        (size_t)n->near_capacity * sizeof *n->near_entry +
        (size_t)(n->reference_capacity + n->near_reference_capacity) * 4 * sizeof(double) +
        (size_t)n->ghosts.capacity * (sizeof *n->ghosts.source + 1);
    for (int t = 0; t < n->segments; t++)
        bytes += (size_t)n->segment[t].capacity * sizeof *n->segment[t].entry;
    return bytes;
}
