/* What the tests of the exact solutions share: solving, reading numbers by name, and the laws that
 * every solution obeys. */
#ifndef BOLIDE_TEST_EXACT_SOLUTION_H
#define BOLIDE_TEST_EXACT_SOLUTION_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "exact/exact.h"

struct solution {
    const struct exact_class *class;
    void *solved;
    struct exact_number numbers[EXACT_NUMBERS];
    int count;
};

static inline struct solution solve(const struct exact_class *class, const void *parameters,
                                    double time)
{
    struct solution solution = {.class = class, .solved = calloc(1, class->size)};
    struct error *error = class->solve(parameters, solution.solved);
    if (error)
        fail_msg("%s", error_message(error, 0));
    solution.count = class->numbers(solution.solved, time, solution.numbers);
    assert_true(solution.count <= EXACT_NUMBERS);
    return solution;
}

static inline void release(struct solution *solution) { free(solution->solved); }

static inline void assert_refused(const struct exact_class *class, const void *parameters)
{
    void *solved = calloc(1, class->size);
    struct error *error = class->solve(parameters, solved);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    error_free(error);
    free(solved);
}

static inline double number(const struct solution *solution, const char *name)
{
    for (int i = 0; i < solution->count; i++)
        if (!strcmp(solution->numbers[i].name, name))
            return solution->numbers[i].value;
    fail_msg("no number \"%s\"", name);
    return NAN;
}

/* VALUE over UNIT, rounded, is PRINTED to its last digit. */
static inline void assert_printed(const char *name, double value, double unit, const char *printed)
{
    const char *point = strchr(printed, '.'), *exponent = strchr(printed, 'e');
    size_t length = exponent ? (size_t)(exponent - printed) : strlen(printed);
    double digit = point ? pow(10.0, -(double)(length - (size_t)(point - printed) - 1)) : 1.0;
    if (exponent)
        digit *= pow(10.0, atof(exponent + 1));
    double off = fabs(value / unit - strtod(printed, NULL));
    if (!(off <= 0.5000001 * digit))
        fail_msg("%s: %.12g instead of %s (%.2f of the last digit)", name, value / unit, printed,
                 off / digit);
}

struct row {
    const char *name;
    double unit;
    const char *printed;
};

static inline void assert_rows(const struct solution *solution, const struct row *rows)
{
    for (; rows->name; rows++)
        assert_printed(rows->name, number(solution, rows->name), rows->unit, rows->printed);
}

static inline void assert_near(double a, double b, double scale, double tolerance)
{
    if (!(fabs(a - b) <= tolerance * scale))
        fail_msg("%.17g and %.17g differ by %.3g of %.6g", a, b, fabs(a - b) / scale, scale);
}

static inline bool ends(const char *name, const char *with)
{
    size_t length = strlen(name), tail = strlen(with);
    return length >= tail && !strcmp(name + length - tail, with);
}

/* The largest speed that occurs: what round-off in a velocity is measured by. */
static inline double largest_speed(const struct solution *solution)
{
    double largest = 0.0;
    for (int i = 0; i < solution->count; i++)
        if (!strcmp(solution->numbers[i].unit, "m/s"))
            largest = maximum(largest, fabs(solution->numbers[i].value));
    return largest;
}

/* Mass, momentum and energy are conserved across every jump of the solution. */
static inline void assert_jumps_conserve(const struct solution *solution)
{
    for (int i = 0; i < solution->count; i++) {
        const char *name = solution->numbers[i].name;
        if (!ends(name, " speed") || strstr(name, "sound") || strstr(name, " head ") ||
            strstr(name, " tail "))
            continue;
        enum exact_side side = name[0] == 'l' ? SIDE_LEFT : SIDE_RIGHT;
        double speed = solution->numbers[i].value,
               at = solution->class->contact(solution->solved, 0.0);
        double outward = side == SIDE_LEFT ? -1.0 : 1.0, hair = 1e-9 * fabs(speed) + 1e-9;
        struct exact_state a =
            solution->class->sample(solution->solved, side, at + speed + outward * hair, 1.0);
        struct exact_state b =
            solution->class->sample(solution->solved, side, at + speed - outward * hair, 1.0);
        double flux = a.density * (a.velocity - speed), largest = largest_speed(solution);
        double density = maximum(a.density, b.density);
        double load = fabs(a.stress) + fabs(b.stress) + density * square(largest);
        assert_near(b.density * (b.velocity - speed), flux, density * largest, 1e-14);
        assert_near(flux * a.velocity - a.stress, flux * b.velocity - b.stress, load, 1e-14);
        double before = flux * (a.energy + 0.5 * square(a.velocity)) - a.stress * a.velocity;
        double after = flux * (b.energy + 0.5 * square(b.velocity)) - b.stress * b.velocity;
        assert_near(before, after, load * largest, 1e-14);
    }
}

/* Inside a fan the self-similar equations of motion hold: differences of three samples. */
static inline void assert_fans_flow(const struct solution *solution)
{
    for (int i = 0; i + 1 < solution->count; i++) {
        const struct exact_number *head = &solution->numbers[i], *tail = head + 1;
        if (!ends(head->name, " head speed") || fabs(head->value - tail->value) < 1e-3)
            continue;
        enum exact_side side = head->name[0] == 'l' ? SIDE_LEFT : SIDE_RIGHT;
        double at = solution->class->contact(solution->solved, 0.0);
        double speed = 0.5 * (head->value + tail->value);
        double step = 1e-3 * (head->value - tail->value);
        struct exact_state low, mid, high;
        low = solution->class->sample(solution->solved, side, at + speed - step, 1.0);
        mid = solution->class->sample(solution->solved, side, at + speed, 1.0);
        high = solution->class->sample(solution->solved, side, at + speed + step, 1.0);
        double flux = mid.density * (mid.velocity - speed), du = high.velocity - low.velocity;
        assert_near((mid.velocity - speed) * (high.density - low.density), -mid.density * du,
                    fabs(mid.density * du), 2e-5);
        assert_near(flux * du, high.stress - low.stress, fabs(flux * du), 2e-5);
        assert_near(flux * (high.energy - low.energy), mid.stress * du,
                    fabs(mid.stress * du) + 1e-6 * fabs(flux * speed * du), 2e-5);
        /* The fan joins its neighbours without a jump. */
        double ends_of_fan[2] = {head->value, tail->value};
        for (int end = 0; end < 2; end++) {
            double place = at + ends_of_fan[end], hair = 1e-7 * step;
            struct exact_state a, b;
            a = solution->class->sample(solution->solved, side, place - hair, 1.0);
            b = solution->class->sample(solution->solved, side, place + hair, 1.0);
            assert_near(a.velocity, b.velocity, fabs(speed) + fabs(du), 1e-8);
            assert_near(a.density, b.density, a.density, 1e-8);
        }
    }
}

/* Both sides of the contact move and push alike, and far from it nothing has happened. */
static inline void assert_contact_balanced(const struct solution *solution)
{
    struct exact_state left = solution->class->star(solution->solved, SIDE_LEFT);
    struct exact_state right = solution->class->star(solution->solved, SIDE_RIGHT);
    assert_true(left.velocity == right.velocity);
    assert_true(left.stress == right.stress);
    double place = solution->class->contact(solution->solved, 1.0);
    struct exact_state seen = solution->class->sample(solution->solved, SIDE_LEFT, place, 1.0);
    assert_memory_equal(&seen, &left, sizeof seen);
    /* A particle of the left that drifted past the contact is still judged as one of the left. */
    seen = solution->class->sample(solution->solved, SIDE_LEFT, place + 1.0, 1.0);
    assert_memory_equal(&seen, &left, sizeof seen);
    struct exact_state start = solution->class->sample(solution->solved, SIDE_RIGHT, 1.0, 0.0);
    seen = solution->class->sample(solution->solved, SIDE_RIGHT, 1e30, 1.0);
    assert_memory_equal(&seen, &start, sizeof seen);
}

/* MIRROR solves the mirror image of the problem of SOLUTION: the same bits, but for the signs. */
static inline void assert_mirrored(const struct solution *solution, const struct solution *mirror)
{
    double at = solution->class->contact(solution->solved, 0.0);
    double reach = 0.0;
    for (int i = 0; i < solution->count; i++)
        if (ends(solution->numbers[i].name, " speed"))
            reach = maximum(reach, 1.2 * fabs(solution->numbers[i].value));
    for (int i = -50; i <= 50; i++) {
        double offset = reach * i / 50.0;
        enum exact_side side = i < 0 ? SIDE_LEFT : SIDE_RIGHT;
        enum exact_side other = i < 0 ? SIDE_RIGHT : SIDE_LEFT;
        struct exact_state a = solution->class->sample(solution->solved, side, at + offset, 1.0);
        struct exact_state b = mirror->class->sample(mirror->solved, other, -at - offset, 1.0);
        b.velocity = -b.velocity;
        assert_true(a.density == b.density && a.velocity == b.velocity &&
                    a.pressure == b.pressure && a.energy == b.energy && a.stress == b.stress &&
                    a.deviator == b.deviator);
    }
}

/* A linear congruential sequence in [0, 1), so that the random cases are the same everywhere. */
static inline double draw(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static inline double draw_between(uint64_t *seed, double low, double high)
{
    return low + (high - low) * draw(seed);
}

#endif
