/* Gases are ideal, their molecules rigid rotors and harmonic oscillators; carbon that finds no
 * oxygen is soot. The moles of a species follow from the potentials of its atoms,
 *
 *   n = exp(q + sum a_k x_k)
 *
 * with the logarithm q of its partition function; x is the minimum of the convex function sum n - b
 * x, where b are the atoms. Constants are those of textbooks of statistical thermodynamics and of
 * the JANAF tables (Chase et al., J. Phys. Chem. Ref. Data 14, suppl. 1 (1985)), recalled.
 * scripts/room-pressure computes the same apart from this file. */
#include "material/equilibrium.h"

#include <math.h>
#include <stdbool.h>

#include "base/exponential.h"
#include "base/vector.h"

enum { CARBON, HYDROGEN, NITROGEN, OXYGEN, ELEMENTS };

static const double GAS = 8.314462618, BOLTZMANN = 1.380649e-23, PLANCK = 6.62607015e-34,
                    AVOGADRO = 6.02214076e23;
static const double ROOM = 298.15;        /* K, of heats of formation */
static const double AIR_MOLE = 0.0289647; /* kg */
static const double AIR_OXYGEN = 0.2095;  /* its fraction of the moles; the rest is nitrogen */
static const double HEAT_UNIT = 1e3;      /* J/mol, of `formation` below */
static const double WEIGHT[ELEMENTS] = {12.011e-3, 1.008e-3, 14.007e-3, 15.999e-3}; /* kg/mol */

struct species {
    double atoms[ELEMENTS]; /* C, H, N, O */
    int rotations;          /* 0, 1 of a linear molecule, or 3 */
    double rotation[3];     /* K */
    double symmetry;
    double vibration[4]; /* K; 0: no more */
    double level[3][2];  /* electronic: weight, K; 0: no more */
    double formation;    /* kJ/mol at 0 K */
};

enum { N2, O2, CO2, H2O, CO, H2, OH, O1, H1, NO, SPECIES };
static const struct species all[SPECIES] = {
    [N2] = {{0, 0, 2, 0}, 1, {2.88}, 2, {3393}, {{1, 0}}, 0.0},
    [O2] = {{0, 0, 0, 2}, 1, {2.08}, 2, {2273}, {{3, 0}, {2, 11390}}, 0.0},
    [CO2] = {{1, 0, 0, 2}, 1, {0.561}, 2, {960, 960, 1932, 3380}, {{1, 0}}, -393.15},
    [H2O] = {{0, 2, 0, 1}, 3, {40.1, 20.9, 13.4}, 2, {2297, 5254, 5404}, {{1, 0}}, -238.92},
    [CO] = {{1, 0, 0, 1}, 1, {2.78}, 1, {3122}, {{1, 0}}, -113.80},
    [H2] = {{0, 2, 0, 0}, 1, {87.6}, 2, {6332}, {{1, 0}}, 0.0},
    [OH] = {{0, 1, 0, 1}, 1, {26.7}, 1, {5370}, {{2, 0}, {2, 201}}, 37.3},
    [O1] = {{0, 0, 0, 1}, 0, {0}, 1, {0}, {{5, 0}, {3, 228}, {1, 326}}, 246.8},
    [H1] = {{0, 1, 0, 0}, 0, {0}, 1, {0}, {{2, 0}}, 216.03},
    [NO] = {{0, 0, 1, 1}, 1, {2.45}, 1, {2740}, {{2, 0}, {2, 174}}, 90.5},
};

/* The oscillators of an atom of graphite: number, K. */
static const double soot[2][2] = {{2.0, 1000.0}, {1.0, 2300.0}};

/* J/mol over the elements at 0 K. */
static double energy_of(const struct species *s, double t)
{
    double sum = (s->rotations == 3 ? 3.0 : 1.5 + s->rotations) * t, weight = 0.0, levels = 0.0;
    for (int k = 0; k < 4 && s->vibration[k] > 0.0; k++)
        sum += s->vibration[k] / exponential_minus_one(s->vibration[k] / t);
    for (int k = 0; k < 3 && s->level[k][0] > 0.0; k++) {
        const double part = s->level[k][0] * exponential(-s->level[k][1] / t);
        weight += part;
        levels += part * s->level[k][1];
    }
    return GAS * (sum + levels / weight) + HEAT_UNIT * s->formation;
}

static double energy_of_soot(double t)
{
    double sum = 0.0;
    for (int k = 0; k < 2; k++)
        sum += soot[k][0] * soot[k][1] / exponential_minus_one(soot[k][1] / t);
    return GAS * sum;
}

/* The potential of soot over RT. */
static double potential_of_soot(double t)
{
    double sum = 0.0;
    for (int k = 0; k < 2; k++)
        sum += soot[k][0] * logarithm(-exponential_minus_one(-soot[k][1] / t));
    return sum;
}

/* The logarithm of the partition function, in moles a cubic metre. */
static double partition_of(const struct species *s, double t)
{
    double mass = 0.0, levels = 0.0, turns = 1.0;
    for (int k = 0; k < ELEMENTS; k++)
        mass += s->atoms[k] * WEIGHT[k] / AVOGADRO;
    double q =
        1.5 * logarithm(2.0 * M_PI * mass * BOLTZMANN * t / square(PLANCK)) - logarithm(AVOGADRO);
    for (int k = 0; k < s->rotations; k++)
        turns *= t / s->rotation[k];
    q += (s->rotations == 3 ? 0.5 * logarithm(M_PI * turns) : logarithm(turns)) -
         logarithm(s->symmetry);
    for (int k = 0; k < 4 && s->vibration[k] > 0.0; k++)
        q -= logarithm(-exponential_minus_one(-s->vibration[k] / t));
    for (int k = 0; k < 3 && s->level[k][0] > 0.0; k++)
        levels += s->level[k][0] * exponential(-s->level[k][1] / t);
    return q + logarithm(levels) - HEAT_UNIT * s->formation / (GAS * t);
}

/* A mixture at a temperature and the elements of which it may have more or less in its gas. */
struct balance {
    double atoms[ELEMENTS], q[SPECIES];
    bool has[SPECIES];
    int element[ELEMENTS], elements;
    double x[ELEMENTS], n[SPECIES];
};

/* The moles at the potentials X; the value of the function that they make least. */
static double moles_at(struct balance *b, const double x[ELEMENTS])
{
    double value = 0.0;
    for (int s = 0; s < SPECIES; s++) {
        double sum = b->q[s];
        for (int k = 0; k < ELEMENTS; k++)
            sum += all[s].atoms[k] * x[k];
        b->n[s] = b->has[s] ? exponential(fmin(sum, 300.0)) : 0.0;
        value += b->n[s];
    }
    for (int k = 0; k < ELEMENTS; k++)
        value -= b->atoms[k] * x[k];
    return value;
}

/* The potential of element K with which no species of known elements holds more of it than there
 * is. */
static double start_of(const struct balance *b, const bool known[ELEMENTS], int k)
{
    double least = INFINITY;
    for (int s = 0; s < SPECIES; s++) {
        const double own = all[s].atoms[k];
        double sum = b->q[s];
        bool all_known = b->has[s] && own > 0.0;
        for (int m = 0; m < ELEMENTS && all_known; m++) {
            all_known = all[s].atoms[m] == 0.0 || m == k || known[m];
            sum += m == k || !known[m] ? 0.0 : all[s].atoms[m] * b->x[m];
        }
        if (all_known)
            least = fmin(least, (logarithm(b->atoms[k] / own) - sum) / own);
    }
    return least;
}

/* Solves the COUNT equations of MATRIX, which is positive definite; RIGHT becomes the solution. */
static void eliminate(double matrix[ELEMENTS][ELEMENTS], double right[ELEMENTS], int count)
{
    for (int i = 0; i < count; i++)
        for (int r = i + 1; r < count; r++) {
            const double factor = matrix[r][i] / matrix[i][i];
            for (int c = i; c < count; c++)
                matrix[r][c] -= factor * matrix[i][c];
            right[r] -= factor * right[i];
        }
    for (int i = count - 1; i >= 0; i--) {
        for (int c = i + 1; c < count; c++)
            right[i] -= matrix[i][c] * right[c];
        right[i] /= matrix[i][i];
    }
}

/* A step of Newton's method, no longer than 4 and shortened until the function falls. Whether it
 * changes anything. */
static bool improve(struct balance *b)
{
    double matrix[ELEMENTS][ELEMENTS], step[ELEMENTS], longest = 0.0;
    const double here = moles_at(b, b->x);
    bool done = true;
    for (int i = 0; i < b->elements; i++) {
        const int k = b->element[i];
        double held = 0.0;
        for (int j = 0; j < b->elements; j++)
            matrix[i][j] = 0.0;
        for (int s = 0; s < SPECIES; s++) {
            held += b->n[s] * all[s].atoms[k];
            for (int j = 0; j < b->elements; j++)
                matrix[i][j] += b->n[s] * all[s].atoms[k] * all[s].atoms[b->element[j]];
        }
        step[i] = b->atoms[k] - held;
        done &= fabs(step[i]) < 1e-11 * b->atoms[k];
    }
    if (done)
        return false;
    eliminate(matrix, step, b->elements);
    for (int i = 0; i < b->elements; i++)
        longest = fmax(longest, fabs(step[i]));
    for (double part = fmin(1.0, 4.0 / longest); part > 1e-12; part *= 0.5) {
        double at[ELEMENTS];
        for (int k = 0; k < ELEMENTS; k++)
            at[k] = b->x[k];
        for (int i = 0; i < b->elements; i++)
            at[b->element[i]] += part * step[i];
        if (moles_at(b, at) > here)
            continue;
        for (int k = 0; k < ELEMENTS; k++)
            b->x[k] = at[k];
        return true;
    }
    return false;
}

/* The gas at temperature T; beside soot, or without. */
static void balance(struct balance *b, double t, bool sooty)
{
    static const int order[ELEMENTS] = {OXYGEN, CARBON, HYDROGEN, NITROGEN};
    bool known[ELEMENTS] = {false, false, false, false};
    for (int k = 0; k < ELEMENTS; k++)
        b->x[k] = 0.0;
    if (sooty) {
        b->x[CARBON] = potential_of_soot(t);
        known[CARBON] = true;
    }
    b->elements = 0;
    for (int i = 0; i < ELEMENTS; i++) {
        const int k = order[i];
        if (b->atoms[k] > 0.0 && !known[k]) {
            b->x[k] = start_of(b, known, k);
            known[k] = true;
            b->element[b->elements++] = k;
        }
    }
    for (int round = 0; round < 400 && improve(b); round++)
        ;
    moles_at(b, b->x);
}

/* Pressure (Pa) and energy (J/m^3) of ATOMS, in mol/m^3, at temperature T. */
static double pressure_at(const double atoms[ELEMENTS], double t, double *energy)
{
    struct balance b;
    double carbon = -1.0, moles = 0.0;
    for (int k = 0; k < ELEMENTS; k++)
        b.atoms[k] = atoms[k];
    for (int s = 0; s < SPECIES; s++) {
        b.q[s] = partition_of(&all[s], t);
        b.has[s] = true;
        for (int k = 0; k < ELEMENTS; k++)
            b.has[s] &= all[s].atoms[k] == 0.0 || atoms[k] > 0.0;
    }
    if (atoms[CARBON] > 0.0) {
        balance(&b, t, true);
        carbon = atoms[CARBON] - b.n[CO] - b.n[CO2];
    }
    if (carbon < 0.0)
        balance(&b, t, false);
    *energy = fmax(carbon, 0.0) * energy_of_soot(t);
    for (int s = 0; s < SPECIES; s++) {
        *energy += b.n[s] * energy_of(&all[s], t);
        moles += b.n[s];
    }
    return moles * GAS * t;
}

/* The energy of the elements of ATOMS at 298.15 K, over that at 0 K, and the work that they do when
 * they form: heats of formation are enthalpies. */
static double energy_of_elements(const double atoms[ELEMENTS])
{
    static const int pure[ELEMENTS] = {-1, H2, N2, O2};
    double sum = atoms[CARBON] * energy_of_soot(ROOM);
    for (int k = HYDROGEN; k < ELEMENTS; k++)
        sum += 0.5 * atoms[k] * (energy_of(&all[pure[k]], ROOM) + GAS * ROOM);
    return sum;
}

double equilibrium_density_of_air(double pressure, double temperature)
{
    return pressure * AIR_MOLE / (GAS * temperature);
}

double equilibrium_temperature_of_air(double pressure, double density)
{
    return pressure * AIR_MOLE / (GAS * density);
}

struct room_gas equilibrium_of_room(const struct composition *explosive, const struct room *room)
{
    const double unit[ELEMENTS] = {explosive->carbon, explosive->hydrogen, explosive->nitrogen,
                                   explosive->oxygen},
                 air = room->air / AIR_MOLE;
    double weight = 0.0, atoms[ELEMENTS], energy = 0.0;
    for (int k = 0; k < ELEMENTS; k++)
        weight += unit[k] * WEIGHT[k];
    const double units = weight > 0.0 ? room->load / weight : 0.0;
    for (int k = 0; k < ELEMENTS; k++)
        atoms[k] = units * unit[k];
    atoms[OXYGEN] += 2.0 * AIR_OXYGEN * air;
    atoms[NITROGEN] += 2.0 * (1.0 - AIR_OXYGEN) * air;
    const double before = room->load * explosive->formation + units * energy_of_elements(unit) +
                          air * (AIR_OXYGEN * energy_of(&all[O2], room->temperature) +
                                 (1.0 - AIR_OXYGEN) * energy_of(&all[N2], room->temperature));
    double low = 200.0, high = 9000.0;
    struct room_gas gas = {0.0, 0.0};
    for (int k = 0; k < 50; k++) {
        gas.temperature = 0.5 * (low + high);
        gas.pressure = pressure_at(atoms, gas.temperature, &energy);
        *(energy < before ? &low : &high) = gas.temperature;
    }
    return gas;
}
