/* The cells beyond the ends of blocks; see cell_halo.h. */
#include "grid/cell_halo.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "grid/levels.h"
#include "parallel/block.h"

/* A plane that this rank needs: of the block with KEY, at place AT along the axis; who asks. */
struct wanted {
    uint64_t key;
    int32_t at, rank;
};

/* A plan in the making. Sources of other ranks name what is wanted, in the order in which it was
 * found. */
struct planning {
    struct cell_halo *halo;
    const struct cell_blocks *cells;
    int axis;
    struct wanted *wanted;
    struct send_item *owner;
    int32_t count;
    int64_t wanted_capacity, owner_capacity;
    bool failed;
};

/* A place along the axis outside the domain, in cells of a level, taken into it; FILLED where a
 * face does not say how, and INSTEAD is not to be used for it. */
struct axis_place {
    int64_t at;
    bool turned, filled;
};

static struct axis_place place_inside(const struct planning *p, int level, int64_t at,
                                      const enum cell_face *instead)
{
    const int64_t low = cell_domain_end(p->cells, level, p->axis, 0),
                  high = cell_domain_end(p->cells, level, p->axis, 1);
    struct axis_place place = {at, false, false};
    while (place.at < low || place.at >= high) {
        const int side = place.at >= high;
        enum cell_face face = p->halo->face[p->axis][side];
        if (face == CELL_FACE_FILLED && !instead) {
            place.filled = true;
            return place;
        }
        face = face == CELL_FACE_FILLED ? *instead : face;
        if (face == CELL_FACE_COPIES)
            place.at = side ? high - 1 : low;
        else if (face == CELL_FACE_MIRROR) {
            place.at = (side ? 2 * high : 2 * low) - 1 - place.at;
            place.turned = !place.turned;
        } else
            place.at += side ? low - high : high - low;
    }
    return place;
}

/* The cells at PLACE beside block B are of another level. */
static struct cell_source join(struct planning *p, const struct cell_block *b,
                               struct axis_place place)
{
    struct cell_halo_axis *axis = &p->halo->axis[p->axis];
    if (!memory_reserve((void **)&axis->seam, &axis->seam_capacity, axis->seams + 1, axis->seams,
                        sizeof *axis->seam)) {
        p->failed = true;
        return (struct cell_source){0};
    }
    axis->seam[axis->seams] =
        (struct cell_seam){.block = (int32_t)(b - p->cells->block), .at = place.at};
    return (struct cell_source){-3, axis->seams++, place.turned};
}

/* The cell of the domain at PLACE along the axis, beside block B. */
static struct cell_source source_of(struct planning *p, const struct cell_block *b,
                                    struct axis_place place)
{
    int64_t at[3] = {b->corner[0], b->corner[1], b->corner[2]};
    at[p->axis] = place.at;
    const uint64_t key = cell_block_key(p->cells->dimension, b->level, at);
    const struct cell_block *own = cell_block_at(p->cells, b->level, at);
    struct cell_source source = {-1, p->count, place.turned};
    if (own) {
        source.block = (int32_t)(own - p->cells->block);
        source.at = (int32_t)(place.at - own->corner[p->axis]);
        return source;
    }
    if (p->cells->levels > 1) {
        const struct cell_block *there = cell_block_known(p->cells, b->level, at);
        if (!there || there->level != b->level)
            return join(p, b, place);
    }
    if (!memory_reserve((void **)&p->wanted, &p->wanted_capacity, p->count + 1, p->count,
                        sizeof *p->wanted) ||
        !memory_reserve((void **)&p->owner, &p->owner_capacity, p->count + 1, p->count,
                        sizeof *p->owner)) {
        p->failed = true;
        return source;
    }
    const int64_t side = cell_block_side(p->cells->dimension),
                  begin = block_of_cell(place.at, side) * side,
                  low = cell_domain_end(p->cells, b->level, p->axis, 0),
                  corner = begin > low ? begin : low;
    const int32_t rank = partition_owner(p->cells->partition, key);
    p->wanted[p->count] = (struct wanted){key, (int32_t)(place.at - corner), p->cells->ranks->rank};
    p->owner[p->count] = (struct send_item){rank, p->count};
    p->count++;
    return source;
}

/* Takes down that the caller fills a plane, whose number is its own for now. */
static struct cell_source fill(struct planning *p, int32_t b, int side, int depth, int64_t at)
{
    static const enum cell_face mirror = CELL_FACE_MIRROR, copies = CELL_FACE_COPIES;
    struct cell_halo_axis *axis = &p->halo->axis[p->axis];
    const struct cell_block *block = &p->cells->block[b];
    if (!memory_reserve((void **)&axis->filled, &axis->filled_capacity, axis->fills + 1,
                        axis->fills, sizeof *axis->filled)) {
        p->failed = true;
        return (struct cell_source){0};
    }
    axis->filled[axis->fills] = (struct cell_filled){
        .block = b,
        .side = side,
        .depth = depth,
        .at = at,
        .mirror = source_of(p, block, place_inside(p, block->level, at, &mirror)),
        .copy = source_of(p, block, place_inside(p, block->level, at, &copies))};
    return (struct cell_source){-2, axis->fills++, false};
}

static void find_sources(struct planning *p)
{
    const struct cell_blocks *cells = p->cells;
    struct cell_halo_axis *axis = &p->halo->axis[p->axis];
    for (int32_t b = 0; b < cells->blocks; b++)
        for (int side = 0; side < 2; side++)
            for (int k = 0; k < p->halo->depth && !p->failed; k++) {
                const struct cell_block *block = &cells->block[b];
                const int64_t corner = block->corner[p->axis],
                              at = side ? corner + block->count[p->axis] + k : corner - 1 - k;
                const struct axis_place place = place_inside(p, block->level, at, NULL);
                axis->beyond[b][side][k] =
                    place.filled ? fill(p, b, side, k, at) : source_of(p, block, place);
            }
}

static int by_owner(const void *a, const void *b)
{
    const struct send_item *x = a, *y = b;
    return x->rank != y->rank ? (x->rank < y->rank ? -1 : 1)
                              : (x->item > y->item) - (x->item < y->item);
}

/* Planes come in the order of their ranks, of one rank as they were asked for. */
static void number_source(struct cell_source *source, const int32_t *plane, int32_t remote,
                          int32_t filled)
{
    if (source->block == -1)
        source->at = plane[source->at];
    else if (source->block == -2)
        *source = (struct cell_source){-1, remote + source->at, source->turned};
    else if (source->block == -3)
        *source = (struct cell_source){-1, remote + filled + source->at, source->turned};
}

static void number_planes(struct planning *p, const int32_t *plane)
{
    struct cell_halo_axis *axis = &p->halo->axis[p->axis];
    for (int32_t b = 0; b < p->cells->blocks; b++)
        for (int side = 0; side < 2; side++) {
            axis->waits[b][side] = false;
            for (int k = 0; k < p->halo->depth; k++) {
                number_source(&axis->beyond[b][side][k], plane, p->count, axis->fills);
                axis->waits[b][side] |= axis->beyond[b][side][k].block < 0;
            }
        }
    for (int32_t f = 0; f < axis->fills; f++) {
        number_source(&axis->filled[f].mirror, plane, p->count, axis->fills);
        number_source(&axis->filled[f].copy, plane, p->count, axis->fills);
        axis->filled[f].plane = p->count + f;
    }
    for (int32_t s = 0; s < axis->seams; s++)
        axis->seam[s].plane = p->count + axis->fills + s;
    axis->planes = p->count + axis->fills + axis->seams;
}

/* Tells the owners what is wanted of them. */
static struct error *ask(struct planning *p)
{
    struct cell_halo_axis *axis = &p->halo->axis[p->axis];
    const struct ranks *ranks = p->cells->ranks;
    void *came = NULL;
    int32_t count = 0;
    qsort(p->owner, (size_t)p->count, sizeof *p->owner, by_owner);
    TRY(exchange_once(ranks, p->owner, p->count, p->wanted, sizeof *p->wanted, &came, &count));
    const struct wanted *asked = came;
    struct send_item *send = memory_allocate(((size_t)count + 1) * sizeof *send);
    axis->sent = memory_allocate(((size_t)count + 1) * sizeof *axis->sent);
    struct error *error = ranks_agree(
        ranks, send && axis->sent ? NULL : out_of_memory_for("the cells beyond blocks"));
    for (int32_t k = 0; k < count && !error; k++) {
        const struct cell_block *block = cell_block_find(p->cells, asked[k].key);
        assert(block);
        axis->sent[k] =
            (struct cell_source){(int32_t)(block - p->cells->block), asked[k].at, false};
        send[k] = (struct send_item){asked[k].rank, k};
    }
    if (!error)
        error = exchange_plan(&axis->exchange, ranks, send, count);
    if (!error)
        error =
            ranks_agree(ranks, exchange_reserve(&axis->exchange,
                                                (size_t)p->halo->numbers * sizeof(double) *
                                                    (size_t)cell_plane_room(p->cells->dimension)));
    free(send);
    free(came);
    return error;
}

static void free_axis(struct cell_halo_axis *axis)
{
    free(axis->beyond);
    free(axis->waits);
    free(axis->plane);
    free(axis->filled);
    free(axis->seam);
    free(axis->sent);
    exchange_free(&axis->exchange);
    memset(axis, 0, sizeof *axis);
}

static struct error *plan_axis(struct planning *p)
{
    struct cell_halo_axis *axis = &p->halo->axis[p->axis];
    const size_t blocks = (size_t)p->cells->blocks + 1;
    free_axis(axis);
    axis->beyond = memory_allocate(blocks * sizeof *axis->beyond);
    axis->waits = memory_allocate(blocks * sizeof *axis->waits);
    p->failed = !axis->beyond || !axis->waits;
    if (!p->failed)
        find_sources(p);
    TRY(ranks_agree(p->cells->ranks,
                    p->failed ? out_of_memory_for("the cells beyond blocks") : NULL));
    TRY(p->cells->ranks->joined ? ask(p) : NULL);
    int32_t *plane = memory_allocate(((size_t)p->count + 1) * sizeof *plane);
    for (int32_t k = 0; k < p->count && plane; k++)
        plane[p->owner[k].item] = k;
    if (plane)
        number_planes(p, plane);
    const size_t numbers = (size_t)p->halo->numbers * (size_t)cell_plane_room(p->cells->dimension);
    axis->plane = memory_allocate(((size_t)axis->planes + 1) * numbers * sizeof(double));
    struct error *error =
        plane && axis->plane ? NULL : out_of_memory_for("the cells beyond blocks");
    free(plane);
    return ranks_agree(p->cells->ranks, error);
}

struct error *cell_halo_plan(struct cell_halo *halo, const struct cell_blocks *cells)
{
    if (halo->order == cells->order)
        return NULL;
    halo->order = cells->order;
    struct error *error = NULL;
    for (int axis = 0; axis < cells->dimension && !error; axis++) {
        struct planning planning = {.halo = halo, .cells = cells, .axis = axis};
        error = plan_axis(&planning);
        free(planning.wanted);
        free(planning.owner);
    }
    return error;
}

void cell_halo_free(struct cell_halo *halo)
{
    for (int axis = 0; axis < 3; axis++)
        free_axis(&halo->axis[axis]);
}

/* Number N of a plane of a block. */
static void copy_plane(const struct cell_blocks *cells, const struct cell_source *source, int axis,
                       const double *field, double *out)
{
    const struct cell_block *block = &cells->block[source->block];
    const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
    const double *in = field + block->first + source->at * cell_stride(block, axis);
    for (int j = 0; j < block->count[second]; j++)
        for (int i = 0; i < block->count[first]; i++)
            out[j * block->count[first] + i] =
                in[j * cell_stride(block, second) + i * cell_stride(block, first)];
}

void cell_halo_start(struct cell_halo *halo, const struct cell_blocks *cells, int axis,
                     const double *const *field)
{
    struct cell_halo_axis *of = &halo->axis[axis];
    const size_t room = (size_t)cell_plane_room(cells->dimension),
                 bytes = room * (size_t)halo->numbers * sizeof(double);
    if (!cells->ranks->joined)
        return;
    double *out = of->exchange.buffer;
    for (int32_t k = 0; k < of->exchange.goes; k++)
        for (int n = 0; n < halo->numbers; n++, out += room)
            copy_plane(cells, &of->sent[of->exchange.send[k].item], axis, field[n], out);
    exchange_start(&of->exchange, NULL, bytes, of->plane);
}

void cell_halo_advance(struct cell_halo *halo, int axis)
{
    exchange_advance(&halo->axis[axis].exchange);
}

void cell_halo_finish(struct cell_halo *halo, int axis)
{
    if (halo->axis[axis].exchange.message)
        exchange_finish(&halo->axis[axis].exchange);
}
