/* The pressure on area of the gates that no particles cover. Particles drift along a face of the
 * region, and come and go in layers, so that their surface at a gate is not the area of the gate.
 * The material that waits at the gates of the adjacent face fills the difference. It bears the
 * pressure there and passes it on to the opposite side of the region, or to a wall.
 *
 * The uncovered areas U of all gates form a closed surface: their sum is zero along each axis whose
 * faces are both open. So the sum of P U is that of (P - P_min) U and vanishes in a uniform
 * pressure, and that of P u U vanishes in a uniform flow. The sums return to the gas in proportion
 * to (P - P_min) times the area of a gate. Along an axis with a wall, and along a radius, the wall
 * or the ring bears P U. */
#include "couple/gates.h"

/* Where the uncovered pressure goes along each axis, and what it needs to be shared. */
struct sharing {
    bool borne[3];         /* by a wall or a ring */
    double least, largest; /* pressure, Pa */
    double sum[4];         /* impulse and work to be shared */
    double weights;
    struct ledger *ledger; /* NULL: another rank books */
};

/* Impulse and work of the pressure on the uncovered area of a gate. */
static void find_share(const struct cfdmp *cfdmp, int axis, int side, int64_t number,
                       const struct sharing *sharing, double share[4])
{
    const struct gate *gate = &cfdmp->side[axis][side].gate[number];
    const struct beside beside = gate_beside(cfdmp, axis, side, number);
    share[3] = 0.0;
    for (int k = 0; k < 3; k++) {
        share[k] = gate->pressure * gate->uncovered[k];
        share[3] += sharing->borne[k] ? 0.0 : share[k] * beside.velocity[k];
    }
}

static double weight_of(const struct cfdmp *cfdmp, int axis, int side, int64_t number,
                        const struct sharing *sharing)
{
    static const double rounding = 1e-12, nothing = 1e-200; /* Pa */
    const double pressure = cfdmp->side[axis][side].gate[number].pressure;
    return gate_area(cfdmp, axis, side, number) *
           (pressure - sharing->least + rounding * fabs(sharing->largest) + nothing);
}

static void note_range(struct cfdmp *cfdmp, int axis, int side, int64_t number,
                       struct sharing *sharing)
{
    const double pressure = cfdmp->side[axis][side].gate[number].pressure;
    sharing->least = minimum(sharing->least, pressure);
    sharing->largest = maximum(sharing->largest, pressure);
}

static void collect(struct cfdmp *cfdmp, int axis, int side, int64_t number,
                    struct sharing *sharing)
{
    double share[4];
    find_share(cfdmp, axis, side, number, sharing, share);
    for (int k = 0; k < 4; k++)
        sharing->sum[k] += k < 3 && sharing->borne[k] ? 0.0 : share[k];
    sharing->weights += weight_of(cfdmp, axis, side, number, sharing);
}

/* Books the impulse of the gates that something else than gas bears along each axis, at AT. */
static void book_borne(const struct cfdmp *cfdmp, const struct sharing *sharing,
                       const double impulse[3], const double at[3])
{
    double borne[3];
    for (int k = 0; k < 3; k++)
        borne[k] = sharing->borne[k] ? -impulse[k] : 0.0;
    if (!sharing->ledger || (borne[0] == 0.0 && borne[1] == 0.0 && borne[2] == 0.0))
        return;
    const struct vec3 place =
        vec3_scale(cfdmp->edge, vec3_make(at[0] + 0.5, at[1] + 0.5, at[2] + 0.5));
    const double ring = cfdmp->round ? borne[0] : 0.0;
    ledger_book(sharing->ledger, LEDGER_AXIS, 0.0, vec3_make(ring, 0.0, 0.0), place, 0.0);
    ledger_book(sharing->ledger, LEDGER_WALLS, 0.0, vec3_make(borne[0] - ring, borne[1], borne[2]),
                place, 0.0);
}

static void pass_on(struct cfdmp *cfdmp, int axis, int side, int64_t number,
                    struct sharing *sharing)
{
    struct gate *gate = &cfdmp->side[axis][side].gate[number];
    const double part = weight_of(cfdmp, axis, side, number, sharing) / sharing->weights;
    double share[4];
    int64_t at[3];
    find_share(cfdmp, axis, side, number, sharing, share);
    for (int k = 0; k < 4; k++)
        gate->push[k] += part * sharing->sum[k] - share[k];
    gate_cell(cfdmp, axis, side, number, true, at);
    book_borne(cfdmp, sharing, share,
               (const double[3]){(double)at[0], (double)at[1], (double)at[2]});
}

static void for_each_gate(struct cfdmp *cfdmp,
                          void (*function)(struct cfdmp *, int axis, int side, int64_t number,
                                           struct sharing *sharing),
                          struct sharing *sharing)
{
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            for (int64_t n = 0; n < cfdmp->side[axis][side].gates; n++)
                function(cfdmp, axis, side, n, sharing);
}

/* The pushes include the ambient pressure, which the forces of the particles leave out: walls and
 * rings bear it, and its work is in the ledger already. */
static void book_gauged(const struct cfdmp *cfdmp, struct sharing *sharing)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    if (sharing->ledger)
        ledger_book(sharing->ledger, LEDGER_LOADS, 0.0, vec3_make(0.0, 0.0, 0.0),
                    vec3_make(0.0, 0.0, 0.0), -cfdmp->gauged[3]);
    book_borne(cfdmp, sharing, cfdmp->gauged, origin);
    for (int k = 0; k < 3; k++)
        sharing->sum[k] += sharing->borne[k] ? 0.0 : cfdmp->gauged[k];
}

void cfdmp_share_uncovered(struct cfdmp *cfdmp, struct simulation *simulation)
{
    struct sharing sharing = {.least = INFINITY, .largest = -INFINITY};
    if (cfdmp->ranks->rank == 0)
        sharing.ledger = &simulation->ledger;
    for (int k = 0; k < 3; k++)
        sharing.borne[k] =
            !cfdmp->cut.open[k][0] || !cfdmp->cut.open[k][1] || (cfdmp->round && k == 0);
    for_each_gate(cfdmp, note_range, &sharing);
    book_gauged(cfdmp, &sharing);
    for_each_gate(cfdmp, collect, &sharing);
    for_each_gate(cfdmp, pass_on, &sharing);
}
