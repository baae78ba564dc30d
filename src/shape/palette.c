/* The palette of a PNG image; see palette.h. A file is a list of chunks: the length of their data,
 * a name of four letters, the data, and the checksum of both (ISO/IEC 15948). */
#include "shape/palette.h"

#include <stdint.h>
#include <string.h>

#include "base/memory.h"

enum { SIGNATURE = 8, CHUNK = 12, DEPTH_AT = SIGNATURE + 16, COLOR_AT = SIGNATURE + 17 };
enum { COLOR_PALETTE = 3, ENTRY = 3 };

static uint32_t big_endian(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static void put_big_endian(unsigned char *bytes, uint32_t value)
{
    for (int k = 0; k < 4; k++)
        bytes[k] = (unsigned char)(value >> (24 - 8 * k));
}

/* The cyclic redundancy check of the format, annex D. */
static uint32_t checksum(const unsigned char *bytes, size_t size)
{
    uint32_t sum = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            sum = sum >> 1 ^ (sum & 1 ? UINT32_C(0xedb88320) : 0);
    }
    return ~sum;
}

/* Where the chunk NAME begins; SIZE where there is none. */
static size_t find_chunk(const unsigned char *bytes, size_t size, const char *name)
{
    for (size_t at = SIGNATURE; size - at >= CHUNK;) {
        const size_t length = big_endian(bytes + at);
        if (memcmp(bytes + at + 4, name, 4) == 0)
            return length <= size - at - CHUNK ? at : size;
        if (length > size - at - CHUNK)
            break;
        at += length + CHUNK;
    }
    return size;
}

bool palette_fill(const unsigned char *bytes, size_t size, unsigned char level,
                  unsigned char **made, size_t *made_size)
{
    *made = NULL;
    if (size <= COLOR_AT || bytes[COLOR_AT] != COLOR_PALETTE || bytes[DEPTH_AT] > 8)
        return false;
    const size_t at = find_chunk(bytes, size, "PLTE"), all = (size_t)ENTRY << bytes[DEPTH_AT];
    if (at == size)
        return false;
    const size_t length = big_endian(bytes + at), behind = at + CHUNK + length;
    if (length >= all)
        return false;
    *made_size = size + all - length;
    *made = memory_allocate(*made_size);
    if (!*made)
        return true;
    unsigned char *chunk = *made + at;
    memcpy(*made, bytes, at + 8 + length);
    put_big_endian(chunk, (uint32_t)all);
    memset(chunk + 8 + length, level, all - length);
    put_big_endian(chunk + 8 + all, checksum(chunk + 4, 4 + all));
    memcpy(chunk + CHUNK + all, bytes + behind, size - behind);
    return true;
}
