/* Gates through which material leaves exchange what waits there with their neighbours. Particles
 * leave at places that repeat with each layer, so that one gate always gets more of them than its
 * flow, and the next one less, although all of them together get as much as all flow. */
#include <string.h>

#include "couple/gates.h"

/* A gate, where its change is collected, its area and the state beside it. */
struct waiting {
    const struct gate *gate;
    double *change, area;
    struct beside beside;
};

static struct waiting waiting_at(struct cfdmp *cfdmp, int axis, int side, const int64_t at[3])
{
    const struct side *of = &cfdmp->side[axis][side];
    const struct gate *gate = cfdmp_gate(cfdmp, axis, side, at);
    const int64_t number = gate - of->gate;
    return (struct waiting){gate, of->rest[number], gate_area(cfdmp, axis, side, number),
                            gate_beside(cfdmp, axis, side, number)};
}

/* Whether two gates may exchange: material leaves, and of the same kinds. */
static bool are_alike(const struct waiting *a, const struct waiting *b)
{
    bool alike = a->gate->flow < 0.0 && b->gate->flow < 0.0;
    for (int m = 0; m < 2; m++)
        alike &= (a->beside.of[m] > 0.0) == (b->beside.of[m] > 0.0);
    return alike;
}

static double speed_of(const struct beside *beside)
{
    const double *u = beside->velocity;
    return sqrt(square(u[0]) + square(u[1]) + square(u[2]));
}

/* Two gates exchange a part of their difference by area: all of it in the time in which the flow
 * crosses a cell, but never more than is stable with four neighbours. */
static void exchange(const struct cfdmp *cfdmp, struct waiting *a, struct waiting *b, double dt)
{
    static const double most = 0.125;
    if (!are_alike(a, b))
        return;
    const double speed = maximum(speed_of(&a->beside), speed_of(&b->beside)),
                 part = minimum(dt * speed / cfdmp->edge, most) * minimum(a->area, b->area);
    for (int n = 0; n < PASSES; n++) {
        const double passes =
            part * (a->gate->pending[n] / a->area - b->gate->pending[n] / b->area);
        a->change[n] -= passes;
        b->change[n] += passes;
    }
}

/* Gate NUMBER of the face across AXIS on SIDE exchanges with the next one along each other axis,
 * and at an edge of the region with that of the adjacent face. */
static void exchange_around(struct cfdmp *cfdmp, int axis, int side, int64_t number, double dt)
{
    int64_t at[3];
    gate_cell(cfdmp, axis, side, number, true, at);
    struct waiting own = waiting_at(cfdmp, axis, side, at);
    if (!(own.gate->flow < 0.0))
        return;
    for (int a = 0; a < cfdmp->dimension; a++) {
        int64_t next[3] = {at[0], at[1], at[2]};
        next[a]++;
        if (a != axis && next[a] < cfdmp->cut.high[a]) {
            struct waiting other = waiting_at(cfdmp, axis, side, next);
            exchange(cfdmp, &own, &other, dt);
        }
        for (int s = 0; s < 2 && a > axis; s++) {
            const int64_t last = s ? cfdmp->cut.high[a] - 1 : cfdmp->cut.low[a];
            if (!cfdmp->cut.open[a][s] || at[a] != last)
                continue;
            struct waiting other = waiting_at(cfdmp, a, s, at);
            exchange(cfdmp, &own, &other, dt);
        }
    }
}

void cfdmp_even_out(struct cfdmp *cfdmp, double dt)
{
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int s = 0; s < 2; s++)
            for (int64_t n = 0; n < cfdmp->side[axis][s].gates; n++)
                memset(cfdmp->side[axis][s].rest[n], 0, sizeof *cfdmp->side[axis][s].rest);
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int s = 0; s < 2; s++)
            for (int64_t n = 0; n < cfdmp->side[axis][s].gates; n++)
                exchange_around(cfdmp, axis, s, n, dt);
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int s = 0; s < 2; s++)
            for (int64_t n = 0; n < cfdmp->side[axis][s].gates; n++)
                for (int k = 0; k < PASSES; k++)
                    cfdmp->side[axis][s].gate[n].pending[k] += cfdmp->side[axis][s].rest[n][k];
}
