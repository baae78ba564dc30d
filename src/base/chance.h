/* Numbers that look random and follow from what they are of alone, so that they are the same in any
 * order, on any thread and rank. */
#ifndef BOLIDE_CHANCE_H
#define BOLIDE_CHANCE_H

#include "base/base.h"

/* The finaliser of splitmix64: every bit of WORD reaches every bit of the result. */
BOLIDE_INLINE uint64_t mix_bits(uint64_t word)
{
    word = (word ^ word >> 30) * 0xbf58476d1ce4e5b9u;
    word = (word ^ word >> 27) * 0x94d049bb133111ebu;
    return word ^ word >> 31;
}

/* A number above zero and below one, evenly distributed, that ID and SEED decide. */
BOLIDE_INLINE double chance_of(uint64_t id, uint64_t seed)
{
    const uint64_t bits = mix_bits(mix_bits(seed * 0x9e3779b97f4a7c15u + 1) ^ id);
    return ((double)(bits >> 12) + 0.5) * 0x1p-52;
}

#endif
