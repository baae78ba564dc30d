/* Wall-clock seconds for phases and progress; never part of a result. */
#ifndef BOLIDE_CLOCK_H
#define BOLIDE_CLOCK_H

#include <time.h>

#include "base/base.h"

/* Seconds since an arbitrary moment, monotonic. */
BOLIDE_INLINE double clock_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
