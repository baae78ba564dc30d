/* A plane detonation and the wave behind it; see slab_detonation.h. With V = rho_0/rho and E of the
 * initial volume:
 *
 *   Hugoniot    E = E_0 + p (1 - V)/2,   D^2 = p/[rho_0 (1 - V)], u = D (1 - V)
 *   CJ          D as small as it can be: the flow behind the front is as fast as its sound, rho_0 D = rho c
 *   isentrope   p_s = A e^(-R_1 V) + B e^(-R_2 V) + C V^(-1-w),   c^2 = -(V^2/rho_0) dp_s/dV
 *   fan         x/t = u + c,   u = u_CJ - int c dV/V from V_CJ on,   down to u = 0
 *
 * Source: Cui, dissertation (2014), section 3.4.1; Fickett and Davis, Detonation (1979),
 * chapter 2. */
#include "exact/slab_detonation.h"

#include "exact/radial.h"
#include "exact/waves.h"
#include "material/choices.h"

enum { NODES = 256 };

struct detonation {
    struct eos_jwl jwl;
    double speed;               /* D */
    double constant;            /* C of the isentrope */
    double volume[NODES + 1];   /* from V_CJ to that of the products at rest */
    double velocity[NODES + 1]; /* u there */
};

const struct parameter exact_slab_detonation_table[] = {
    PARAMETER(TABLE, struct exact_slab_detonation, jwl, REQUIRED, "the products",
              .table = eos_jwl_parameters),
    PARAMETER_END,
};

/* Pressure without the part of the energy. */
static double cold_pressure(const struct eos_jwl *jwl, double volume)
{
    return jwl->a * (1.0 - jwl->omega / (jwl->r1 * volume)) * exp(-jwl->r1 * volume) +
           jwl->b * (1.0 - jwl->omega / (jwl->r2 * volume)) * exp(-jwl->r2 * volume);
}

/* Pressure behind a front that compresses to VOLUME. */
static double front_pressure(const struct eos_jwl *jwl, double volume)
{
    return (cold_pressure(jwl, volume) + jwl->omega * jwl->energy / volume) /
           (1.0 - 0.5 * jwl->omega * (1.0 - volume) / volume);
}

static double isentrope_constant(const struct eos_jwl *jwl, double volume, double pressure)
{
    return (pressure - jwl->a * exp(-jwl->r1 * volume) - jwl->b * exp(-jwl->r2 * volume)) *
           pow(volume, 1.0 + jwl->omega);
}

static double isentrope_pressure(const struct detonation *d, double volume)
{
    const struct eos_jwl *jwl = &d->jwl;
    return jwl->a * exp(-jwl->r1 * volume) + jwl->b * exp(-jwl->r2 * volume) +
           d->constant * pow(volume, -1.0 - jwl->omega);
}

/* c/V on the isentrope. */
static double sound_over_volume(const void *solved, double volume)
{
    const struct detonation *d = solved;
    const struct eos_jwl *jwl = &d->jwl;
    const double slope = jwl->a * jwl->r1 * exp(-jwl->r1 * volume) +
                         jwl->b * jwl->r2 * exp(-jwl->r2 * volume) +
                         (1.0 + jwl->omega) * d->constant * pow(volume, -2.0 - jwl->omega);
    return sqrt(maximum(slope, 0.0) / jwl->density);
}

/* By how much the front's mass flow squared, rho_0^2 D^2, exceeds (rho c)^2 behind it, over
 * rho_0. */
static double flow_excess(const struct eos_jwl *jwl, double volume)
{
    const double pressure = front_pressure(jwl, volume);
    const struct detonation d = {.jwl = *jwl,
                                 .constant = isentrope_constant(jwl, volume, pressure)};
    return pressure / (1.0 - volume) - jwl->density * square(sound_over_volume(&d, volume));
}

/* Velocity at VOLUME from that at another. */
static double velocity_from(const struct detonation *d, double velocity, double from, double volume)
{
    return velocity - radial_integral(sound_over_volume, d, from, volume, 1);
}

static struct error *slab_solve(const void *parameters, void *solved)
{
    struct detonation *d = solved;
    *d = (struct detonation){.jwl = ((const struct exact_slab_detonation *)parameters)->jwl};
    const struct eos_jwl *jwl = &d->jwl;
    double low = jwl->omega / (2.0 + jwl->omega) + 1e-6, high = 1.0 - 1e-9;
    if (!(flow_excess(jwl, low) < 0.0 && flow_excess(jwl, high) > 0.0))
        return error_new(ERROR_INPUT, "these products carry no detonation");
    for (double middle = 0.5 * (low + high); middle != low && middle != high;
         middle = 0.5 * (low + high))
        *(flow_excess(jwl, middle) < 0.0 ? &low : &high) = middle;
    const double pressure = front_pressure(jwl, low);
    d->speed = sqrt(pressure / (jwl->density * (1.0 - low)));
    d->constant = isentrope_constant(jwl, low, pressure);
    /* The products at rest lie where the velocity has fallen to zero. */
    const double least = low, front = d->speed * (1.0 - low);
    for (high = 2.0 * low; radial_integral(sound_over_volume, d, least, high, NODES) < front;)
        high *= 2.0;
    for (double middle = 0.5 * (low + high); middle != low && middle != high;
         middle = 0.5 * (low + high)) {
        bool moves = radial_integral(sound_over_volume, d, least, middle, NODES) < front;
        *(moves ? &low : &high) = middle;
    }
    d->volume[0] = least;
    d->velocity[0] = front;
    for (int k = 1; k <= NODES; k++) {
        d->volume[k] = least + (low - least) * k / NODES;
        d->velocity[k] = velocity_from(d, d->velocity[k - 1], d->volume[k - 1], d->volume[k]);
    }
    d->velocity[NODES] = 0.0;
    return NULL;
}

/* x/t where the products have VOLUME and VELOCITY. */
static double place_of(const struct detonation *d, double volume, double velocity)
{
    return velocity + volume * sound_over_volume(d, volume);
}

static struct exact_state products_at(const struct detonation *d, double volume, double velocity)
{
    const struct eos_jwl *jwl = &d->jwl;
    const double pressure = isentrope_pressure(d, volume);
    const double energy = (pressure - cold_pressure(jwl, volume)) * volume / jwl->omega;
    return (struct exact_state){.density = jwl->density / volume,
                                .velocity = velocity,
                                .pressure = pressure,
                                .energy = (energy - jwl->energy) / jwl->density,
                                .stress = -pressure};
}

static struct exact_state slab_sample(const void *solved, enum exact_side side, double x,
                                      double time)
{
    (void)side;
    const struct detonation *d = solved;
    if (!(x < d->speed * time))
        return (struct exact_state){.density = d->jwl.density};
    const double speed = x / time;
    int low = 0, high = NODES;
    if (speed <= place_of(d, d->volume[NODES], 0.0))
        return products_at(d, d->volume[NODES], 0.0);
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        *(place_of(d, d->volume[middle], d->velocity[middle]) > speed ? &low : &high) = middle;
    }
    double near = d->volume[low], far = d->volume[high], volume = near, velocity = d->velocity[low];
    for (int round = 0; round < 50; round++) {
        volume = 0.5 * (near + far);
        velocity = velocity_from(d, d->velocity[low], d->volume[low], volume);
        *(place_of(d, volume, velocity) > speed ? &near : &far) = volume;
    }
    return products_at(d, volume, velocity);
}

static int slab_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct detonation *d = solved;
    const struct exact_state front = products_at(d, d->volume[0], d->velocity[0]);
    const struct exact_state rest = products_at(d, d->volume[NODES], 0.0);
    const double edge = place_of(d, d->volume[NODES], 0.0);
    struct number_list list = {numbers, 0};
    number_add(&list, "detonation speed", "m/s", d->speed);
    number_add(&list, "front pressure", "Pa", front.pressure);
    number_add(&list, "front density", "kg/m^3", front.density);
    number_add(&list, "front velocity", "m/s", front.velocity);
    number_add(&list, "front sound speed", "m/s", d->speed - front.velocity);
    number_add(&list, "pressure at rest", "Pa", rest.pressure);
    number_add(&list, "density at rest", "kg/m^3", rest.density);
    number_add(&list, "speed of the edge of rest", "m/s", edge);
    if (time > 0.0) {
        number_add(&list, "front", "m", d->speed * time);
        number_add(&list, "edge of rest", "m", edge * time);
    }
    return list.count;
}

const struct exact_class exact_slab_detonation_class = {
    .size = sizeof(struct detonation),
    .solve = slab_solve,
    .sample = slab_sample,
    .numbers = slab_numbers,
};
