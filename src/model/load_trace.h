/* The pressure that acts on a face by a record: over the distance from the first point of a line,
 * and the time. */
#ifndef BOLIDE_LOAD_TRACE_H
#define BOLIDE_LOAD_TRACE_H

#include "base/base.h"

struct load_trace {
    int points;
    int64_t rows;
    double spacing;  /* of the points, m */
    double largest;  /* pressure above the ambient at any point and time, Pa */
    double *time;    /* of each row, s, growing */
    double *impulse; /* points numbers a row: up to its time, of what is above the ambient, Pa s */
};

/* Room for ROWS of POINTS; false when memory is out. Free it in any case. */
bool load_trace_create(struct load_trace *trace, int points, int64_t rows);
void load_trace_free(struct load_trace *trace);

/* Fills the impulse from PRESSURE, points numbers a row, between whose rows it is linear. AMBIENT
 * is taken off; NAN: the pressure of each point in the first row. */
void load_trace_integrate(struct load_trace *trace, const double *pressure, double ambient);

/* The mean pressure at DISTANCE from time FROM to TO, Pa: linear between the points; beyond the
 * last that of the last; zero before the first and after the last row. */
double load_trace_mean(const struct load_trace *trace, double distance, double from, double to);

#endif
