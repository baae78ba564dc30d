/* Finds blocks by their keys: a hash table of so many numbers as there are blocks. */
#ifndef BOLIDE_BLOCK_TABLE_H
#define BOLIDE_BLOCK_TABLE_H

#include "base/base.h"

struct block_slot {
    uint64_t key;
    int32_t number; /* + 1; 0: empty */
};

struct block_table {
    uint64_t slots; /* a power of two, at least twice the blocks */
    int32_t count;
    struct block_slot *slot;
};

/* An empty table with room for COUNT blocks; false when memory is out. */
bool block_table_clear(struct block_table *table, int64_t count);
void block_table_free(struct block_table *table);

/* Where KEY is, or where it would go. */
static inline struct block_slot *block_table_slot(const struct block_table *table, uint64_t key)
{
    uint64_t s = key * 0x9e3779b97f4a7c15u >> 20 & (table->slots - 1);
    while (table->slot[s].number && table->slot[s].key != key)
        s = (s + 1) & (table->slots - 1);
    return &table->slot[s];
}

/* The number of the block of KEY, -1 when it is not there. */
static inline int32_t block_table_find(const struct block_table *table, uint64_t key)
{
    return block_table_slot(table, key)->number - 1;
}

/* The number of the block of KEY, which is the next one when it is not there yet. The table must
 * have room. */
static inline int32_t block_table_add(struct block_table *table, uint64_t key)
{
    struct block_slot *slot = block_table_slot(table, key);
    if (!slot->number) {
        slot->key = key;
        slot->number = ++table->count;
    }
    return slot->number - 1;
}

#endif
