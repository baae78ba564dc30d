/* What a blast engineer reads from the pressure that a gauge records. */
#ifndef BOLIDE_BLAST_RECORD_H
#define BOLIDE_BLAST_RECORD_H

#include "exact/blast_wave.h"

/* The blast wave in COUNT pressures at growing times over the pressure AMBIENT (NAN: the first
 * one). It arrives when the overpressure first reaches half its peak, which is where a shock is
 * that the grid has smeared. The positive phase ends where the overpressure first falls to zero
 * after the peak; a record that ends before has neither duration nor impulse. NAN for what there is
 * not. */
struct blast_wave blast_record(const double *time, const double *pressure, int64_t count,
                               double ambient);

#endif
