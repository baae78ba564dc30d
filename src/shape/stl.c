/* STL files: triangles in binary (an 80-byte header, a number, 50 bytes a triangle) or in text. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "shape/triangles.h"

enum { HEADER = 84, RECORD = 50, MOST_TRIANGLES = 4000000 };

static const char is_large[] = "this mesh has more than 4 million triangles",
                  is_out[] = "there is no memory for this mesh", is_blank[] = " \t\r\n\f\v";

static uint32_t little_endian(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

static const char *read_binary(const unsigned char *bytes, size_t size, char *said,
                               struct triangles **made)
{
    const int64_t count = little_endian(bytes + 80);
    const int64_t wanted = HEADER + RECORD * count, extra = (int64_t)size - wanted;
    if (extra != 0) {
        const int length = snprintf(said, MESH_TEXT,
                                    "a binary STL file of %lld facets, the number in its bytes 81 "
                                    "to 84, has %lld bytes, and this `file` has %lld: ",
                                    (long long)count, (long long)wanted, (long long)size);
        if (extra < 0)
            snprintf(said + length, (size_t)(MESH_TEXT - length),
                     "it is not an STL mesh, or it is damaged or cut off");
        else
            snprintf(said + length, (size_t)(MESH_TEXT - length),
                     "correct the number, or remove the %lld byte%s after the last facet",
                     (long long)extra, extra == 1 ? "" : "s");
        return said;
    }
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
    const char *text = triangles_make((const float(*)[3][3])corners, count, said, made);
    free(corners);
    return text;
}

/* Where the reading of a text is, and what the grammar wants there. */
struct text {
    const char *begin, *at;
    const char *wanted; /* of the first word that is wrong; NULL: none is */
};

/* The next word, without its end; its length. */
static size_t next_word(struct text *text)
{
    text->at += strspn(text->at, is_blank);
    return strcspn(text->at, is_blank);
}

static bool is_word(const char *at, size_t length, const char *wanted)
{
    if (length != strlen(wanted))
        return false;
    for (size_t i = 0; i < length; i++)
        if ((at[i] | 0x20) != wanted[i])
            return false;
    return true;
}

static bool take_word(struct text *text, const char *wanted)
{
    const size_t length = next_word(text);
    const bool is_right = is_word(text->at, length, wanted);
    text->at += is_right ? length : 0;
    return is_right;
}

/* "end" and WHAT, in one word or two. */
static bool take_end(struct text *text, const char *what)
{
    const size_t length = next_word(text);
    const char *const begin = text->at;
    if (length > 3 && is_word(begin, 3, "end") && is_word(begin + 3, length - 3, what)) {
        text->at += length;
        return true;
    }
    if (take_word(text, "end") && take_word(text, what))
        return true;
    text->at = begin;
    return false;
}

/* Notes what is wanted, unless it is THERE or something was wrong before. */
static bool want(struct text *text, bool there, const char *what)
{
    if (!there && !text->wanted)
        text->wanted = what;
    return there;
}

static bool want_number(struct text *text, float *number)
{
    const size_t length = next_word(text);
    char *end = NULL;
    *number = length ? strtof(text->at, &end) : 0.0f;
    const bool is_right = length > 0 && end == text->at + length;
    text->at += is_right ? length : 0;
    return want(text, is_right, "a number");
}

/* facet normal x y z, outer loop, three times vertex x y z, endloop, endfacet */
static bool take_facet(struct text *text, float corner[3][3])
{
    float normal;
    bool is_right = want(text, take_word(text, "normal"), "`normal`");
    for (int i = 0; i < 3; i++)
        is_right = is_right && want_number(text, &normal);
    is_right = is_right && want(text, take_word(text, "outer"), "`outer loop`") &&
               want(text, take_word(text, "loop"), "`loop`");
    for (int i = 0; i < 3; i++) {
        is_right = is_right && want(text, take_word(text, "vertex"), "`vertex`");
        for (int j = 0; j < 3; j++)
            is_right = is_right && want_number(text, &corner[i][j]);
    }
    return is_right && want(text, take_end(text, "loop"), "`endloop`") &&
           want(text, take_end(text, "facet"), "`endfacet`");
}

static void skip_line(struct text *text) { text->at += strcspn(text->at, "\n"); }

/* What is wrong at the place that the reading has reached, and in which line. */
static const char *explain(struct text *text, int64_t facet, char *said)
{
    enum { MOST_SHOWN = 30 };
    const size_t length = next_word(text);
    long long line = 1;
    for (const char *at = text->begin; at < text->at; at++)
        line += *at == '\n';
    char found[MOST_SHOWN + 1];
    size_t shown = 0;
    for (; shown < length && shown < MOST_SHOWN; shown++)
        found[shown] =
            text->at[shown] > ' ' && text->at[shown] <= '~' ? (char)text->at[shown] : '?';
    found[shown] = '\0';
    const char *comma = strchr(found, ',');
    if (length == 0)
        snprintf(said, MESH_TEXT,
                 "this STL file is cut off: it ends at line %lld, in facet %lld, where %s is "
                 "wanted",
                 line, (long long)facet, text->wanted);
    else if (!strcmp(text->wanted, "a number") && comma)
        snprintf(said, MESH_TEXT,
                 "line %lld of this STL file (facet %lld): \"%s\" has a decimal comma, write "
                 "%.*s.%s",
                 line, (long long)facet, found, (int)(comma - found), found, comma + 1);
    else
        snprintf(said, MESH_TEXT,
                 "line %lld of this STL file (facet %lld): expected %s, found \"%s%s\"", line,
                 (long long)facet, text->wanted, found, shown < length ? "..." : "");
    return said;
}

/* One solid after the other, up to the end of the text: solid NAME, facets, endsolid NAME. */
static const char *read_text(struct text text, char *said, struct triangles **made)
{
    int64_t count = 0, room = 0;
    void *corners = NULL;
    const char *wrong = NULL;
    bool is_open = false;
    while (!wrong && next_word(&text) > 0) {
        if (!is_open && want(&text, take_word(&text, "solid"), "`solid`")) {
            is_open = true;
            skip_line(&text);
        } else if (is_open && take_end(&text, "solid")) {
            is_open = false;
            skip_line(&text);
        } else if (!is_open || !want(&text, take_word(&text, "facet"), "`facet` or `endsolid`")) {
            wrong = explain(&text, count + 1, said);
        } else if (count == MOST_TRIANGLES) {
            wrong = is_large;
        } else if (!memory_reserve(&corners, &room, count + 1, count, sizeof(float[3][3]))) {
            wrong = is_out;
        } else if (!take_facet(&text, ((float(*)[3][3])corners)[count++])) {
            wrong = explain(&text, count, said);
        }
    }
    if (!wrong && is_open && !want(&text, false, "`facet` or `endsolid`"))
        wrong = explain(&text, count + 1, said);
    if (!wrong)
        wrong = triangles_make((const float(*)[3][3])corners, count, said, made);
    free(corners);
    return wrong;
}

const char *stl_read(const char *bytes, size_t size, char *said, struct triangles **made)
{
    static const char order_mark[] = "\xef\xbb\xbf"; /* of a text in UTF-8 */
    if (size == 0)
        return "this `file` is empty";
    struct text text = {.begin = bytes, .at = bytes};
    text.at += strncmp(bytes, order_mark, 3) ? 0 : 3;
    const size_t length = next_word(&text);
    /* Headers of binary files may begin as texts do. */
    if (is_word(text.at, length, "solid") && !memchr(bytes, '\0', size))
        return read_text(text, said, made);
    if (size < HEADER)
        return "this `file` is not an STL mesh";
    if (!memchr(bytes, '\0', size))
        return "this `file` is not an STL mesh, or it is damaged or cut off";
    return read_binary((const unsigned char *)bytes, size, said, made);
}
