/* pieces: into how many pieces bodies are broken. Two particles of one body hang together when they are
 * nearer than link (D_i + D_j). Particles of different bodies do not, however close. */
#include <stdlib.h>

#include "base/memory.h"
#include "run/measure.h"
#include "run/near_points.h"

const struct parameter measure_pieces_table[] = {
    {.key = "link",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct measure_pieces, link),
     .standard = "0.8",
     .below = INFINITY,
     .help =
         "the distance up to which two particles hang together, over the sum of their diameters"},
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    int component;
    if (!views_find(measurement->views, "diameter", &component))
        return measure_error(measurement, "the particles of this solver have no diameter");
    *unit = "";
    return NULL;
}

/* A search for the particles that hang together with particle `index`. */
struct search {
    const struct particles *particles;
    const double *diameter;
    double link;
    int32_t *parent; /* of each particle; its own where it stands for a piece, -1: not counted */
    int32_t index;
};

static int32_t root_of(int32_t *parent, int32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static void try_link(void *context, int64_t other)
{
    struct search *search = context;
    const struct particles *p = search->particles;
    const int32_t i = search->index, j = (int32_t)other;
    if (j >= i || search->parent[j] < 0 || p->body[i] != p->body[j])
        return;
    const double *a = p->position[i], *b = p->position[j];
    const double reach = search->link * (search->diameter[i] + search->diameter[j]);
    if (square(a[0] - b[0]) + square(a[1] - b[1]) + square(a[2] - b[2]) < square(reach))
        search->parent[root_of(search->parent, i)] = root_of(search->parent, j);
}

static struct error *count_pieces(struct search *search, int body, double *pieces)
{
    const struct particles *p = search->particles;
    struct near_points near;
    double largest = 0.0;
    for (int32_t i = 0; i < p->count; i++) {
        search->parent[i] = body < 0 || p->body[i] == body ? i : -1;
        largest = maximum(largest, search->diameter[i]);
    }
    TRY(near_points_make((const double(*)[3])p->position, p->count, 2.0 * search->link * largest,
                         &near));
    for (search->index = 0; search->index < p->count; search->index++)
        if (search->parent[search->index] >= 0)
            near_points_about(&near, p->position[search->index], try_link, search);
    near_points_free(&near);
    int32_t roots = 0;
    for (int32_t i = 0; i < p->count; i++)
        roots += search->parent[i] == i;
    *pieces = roots;
    return NULL;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_pieces *parameters = measurement->check->measure.value;
    const struct particles *particles = &measurement->simulation->particles;
    const size_t room = (size_t)particles->count + 1;
    int component;
    const struct view *view = views_find(measurement->views, "diameter", &component);
    double *diameter = memory_allocate(room * sizeof *diameter);
    int32_t *parent = memory_allocate(room * sizeof *parent);
    struct error *error = NULL;
    if (!diameter || !parent)
        error = error_new(ERROR_SYSTEM, "out of memory for a check of %d particles",
                          (int)particles->count);
    if (!error) {
        struct search search = {particles, diameter, parameters->link, parent, 0};
        view_read(view, 0, particles->count, diameter);
        error = count_pieces(&search, measure_body(measurement), value);
    }
    free(diameter);
    free(parent);
    return error;
}

const struct measure_class measure_pieces = {
    .at_once = true, .unit = unit, .measure = measure, .of_bodies = true};
