/* The elastic-plastic Riemann problem; see elastic_plastic_riemann.h. Each side sends out an
 * elastic wave and, if that does not suffice, a plastic one behind it (solid_path.h). Sources:
 * Wang, Chen and Huang (2024) for any equation of state; Parshikov (2013), section 2.1, for
 * barotropic solids. The solution is exact for these relations. */
#include "exact/elastic_plastic_riemann.h"

#include "exact/root.h"

struct solid_problem {
    struct waves waves; /* first: waves.h */
    struct solid_path path[2];
    struct solid_base base[2][WAVES_A_SIDE]; /* ahead of each wave */
};

const struct parameter exact_elastic_plastic_riemann_table[] = {
    {"left", PARAMETER_TABLE, offsetof(struct exact_elastic_plastic_riemann, solid[SIDE_LEFT]),
     .standard = REQUIRED, .help = "the solid left of the contact", .table = exact_solid_table},
    {"right", PARAMETER_TABLE, offsetof(struct exact_elastic_plastic_riemann, solid[SIDE_RIGHT]),
     .standard = REQUIRED, .help = "the solid right of the contact", .table = exact_solid_table},
    {"at", PARAMETER_NUMBER, offsetof(struct exact_elastic_plastic_riemann, at), "m", "0 mm",
     .help = "position of the contact at the start"},
    PARAMETER_END,
};

static enum wave_kind kind_of(const struct solid_path *path, const struct solid_base *base,
                              bool fan)
{
    if (path->fluid)
        return fan ? WAVE_FAN : WAVE_SHOCK;
    if (base->shear > 0.0)
        return fan ? WAVE_ELASTIC_FAN : WAVE_ELASTIC;
    return fan ? WAVE_PLASTIC_FAN : WAVE_PLASTIC;
}

/* The waves that take a side to its star state, from the outermost. */
static void set_waves(struct solid_problem *problem, enum exact_side side,
                      const struct solid_meeting *meeting)
{
    const struct solid_path *path = &problem->path[side];
    const struct solid_response *response = &meeting->response[side];
    double direction = side_direction(side), velocity = path->velocity;
    problem->waves.count[side] = response->count;
    for (int i = 0; i < response->count; i++) {
        struct solid_place behind = response->behind[i];
        const struct solid_base *base = &response->base[i];
        struct wave *wave = &problem->waves.wave[side][i];
        bool last = i == response->count - 1;
        bool fan = solid_wave_is_fan(response, i);
        double ahead = fan ? solid_fan(base, 0.0).stiffness : behind.chord;
        problem->base[side][i] = *base;
        wave->kind = kind_of(path, base, fan);
        wave->head = velocity + direction * base->volume * sqrt(ahead);
        velocity = last ? meeting->velocity : velocity + direction * behind.push;
        wave->tail =
            fan ? velocity + direction * behind.volume * sqrt(behind.stiffness) : wave->head;
        behind.normal = last ? meeting->pressure : behind.normal;
        wave->behind = solid_state(&behind, velocity);
    }
}

struct fan_target {
    const struct solid_base *base;
    double speed,
        fall; /* away from the contact, relative to the solid ahead; its fall over strain */
};

/* The target's speed less that of the characteristic at STRAIN, which falls as the solid
 * expands. */
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
    return solid_state(&place, velocity + direction * place.push);
}

static struct error *solid_solve(const void *parameters, void *solved)
{
    const struct exact_elastic_plastic_riemann *input = parameters;
    struct solid_problem *problem = solved;
    struct solid_path *path = problem->path;
    struct solid_meeting meeting;
    *problem = (struct solid_problem){.waves = {.at = input->at, .in_fan = solid_in_fan}};
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++)
        TRY(solid_path_of(&input->solid[side], exact_side_names[side], &path[side]));
    TRY(solid_meet(path, &meeting));
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        const struct exact_state empty = {.velocity = meeting.velocity};
        problem->waves.start[side] = path[side].free ? empty : solid_path_start(&path[side]);
        set_waves(problem, (enum exact_side)side, &meeting);
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
