/* The step of a batch for those who do not inline the physics of all materials: compiled once an
 * instruction set (batch_kernel.c). */
#ifndef BOLIDE_BATCH_RUN_H
#define BOLIDE_BATCH_RUN_H

#include "material/strength/common.h"

struct material;

/* Takes the points of BATCH, of MATERIAL, which batches must take, through a step: see batch_step
 * in batch.h. */
void batch_run(const struct material *material, struct batch *batch, enum batch_energy energy);

#endif
