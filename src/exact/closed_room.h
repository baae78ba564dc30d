/* The gas of a closed room in which an explosive has burnt, in chemical equilibrium; see
 * material/equilibrium.h. */
#ifndef BOLIDE_EXACT_CLOSED_ROOM_H
#define BOLIDE_EXACT_CLOSED_ROOM_H

#include "base/parameter.h"
#include "exact/exact.h"
#include "material/composition.h"

struct exact_closed_room {
    char *explosive;              /* its name */
    double load;                  /* kg/m^3 */
    double pressure, temperature; /* of the air before, Pa, K */
    struct composition of;        /* of the explosive, taken before it is solved */
};

extern const struct parameter exact_closed_room_table[];
extern const struct exact_class exact_closed_room_class;

#endif
