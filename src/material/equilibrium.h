/* The chemical equilibrium of an explosive that has burnt in the air of a closed room, at constant
 * volume and energy. */
#ifndef BOLIDE_EQUILIBRIUM_H
#define BOLIDE_EQUILIBRIUM_H

#include "material/composition.h"

/* What a room holds at the start. */
struct room {
    double load, air;   /* kg of explosive and of air over the volume, kg/m^3 */
    double temperature; /* of the air, K */
};

struct room_gas {
    double pressure, temperature; /* Pa, K */
};

/* The density, kg/m^3, of air as an ideal gas, and its temperature, K. */
double equilibrium_density_of_air(double pressure, double temperature);
double equilibrium_temperature_of_air(double pressure, double density);

/* The gas of ROOM in equilibrium. Air must be there. */
struct room_gas equilibrium_of_room(const struct composition *explosive, const struct room *room);

#endif
