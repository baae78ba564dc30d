/* The reader of images under libFuzzer: whatever the bytes, it returns grey values or says what is
 * wrong, and frees all memory. */
#include "fuzz.h"
#include "shape/pixels.h"

static uint32_t big_endian(const char *bytes)
{
    uint32_t value = 0;
    for (int i = 0; i < 4; i++)
        value = value << 8 | (uint8_t)bytes[i];
    return value;
}

static uint32_t crc32_of(const char *bytes, size_t size)
{
    uint32_t crc = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        crc ^= (uint8_t)bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc;
}

/* A wrong checksum stops the reader at once. This makes those of all whole chunks right. */
static void mend_checksums(char *png, size_t size)
{
    for (size_t at = 8; at + 12 <= size;) {
        const size_t length = big_endian(png + at);
        if (length > size - at - 12)
            return;
        const uint32_t crc = crc32_of(png + at + 4, length + 4);
        for (int i = 0; i < 4; i++)
            png[at + 8 + length + (size_t)i] = (char)(crc >> (24 - 8 * i));
        at += length + 12;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *bytes = fuzz_file(data, size);
    if (!bytes)
        return 0;
    if (size % 4 != 0) /* most inputs */
        mend_checksums(bytes, size);

    struct pixels *pixels = NULL;
    const char *text = pixels_read(bytes, size, &pixels);
    insist(!text == !!pixels, "neither an image nor an error, or both");
    for (int64_t i = 0; pixels && i < pixels->width * pixels->height; i++)
        insist(pixels->grey[i] >= PIXEL_CLEAR && pixels->grey[i] <= PIXEL_WHITE, "a grey value");
    free(pixels);
    free(bytes);
    return 0;
}
