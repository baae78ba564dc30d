/* The gates of a coupling, faces of cells in the open faces of the region, and the cells of gas on
 * both sides of them. Private to couple/. */
#ifndef BOLIDE_GATES_H
#define BOLIDE_GATES_H

#include "couple/cfdmp.h"

/* The axes across AXIS, the lower first, by which the gates of a face are numbered. */
void gate_axes(int axis, int across[2]);

/* The cell behind gate NUMBER of the face across AXIS on SIDE, INSIDE the region or outside. */
void gate_cell(const struct cfdmp *cfdmp, int axis, int side, int64_t number, bool inside,
               int64_t at[3]);

/* The area of gate NUMBER, of a radian in axisymmetry. */
double gate_area(const struct cfdmp *cfdmp, int axis, int side, int64_t number);

/* The mean of the cells on both sides of a gate, as cfdmp_look has found them; the densities of
 * both materials where they are, 0 where there is none. */
struct beside {
    double density, velocity[3], energy, sound, pressure, of[2];
};
struct beside gate_beside(const struct cfdmp *cfdmp, int axis, int side, int64_t number);

/* Materials at one pressure, where each has MASS, DENSITY and a pressure that grows in proportion
 * to its energy: that pressure, from their ENERGY together, and of each what it has without energy
 * and the slope by its specific energy; as gas/mixture.h has it, without its bounds. A mass may be
 * zero. */
struct shared {
    double pressure, cold[2], slope[2];
};
struct shared gate_share(const struct gas_view *view, const double mass[2], const double density[2],
                         double energy);

/* Adds REST, conserved, to the cell AT outside a gate; materials have the densities OF, 0 where
 * they are not known. REST becomes what the cell cannot bear at once: it takes all, a half, a
 * quarter and so on. On ranks that do not have the cell it becomes zero. */
void gate_give(struct cfdmp *cfdmp, const struct gas_view *view, const int64_t at[3],
               double rest[PASSES], const double of[2]);

/* Collective: particles that have left the region wait at the gates that they cover, taken in the
 * order of their ids. */
struct error *cfdmp_take_out(struct cfdmp *cfdmp);

/* Neighbouring gates through which material leaves exchange what waits there, in a step of DT, see
 * even.c. Uses the `rest` of the sides. */
void cfdmp_even_out(struct cfdmp *cfdmp, double dt);

#endif
