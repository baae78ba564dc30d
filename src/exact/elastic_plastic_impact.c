/* Front tracking; see elastic_plastic_impact.h. All fronts stay in a list, with birth, end and the
 * states on both sides; those that exist at a time give the solution, and divide it from left to
 * right. */
#include "exact/elastic_plastic_impact.h"

#include <string.h>

enum front_kind {
    FRONT_JUMP,
    FRONT_ELASTIC_FAN,
    FRONT_PLASTIC_FAN,
    FRONT_SLIP,
    FRONT_INTERFACE,
    FRONT_FREE
};

static bool is_fan(enum front_kind kind)
{
    return kind == FRONT_ELASTIC_FAN || kind == FRONT_PLASTIC_FAN;
}

struct front {
    double birth, end; /* s; end INFINITY: it still exists when the tracking stops */
    double x, speed;   /* place at birth */
    struct exact_state left, right;
    enum front_kind kind;
    int family; /* the fan to which a piece belongs */
    double direction;
};

enum { FRONTS_MOST = 8192, ALIVE_MOST = 1024, LEAVING_MOST = 256, EVENTS_MOST = 100000 };

struct impact {
    double until;
    int fronts, alive_count, families;
    struct front front[FRONTS_MOST]; /* of one birth: from left to right */
    int alive[ALIVE_MOST];
    double touch;  /* m: fronts as near as that meet */
    bool crowded;  /* they met too often */
    double coarse; /* factor on the strains of pieces and of weak waves */
};

/* The strain of a piece of a fan. Waves and slips with a relative change of density below WEAK are
 * dropped; the next Riemann problem includes their change. Waves between a surface and an
 * approaching shock become ever faster and weaker: fronts closer than NEAR thicknesses are merged,
 * and all tolerances grow where there are still too many interactions. */
static const double piece_strain = 1.0 / 2048.0, weak = 3e-6, near = 1e-4;
enum { COARSEST = 512 };

const struct parameter exact_elastic_plastic_impact_table[] = {
    {"left", PARAMETER_TABLE, offsetof(struct exact_elastic_plastic_impact, solid[SIDE_LEFT]),
     .standard = REQUIRED, .help = "the body on the left", .table = exact_solid_table},
    {"right", PARAMETER_TABLE, offsetof(struct exact_elastic_plastic_impact, solid[SIDE_RIGHT]),
     .standard = REQUIRED, .help = "the body on the right", .table = exact_solid_table},
    {"at", PARAMETER_NUMBER, offsetof(struct exact_elastic_plastic_impact, at), "m", "0 mm",
     .help = "position of the contact at the start"},
    {"left_end", PARAMETER_NUMBER, offsetof(struct exact_elastic_plastic_impact, rear[SIDE_LEFT]),
     "m", OPTIONAL, .help = "position of the free rear surface of the left body; default: none"},
    {"right_end", PARAMETER_NUMBER, offsetof(struct exact_elastic_plastic_impact, rear[SIDE_RIGHT]),
     "m", OPTIONAL, .help = "position of the free rear surface of the right body; default: none"},
    {"until", PARAMETER_NUMBER, offsetof(struct exact_elastic_plastic_impact, until), "s", REQUIRED,
     .above = 0.0, .below = INFINITY, .help = "time up to which the waves are followed"},
    PARAMETER_END,
};

static double place_of(const struct front *front, double time)
{
    return front->x + front->speed * (time - front->birth);
}

/* The fronts that leave one side of a meeting, from the outermost. */
struct leaving {
    int count;
    double coarse;
    struct front front[LEAVING_MOST];
};

static bool is_weak(const struct exact_state *a, const struct exact_state *b, double coarse)
{
    return fabs(a->density - b->density) < coarse * weak * a->density;
}

/* A front that moves in DIRECTION between OUTER and the other state, with the speed given by
 * conservation of mass. */
static void leave(struct leaving *leaving, double direction, enum front_kind kind,
                  const struct exact_state *outer, const struct exact_state *inner)
{
    if (is_weak(outer, inner, leaving->coarse) || leaving->count == LEAVING_MOST)
        return;
    double flow = inner->density * inner->velocity - outer->density * outer->velocity;
    leaving->front[leaving->count++] =
        (struct front){.speed = flow / (inner->density - outer->density),
                       .left = direction < 0.0 ? *outer : *inner,
                       .right = direction < 0.0 ? *inner : *outer,
                       .kind = kind,
                       .direction = direction};
}

static void leave_in_pieces(struct leaving *leaving, double direction,
                            const struct solid_base *base, const struct exact_state *outer,
                            const struct exact_state *inner, double strain)
{
    const int most = LEAVING_MOST / WAVES_A_SIDE;
    int pieces = 1 + (int)minimum(strain / (leaving->coarse * piece_strain), most - 1);
    struct exact_state before = *outer;
    for (int i = 1; i <= pieces; i++) {
        struct solid_place place = solid_fan(base, strain * i / pieces);
        struct exact_state behind =
            i == pieces ? *inner : solid_state(&place, outer->velocity + direction * place.push);
        leave(leaving, direction, base->shear > 0.0 ? FRONT_ELASTIC_FAN : FRONT_PLASTIC_FAN,
              &before, &behind);
        before = behind;
    }
}

/* Computes the waves of SIDE; *star becomes the state at the contact. */
static void leave_side(const struct solid_path *path, enum exact_side side,
                       const struct solid_meeting *meeting, struct leaving *leaving,
                       struct exact_state *star)
{
    const struct solid_response *response = &meeting->response[side];
    double direction = side_direction(side);
    *star = solid_path_start(path);
    for (int i = 0; i < response->count; i++) {
        struct solid_place place = response->behind[i];
        bool last = i == response->count - 1;
        double velocity = last ? meeting->velocity : star->velocity + direction * place.push;
        place.normal = last ? meeting->pressure : place.normal;
        struct exact_state behind = solid_state(&place, velocity);
        if (solid_wave_is_fan(response, i))
            leave_in_pieces(leaving, direction, &response->base[i], star, &behind, place.strain);
        else
            leave(leaving, direction, FRONT_JUMP, star, &behind);
        *star = behind;
    }
}

/* Resolves the interaction at X of the active fronts FIRST to LAST. */
struct encounter {
    int first, last;
    double x, time;
};

/* The fan to which a piece that arrives with DIRECTION belongs, or a new one. */
static int family_of(struct impact *impact, const struct encounter *meeting, double direction)
{
    for (int i = meeting->first; i <= meeting->last; i++) {
        const struct front *front = &impact->front[impact->alive[i]];
        if (is_fan(front->kind) && front->direction == direction)
            return front->family;
    }
    return ++impact->families;
}

static struct error *too_many(struct impact *impact, const char *what)
{
    impact->crowded = true;
    return error_new(ERROR_INPUT, "the waves meet too often to be followed: too many %s", what);
}

/* Puts the COUNT fronts FRESH in place of those that meet. */
static struct error *replace(struct impact *impact, const struct encounter *meeting,
                             const struct front *fresh, int count)
{
    int gone = meeting->last - meeting->first + 1, after = impact->alive_count - meeting->last - 1;
    if (impact->fronts + count > FRONTS_MOST || impact->alive_count + count - gone > ALIVE_MOST)
        return too_many(impact, "fronts");
    for (int i = meeting->first; i <= meeting->last; i++)
        impact->front[impact->alive[i]].end = meeting->time;
    memmove(&impact->alive[meeting->first + count], &impact->alive[meeting->last + 1],
            (size_t)after * sizeof impact->alive[0]);
    impact->alive_count += count - gone;
    for (int i = 0; i < count; i++) {
        struct front *front = &impact->front[impact->fronts];
        *front = fresh[i];
        front->birth = meeting->time;
        front->end = INFINITY;
        front->x = meeting->x;
        impact->alive[meeting->first + i] = impact->fronts++;
    }
    return NULL;
}

/* The front between the two sides of an interaction: the interface, a surface, or a slip line. */
static struct front middle_of(const struct impact *impact, const struct encounter *meeting,
                              const struct solid_meeting *found, const struct exact_state star[2])
{
    struct front middle = {.speed = found->velocity,
                           .left = star[SIDE_LEFT],
                           .right = star[SIDE_RIGHT],
                           .kind = FRONT_SLIP};
    for (int i = meeting->first; i <= meeting->last; i++) {
        enum front_kind kind = impact->front[impact->alive[i]].kind;
        middle.kind = kind > middle.kind ? kind : middle.kind;
    }
    return middle;
}

/* The side of the interface on which active front INDEX lies; AT_IT for the interface itself. */
static enum exact_side side_of(const struct impact *impact, int index, enum exact_side at_it)
{
    for (int i = 0; i < impact->alive_count; i++)
        if (impact->front[impact->alive[i]].kind == FRONT_INTERFACE)
            return index < i ? SIDE_LEFT : index > i ? SIDE_RIGHT : at_it;
    return at_it;
}

/* Solves the Riemann problem of the outermost states, of SOLID. */
static struct error *resolve(struct impact *impact, const struct exact_solid solid[2],
                             const struct encounter *meeting)
{
    const struct front *first = &impact->front[impact->alive[meeting->first]];
    const struct front *last = &impact->front[impact->alive[meeting->last]];
    const struct exact_state *outer[2] = {&first->left, &last->right};
    const bool free[2] = {first->left.density == 0.0, last->right.density == 0.0};
    const enum exact_side from[2] = {side_of(impact, meeting->first, SIDE_LEFT),
                                     side_of(impact, meeting->last, SIDE_RIGHT)};
    struct solid_path path[2];
    struct solid_meeting found;
    struct exact_state star[2];
    struct leaving leaving[2];
    struct front fresh[2 * LEAVING_MOST + 1];
    int count = 0;
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        struct exact_solid own = solid[from[side]];
        own.free = free[side];
        TRY(solid_path_of(&own, exact_side_names[from[side]], &path[side]));
        if (!free[side])
            TRY(solid_path_restart(&path[side], outer[side], exact_side_names[from[side]]));
    }
    TRY(solid_meet(path, &found));
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        leaving[side].count = 0;
        leaving[side].coarse = impact->coarse;
        star[side] = (struct exact_state){.velocity = found.velocity};
        if (!free[side])
            leave_side(&path[side], (enum exact_side)side, &found, &leaving[side], &star[side]);
        int family = family_of(impact, meeting, side_direction(side));
        for (int i = 0; i < leaving[side].count; i++)
            leaving[side].front[i].family = family;
    }
    for (; count < leaving[SIDE_LEFT].count; count++)
        fresh[count] = leaving[SIDE_LEFT].front[count];
    const struct front middle = middle_of(impact, meeting, &found, star);
    if (middle.kind != FRONT_SLIP || !is_weak(&middle.left, &middle.right, impact->coarse))
        fresh[count++] = middle;
    for (int i = leaving[SIDE_RIGHT].count; i-- > 0;)
        fresh[count++] = leaving[SIDE_RIGHT].front[i];
    return replace(impact, meeting, fresh, count);
}

/* The time at which active front INDEX meets the next one; INFINITY: never. */
static double meeting_time(const struct impact *impact, int index)
{
    const struct front *a = &impact->front[impact->alive[index]];
    const struct front *b = &impact->front[impact->alive[index + 1]];
    double closing = a->speed - b->speed, born = maximum(a->birth, b->birth);
    if (closing <= 1e-9 * (fabs(a->speed) + fabs(b->speed)))
        return INFINITY;
    return born + maximum(place_of(b, born) - place_of(a, born), 0.0) / closing;
}

/* Whether active front INDEX is within the merging distance of MEETING, whose fronts have SPEED. */
static bool joins(const struct impact *impact, const struct encounter *meeting, int index,
                  const double speed[2])
{
    if (index < 0 || index >= impact->alive_count)
        return false;
    const struct front *front = &impact->front[impact->alive[index]];
    bool comes = index < meeting->first ? front->speed > speed[0] : front->speed < speed[1];
    return comes && fabs(place_of(front, meeting->time) - meeting->x) < impact->touch;
}

/* Extends MEETING by the fronts within the merging distance. */
static void widen(const struct impact *impact, struct encounter *meeting)
{
    for (bool grown = true; grown;) {
        double speed[2] = {INFINITY, -INFINITY}; /* the slowest and the fastest */
        for (int i = meeting->first; i <= meeting->last; i++) {
            speed[0] = minimum(speed[0], impact->front[impact->alive[i]].speed);
            speed[1] = maximum(speed[1], impact->front[impact->alive[i]].speed);
        }
        bool left = joins(impact, meeting, meeting->first - 1, speed);
        bool right = joins(impact, meeting, meeting->last + 1, speed);
        meeting->first -= left;
        meeting->last += right;
        grown = left || right;
    }
}

static struct encounter next_meeting(const struct impact *impact)
{
    struct encounter next = {.time = INFINITY};
    for (int i = 0; i + 1 < impact->alive_count; i++) {
        double time = meeting_time(impact, i);
        if (time < next.time)
            next = (struct encounter){i, i + 1, 0.0, time};
    }
    if (isinf(next.time))
        return next;
    next.x = place_of(&impact->front[impact->alive[next.first]], next.time);
    widen(impact, &next);
    return next;
}

/* Adds a front at PLACE that is resolved at the start. */
static void begin(struct impact *impact, double place, enum front_kind kind,
                  struct exact_state left, struct exact_state right)
{
    impact->front[impact->fronts] =
        (struct front){.end = INFINITY, .x = place, .left = left, .right = right, .kind = kind};
    impact->alive[impact->alive_count++] = impact->fronts++;
}

static struct error *start(struct impact *impact, const struct exact_elastic_plastic_impact *input)
{
    struct exact_state state[2] = {{0}}, nothing = {0};
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        struct solid_path path;
        double depth = side_direction(side) * (input->rear[side] - input->at);
        TRY(solid_path_of(&input->solid[side], exact_side_names[side], &path));
        if (path.free)
            return error_new(ERROR_INPUT, "%s: two bodies meet; neither can be free",
                             exact_side_names[side]);
        if (depth <= 0.0)
            return error_new(ERROR_INPUT, "%s_end: must lie on the %s of `at`",
                             exact_side_names[side], exact_side_names[side]);
        state[side] = solid_path_start(&path);
        if (!isnan(depth))
            impact->touch = near * maximum(depth, impact->touch);
    }
    impact->until = input->until;
    if (!isnan(input->rear[SIDE_LEFT]))
        begin(impact, input->rear[SIDE_LEFT], FRONT_FREE, nothing, state[SIDE_LEFT]);
    begin(impact, input->at, FRONT_INTERFACE, state[SIDE_LEFT], state[SIDE_RIGHT]);
    if (!isnan(input->rear[SIDE_RIGHT]))
        begin(impact, input->rear[SIDE_RIGHT], FRONT_FREE, state[SIDE_RIGHT], nothing);
    for (int i = impact->alive_count; i-- > 0;)
        TRY(resolve(impact, input->solid,
                    &(struct encounter){i, i, impact->front[impact->alive[i]].x, 0.0}));
    return NULL;
}

static struct error *follow(struct impact *impact, const struct exact_elastic_plastic_impact *input)
{
    TRY(start(impact, input));
    for (int event = 0; event < EVENTS_MOST; event++) {
        struct encounter next = next_meeting(impact);
        if (next.time > input->until)
            return NULL;
        TRY(resolve(impact, input->solid, &next));
    }
    return too_many(impact, "meetings");
}

static struct error *impact_solve(const void *parameters, void *solved)
{
    struct impact *impact = solved;
    for (int coarse = 1;; coarse *= 2) {
        impact->coarse = coarse;
        impact->crowded = false;
        impact->fronts = impact->alive_count = impact->families = 0;
        impact->touch = 0.0;
        struct error *error = follow(impact, parameters);
        if (!error || !impact->crowded || coarse >= COARSEST)
            return error;
        error_free(error);
    }
}

static bool is_alive_at(const struct front *front, double time)
{
    return time >= front->birth && time < front->end;
}

/* The fronts about X at TIME; NULL: there is none on that side. */
struct between {
    const struct front *left, *right, *interface;
};

static struct between find_between(const struct impact *impact, double x, double time)
{
    struct between found = {NULL, NULL, NULL};
    for (int i = 0; i < impact->fronts; i++) {
        const struct front *front = &impact->front[i];
        if (!is_alive_at(front, time))
            continue;
        double at = place_of(front, time);
        if (front->kind == FRONT_INTERFACE)
            found.interface = front;
        if (at <= x && (!found.left || at >= place_of(found.left, time)))
            found.left = front;
        if (at > x && (!found.right || at < place_of(found.right, time)))
            found.right = front;
    }
    return found;
}

/* The state SHARE of the way from the middle of piece A to that of piece B. */
static struct exact_state mix(const struct front *a, const struct front *b, double share)
{
    const double wa = 0.5 * (1.0 - share), wb = 0.5 * share;
#define MIX(of) (wa * (a->left.of + a->right.of) + wb * (b->left.of + b->right.of))
    return (struct exact_state){MIX(density), MIX(velocity), MIX(pressure), MIX(energy),
                                MIX(stress),  MIX(deviator), NAN,           0.0};
#undef MIX
}

static bool same_fan(const struct front *a, const struct front *b)
{
    return is_fan(a->kind) && a->kind == b->kind && a->family == b->family &&
           a->direction == b->direction;
}

static struct exact_state impact_sample(const void *solved, enum exact_side side, double x,
                                        double time)
{
    const struct impact *impact = solved;
    const struct exact_state unknown = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    if (time > impact->until * (1.0 + 1e-9))
        return unknown;
    const struct between at = find_between(impact, x, time);
    assert(at.interface);
    double contact = place_of(at.interface, time);
    if (side == SIDE_LEFT && x >= contact)
        return at.interface->left;
    if (side == SIDE_RIGHT && x < contact)
        return at.interface->right;
    if (!at.left) /* outside a free surface, the state at the surface */
        return at.right->left.density > 0.0 ? at.right->left : at.right->right;
    if (at.left->right.density == 0.0)
        return at.left->left;
    if (!at.right || !same_fan(at.left, at.right))
        return at.left->right;
    double low = place_of(at.left, time);
    return mix(at.left, at.right, (x - low) / (place_of(at.right, time) - low));
}

static double impact_contact(const void *solved, double time)
{
    const struct impact *impact = solved;
    const struct between at = find_between(impact, 0.0, time);
    return place_of(at.interface, time);
}

/* The outermost wave on SIDE at TIME; NULL: there is none. */
static const struct front *outermost(const struct impact *impact, enum exact_side side, double time)
{
    const struct front *found = NULL;
    double direction = side_direction(side);
    for (int i = 0; i < impact->fronts; i++) {
        const struct front *front = &impact->front[i];
        if (is_alive_at(front, time) && front->kind <= FRONT_PLASTIC_FAN &&
            (!found || direction * (place_of(front, time) - place_of(found, time)) > 0.0))
            found = front;
    }
    return found;
}

static int impact_numbers(const void *solved, double time, struct exact_number *numbers)
{
    static const char *const names[2][4] = {
        {"left end velocity", "left end place", "leftmost wave speed", "leftmost wave place"},
        {"right end velocity", "right end place", "rightmost wave speed", "rightmost wave place"}};
    const struct impact *impact = solved;
    struct number_list list = {numbers, 0};
    const struct front *contact = find_between(impact, 0.0, time).interface;
    assert(contact);
    number_add(&list, "contact velocity", "m/s", contact->speed);
    number_add(&list, "contact normal pressure", "Pa", 0.0 - contact->left.stress);
    number_add(&list, "contact place", "m", place_of(contact, time));
    number_add(&list, "strain of a piece of a fan", "", impact->coarse * piece_strain);
    for (int i = 0; i < impact->fronts; i++) {
        const struct front *front = &impact->front[i];
        if (!is_alive_at(front, time) || front->kind != FRONT_FREE)
            continue;
        enum exact_side side = front->left.density == 0.0 ? SIDE_LEFT : SIDE_RIGHT;
        number_add(&list, names[side][0], "m/s", front->speed);
        number_add(&list, names[side][1], "m", place_of(front, time));
    }
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        const struct front *wave = outermost(impact, (enum exact_side)side, time);
        if (wave) {
            number_add(&list, names[side][2], "m/s", wave->speed);
            number_add(&list, names[side][3], "m", place_of(wave, time));
        }
    }
    return list.count;
}

const struct exact_class exact_elastic_plastic_impact_class = {
    .size = sizeof(struct impact),
    .solve = impact_solve,
    .sample = impact_sample,
    .numbers = impact_numbers,
    .contact = impact_contact,
};
