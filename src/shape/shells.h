/* A mesh of several closed surfaces, its shells: one within another is a cavity, one in a cavity is
 * material again, and shells that overlap enclose what either does. */
#ifndef BOLIDE_SHELLS_H
#define BOLIDE_SHELLS_H

#include <stdbool.h>
#include <stdint.h>

/* Shells that a shell lies within, and that are around a point, at most; more do not count. */
enum { SHELLS_DEEP = 6, SHELLS_AROUND = 32 };

struct shell_nest {
    int32_t depth, outer[SHELLS_DEEP];
};

/* Sorts the COUNT triangles at CORNERS by shell, SHELL of each, of which there are *SHELLS. False
 * where memory is out. */
bool shells_sort(double (*corners)[3][3], int64_t count, int32_t *shell, int32_t *shells);

/* Takes a corner of shell OWN, its FIRST or another, into its NEST: the COUNT shells AROUND it.
 * What is around some corners and not around others overlaps the shell. */
void shells_nest(struct shell_nest *nest, bool first, const int32_t *around, int count,
                 int32_t own);

/* Whether a point is enclosed that has COUNT shells AROUND it. */
bool shells_enclose(const struct shell_nest *nest, const int32_t *around, int count);

#endif
