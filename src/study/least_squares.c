/* Least squares; see least_squares.h. */
#include "study/least_squares.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { N = LEAST_SQUARES_MOST };

/* Of the range of an unknown: the difference that the Jacobian is taken with, so large that the
 * noise of a simulation does not show; the step that is worth a run; and where its predicted gain
 * is less than this fraction of the sum. */
static const double DIFFERENCE = 0.05, DIFFERENCE_AGAIN = 0.02, STEP_LEAST = 1e-3,
                    GAIN_LEAST = 1e-2;
static const double DAMPING_START = 1e-3, DAMPING_FAILED = 1.0, DAMPING_WORSE = 1e-2;
/* So many steps in a row that do not help, and the Jacobian is taken again. */
enum { WORSE_MOST = 2 };

struct state {
    const struct least_squares *problem;
    struct least_squares_result *result;
    double *trial; /* residuals */
    double damping, difference;
    int runs, worse; /* steps in a row that did not help */
    bool fresh;      /* the Jacobian has been taken about the best point */
};

static double sum_of(const double *r, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++)
        sum += r[i] * r[i];
    return sum;
}

/* Solves the system of the symmetric positive A, of COUNT unknowns in rows of N, for B in place:
 * Cholesky. False where it is singular. */
static bool solve(int count, double a[N][N], double *b)
{
    for (int j = 0; j < count; j++) {
        for (int i = j; i < count; i++) {
            for (int k = 0; k < j; k++)
                a[i][j] -= a[i][k] * a[j][k];
            if (i == j && !(a[j][j] > 0.0))
                return false;
            a[i][j] = i == j ? sqrt(a[j][j]) : a[i][j] / a[j][j];
        }
    }
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < i; k++)
            b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (int i = count - 1; i >= 0; i--) {
        for (int k = i + 1; k < count; k++)
            b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return true;
}

/* Evaluates at U into the trial's residuals, and counts. */
static enum residuals_end evaluate(struct state *s, const double *u, double *sum)
{
    *sum = INFINITY;
    const enum residuals_end end = s->problem->evaluate(s->problem->context, u, s->trial);
    s->runs++;
    if (end == RESIDUALS_DONE)
        *sum = sum_of(s->trial, s->problem->residuals);
    return end == RESIDUALS_DONE && !isfinite(*sum) ? RESIDUALS_FAILED : end;
}

static bool is_exhausted(const struct state *s) { return s->runs >= s->problem->most; }

static void accept(struct state *s, const double *u, double sum)
{
    s->fresh = false;
    memcpy(s->result->at, u, (size_t)s->problem->unknowns * sizeof *u);
    memcpy(s->result->residual, s->trial, (size_t)s->problem->residuals * sizeof *u);
    s->result->sum = sum;
}

/* Column K of the Jacobian at AT with its residuals R, by a step inwards, else outwards, else by
 * shorter ones; what is better than the best so far becomes that. */
static bool take_column(struct state *s, const double *at, const double *r, int k)
{
    static const double tries[] = {1.0, -1.0, 0.25, -0.25};
    const int n = s->problem->unknowns, m = s->problem->residuals;
    const double inwards = at[k] + s->difference <= 1.0 ? s->difference : -s->difference;
    for (size_t t = 0; t < COUNT_OF(tries); t++) {
        double u[N], sum;
        memcpy(u, at, (size_t)n * sizeof *u);
        u[k] = at[k] + tries[t] * inwards;
        if (u[k] < 0.0 || u[k] > 1.0)
            continue;
        if (is_exhausted(s)) {
            s->result->end = LEAST_SQUARES_MOST_RUNS;
            return false;
        }
        const enum residuals_end end = evaluate(s, u, &sum);
        if (end == RESIDUALS_STOP) {
            s->result->end = LEAST_SQUARES_STOPPED;
            return false;
        }
        if (end == RESIDUALS_FAILED)
            continue;
        for (int i = 0; i < m; i++)
            s->result->jacobian[i * n + k] = (s->trial[i] - r[i]) / (u[k] - at[k]);
        if (sum < s->result->sum)
            accept(s, u, sum);
        return true;
    }
    s->result->end = LEAST_SQUARES_NO_NEIGHBOUR;
    return false;
}

static struct error *differentiate(struct state *s, bool *goes_on)
{
    const size_t size = (size_t)s->problem->residuals * sizeof(double);
    double at[N], *r = memory_allocate(size);
    if (!r)
        return out_of_memory();
    memcpy(at, s->result->at, sizeof at);
    memcpy(r, s->result->residual, size);
    *goes_on = s->fresh = true;
    for (int k = 0; k < s->problem->unknowns && *goes_on; k++)
        *goes_on = take_column(s, at, r, k);
    s->result->differentiated |= *goes_on;
    s->worse = 0;
    s->damping = DAMPING_START;
    s->difference = DIFFERENCE_AGAIN;
    free(r);
    return NULL;
}

/* The step of the damped normal equations of the unknowns that are not FIXED, whose steps STEP
 * has. */
static bool solve_free(const struct state *s, const bool *fixed, double *step)
{
    const int n = s->problem->unknowns, m = s->problem->residuals;
    const double *J = s->result->jacobian, *r = s->result->residual;
    int place[N], count = 0;
    double a[N][N], b[N];
    for (int k = 0; k < n; k++)
        if (!fixed[k])
            place[count++] = k;
    for (int i = 0; i < count; i++) {
        b[i] = 0.0;
        for (int q = 0; q < m; q++) {
            double residual = r[q];
            for (int k = 0; k < n; k++)
                residual += fixed[k] ? J[q * n + k] * step[k] : 0.0;
            b[i] -= J[q * n + place[i]] * residual;
        }
        for (int j = 0; j < count; j++) {
            a[i][j] = 0.0;
            for (int q = 0; q < m; q++)
                a[i][j] += J[q * n + place[i]] * J[q * n + place[j]];
        }
        a[i][i] += s->damping * a[i][i];
        if (a[i][i] == 0.0) /* without influence it stays where it is */
            a[i][i] = 1.0;
    }
    if (!solve(count, a, b))
        return false;
    for (int i = 0; i < count; i++)
        step[place[i]] = b[i];
    return true;
}

/* The step, with those unknowns that would leave their bounds fixed there. False where the system
 * is singular. */
static bool find_step(const struct state *s, double *step)
{
    const int n = s->problem->unknowns;
    const double *at = s->result->at;
    bool fixed[N] = {false}, again = true;
    while (again) {
        again = false;
        if (!solve_free(s, fixed, step))
            return false;
        for (int k = 0; k < n; k++) {
            const double inside = minimum(maximum(at[k] + step[k], 0.0), 1.0) - at[k];
            if (fixed[k] || inside == step[k])
                continue;
            step[k] = inside;
            fixed[k] = again = true;
        }
    }
    return true;
}

/* The sum of squares that the Jacobian predicts after STEP. */
static double predict(const struct state *s, const double *step)
{
    const int n = s->problem->unknowns;
    double sum = 0.0;
    for (int i = 0; i < s->problem->residuals; i++) {
        double r = s->result->residual[i];
        for (int k = 0; k < n; k++)
            r += s->result->jacobian[i * n + k] * step[k];
        sum += r * r;
    }
    return sum;
}

/* Broyden's update, so that the Jacobian gives the change that STEP made. */
static void update(struct state *s, const double *step)
{
    const int n = s->problem->unknowns;
    const double length = sum_of(step, n);
    for (int i = 0; i < s->problem->residuals; i++) {
        double *row = s->result->jacobian + i * n, change = s->trial[i] - s->result->residual[i];
        for (int k = 0; k < n; k++)
            change -= row[k] * step[k];
        for (int k = 0; k < n; k++)
            row[k] += change * step[k] / length;
    }
}

/* One step. *TRIED: false where none is worth a run. */
static enum residuals_end make_step(struct state *s, bool *tried)
{
    const int n = s->problem->unknowns;
    double step[N] = {0.0}, u[N], largest = 0.0, sum;
    *tried = find_step(s, step);
    for (int k = 0; k < n; k++) {
        u[k] = s->result->at[k] + step[k];
        largest = maximum(largest, fabs(step[k]));
    }
    const double gain = s->result->sum - predict(s, step);
    *tried = *tried && largest >= STEP_LEAST && gain > GAIN_LEAST * s->result->sum;
    if (!*tried)
        return RESIDUALS_DONE;
    const enum residuals_end end = evaluate(s, u, &sum);
    s->worse++;
    if (end == RESIDUALS_FAILED)
        s->damping = maximum(10.0 * s->damping, DAMPING_FAILED);
    if (end != RESIDUALS_DONE)
        return end;
    update(s, step);
    if (sum < s->result->sum) {
        accept(s, u, sum);
        s->damping *= 0.2;
        s->worse = 0;
    } else {
        s->damping = maximum(10.0 * s->damping, DAMPING_WORSE);
    }
    return end;
}

/* Steps until it ends. Where no step helps, the Jacobian is taken afresh, unless it is fresh. */
static struct error *descend(struct state *s)
{
    struct least_squares_result *result = s->result;
    bool goes_on = true, tried;
    TRY(differentiate(s, &goes_on));
    while (goes_on) {
        result->end = result->sum <= s->problem->within ? LEAST_SQUARES_WITHIN
                      : is_exhausted(s)                 ? LEAST_SQUARES_MOST_RUNS
                                                        : LEAST_SQUARES_NEAREST;
        if (result->end != LEAST_SQUARES_NEAREST)
            return NULL;
        if (make_step(s, &tried) == RESIDUALS_STOP) {
            result->end = LEAST_SQUARES_STOPPED;
            return NULL;
        }
        if (tried && (s->worse < WORSE_MOST || s->fresh))
            continue;
        if (s->fresh)
            return NULL;
        TRY(differentiate(s, &goes_on));
    }
    return NULL;
}

struct error *least_squares(const struct least_squares *problem,
                            struct least_squares_result *result)
{
    const size_t n = (size_t)problem->unknowns, m = (size_t)problem->residuals;
    struct state s = {.problem = problem, .result = result, .difference = DIFFERENCE};
    assert(problem->unknowns <= N);
    *result = (struct least_squares_result){.sum = INFINITY};
    s.trial = memory_allocate((m + 1) * sizeof *s.trial);
    result->residual = memory_allocate((m + 1) * sizeof *s.trial);
    result->jacobian = memory_allocate((m * n + 1) * sizeof *s.trial);
    if (!s.trial || !result->residual || !result->jacobian) {
        free(s.trial);
        return out_of_memory();
    }
    double sum;
    struct error *error = NULL;
    switch (evaluate(&s, problem->start, &sum)) {
    case RESIDUALS_FAILED:
        result->end = LEAST_SQUARES_NO_START;
        break;
    case RESIDUALS_STOP:
        result->end = LEAST_SQUARES_STOPPED;
        break;
    case RESIDUALS_DONE:
        accept(&s, problem->start, sum);
        error = descend(&s);
    }
    free(s.trial);
    return error;
}

void least_squares_free(struct least_squares_result *result)
{
    free(result->residual);
    free(result->jacobian);
    *result = (struct least_squares_result){0};
}

/* J'J is scaled to ones on its diagonal, so that its inverse does not depend on units, and a little
 * is added to it, so that there is one. */
void least_squares_covariance(int m, int n, const double *jacobian, double *covariance)
{
    static const double LITTLE = 1e-10;
    double norm[N], scaled[N][N];
    for (int i = 0; i < n; i++) {
        norm[i] = 0.0;
        for (int q = 0; q < m; q++)
            norm[i] += square(jacobian[q * n + i]);
        norm[i] = sqrt(norm[i]);
    }
    for (int j = 0; j < n; j++) {
        double column[N] = {0.0};
        for (int i = 0; i < n; i++)
            for (int k = 0; k < n; k++) {
                scaled[i][k] = i == k ? 1.0 + LITTLE : 0.0;
                for (int q = 0; q < m && i != k && norm[i] > 0.0 && norm[k] > 0.0; q++)
                    scaled[i][k] += jacobian[q * n + i] / norm[i] * (jacobian[q * n + k] / norm[k]);
            }
        column[j] = 1.0;
        const bool solved = solve(n, scaled, column);
        for (int i = 0; i < n; i++) {
            const double scale = norm[i] * norm[j];
            covariance[i * n + j] = !solved       ? (double)NAN
                                    : scale > 0.0 ? column[i] / scale
                                    : i == j      ? (double)INFINITY
                                                  : 0.0;
        }
    }
}
