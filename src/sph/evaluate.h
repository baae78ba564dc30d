/* A particle as it stands, by its material. Apart from scheme.h, so that few files need all
 * materials. */
#ifndef BOLIDE_SPH_EVALUATE_H
#define BOLIDE_SPH_EVALUATE_H

#include "material/any.h"
#include "material/material.h"
#include "sph/scheme.h"

/* Pressure and sound speeds of particle I as it stands; returns what its material says of them. */
BOLIDE_INLINE struct response sph_evaluate_point(struct simulation *simulation,
                                                 const struct sph_fields *f, int32_t i)
{
    struct particles *p = f->particles;
    struct point point = {.density = p->density[i], .energy = p->energy[i]};
    particle_load_history(p, i, point.history);
    struct response r =
        any_material_evaluate(&simulation->problem->material[p->material[i]], &point);
    p->pressure[i] = point.pressure;
    f->sound_long[i] = r.sound_long;
    f->sound_shear[i] = r.sound_shear;
    return r;
}

#endif
