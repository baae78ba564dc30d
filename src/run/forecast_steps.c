/* How many steps a run takes, from the state at its start and from what is known of impacts and of
 * blasts. A charge in a gas sends out waves as fast as its detonation, D. As the blast engages the
 * gas, the energy W D^2/16 of the charge (products with a ratio of specific heats of 3) moves the
 * mass M: speeds fall with sqrt(W/M), and the front is at R with dR/dt = D/sqrt(8) sqrt(W/M). What
 * has burnt stays hot. See forecast.h. */
#include <math.h>

#include "exact/detonation.h"
#include "material/material.h"
#include "model/place.h"
#include "model/solver.h"
#include "run/forecast.h"

/* What bodies that collide at this fraction of a speed of sound, or faster, do to the step: the
 * shock compresses and heats them, and sound gets faster in what are smaller particles. Slower ones
 * do less. */
static const double FAST_IMPACT = 0.5, SHORTER_STEPS = 2.0;

/* Signals in the products of a blast do not get slower than this fraction of D. */
static const double HOT_PRODUCTS = 0.25;

/* A gas has less than this fraction of the density of an explosive. */
static const double RARE = 0.1;

/* A charge in a gas. */
struct blast {
    double speed;        /* of its detonation, m/s */
    double mass, radius; /* of the charge */
    double gas, sound;   /* density and speed of sound of the gas */
    double volume;       /* of a ball of radius 1 m, as much as the case has of it */
    int power;           /* of the radius that volumes grow with */
};

/* The speed of detonation of BODY, m/s, and *sound that behind its front; 0 for what does not
 * burn. */
static double detonation_of(const struct simulation_case *input, int body, double *sound)
{
    const struct material *material = body_material(input, body);
    struct detonation d;
    if (!material_burns(material))
        return 0.0;
    if (detonation_solve(material, material_density(material), &d)) {
        *sound = d.cj.sound;
        return d.speed;
    }
    *sound = 0.75 * material_detonation_speed(material);
    return material_detonation_speed(material);
}

/* The ball of 1 m in what the case has of space, halved by each mirror that BODY touches. */
static double ball_volume(const struct simulation_case *input, int body, int *power)
{
    const struct bounds bounds = body_bounds(input, body);
    const double pi = 3.14159265358979;
    const int radial = geometry_power(input->geometry);
    *power = radial ? (input->dimension == 2 ? 3 : radial + 1) : (int)input->dimension;
    double volume = *power == 1 ? 2.0 : *power == 2 ? pi : 4.0 / 3.0 * pi;
    if (radial == 1)
        volume /= 2.0 * pi;
    else if (radial == 2)
        volume /= 4.0 * pi;
    const struct place whole = place_whole(input);
    for (int axis = radial ? 1 : 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            const struct face *face = &whole.face[axis][side];
            if (face_closes(face) &&
                fabs(face->at - vec3_at(side ? bounds.high : bounds.low, axis)) < input->resolution)
                volume *= 0.5;
        }
    return volume;
}

/* The blast of the explosives of INPUT in the gas around them; false where there is none. */
static bool find_blast(const struct simulation_case *input, const struct estimate *estimate,
                       struct blast *blast)
{
    double density = 0.0, sound;
    *blast = (struct blast){.gas = INFINITY};
    for (int b = 0; b < input->bodies.count; b++) {
        const double speed = detonation_of(input, b, &sound);
        if (speed > 0.0) {
            blast->speed = maximum(blast->speed, speed);
            blast->mass += estimate->body[b].summary.mass;
            blast->volume = ball_volume(input, b, &blast->power);
            density = material_density(body_material(input, b));
        } else if (estimate->body[b].summary.fastest.density < blast->gas) {
            blast->gas = estimate->body[b].summary.fastest.density;
            blast->sound = estimate->body[b].sound_long;
        }
    }
    if (!(blast->mass > 0.0) || !(blast->gas < RARE * density))
        return false;
    blast->radius = pow(blast->mass / (density * blast->volume), 1.0 / blast->power);
    return true;
}

/* The steps of a blast from time BEFORE to END, of at most STEP; a signal as fast as sound in the
 * gas allows STEP_OF_GAS. */
static double steps_of_blast(const struct blast *blast, double before, double end, double step,
                             double step_of_gas)
{
    static const double PIECE = 0.05;
    const double volume = pow(blast->radius, blast->power);
    double radius = blast->radius, time = 0.0, steps = 0.0;
    while (time < end) {
        const double moved =
            blast->mass + blast->gas * blast->volume * (pow(radius, blast->power) - volume);
        const double slower = sqrt(blast->mass / moved);
        const double signal = maximum(blast->sound, blast->speed * maximum(slower, HOT_PRODUCTS));
        const double front = maximum(blast->sound, blast->speed * slower / sqrt(8.0));
        const double lasts = minimum(PIECE * radius / front, end - time);
        const double after = maximum(0.0, time + lasts - maximum(time, before));
        steps += after / minimum(step, step_of_gas * blast->sound / signal);
        radius += front * lasts;
        if (!(time + lasts > time))
            break;
        time += lasts;
    }
    return steps;
}

/* The blast of the case that INPUT starts from, and the time that has passed by then. */
static bool find_earlier_blast(const struct simulation_case *input, struct blast *blast,
                               double *before)
{
    const struct simulation_case *source = input->start.input;
    struct estimate estimate;
    struct error *error = source ? estimate_size(source, &estimate) : NULL;
    if (!source || error) {
        error_free(error);
        return false;
    }
    const bool found = find_blast(source, &estimate, blast);
    *before =
        isnan(input->start.at) ? source->run.until : minimum(input->start.at, source->run.until);
    estimate_free(&estimate);
    return found;
}

/* The step that the gas of BLAST allows at rest, and in *OTHERS the smallest of bodies that are
 * neither that nor explosives. */
static double step_of_gas(const struct simulation_case *input, const struct estimate *estimate,
                          double *others)
{
    double step = INFINITY, rarest = INFINITY, sound;
    int gas = -1;
    for (int b = 0; b < input->bodies.count; b++)
        if (!(detonation_of(input, b, &sound) > 0.0) &&
            estimate->body[b].summary.fastest.density < rarest) {
            rarest = estimate->body[b].summary.fastest.density;
            gas = b;
        }
    for (int b = 0; b < input->bodies.count; b++)
        if (b != gas && !(detonation_of(input, b, &sound) > 0.0))
            step = minimum(step, estimate->body[b].step);
    *others = step;
    return gas < 0 ? INFINITY : estimate->body[gas].step;
}

/* The smallest step of all bodies, of explosives that have burnt. */
static double step_of_bodies(const struct simulation_case *input, const struct estimate *estimate)
{
    const struct solver_class *class = input->solver.choice->thing;
    double step = INFINITY;
    for (int b = 0; b < input->bodies.count; b++) {
        const struct body_estimate *body = &estimate->body[b];
        double sound = 0.0;
        const double speed = detonation_of(input, b, &sound);
        const double signal = class->members ? speed : sound; /* in cells, also the flow */
        step = minimum(step, body->step * minimum(1.0, body->sound_long / signal));
    }
    return step;
}

double forecast_steps(const struct simulation_case *input, const struct estimate *estimate,
                      double from)
{
    const double until = input->run.until;
    struct blast blast;
    double before = 0.0, others, steps;
    if (find_blast(input, estimate, &blast) || find_earlier_blast(input, &blast, &before)) {
        const double gas = step_of_gas(input, estimate, &others);
        steps = steps_of_blast(&blast, before + from, before + until, others, gas);
    } else
        steps = (until - from) / step_of_bodies(input, estimate);
    const double fast = minimum(1.0, estimate->impact / FAST_IMPACT);
    return steps * (1.0 + fast * (SHORTER_STEPS - 1.0));
}
