/* STL files: triangles in binary (an 80-byte header, a number, 50 bytes a triangle) or in text. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "shape/triangles.h"

enum { HEADER = 84, RECORD = 50, MOST_TRIANGLES = 4000000 };

static const char is_damaged[] = "this STL file is damaged or cut off",
                  is_large[] = "this mesh has more than 4 million triangles",
                  is_out[] = "there is no memory for this mesh";

static uint32_t little_endian(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

static bool is_binary(const unsigned char *bytes, size_t size)
{
    return size >= HEADER && size == HEADER + (size_t)RECORD * little_endian(bytes + 80);
}

static const char *read_binary(const unsigned char *bytes, struct triangles **made)
{
    const int64_t count = little_endian(bytes + 80);
    if (count > MOST_TRIANGLES)
        return is_large;
    float(*corners)[3][3] = malloc((size_t)(count + 1) * sizeof *corners);
    if (!corners)
        return is_out;
    for (int64_t i = 0; i < count; i++)
        for (int j = 0; j < 9; j++) {
            /* The normal comes first. */
            const uint32_t bits = little_endian(bytes + HEADER + RECORD * i + 12 + 4 * j);
            memcpy(&corners[i][j / 3][j % 3], &bits, sizeof bits);
        }
    const char *text = triangles_make((const float(*)[3][3])corners, count, made);
    free(corners);
    return text;
}

/* The next word at *AT, without its end; its length. */
static size_t next_word(const char **at)
{
    *at += strspn(*at, " \t\r\n\f\v");
    return strcspn(*at, " \t\r\n\f\v");
}

static bool take_word(const char **at, const char *wanted)
{
    const size_t length = next_word(at);
    if (length != strlen(wanted))
        return false;
    for (size_t i = 0; i < length; i++)
        if (((*at)[i] | 0x20) != wanted[i])
            return false;
    *at += length;
    return true;
}

static bool take_number(const char **at, float *number)
{
    const size_t length = next_word(at);
    char *end;
    if (length == 0)
        return false;
    *number = strtof(*at, &end);
    if (end != *at + length)
        return false;
    *at = end;
    return true;
}

/* facet normal x y z, outer loop, three times vertex x y z, endloop, endfacet */
static bool take_facet(const char **at, float corner[3][3])
{
    float normal;
    bool is_right = take_word(at, "normal");
    for (int i = 0; i < 3; i++)
        is_right = is_right && take_number(at, &normal);
    is_right = is_right && take_word(at, "outer") && take_word(at, "loop");
    for (int i = 0; i < 3; i++) {
        is_right = is_right && take_word(at, "vertex");
        for (int j = 0; j < 3; j++)
            is_right = is_right && take_number(at, &corner[i][j]);
    }
    return is_right && take_word(at, "endloop") && take_word(at, "endfacet");
}

static void skip_line(const char **at) { *at += strcspn(*at, "\n"); }

/* One solid after the other, up to the end of the text: solid NAME, facets, endsolid NAME. */
static const char *read_text(const char *at, struct triangles **made)
{
    int64_t count = 0, room = 0;
    void *corners = NULL;
    const char *text = NULL;
    bool is_open = false;
    while (!text && next_word(&at) > 0) {
        if (!is_open && take_word(&at, "solid")) {
            is_open = true;
            skip_line(&at);
        } else if (is_open && take_word(&at, "endsolid")) {
            is_open = false;
            skip_line(&at);
        } else if (!is_open || !take_word(&at, "facet")) {
            text = is_damaged;
        } else if (count == MOST_TRIANGLES) {
            text = is_large;
        } else if (!memory_reserve(&corners, &room, count + 1, count, sizeof(float[3][3]))) {
            text = is_out;
        } else if (!take_facet(&at, ((float(*)[3][3])corners)[count++])) {
            text = is_damaged;
        }
    }
    if (!text && is_open)
        text = is_damaged;
    if (!text)
        text = triangles_make((const float(*)[3][3])corners, count, made);
    free(corners);
    return text;
}

const char *stl_read(const char *bytes, size_t size, struct triangles **made)
{
    if (size == 0)
        return "this `file` is empty";
    if (is_binary((const unsigned char *)bytes, size))
        return read_binary((const unsigned char *)bytes, made);
    const char *at = bytes;
    if (!take_word(&at, "solid"))
        return size > HEADER ? "this `file` is not an STL mesh, or it is damaged or cut off"
                             : "this `file` is not an STL mesh";
    return memchr(bytes, '\0', size) ? is_damaged : read_text(bytes, made);
}
