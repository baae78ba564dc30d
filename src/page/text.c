/* Words and bytes of report.html: escaping, quantities, base64. */
#include <stdlib.h>
#include <string.h>

#include "page/internal.h"

static const char replacement[] = "\xEF\xBF\xBD";

/* Bytes of the UTF-8 character at TEXT, 0 where there is none (RFC 3629: no overlong form, no
 * surrogate, nothing beyond U+10FFFF). */
static int character_length(const unsigned char *text)
{
    int length = text[0] < 0x80                       ? 1
                 : text[0] >= 0xC2 && text[0] < 0xE0  ? 2
                 : text[0] >= 0xE0 && text[0] < 0xF0  ? 3
                 : text[0] >= 0xF0 && text[0] <= 0xF4 ? 4
                                                      : 0;
    for (int i = 1; i < length; i++)
        if ((text[i] & 0xC0) != 0x80)
            return 0;
    if ((text[0] == 0xE0 && text[1] < 0xA0) || (text[0] == 0xED && text[1] > 0x9F) ||
        (text[0] == 0xF0 && text[1] < 0x90) || (text[0] == 0xF4 && text[1] > 0x8F))
        return 0;
    return length;
}

static bool is_control(unsigned char c)
{
    return (c < 0x20 && c != '\n' && c != '\t' && c != '\r') || c == 0x7F;
}

void page_text(FILE *file, const char *text)
{
    while (*text) {
        int length = character_length((const unsigned char *)text);
        switch (*text) {
        case '&':
            fputs("&amp;", file);
            break;
        case '<':
            fputs("&lt;", file);
            break;
        case '>':
            fputs("&gt;", file);
            break;
        case '"':
            fputs("&quot;", file);
            break;
        case '\'':
            fputs("&#39;", file);
            break;
        default:
            if (!length || is_control((unsigned char)*text))
                fputs(replacement, file);
            else
                fwrite(text, 1, (size_t)length, file);
        }
        text += length ? length : 1;
    }
}

/* VALUE, positive, as a number below ten and a power of ten. */
static void scientific_text(double value, char *buffer, size_t size)
{
    static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    char number[32], power[8], digits[32] = "";
    snprintf(number, sizeof number, "%.4e", value);
    char *exponent = strchr(number, 'e');
    *exponent = '\0';
    snprintf(power, sizeof power, "%d", (int)strtol(exponent + 1, NULL, 10));
    for (const char *c = power; *c; c++)
        strcat(digits, *c == '-' ? "⁻" : raised[*c - '0']);
    snprintf(buffer, size, "%g\u00a0×\u00a010%s", strtod(number, NULL), digits);
}

const char *quantity_text(double value, const char *unit, char *buffer)
{
    char number[64];
    const char *sign = value < 0.0 ? "−" : "";
    double magnitude = fabs(value);
    struct multiple multiple = multiple_find(magnitude, unit);
    if (!isfinite(value) || multiple.name[0] == '1')
        multiple = multiple_find(1.0, unit); /* no customary multiple is near */
    double reduced = magnitude / multiple.scale;
    if (isnan(value))
        snprintf(number, sizeof number, "not a number");
    else if (isinf(value))
        snprintf(number, sizeof number, "∞");
    else if (reduced != 0.0 && (reduced < 1e-3 || reduced >= 1e6))
        scientific_text(reduced, number, sizeof number);
    else
        snprintf(number, sizeof number, reduced >= 1e5 ? "%.6g" : "%.5g", reduced);
    bool named = multiple.name[0] && !isnan(value);
    snprintf(buffer, QUANTITY_TEXT, "%s%s%s%s", sign, number, named ? "\u00a0" : "",
             named ? multiple.name : "");
    return buffer;
}

void page_quantity(FILE *file, double value, const char *unit)
{
    char text[QUANTITY_TEXT];
    page_text(file, quantity_text(value, unit, text));
}

void page_base64(FILE *file, const unsigned char *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        uint32_t group = (uint32_t)bytes[i] << 16 | (left > 1 ? (uint32_t)bytes[i + 1] << 8 : 0) |
                         (left > 2 ? bytes[i + 2] : 0);
        fputc(digits[group >> 18], file);
        fputc(digits[group >> 12 & 63], file);
        fputc(left > 1 ? digits[group >> 6 & 63] : '=', file);
        fputc(left > 2 ? digits[group & 63] : '=', file);
    }
}

void page_json_text(FILE *file, const char *text)
{
    fputc('"', file);
    for (; *text; text++)
        if (*text == '"' || *text == '\\' || *text == '<' || (unsigned char)*text < ' ')
            fprintf(file, "\\u%04x", (unsigned char)*text);
        else
            fputc(*text, file);
    fputc('"', file);
}
