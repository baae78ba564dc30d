/* Particles that leave the region wait at its gates. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "couple/gates.h"

/* A particle that has left through an open face of the region: where it is and how wide, in
 * cells. */
struct leaver {
    uint64_t id;
    double place[3], width, values[PASSES];
};

/* How far PLACE, in cells, is outside the open face across AXIS on SIDE. */
static double way_out(const struct cfdmp *cfdmp, int axis, int side, double place)
{
    if (!cfdmp->cut.open[axis][side])
        return -INFINITY;
    return side ? place - (double)cfdmp->cut.high[axis] : (double)cfdmp->cut.low[axis] - place;
}

/* The open face that PLACE is the farthest outside of; -1 for the axis: none. */
static int face_left(const struct cfdmp *cfdmp, const double place[3], int *side)
{
    double most = 0.0;
    int found = -1;
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int s = 0; s < 2; s++) {
            const double way = way_out(cfdmp, axis, s, place[axis]);
            if (!(way > most))
                continue;
            most = way;
            found = axis;
            *side = s;
        }
    return found;
}

/* Whether particle I of the coupling OF has left the region through an open face, and maybe through
 * an outflow since. */
static bool has_left(void *of, int32_t i)
{
    const struct cfdmp *cfdmp = of;
    const double *x = mpm_particles(cfdmp->mpm)->position[i];
    double place[3] = {0.0};
    int side;
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        place[axis] = x[axis] / cfdmp->edge;
    return face_left(cfdmp, place, &side) >= 0;
}

/* What particle I, which has left, takes along: of the SECOND material or the first. */
static struct leaver leaver_of(const struct cfdmp *cfdmp, int32_t i, bool second)
{
    const struct particles *p = mpm_particles(cfdmp->mpm);
    const double *u = p->velocity[i], m = p->mass[i];
    double kinetic = 0.0;
    struct leaver leaver = {.id = p->id[i],
                            .width = 1.0 / (double)part_particles_across(cfdmp->mpm, p->body[i])};
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        leaver.place[axis] = p->position[i][axis] / cfdmp->edge;
    for (int k = 0; k < 3; k++) {
        leaver.values[PASS_MOMENTUM + k] = m * u[k];
        kinetic += 0.5 * square(u[k]);
    }
    leaver.values[PASS_MASS] = m;
    leaver.values[PASS_ENERGY] = m * (p->energy[i] + kinetic);
    leaver.values[PASS_SECOND] = second ? m : 0.0;
    return leaver;
}

/* The cells that a particle at PLACE is in along an axis where it is WIDTH wide, and how much of it
 * is in each. */
static int cells_of(double place, double width, int64_t cell[2], double part[2])
{
    cell[0] = (int64_t)floor(place - 0.5 * width);
    cell[1] = cell[0] + 1;
    part[1] = minimum(maximum(place + 0.5 * width - (double)cell[1], 0.0) / width, 1.0);
    part[0] = 1.0 - part[1];
    return part[1] > 0.0 ? 2 : 1;
}

/* PART of a particle that has left through the face across AXIS on SIDE, and is next to the cell
 * AT, waits at the gate there; where that is outside the region, at the last gate of the face
 * between them. */
static void wait_at(struct cfdmp *cfdmp, int axis, int side, const int64_t at[3],
                    const struct leaver *leaver, double part)
{
    int across[2];
    gate_axes(axis, across);
    for (int k = 0; k < 2; k++) {
        const int a = across[k];
        const bool low = at[a] < cfdmp->cut.low[a], high = at[a] >= cfdmp->cut.high[a];
        if ((low || high) && a < cfdmp->dimension && cfdmp->cut.open[a][high]) {
            axis = a;
            side = high;
            break;
        }
    }
    struct gate *gate = cfdmp_gate(cfdmp, axis, side, at);
    for (int n = 0; n < PASSES; n++)
        gate->pending[n] += part * leaver->values[n];
}

/* A particle waits at the gates that it covers. */
static void take_leaver(struct cfdmp *cfdmp, const struct leaver *leaver)
{
    int across[2], side = 0, count[2] = {1, 1};
    const int axis = face_left(cfdmp, leaver->place, &side);
    int64_t cell[2][2] = {{0, 0}, {0, 0}};
    double part[2][2] = {{1.0, 0.0}, {1.0, 0.0}};
    gate_axes(axis, across);
    for (int k = 0; k < cfdmp->dimension - 1; k++)
        count[k] = cells_of(leaver->place[across[k]], leaver->width, cell[k], part[k]);
    for (int a = 0; a < count[0]; a++)
        for (int b = 0; b < count[1]; b++) {
            int64_t at[3];
            at[axis] = (int64_t)floor(leaver->place[axis]);
            at[across[0]] = cell[0][a];
            at[across[1]] = cell[1][b];
            wait_at(cfdmp, axis, side, at, leaver, part[0][a] * part[1][b]);
        }
}

static int by_id(const void *left, const void *right)
{
    const struct leaver *a = left, *b = right;
    return (a->id > b->id) - (a->id < b->id);
}

struct error *cfdmp_take_out(struct cfdmp *cfdmp)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    struct particles *p = mpm_particles(cfdmp->mpm);
    struct leaver *own = NULL, *all = NULL;
    int64_t count = 0;
    struct error *error = NULL;
    if (!part_pick(&cfdmp->leaving, p->count, cfdmp->mpm_part.simulation.threads, has_left, cfdmp))
        error = out_of_memory_for("the coupling");
    else if (!(own = memory_allocate(((size_t)cfdmp->leaving.count + 1) * sizeof *own)))
        error = out_of_memory_for("the coupling");
    for (int64_t k = 0; own && k < cfdmp->leaving.count; k++) {
        const int32_t i = cfdmp->leaving.index[k];
        if (particles_is_deleted(p, i)) /* gone through an outflow */
            continue;
        own[count++] = leaver_of(cfdmp, i, view.layout->two && p->material[i] == view.material[1]);
        particles_delete(p, i);
    }
    error = ranks_agree(cfdmp->ranks, error);
    if (!error)
        error = ranks_gather(cfdmp->ranks, -1, own, count, sizeof *own, (void **)&all, &count);
    free(own);
    if (error)
        return error;
    qsort(all, (size_t)count, sizeof *all, by_id);
    for (int64_t k = 0; k < count; k++)
        take_leaver(cfdmp, &all[k]);
    free(all);
    return NULL;
}
