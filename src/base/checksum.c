/* Checksums; see checksum.h. For a place, numbers and what is added for them correspond one to one:
 * mix_bits can be undone. */
#include "base/checksum.h"

#include <string.h>

#include "base/chance.h"

/* Of BYTES the compiler knows the value. */
BOLIDE_INLINE uint64_t sum_of(const char *data, size_t bytes, int64_t first, int64_t count)
{
    uint64_t sum = 0;
    for (int64_t i = 0; i < count; i++) {
        uint64_t number = 0;
        memcpy(&number, data + (size_t)i * bytes, bytes);
        sum += mix_bits(number ^ (uint64_t)(first + i + 1) * 0x9e3779b97f4a7c15u);
    }
    return sum;
}

static uint64_t sum_of_piece(const char *data, size_t bytes, int64_t first, int64_t count)
{
    switch (bytes) {
    case 1:
        return sum_of(data, 1, first, count);
    case 2:
        return sum_of(data, 2, first, count);
    default:
        assert(bytes == 8);
        return sum_of(data, 8, first, count);
    }
}

uint64_t checksum_of(const void *data, size_t bytes, int64_t first, int64_t count, int threads)
{
    enum { PIECE = 1 << 16 };
    const char *from = data;
    uint64_t sum = 0;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(+ : sum) if (count > PIECE)
    for (int64_t i = 0; i < count; i += PIECE)
        sum += sum_of_piece(from + (size_t)i * bytes, bytes, first + i,
                            count - i < PIECE ? count - i : PIECE);
    return sum;
}
