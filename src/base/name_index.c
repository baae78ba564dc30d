/* A hash table of names; see name_index.h. */
#include "base/name_index.h"

#include <stdlib.h>
#include <string.h>

/* FNV-1a, with its high bits mixed in, as only the low ones choose the slot. */
static uint64_t hash_of(const char *name, size_t length)
{
    uint64_t hash = UINT64_C(14695981039346656037);
    for (size_t i = 0; i < length; i++)
        hash = (hash ^ (unsigned char)name[i]) * UINT64_C(1099511628211);
    return hash ^ hash >> 32;
}

/* The slot that holds the name, or the free one where it belongs. */
static int slot_of(const struct name_index *index, const char *name, size_t length)
{
    const uint64_t mask = (uint64_t)index->slots - 1;
    uint64_t at = hash_of(name, length) & mask;
    for (;; at = (at + 1) & mask) {
        const char *there = index->slot[at].name;
        if (!there || (!strncmp(there, name, length) && !there[length]))
            return (int)at;
    }
}

/* Twice as many slots, at least half of them free. */
static bool grow(struct name_index *index)
{
    struct name_index larger = {.slots = index->slots ? 2 * index->slots : 16};
    larger.slot = calloc((size_t)larger.slots, sizeof *larger.slot);
    if (!larger.slot)
        return false;
    for (int i = 0; i < index->slots; i++)
        if (index->slot[i].name)
            name_index_add(&larger, index->slot[i].name, index->slot[i].value);
    free(index->slot);
    *index = larger;
    return true;
}

bool name_index_add(struct name_index *index, const char *name, int value)
{
    if (2 * (index->count + 1) > index->slots && !grow(index))
        return false;
    index->slot[slot_of(index, name, strlen(name))] = (struct name_slot){name, value};
    index->count++;
    return true;
}

int name_index_find_part(const struct name_index *index, const char *name, size_t length)
{
    if (!index->slots)
        return -1;
    const struct name_slot *slot = &index->slot[slot_of(index, name, length)];
    return slot->name ? slot->value : -1;
}

int name_index_find(const struct name_index *index, const char *name)
{
    return name_index_find_part(index, name, strlen(name));
}

void name_index_free(struct name_index *index)
{
    free(index->slot);
    *index = (struct name_index){0};
}
