/* The order of storage: blocks by key, in them materials, cells and ids. No result depends on it; locality
 * and batches of one material do. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/block.h"
#include "particle/particles.h"
#include "particle/radix.h"

/* What sorting needs for a while. */
struct sorting {
    struct keyed *entry, *scratch;
    uint64_t *block; /* key of each particle's block */
    void *moved;     /* one field in its new order */
};

static void sorting_free(struct sorting *s)
{
    free(s->entry);
    free(s->scratch);
    free(s->block);
    free(s->moved);
}

/* The key of the block that X lies in; *cell becomes its cell within the block. */
static uint64_t locate(const struct particles *p, const double x[3], uint64_t *cell)
{
    int64_t at[3] = {0, 0, 0}, cells = block_cells(p->dimension);
    *cell = 0;
    for (int axis = 0; axis < p->dimension; axis++) {
        int64_t index = cell_index(x[axis], p->cell, cells * BLOCK_MIDDLE);
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

/* Finds the blocks of the particles, sorted by key so far. */
static struct error *find_blocks(struct particles *p, const struct keyed *entry)
{
    p->blocks = 0;
    for (int32_t i = 0; i < p->count; i++) {
        if (i > 0 && entry[i].key == entry[i - 1].key)
            continue;
        if (p->blocks == p->block_capacity &&
            !memory_reserve((void **)&p->block, &p->block_capacity, p->blocks + 64, p->blocks,
                            sizeof *p->block))
            return error_new(ERROR_SYSTEM, "out of memory for %d blocks", p->blocks);
        p->block[p->blocks++] = (struct block){entry[i].key, i, 0};
    }
    for (int32_t b = 0; b < p->blocks; b++)
        p->block[b].count =
            (b + 1 < p->blocks ? p->block[b + 1].first : p->count) - p->block[b].first;
    return NULL;
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

/* Bytes of a particle in the widest field. */
static size_t widest_field(const struct particles *p)
{
    size_t widest = 0;
    for (int k = 0; k < p->fields; k++) {
        const struct field_declaration *field = &p->field[k].declaration;
        size_t bytes = number_size(field->number) * (size_t)field->components;
        widest = bytes > widest ? bytes : widest;
    }
    return widest;
}

static void move_fields(struct particles *p, const struct keyed *entry, void *moved)
{
    for (int k = 0; k < p->fields; k++) {
        struct field *field = &p->field[k];
        size_t bytes =
            number_size(field->declaration.number) * (size_t)field->declaration.components;
        const char *data = field->data;
        char *to = moved;
        for (int32_t i = 0; i < p->count; i++)
            memcpy(to + (size_t)i * bytes, data + (size_t)entry[i].index * bytes, bytes);
        memcpy(field->data, moved, (size_t)p->count * bytes);
    }
}

static struct error *sort_with(struct particles *p, struct sorting *s)
{
    size_t count = (size_t)p->count;
    s->entry = memory_allocate(count * sizeof *s->entry);
    s->scratch = memory_allocate(count * sizeof *s->scratch);
    s->block = memory_allocate(count * sizeof *s->block);
    s->moved = memory_allocate(count * widest_field(p));
    if (!s->entry || !s->scratch || !s->block || !s->moved)
        return error_new(ERROR_SYSTEM, "out of memory while sorting %d particles", p->count);
    /* First by material and cell, then, keeping that order, by block. */
    for (int32_t i = 0; i < p->count; i++) {
        uint64_t cell;
        s->block[i] = locate(p, p->position[i], &cell);
        s->entry[i] = (struct keyed){(uint64_t)p->material[i] << 6 | cell, i};
    }
    radix_sort(s->entry, s->scratch, p->count);
    for (int32_t i = 0; i < p->count; i++)
        s->entry[i].key = s->block[s->entry[i].index];
    radix_sort(s->entry, s->scratch, p->count);
    TRY(find_blocks(p, s->entry));
    for (int32_t b = 0; b < p->blocks; b++) {
        struct keyed *entry = s->entry + p->block[b].first;
        for (int32_t k = 0; k < p->block[b].count; k++) {
            uint64_t cell;
            locate(p, p->position[entry[k].index], &cell);
            entry[k].key = (uint64_t)p->material[entry[k].index] << 6 | cell;
        }
        order_by_id(entry, p->block[b].count, p->id);
    }
    bool moved = false;
    for (int32_t i = 0; i < p->count && !moved; i++)
        moved = s->entry[i].index != i;
    if (moved)
        move_fields(p, s->entry, s->moved);
    return NULL;
}

struct error *particles_sort(struct particles *particles)
{
    struct sorting sorting = {0};
    struct error *error = sort_with(particles, &sorting);
    particles->order++;
    sorting_free(&sorting);
    return error;
}
