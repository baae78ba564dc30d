/* How a particle deforms in a step. */
#ifndef BOLIDE_SPH_DEFORM_H
#define BOLIDE_SPH_DEFORM_H

#include "base/vector.h"

/* The sums measure the gradient A of velocity in places at level n, so that these deform by F = 1 +
 * dt A in a step. Returns det F, and turns the parts of A into those of ln F / dt, to second order.
 */
BOLIDE_INLINE double sph_deform(double dt, struct sym3 *strain_rate, struct vec3 *spin)
{
    struct sym3 e = sym3_scale(dt, *strain_rate);
    struct vec3 w = vec3_scale(dt, *spin);
    double xy = e.xy - w.z, yx = e.xy + w.z, yz = e.yz - w.x, zy = e.yz + w.x, zx = e.zx - w.y,
           xz = e.zx + w.y;
    /* the rows of A squared */
    double aa[3][3] = {{e.xx * e.xx + xy * yx + xz * zx, e.xx * xy + xy * e.yy + xz * zy,
                        e.xx * xz + xy * yz + xz * e.zz},
                       {yx * e.xx + e.yy * yx + yz * zx, yx * xy + e.yy * e.yy + yz * zy,
                        yx * xz + e.yy * yz + yz * e.zz},
                       {zx * e.xx + zy * yx + e.zz * zx, zx * xy + zy * e.yy + e.zz * zy,
                        zx * xz + zy * yz + e.zz * e.zz}};
    double half = 0.5 / dt, quarter = 0.25 / dt;
    strain_rate->xx -= half * aa[0][0];
    strain_rate->yy -= half * aa[1][1];
    strain_rate->zz -= half * aa[2][2];
    strain_rate->xy -= quarter * (aa[0][1] + aa[1][0]);
    strain_rate->yz -= quarter * (aa[1][2] + aa[2][1]);
    strain_rate->zx -= quarter * (aa[2][0] + aa[0][2]);
    spin->x -= quarter * (aa[2][1] - aa[1][2]);
    spin->y -= quarter * (aa[0][2] - aa[2][0]);
    spin->z -= quarter * (aa[1][0] - aa[0][1]);
    double x = 1.0 + e.xx, y = 1.0 + e.yy, z = 1.0 + e.zz;
    return x * (y * z - yz * zy) - xy * (yx * z - yz * zx) + xz * (yx * zy - y * zx);
}

#endif
