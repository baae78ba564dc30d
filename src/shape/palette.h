/* Whether the pixels of a PNG image with a palette name entries that it lacks. */
#ifndef BOLIDE_PALETTE_H
#define BOLIDE_PALETTE_H

#include <stdbool.h>
#include <stddef.h>

/* What the SIZE bytes of a PNG image, whose signature and header are right, become when its palette
 * is filled up to as many entries as its pixels can name, with entries of grey LEVEL: *made, to be
 * freed, of *made_size bytes. False, and *made NULL, where there is no such palette; *made is NULL
 * too where memory is out. */
bool palette_fill(const unsigned char *bytes, size_t size, unsigned char level,
                  unsigned char **made, size_t *made_size);

#endif
