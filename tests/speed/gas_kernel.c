/* The sweeps of gas rows for one instruction set, named by BOLIDE_ISA; see gas_kernel.h. */
#include "gas_kernel.h"

#include "base/isa.h"

ISA_KERNEL(void, gas_lax_wendroff, struct gas_row *row, const struct lax_wendroff *scheme, double r,
           struct gas_numbers *flux)
{
    row_lax_wendroff(row, scheme, r, flux);
}

ISA_KERNEL(void, gas_muscl_hancock, struct gas_row *row, double r, struct gas_numbers *flux)
{
    row_muscl_hancock(row, r, flux);
}
