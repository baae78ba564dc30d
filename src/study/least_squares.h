/* Non-linear least squares with bounds for residuals that are dear, by the method of Levenberg and
 * Marquardt: the Jacobian is taken by differences at first and kept by Broyden's updates. Source:
 * Levenberg 1944, Marquardt 1963, Broyden 1965. */
#ifndef BOLIDE_LEAST_SQUARES_H
#define BOLIDE_LEAST_SQUARES_H

#include "base/error.h"

enum { LEAST_SQUARES_MOST = 12 }; /* unknowns */

enum residuals_end { RESIDUALS_DONE, RESIDUALS_FAILED, RESIDUALS_STOP };

struct least_squares {
    int unknowns, residuals; /* UNKNOWNS from 0 to 1 each */
    const double *start;
    double within; /* the end, of the sum of squares */
    int most;      /* evaluations */
    /* Fills R at U. FAILED: there is no value at U, the misfit is infinite. STOP ends all. */
    enum residuals_end (*evaluate)(void *context, const double *u, double *r);
    void *context;
};

enum least_squares_end {
    LEAST_SQUARES_WITHIN,  /* as near as was asked for */
    LEAST_SQUARES_NEAREST, /* no step makes it better */
    LEAST_SQUARES_MOST_RUNS,
    LEAST_SQUARES_NO_START,     /* the start has no value */
    LEAST_SQUARES_NO_NEIGHBOUR, /* nor have the points beside it */
    LEAST_SQUARES_STOPPED
};

/* JACOBIAN has a row of `unknowns` for each residual. */
struct least_squares_result {
    enum least_squares_end end;
    double at[LEAST_SQUARES_MOST], sum; /* INFINITY: nothing was evaluated */
    double *residual, *jacobian;        /* owned */
    bool differentiated;                /* the Jacobian has been taken */
};

struct error *least_squares(const struct least_squares *problem,
                            struct least_squares_result *result);
void least_squares_free(struct least_squares_result *result);

/* Covariances of N unknowns from the Jacobian of M residuals, each over its deviation: the inverse
 * of J'J, N * N numbers. An unknown without influence has an infinite variance; those that cannot
 * be told apart have large ones, and correlations next to one. */
void least_squares_covariance(int m, int n, const double *jacobian, double *covariance);

#endif
