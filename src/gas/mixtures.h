/* The mixtures (mixture.h) at some places of a row, packed one a lane: few cells of a row have both
 * materials. For files that are compiled once an instruction set. */
#ifndef BOLIDE_GAS_MIXTURES_H
#define BOLIDE_GAS_MIXTURES_H

#include "base/lanes.h"
#include "gas/mixture.h"

/* Cells of a row at most, and those known beyond either end of it. */
enum { ROW_CELLS = 64, ROW_GHOSTS = 4, ROW_ROOM = ROW_CELLS + 2 * ROW_GHOSTS };

struct mixtures {
    int count, place[ROW_ROOM];                      /* places in the row */
    double density[2][ROW_ROOM], fraction[ROW_ROOM]; /* given, of both and of the second */
    double burnt[2][ROW_ROOM], energy[ROW_ROOM];     /* given; energy: rho e */
    double weight[2][ROW_ROOM], cold[2][ROW_ROOM], slope[2][ROW_ROOM], rise[2][ROW_ROOM],
        ratio[2][ROW_ROOM]; /* as in struct mixture_part */
    double pressure[ROW_ROOM];
};

/* Place K becomes the next, with DENSITY of each material, FRACTION of the second and ENERGY. */
BOLIDE_INLINE void mixtures_add(struct mixtures *of, int k, const double density[2],
                                double fraction, const double burnt[2], double energy)
{
    const int i = of->count++;
    of->place[i] = k;
    for (int m = 0; m < 2; m++) {
        of->density[m][i] = density[m];
        of->burnt[m][i] = burnt[m];
    }
    of->fraction[i] = fraction;
    of->energy[i] = energy;
}

BOLIDE_INLINE struct mixture mixtures_at(const struct mixtures *of, int i)
{
    struct mixture mixture;
    for (int m = 0; m < 2; m++) {
        const struct mixture_part part = {of->density[m][i], of->weight[m][i], of->cold[m][i],
                                          of->slope[m][i],   of->rise[m][i],   of->ratio[m][i]};
        mixture.part[m] = part;
    }
    mixture.density =
        (1.0 - of->fraction[i]) * of->density[0][i] + of->fraction[i] * of->density[1][i];
    return mixture;
}

/* Material M, of EOS, of the first COUNT. */
static inline void mixtures_find_part(struct mixtures *of, const struct eos *eos, int m, int count)
{
    const double none[POINT_HISTORY] = {0.0}, *density = of->density[m], *burnt = of->burnt[m];
    switch (eos->kind) {
#define MIXTURES_CASE(name)                                                                  \
    case EOS_##name:                                                                         \
        for (int i = 0; i < count; i++) {                                                    \
            const double fraction = m ? of->fraction[i] : 1.0 - of->fraction[i];             \
            const struct mixture_part part =                                                 \
                mixture_part_from(eos_##name(&eos->of.name, density[i], 0.0, none),          \
                                  eos_##name(&eos->of.name, density[i], MIXTURE_WARM, none), \
                                  density[i], fraction, burnt[i]);                           \
            of->weight[m][i] = part.weight;                                                  \
            of->cold[m][i] = part.cold;                                                      \
            of->slope[m][i] = part.slope;                                                    \
            of->rise[m][i] = part.rise;                                                      \
            of->ratio[m][i] = part.ratio;                                                    \
        }                                                                                    \
        break;
        EOS_STATELESS(MIXTURES_CASE)
#undef MIXTURES_CASE
    default:
        break;
    }
}

/* Finds the mixtures that were added, of EOS, and their pressures. Lanes after the last one repeat
 * it, so that loops are whole vectors; returns the number of all. */
APART int mixtures_find(struct mixtures *of, const struct eos *const eos[2])
{
    enum { WIDTH = 8 };
    if (of->count == 0)
        return 0;
    const int count = of->count, all = (count + WIDTH - 1) / WIDTH * WIDTH;
    for (int i = count; i < all; i++) {
        for (int m = 0; m < 2; m++) {
            of->density[m][i] = of->density[m][count - 1];
            of->burnt[m][i] = of->burnt[m][count - 1];
        }
        of->fraction[i] = of->fraction[count - 1];
        of->energy[i] = of->energy[count - 1];
    }
    for (int m = 0; m < 2; m++)
        mixtures_find_part(of, eos[m], m, all);
    for (int i = 0; i < all; i++) {
        const struct mixture mixture = mixtures_at(of, i);
        of->pressure[i] = mixture_pressure(&mixture, of->energy[i]);
    }
    return all;
}

#endif
