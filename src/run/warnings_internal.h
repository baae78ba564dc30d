/* The watch of a run; private to warnings*.c. */
#ifndef BOLIDE_RUN_WARNINGS_INTERNAL_H
#define BOLIDE_RUN_WARNINGS_INTERNAL_H

#include "run/warnings.h"

/* Densities at which the energy of 0 K is tabulated, in steps of this fraction of the reference
 * density. */
enum { COLDEST = 256 };
#define COLDEST_STEP 0.02

struct material_watch {
    double limit[WARNING_ENERGY]; /* INFINITY: none */
    bool estimated;               /* the tension: no strength is known */
    bool warm;                    /* it has a temperature */
    double coldest[COLDEST];      /* J/kg */
};

/* Memory M * WARNING_ENERGY + KIND is that of KIND in material M, the last that of the energy. */
struct warnings {
    int materials, memories;
    struct material_watch *watch;
    struct warning_memory *memory;
    bool *held;   /* by body: it has a prescribed motion */
    double speed; /* the largest that needs no warning, so far, m/s */
};

/* "tension in copper", and the whole line, of memory INDEX. Owned by the caller; NULL when memory is
 * out. */
char *warning_name(const struct warnings *warnings, const struct simulation *simulation, int index);
char *warning_text(const struct warnings *warnings, const struct simulation *simulation, int index);

#endif
