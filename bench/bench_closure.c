/* Closures of an explosive and its products a second, on one core: random states of PETN between
 * its spike and the expanded products, each from the volume of the explosive a little before, as in
 * a run, and from none.
 *
 * Usage: bench_closure */
#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "base/clock.h"
#include "material/material.h"

enum { STATES = 4096, ROUNDS = 100, REPEATS = 5 };

struct mixed {
    double total, energy, burnt, explosive; /* volumes and J/m^3 of the explosive at rest */
};

static double between(uint64_t *state, double low, double high)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * ((double)(*state >> 11) * 0x1p-53);
}

/* States near the Rayleigh line and the isentrope, with the volume of the explosive in each. */
static void fill(const struct eos_reactive_jwl *jwl, struct mixed *states)
{
    uint64_t dice = 7;
    for (int k = 0; k < STATES;) {
        struct mixed s = {.total = between(&dice, 0.6, 1.2), .burnt = between(&dice, 0.01, 0.99)};
        s.energy = between(&dice, 0.5, 1.5) * 1.22e11 * pow(maximum(1.0 - s.total, 0.1), 2.0) / 2.0;
        const struct jwl_closure closure = reactive_jwl_close(jwl, s.total, s.energy, s.burnt, 0.0);
        if (!closure.found)
            continue;
        s.explosive = closure.volume[s.burnt < 0.5 ? 1 : 0];
        states[k++] = s;
    }
}

/* The fastest of REPEATS, each guess FACTOR times the volume of the explosive. */
static double rate(const struct eos_reactive_jwl *jwl, const struct mixed *states, double factor)
{
    static volatile double sink;
    double best = INFINITY;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        const double begin = clock_seconds();
        double sum = 0.0;
        for (int round = 0; round < ROUNDS; round++)
            for (int k = 0; k < STATES; k++) {
                double last = factor * states[k].explosive;
                sum += reactive_jwl_state(jwl, jwl->density / states[k].total,
                                          states[k].energy / jwl->density, states[k].burnt, &last)
                           .pressure;
            }
        sink = sum;
        (void)sink;
        best = minimum(best, clock_seconds() - begin);
    }
    return (double)STATES * ROUNDS / best;
}

int main(void)
{
    static const struct eos_reactive_jwl petn = EOS_reactive_jwl_SAMPLE;
    static struct mixed states[STATES];
    fill(&petn, states);
    printf("two-phase JWL, one core\n");
    printf("  %-40s %8.3f M closures/s\n", "from a volume 1 % off",
           1e-6 * rate(&petn, states, 1.01));
    printf("  %-40s %8.3f M closures/s\n", "from none", 1e-6 * rate(&petn, states, 0.0));
    return 0;
}
