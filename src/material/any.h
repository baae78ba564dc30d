/* A point of any material: functions of material.h compiled once, for callers where a call costs
 * little. Inlined, they bring the physics of every model, which takes seconds to compile. */
#ifndef BOLIDE_MATERIAL_ANY_H
#define BOLIDE_MATERIAL_ANY_H

#include "material/point.h"

struct material;

struct response any_material_evaluate(const struct material *material, struct point *point);
struct response any_material_step(const struct material *material, struct point *point,
                                  const struct motion *motion);

#endif
