/* Chooses the search for neighbours for the processor that it runs on. */
#include "base/isa.h"
#include "particle/row_kernel.h"

ISA_CHOOSE(int32_t, row_find,
           (const struct candidates *candidates, const struct row_point *own, uint32_t *key,
            uint32_t *entry, uint32_t *row),
           (candidates, own, key, entry, row))
