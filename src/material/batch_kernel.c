/* The step of a batch for one instruction set, named by BOLIDE_ISA; see batch_run.h. */
#include "base/isa.h"
#include "material/batch.h"

ISA_KERNEL(void, batch_run, const struct material *material, struct batch *batch,
           enum batch_energy energy)
{
    if (energy == ENERGY_GIVEN)
        batch_step(material, batch, ENERGY_GIVEN);
    else
        batch_step(material, batch, ENERGY_BY_WORK);
}
