/* The root of an increasing curve: Newton's method inside a shrinking bracket. */
#ifndef BOLIDE_EXACT_ROOT_H
#define BOLIDE_EXACT_ROOT_H

struct root_value {
    double value, slope;
};

/* The x in [LOW, HIGH] where CURVE(context, x) is zero, to the last bits of x. The curve increases,
 * is at most zero at LOW and at least zero at HIGH; START is the first guess. HIGH may be INFINITY
 * when the curve is concave between START and the root, and not positive at START. */
double root_find(struct root_value (*curve)(const void *context, double x), const void *context,
                 double low, double high, double start);

#endif
