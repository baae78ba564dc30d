/* Animated PNG (APNG 1.0, now part of PNG 3): acTL says how many frames there are, fcTL before each
 * how long it is seen; the data of all but the first are in fdAT instead of IDAT. */
#include "picture/film.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "base/file.h"

enum { SIGNATURE = 8, HEAD_BYTES = 13, FRAME_BYTES = 26 };

static uint32_t read_number(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static void put_number(unsigned char *bytes, uint32_t number)
{
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned char)(number >> (24 - 8 * i));
}

/* A chunk of NAME, whose data are NUMBER (unless negative), then SIZE bytes. */
static void put_chunk(FILE *file, const char *name, int64_t number, const void *bytes,
                      uint32_t size)
{
    unsigned char word[4];
    uLong check = crc32(0, (const Bytef *)name, 4);
    put_number(word, size + (number >= 0 ? 4 : 0));
    fwrite(word, 1, 4, file);
    fwrite(name, 1, 4, file);
    if (number >= 0) {
        put_number(word, (uint32_t)number);
        check = crc32(check, word, 4);
        fwrite(word, 1, 4, file);
    }
    check = crc32(check, bytes, size);
    fwrite(bytes, 1, size, file);
    put_number(word, (uint32_t)check);
    fwrite(word, 1, 4, file);
}

/* The whole file; ERROR_INPUT unless it is a PNG of the size in HEAD, which it fills first. */
static struct error *read_frame(const char *path, bool first, char head[HEAD_BYTES], char **bytes,
                                size_t *size)
{
    static const char signature[] = "\x89PNG\r\n\x1a\n";
    TRY(file_read(path, bytes, size));
    const bool whole = *bytes && *size > SIGNATURE + 12 + HEAD_BYTES + 12 &&
                       !memcmp(*bytes, signature, SIGNATURE) &&
                       !memcmp(*bytes + SIGNATURE + 4, "IHDR", 4) &&
                       !memcmp(*bytes + *size - 8, "IEND", 4);
    if (whole && first)
        memcpy(head, *bytes + SIGNATURE + 8, HEAD_BYTES);
    if (whole && !memcmp(head, *bytes + SIGNATURE + 8, HEAD_BYTES))
        return NULL;
    free(*bytes);
    *bytes = NULL;
    return error_new(ERROR_INPUT, "%s: %s", path,
                     whole ? "another size than the frames before; draw them all again with "
                             "`bolide picture`"
                           : "no PNG, or half of one");
}

/* The frame at PATH, after its fcTL; *NUMBER counts these and the parts of data. */
static struct error *put_frame(FILE *file, const char *bytes, size_t size, bool first,
                               int64_t *number)
{
    for (size_t at = SIGNATURE; at + 12 <= size;) {
        const uint32_t length = read_number(bytes + at);
        if (length > size - at - 12)
            return error_new(ERROR_INPUT, "half of a PNG");
        if (!memcmp(bytes + at + 4, "IDAT", 4)) {
            if (first)
                put_chunk(file, "IDAT", -1, bytes + at + 8, length);
            else
                put_chunk(file, "fdAT", (*number)++, bytes + at + 8, length);
        }
        at += 12 + length;
    }
    return NULL;
}

static void put_control(FILE *file, const char head[HEAD_BYTES], double rate, int64_t *number)
{
    unsigned char control[FRAME_BYTES - 4] = {0};
    memcpy(control, head, 8); /* width, height; no offset */
    put_number(control + 16, (uint32_t)(1000.0 / rate + 0.5) << 16 | 1000);
    put_chunk(file, "fcTL", (*number)++, control, sizeof control);
}

struct error *film_check(const char *const *paths, int count)
{
    char head[HEAD_BYTES], *bytes;
    size_t size;
    for (int i = 0; i < count; i++) {
        TRY(read_frame(paths[i], i == 0, head, &bytes, &size));
        free(bytes);
    }
    return NULL;
}

struct error *film_apng(const char *const *paths, int count, double rate, const char *path)
{
    char head[HEAD_BYTES], *bytes;
    size_t size;
    int64_t number = 0;
    FILE *file;
    TRY(film_check(paths, count));
    TRY(file_begin(path, &file));
    struct error *error = NULL;
    fwrite("\x89PNG\r\n\x1a\n", 1, SIGNATURE, file);
    for (int i = 0; i < count && !error; i++) {
        error = read_frame(paths[i], i == 0, head, &bytes, &size);
        if (error)
            break;
        if (i == 0) {
            const unsigned char forever[4] = {0};
            put_chunk(file, "IHDR", -1, head, HEAD_BYTES);
            put_chunk(file, "acTL", count, forever, 4);
        }
        put_control(file, head, rate, &number);
        error = error_context(put_frame(file, bytes, size, i == 0, &number), "%s", paths[i]);
        free(bytes);
    }
    put_chunk(file, "IEND", -1, "", 0);
    if (!error)
        return file_end(path, file);
    fclose(file);
    return error;
}
