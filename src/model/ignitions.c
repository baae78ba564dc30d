/* Ignitions that light nothing; see findings.h. An ignition outside an explosive counts as a
 * detonation that runs from there, through whatever is between, at the speed of the explosive. */
#include "model/findings.h"

#include <stdio.h>

#include "material/material.h"
#include "shape/shape.h"

/* The place at FRACTION of the line of DETONATION, or its point. */
static struct vec3 place_on(const struct detonation_input *detonation, double fraction)
{
    double at[3] = {0.0, 0.0, 0.0};
    for (int axis = 0; axis < detonation->at.count; axis++)
        at[axis] =
            detonation->at.at[axis] +
            (detonation->to.count ? fraction * (detonation->to.at[axis] - detonation->at.at[axis])
                                  : 0.0);
    return vector_at(at);
}

/* How far the ignition is from BODY; 0 where it is within NEAR of the box around that: some ignite
 * a cavity on purpose. */
static double gap_to(const struct simulation_case *input, const struct detonation_input *detonation,
                     int body, double near)
{
    enum { POINTS = 101 };
    const struct one_of *shape = &case_body(input, body)->shape;
    const struct bounds bounds = shape_bounds(shape);
    double least = INFINITY;
    for (int k = 0; k < (detonation->to.count ? POINTS : 1); k++) {
        const struct vec3 place = place_on(detonation, (double)k / (POINTS - 1));
        const double gap = bounds_distance(&bounds, place, (int)input->dimension);
        least = minimum(least, gap > near ? gap : 0.0);
    }
    return least;
}

/* When the detonation arrives at BODY, GAP away. */
static double arrival_at(const struct simulation_case *input,
                         const struct detonation_input *detonation, int body, double gap)
{
    const struct material *material = body_material(input, body);
    return detonation->time + gap / material_detonation_speed(material);
}

static void judge_ignition(struct findings *findings, int index)
{
    const struct simulation_case *input = findings->input;
    const struct detonation_input *detonation = case_detonation(input, index);
    const char *name = input->detonations.names[index];
    const double near = 2.0 * input->resolution;
    double gap = INFINITY, arrival = INFINITY;
    int nearest = -1;
    for (int body = 0; body < input->bodies.count; body++) {
        if (!detonation_lights(input, index, body))
            continue;
        const double own = gap_to(input, detonation, body, near),
                     first = arrival_at(input, detonation, body, own);
        arrival = minimum(arrival, first);
        if (own < gap) {
            gap = own;
            nearest = body;
        }
    }
    char late[120] = "";
    if (nearest >= 0 && arrival > input->run.until)
        snprintf(late, sizeof late, "after the end of the run at t = %.6g s: it ignites nothing",
                 input->run.until);
    if (nearest < 0 || (gap == 0.0 && !late[0]))
        return;
    if (gap == 0.0) {
        finding_add(findings, FINDING_NO_EFFECT, "detonations", name, "t = %.6g s is %s",
                    detonation->time, late);
        return;
    }

    finding_add(findings, FINDING_NO_EFFECT, "detonations", name,
                "it is %.4g m outside the nearest explosive, \"%s\": a detonation that runs "
                "from there arrives at t = %.4g s%s%s; put it into the explosive",
                gap, input->bodies.names[nearest], arrival, late[0] ? ", " : "", late);
}

void ignitions_judge(struct findings *findings)
{
    for (int i = 0; i < findings->input->detonations.count; i++)
        judge_ignition(findings, i);
}
