/* The cell store; see cell_blocks.h. */
#include "grid/cell_blocks.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "grid/cell_copies.h"
#include "grid/levels.h"
#include "parallel/block.h"

static const struct field_declaration core_fields[] = {
    {"id", NULL, "number in the domain", NUMBER_UINT64, 1, FIELD_STATE},
    {"material", NULL, "material", NUMBER_UINT16, 1, FIELD_STATE},
    {"body", NULL, "body that filled it", NUMBER_UINT16, 1, FIELD_STATE},
    {"mass", "kg", "mass", NUMBER_DOUBLE, 1, FIELD_DERIVED},
    {"density", "kg/m^3", "density", NUMBER_DOUBLE, 1, FIELD_STATE | FIELD_POSITIVE},
    {"energy", "J/kg", "specific internal energy", NUMBER_DOUBLE, 1, FIELD_DERIVED},
    {"pressure", "Pa", "pressure, positive in compression", NUMBER_DOUBLE, 1, FIELD_DERIVED},
    {"position", "m", "centre", NUMBER_DOUBLE, 3, FIELD_DERIVED},
    {"velocity", "m/s", "velocity", NUMBER_DOUBLE, 3, FIELD_DERIVED},
};

static void bind_core(struct cell_blocks *cells)
{
    cells->id = cell_blocks_field(cells, "id");
    cells->material = cell_blocks_field(cells, "material");
    cells->body = cell_blocks_field(cells, "body");
    cells->mass = cell_blocks_field(cells, "mass");
    cells->density = cell_blocks_field(cells, "density");
    cells->energy = cell_blocks_field(cells, "energy");
    cells->pressure = cell_blocks_field(cells, "pressure");
    cells->position = cell_blocks_field(cells, "position");
    cells->velocity = cell_blocks_field(cells, "velocity");
    cells->size = cell_blocks_field(cells, "size");
}

void *cell_blocks_field(const struct cell_blocks *cells, const char *name)
{
    return fields_find(cells->field, cells->fields, name);
}

/* Arrays for the blocks that are there, cleared. */
static struct error *allocate(struct cell_blocks *cells)
{
    for (int k = 0; k < cells->fields; k++) {
        struct field *field = &cells->field[k];
        free(field->data);
        field->data = memory_allocate(((size_t)cells->held + 1) * field_bytes(field));
        if (!field->data)
            return out_of_memory_for("cells");
    }
    bind_core(cells);
    return NULL;
}

struct error *cell_blocks_create(struct cell_blocks *cells, const struct field_declaration *more,
                                 int count)
{
    const int core = (int)COUNT_OF(core_fields);
    cells->fields = 0;
    cell_blocks_declare(cells, core_fields, core);
    cell_blocks_declare(cells, more, count);
    return allocate(cells);
}

void cell_blocks_declare(struct cell_blocks *cells, const struct field_declaration *more, int count)
{
    assert(cells->fields + count <= CELL_BLOCK_FIELDS && cells->blocks == 0);
    for (int k = 0; k < count; k++)
        cells->field[cells->fields++].declaration = more[k];
}

static void free_cover(struct cell_cover *cover)
{
    free(cover->block);
    block_table_free(&cover->table);
    *cover = (struct cell_cover){0};
}

void cell_blocks_destroy(struct cell_blocks *cells)
{
    for (int k = 0; k < cells->fields; k++)
        free(cells->field[k].data);
    free(cells->block);
    free(cells->region);
    block_table_free(&cells->table);
    free_cover(&cells->whole);
    memset(cells, 0, sizeof *cells);
}

static int64_t block_index(const struct cell_blocks *cells, int axis, int64_t cell)
{
    return axis < cells->dimension ? block_of_cell(cell, cell_block_side(cells->dimension)) : 0;
}

uint64_t cell_block_key(int dimension, int level, const int64_t at[3])
{
    const int side = cell_block_side(dimension), blocks = (side / block_cells(dimension)) << level;
    int64_t block[3] = {0, 0, 0};
    for (int axis = 0; axis < dimension; axis++)
        block[axis] = block_of_cell(at[axis], side) * blocks;
    return block_key(block);
}

const struct cell_block *cell_block_find(const struct cell_blocks *cells, uint64_t key)
{
    const int32_t number = cells->table.slots ? block_table_find(&cells->table, key) : -1;
    return number < 0 || number >= cells->blocks ? NULL : &cells->block[number];
}

const struct cell_block *cell_block_at(const struct cell_blocks *cells, int level,
                                       const int64_t at[3])
{
    const struct cell_block *block =
        cell_block_find(cells, cell_block_key(cells->dimension, level, at));
    return block && block->level == level ? block : NULL;
}

int cell_block_order(const void *a, const void *b)
{
    const struct cell_block *first = a, *second = b;
    return first->key < second->key ? -1 : first->key > second->key;
}

/* The block of the domain with index AT along each axis. */
static struct cell_block block_at(const struct cell_blocks *cells, const int64_t at[3])
{
    const int side = cell_block_side(cells->dimension);
    struct cell_block block = {0};
    for (int axis = 0; axis < 3; axis++) {
        const int64_t begin = axis < cells->dimension ? at[axis] * side : 0,
                      end = axis < cells->dimension ? begin + side : 1;
        block.corner[axis] = begin > cells->low[axis] ? begin : cells->low[axis];
        block.count[axis] =
            (int)((end < cells->high[axis] ? end : cells->high[axis]) - block.corner[axis]);
    }
    block.key = cell_block_key(cells->dimension, 0, block.corner);
    return block;
}

/* All blocks of a domain of one level. Free *list. */
static struct error *list_blocks(const struct cell_blocks *cells, struct cell_block **list,
                                 int64_t *count)
{
    int64_t low[3], high[3];
    double all = 1.0;
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = block_index(cells, axis, cells->low[axis]);
        high[axis] = block_index(cells, axis, cells->high[axis] - 1);
        all *= (double)(high[axis] - low[axis] + 1);
    }
    *list = all < INT32_MAX ? memory_allocate((size_t)(all + 1.0) * sizeof **list) : NULL;
    if (!*list)
        return out_of_memory_for("cells");
    *count = 0;
    int64_t at[3];
    for (at[2] = low[2]; at[2] <= high[2]; at[2]++)
        for (at[1] = low[1]; at[1] <= high[1]; at[1]++)
            for (at[0] = low[0]; at[0] <= high[0]; at[0]++)
                (*list)[(*count)++] = block_at(cells, at);
    return NULL;
}

/* Where the cells of blocks are, which have just come: in the arrays, in the table. */
static struct error *place_blocks(struct cell_blocks *cells)
{
    int64_t count = 0;
    cells->copies = 0;
    if (!block_table_clear(&cells->table, cells->blocks + 1))
        return out_of_memory_for("cells");
    for (int32_t b = 0; b < cells->blocks; b++) {
        struct cell_block *block = &cells->block[b];
        block->first = (int32_t)count;
        count += cell_block_cells(block);
        block_table_add(&cells->table, block->key);
        if (count > INT32_MAX)
            return error_new(ERROR_STATE, "more than %d cells on one rank", INT32_MAX);
    }
    cells->count = cells->held = (int32_t)count;
    cells->order++;
    return NULL;
}

/* The cells' ids and centres. */
static void place_cells(struct cell_blocks *cells)
{
    for (int32_t b = 0; b < cells->blocks; b++) {
        const struct cell_block *block = &cells->block[b];
        const double edge = cell_block_edge(cells, block);
        int32_t i = block->first;
        int64_t at[3];
        for (at[2] = 0; at[2] < block->count[2]; at[2]++)
            for (at[1] = 0; at[1] < block->count[1]; at[1]++)
                for (at[0] = 0; at[0] < block->count[0]; at[0]++, i++) {
                    uint64_t id = 0;
                    for (int axis = 2; axis >= 0; axis--) {
                        const int64_t cell = block->corner[axis] + at[axis];
                        id = id * (uint64_t)(cells->high[axis] - cells->low[axis]) +
                             (uint64_t)(cell * (1 << block->level) - cells->low[axis]);
                        cells->position[i][axis] =
                            axis < cells->dimension ? ((double)cell + 0.5) * edge : 0.0;
                    }
                    cells->id[i] = id;
                    if (cells->size)
                        cells->size[i] = edge;
                }
    }
}

struct error *cell_blocks_take_own(struct cell_blocks *cells, struct cell_block *block,
                                   int32_t count, bool copies)
{
    qsort(block, (size_t)count, sizeof *block, cell_block_order);
    free(cells->block);
    cells->block = block;
    cells->blocks = count;
    TRY(place_blocks(cells));
    if (copies)
        TRY(cell_copies_add(cells));
    TRY(allocate(cells));
    place_cells(cells);
    return NULL;
}

/* Whether this rank has block B of all COUNT, which has KEY: before space is divided its slice of
 * them. */
static bool is_own(const struct cell_blocks *cells, uint64_t key, int64_t b, int64_t count)
{
    const struct slice slice = ranks_slice(cells->ranks, count);
    return cells->partition->cut ? partition_owner(cells->partition, key) == cells->ranks->rank
                                 : b >= slice.begin && b < slice.end;
}

struct error *cell_blocks_take(struct cell_blocks *cells, struct cell_block *list, int32_t count)
{
    int32_t blocks = 0;
    if (!cell_blocks_are_spread(cells))
        return cell_blocks_take_own(cells, list, count, false);
    qsort(list, (size_t)count, sizeof *list, cell_block_order);
    free_cover(&cells->whole);
    cells->whole.block = list;
    cells->whole.count = count;
    if (!block_table_clear(&cells->whole.table, count + 1))
        return out_of_memory_for("cells");
    for (int32_t b = 0; b < count; b++) {
        block_table_add(&cells->whole.table, list[b].key);
        blocks += is_own(cells, list[b].key, b, count);
    }
    struct cell_block *own = memory_allocate(((size_t)blocks + 1) * sizeof *own);
    if (!own)
        return out_of_memory_for("cells");
    blocks = 0;
    for (int32_t b = 0; b < count; b++)
        if (is_own(cells, list[b].key, b, count))
            own[blocks++] = list[b];
    return cell_blocks_take_own(cells, own, blocks, true);
}

/* This rank's slice of COUNT blocks. */
static struct error *take_slice(struct cell_blocks *cells, struct cell_block *list, int64_t count)
{
    const struct slice slice = ranks_slice(cells->ranks, count);
    const int32_t blocks = (int32_t)(slice.end - slice.begin);
    struct cell_block *own = memory_allocate(((size_t)blocks + 1) * sizeof *own);
    qsort(list, (size_t)count, sizeof *list, cell_block_order);
    if (own)
        memcpy(own, list + slice.begin, (size_t)blocks * sizeof *list);
    free(list);
    return own ? cell_blocks_take_own(cells, own, blocks, false) : out_of_memory_for("cells");
}

struct error *cell_blocks_fill(struct cell_blocks *cells)
{
    struct cell_block *list;
    int64_t count = 0;
    if (cells->levels < 2) {
        TRY(list_blocks(cells, &list, &count));
        return take_slice(cells, list, count);
    }
    TRY(levels_list(cells, NULL, 0, &list, &count));
    return cell_blocks_take(cells, list, (int32_t)count);
}

struct error *cell_blocks_renew(struct cell_blocks *cells, struct cell_block *list, int32_t count,
                                struct cell_blocks *old)
{
    *old = *cells;
    old->region = NULL;
    cells->block = NULL;
    cells->whole = (struct cell_cover){0};
    cells->table = (struct block_table){0};
    for (int k = 0; k < cells->fields; k++)
        cells->field[k].data = NULL;
    return cell_blocks_take(cells, list, count);
}

struct error *cell_blocks_visit(struct cell_blocks *cells, struct visitor *visitor)
{
    if (cells->levels > 1)
        TRY(ranks_agree(cells->ranks, levels_visit(cells, visitor)));
    if (ranks_sum(cells->ranks, cells->blocks) == 0) /* they are to be loaded */
        TRY(ranks_agree(cells->ranks, cell_blocks_fill(cells)));
    visitor->first = ranks_before(cells->ranks, cells->count);
    visitor->total = ranks_sum(cells->ranks, cells->count);
    struct error *error = fields_visit("cells", cells->field, cells->fields, cells->count, visitor);
    visitor->first = visitor->total = 0;
    return error;
}

uint64_t cell_blocks_hash(const struct cell_blocks *cells)
{
    const uint64_t own = fields_hash(cells->field, cells->fields, cells->count);
    return (uint64_t)ranks_sum(cells->ranks, (int64_t)own);
}

size_t cell_blocks_bytes(const struct cell_blocks *cells)
{
    return fields_bytes(cells->field, cells->fields, 0);
}
