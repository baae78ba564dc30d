/* The functions of material.h for callers that do not inline them. */
#include "material/any.h"

#include "material/material.h"

struct response any_material_evaluate(const struct material *material, struct point *point)
{
    return material_evaluate(material, point);
}

struct response any_material_step(const struct material *material, struct point *point,
                                  const struct motion *motion)
{
    return material_step(material, point, motion);
}
