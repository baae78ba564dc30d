/* Controls written out; see visible.h. */
#include "base/visible.h"

#include <stdlib.h>
#include <string.h>

size_t utf8_character(const char *text, size_t length, uint32_t *code)
{
    static const uint32_t least[5] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned char *byte = (const unsigned char *)text;
    const size_t size = byte[0] < 0x80   ? 1
                        : byte[0] < 0xc0 ? 0
                        : byte[0] < 0xe0 ? 2
                        : byte[0] < 0xf0 ? 3
                        : byte[0] < 0xf8 ? 4
                                         : 0;
    *code = byte[0];
    if (size < 2 || size > length)
        return size > length ? 0 : size;
    *code &= 0x7f >> size;
    for (size_t i = 1; i < size; i++) {
        if ((byte[i] & 0xc0) != 0x80)
            return 0;
        *code = *code << 6 | (byte[i] & 0x3f);
    }
    const bool surrogate = *code >= 0xd800 && *code < 0xe000;
    return *code < least[size] || *code > 0x10ffff || surrogate ? 0 : size;
}

static bool is_within(uint32_t code, const uint32_t ranges[][2], size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (code >= ranges[i][0] && code <= ranges[i][1])
            return true;
    return false;
}

bool is_invisible(uint32_t code)
{
    static const uint32_t ranges[][2] = {
        {0x20, 0x20},       {0xa0, 0xa0},       {0xad, 0xad},      {0x34f, 0x34f},
        {0x115f, 0x1160},   {0x1680, 0x1680},   {0x17b4, 0x17b5},  {0x180b, 0x180f},
        {0x2000, 0x200d},   {0x202f, 0x202f},   {0x205f, 0x2065},  {0x2800, 0x2800},
        {0x3000, 0x3000},   {0x3164, 0x3164},   {0xfe00, 0xfe0f},  {0xffa0, 0xffa0},
        {0x1bca0, 0x1bca3}, {0x1d173, 0x1d17a}, {0xe0100, 0xe01ef}};
    return is_control(code) || is_within(code, ranges, COUNT_OF(ranges));
}

bool is_spelled_twice(uint32_t code)
{
    static const uint32_t ranges[][2] = {
        {0x300, 0x36f},   {0x37e, 0x37e},   {0x387, 0x387},    {0x653, 0x655},   {0x1100, 0x11ff},
        {0x1ab0, 0x1aff}, {0x1dc0, 0x1dff}, {0x1f71, 0x1f71},  {0x1f73, 0x1f73}, {0x1f75, 0x1f75},
        {0x1f77, 0x1f77}, {0x1f79, 0x1f79}, {0x1f7b, 0x1f7b},  {0x1f7d, 0x1f7d}, {0x20d0, 0x20ff},
        {0x2126, 0x2126}, {0x212a, 0x212b}, {0x3099, 0x309a},  {0xa960, 0xa97f}, {0xd7b0, 0xd7ff},
        {0xf900, 0xfaff}, {0xfe20, 0xfe2f}, {0x2f800, 0x2fa1f}};
    return is_within(code, ranges, COUNT_OF(ranges));
}

bool is_control(uint32_t code)
{
    static const uint32_t ranges[][2] = {
        {0x00, 0x1f},     {0x7f, 0x9f},     {0x61c, 0x61c},   {0x200b, 0x200b}, {0x200e, 0x200f},
        {0x2028, 0x202e}, {0x2060, 0x206f}, {0xfeff, 0xfeff}, {0xfff9, 0xfffb}, {0xe0000, 0xe007f}};
    return is_within(code, ranges, COUNT_OF(ranges));
}

/* Writes the piece that TEXT starts with, as it is or written out, into PIECE; returns how many
 * bytes of TEXT it is. */
enum { PIECE = 16 };
static size_t next_piece(const char *text, char piece[PIECE])
{
    uint32_t code;
    const size_t size = utf8_character(text, strnlen(text, 4), &code);
    if (size == 0 || (size == 1 && is_control(code)))
        snprintf(piece, PIECE, "\\x%02x", (unsigned)(unsigned char)*text);
    else if (is_control(code))
        snprintf(piece, PIECE, "\\u%04x", (unsigned)code);
    else
        snprintf(piece, PIECE, "%.*s", (int)size, text);
    return size ? size : 1;
}

char *text_visible(const char *text)
{
    char piece[PIECE];
    size_t length = 0;
    for (const char *at = text; *at; length += strlen(piece))
        at += next_piece(at, piece);
    char *visible = malloc(length + 1), *end = visible;
    if (!visible)
        return NULL;
    for (const char *at = text; *at; end += strlen(piece)) {
        at += next_piece(at, piece);
        memcpy(end, piece, strlen(piece));
    }
    *end = '\0';
    return visible;
}

void text_put_visible(FILE *file, const char *text)
{
    char piece[PIECE];
    while (*text) {
        text += next_piece(text, piece);
        fputs(piece, file);
    }
}

void text_make_file_name(char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < 128 &&
            !strchr("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.+-=,", *text))
            *text = '_';
}
