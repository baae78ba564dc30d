/* The elastic-plastic Riemann problem; see elastic_plastic_riemann.h. Let P = K (1 - V/V_0) (2.1),
 * dS/dt = 4/3 G du/dx (2.2), |S| <= 2Y/3 (2.3), p = P - S = -sigma, x = ln(V/V_start):
 *   elastic  p = K (1 - V/V_0) - 4/3 G x,  |x| <= Y/2G;    convex: compression jumps, release fans out
 *   plastic  p = K (1 - V/V_0) +- 2Y/3, + in compression;  straight: a jump of impedance sqrt(K/V_0)
 * The elastic wave is the faster one at any strength. Stress power goes into the energy. Source:
 * Parshikov (2013), section 2.1, for the problem; the solution is exact for these relations. */
#include "exact/elastic_plastic_riemann.h"

#include "exact/root.h"
#include "exact/waves.h"

/* A solid as its waves see it. */
struct path {
    double bulk;             /* K, Pa */
    double shear;            /* 4/3 G, Pa */
    double slope;            /* K/V_0: -dp/dV of the plastic branch, kg^2/(m^4 s^2) */
    double limit;            /* strain at yield; zero: a liquid */
    double flow;             /* 2Y/3, Pa; zero for a liquid */
    double reference, start; /* V_0 and V at the start, m^3/kg */
    double pressure;         /* p at the start */
    double velocity;
};

struct solid_problem {
    struct waves waves; /* first: waves.h */
    struct path path[2];
};

static const struct parameter solid_table[] = {
    {"reference_density", PARAMETER_NUMBER, offsetof(struct exact_solid, reference_density),
     "kg/m^3", PARAMETER_REQUIRED, .above = 0.0, .below = INFINITY,
     .help = "density at zero pressure"},
    {"bulk_modulus", PARAMETER_NUMBER, offsetof(struct exact_solid, bulk_modulus), "Pa",
     PARAMETER_REQUIRED, .above = 0.0, .below = INFINITY, .help = "K of p = K (1 - rho_0/rho)"},
    {"shear_modulus", PARAMETER_NUMBER, offsetof(struct exact_solid, shear_modulus), "Pa", "0 Pa",
     .above = 0.0, .below = INFINITY, .closed = true, .help = "shear modulus G"},
    {"yield", PARAMETER_NUMBER, offsetof(struct exact_solid, yield), "Pa", "0 Pa", .above = 0.0,
     .below = INFINITY, .closed = true, .help = "yield strength in simple tension"},
    {"density", PARAMETER_NUMBER, offsetof(struct exact_solid, density), "kg/m^3",
     PARAMETER_OPTIONAL, .above = 0.0, .below = INFINITY,
     .help = "density at the start; the reference density if not given"},
    {"velocity", PARAMETER_NUMBER, offsetof(struct exact_solid, velocity), "m/s", "0 m/s",
     .help = "velocity at the start, positive to the right"},
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

static struct path path_of(const struct exact_solid *solid)
{
    struct path path = {.bulk = solid->bulk_modulus, .velocity = solid->velocity};
    bool liquid = !(solid->shear_modulus > 0.0 && solid->yield > 0.0);
    double density = isnan(solid->density) ? solid->reference_density : solid->density;
    path.shear = liquid ? 0.0 : 4.0 / 3.0 * solid->shear_modulus;
    path.flow = liquid ? 0.0 : 2.0 / 3.0 * solid->yield;
    path.limit = liquid ? 0.0 : 0.5 * solid->yield / solid->shear_modulus;
    path.slope = solid->bulk_modulus * solid->reference_density;
    path.reference = 1.0 / solid->reference_density;
    path.start = 1.0 / density;
    path.pressure = solid->bulk_modulus * (1.0 - solid->reference_density / density);
    return path;
}

/* How a wave changes things: the velocity (away from the contact positive) with its slope over p, and
 * the energy. */
struct change {
    double velocity, slope, energy;
};

/* A state on a path: strain x since the start while elastic, volume, p. */
struct place {
    double strain, volume, pressure;
};

static struct place elastic_place(const struct path *path, double strain)
{
    struct place place = {strain, path->start * exp(strain), path->pressure};
    place.pressure -= path->slope * path->start * expm1(strain) + path->shear * strain;
    return place;
}

/* Speed times density squared: -dp/dV of the elastic branch. */
static double elastic_stiffness(const struct path *path, double volume)
{
    return path->slope + path->shear / volume;
}

/* Slope of the chord from the start: the squared impedance of an elastic jump. */
static double chord_stiffness(const struct path *path, double strain)
{
    double stretch = strain == 0.0 ? 1.0 : strain / expm1(strain);
    return path->slope + path->shear / path->start * stretch;
}

static struct change elastic_jump(const struct path *path, struct place to)
{
    double impedance = sqrt(chord_stiffness(path, to.strain));
    double shrink = -path->start * expm1(to.strain);
    double slope = 0.5 * (1.0 / impedance + impedance / elastic_stiffness(path, to.volume));
    double energy = 0.5 * (path->pressure + to.pressure) * shrink;
    return (struct change){impedance * shrink, slope, energy};
}

/* The integrals of sqrt(-dp/dV) and of p over V from the start to TO, in closed form; a = K/V_0,
 * b = 4/3 G. Differences are taken in forms that keep their digits for small strain. */
static struct change elastic_fan(const struct path *path, struct place to)
{
    double a = path->slope, b = path->shear, from = path->start;
    double grow = from * expm1(to.strain);
    double rise = a * (to.volume + from) + b; /* of a V^2 + b V, divided by grow */
    double root_to = sqrt(a * to.volume), root_from = sqrt(a * from);
    double stiff_to = sqrt(a * to.volume + b), stiff_from = sqrt(a * from + b);
    double part = a * grow * rise / (root_to * stiff_to + root_from * stiff_from);
    double gain = a * grow * (1.0 / (root_to + root_from) + 1.0 / (stiff_to + stiff_from));
    double velocity = -(part + b * log1p(gain / (root_from + stiff_from))) / sqrt(a);
    double energy = -grow * (path->pressure - 0.5 * a * grow) + b * (to.volume * to.strain - grow);
    return (struct change){velocity, 1.0 / sqrt(elastic_stiffness(path, to.volume)), energy};
}

static struct change elastic_change(const struct path *path, struct place to)
{
    return to.strain < 0.0 ? elastic_jump(path, to) : elastic_fan(path, to);
}

/* The wave pattern of one side: the end of the elastic wave and, behind it, of the plastic one. */
struct response {
    bool plastic;
    double flow; /* P - p behind: -S while plastic */
    struct place elastic, end;
    struct change first, second;
};

struct target {
    const struct path *path;
    double pressure;
};

static struct root_value elastic_excess(const void *context, double strain)
{
    const struct target *target = context;
    struct place place = elastic_place(target->path, strain);
    double slope = target->path->slope * place.volume + target->path->shear;
    return (struct root_value){target->pressure - place.pressure, slope};
}

/* The strain on the elastic branch at PRESSURE, in (-limit, limit). */
static double elastic_strain(const struct path *path, double pressure)
{
    struct target target = {path, pressure};
    bool compressed = pressure > path->pressure;
    return root_find(elastic_excess, &target, compressed ? -path->limit : 0.0,
                     compressed ? 0.0 : path->limit, 0.0);
}

static struct response respond(const struct path *path, double pressure)
{
    double sign = pressure > path->pressure ? 1.0 : -1.0;
    struct response response = {.elastic = elastic_place(path, -sign * path->limit)};
    response.plastic = sign * (pressure - response.elastic.pressure) > 0.0;
    if (!response.plastic) {
        response.elastic = elastic_place(path, elastic_strain(path, pressure));
        response.elastic.pressure = pressure;
        response.end = response.elastic;
        response.flow = path->shear * response.end.strain;
        response.first = elastic_change(path, response.elastic);
        return response;
    }
    double shrink = (pressure - response.elastic.pressure) / path->slope;
    double impedance = sqrt(path->slope);
    response.first = elastic_change(path, response.elastic);
    response.flow = -sign * path->flow;
    response.end = (struct place){0.0, response.elastic.volume - shrink, pressure};
    response.second.velocity = impedance * shrink;
    response.second.slope = 1.0 / impedance;
    response.second.energy = 0.5 * (pressure + response.elastic.pressure) * shrink;
    return response;
}

/* Velocity right of the contact less that left of it when both solids have PRESSURE. */
static struct root_value mismatch(const void *context, double pressure)
{
    const struct path *left = (const struct path *)context + SIDE_LEFT;
    const struct path *right = (const struct path *)context + SIDE_RIGHT;
    struct response back = respond(left, pressure), forth = respond(right, pressure);
    double push_left = back.first.velocity + back.second.velocity;
    double push_right = forth.first.velocity + forth.second.velocity;
    return (struct root_value){right->velocity - left->velocity + (push_left + push_right),
                               (back.plastic ? back.second : back.first).slope +
                                   (forth.plastic ? forth.second : forth.first).slope};
}

static struct error *star_pressure(const struct path path[2], double *pressure)
{
    const struct path *left = &path[SIDE_LEFT], *right = &path[SIDE_RIGHT];
    /* The pressure at which a solid has no volume left. */
    double high = minimum(left->bulk + left->flow, right->bulk + right->flow);
    if (!(mismatch(path, high).value > 0.0))
        return error_new(ERROR_INPUT,
                         "the impact asks for more than the %g Pa at which the equation of state "
                         "p = K (1 - rho_0/rho) has no volume left",
                         high);
    double low = minimum(left->pressure, right->pressure);
    double step = maximum(left->bulk, right->bulk);
    for (; mismatch(path, low).value > 0.0; step *= 2.0)
        low -= step;
    double start = minimum(0.5 * (left->pressure + right->pressure), high);
    *pressure = root_find(mismatch, path, low, high, start);
    return NULL;
}

static struct exact_state state_at(struct place place, double deviator, double velocity,
                                   double energy)
{
    struct exact_state state = {.density = 1.0 / place.volume, .velocity = velocity};
    state.pressure = place.pressure + deviator;
    state.energy = energy;
    state.stress = -place.pressure;
    state.deviator = deviator;
    return state;
}

/* The one or two waves that take a side to its star state. */
static int side_waves(const struct path *path, double direction, const struct response *response,
                      double star_velocity, struct wave wave[WAVES_A_SIDE])
{
    int count = 0;
    bool elastic = path->limit > 0.0 || !response->plastic;
    double velocity = path->velocity, strain = response->elastic.strain;
    if (elastic) {
        double ahead =
            strain < 0.0 ? chord_stiffness(path, strain) : elastic_stiffness(path, path->start);
        wave[0].kind = strain < 0.0 ? WAVE_ELASTIC : WAVE_ELASTIC_FAN;
        wave[0].head = velocity + direction * path->start * sqrt(ahead);
        velocity =
            response->plastic ? velocity + direction * response->first.velocity : star_velocity;
        wave[0].behind =
            state_at(response->elastic, path->shear * strain, velocity, response->first.energy);
        double volume = response->elastic.volume;
        wave[0].tail = strain < 0.0
                           ? wave[0].head
                           : velocity + direction * volume * sqrt(elastic_stiffness(path, volume));
        count++;
    }
    if (response->plastic) {
        double speed = response->elastic.volume * sqrt(path->slope);
        wave[count].kind = WAVE_PLASTIC;
        wave[count].head = wave[count].tail = velocity + direction * speed;
        wave[count].behind = state_at(response->end, response->flow, star_velocity,
                                      response->first.energy + response->second.energy);
        count++;
    }
    return count;
}

struct fan_target {
    const struct path *path;
    double speed; /* away from the contact positive, relative to the solid ahead */
};

/* The target's speed less that of the characteristic at STRAIN, which falls as the solid expands. */
static struct root_value fan_excess(const void *context, double strain)
{
    const struct fan_target *target = context;
    const struct path *path = target->path;
    struct place place = elastic_place(path, strain);
    double sound = place.volume * sqrt(elastic_stiffness(path, place.volume));
    double speed = elastic_fan(path, place).velocity + sound;
    return (struct root_value){target->speed - speed,
                               0.5 * path->shear * square(place.volume) / sound};
}

static struct exact_state solid_in_fan(const void *solved, enum exact_side side, double speed)
{
    const struct solid_problem *problem = solved;
    const struct path *path = &problem->path[side];
    double direction = side_direction(side);
    struct fan_target target = {path, direction * (speed - path->velocity)};
    double end = -log(path->start * problem->waves.wave[side][0].behind.density);
    double strain = root_find(fan_excess, &target, 0.0, end, 0.5 * end);
    struct place place = elastic_place(path, strain);
    struct change change = elastic_fan(path, place);
    return state_at(place, path->shear * strain, path->velocity + direction * change.velocity,
                    change.energy);
}

static struct error *solid_solve(const void *parameters, void *solved)
{
    const struct exact_elastic_plastic_riemann *input = parameters;
    struct solid_problem *problem = solved;
    struct waves *waves = &problem->waves;
    struct response response[2];
    double pressure = 0.0;
    *problem = (struct solid_problem){.waves = {.at = input->at, .in_fan = solid_in_fan}};
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        const struct path *path = &problem->path[side];
        problem->path[side] = path_of(&input->solid[side]);
        waves->start[side] = state_at(elastic_place(path, 0.0), 0.0, path->velocity, 0.0);
    }
    TRY(star_pressure(problem->path, &pressure));
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++)
        response[side] = respond(&problem->path[side], pressure);
    double back = response[SIDE_LEFT].first.velocity + response[SIDE_LEFT].second.velocity;
    double forth = response[SIDE_RIGHT].first.velocity + response[SIDE_RIGHT].second.velocity;
    double velocity = 0.5 * ((problem->path[SIDE_LEFT].velocity - back) +
                             (problem->path[SIDE_RIGHT].velocity + forth));
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++)
        waves->count[side] = side_waves(&problem->path[side], side_direction(side), &response[side],
                                        velocity, waves->wave[side]);
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
    number_add(&list, "star normal pressure", "Pa", -left.stress);
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
