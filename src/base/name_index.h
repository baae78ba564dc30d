/* Where a name stands in a list, without looking through the list: cases may have a hundred
 * thousand keys. */
#ifndef BOLIDE_NAME_INDEX_H
#define BOLIDE_NAME_INDEX_H

#include "base/base.h"

struct name_slot {
    const char *name; /* NULL: free */
    int value;
};

/* A hash table with open addressing. All zero is empty. The names belong to the caller, and must
 * stay where they are. */
struct name_index {
    int count, slots; /* slots: zero or a power of two */
    struct name_slot *slot;
};

/* Notes VALUE of NAME, which must not be in it yet. False when memory is out. */
bool name_index_add(struct name_index *index, const char *name, int value);

/* The value of the first LENGTH bytes of NAME; -1 when there is none. */
int name_index_find_part(const struct name_index *index, const char *name, size_t length);
int name_index_find(const struct name_index *index, const char *name);

void name_index_free(struct name_index *index);

#endif
