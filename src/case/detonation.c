/* Where and when a case's explosives are lit: its keys, and when the detonation arrives where. */
#include <math.h>

#include "case/internal.h"
#include "material/material.h"

const struct parameter case_detonation_table[] = {
    PARAMETER(VECTOR, struct detonation_input, at, REQUIRED,
              "position of the ignition, one value per dimension", .unit = "m"),
    PARAMETER(VECTOR, struct detonation_input, to, OPTIONAL,
              "other end of a line that is ignited along its whole length", .unit = "m"),
    PARAMETER(NUMBER, struct detonation_input, time, "0 s", "time of the ignition", .unit = "s",
              .below = INFINITY, .closed = true),
    PARAMETER(TEXT, struct detonation_input, of, OPTIONAL,
              "the body that it ignites; default: all explosives"),
    PARAMETER_END,
};

bool detonation_lights(const struct simulation_case *input, int index, int body)
{
    const struct material_input *material =
        case_material(input, case_body(input, body)->material_index);
    const int of = case_detonation(input, index)->body;
    return material_is_lit(material->material) && (of < 0 || of == body);
}

static struct vec3 vector(const struct vector_value *value)
{
    return vec3_make(value->at[0], value->count > 1 ? value->at[1] : 0.0,
                     value->count > 2 ? value->at[2] : 0.0);
}

/* How far PLACE is from the point or line of DETONATION. */
static double distance(const struct detonation_input *detonation, struct vec3 place)
{
    const struct vec3 from = vector(&detonation->at), way = vec3_sub(place, from);
    double share = 0.0;
    struct vec3 line = {0.0, 0.0, 0.0};
    if (detonation->to.count) {
        line = vec3_sub(vector(&detonation->to), from);
        share = maximum(0.0, minimum(1.0, vec3_dot(way, line) / vec3_dot(line, line)));
    }
    const struct vec3 rest = vec3_sub(way, vec3_scale(share, line));
    return hypot(hypot(rest.x, rest.y), rest.z);
}

double detonation_arrival(const struct simulation_case *input, int body, struct vec3 place)
{
    const struct burn *burn = &body_material(input, body)->burn;
    double arrival = INFINITY;
    for (int i = 0; i < input->detonations.count; i++) {
        const struct detonation_input *detonation = case_detonation(input, i);
        if (detonation_lights(input, i, body))
            arrival =
                minimum(arrival, detonation->time + distance(detonation, place) / burn->of.speed);
    }
    return isfinite(arrival) ? arrival : 0.0;
}
