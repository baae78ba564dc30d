/* Memory of the table of blocks; see block_table.h. */
#include "grid/block_table.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

bool block_table_clear(struct block_table *table, int64_t count)
{
    uint64_t slots = table->slots ? table->slots : 64;
    while (slots < 2 * (uint64_t)count)
        slots *= 2;
    if (slots != table->slots) {
        free(table->slot);
        table->slot = memory_allocate(slots * sizeof *table->slot);
        table->slots = table->slot ? slots : 0;
    } else {
        memset(table->slot, 0, slots * sizeof *table->slot);
    }
    table->count = 0;
    return table->slot != NULL;
}

void block_table_free(struct block_table *table)
{
    free(table->slot);
    *table = (struct block_table){0};
}
