/* Films of PNG frames. */
#ifndef BOLIDE_PICTURE_FILM_H
#define BOLIDE_PICTURE_FILM_H

#include "base/error.h"

/* ERROR_INPUT, with its name, where a frame is no PNG or has another size than the first. */
struct error *film_check(const char *const *paths, int count);

/* Joins the frames, RATE a second, to an animated PNG at PATH: their compressed data as they
 * are. */
struct error *film_apng(const char *const *paths, int count, double rate, const char *path);

#endif
