/* Text from outside that goes to a terminal, a log or a file name: which characters steer a
 * terminal or hide what is read, and the same text with these written out. */
#ifndef BOLIDE_VISIBLE_H
#define BOLIDE_VISIBLE_H

#include <stdio.h>

#include "base/base.h"

/* The UTF-8 character that TEXT, of LENGTH bytes, starts with: how many bytes it has, 0 where there
 * is none, and its code point. */
size_t utf8_character(const char *text, size_t length, uint32_t *code);

/* True for what has no glyph and acts on what surrounds it: C0 and C1 controls, delete, line and
 * paragraph separators, marks that change the direction of the text, the byte order mark, tags. */
bool is_control(uint32_t code);

/* True for what shows nothing by itself: blanks of all widths, joiners, fillers, variation
 * selectors, the soft hyphen. Two texts that differ by these alone look the same. */
bool is_invisible(uint32_t code);

/* True for what Unicode spells in another way too: marks that compose with the Latin, Greek,
 * Cyrillic, Arabic or kana letter before them, the parts of Hangul syllables, and second copies of
 * letters, such as the signs of ohm, kelvin and angstrom. Texts that differ by their spelling look
 * the same. */
bool is_spelled_twice(uint32_t code);

/* The same text on one line, with controls written as \x1b or \u202e and bytes that are not UTF-8
 * as \xff; in fresh memory, NULL when that is out. */
char *text_visible(const char *text);

/* Writes TEXT to FILE in that way. */
void text_put_visible(FILE *file, const char *text);

/* Makes TEXT a name of a file in place: what has a meaning to a shell or a file system becomes
 * "_". */
void text_make_file_name(char *text);

#endif
