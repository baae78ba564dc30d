/* From samples of a surface to its elements, and the particles that they follow. */
#include <stdlib.h>

#include "base/field.h"
#include "base/memory.h"
#include "model/surface_sampler.h"

/* The carriers around carrier C, which go to FOUND unless it is NULL. Returns their number. */
static int32_t sites_around(const struct sampler *s, int32_t c, int32_t *found)
{
    static const double reach = 1.6; /* spacings: neighbours across the corners of cells too */
    int64_t at[3];
    int k[3];
    int32_t count = 0;
    sampler_cell_of(s, s->carrier[c].place, at);
    for (int n = 0; n < sampler_around(s->dimension, n, k); n++) {
        const int64_t cell = sampler_cell(s, at, k);
        for (int32_t o = cell < 0 ? -1 : s->cell[cell]; o >= 0; o = s->carrier[o].next)
            if (o != c &&
                sampler_distance(s, &s->carrier[o], s->carrier[c].place) < square(reach)) {
                if (found)
                    found[count] = o;
                count++;
            }
    }
    return count;
}

/* Numbers the carriers that a surface needs, NUMBER, by site; -1 for the others. */
static void number_sites(const struct sampler *s, struct body_surface *surface, int32_t *number)
{
    int32_t near[256];
    for (int64_t c = 0; c < s->carriers; c++)
        number[c] = -1;
    for (int32_t c = 0; c < s->carriers; c++) {
        if (s->carrier[c].element < 0)
            continue;
        number[c] = 0;
        const int32_t count = sites_around(s, c, NULL) <= 256 ? sites_around(s, c, near) : 0;
        for (int32_t k = 0; k < count; k++)
            number[near[k]] = 0;
    }
    for (int64_t c = 0; c < s->carriers; c++)
        if (number[c] == 0)
            number[c] = surface->sites++;
}

static void fill_sites(const struct sampler *s, struct body_surface *surface, const int32_t *number)
{
    int32_t near = 0, element = 0;
    for (int32_t c = 0; c < s->carriers; c++) {
        const int32_t site = number[c];
        const struct carrier *carrier = &s->carrier[c];
        if (site < 0)
            continue;
        surface->id[site] = particle_id(s->body, carrier->site);
        surface->start[site] = carrier->place;
        surface->place[site] = (struct vec3){NAN, NAN, NAN};
        surface->member[site] = -1;
        surface->first[site] = near;
        if (carrier->element >= 0) {
            const int32_t count = sites_around(s, c, surface->near + near);
            for (int32_t k = near; k < near + count; k++)
                surface->near[k] = number[surface->near[k]];
            near += count;
        }
        for (int32_t e = carrier->element; e >= 0; e = s->piece[e].next) {
            struct surface_element *to = &surface->element[element++];
            *to = s->piece[e].element;
            struct surface_state *start = &to->start;
            to->site = site;
            start->place = vec3_scale(1.0 / s->piece[e].weight, start->place);
            start->normal =
                vec3_scale(1.0 / sqrt(vec3_dot(start->normal, start->normal)), start->normal);
        }
    }
    surface->first[surface->sites] = near;
}

bool sampler_make_surface(const struct sampler *s, struct body_surface *surface)
{
    int32_t *number = malloc(((size_t)s->carriers + 1) * sizeof *number);
    if (!number)
        return false;
    number_sites(s, surface, number);
    int64_t near = 0;
    for (int32_t c = 0; c < s->carriers; c++)
        near += s->carrier[c].element < 0 ? 0 : sites_around(s, c, NULL);
    const size_t sites = (size_t)surface->sites;
    surface->elements = (int32_t)s->pieces;
    surface->element = memory_allocate((size_t)s->pieces * sizeof *surface->element);
    surface->now = memory_allocate((size_t)s->pieces * sizeof *surface->now);
    surface->id = memory_allocate(sites * sizeof *surface->id);
    surface->start = memory_allocate(sites * sizeof *surface->start);
    surface->place = memory_allocate(sites * sizeof *surface->place);
    surface->member = memory_allocate(sites * sizeof *surface->member);
    surface->first = memory_allocate((sites + 1) * sizeof *surface->first);
    surface->near = memory_allocate((size_t)near * sizeof *surface->near);
    const bool done = near <= INT32_MAX && surface->element && surface->now && surface->id &&
                      surface->start && surface->place && surface->member && surface->first &&
                      surface->near;
    if (done)
        fill_sites(s, surface, number);
    free(number);
    return done;
}
