/* Chooses the step of batch_run.h for the processor that it runs on. */
#include "base/isa.h"
#include "material/batch_run.h"

ISA_CHOOSE(void, batch_run,
           (const struct material *material, struct batch *batch, enum batch_energy energy),
           (material, batch, energy))
