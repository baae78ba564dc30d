/* PNG files, see png.h. Each row is stored as its difference from the row above, which is zero for
 * most of a plot, so that zlib's fastest level compresses well. */
#include "picture/png.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "base/memory.h"

enum { LEVEL = 1, UP = 2 /* the filter of rows */, CHUNK = 1 << 16 };

static void colour_row(const struct png_image *image, int row, unsigned char *bytes)
{
    const unsigned char *from = image->data + (size_t)row * image->stride;
    for (int x = 0; x < image->width; x++) {
        uint32_t colour;
        memcpy(&colour, from + (size_t)x * sizeof colour, sizeof colour);
        for (int k = 0; k < 3; k++)
            bytes[3 * x + k] = (unsigned char)(colour >> (16 - 8 * k));
    }
}

static void put_number(unsigned char bytes[4], size_t number)
{
    for (int k = 0; k < 4; k++)
        bytes[k] = (unsigned char)(number >> (24 - 8 * k));
}

static bool put_chunk(FILE *file, const char *type, const unsigned char *data, size_t size)
{
    unsigned char length[4], sum[4];
    uLong check = crc32(0, (const unsigned char *)type, 4);
    if (size > 0) /* crc32 of no data begins anew */
        check = crc32(check, data, (uInt)size);
    put_number(length, size);
    put_number(sum, check);
    return fwrite(length, 1, 4, file) == 4 && fwrite(type, 1, 4, file) == 4 &&
           fwrite(data, 1, size, file) == size && fwrite(sum, 1, 4, file) == 4;
}

/* Compresses what STREAM has as input, and writes each full chunk of OUT; at the LAST row all. */
static bool put_row(FILE *file, z_stream *stream, unsigned char *out, bool last)
{
    int status = Z_OK;
    do {
        status = deflate(stream, last ? Z_FINISH : Z_NO_FLUSH);
        if (stream->avail_out == 0 || status == Z_STREAM_END) {
            if (!put_chunk(file, "IDAT", out, CHUNK - stream->avail_out))
                return false;
            stream->next_out = out;
            stream->avail_out = CHUNK;
        }
    } while (stream->avail_in > 0 || (last && status == Z_OK));
    return true;
}

/* The rows, of SIZE bytes each; ROOM is for three of them and a chunk. */
static bool put_rows(FILE *file, const struct png_image *image, size_t size, unsigned char *room)
{
    unsigned char *bytes = room, *before = room + size, *up = room + 2 * size, *out = up + size + 1;
    z_stream stream = {.next_out = out, .avail_out = CHUNK};
    bool written = deflateInit(&stream, LEVEL) == Z_OK;
    if (!written)
        errno = ENOMEM;
    memset(before, 0, size);
    up[0] = UP;
    for (int y = 0; y < image->height && written; y++) {
        colour_row(image, y, bytes);
        for (size_t k = 0; k < size; k++)
            up[1 + k] = (unsigned char)(bytes[k] - before[k]);
        unsigned char *other = before;
        before = bytes;
        bytes = other;
        stream.next_in = up;
        stream.avail_in = (uInt)(size + 1);
        written = put_row(file, &stream, out, y + 1 == image->height);
    }
    deflateEnd(&stream);
    return written;
}

static bool put_image(FILE *file, const struct png_image *image)
{
    static const unsigned char signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    const size_t size = 3 * (size_t)image->width;
    unsigned char head[13] = {[8] = 8 /* bits */, 2 /* red, green and blue */};
    unsigned char *room = memory_allocate(3 * size + 1 + CHUNK);
    put_number(head, (size_t)image->width);
    put_number(head + 4, (size_t)image->height);
    if (!room)
        errno = ENOMEM;
    const bool written = room && fwrite(signature, 1, sizeof signature, file) == sizeof signature &&
                         put_chunk(file, "IHDR", head, sizeof head) &&
                         put_rows(file, image, size, room) && put_chunk(file, "IEND", head, 0);
    free(room);
    return written;
}

bool png_write(const char *path, const struct png_image *image)
{
    FILE *file = fopen(path, "wb");
    bool written = file && put_image(file, image);
    if (file)
        written = !fclose(file) && written;
    return written;
}
