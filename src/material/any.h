/* A point of any material: the functions of material.h compiled once, for callers where a call costs
 * little. What is inlined has the physics of every model in it, and takes seconds to compile. */
#ifndef BOLIDE_MATERIAL_ANY_H
#define BOLIDE_MATERIAL_ANY_H

#include "material/point.h"

struct material;

struct response any_material_evaluate(const struct material *material, struct point *point);
struct response any_material_step(const struct material *material, struct point *point,
                                  const struct motion *motion);
struct response any_material_step_by_work(const struct material *material, struct point *point,
                                          const struct motion *motion);

#endif
