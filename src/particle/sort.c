/* The order of storage: blocks by key, in them materials, cells and ids. No result depends on it;
 * locality and batches of one material do. */
#include <omp.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/block.h"
#include "particle/particles.h"
#include "particle/radix.h"

/* Within a block: the material, and its cell of BLOCK_CELLS. */
enum { CELL_BITS = 6, WITHIN_BITS = 16 + CELL_BITS };

/* Fields move so many bytes of a particle at a time. */
enum { SLICE = 48 };

/* What sorting needs for a while. Slices are moved when the runs have been used. */
struct sorting {
    struct keyed *entry, *spare;
    union {
        struct key_run *run;
        char *slice;
    } room;
};

/* The key of the block that X lies in; *cell becomes its cell within the block. */
static uint64_t locate(const struct particles *p, const double x[3], uint64_t *cell)
{
    int64_t at[3] = {0, 0, 0}, cells = block_cells(p->dimension);
    *cell = 0;
    for (int axis = 0; axis < p->dimension; axis++) {
        int64_t index = cell_index(x[axis] + p->shift, p->cell, cells * BLOCK_MIDDLE);
        at[axis] = block_of_cell(index, cells);
        *cell = *cell * (uint64_t)cells + (uint64_t)(index - at[axis] * cells);
    }
    return block_key(at);
}

uint64_t particles_block_key(const struct particles *particles, const double x[3])
{
    uint64_t cell;
    return locate(particles, x, &cell);
}

/* Finds the keys of the blocks. Neighbours in storage were in one block when they were sorted last,
 * so that there are few runs of equal keys to sort. */
static struct error *find_blocks(struct particles *p, struct sorting *s)
{
#pragma omp parallel for schedule(static) num_threads(*p->threads)
    for (int32_t i = 0; i < p->count; i++)
        s->entry[i] = (struct keyed){particles_block_key(p, p->position[i]), i};
    int32_t runs = radix_runs(s->entry, p->count, *p->threads, s->room.run);
    for (int32_t r = 0; r < runs; r++)
        s->entry[r] = (struct keyed){s->room.run[r].key, r};
    radix_sort(s->entry, s->spare, runs, *p->threads);
    runs = radix_runs(s->entry, runs, *p->threads, s->room.run);
    if (!memory_reserve((void **)&p->block, &p->block_capacity, runs, 0, sizeof *p->block))
        return out_of_memory_for("%d blocks", runs);
    for (int32_t b = 0; b < runs; b++)
        p->block[b] = (struct block){s->room.run[b].key, 0, 0};
    p->blocks = runs;
    return NULL;
}

/* The block of KEY. */
static int32_t find_block(const struct particles *p, uint64_t key)
{
    int32_t low = 0, high = p->blocks; /* key of low <= KEY < key of high */
    while (high - low > 1) {
        int32_t middle = low + (high - low) / 2;
        if (p->block[middle].key <= key)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Entries by block, material and cell. */
static void enter(const struct particles *p, struct keyed *entry)
{
#pragma omp parallel num_threads(*p->threads)
    {
        int32_t block = 0;
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++) {
            uint64_t cell, key = locate(p, p->position[i], &cell);
            if (p->block[block].key != key)
                block = find_block(p, key);
            uint64_t within = (uint64_t)p->material[i] << CELL_BITS | cell;
            entry[i] = (struct keyed){(uint64_t)block << WITHIN_BITS | within, i};
        }
    }
}

/* The first of the sorted entries whose block is BLOCK or a later one. */
static int32_t first_of_block(const struct keyed *entry, int32_t count, int32_t block)
{
    int32_t low = 0, high = count;
    while (low < high) {
        int32_t middle = low + (high - low) / 2;
        if ((int32_t)(entry[middle].key >> WITHIN_BITS) < block)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Orders entries of one (block, material, cell) by id: few, and nearly in order. */
static void order_by_id(struct keyed *entry, int64_t count, const uint64_t *id)
{
    for (int64_t i = 1; i < count; i++) {
        struct keyed moving = entry[i];
        int64_t k = i;
        while (k > 0 && entry[k - 1].key == moving.key &&
               id[entry[k - 1].index] > id[moving.index]) {
            entry[k] = entry[k - 1];
            k--;
        }
        entry[k] = moving;
    }
}

/* Finds where each block's entries begin, and brings them into their order; returns whether any
 * particle has a new place. */
static bool fill_blocks(struct particles *p, struct keyed *entry)
{
    bool moved = false;
#pragma omp parallel for schedule(static) num_threads(*p->threads)
    for (int32_t b = 0; b < p->blocks; b++)
        p->block[b].first = first_of_block(entry, p->count, b);
#pragma omp parallel for schedule(dynamic) num_threads(*p->threads) reduction(|| : moved)
    for (int32_t b = 0; b < p->blocks; b++) {
        const int32_t first = p->block[b].first;
        const int32_t end = b + 1 < p->blocks ? p->block[b + 1].first : p->count;
        p->block[b].count = end - first;
        order_by_id(entry + first, end - first, p->id);
        for (int32_t i = first; i < end && !moved; i++)
            moved = entry[i].index != i;
    }
    return moved;
}

/* Gathers BYTES of each of COUNT particles, which become those at TO, in the order of their
 * entries; and puts those of particles BEGIN .. END - 1 back. */
BOLIDE_INLINE void gather(char *to, const char *from, size_t stride, size_t bytes,
                          const struct keyed *entry, int32_t count)
{
    for (int32_t i = 0; i < count; i++)
        memcpy(to + (size_t)i * bytes, from + (size_t)entry[i].index * stride, bytes);
}

BOLIDE_INLINE void put_back(char *to, const char *from, size_t stride, size_t bytes, int32_t begin,
                            int32_t end)
{
    for (int32_t i = begin; i < end; i++)
        memcpy(to + (size_t)i * stride, from + (size_t)i * bytes, bytes);
}

/* BYTES is a constant where this is inlined: most fields are of a few widths. */
BOLIDE_INLINE void move_part(const struct particles *p, const struct sorting *s, char *data,
                             size_t stride, size_t bytes)
{
    const int parts = omp_get_num_threads(), part = omp_get_thread_num();
    const int32_t begin = (int32_t)((int64_t)p->count * part / parts);
    const int32_t end = (int32_t)((int64_t)p->count * (part + 1) / parts);
    gather((char *)s->room.slice + (size_t)begin * bytes, data, stride, bytes, s->entry + begin,
           end - begin);
#pragma omp barrier
    put_back(data, s->room.slice, stride, bytes, begin, end);
#pragma omp barrier
}

static void move_slice(const struct particles *p, const struct sorting *s, char *data,
                       size_t stride, size_t bytes)
{
    switch (bytes) {
    case 2:
        move_part(p, s, data, stride, 2);
        break;
    case 8:
        move_part(p, s, data, stride, 8);
        break;
    case 24:
        move_part(p, s, data, stride, 24);
        break;
    case SLICE:
        move_part(p, s, data, stride, SLICE);
        break;
    default:
        move_part(p, s, data, stride, bytes);
    }
}

/* All threads walk through all fields, each with its part of the particles. */
static void move_fields(struct particles *p, const struct sorting *s)
{
#pragma omp parallel num_threads(*p->threads)
    for (int k = 0; k < p->fields; k++) {
        const struct field_declaration *field = &p->field[k].declaration;
        const size_t stride = number_size(field->number) * (size_t)field->components;
        for (size_t at = 0; at < stride && !(field->kind & FIELD_PASSING); at += SLICE)
            move_slice(p, s, (char *)p->field[k].data + at, stride,
                       stride - at < SLICE ? stride - at : SLICE);
    }
}

size_t particles_sort_bytes(void) { return 2 * sizeof(struct keyed) + SLICE; }

struct error *particles_sort(struct particles *particles)
{
    struct sorting s;
    const size_t count = (size_t)particles->count;
    particles->order++;
    if (!scratch_begin(&particles->scratch, count * particles_sort_bytes()))
        return out_of_memory_for("sorting %d particles", particles->count);
    s.entry = scratch_part(&particles->scratch, count * sizeof *s.entry);
    s.spare = scratch_part(&particles->scratch, count * sizeof *s.spare);
    s.room.slice = scratch_part(&particles->scratch, count * SLICE);
    TRY(find_blocks(particles, &s));
    enter(particles, s.entry);
    radix_sort(s.entry, s.spare, particles->count, *particles->threads);
    if (fill_blocks(particles, s.entry))
        move_fields(particles, &s);
    return NULL;
}

struct error *particles_arrange(struct particles *particles, const int32_t *list,
                                const struct block *block, int32_t blocks)
{
    struct particles *p = particles;
    struct sorting s;
    const size_t count = (size_t)p->count;
    if (!scratch_begin(&p->scratch, count * (sizeof *s.entry + SLICE)) ||
        !memory_reserve((void **)&p->block, &p->block_capacity, blocks, 0, sizeof *p->block))
        return out_of_memory_for("sorting %d particles", p->count);
    s.entry = scratch_part(&p->scratch, count * sizeof *s.entry);
    s.room.slice = scratch_part(&p->scratch, count * SLICE);
#pragma omp parallel for schedule(static) num_threads(*p->threads)
    for (int32_t i = 0; i < p->count; i++)
        s.entry[i].index = list[i];
    move_fields(p, &s);
    if (blocks > 0)
        memcpy(p->block, block, (size_t)blocks * sizeof *block);
    p->blocks = blocks;
    p->order++;
    return NULL;
}
