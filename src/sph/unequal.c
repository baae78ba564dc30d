/* Gases that differ too much in the mass of a particle, of which the heavier expands, where
 * particles move with the mean of their contact velocities: the mean is not that of a light one
 * between many light and few large ones, and the light ones pass between the heavy ones. */
#include "material/any.h"
#include "material/material.h"
#include "model/generate.h"
#include "sph/scheme.h"

/* Of masses. In tubes of equal spacing with pressure ratios of 10 and 1000 L1 of the energy is up
 * to about twice that of cells at 14 and at 20, and 5 and 150 times that at 25. */
static const double LARGEST_RATIO = 15.0;

/* Of pressures, the heavier particles at the higher one. With 4 mass ratios do no harm. */
static const double PRESSURE_RATIO = 5.0;

static bool is_uniform_gas(const struct simulation_case *input, int body)
{
    const struct material *material = body_material(input, body);
    return eos_traits(&material->eos).gas && !case_body(input, body)->varies;
}

static double particle_size(const struct simulation_case *input, int body)
{
    const struct body_input *of = case_body(input, body);
    return isnan(of->resolution) ? input->resolution : of->resolution;
}

static double particle_mass(const struct simulation_case *input, int body)
{
    return case_body(input, body)->start.density *
           pow(particle_size(input, body), (double)input->dimension);
}

static double pressure_of(const struct simulation_case *input, int body)
{
    const struct body_input *of = case_body(input, body);
    struct point point = of->start;
    any_material_evaluate(case_material(input, of->material_index)->material, &point);
    return point.pressure;
}

/* Whether particles of A and B may be neighbours at the start. */
static bool may_touch(const struct simulation_case *input, int a, int b)
{
    const double reach = particle_size(input, a) + particle_size(input, b);
    const struct bounds common = bounds_common(body_bounds(input, a), body_bounds(input, b));
    const struct vec3 gap = vec3_sub(common.low, common.high);
    return !(gap.x > reach) && (input->dimension < 2 || !(gap.y > reach)) &&
           (input->dimension < 3 || !(gap.z > reach));
}

/* HEAVY and LIGHT name bodies by the mass of their particles. */
static void judge(struct findings *findings, int heavy, int light)
{
    const struct simulation_case *input = findings->input;
    const double ratio = particle_mass(input, heavy) / particle_mass(input, light);
    if (!(ratio > LARGEST_RATIO) || !may_touch(input, heavy, light) ||
        !(pressure_of(input, heavy) > PRESSURE_RATIO * pressure_of(input, light)))
        return;
    finding_add(
        findings, FINDING_COARSE, "bodies", input->bodies.names[heavy],
        "its particles are %.3g times as heavy as those of \"%s\": above %g light particles "
        "pass "
        "between heavy ones that expand, and energy and density near the contact are wrong; "
        "choose "
        "`motion: particle` of the method, or a `resolution` of at most %.2g m for this body",
        ratio, input->bodies.names[light], LARGEST_RATIO,
        particle_size(input, heavy) * pow(LARGEST_RATIO / ratio, 1.0 / input->dimension));
}

void sph_judge_masses(const struct sph_parameters *all, struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    const struct sph_scheme *scheme = all->method.choice->thing;
    if (!(scheme->traits(all->method.value, input->dimension) & SPH_DRIFT))
        return;
    for (int a = 0; a < input->bodies.count; a++)
        for (int b = 0; b < input->bodies.count; b++)
            if (a != b && is_uniform_gas(input, a) && is_uniform_gas(input, b))
                judge(findings, a, b);
}
