/* Solids that meet; see solid_path.h. With x = ln(V/V_start),
 *   elastic  S = S_start + 4/3 G x until |S| = 2Y/3,
 *   plastic  S = -2Y/3 in compression, 2Y/3 in expansion.
 * A plastic shock that would outrun its precursor takes the solid from the start to the end in one
 * jump. */
#include "exact/solid_path.h"

#include <string.h>

#include "exact/root.h"

const struct parameter exact_solid_table[] = {
    PARAMETER(ONE_OF, struct exact_solid, eos, OPTIONAL,
              "its equation of state; default: barotropic with the next two",
              .kind_of_thing = "eos"),
    {"reference_density", PARAMETER_NUMBER, offsetof(struct exact_solid, reference_density),
     "kg/m^3", OPTIONAL, .above = 0.0, .below = INFINITY,
     .help = "of a barotropic solid: density at zero pressure"},
    {"bulk_modulus", PARAMETER_NUMBER, offsetof(struct exact_solid, bulk_modulus), "Pa", OPTIONAL,
     .above = 0.0, .below = INFINITY, .help = "of a barotropic solid: K of p = K (1 - rho_0/rho)"},
    {"shear_modulus", PARAMETER_NUMBER, offsetof(struct exact_solid, shear_modulus), "Pa", "0 Pa",
     .above = 0.0, .below = INFINITY, .closed = true, .help = "shear modulus G"},
    {"yield", PARAMETER_NUMBER, offsetof(struct exact_solid, yield), "Pa", "0 Pa", .above = 0.0,
     .below = INFINITY, .closed = true, .help = "yield strength in simple tension"},
    {"density", PARAMETER_NUMBER, offsetof(struct exact_solid, density), "kg/m^3", OPTIONAL,
     .above = 0.0, .below = INFINITY,
     .help = "density at the start; default: that of the equation of state"},
    {"velocity", PARAMETER_NUMBER, offsetof(struct exact_solid, velocity), "m/s", "0 m/s",
     .help = "velocity at the start, positive to the right"},
    {"energy", PARAMETER_NUMBER, offsetof(struct exact_solid, energy), "J/kg", "0 J/kg",
     .help = "specific internal energy at the start"},
    {"deviator", PARAMETER_NUMBER, offsetof(struct exact_solid, deviator), "Pa", "0 Pa",
     .help = "deviator along x at the start, at most 2/3 of the yield strength"},
    PARAMETER(FLAG, struct exact_solid, free, "no",
              "nothing is on this side: the other side has a free surface"),
    PARAMETER_END,
};

const char *const exact_side_names[2] = {"left", "right"};

static struct error *eos_of(const struct exact_solid *solid, const char *side, struct eos *eos)
{
    bool barotropic = !isnan(solid->reference_density) && !isnan(solid->bulk_modulus);
    bool some = !isnan(solid->reference_density) || !isnan(solid->bulk_modulus);
    if (solid->eos.value ? some : !barotropic)
        return error_new(
            ERROR_INPUT,
            "%s: needs either eos, or reference_density and bulk_modulus of a barotropic solid",
            side);
    if (solid->eos.value) {
        eos->kind = (enum eos_kind)solid->eos.index;
        memcpy(&eos->of, solid->eos.value, solid->eos.choice->size);
    } else {
        *eos = eos_make_barotropic(
            &(struct eos_barotropic){solid->reference_density, solid->bulk_modulus});
    }
    return NULL;
}

/* The strains and places at which the solid yields, given its state at the start. */
static struct error *find_limits(struct solid_path *path, double flow, const char *side)
{
    double deviator = path->start.deviator;
    if (fabs(deviator) > flow * (1.0 + 1e-12))
        return error_new(ERROR_INPUT, "%s.deviator: %g Pa is beyond 2/3 of the yield strength",
                         side, deviator);
    for (int load = COMPRESSION; load <= EXPANSION; load++) {
        double sign = load == COMPRESSION ? -1.0 : 1.0, room = flow - sign * deviator;
        path->flow[load] = sign * flow;
        /* At yield there is no elastic wave, not even one of rounding. */
        path->limit[load] = room > 1e-12 * flow ? sign * room / path->start.shear : 0.0;
        path->yield[load] = load == COMPRESSION ? solid_jump(&path->start, path->limit[load])
                                                : solid_fan(&path->start, path->limit[load]);
        if (!path->yield[load].valid)
            return error_new(ERROR_INPUT,
                             "%s: the equation of state has no sound speed between the start and "
                             "yield",
                             side);
    }
    return NULL;
}

struct error *solid_path_of(const struct exact_solid *solid, const char *side,
                            struct solid_path *path)
{
    static const double fresh[POINT_HISTORY] = {0.0};
    *path = (struct solid_path){.free = solid->free, .velocity = solid->velocity};
    if (solid->free)
        return NULL;
    TRY(eos_of(solid, side, &path->eos));
    double density = isnan(solid->density) ? eos_reference_density(&path->eos) : solid->density;
    struct eos_value value = eos_evaluate(&path->eos, density, solid->energy, fresh);
    path->fluid = !(solid->shear_modulus > 0.0 && solid->yield > 0.0);
    path->start.eos = &path->eos;
    path->start.volume = 1.0 / density;
    path->start.energy = solid->energy;
    path->start.normal = value.pressure - solid->deviator;
    path->start.deviator = solid->deviator;
    path->start.shear = path->fluid ? 0.0 : 4.0 / 3.0 * solid->shear_modulus;
    return find_limits(path, path->fluid ? 0.0 : 2.0 / 3.0 * solid->yield, side);
}

struct error *solid_path_restart(struct solid_path *path, const struct exact_state *state,
                                 const char *side)
{
    path->velocity = state->velocity;
    path->start.volume = 1.0 / state->density;
    path->start.energy = state->energy;
    path->start.normal = -state->stress;
    path->start.deviator = state->deviator;
    return find_limits(path, path->flow[EXPANSION], side);
}

static void add_wave(struct solid_response *response, struct solid_base base,
                     struct solid_place behind)
{
    response->base[response->count] = base;
    response->behind[response->count++] = behind;
}

/* A plastic wave behind the elastic one that ends at yield. */
static void flow_to(const struct solid_path *path, double pressure, enum load load,
                    struct solid_response *response)
{
    double far = load == COMPRESSION ? -INFINITY : INFINITY;
    const struct solid_place *yield = &path->yield[load];
    struct solid_base base = {.eos = &path->eos,
                              .volume = yield->volume,
                              .energy = yield->energy,
                              .normal = yield->normal,
                              .deviator = path->flow[load]};
    struct solid_place end;
    if (path->limit[load] != 0.0)
        add_wave(response, path->start, *yield);
    response->reached = solid_wave_to(&base, pressure, far, &end);
    if (load == COMPRESSION && response->count > 0 && end.chord > yield->chord) {
        response->count = 0;
        base.volume = path->start.volume;
        base.energy = path->start.energy;
        base.normal = path->start.normal;
        base.sudden = true;
        response->reached = solid_wave_to(&base, pressure, far, &end);
    }
    add_wave(response, base, end);
}

static struct solid_response respond(const struct solid_path *path, double pressure)
{
    struct solid_response response = {.reached = true};
    if (path->free)
        return response;
    enum load load = pressure > path->start.normal ? COMPRESSION : EXPANSION;
    double beyond = pressure - path->yield[load].normal;
    if (pressure == path->start.normal)
        add_wave(&response, path->start, solid_jump(&path->start, 0.0));
    else if (load == COMPRESSION ? beyond > 0.0 : beyond < 0.0)
        flow_to(path, pressure, load, &response);
    else {
        struct solid_place end;
        response.reached = solid_wave_to(&path->start, pressure, path->limit[load], &end);
        add_wave(&response, path->start, end);
    }
    return response;
}

/* The change of velocity away from the contact, and its slope over pressure. */
static struct root_value push_of(const struct solid_path *path, double pressure)
{
    struct solid_response response = respond(path, pressure);
    struct root_value push = {0.0, 0.0};
    if (!response.reached)
        return (struct root_value){pressure > path->start.normal ? INFINITY : -INFINITY, NAN};
    for (int i = 0; i < response.count; i++)
        push.value += response.behind[i].push;
    const struct solid_place *end = &response.behind[response.count - 1];
    double impedance = sqrt(end->chord);
    push.slope = 0.5 * (1.0 / impedance + impedance / end->stiffness);
    return push;
}

/* Velocity right of the contact less that left of it when both solids have PRESSURE. */
static struct root_value mismatch(const void *context, double pressure)
{
    const struct solid_path *left = (const struct solid_path *)context + SIDE_LEFT;
    const struct solid_path *right = (const struct solid_path *)context + SIDE_RIGHT;
    struct root_value back = push_of(left, pressure), forth = push_of(right, pressure);
    return (struct root_value){right->velocity - left->velocity + (back.value + forth.value),
                               back.slope + forth.slope};
}

/* Where the solids meet: neither pulls more nor is pressed harder than it bears. */
static struct error *star_pressure(const struct solid_path path[2], double *pressure)
{
    enum { DOUBLINGS = 100 };
    const struct solid_path *left = &path[SIDE_LEFT], *right = &path[SIDE_RIGHT];
    double low = minimum(left->start.normal, right->start.normal);
    double high = maximum(left->start.normal, right->start.normal);
    double start = 0.5 * (low + high), soft = 1.0;
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++)
        soft = maximum(soft, path[side].yield[EXPANSION].stiffness * path[side].start.volume);
    double step = 0.01 * soft;
    for (int i = 0; i < DOUBLINGS && mismatch(path, high).value < 0.0; i++, step *= 2.0)
        high += step;
    step = 0.01 * soft;
    for (int i = 0; i < DOUBLINGS && mismatch(path, low).value > 0.0; i++, step *= 2.0)
        low -= step;
    *pressure = root_find(mismatch, path, low, high, start);
    double left_over = mismatch(path, *pressure).value;
    double speed = sqrt(soft * maximum(left->start.volume, right->start.volume));
    if (fabs(left_over) <= 1e-9 * speed)
        return NULL;
    return error_new(ERROR_INPUT,
                     "the bodies ask for more than the %g Pa that an equation of state can bear: "
                     "it has no volume left, or comes apart",
                     *pressure);
}

struct exact_state solid_state(const struct solid_place *place, double velocity)
{
    struct exact_state state = {.density = 1.0 / place->volume, .velocity = velocity};
    state.pressure = place->normal + place->deviator;
    state.energy = place->energy;
    state.stress = -place->normal;
    state.deviator = place->deviator;
    return state;
}

struct exact_state solid_path_start(const struct solid_path *path)
{
    const struct solid_base *base = &path->start;
    const struct solid_place start = {.volume = base->volume,
                                      .energy = base->energy,
                                      .normal = base->normal,
                                      .deviator = base->deviator};
    return solid_state(&start, path->velocity);
}

/* The normal pressure at the contact and the waves that lead to it. */
static struct error *respond_both(const struct solid_path path[2], double *pressure,
                                  struct solid_response response[2])
{
    bool free = path[SIDE_LEFT].free || path[SIDE_RIGHT].free;
    if (path[SIDE_LEFT].free && path[SIDE_RIGHT].free)
        return error_new(ERROR_INPUT, "left, right: at most one of them can be free");
    *pressure = 0.0;
    if (!free)
        TRY(star_pressure(path, pressure));
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        response[side] = respond(&path[side], *pressure);
        if (!response[side].reached)
            return error_new(ERROR_INPUT,
                             "%s: comes to no state without stress for its free surface",
                             exact_side_names[side]);
    }
    return NULL;
}

/* The velocity of the contact: that of both sides, but for rounding. */
static double star_velocity_of(const struct solid_path path[2],
                               const struct solid_response response[2])
{
    double push[2] = {0.0, 0.0};
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++)
        for (int i = 0; i < response[side].count; i++)
            push[side] += response[side].behind[i].push;
    double left = path[SIDE_LEFT].velocity - push[SIDE_LEFT];
    double right = path[SIDE_RIGHT].velocity + push[SIDE_RIGHT];
    if (path[SIDE_LEFT].free)
        return right;
    return path[SIDE_RIGHT].free ? left : 0.5 * (left + right);
}

struct error *solid_meet(const struct solid_path path[2], struct solid_meeting *meeting)
{
    TRY(respond_both(path, &meeting->pressure, meeting->response));
    meeting->velocity = star_velocity_of(path, meeting->response);
    return NULL;
}
