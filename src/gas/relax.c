/* Cells at the start that bodies of two materials share, at pressures of their own: the material of
 * the higher pressure compresses the other one before the run begins. With the volumes as they are
 * the energy of a charge would heat the air of such a cell to what no shock can. */
#include <math.h>

#include "gas/gas_internal.h"
#include "gas/mixture.h"

/* Specific energy of a gas at ENERGY and density FROM that comes to density TO without heat. */
static double isentrope(const struct eos *eos, double energy, double from, double to)
{
    enum { STEPS = 64 };
    const double none[POINT_HISTORY] = {0.0}, factor = pow(to / from, 1.0 / STEPS),
                 middle = sqrt(factor);
    double density = from;
    for (int k = 0; k < STEPS; k++) {
        const double push = eos_evaluate(eos, density, energy, none).pressure;
        const double half = energy + push / density * (1.0 - 1.0 / middle);
        const double mean = eos_evaluate(eos, density * middle, half, none).pressure;
        energy += mean / density * (1.0 - 1.0 / factor);
        density *= factor;
    }
    return energy;
}

/* Of what has burnt to the fraction BURNT (row_unburn). */
static double pressure_of(const struct eos *eos, double density, double energy, double burnt)
{
    const double none[POINT_HISTORY] = {0.0};
    if (burnt >= 1.0)
        return eos_evaluate(eos, density, energy, none).pressure;
    const struct eos_value rest = eos_evaluate(eos, density, 0.0, none);
    return burnt * rest.pressure + rest.dp_de * energy;
}

double gas_relax(const struct eos eos[2], const double mass[2], const double energy[2],
                 double fraction, double burnt)
{
    enum { HALVINGS = 50 };
    const double none[POINT_HISTORY] = {0.0}, volume = 1.0 - fraction;
    const double own = mass[0] / volume, specific = energy[0] / mass[0];
    const double first = eos_evaluate(&eos[0], own, specific, none).pressure,
                 second = pressure_of(&eos[1], mass[1] / fraction, energy[1] / mass[1], burnt);
    if (!(fabs(first - second) > 1e-6 * maximum(fabs(first), fabs(second))))
        return fraction;
    double low = log(1e-6 * volume), high = log(1.0 - 1e-6 * fraction); /* of the first's volume */
    for (int k = 0; k < HALVINGS; k++) {
        const double at = 0.5 * (low + high), part = exp(at);
        const double here = isentrope(&eos[0], specific, own, mass[0] / part);
        const double left = energy[0] + energy[1] - mass[0] * here;
        const double push = eos_evaluate(&eos[0], mass[0] / part, here, none).pressure,
                     back = pressure_of(&eos[1], mass[1] / (1.0 - part), left / mass[1], burnt);
        if (push > back)
            low = at;
        else
            high = at;
    }
    return 1.0 - exp(0.5 * (low + high));
}
