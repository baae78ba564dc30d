/* asymmetry: how far a field is from its own mirror image. Each particle is compared with the one that
 * stood at the start where its image did:
 *   largest |f_i - s f_image(i)| / largest |f|, s = 1 for an even field, -1 for an odd one. */
#include <stdlib.h>

#include "base/memory.h"
#include "model/start_place.h"
#include "run/measure.h"
#include "run/near_points.h"

static const char *const across_names[] = {"x", "y", "z", "xy", "xyz", NULL};
static const char *const parity_names[] = {"even", "odd", NULL};
static const bool flips[][3] = {{true, false, false},
                                {false, true, false},
                                {false, false, true},
                                {true, true, false},
                                {true, true, true}};
/* An image is found when a particle stood within this part of the resolution of it. */
static const double tolerance = 1e-3;

const struct parameter measure_asymmetry_table[] = {
    {.key = "field",
     .kind = PARAMETER_TEXT,
     .offset = offsetof(struct measure_asymmetry, field),
     .standard = PARAMETER_REQUIRED,
     .help = "a field of the particles, or one component of it: velocity.x, displacement.y"},
    {.key = "across",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct measure_asymmetry, across),
     .standard = PARAMETER_REQUIRED,
     .names = across_names,
     .help = "the axis whose sign the image changes; xy: both, half a turn about z"},
    {.key = "parity",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct measure_asymmetry, parity),
     .standard = "even",
     .names = parity_names,
     .help = "whether the field is the same at the image, or changes its sign"},
    {.key = "center",
     .kind = PARAMETER_VECTOR,
     .offset = offsetof(struct measure_asymmetry, center),
     .unit = "m",
     .standard = PARAMETER_OPTIONAL,
     .help = "a point that is its own image; the origin when not given"},
    PARAMETER_END,
};

/* A search for the particle that stood nearest to a place. */
struct search {
    const double (*start)[3];
    double image[3];
    double distance2;
    int64_t nearest;
};

static void look_at(void *context, int64_t index)
{
    struct search *search = context;
    const double *x = search->start[index];
    const double distance2 = square(x[0] - search->image[0]) + square(x[1] - search->image[1]) +
                             square(x[2] - search->image[2]);
    if (distance2 < search->distance2) {
        search->distance2 = distance2;
        search->nearest = index;
    }
}

static struct error *compare(const struct measurement *measurement, const double (*start)[3],
                             const double *field, double *value)
{
    const struct measure_asymmetry *parameters = measurement->check->measure.value;
    const struct particles *p = &measurement->simulation->particles;
    const double reach = tolerance * measurement->simulation->input->resolution;
    const double sign = parameters->parity ? -1.0 : 1.0;
    const int body = measure_body(measurement);
    double largest = 0.0, off = 0.0;
    struct near_points near;
    TRY(near_points_make(start, p->count, reach, &near));
    for (int32_t i = 0; i < p->count; i++) {
        if (body >= 0 && p->body[i] != body)
            continue;
        struct search search = {start, {0}, square(reach), -1};
        for (int k = 0; k < 3; k++)
            search.image[k] = flips[parameters->across][k]
                                  ? 2.0 * parameters->center.at[k] - start[i][k]
                                  : start[i][k];
        near_points_about(&near, search.image, look_at, &search);
        const double image = search.nearest < 0 ? NAN : field[search.nearest];
        const double difference = fabs(field[i] - sign * image);
        off = difference > off || isnan(difference) ? difference : off;
        largest = maximum(largest, fabs(field[i]));
        if (isnan(off))
            break;
    }
    near_points_free(&near);
    *value = off == 0.0 ? 0.0 : off / largest;
    return NULL;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_asymmetry *parameters = measurement->check->measure.value;
    const int32_t count = measurement->simulation->particles.count;
    const struct view *view;
    int component;
    TRY(views_choose(measurement->views, parameters->field, NULL, 0, &view, &component));
    double(*start)[3] = memory_allocate(((size_t)count + 1) * sizeof *start);
    double *field = memory_allocate(((size_t)count + 1) * sizeof *field);
    struct error *error = NULL;
    if (!start || !field)
        error = error_new(ERROR_SYSTEM, "out of memory for a check of %d particles", (int)count);
    if (!error) {
        start_places(measurement->simulation, 0, count, start);
        view_read_component(view, component, 0, count, field);
        error = compare(measurement, (const double(*)[3])start, field, value);
    }
    free(start);
    free(field);
    return error;
}

const struct measure_class measure_asymmetry = {.at_once = true,
                                                .of_field = true,
                                                .unit = measure_no_unit,
                                                .measure = measure,
                                                .of_bodies = true};
