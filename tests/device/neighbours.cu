/* Device code of the search for neighbours. */
#include "particle/row_body.h"

__global__ void find_rows(const struct candidates *candidates, const struct row_point *own,
                          uint32_t *key, uint32_t *entry, uint32_t *row)
{
    const int i = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    row_order(key, entry, row_keep(&candidates[i], &own[i], key, entry), row);
}
