/* Exact solutions that results are measured against. Each is a choice of the catalogue's kind
 * "exact": its parameters come from a table, and its thing is a struct exact_class. */
#ifndef BOLIDE_EXACT_H
#define BOLIDE_EXACT_H

#include <stdio.h>

#include "base/error.h"
#include "exact/blast_wave.h"

/* The state of a one-dimensional solution at a place and time. SI units. Stress is positive in
 * tension along x; deviator is its S_xx part. */
struct exact_state {
    double density, velocity, pressure, energy, stress, deviator, temperature, burnt;
};

/* Which material a point belongs to: an exact solution keeps its contact between SIDE_LEFT and
 * SIDE_RIGHT, so that a particle is compared with its own material's state wherever it drifted. */
enum exact_side { SIDE_LEFT, SIDE_RIGHT };

/* A number of the solution with a name, for tables: {"star pressure", "Pa", 1.8e4}. */
struct exact_number {
    const char *name, *unit;
    double value;
};

enum { EXACT_NUMBERS = 40 };

enum exact_known { EXACT_ALL, EXACT_PRESSURE, EXACT_NO_FIELD };

enum { EXACT_MATERIALS = 2 };

struct vector_value;
struct material;

struct exact_class {
    size_t size;  /* of the solved problem */
    bool thermal; /* its states are of a body at rest: temperature alone; others have none */
    bool burns;   /* its states have the fraction burnt, and a temperature */
    /* Where PARAMETERS may name materials, EXACT_MATERIALS at most: the name of that at INDEX and
     * the path of its KEY, NULL where none is named, and what takes its models before `solve`.
     * NULL: they name none. */
    const char *(*material_name)(const void *parameters, int index, const char **key);
    void (*take_material)(void *parameters, int index, const struct material *material);
    /* Solves the problem of PARAMETERS (the choice's struct). ERROR_INPUT when it has no solution
     * of the kind (vacuum, say). */
    struct error *(*solve)(const void *parameters, void *solved);
    /* The state at X and TIME (measured from the start, x in the frame of the case) on SIDE. In a
     * solution with a centre x is the distance from it. */
    struct exact_state (*sample)(const void *solved, enum exact_side side, double x, double time);
    /* The star state beside the contact; NULL: there is no contact. */
    struct exact_state (*star)(const void *solved, enum exact_side side);
    /* Fills at most EXACT_NUMBERS named numbers; returns how many. TIME > 0 adds the places of
     * fronts. */
    int (*numbers)(const void *solved, double time, struct exact_number *numbers);
    /* Place of the contact, or of the front of a wave, at TIME; NULL: there is none, but a
     * centre. */
    double (*contact)(const void *solved, double time);
    /* Blasts. Which fields the samples have: all unless it says less. */
    enum exact_known known;
    /* Where the charge is; NULL: at the origin. */
    const struct vector_value *(*center)(const void *solved);
    /* The wave that passes at DISTANCE from the centre; what the solution does not have is NAN. */
    struct blast_wave (*blast)(const void *solved, double distance);
    /* Distance of the front from the centre at TIME; NAN where that is unknown. */
    double (*front)(const void *solved, double time);
};

/* On which side of the contact X lies at TIME; left where there is no contact. */
static inline enum exact_side exact_side_at(const struct exact_class *exact, const void *solved,
                                            double x, double time)
{
    return !exact->contact || x < exact->contact(solved, time) ? SIDE_LEFT : SIDE_RIGHT;
}

#endif
