/* A ring of cells of two materials for tests of sweeps, cut into rows whose ghosts are the cells of
 * the next ones. */
#ifndef BOLIDE_TESTS_RING_H
#define BOLIDE_TESTS_RING_H

#include "gas/gas_internal.h"
#include "gas/muscl_hancock.h"

enum { CELLS = 200, NUMBERS = GAS_NUMBERS + PARTS };

struct ring {
    struct eos eos[2];
    bool liquid;
    double floor[2];
    double speed; /* of all of it at the start, m/s */
    double u[NUMBERS][CELLS];
};

/* rho e, J/m^3, at a PRESSURE. */
static inline double mixture_energy(const struct mixture *mixture, double pressure)
{
    const struct mixture_part *part = mixture->part;
    return part[0].weight * (pressure - part[0].cold) + part[1].weight * (pressure - part[1].cold);
}

/* Gives cell C a state at DENSITY of both materials, FRACTION of the second. */
static inline void ring_put(struct ring *ring, int c, const double density[2], double fraction,
                            double pressure, double speed)
{
    const struct eos *const eos[2] = {&ring->eos[0], &ring->eos[1]};
    const double whole[2] = {1.0, 1.0};
    const struct mixture mixture = mixture_of(eos, density, fraction, whole);
    ring->u[GAS_DENSITY][c] = mixture.density;
    ring->u[GAS_MOMENTUM][c] = mixture.density * speed;
    ring->u[GAS_ENERGY][c] =
        mixture_energy(&mixture, pressure) + 0.5 * mixture.density * square(speed);
    ring->u[GAS_NUMBERS + PART_MASS][c] = fraction * density[1];
    ring->u[GAS_NUMBERS + PART_FRACTION][c] = fraction;
}

/* The second material in a quarter of the ring, at DENSITY of both. */
static inline void ring_fill(struct ring *ring, const double density[2], double pressure)
{
    for (int c = 0; c < CELLS; c++)
        ring_put(ring, c, density,
                 c == 50             ? 0.3
                 : c > 50 && c < 100 ? 1.0
                                     : 0.0,
                 pressure, ring->speed);
}

/* A sweep in rows of ROWS cells at most. */
static inline void ring_sweep(struct ring *ring, int rows, double r)
{
    struct ring next = *ring;
    for (int first = 0; first < CELLS; first += rows) {
        struct gas_row row = {.closure = {.eos = &ring->eos[0],
                                          .other = &ring->eos[1],
                                          .liquid = ring->liquid,
                                          .floor = {ring->floor[0], ring->floor[1]}}};
        struct gas_numbers flux;
        row.cells = CELLS - first < rows ? CELLS - first : rows;
        FOR_ROW (k, -2, row.cells + 1) {
            const int c = (first + k - ROW_GHOSTS + CELLS) % CELLS;
            for (int n = 0; n < NUMBERS; n++)
                *(n < GAS_NUMBERS ? &row.u.of[n][k] : &row.part[n - GAS_NUMBERS][k]) =
                    ring->u[n][c];
        }
        row_muscl_hancock(&row, r, &flux);
        FOR_ROW (k, 0, row.cells - 1)
            for (int n = 0; n < NUMBERS; n++)
                next.u[n][first + k - ROW_GHOSTS] =
                    n < GAS_NUMBERS ? row.u.of[n][k] : row.part[n - GAS_NUMBERS][k];
    }
    *ring = next;
}

static inline double ring_sum(const struct ring *ring, int n)
{
    double sum = 0.0;
    for (int c = 0; c < CELLS; c++)
        sum += ring->u[n][c];
    return sum;
}

#endif
