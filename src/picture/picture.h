/* Line plots, as PNG by Cairo. Pictures of particles are in album.h. */
#ifndef BOLIDE_PICTURE_H
#define BOLIDE_PICTURE_H

#include "model/columns.h"
#include "model/simulation.h"

/* How the points of a series are drawn: as dots, as a line, as a line with a dot at each point, as
 * a thin grey line to measure the others by, or as error bars of three points each: low, middle
 * and high. */
enum line_style { LINE_NONE, LINE_PLAIN, LINE_MARKED, LINE_FAINT, LINE_BARS };

/* One series of a line plot. */
struct series {
    const char *label; /* for the legend; NULL: none */
    int64_t count;
    const double *x, *y; /* SI units; a point that is not finite interrupts a line */
    enum line_style line;
};

struct plot {
    const char *title;
    const char *x_name, *x_unit, *y_name, *y_unit; /* SI units; drawn in a readable multiple */
    int count;
    const struct series *series; /* drawn in order: the first lies behind */
    bool log_x, log_y;
    const char *note;     /* a line under the title, the time for example; NULL: none */
    double x_low, x_high; /* fix an axis; equal: the series' own range */
    double y_low, y_high;
    bool own_folder; /* it goes into a folder of the run: refused where that is a link */
    bool frame;      /* of a film, whose frames have their colours as numbers, not by a palette */
};

struct error *picture_plot(const char *path, const struct plot *plot);

/* The picture at PATH with FACTOR times fewer pixels on each side, as the bytes of a PNG in fresh
 * memory; ERROR_SYSTEM where it cannot be read. */
struct error *picture_shrink(const char *path, int factor, char **bytes, size_t *size);

/* Dots for a plot. */
struct scatter {
    int64_t count;
    double *x, *y;
};

/* False when memory is out; free it all the same. */
bool scatter_allocate(struct scatter *scatter, int64_t count);
void scatter_free(struct scatter *scatter);

/* Collective: brings the dots of all ranks to rank 0, sorted, one where several would lie on each
 * other; the others are left with none. Those that are not finite are left out. */
struct error *scatter_gather(const struct ranks *ranks, struct scatter *scatter);

#endif
