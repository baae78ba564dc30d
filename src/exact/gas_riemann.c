/* The Riemann problem of two ideal gases; see gas_riemann.h.
 *
 * Pressure p* and velocity u* behind both waves are equal (gas_wave.h). The difference of
 * velocities is an increasing, concave function of p*, so that Newton's method from the left of the
 * root cannot overshoot. Source: Landau and Lifshitz, Fluid mechanics, sections 85, 89, 99, 100. */
#include "exact/gas_riemann.h"

#include "exact/root.h"
#include "exact/waves.h"
#include "material/gas_wave.h"

struct gas_problem {
    struct waves waves; /* first: waves.h */
    struct exact_gas gas[2];
    double sound[2];
};

static const struct parameter gas_table[] = {
    {"density", PARAMETER_NUMBER, offsetof(struct exact_gas, density), "kg/m^3", REQUIRED,
     .above = 0.0, .below = INFINITY, .help = "density at the start"},
    {"velocity", PARAMETER_NUMBER, offsetof(struct exact_gas, velocity), "m/s", "0 m/s",
     .help = "velocity at the start, positive to the right"},
    {"pressure", PARAMETER_NUMBER, offsetof(struct exact_gas, pressure), "Pa", REQUIRED,
     .above = 0.0, .below = INFINITY, .help = "pressure at the start"},
    {"gamma", PARAMETER_NUMBER, offsetof(struct exact_gas, gamma), "", REQUIRED, .above = 1.0,
     .below = INFINITY, .help = "ratio of specific heats"},
    PARAMETER_END,
};

const struct parameter exact_gas_riemann_table[] = {
    {"left", PARAMETER_TABLE, offsetof(struct exact_gas_riemann, gas[SIDE_LEFT]),
     .standard = REQUIRED, .help = "the gas left of the contact", .table = gas_table},
    {"right", PARAMETER_TABLE, offsetof(struct exact_gas_riemann, gas[SIDE_RIGHT]),
     .standard = REQUIRED, .help = "the gas right of the contact", .table = gas_table},
    {"at", PARAMETER_NUMBER, offsetof(struct exact_gas_riemann, at), "m", "0 mm",
     .help = "position of the contact at the start"},
    PARAMETER_END,
};

static double sound_speed(const struct exact_gas *gas)
{
    return sqrt(gas->gamma * gas->pressure / gas->density);
}

static struct exact_state gas_state(const struct exact_gas *gas, double density, double velocity,
                                    double pressure)
{
    return (struct exact_state){.density = density,
                                .velocity = velocity,
                                .pressure = pressure,
                                .energy = pressure / ((gas->gamma - 1.0) * density),
                                .stress = -pressure};
}

/* How much the wave that takes GAS to PRESSURE changes its velocity, away from the contact
 * positive. */
static struct root_value push(const struct exact_gas *gas, double sound, double pressure)
{
    struct gas_push push = gas_wave_push(gas->density, gas->pressure, sound, gas->gamma, pressure);
    return (struct root_value){push.value, push.slope};
}

/* Velocity right of the contact less that left of it when both gases have PRESSURE. */
static struct root_value mismatch(const void *context, double pressure)
{
    const struct gas_problem *problem = context;
    const struct exact_gas *gas = problem->gas;
    struct root_value left = push(&gas[SIDE_LEFT], problem->sound[SIDE_LEFT], pressure);
    struct root_value right = push(&gas[SIDE_RIGHT], problem->sound[SIDE_RIGHT], pressure);
    double apart = gas[SIDE_RIGHT].velocity - gas[SIDE_LEFT].velocity;
    return (struct root_value){apart + (left.value + right.value), left.slope + right.slope};
}

static struct wave gas_wave(const struct exact_gas *gas, double sound, double direction,
                            double pressure, double velocity)
{
    double g = gas->gamma, ratio = pressure / gas->pressure;
    struct wave wave;
    if (ratio > 1.0) {
        double m = (g - 1.0) / (g + 1.0);
        double speed = sound * sqrt((g + 1.0) / (2.0 * g) * ratio + (g - 1.0) / (2.0 * g));
        wave.kind = WAVE_SHOCK;
        wave.head = wave.tail = gas->velocity + direction * speed;
        wave.behind =
            gas_state(gas, gas->density * (ratio + m) / (m * ratio + 1.0), velocity, pressure);
        return wave;
    }
    wave.kind = WAVE_FAN;
    wave.behind = gas_state(gas, gas->density * pow(ratio, 1.0 / g), velocity, pressure);
    wave.head = gas->velocity + direction * sound;
    wave.tail = velocity + direction * sqrt(g * pressure / wave.behind.density);
    return wave;
}

static struct exact_state gas_in_fan(const void *solved, enum exact_side side, double speed)
{
    const struct gas_problem *problem = solved;
    const struct exact_gas *gas = &problem->gas[side];
    double g = gas->gamma, direction = side_direction(side);
    double ahead = problem->sound[side];
    double sound = (2.0 * ahead + (g - 1.0) * direction * (speed - gas->velocity)) / (g + 1.0);
    double density = gas->density * pow(sound / ahead, 2.0 / (g - 1.0));
    return gas_state(gas, density, speed - direction * sound, density * sound * sound / g);
}

static struct error *gas_solve(const void *parameters, void *solved)
{
    const struct exact_gas_riemann *input = parameters;
    struct gas_problem *problem = solved;
    double escape = 0.0;
    *problem = (struct gas_problem){.waves = {.at = input->at, .in_fan = gas_in_fan}};
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        const struct exact_gas *gas = &input->gas[side];
        problem->gas[side] = *gas;
        problem->sound[side] = sound_speed(gas);
        problem->waves.start[side] = gas_state(gas, gas->density, gas->velocity, gas->pressure);
        escape += 2.0 * problem->sound[side] / (gas->gamma - 1.0);
    }
    const struct exact_gas *left = &input->gas[SIDE_LEFT], *right = &input->gas[SIDE_RIGHT];
    double apart = right->velocity - left->velocity;
    if (!(apart < escape))
        return error_new(ERROR_INPUT,
                         "the gases separate at %g m/s, faster than both can expand (%g m/s): a "
                         "vacuum opens between them",
                         apart, escape);
    double start = minimum(left->pressure, right->pressure);
    double pressure = root_find(mismatch, problem, 0.0, INFINITY, start);
    double back = push(left, problem->sound[SIDE_LEFT], pressure).value;
    double forth = push(right, problem->sound[SIDE_RIGHT], pressure).value;
    double velocity = 0.5 * ((left->velocity - back) + (right->velocity + forth));
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        problem->waves.count[side] = 1;
        problem->waves.wave[side][0] = gas_wave(&problem->gas[side], problem->sound[side],
                                                side_direction(side), pressure, velocity);
    }
    return NULL;
}

static int gas_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct gas_problem *problem = solved;
    struct exact_state left = waves_star(solved, SIDE_LEFT), right = waves_star(solved, SIDE_RIGHT);
    const struct exact_gas *gas = problem->gas;
    struct number_list list = {numbers, 0};
    number_add(&list, "star pressure", "Pa", left.pressure);
    number_add(&list, "star velocity", "m/s", left.velocity);
    number_add(&list, "left star density", "kg/m^3", left.density);
    number_add(&list, "right star density", "kg/m^3", right.density);
    number_add(&list, "left energy", "J/kg", problem->waves.start[SIDE_LEFT].energy);
    number_add(&list, "right energy", "J/kg", problem->waves.start[SIDE_RIGHT].energy);
    number_add(&list, "left star energy", "J/kg", left.energy);
    number_add(&list, "right star energy", "J/kg", right.energy);
    number_add(&list, "left sound speed", "m/s", problem->sound[SIDE_LEFT]);
    number_add(&list, "right sound speed", "m/s", problem->sound[SIDE_RIGHT]);
    number_add(&list, "left star sound speed", "m/s",
               sqrt(gas[SIDE_LEFT].gamma * left.pressure / left.density));
    number_add(&list, "right star sound speed", "m/s",
               sqrt(gas[SIDE_RIGHT].gamma * right.pressure / right.density));
    waves_add_numbers(&problem->waves, time, &list);
    return list.count;
}

const struct exact_class exact_gas_riemann_class = {
    .size = sizeof(struct gas_problem),
    .solve = gas_solve,
    .sample = waves_sample,
    .star = waves_star,
    .numbers = gas_numbers,
    .contact = waves_contact,
};
