/* bolide materials NAME --curves: curves of the equation of state as CSV. */
#include <math.h>
#include <stdio.h>

#include "cli/cli.h"
#include "exact/material_curves.h"

static const double FASTEST = 15e3; /* particle speed up to which shocks are shown, m/s */
enum { POINTS = 60 };

static void print_state(const char *curve, const struct curve_state *s)
{
    const double columns[] = {s->density, s->pressure, s->energy,  s->temperature,
                              s->sound,   s->shock,    s->particle};
    printf("%s", curve);
    for (int i = 0; i < 7; i++)
        isnan(columns[i]) ? printf(",") : printf(",%.6g", columns[i]);
    printf("\n");
}

/* The shock adiabat from AHEAD with rising density, as far as it exists. */
static void print_shocks(const char *curve, const struct material *material,
                         const struct curve_state *ahead, double density_ahead)
{
    const double rest = material_density(material), lowest = maximum(density_ahead, ahead->density);
    for (int i = 1; i <= 4 * POINTS; i++) {
        struct curve_state behind;
        const double density = lowest + 0.05 * rest * i / 4.0;
        if (!curve_shock(material, ahead, density_ahead, density, &behind) ||
            behind.particle > FASTEST)
            break;
        print_state(curve, &behind);
    }
}

bool print_curves(const struct material *material)
{
    struct curve_state rest, first, states[POINTS];
    double densities[POINTS];
    if (!curve_rest(material, &rest))
        return false;
    printf("curve,density [kg/m^3],pressure [Pa],energy [J/kg],temperature [K],sound [m/s],"
           "shock [m/s],particle [m/s]\n");
    print_state("rest", &rest);
    for (int i = 0; i < POINTS; i++)
        densities[i] = rest.density * (1.0 + 2.0 * (i + 1) / POINTS);
    curve_isentrope(material, densities, POINTS, states);
    for (int i = 0; i < POINTS; i++)
        print_state("isentrope", &states[i]);
    for (int i = 0; i < POINTS; i++)
        densities[i] = rest.density * pow(0.01, (i + 1.0) / POINTS);
    curve_isentrope(material, densities, POINTS, states);
    for (int i = 0; i < POINTS; i++)
        print_state("expansion", &states[i]);
    print_shocks("shock", material, &rest, rest.density);
    if (curve_shock(material, &rest, rest.density, 1.2 * rest.density, &first))
        print_shocks("second shock from 1.2", material, &first, first.density);
    print_shocks("porous 1.25", material, &rest, rest.density / 1.25);
    print_shocks("porous 1.67", material, &rest, rest.density / (5.0 / 3.0));
    return true;
}
