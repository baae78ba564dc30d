/* Pictures, as PNG by Cairo: particles coloured by a field, and line plots. */
#ifndef BOLIDE_PICTURE_H
#define BOLIDE_PICTURE_H

#include "model/columns.h"
#include "model/simulation.h"

/* Collective: the particles of all ranks coloured by FIELD ("pressure", "velocity.x") with axes in
 * a readable unit (mm, µm), colour scale with unit, title, time and outline-free discs of the
 * particle's diameter. In 3-D the particles in the slab about the middle plane (of the smallest
 * extent) are drawn; in 1-D it is a plot of FIELD over x. The picture has the same bits on any
 * number of ranks, however the particles are stored. Rank 0 writes it. FIELD may be "material" or
 * "body" too: one colour each, with a legend of their names. LOW and HIGH fix the colour scale (in
 * 1-D the y axis); NAN: the field's own range. A particle at a place that is not finite is left
 * out, one whose value is NaN is grey. ERROR_INPUT when FIELD is unknown or has several components,
 * ERROR_SYSTEM when PATH cannot be written; then PATH is as it was. */
struct error *picture_particles(const char *path, const struct simulation *simulation,
                                const struct population *population, const char *field, double low,
                                double high);

/* NULL when picture_particles can draw FIELD, else an ERROR_INPUT, not located. */
struct error *picture_field_check(const struct simulation *simulation,
                                  const struct population *population, const char *field);

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
    double y_low, y_high; /* fix the y axis; equal: the series' own range */
    bool own_folder;      /* it goes into a folder of the run: refused where that is a link */
};

struct error *picture_plot(const char *path, const struct plot *plot);

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
