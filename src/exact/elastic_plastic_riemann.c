/* The elastic-plastic Riemann problem; see elastic_plastic_riemann.h. With x = ln(V/V_start),
 *   elastic  S = S_start + 4/3 G x until |S| = 2Y/3,
 *   plastic  S = -2Y/3 in compression, 2Y/3 in expansion,
 * each side sends out an elastic wave and, if that does not suffice, a plastic one behind it. A plastic
 * shock that would outrun its precursor takes the solid from the start to the end in one jump.
 * Sources: Wang, Chen and Huang (2024) for any equation of state; Parshikov (2013), section 2.1, for
 * barotropic solids. The solution is exact for these relations. */
#include "exact/elastic_plastic_riemann.h"

#include <string.h>

#include "exact/root.h"
#include "exact/solid_wave.h"
#include "exact/waves.h"

enum load { COMPRESSION, EXPANSION };

/* A solid as its waves see it. */
struct path {
    struct eos eos;
    bool free, fluid;
    double velocity;
    struct solid_base start;     /* elastic; of a fluid, as plastic */
    double limit[2];             /* strains at yield by enum load: <= 0, >= 0; zero: a fluid */
    double flow[2];              /* the deviators there */
    struct solid_place yield[2]; /* behind the elastic waves that end there */
};

struct solid_problem {
    struct waves waves; /* first: waves.h */
    struct path path[2];
    struct solid_base base[2][WAVES_A_SIDE]; /* ahead of each wave */
};

static const struct parameter solid_table[] = {
    {.key = "eos",
     .kind = PARAMETER_ONE_OF,
     .offset = offsetof(struct exact_solid, eos),
     .standard = PARAMETER_OPTIONAL,
     .help = "its equation of state; not given: barotropic, of the next two",
     .kind_of_thing = "eos"},
    {"reference_density", PARAMETER_NUMBER, offsetof(struct exact_solid, reference_density),
     "kg/m^3", PARAMETER_OPTIONAL, .above = 0.0, .below = INFINITY,
     .help = "of a barotropic solid: density at zero pressure"},
    {"bulk_modulus", PARAMETER_NUMBER, offsetof(struct exact_solid, bulk_modulus), "Pa",
     PARAMETER_OPTIONAL, .above = 0.0, .below = INFINITY,
     .help = "of a barotropic solid: K of p = K (1 - rho_0/rho)"},
    {"shear_modulus", PARAMETER_NUMBER, offsetof(struct exact_solid, shear_modulus), "Pa", "0 Pa",
     .above = 0.0, .below = INFINITY, .closed = true, .help = "shear modulus G"},
    {"yield", PARAMETER_NUMBER, offsetof(struct exact_solid, yield), "Pa", "0 Pa", .above = 0.0,
     .below = INFINITY, .closed = true, .help = "yield strength in simple tension"},
    {"density", PARAMETER_NUMBER, offsetof(struct exact_solid, density), "kg/m^3",
     PARAMETER_OPTIONAL, .above = 0.0, .below = INFINITY,
     .help = "density at the start; that of the equation of state if not given"},
    {"velocity", PARAMETER_NUMBER, offsetof(struct exact_solid, velocity), "m/s", "0 m/s",
     .help = "velocity at the start, positive to the right"},
    {"energy", PARAMETER_NUMBER, offsetof(struct exact_solid, energy), "J/kg", "0 J/kg",
     .help = "specific internal energy at the start"},
    {"deviator", PARAMETER_NUMBER, offsetof(struct exact_solid, deviator), "Pa", "0 Pa",
     .help = "deviator along x at the start, at most 2/3 of the yield strength"},
    {.key = "free",
     .kind = PARAMETER_FLAG,
     .offset = offsetof(struct exact_solid, free),
     .standard = "no",
     .help = "nothing is on this side: the surface of the other one is free"},
    PARAMETER_END,
};

const struct parameter exact_elastic_plastic_riemann_table[] = {
    {"left", PARAMETER_TABLE, offsetof(struct exact_elastic_plastic_riemann, solid[SIDE_LEFT]),
     .standard = PARAMETER_REQUIRED, .help = "the solid left of the contact", .table = solid_table},
    {"right", PARAMETER_TABLE, offsetof(struct exact_elastic_plastic_riemann, solid[SIDE_RIGHT]),
     .standard = PARAMETER_REQUIRED, .help = "the solid right of the contact",
     .table = solid_table},
    {"at", PARAMETER_NUMBER, offsetof(struct exact_elastic_plastic_riemann, at), "m", "0 mm",
     .help = "place of the contact at the start"},
    PARAMETER_END,
};

static const char *const side_names[2] = {"left", "right"};

static struct error *eos_of(const struct exact_solid *solid, const char *side, struct eos *eos)
{
    bool barotropic = !isnan(solid->reference_density) && !isnan(solid->bulk_modulus);
    bool some = !isnan(solid->reference_density) || !isnan(solid->bulk_modulus);
    if (solid->eos.value ? some : !barotropic)
        return error_new(ERROR_INPUT,
                         "%s: wants either eos, or reference_density and bulk_modulus of a "
                         "barotropic solid",
                         side);
    if (solid->eos.value) {
        eos->kind = (enum eos_kind)solid->eos.index;
        memcpy(&eos->of, solid->eos.value, solid->eos.choice->size);
    } else {
        eos->kind = EOS_barotropic;
        eos->of.barotropic.density = solid->reference_density;
        eos->of.barotropic.bulk_modulus = solid->bulk_modulus;
    }
    return NULL;
}

/* The strains and places at which the solid yields, given its state at the start. */
static struct error *find_limits(struct path *path, double yield, double deviator, const char *side)
{
    double flow = path->fluid ? 0.0 : 2.0 / 3.0 * yield;
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

static struct error *path_of(const struct exact_solid *solid, const char *side, struct path *path)
{
    static const double fresh[1] = {0.0};
    *path = (struct path){.free = solid->free, .velocity = solid->velocity};
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
    return find_limits(path, solid->yield, solid->deviator, side);
}

/* The waves of one side: each from its base to its place. */
struct response {
    int count;
    bool reached; /* the solid bears the pressure */
    struct solid_base base[WAVES_A_SIDE];
    struct solid_place behind[WAVES_A_SIDE];
};

static void add_wave(struct response *response, struct solid_base base, struct solid_place behind)
{
    response->base[response->count] = base;
    response->behind[response->count++] = behind;
}

/* A plastic wave behind the elastic one that ends at yield. */
static void flow_to(const struct path *path, double pressure, enum load load,
                    struct response *response)
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

static struct response respond(const struct path *path, double pressure)
{
    struct response response = {.reached = true};
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
static struct root_value push_of(const struct path *path, double pressure)
{
    struct response response = respond(path, pressure);
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
    const struct path *left = (const struct path *)context + SIDE_LEFT;
    const struct path *right = (const struct path *)context + SIDE_RIGHT;
    struct root_value back = push_of(left, pressure), forth = push_of(right, pressure);
    return (struct root_value){right->velocity - left->velocity + (back.value + forth.value),
                               back.slope + forth.slope};
}

/* Where the solids meet: neither pulls more nor is pressed harder than it bears. */
static struct error *star_pressure(const struct path path[2], double *pressure)
{
    enum { DOUBLINGS = 100 };
    const struct path *left = &path[SIDE_LEFT], *right = &path[SIDE_RIGHT];
    double low = minimum(left->start.normal, right->start.normal);
    double high = maximum(left->start.normal, right->start.normal);
    double start = 0.5 * (low + high), soft = 1.0;
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++)
        soft = maximum(soft, path[side].yield[EXPANSION].stiffness * path[side].start.volume);
    double step = soft;
    for (int i = 0; i < DOUBLINGS && mismatch(path, high).value < 0.0; i++, step *= 2.0)
        high += step;
    step = soft;
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

static struct exact_state state_at(const struct solid_place *place, double velocity)
{
    struct exact_state state = {.density = 1.0 / place->volume, .velocity = velocity};
    state.pressure = place->normal + place->deviator;
    state.energy = place->energy;
    state.stress = -place->normal;
    state.deviator = place->deviator;
    return state;
}

static enum wave_kind kind_of(const struct path *path, const struct solid_base *base, bool fan)
{
    if (path->fluid)
        return fan ? WAVE_FAN : WAVE_SHOCK;
    if (base->shear > 0.0)
        return fan ? WAVE_ELASTIC_FAN : WAVE_ELASTIC;
    return fan ? WAVE_PLASTIC_FAN : WAVE_PLASTIC;
}

/* The waves that take a side to its star state, from the outermost. */
static void set_waves(struct solid_problem *problem, enum exact_side side,
                      const struct response *response, double pressure, double star_velocity)
{
    const struct path *path = &problem->path[side];
    double direction = side_direction(side), velocity = path->velocity;
    problem->waves.count[side] = response->count;
    for (int i = 0; i < response->count; i++) {
        struct solid_place behind = response->behind[i];
        const struct solid_base *base = &response->base[i];
        struct wave *wave = &problem->waves.wave[side][i];
        bool last = i == response->count - 1;
        bool fan = behind.strain > 0.0 && behind.chord == behind.stiffness;
        double ahead = fan ? solid_fan(base, 0.0).stiffness : behind.chord;
        problem->base[side][i] = *base;
        wave->kind = kind_of(path, base, fan);
        wave->head = velocity + direction * base->volume * sqrt(ahead);
        velocity = last ? star_velocity : velocity + direction * behind.push;
        wave->tail =
            fan ? velocity + direction * behind.volume * sqrt(behind.stiffness) : wave->head;
        behind.normal = last ? pressure : behind.normal;
        wave->behind = state_at(&behind, velocity);
    }
}

struct fan_target {
    const struct solid_base *base;
    double speed,
        fall; /* away from the contact, relative to the solid ahead; its fall over strain */
};

/* The target's speed less that of the characteristic at STRAIN, which falls as the solid expands. */
static struct root_value fan_excess(const void *context, double strain)
{
    const struct fan_target *target = context;
    struct solid_place place = solid_fan(target->base, strain);
    double speed = place.push + place.volume * sqrt(place.stiffness);
    return (struct root_value){target->speed - speed, target->fall};
}

static struct exact_state solid_in_fan(const void *solved, enum exact_side side, double speed)
{
    const struct solid_problem *problem = solved;
    const struct waves *waves = &problem->waves;
    double direction = side_direction(side), velocity = problem->path[side].velocity;
    int i = 0;
    while (i < waves->count[side] - 1 && direction * (speed - waves->wave[side][i].tail) <= 0.0)
        velocity = waves->wave[side][i++].behind.velocity;
    const struct wave *wave = &waves->wave[side][i];
    const struct solid_base *base = &problem->base[side][i];
    double end = -log(base->volume * wave->behind.density);
    struct fan_target target = {base, direction * (speed - velocity),
                                direction * (wave->head - wave->tail) / end};
    double guess = direction * (wave->head - speed) / target.fall;
    double strain = root_find(fan_excess, &target, 0.0, end, guess);
    struct solid_place place = solid_fan(base, strain);
    return state_at(&place, velocity + direction * place.push);
}

/* The normal pressure at the contact and the waves that lead to it. */
static struct error *respond_both(const struct path path[2], double *pressure,
                                  struct response response[2])
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
                             side_names[side]);
    }
    return NULL;
}

/* The velocity of the contact: that of both sides, but for rounding. */
static double star_velocity_of(const struct path path[2], const struct response response[2])
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

static struct error *solid_solve(const void *parameters, void *solved)
{
    const struct exact_elastic_plastic_riemann *input = parameters;
    struct solid_problem *problem = solved;
    struct path *path = problem->path;
    struct response response[2];
    double pressure = 0.0;
    *problem = (struct solid_problem){.waves = {.at = input->at, .in_fan = solid_in_fan}};
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++)
        TRY(path_of(&input->solid[side], side_names[side], &path[side]));
    TRY(respond_both(path, &pressure, response));
    double velocity = star_velocity_of(path, response);
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        const struct solid_base *base = &path[side].start;
        struct solid_place start = {.volume = base->volume,
                                    .energy = base->energy,
                                    .normal = base->normal,
                                    .deviator = base->deviator};
        const struct exact_state empty = {.velocity = velocity};
        problem->waves.start[side] =
            path[side].free ? empty : state_at(&start, path[side].velocity);
        set_waves(problem, (enum exact_side)side, &response[side], pressure, velocity);
    }
    return NULL;
}

/* Names of what stands between the elastic and the plastic wave of a side. */
static const char *const limit_names[2][4] = {
    {"left elastic limit normal pressure", "left elastic limit velocity",
     "left elastic limit density", "left elastic limit pressure"},
    {"right elastic limit normal pressure", "right elastic limit velocity",
     "right elastic limit density", "right elastic limit pressure"},
};

static int solid_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct solid_problem *problem = solved;
    const struct waves *waves = &problem->waves;
    struct exact_state left = waves_star(solved, SIDE_LEFT), right = waves_star(solved, SIDE_RIGHT);
    struct number_list list = {numbers, 0};
    number_add(&list, "star normal pressure", "Pa", 0.0 - left.stress);
    number_add(&list, "star velocity", "m/s", left.velocity);
    number_add(&list, "left star density", "kg/m^3", left.density);
    number_add(&list, "right star density", "kg/m^3", right.density);
    number_add(&list, "left star pressure", "Pa", left.pressure);
    number_add(&list, "right star pressure", "Pa", right.pressure);
    number_add(&list, "left star deviator", "Pa", left.deviator);
    number_add(&list, "right star deviator", "Pa", right.deviator);
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        if (waves->count[side] < WAVES_A_SIDE)
            continue;
        struct exact_state limit = waves->wave[side][0].behind;
        number_add(&list, limit_names[side][0], "Pa", -limit.stress);
        number_add(&list, limit_names[side][1], "m/s", limit.velocity);
        number_add(&list, limit_names[side][2], "kg/m^3", limit.density);
        number_add(&list, limit_names[side][3], "Pa", limit.pressure);
    }
    waves_add_numbers(waves, time, &list);
    return list.count;
}

const struct exact_class exact_elastic_plastic_riemann_class = {
    .size = sizeof(struct solid_problem),
    .solve = solid_solve,
    .sample = waves_sample,
    .star = waves_star,
    .numbers = solid_numbers,
    .contact = waves_contact,
};
