/* How the gas pushes on the particles through the open faces of the region, and what it pushes on
 * while they rest. */
#include <string.h>

#include "base/memory.h"
#include "couple/gates.h"

/* Whether the node AT of the part across AXIS lies near the open face on SIDE. */
static double distance_to(const struct cfdmp *cfdmp, int axis, int side, const int64_t at[3])
{
    const int64_t plane = (side ? cfdmp->cut.high : cfdmp->cut.low)[axis];
    return cfdmp->cut.open[axis][side] ? fabs((double)(at[axis] - plane)) : (double)INFINITY;
}

/* The gates around the node AT through which its force along COMPONENT comes, with equal parts:
 * across that axis where a face is near, else across another. Returns their number. */
static int gates_at(struct cfdmp *cfdmp, const int64_t at[3], int component, struct gate *gate[4])
{
    static const double near = 2.0;
    int axis = -1, side = 0, count = 0, across[2];
    double least = (double)INFINITY;
    for (int k = 0; k < 3; k++)
        for (int s = 0; s < 2; s++) {
            double distance = distance_to(cfdmp, k, s, at);
            if (distance > near)
                continue;
            distance -= k == component ? 2.0 * near : 0.0;
            if (distance < least) {
                least = distance;
                axis = k;
                side = s;
            }
        }
    if (axis < 0)
        return 0;
    gate_axes(axis, across);
    for (int k = 0; k < 4; k++) {
        int64_t cell[3] = {at[0], at[1], at[2]};
        cell[across[0]] -= k % 2;
        cell[across[1]] -= k / 2;
        gate[count++] = cfdmp_gate(cfdmp, axis, side, cell);
    }
    return count;
}

static double pressure_at(void *of, const int64_t at[3], int component)
{
    struct cfdmp *cfdmp = of;
    struct gate *gate[4];
    const int count = gates_at(cfdmp, at, component, gate);
    double sum = 0.0;
    for (int k = 0; k < count; k++)
        sum += gate[k]->pressure / count;
    return sum - mpm_gauge(cfdmp->mpm, gas_view(cfdmp->gas).material[0]);
}

static void note_push(void *of, const struct mpm_push *push)
{
    struct cfdmp *cfdmp = of;
    if (memory_reserve((void **)&cfdmp->push, &cfdmp->push_capacity, cfdmp->pushes + 1,
                       cfdmp->pushes, sizeof *push))
        cfdmp->push[cfdmp->pushes++] = *push;
    else
        cfdmp->pushes_lost = true;
}

/* The gates around a node note what they have pushed there. */
static void take_push(struct cfdmp *cfdmp, const struct mpm_push *push)
{
    const double gauge = mpm_gauge(cfdmp->mpm, gas_view(cfdmp->gas).material[0]);
    for (int c = 0; c < 3; c++) {
        struct gate *gate[4];
        const int count = gates_at(cfdmp, push->at, c, gate);
        const double gauged = -gauge * push->area[c], impulse = push->impulse[c] + gauged;
        for (int k = 0; k < count; k++) {
            gate[k]->pushed[c] += impulse / count;
            gate[k]->pushed[3] += impulse * push->velocity[c] / count;
            gate[k]->uncovered[c] += push->area[c] / count;
        }
        cfdmp->gauged[c] += gauged;
        cfdmp->gauged[3] += gauged * push->velocity[c];
    }
}

struct error *cfdmp_take_pushes(struct cfdmp *cfdmp)
{
    TRY(cfdmp_gather_pushes(cfdmp));
    memset(cfdmp->gauged, 0, sizeof cfdmp->gauged);
    for (int64_t k = 0; k < cfdmp->pushes; k++)
        take_push(cfdmp, &cfdmp->push[k]);
    cfdmp->pushes = 0;
    return NULL;
}

void cfdmp_surround(struct cfdmp *cfdmp)
{
    cfdmp->outside =
        (struct mpm_outside){.of = cfdmp, .pressure = pressure_at, .pushed = note_push};
    part_surround(cfdmp->mpm, &cfdmp->outside, &cfdmp->cut);
}

void cfdmp_note_rest(struct cfdmp *cfdmp)
{
    cfdmp_look(cfdmp);
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int64_t n = 0; n < cfdmp->side[axis][side].gates; n++)
                cfdmp->side[axis][side].gate[n].rest = cfdmp->side[axis][side].flank[n][0].pressure;
}

bool cfdmp_stirs(const struct cfdmp *cfdmp)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    const double wake = cfdmp->parameters.wake;
    bool stirs = false;
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int64_t n = 0; n < cfdmp->side[axis][side].gates && !stirs; n++) {
                int64_t at[3];
                int32_t block;
                gate_cell(cfdmp, axis, side, n, false, at);
                const int32_t i = part_cell(view.cells, at, &block);
                if (i < 0)
                    continue;
                const double now = view.cells->pressure[i],
                             rest = cfdmp->side[axis][side].gate[n].rest;
                stirs = !(now < wake * rest && rest < wake * now);
            }
    return ranks_maximum(cfdmp->ranks, stirs) > 0.0;
}

void cfdmp_lean(struct cfdmp *cfdmp, struct simulation *simulation)
{
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int64_t n = 0; n < cfdmp->side[axis][side].gates; n++) {
                struct gate *gate = &cfdmp->side[axis][side].gate[n];
                int64_t at[3];
                gate_cell(cfdmp, axis, side, n, true, at);
                for (int k = 0; k < 4; k++)
                    gate->pushed[k] = gate->push[k];
                if (cfdmp->ranks->rank > 0)
                    continue;
                ledger_book(
                    &simulation->ledger, LEDGER_WALLS, 0.0,
                    vec3_make(-gate->push[0], -gate->push[1], -gate->push[2]),
                    vec3_scale(cfdmp->edge, vec3_make((double)at[0] + 0.5, (double)at[1] + 0.5,
                                                      (double)at[2] + 0.5)),
                    -gate->push[3]);
            }
}
