/* Particles of the plane that have a depth: a ring of radius r in axisymmetry (x = r, y = z, mass
 * per radian), or a plate that thins under plane stress. The pair sums know of it by the depth in
 * the records alone; what it adds to a particle by itself is here. */
#include "material/any.h"
#include "sph/scheme.h"

/* Of the equation of motion per radian, m dU/dt = ... - A sigma_tt g e_r with the g of the pair
 * sums: a uniform pressure is then balanced as well as in plane strain. The hoop stress does no
 * work on E + U^2/2. */
void sph_add_hoop(const struct sph *sph, const struct simulation *simulation,
                  const struct sph_fields *f, const double *stress)
{
    const struct particles *p = sph->particles;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        const struct ring ring = sph_ring(p, i);
        const double acts =
            stress ? stress[i]
                   : p->deviator[i][2] - p->pressure[i] - (f->viscosity ? f->viscosity[i] : 0.0);
        double pull = -acts * f->rates.hoop_pull[i] / (p->density[i] * ring.depth);
        f->rates.acceleration[i][0] += pull;
        f->rates.power[i] -= p->velocity[i][0] * pull;
        /* the radius grows as the particle moves, which may be with its contacts' velocity */
        double velocity = p->velocity[i][0] + sph->ahead * f->rates.acceleration[i][0] +
                          (f->rates.drift ? f->rates.drift[i][0] : 0.0);
        f->rates.strain_rate[i][2] =
            f->rates.hoop_strain[i] * ring_hoop_rate(ring, velocity, f->rates.strain_rate[i][0]);
        f->rates.hoop_pull[i] = pull;
    }
}

struct response sph_thin_step(const struct material *material, double divergence,
                              struct point *point, struct motion *motion, double *thickness)
{
    const struct point start = *point;
    struct response r = any_material_evaluate(material, point);
    const double modulus = start.density * square(r.sound_long), filled = motion->density;
    double rate = -divergence * (1.0 - 2.0 * r.shear_modulus / modulus);
    double slope = motion->dt * modulus, last_rate = 0.0, last_stress = 0.0;
    for (int round = 0; round < 60; round++) {
        double change = motion->dt * (divergence + rate);
        *point = start;
        motion->density = start.density * (2.0 - change) / (2.0 + change);
        motion->strain_rate.zz = rate;
        r = any_material_step(material, point, motion);
        double stress = point->deviator.zz - point->pressure;
        if (fabs(stress) <= 1e-14 * modulus) {
            *thickness *= filled / point->density;
            return r;
        }
        double secant = (stress - last_stress) / (rate - last_rate);
        if (round > 0 && secant > 0.0 && isfinite(secant))
            slope = secant;
        last_rate = rate;
        last_stress = stress;
        rate -= stress / slope;
    }
    r.status |= POINT_OUT_OF_RANGE | POINT_NO_SOUND;
    return r;
}
