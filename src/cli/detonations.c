/* The detonation that follows from the constants of an explosive. */
#include <stdio.h>

#include "cli/cli.h"
#include "exact/detonation.h"

/* VALUE with so many DECIMALS; a huge one, of constants that are wrong, in short. */
static void print_value(const char *before, double value, int decimals, const char *unit)
{
    if (fabs(value) < 1e9)
        printf("%s%.*f %s", before, decimals, value, unit);
    else
        printf("%s%.6g %s", before, value, unit);
}

bool print_detonation(const char *before, const char *between, const struct material *material)
{
    struct detonation d;
    const double density = material_density(material);
    if (!detonation_solve(material, density, &d))
        return false;
    printf("%sdetonation speed", before);
    print_value(" ", d.speed, 0, "m/s");
    printf("%sChapman-Jouguet", between);
    print_value(" ", d.cj.pressure / 1e9, 2, "GPa");
    print_value(", ", d.cj.density, 0, "kg/m^3");
    print_value(", ", d.cj.velocity, 0, "m/s");
    if (!isnan(d.spike.pressure)) {
        printf("%sspike", between);
        print_value(" ", d.spike.pressure / 1e9, 2, "GPa");
        print_value(", ", d.spike.density, 0, "kg/m^3");
        print_value(", ", d.spike.velocity, 0, "m/s");
    }
    printf("\n");
    return true;
}
