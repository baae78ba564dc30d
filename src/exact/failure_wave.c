/* The two waves of glass that fails; see failure_wave.h. */
#include "exact/failure_wave.h"

#include <math.h>

#include "exact/waves.h"

#define ROW(member, of, text)                                                        \
    PARAMETER(NUMBER, struct exact_failure_wave, member, REQUIRED, text, .unit = of, \
              .below = INFINITY)

const struct parameter exact_failure_wave_table[] = {
    ROW(impact, "m/s", "u_f: speed at which the layer runs into the wall"),
    ROW(density, "kg/m^3", "rho_0: density of intact glass"),
    ROW(bulk_modulus, "Pa", "K of p = K (1 - rho_0/rho)"),
    ROW(shear_modulus, "Pa", "G of intact glass"),
    ROW(speed, "m/s", "C_f: speed of the failure wave in the material"),
    ROW(failed, "Pa", "c: two thirds of the strength of failed glass without pressure"),
    ROW(failed_slope, "", "b: its increase with pressure"),
    PARAMETER_END,
};

struct wave_pair {
    struct exact_failure_wave input;
    double sound;                       /* C_l */
    struct exact_state elastic, failed; /* velocities in the frame of the wall */
};

/* (2.31) at x = rho/rho_0. */
static double cubic(const struct exact_failure_wave *glass, double sound, double x)
{
    const double bulk = glass->bulk_modulus / glass->density, front = glass->speed;
    const double b = 1.0 + glass->failed_slope, u = glass->impact;
    const double third = front * (sound - u);
    const double second =
        -(square(sound) + front * sound - glass->failed / glass->density - b * bulk);
    const double first = -(b * bulk / front * (front - u + sound) - square(sound));
    return ((third * x + second) * x + first) * x + b * bulk * sound / front;
}

/* The root just above one, by steps and bisection; NAN: there is none below twice the density. */
static double compression(const struct exact_failure_wave *glass, double sound)
{
    const double step = 5e-4;
    for (double low = 1.0 + step; low < 2.0; low += step) {
        double high = low + step;
        const bool rises = cubic(glass, sound, low) < 0.0;
        if (rises == (cubic(glass, sound, high) < 0.0))
            continue;
        for (int k = 0; k < 60; k++) {
            const double middle = 0.5 * (low + high);
            if ((cubic(glass, sound, middle) < 0.0) == rises)
                low = middle;
            else
                high = middle;
        }
        return 0.5 * (low + high);
    }
    return NAN;
}

static struct error *solve(const void *parameters, void *solved)
{
    struct wave_pair *waves = solved;
    const struct exact_failure_wave *glass = parameters;
    const double rest = glass->density, K = glass->bulk_modulus, G = glass->shear_modulus;
    const double sound = sqrt((K + 4.0 / 3.0 * G) / rest), x = compression(glass, sound);
    if (!(x > 1.0))
        return error_new(ERROR_INPUT,
                         "there is no failure wave behind the elastic one at this speed");
    const double u = sound * (1.0 - 1.0 / x), strain = 1.0 - 1.0 / x;
    const double failed = rest * x / (1.0 - (glass->impact - u) / glass->speed);
    const double pressure = K * (1.0 - rest / failed);
    *waves = (struct wave_pair){.input = *glass, .sound = sound};
    waves->elastic = (struct exact_state){.density = rest * x,
                                          .velocity = u - glass->impact,
                                          .pressure = K * strain,
                                          .energy = NAN,
                                          .stress = -rest * sound * u,
                                          .temperature = NAN};
    waves->failed =
        (struct exact_state){.density = failed,
                             .pressure = pressure,
                             .energy = NAN,
                             .stress = -glass->failed - (1.0 + glass->failed_slope) * pressure,
                             .temperature = NAN};
    waves->elastic.deviator = waves->elastic.stress + waves->elastic.pressure;
    waves->failed.deviator = waves->failed.stress + waves->failed.pressure;
    return NULL;
}

/* In the frame of the wall. */
static double front_speed(const struct wave_pair *waves)
{
    return waves->input.speed + waves->elastic.velocity;
}

static struct exact_state sample(const void *solved, enum exact_side side, double x, double time)
{
    const struct wave_pair *waves = solved;
    (void)side;
    if (x < front_speed(waves) * time)
        return waves->failed;
    if (x < (waves->sound - waves->input.impact) * time)
        return waves->elastic;
    return (struct exact_state){.density = waves->input.density,
                                .velocity = -waves->input.impact,
                                .energy = NAN,
                                .temperature = NAN};
}

static int numbers(const void *solved, double time, struct exact_number *into)
{
    const struct wave_pair *waves = solved;
    const struct exact_state *elastic = &waves->elastic, *failed = &waves->failed;
    struct number_list list = {into, 0};
    (void)time;
    number_add(&list, "elastic density", "kg/m^3", elastic->density);
    number_add(&list, "elastic velocity", "m/s", elastic->velocity + waves->input.impact);
    number_add(&list, "elastic pressure", "Pa", elastic->pressure);
    number_add(&list, "elastic stress", "Pa", elastic->stress);
    number_add(&list, "elastic lateral stress", "Pa", -elastic->pressure - 0.5 * elastic->deviator);
    number_add(&list, "elastic Mises stress", "Pa", -1.5 * elastic->deviator);
    number_add(&list, "failed density", "kg/m^3", failed->density);
    number_add(&list, "failed pressure", "Pa", failed->pressure);
    number_add(&list, "failed stress", "Pa", failed->stress);
    number_add(&list, "failed lateral stress", "Pa", -failed->pressure - 0.5 * failed->deviator);
    number_add(&list, "failed Mises stress", "Pa", -1.5 * failed->deviator);
    number_add(&list, "elastic wave speed", "m/s", waves->sound - waves->input.impact);
    number_add(&list, "failure wave speed", "m/s", front_speed(waves));
    return list.count;
}

const struct exact_class exact_failure_wave_class = {
    .size = sizeof(struct wave_pair), .solve = solve, .sample = sample, .numbers = numbers};
