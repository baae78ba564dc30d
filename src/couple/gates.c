/* Gates and the cells of gas on both sides of them, see gates.h. */
#include "couple/gates.h"

#include "material/material.h"

void gate_axes(int axis, int across[2])
{
    across[0] = axis == 0 ? 1 : 0;
    across[1] = axis == 2 ? 1 : 2;
}

struct gate *cfdmp_gate(struct cfdmp *cfdmp, int axis, int side, const int64_t at[3])
{
    int across[2];
    int64_t n[2];
    gate_axes(axis, across);
    for (int k = 0; k < 2; k++) {
        const int64_t last = cfdmp->count[across[k]] - 1,
                      here = at[across[k]] - cfdmp->cut.low[across[k]];
        n[k] = here < 0 ? 0 : here > last ? last : here;
    }
    return &cfdmp->side[axis][side].gate[n[0] + n[1] * cfdmp->count[across[0]]];
}

void gate_cell(const struct cfdmp *cfdmp, int axis, int side, int64_t number, bool inside,
               int64_t at[3])
{
    int across[2];
    gate_axes(axis, across);
    at[across[0]] = cfdmp->cut.low[across[0]] + number % cfdmp->count[across[0]];
    at[across[1]] = cfdmp->cut.low[across[1]] + number / cfdmp->count[across[0]];
    at[axis] = side ? cfdmp->cut.high[axis] - inside : cfdmp->cut.low[axis] - !inside;
}

double gate_area(const struct cfdmp *cfdmp, int axis, int side, int64_t number)
{
    int64_t at[3];
    gate_cell(cfdmp, axis, side, number, true, at);
    const double radius =
        axis > 0 ? (double)at[0] + 0.5 : (double)(side ? cfdmp->cut.high : cfdmp->cut.low)[0];
    double area = cfdmp->round ? radius * cfdmp->edge : 1.0;
    for (int k = 1; k < cfdmp->dimension; k++)
        area *= cfdmp->edge;
    return area;
}

/* The state of a cell: conserved numbers, the second material's mass per volume and its
 * fraction. */
struct content {
    double u[GAS_NUMBERS], second, fraction;
};

static struct content content_of(const struct gas_view *view, int32_t i)
{
    struct content content = {{0.0}, 0.0, 0.0};
    for (int n = 0; n < GAS_NUMBERS; n++)
        content.u[n] = view->u[n][i];
    if (view->layout->two) {
        content.second = view->u[GAS_SECOND][i];
        content.fraction = view->u[GAS_FRACTION][i];
    }
    return content;
}

struct shared gate_share(const struct gas_view *view, const double mass[2], const double density[2],
                         double energy)
{
    const double none[POINT_HISTORY] = {0.0};
    struct shared shared = {0.0, {0.0, 0.0}, {1.0, 1.0}};
    double per = 0.0;
    for (int m = 0; m < 2; m++)
        if (mass[m] > 0.0) {
            const struct eos_value cold = eos_evaluate(&view->eos[m], density[m], 0.0, none);
            shared.cold[m] = cold.pressure;
            shared.slope[m] = cold.dp_de;
            energy += mass[m] * cold.pressure / cold.dp_de;
            per += mass[m] / cold.dp_de;
        }
    shared.pressure = energy / per;
    return shared;
}

/* The density of material M in a cell, 0 where there is none. */
static double density_in(const struct content *content, int m)
{
    const double mass = m ? content->second : content->u[GAS_DENSITY] - content->second,
                 part = m ? content->fraction : 1.0 - content->fraction;
    return part > 0.0 ? mass / part : 0.0;
}

/* The pressure of a cell. */
static double pressure_of(const struct gas_view *view, const struct content *content)
{
    const double none[POINT_HISTORY] = {0.0}, *u = content->u;
    double kinetic = 0.0;
    for (int axis = 0; axis < 3; axis++)
        kinetic += 0.5 * square(u[GAS_MOMENTUM + axis]) / u[GAS_DENSITY];
    const double energy = u[GAS_ENERGY] - kinetic;
    if (!view->layout->two)
        return eos_evaluate(view->eos, u[GAS_DENSITY], energy / u[GAS_DENSITY], none).pressure;
    const double density[2] = {density_in(content, 0), density_in(content, 1)},
                 mass[2] = {density[0] > 0.0 ? u[GAS_DENSITY] - content->second : 0.0,
                            density[1] > 0.0 ? content->second : 0.0};
    return gate_share(view, mass, density, energy).pressure;
}

/* The volume of MASS of a material that comes at the density OF, 0 where it is not known, to a cell
 * that has it at OWN, or is taken from there. Of what is much denser than beside the gate as much
 * volume goes as it fills: at OF more than that would go, and the rest would get denser with each
 * step. */
static double volume_of(double mass, double of, double own)
{
    static const double most = 5.0;
    if (mass < 0.0 && of > 0.0 && own > most * of)
        return mass / own;
    return of > 0.0 ? mass / of : 0.0;
}

/* CONTENT with VALUES per volume more; materials have the densities OF, 0 where they are not
 * known. */
static struct content content_with(const struct gas_view *view, struct content content,
                                   const double values[PASSES], const double of[2])
{
    const double own[2] = {density_in(&content, 0), density_in(&content, 1)};
    for (int n = 0; n < GAS_NUMBERS; n++)
        content.u[n] += values[n];
    if (!view->layout->two)
        return content;
    const double given[2] = {values[PASS_MASS] - values[PASS_SECOND], values[PASS_SECOND]};
    const double volume[2] = {volume_of(given[0], of[0], own[0]),
                              volume_of(given[1], of[1], own[1])};
    content.second += given[1];
    content.fraction = (content.fraction + volume[1]) / (1.0 + volume[0] + volume[1]);
    const double all = content.u[GAS_DENSITY], trace = 1e-8;
    if (fabs(content.second) <= trace * all)
        content.fraction = content.second = 0.0;
    if (fabs(content.second - all) <= trace * all) {
        content.fraction = 1.0;
        content.second = all;
    }
    return content;
}

/* Whether a cell keeps half of its density and of its pressure, and of each material some at about
 * the density that it had, or that it has beside the gate, OF. */
static bool is_bearable(const struct gas_view *view, const struct content *before,
                        const struct content *after, const double of[2])
{
    static const double most = 5.0;
    const double all = after->u[GAS_DENSITY];
    if (!(all > 0.5 * before->u[GAS_DENSITY]))
        return false;
    if (after->second < 0.0 || after->second > all || !(after->fraction >= 0.0) ||
        after->fraction > 1.0 || (after->fraction == 0.0) != (after->second == 0.0) ||
        (after->fraction == 1.0) != (after->second == all && view->layout->two))
        return false;
    for (int m = 0; m < 2 && view->layout->two; m++) {
        const double now = density_in(after, m), was = density_in(before, m);
        const double than = was > 0.0 ? was : of[m];
        if (now != 0.0 && !(now < most * than && than < most * now))
            return false;
    }
    return pressure_of(view, after) > 0.5 * pressure_of(view, before);
}

void gate_give(struct cfdmp *cfdmp, const struct gas_view *view, const int64_t at[3],
               double rest[PASSES], const double of[2])
{
    enum { HALVINGS = 10 };
    int32_t block;
    const int32_t i = part_cell(view->cells, at, &block);
    if (i < 0) {
        for (int n = 0; n < PASSES; n++)
            rest[n] = 0.0;
        return;
    }
    const struct content before = content_of(view, i);
    double part = 1.0 / part_cell_volume(&cfdmp->maker, cfdmp->round, at), values[PASSES];
    const double all = part;
    struct content after = before;
    bool bearable = false;
    for (int k = 0; k < HALVINGS && !bearable; k++, part *= bearable ? 1.0 : 0.5) {
        for (int n = 0; n < PASSES; n++)
            values[n] = part * rest[n];
        after = content_with(view, before, values, of);
        bearable = is_bearable(view, &before, &after, of);
    }
    if (!bearable)
        return;
    for (int n = 0; n < PASSES; n++)
        rest[n] -= values[n] / all;
    for (int n = 0; n < GAS_NUMBERS; n++)
        view->u[n][i] = after.u[n];
    if (view->layout->two) {
        view->u[GAS_SECOND][i] = after.second;
        view->u[GAS_FRACTION][i] = after.fraction;
    }
    cfdmp->changed[block] = true;
}

struct beside gate_beside(const struct cfdmp *cfdmp, int axis, int side, int64_t number)
{
    struct beside beside = {0.0, {0.0, 0.0, 0.0}, 0.0, 0.0, 0.0, {0.0, 0.0}};
    double mass[2] = {0.0, 0.0}, volume[2] = {0.0, 0.0};
    for (int inside = 0; inside < 2; inside++) {
        const struct flank *flank = &cfdmp->side[axis][side].flank[number][inside];
        beside.density += 0.5 * flank->density;
        beside.energy += 0.5 * flank->energy;
        beside.pressure += 0.5 * flank->pressure;
        beside.sound = maximum(beside.sound, flank->sound);
        for (int k = 0; k < 3; k++)
            beside.velocity[k] += 0.5 * flank->velocity[k];
        mass[0] += flank->density - flank->second;
        mass[1] += flank->second;
        volume[0] += 1.0 - flank->fraction;
        volume[1] += flank->fraction;
    }
    for (int m = 0; m < 2; m++)
        beside.of[m] = volume[m] > 1e-6 && mass[m] > 0.0 ? mass[m] / volume[m] : 0.0;
    return beside;
}
