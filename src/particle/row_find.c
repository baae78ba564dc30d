/* Chooses the search for neighbours for the processor that it runs on. */
#include "base/isa.h"
#include "particle/row_kernel.h"

typedef int32_t row_find_isa(const struct candidates *, const struct row_point *, uint32_t *,
                             uint32_t *, uint32_t *);

row_find_isa row_find_v2;
#if defined(__x86_64__)
row_find_isa row_find_v3, row_find_v4;
#endif

int32_t row_find(const struct candidates *candidates, const struct row_point *own, uint32_t *key,
                 uint32_t *entry, uint32_t *row)
{
    switch (isa_best()) {
#if defined(__x86_64__)
    case ISA_V4:
        return row_find_v4(candidates, own, key, entry, row);
    case ISA_V3:
        return row_find_v3(candidates, own, key, entry, row);
#endif
    default:
        return row_find_v2(candidates, own, key, entry, row);
    }
}
