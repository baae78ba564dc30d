/* The pair sums written straight from the formulas, slowly: rotation into the axes R, S, T of each
 * pair, contact values component by component, and rotation back. It judges the fast loop. Source:
 * Parshikov (2013), (1.5), (1.19), (1.31)-(1.40), (1.56), (1.58), (1.72)-(1.78), (2.52)-(2.54);
 * depths and spins: docs/sph.md. */
#ifndef BOLIDE_TEST_NAIVE_PAIRS_H
#define BOLIDE_TEST_NAIVE_PAIRS_H

#include <string.h>

#include "model/particles/population.h"
#include "riemann/dukowicz.h"
#include "riemann/exact_gas.h"
#include "sph/contact/kernel.h"

/* One side of a pair, images already reflected. */
struct naive_particle {
    double mass, density, diameter, x[3], u[3], stress[3][3], z_long, z_shear, shock_slope;
    double bears[2]; /* along a contact and across it, where contacts break */
    double depth,
        spin[3]; /* one and zero where the kind has none; behind an axis the depth is negative */
};

/* The sums for one particle, and beside each number the sum of the magnitudes of its terms. */
struct naive_sums {
    double acceleration[3], acceleration_size;
    double wall[3];
    double power, power_size;
    double gradient[3][3], spin[3], gradient_size;
    double weight, drift[3], broken;
    double hoop_pull, hoop_outside, hoop_inside, hoop_size;
};

static inline double naive_slope(double r, double h, int dimension)
{
    static const double pi = 3.14159265358979323846;
    double phi = r / h;
    double n1 = dimension == 1   ? 6.0 * h * h
                : dimension == 2 ? 2.8 * pi * h * h * h
                                 : 4.0 * pi * h * h * h * h;
    if (phi < 1.0)
        return (-12.0 * phi + 9.0 * phi * phi) / n1;
    return phi < 2.0 ? -3.0 * (2.0 - phi) * (2.0 - phi) / n1 : 0.0;
}

/* (1.31): rows R, S, T. */
static inline void naive_axes(const double e[3], double a[3][3])
{
    double s = sqrt(e[0] * e[0] + e[1] * e[1]);
    double cos_theta = e[2], sin_theta = s;
    double cos_phi = s < 1e-12 ? 1.0 : e[0] / s, sin_phi = s < 1e-12 ? 0.0 : e[1] / s;
    double rows[3][3] = {{cos_phi * sin_theta, sin_phi * sin_theta, cos_theta},
                         {cos_phi * cos_theta, sin_phi * cos_theta, -sin_theta},
                         {-sin_phi, cos_phi, 0.0}};
    memcpy(a, rows, sizeof rows);
}

static inline void naive_turn(const double a[3][3], const double v[3], double turned[3])
{
    for (int k = 0; k < 3; k++)
        turned[k] = a[k][0] * v[0] + a[k][1] * v[1] + a[k][2] * v[2];
}

static inline void naive_turn_back(const double a[3][3], const double v[3], double turned[3])
{
    for (int k = 0; k < 3; k++)
        turned[k] = a[0][k] * v[0] + a[1][k] * v[1] + a[2][k] * v[2];
}

/* U* and sigma* of the three components R, S, T. U and SIGMA: of i and j. */
static inline void naive_contact(struct pair_kind kind, unsigned law,
                                 const struct naive_particle *i, const struct naive_particle *j,
                                 double u[2][3], double sigma[2][3], double u_star[3],
                                 double sigma_star[3], bool *broken)
{
    for (int k = 0; k < 3; k++) {
        double zi = k == 0 ? i->z_long : i->z_shear, zj = k == 0 ? j->z_long : j->z_shear;
        if (k == 0 && record_has_shock_slope(kind)) {
            struct side left = {zi, u[0][0], sigma[0][0], i->density, i->shock_slope};
            struct side right = {zj, u[1][0], sigma[1][0], j->density, j->shock_slope};
            struct contact contact = kind.star == STAR_DUKOWICZ ? riemann_dukowicz(left, right)
                                                                : riemann_exact_gas(left, right);
            u_star[0] = contact.velocity;
            sigma_star[0] = contact.stress;
        } else if (kind.star == STAR_MEAN) {
            u_star[k] = 0.5 * (u[0][k] + u[1][k]);
            sigma_star[k] = 0.5 * (sigma[0][k] + sigma[1][k]);
        } else if (zi + zj == 0.0) {
            u_star[k] = 0.5 * (u[0][k] + u[1][k]);
            sigma_star[k] = 0.0;
        } else {
            u_star[k] = (zj * u[1][k] + zi * u[0][k] + sigma[1][k] - sigma[0][k]) / (zj + zi);
            sigma_star[k] =
                (zi * sigma[1][k] + zj * sigma[0][k] + zi * zj * (u[1][k] - u[0][k])) / (zj + zi);
        }
    }
    bool opened = law & LAW_NO_TENSION && sigma_star[0] > 0.0;
    /* (2.52)-(2.54): the contact parts in tension, and slips where shear alone breaks it */
    const double *a = i->bears, *b = j->bears;
    const bool sheared = kind.breaks && hypot(sigma_star[1], sigma_star[2]) > fmin(a[1], b[1]);
    const bool torn =
        kind.breaks && (sigma_star[0] > fmin(a[0], b[0]) || (sheared && sigma_star[0] > 0.0));
    *broken = sheared || torn;
    opened |= torn;
    for (int k = 0; k < 3; k++) {
        double zi = k == 0 ? i->z_long : i->z_shear;
        bool free_surface = opened || (k > 0 && (law & LAW_SLIP || sheared));
        if (!free_surface || (k > 0 && !kind.shear))
            continue; /* a fluid's shear is free already */
        sigma_star[k] = 0.0;
        u_star[k] = zi > 0.0 ? u[0][k] - sigma[0][k] / zi : u[0][k];
    }
}

/* The velocity of SIDE at the point A where the pair meets. */
static inline void naive_at_contact(const struct naive_particle *side, const double a[3],
                                    double u[3])
{
    double arm[3];
    for (int k = 0; k < 3; k++)
        arm[k] = a[k] - side->x[k];
    for (int k = 0; k < 3; k++) {
        int b = (k + 1) % 3, c = (k + 2) % 3;
        u[k] = side->u[k] + side->spin[b] * arm[c] - side->spin[c] * arm[b];
    }
}

/* Adds the pair (i, j), seen by i. IMAGE: j is an image. */
static inline void naive_pair(struct pair_kind kind, double smoothing, unsigned law,
                              const struct naive_particle *i, const struct naive_particle *j,
                              bool image, struct naive_sums *sums)
{
    double h = smoothing * 0.5 * (i->diameter + j->diameter), r2 = 0.0, e[3];
    for (int k = 0; k < 3; k++)
        r2 += (j->x[k] - i->x[k]) * (j->x[k] - i->x[k]);
    double r = sqrt(r2);
    if (r >= 2.0 * h)
        return;
    for (int k = 0; k < 3; k++)
        e[k] = (j->x[k] - i->x[k]) / r;
    double a[3][3], u[2][3], traction[2][3], sigma[2][3], turned_u[3], turned_sigma[3];
    naive_axes(e, a);
    double meet[3], met_i[3], met_j[3];
    for (int k = 0; k < 3; k++)
        meet[k] = i->x[k] + r * e[k] * i->diameter / (i->diameter + j->diameter);
    naive_at_contact(i, meet, met_i);
    naive_at_contact(j, meet, met_j);
    naive_turn(a, met_i, u[0]);
    naive_turn(a, met_j, u[1]);
    naive_turn(i->stress, e, traction[0]);
    naive_turn(j->stress, e, traction[1]);
    naive_turn(a, traction[0], sigma[0]);
    naive_turn(a, traction[1], sigma[1]);
    bool broken;
    naive_contact(kind, law, i, j, u, sigma, turned_u, turned_sigma, &broken);
    double u_star[3], sigma_star[3];
    naive_turn_back(a, turned_u, u_star);
    naive_turn_back(a, turned_sigma, sigma_star);

    double slope = naive_slope(r, h, kind.dimension);
    double volume = j->mass / (j->density * fabs(j->depth)) * slope;
    double between = 0.5 * fabs(i->depth + j->depth);
    double push = -2.0 * between / (i->density * i->depth) * volume; /* of (1.39) and (1.40) */
    double work = 0.0, speed = 0.0, stress = 0.0, own_speed = 0.0;
    sums->weight += volume;
    sums->broken += broken ? volume : 0.0;
    sums->hoop_pull -= 2.0 * volume * (between - i->depth) * e[0];
    *(e[0] > 0.0 ? &sums->hoop_outside : &sums->hoop_inside) -= volume * (j->x[0] - i->x[0]) * e[0];
    sums->hoop_size += 2.0 * fabs(volume) * (between + fabs(i->depth) + r);
    for (int k = 0; k < 3; k++) {
        sums->acceleration[k] += push * sigma_star[k];
        sums->drift[k] += volume * (u_star[k] - i->u[k]);
        sums->wall[k] += image ? push * sigma_star[k] : 0.0;
        work += sigma_star[k] * u_star[k] - i->u[k] * sigma_star[k];
        speed += u_star[k] * u_star[k];
        own_speed += i->u[k] * i->u[k];
        stress += sigma[0][k] * sigma[0][k] + sigma[1][k] * sigma[1][k] +
                  turned_sigma[k] * turned_sigma[k];
        for (int b = 0; b < 3; b++)
            sums->gradient[k][b] += 2.0 * volume * (i->u[k] - u_star[k]) * (j->x[b] - i->x[b]) / r;
    }
    for (int k = 0; k < 3; k++) {
        int b = (k + 1) % 3, c = (k + 2) % 3; /* (1.58) */
        sums->spin[k] += volume *
                         ((i->u[c] - u_star[c]) * (j->x[b] - i->x[b]) -
                          (i->u[b] - u_star[b]) * (j->x[c] - i->x[c])) /
                         r;
    }
    sums->power += push * work;
    sums->acceleration_size += fabs(push) * sqrt(stress);
    sums->power_size += fabs(push) * sqrt(stress) * (sqrt(speed) + sqrt(own_speed));
    sums->gradient_size += 2.0 * fabs(volume) * (sqrt(speed) + sqrt(own_speed));
}

#endif
