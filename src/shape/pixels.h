/* The grey values of a picture in the PNG format. */
#ifndef BOLIDE_PIXELS_H
#define BOLIDE_PIXELS_H

#include "base/base.h"

enum { PIXEL_CLEAR = -1, PIXEL_WHITE = 255 };

/* One block of memory; free() it. */
struct pixels {
    int64_t width, height;
    int16_t grey[]; /* the top row first, 0 (black) to 255; PIXEL_CLEAR: transparent */
};

/* Makes *made of the bytes of a file, or says what is wrong with them (static text). A color is as
 * grey as it is bright (ITU-R BT.601). */
const char *pixels_read(const char *bytes, size_t size, struct pixels **made);

#endif
