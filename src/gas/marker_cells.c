/* The states of cells by their markers, see markers.h. */
#include "gas/marker_grid.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/material.h"

static double pressure_of(const struct eos *eos, double density, double energy)
{
    const double none[POINT_HISTORY] = {0.0};
    return eos_evaluate(eos, density, energy, none).pressure;
}

struct gas_mixed gas_mix(const struct eos eos[2], const double theta[2], const double energy[2],
                         double density, double of_cell, int mixing)
{
    enum { HALVINGS = 80 };
    struct gas_mixed mixed = {{0.0, 0.0}, {energy[0], energy[1]}, 0.0};
    double low = log(1e-12 * density / theta[0]), high = log((1.0 - 1e-12) * density / theta[0]);
    for (int k = 0; k < HALVINGS; k++) {
        const double middle = 0.5 * (low + high);
        mixed.density[0] = exp(middle);
        mixed.density[1] = (density - mixed.density[0] * theta[0]) / theta[1];
        if (mixing == MIXING_CONSERVATIVE) {
            double sum = 0.0;
            for (int m = 0; m < 2; m++)
                sum += mixed.density[m] * theta[m] * energy[m];
            for (int m = 0; m < 2; m++)
                mixed.energy[m] = energy[m] * density * of_cell / sum;
        }
        mixed.pressure = pressure_of(&eos[0], mixed.density[0], mixed.energy[0]);
        if (mixed.pressure < pressure_of(&eos[1], mixed.density[1], mixed.energy[1]))
            low = middle;
        else
            high = middle;
    }
    return mixed;
}

/* The volume that a marker stands for (3-21), (3-22). */
void marker_find_volumes(const struct marker_grid *grid, int32_t (*number)[2])
{
    const struct gas *gas = grid->gas;
    struct gas_markers *markers = gas->markers;
    const struct cell_blocks *cells = gas->cells;
    marker_count(grid, number);
    for (int64_t k = 0; k < markers->count; k++) {
        struct gas_marker *marker = &markers->marker[k];
        const int64_t place = marker_place_of(grid, marker);
        const int m = marker->second != 0.0;
        const double fraction = marker_fraction_at(grid, place), part = marker_is_pure(fraction)
                                                                            ? 1.0
                                                                        : m ? fraction
                                                                            : 1.0 - fraction;
        const int32_t sharing =
            marker_is_pure(fraction) ? number[place][0] + number[place][1] : number[place][m];
        const double size =
            gas_cell_volume(1.0, cells->edge, cells->position[markers->cell[place]][0], gas->round);
        marker->volume = part * size / (double)sharing;
    }
}

/* The mean specific energy of material M in the cells around PLACE, that of the cell where there is
 * none. */
static double energy_around(const struct marker_grid *grid, int64_t place, int m, double of_cell)
{
    const struct gas *gas = grid->gas;
    double sum = 0.0;
    int cells = 0;
    int64_t at[3], other;
    marker_at_place(grid, place, at);
    FOR_AROUND(grid, 1, delta)
    {
        if (!marker_beside(grid, at, delta, &other) || other == place)
            continue;
        const int32_t i = gas->markers->cell[other];
        if (marker_fraction_at(grid, other) == (double)m) {
            sum += gas->cells->energy[i];
            cells++;
        }
    }
    return cells ? sum / cells : of_cell;
}

static double specific_energy(const struct gas *gas, int32_t i)
{
    double kinetic = 0.0;
    const double density = gas->u[GAS_DENSITY][i];
    for (int axis = 0; axis < 3; axis++)
        kinetic += 0.5 * square(gas->u[GAS_MOMENTUM + axis][i] / density);
    return gas->u[GAS_ENERGY][i] / density - kinetic;
}

/* The state of the cell I at PLACE: pure, or mixed with FRACTION of the second material. */
static void put_state(const struct marker_grid *grid, int64_t place, double fraction)
{
    const struct gas *gas = grid->gas;
    struct gas_markers *markers = gas->markers;
    const int32_t i = markers->cell[place];
    const double density = gas->u[GAS_DENSITY][i], last = gas->u[GAS_FRACTION][i];
    const double energy = specific_energy(gas, i), change = energy - markers->before[i];
    double *gamma = &gas->u[gas->layout.gamma][i];
    gas->u[GAS_FRACTION][i] = fraction;
    gas->u[GAS_SECOND][i] = fraction * density;
    *gamma = 0.0;
    if (marker_is_pure(fraction)) {
        const double pressure = pressure_of(&gas->eos[fraction == 1.0], density, energy);
        *gamma = pressure / (density * energy);
        return;
    }
    const double theta[2] = {1.0 - fraction, fraction};
    double own[2];
    for (int m = 0; m < 2; m++)
        own[m] = marker_is_pure(last)
                     ? last == (double)m ? energy : energy_around(grid, place, m, energy)
                     : markers->energy[m][i] + theta[m] * change;
    for (int m = 0; m < 2; m++)
        own[m] = maximum(own[m], 1e-3 * fabs(energy));
    const struct gas_mixed mixed = gas_mix(gas->eos, theta, own, density, energy, gas->mixing);
    for (int m = 0; m < 2; m++)
        markers->energy[m][i] = mixed.energy[m];
    gas->u[GAS_SECOND][i] = theta[1] * mixed.density[1];
    *gamma = mixed.pressure / (density * energy);
}

/* The label of a cell without markers: the last one; of one that was mixed that of most of its
 * neighbours at faces. */
static double label_of(const struct marker_grid *grid, int64_t place, const double *last)
{
    int64_t at[3], other;
    int votes = 0;
    if (marker_is_pure(last[place]))
        return last[place];
    marker_at_place(grid, place, at);
    for (int face = 0; face < 2 * grid->dimension; face++) {
        int delta[3] = {0, 0, 0};
        delta[face / 2] = face % 2 ? 1 : -1;
        if (marker_beside(grid, at, delta, &other) && marker_is_pure(last[other]))
            votes += last[other] == 1.0 ? 1 : -1;
    }
    return votes ? votes > 0 : last[place] > 0.5;
}

/* The fractions of volume of all cells by the volumes of their markers (3-23). */
struct error *marker_put_states(const struct marker_grid *grid)
{
    const struct gas *gas = grid->gas;
    struct gas_markers *markers = gas->markers;
    double *last = memory_allocate((size_t)markers->cells * sizeof *last + 1);
    if (!last)
        return out_of_memory_for("markers");
    for (int m = 0; m < 2; m++)
        memset(markers->volume[m], 0, (size_t)markers->cells * sizeof(double));
    for (int64_t k = 0; k < markers->count; k++)
        markers->volume[markers->marker[k].second != 0.0]
                       [marker_place_of(grid, &markers->marker[k])] += markers->marker[k].volume;
    for (int64_t n = 0; n < markers->cells; n++)
        last[n] = marker_fraction_at(grid, n);
    for (int64_t n = 0; n < markers->cells; n++) {
        const double first = markers->volume[0][n], second = markers->volume[1][n];
        if (gas->open && gas->open[markers->cell[n]] == 0.0)
            continue;
        put_state(grid, n,
                  first > 0.0 && second > 0.0 ? second / (first + second)
                  : second > 0.0              ? 1.0
                  : first > 0.0               ? 0.0
                                              : label_of(grid, n, last));
    }
    free(last);
    for (int32_t i = 0; i < gas->cells->count; i++)
        markers->before[i] = !gas->open || gas->open[i] != 0.0 ? specific_energy(gas, i) : 0.0;
    return NULL;
}

/* The states of all cells: mixed ones have been so, with what is around them. */
void marker_begin_states(const struct marker_grid *grid)
{
    const struct gas *gas = grid->gas;
    struct gas_markers *markers = gas->markers;
    for (int32_t i = 0; i < gas->cells->count; i++) {
        const bool open = !gas->open || gas->open[i] != 0.0;
        gas->cells->energy[i] = markers->before[i] = open ? specific_energy(gas, i) : 0.0;
    }
    for (int64_t n = 0; n < markers->cells; n++) {
        const int32_t i = markers->cell[n];
        if (gas->open && gas->open[i] == 0.0)
            continue;
        for (int m = 0; m < 2; m++)
            markers->energy[m][i] = energy_around(grid, n, m, markers->before[i]);
        put_state(grid, n, marker_fraction_at(grid, n));
    }
}
