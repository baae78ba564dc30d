/* The detonation that follows from the constants of an explosive. */
#include <stdio.h>

#include "cli/cli.h"
#include "exact/detonation.h"

bool print_detonation(const char *before, const char *between, const struct material *material)
{
    struct detonation d;
    const double density = material_density(material);
    if (!detonation_solve(material, density, &d))
        return false;
    printf("%sdetonation speed %.0f m/s%sChapman-Jouguet %.2f GPa, %.0f kg/m^3, %.0f m/s", before,
           d.speed, between, d.cj.pressure / 1e9, d.cj.density, d.cj.velocity);
    if (!isnan(d.spike.pressure))
        printf("%sspike %.2f GPa, %.0f kg/m^3, %.0f m/s", between, d.spike.pressure / 1e9,
               d.spike.density, d.spike.velocity);
    printf("\n");
    return true;
}
